"""Run directories of a membrane family that is known in closed form.

The membrane is a sphere of radius a, a toroidal fillet of radius rho and a flat annulus at height z0, joined tangentially; the sphere ends
at polar angle alpha (from the top). Growing alpha at constant cap area buds a patch off. Enlarging a by d, shrinking rho by d and
lifting z0 by d moves every point by exactly d along its normal: two such runs are parallel curves at distance d.
Units: nm, µs, pN.
"""

import csv
import json
from dataclasses import dataclass

import h5py
import numpy as np
from scipy.integrate import trapezoid

from endoflow.curves import arc_length, equivalent_radius
from endoflow.shapes import FIELDS

RIM = 80.0
PATCH_RADIUS = 36.0
INTERFACE_WIDTH = 1.2
FILLET = 8.0
FLAT_HEIGHT = 80.0
MEMBRANE_UNITS = {
    "s": "nm",
    "r": "nm",
    "z": "nm",
    "c": "1",
    "lambda": "pN/nm",
    "kappa": "1/nm",
    "u_r": "nm/us",
    "u_z": "nm/us",
}


#: An entry of run.json's `alarms`.
ALARM = {
    "name": "energy-balance",
    "time_us": 0.125,
    "value": 4.1e-3,
    "bound": 1e-3,
    "meaning": "rate against power",
    "remedy": "raise elements",
}


@dataclass(frozen=True)
class SphereOnPlane:
    """a, rho, z0 in nm, alpha in radians."""

    a: float
    rho: float
    z0: float
    alpha: float

    @property
    def fillet_centre(self):
        """r of the centre of the fillet's circle, nm."""
        return (self.a + self.rho) * np.sin(self.alpha)

    @property
    def sphere_centre(self):
        """z of the centre of the sphere, nm."""
        return self.z0 + self.rho - (self.a + self.rho) * np.cos(self.alpha)

    @property
    def neck_radius(self):
        """nm; nan without a neck (alpha up to a right angle)."""
        return self.fillet_centre - self.rho if self.alpha > np.pi / 2 else np.nan

    @property
    def bud_diameter(self):
        """nm; nan without a neck."""
        return 2 * self.a if self.alpha > np.pi / 2 else np.nan

    @property
    def bud_height(self):
        """Apex above the plane, nm."""
        return self.sphere_centre + self.a - self.z0

    @property
    def area(self):
        """Area inside r = RIM, nm²."""
        sphere = 2 * np.pi * self.a**2 * (1 - np.cos(self.alpha))
        fillet = 2 * np.pi * self.rho * (self.fillet_centre * self.alpha - self.rho * (1 - np.cos(self.alpha)))
        return sphere + fillet + np.pi * (RIM**2 - self.fillet_centre**2)

    def curve(self, points):
        """r, z, total curvature, each (points,), at equal arc length, from the axis to r = RIM."""
        sphere_end = self.a * self.alpha
        fillet_end = sphere_end + self.rho * self.alpha
        s = np.linspace(0.0, fillet_end + RIM - self.fillet_centre, points)
        on_sphere, on_fillet = s <= sphere_end, (s > sphere_end) & (s <= fillet_end)
        theta = np.where(on_sphere, s / self.a, self.alpha - (s - sphere_end) / self.rho)
        r = np.where(on_sphere, self.a * np.sin(theta), self.fillet_centre - self.rho * np.sin(theta))
        z = np.where(on_sphere, self.sphere_centre + self.a * np.cos(theta), self.z0 + self.rho * (1 - np.cos(theta)))
        flat = ~on_sphere & ~on_fillet
        r[flat], z[flat] = self.fillet_centre + s[flat] - fillet_end, self.z0
        kappa = np.where(
            on_sphere, 2 / self.a, np.where(on_fillet, np.sin(theta) / np.maximum(r, 1e-9) - 1 / self.rho, 0.0)
        )
        return r, z, kappa


def budding_membrane(time, duration, offset=0.0, final_angle=2.8):
    """The family's membrane at `time` of a run of `duration` µs, moved outward by `offset` nm."""
    alpha = 0.15 + (final_angle - 0.15) * (1 - np.exp(-3 * time / duration)) / (1 - np.exp(-3))
    a = PATCH_RADIUS / np.sqrt(2 * (1 - np.cos(alpha)))
    return SphereOnPlane(a + offset, FILLET - offset, FLAT_HEIGHT + offset, alpha)


def concentration(r, z):
    """c (n,): the patch profile as a function of material area."""
    return 0.5 * (1 - np.tanh((equivalent_radius(r, z) - PATCH_RADIUS) / (np.sqrt(2) * INTERFACE_WIDTH)))


def history_row(membrane, time, step):
    """One row of history.csv as {column: value}; nan where the column is empty."""
    r, z, kappa = membrane.curve(2000)
    c = concentration(r, z)
    area = np.pi * equivalent_radius(r, z) ** 2
    energy_density = 0.5 * (50 + 550 * c) * (kappa - 2 * c / 14.1) ** 2
    return {
        "time_us": time,
        "step_us": step,
        "neck_radius_nm": membrane.neck_radius,
        "bud_diameter_nm": membrane.bud_diameter,
        "bud_height_nm": membrane.bud_height,
        "membrane_area_nm2": membrane.area,
        "bending_energy_pN_nm": trapezoid(energy_density, area),
        "molecule_mass_nm2": trapezoid(c, area),
        "area_strain_max": 1e-4 * (1 + time),
        "volume_extracellular_nm3": trapezoid((z - membrane.z0) * np.pi * 2 * r * np.gradient(r), dx=1.0),
        "wall_s": 20 * time,
    }


def parameters(**changes):
    """Resolved parameters by section; changes as molecules__patch_radius=40."""
    sections = {
        "domain": {"radius": RIM, "height": 160.0, "membrane_height": FLAT_HEIGHT, "pin_half_width": 5.0},
        "fluid": {
            "viscosity_extracellular": 1e-3,
            "viscosity_intracellular": 1e-2,
            "inertia": False,
            "dynamics": "flow",
        },
        "membrane": {
            "bending_stiffness": 100.0,
            "bending_stiffness_coated": 1200.0,
            "curvature_convention": "as-printed",
        },
        "molecules": {"patch_radius": PATCH_RADIUS, "transport": "cahn-hilliard", "interface_width": INTERFACE_WIDTH},
        "phase_field": {"scheme": "production", "epsilon": 1.2, "production": {"thinning": 1.0}},
        "boundary_integral": {"elements": 32},
        "time": {"end": 1.0, "tolerance": 1e-4},
        "output": {"shape_interval": 0.25, "field_interval": 0.0},
    }
    for key, value in changes.items():
        section, name = key.split("__")
        sections[section][name] = value
    return sections


def budding_time(membrane_at, duration):
    """Time (µs) at which the neck radius falls below 5 nm, by bisection; None when it does not."""
    if not membrane_at(duration).neck_radius < 5:
        return None
    low, high = 0.0, duration
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if membrane_at(middle).neck_radius < 5 else (middle, high)
    return high


def write_run(directory, engine, membrane_at, shape_times, points=400, case=None):
    """Write a run directory (pathlib.Path) whose membrane at a time (µs) is membrane_at(time)."""
    directory.mkdir(parents=True, exist_ok=True)
    end = shape_times[-1]
    history_times = np.linspace(shape_times[0], end, 201)
    rows = [history_row(membrane_at(t), t, end / 200) for t in history_times]
    write_history(directory / "history.csv", rows)
    with h5py.File(directory / "shapes.h5", "w") as file:
        for number, time in enumerate(shape_times):
            write_shape(file, number, time, membrane_at, points)
    budding = budding_time(membrane_at, end)
    record = {
        "format": "endoflow run",
        "format_version": 1,
        "engine": engine,
        "state": "finished",
        "resolution": "32 elements, time tolerance 1e-04",
        "exit_reason": "done",
        "time_us": end,
        "parameters": case or parameters(),
        "provenance": {
            "version": "0.0.0",
            "git": "synthetic",
            "libraries": {"hdf5": "1.10.8"},
            "host": "nowhere",
            "cores": 2,
        },
        "steps": {"accepted": 201, "rejected": 3},
        "wall_s": 20 * end,
        "columns": dict.fromkeys(rows[0], "what the family has"),
        "phases": {"assembly": {"wall_s": 5.0, "cpu_s": 9.0}},
        "events": {} if budding is None else {"budding": {"time_us": budding, "neck_radius_nm": 5.0}},
    }
    (directory / "run.json").write_text(json.dumps(record, indent=2))
    return directory


def write_history(path, rows):
    """rows: list of {column: value}; nan is written as an empty cell."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(rows[0])
        for row in rows:
            writer.writerow(["" if np.isnan(value) else f"{value:.12g}" for value in row.values()])


def write_shape(file, number, time, membrane_at, points):
    """One group /shapes/NNNNNN; the velocity is the central difference of the family at fixed relative arc length."""
    r, z, kappa = membrane_at(time).curve(points)
    step = 1e-4
    before, after = membrane_at(max(0.0, time - step)).curve(points), membrane_at(time + step).curve(points)
    arrays = {
        "s": arc_length(r, z),
        "r": r,
        "z": z,
        "c": concentration(r, z),
        "lambda": np.full(points, 0.01),
        "kappa": kappa,
        "u_r": (after[0] - before[0]) / (2 * step),
        "u_z": (after[1] - before[1]) / (2 * step),
    }
    group = file.create_group(f"shapes/{number:06d}")
    group.attrs["time"] = time
    for name in FIELDS:
        group.create_dataset(name, data=arrays[name]).attrs["unit"] = MEMBRANE_UNITS[name]


def write_pair(parent, offset=0.5, duration=1.0, count=21):
    """Two runs under `parent` (pathlib.Path) whose membranes are parallel curves at `offset` nm; returns both directories."""
    times = np.linspace(0.0, duration, count)
    a = write_run(parent / "a", "boundary-integral", lambda t: budding_membrane(t, duration), times)
    b = write_run(parent / "b", "phase-field", lambda t: budding_membrane(t, duration, offset), times, points=300)
    return a, b
