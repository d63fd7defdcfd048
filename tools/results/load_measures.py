"""Rows of studies of loads, of growing coats and of line tension: see measures.py."""

import numpy as np
from scipy.integrate import solve_ivp

from results.measures import at, cost, differences


def equal_mass_radius(run, time):
    """Radius of the coat of the initial profile that has as many molecules as the membrane at a time (µs), nm."""
    mass = float(np.interp(time, run.history["time_us"], run.history["molecule_mass_nm2"]))
    edge = run.parameters["molecules"]["interface_width"]
    return float(np.sqrt(mass / np.pi - (np.pi * edge) ** 2 / 6))  # of the profile ½ (1 − tanh((r − r_c)/(√2 edge)))


def speed(run, fold_nm):
    """How far a growing coat passes the fold of stationary shapes: coat of equal mass where the neck is 5 nm wide."""
    budding, neck = run.event_time("budding"), run.history["neck_radius_nm"]
    radius, accuracy = equal_mass_radius(run, budding), run.record["accuracy"]
    wide = np.flatnonzero(neck > 7)[-1]
    seven = float(np.interp(-7, -neck[wide:], run.history["time_us"][wide:]))
    row = {"budding_us": budding, "coat_nm": radius, "fold_nm": fold_nm, "beyond_nm": radius - fold_nm, "cpu_s": run.record["cpu_s"]}
    row |= {"balance": accuracy["energy-balance"]["largest"], "molecules": accuracy["molecule-balance"]["largest"]}
    return row | {"from_7_to_5_us": budding - seven, "steps": cost(run)["steps"], "elements": run.record["notes"]["elements"]}


def passing(rows):
    """The power of the speed with which what is passed of the fold falls, between the fastest and the slowest run."""
    fast, *_, slow = rows
    ratio = float(fast["speed_nm_per_us"]) / float(slow["speed_nm_per_us"])
    return [{"between": "fastest and slowest", "power": float(np.log(fast["beyond_nm"] / slow["beyond_nm"]) / np.log(ratio))}]


def engines_beside(sharp, diffuse, times):
    """Differences of the diffuse engine at times (µs), the loads' power among them; a neck's is nan where there is none."""
    rows = []
    for time, row in zip(times, differences(sharp, diffuse, times)):
        powers = [at(run, "load_power_pN_nm_per_us", time) for run in (diffuse, sharp)]
        found = {"time_us": row["time_us"], "height_sharp_nm": at(sharp, "bud_height_nm", time)}
        found |= {name: row[name] for name in ("height", "neck", "volume", "energy")}
        rows.append(found | {"load power": powers[0] / powers[1] - 1})
    return rows


def pulled(sharp, diffuse, times):
    """Heights and speeds (nm/µs) of a tube that is pulled at times (µs), and the diffuse engine's relative differences."""
    runs = (sharp, diffuse)
    courses = [(h["time_us"], np.gradient(h["bud_height_nm"], h["time_us"])) for h in (run.history for run in runs)]
    rows = []
    for time in times:
        heights = [at(run, "bud_height_nm", time) for run in runs]
        speeds = [float(np.interp(time, *course)) for course in courses]
        row = {"time_us": f"{time:g}", "height_sharp_nm": heights[0], "height": heights[1] / heights[0] - 1}
        rows.append(row | {"speed_sharp_nm_per_us": speeds[0], "speed": speeds[1] / speeds[0] - 1})
    return rows


def beside_rest(run, rest):
    """A growing coat when it has the molecules of a stationary shape, beside this shape."""
    time = float(np.interp(rest.history["molecule_mass_nm2"][-1], run.history["molecule_mass_nm2"], run.history["time_us"]))
    row = {"time_us": time}
    for name in ("neck_radius_nm", "bud_height_nm"):
        row |= {name: at(run, name, time), f"{name}_at_rest": float(rest.history[name][-1])}
    return row


def flat_coat(run):
    """Radius of equal mass of a flat coat at a run's end, and that which the law of its growth gives, nm."""
    case, end = run.parameters, float(run.history["time_us"][-1])
    first, speed, rim = case["molecules"]["patch_radius"], case["molecules"]["edge_speed"], case["domain"]["radius"]
    frozen = case["molecules"]["transport"] == "advection"

    def law(_, radius):
        """dr_c/dt of molecules that stay where they are, or whose edge is in equilibrium (docs/model.md)."""
        return speed if frozen else speed * (1 + (rim**2 - 2 * radius**2) / (12 * radius**2))

    expected = solve_ivp(law, (0, end), [first], rtol=1e-10).y[0, -1]
    row = {"end_us": end, "tolerance": run.record["notes"]["time_tolerance"]}
    return row | {"radius_nm": equal_mass_radius(run, end), "expected_nm": float(expected)}


def closing(run):
    """A domain that its line tension closes: until budding, and at the end."""
    h, budding = run.history, run.event_time("budding")
    before = h["time_us"] <= budding
    total = h["bending_energy_pN_nm"] + h["line_energy_pN_nm"]
    row = {"budding_us": budding, "balance": float(h["energy_balance_relative"][before].max()), "rise_pN_nm": float(np.diff(total).max())}
    row |= {"energy_first_pN_nm": float(total[0]), "line_first_pN_nm": float(h["line_energy_pN_nm"][0])}
    row |= {"end_us": float(h["time_us"][-1]), "neck_nm": float(h["neck_radius_nm"][-1])}
    return row | {name: float(h[name][-1]) for name in ("bending_energy_pN_nm", "line_energy_pN_nm")}


def at_rest(run, rest):
    """The end of a run beside the stationary shape: height, and relative differences of the rest."""
    columns = {"area": "membrane_area_nm2", "volume": "volume_extracellular_nm3", "line": "line_energy_pN_nm"}
    row = {"end_us": float(run.history["time_us"][-1])}
    row |= {"height_nm": float(run.history["bud_height_nm"][-1]), "height_at_rest_nm": float(rest.history["bud_height_nm"][-1])}
    return row | {name: float(run.history[column][-1] / rest.history[column][-1] - 1) for name, column in columns.items()}


def outcomes(rows):
    """Rows of a map's table: where its runs are, and how they end."""
    return [
        {"run": f"{number}", "radius_nm": row["molecules.patch_radius"], "tension_pN_per_nm": row["membrane.rim_tension"]}
        | {"outcome": row["outcome"], "alarms": row["alarms"] or ""}
        for number, row in enumerate(rows)
    ]


def counts(rows):
    """How many of a map's runs have each outcome, how many there are, and how many raised an alarm."""
    ends = [row["outcome"] for row in rows]
    found = [{"outcome": name, "runs": ends.count(name)} for name in dict.fromkeys(ends)]
    return [*found, {"outcome": "all", "runs": len(rows)}, {"outcome": "alarmed", "runs": sum(1 for row in rows if row["alarms"])}]


def boundaries(rows):
    """The points of a map's boundaries."""
    return [
        {"point": f"{number}", "between": row["between"], "radius_nm": row["molecules.patch_radius"]}
        | {"tension_pN_per_nm": row["membrane.rim_tension"]}
        for number, row in enumerate(rows)
    ]


def stationary(run):
    """Where a branch of stationary shapes folds, and where its neck is 1 nm wide, which counts as closed."""
    folds = [fold["value"] for fold in run.record["notes"]["branch"]["folds"]] + [None, None]
    neck, value = run.history["neck_radius_nm"], run.history["followed_value"]
    closed = np.flatnonzero(neck < 1)
    around = slice(closed[0], closed[0] - 2, -1) if len(closed) else None
    closes = float(np.interp(1, neck[around], value[around])) if len(closed) else None
    return {"fold_1": folds[0], "fold_2": folds[1], "closes": closes}
