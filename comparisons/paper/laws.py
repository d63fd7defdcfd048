"""The constitutive laws as the program computes them."""

import csv
import subprocess

import numpy as np

from comparisons.errors import IO_FAILURE, StudyError
from comparisons.studies.study import program
from endoflow.errors import last_word


def constitutive_laws():
    """{column: array} of `endoflow laws`: c, and for each law LAW_b_pN_nm and LAW_H0_per_nm. Raises StudyError."""
    found = subprocess.run([str(program()), "laws"], capture_output=True, text=True, check=False)
    if found.returncode:
        raise StudyError(last_word(found.stderr), IO_FAILURE)
    header, *rows = csv.reader(found.stdout.splitlines())
    return dict(zip(header, np.array(rows, dtype=float).T))
