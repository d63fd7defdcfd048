"""`endoflow crate DIR`: ro-crate-metadata.json in a run's directory, with which archives know what is in it.

Exit codes: 0 done; 2 bad command line; 4 the run cannot be read or the file cannot be written; 130 interrupted.
"""

import endoflow
from comparisons.errors import shown
from comparisons.files import write_json
from comparisons.page.run_crate import crate


def run(options):
    """Run the command; returns its exit code."""
    path = options.directory / "ro-crate-metadata.json"
    write_json(path, crate(endoflow.load(options.directory), options.license))
    print(f"metadata  {shown(path)}")
    return 0
