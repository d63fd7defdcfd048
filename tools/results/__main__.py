"""python3 tools/results BUILD …: see command.py."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve()
sys.path[0] = str(HERE.parents[1])
sys.path[1:1] = [str(HERE.parents[2]), str(HERE.parents[2] / "python")]

from results.command import main  # noqa: E402

sys.exit(main())
