"""`endoflow crate DIR`: ro-crate-metadata.json in a run's directory, with which archives know what is in it.

Exit codes: 0 done; 2 bad command line; 4 the run cannot be read or the file cannot be written; 130 interrupted.
"""

from pathlib import Path

from comparisons.files import shown, write_json

from .options import Parser


def parsed(arguments):
    """The command line as a namespace."""
    parser = Parser(
        prog="endoflow crate", description="Describe a run's directory for archives (RO-Crate).", allow_abbrev=False
    )
    parser.add_argument("directory", metavar="DIR", type=Path, help="directory of a run")
    parser.add_argument("--license", metavar="URL", help="licence under which the data are published (default: left open)")
    return parser.parse_args(arguments)


def run(options):
    """Run the command; returns its exit code."""
    import endoflow
    from comparisons.page.run_crate import crate

    found = endoflow.load(options.directory)
    path = options.directory / "ro-crate-metadata.json"
    write_json(path, crate(found, options.license))
    print(f"metadata  {shown(path)}")
    return 0
