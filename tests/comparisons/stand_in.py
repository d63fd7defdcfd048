"""A model in closed form in place of runs: courses that depend on parameters as those of a budding membrane do."""

import locations  # noqa: F401
import numpy as np

from comparisons.inference.course import BUDDED, FIRST_GRID, SECOND_GRID, Course
from comparisons.inference.problem import Problem
from comparisons.inference.study_file import read_study

#: Parameters of the case.
PARAMETERS = {
    "case": {"name": "stand-in"},
    "fluid": {
        "viscosity_extracellular": 1e-3,
        "viscosity_intracellular": 1e-2,
        "inertia": False,
        "dynamics": "flow",
    },
    "domain": {"kind": "box", "radius": 80.0, "height": 160.0, "membrane_height": 80.0},
    "membrane": {"bending_stiffness": 100.0, "bending_stiffness_coated": 1200.0, "spontaneous_curvature": 0.07},
    "molecules": {"patch_radius": 36.0, "transport": "cahn-hilliard", "mobility": 64e3},
    "time": {"end": 20.0},
}


def course(settings):
    """The Course of {key: text} over PARAMETERS: slower with viscosity, faster with stiffness, smaller with curvature."""

    def value(key):
        section, name = key.split(".")
        return float(settings.get(key, PARAMETERS[section][name]))

    pace = value("fluid.viscosity_intracellular") / 1e-2 * 1200 / value("membrane.bending_stiffness_coated")
    size = 0.07 / value("membrane.spontaneous_curvature")
    neck_time, end = 0.12 * pace * size**3, 0.82 * pace * size**2
    second = neck_time + (end - neck_time) * SECOND_GRID
    reached = np.linspace(0, 1, len(SECOND_GRID)) ** 2
    height = lambda t: 44 * size * (1 - np.exp(-4 * t / end))  # noqa: E731
    return Course(
        BUDDED,
        neck_time,
        end,
        {"bud_height_nm": height(neck_time * FIRST_GRID)},
        {
            "bud_height_nm": height(second),
            "neck_radius_nm": 5 + 23 * size * (np.exp(-2.5 * reached) - np.exp(-2.5)) / (1 - np.exp(-2.5)),
            "bud_diameter_nm": size * (42 + 14 * np.exp(-4 * reached)),
        },
    )


class StandIn:
    """As simulator.Simulator."""

    make = staticmethod(course)

    def __init__(self, problem):
        self.problem, self.points, self.known = problem, [], []

    def courses(self, points):
        found = [self.make(self.problem.settings(point)) for point in points]
        self.points.extend(points)
        self.known.extend(found)
        return found

    def pool(self):
        return np.array(self.points), self.known

    def stop_if_interrupted(self):
        pass


def problem_of(directory, text):
    """The Problem of a study's text, written into a directory (Path) beside its data."""
    path = directory / "study.toml"
    path.write_text(text, encoding="utf-8")
    return Problem(read_study(path), PARAMETERS)
