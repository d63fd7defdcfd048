"""The type of every array in this package."""

import numpy as np
import numpy.typing as npt

#: Floating-point numbers, of any shape.
Array = npt.NDArray[np.float64]
