"""A run on 3, 4 and 6 processes has the history of one on one.

    python3 tests/reliability/several_processes.py build/endoflow
"""

import csv
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

from engines import COARSE, launcher, options, texts  # noqa: E402
from scratch import scratch_directory  # noqa: E402

PROGRAM = None
END = 2e-5  # µs, a few steps

# Newton's method ends at a fiftieth of a step's tolerance; where, depends on the factors, and those on the processes: with the
# default tolerance heights of 2 pm differ by up to 3e-5. With a hundredth of it at most by 2e-7 in volume and height, 5e-8 in
# energy, 2e-9 in mass and 1e-12 in area; times are the same.
STRICT = "time.tolerance=1e-6"
TOLERANCES = {
    "time_us": 1e-12,
    "bud_height_nm": 1e-6,
    "volume_extracellular_nm3": 1e-6,
    "membrane_area_nm2": 1e-9,
    "bending_energy_pN_nm": 1e-6,
    "molecule_mass_nm2": 1e-7,
}


def history(directory, processes):
    words = [PROGRAM, "run", "phase-field", "/dev/null", "-o", str(directory), "--until", str(END)]
    words += options((*texts(COARSE["phase-field"]), "output.field_interval=0", STRICT))
    subprocess.run(launcher(processes) + words, check=True, capture_output=True, timeout=1200)
    with open(directory / "history.csv", encoding="utf-8") as file:
        return list(csv.DictReader(file))


class SeveralProcesses(unittest.TestCase):
    def test_same_history(self):
        root = scratch_directory(self)
        one = history(root / "1", 1)
        for processes in (3, 4, 6):
            several = history(root / str(processes), processes)
            self.assertEqual(len(several), len(one))
            for name, tolerance in TOLERANCES.items():
                for row, expected in zip(several[1:], one[1:]):
                    with self.subTest(processes=processes, column=name, time=expected["time_us"]):
                        value = float(expected[name])
                        self.assertAlmostEqual(float(row[name]), value, delta=tolerance * abs(value))


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
