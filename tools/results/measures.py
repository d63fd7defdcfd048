"""From run directories to rows of tables. A row is a dict whose first entry names it; fractions are pure numbers."""

import numpy as np
from scipy.interpolate import griddata
from scipy.optimize import curve_fit

import endoflow
from comparisons.measures.convergence import extrapolated
from comparisons.paper.fig6 import line_fit
from comparisons.paper.patch_sweep import best, morphology, neck_index


def at(run, column, time):
    """A column of the history at a time (µs)."""
    return float(run.history_at(column, time))


def area_gain(run, time):
    """Area that came in since the membrane was flat, nm²."""
    return at(run, "membrane_area_nm2", time) - np.pi * run.parameters["domain"]["radius"] ** 2


#: Quantities that the engines are compared in: {name: (run, time) → value}.
COMPARED = {
    "area": area_gain,
    "volume": lambda run, time: at(run, "volume_extracellular_nm3", time),
    "energy": lambda run, time: at(run, "bending_energy_pN_nm", time),
    "height": lambda run, time: at(run, "bud_height_nm", time),
}


def cost(run):
    """Steps and time."""
    record = run.record
    return {"steps": record["steps"]["accepted"], "rejected": record["steps"]["rejected"], "cpu_s": record["cpu_s"], "wall_s": record["wall_s"]}


def shape_of_standard(run):
    """What is told of the standard case's shape."""
    return {
        "budding_us": run.event_time("budding"),
        "area_0.5_nm2": at(run, "membrane_area_nm2", 0.5),
        "neck_0.5_nm": at(run, "neck_radius_nm", 0.5),
        "neck_1_nm": at(run, "neck_radius_nm", 1),
        "diameter_1_nm": at(run, "bud_diameter_nm", 1),
    }


def energy(run):
    """Energy and dissipation of a run of the sharp engine, at times evenly spread over their logarithm."""
    columns = {"energy_pN_nm": "bending_energy_pN_nm", "dissipation_pN_nm_per_us": "dissipated_power_pN_nm_per_us"}
    times = np.geomspace(1e-3, run.history["time_us"][-1], 30)
    return [{"time_us": f"{time:.4g}"} | {name: at(run, column, time) for name, column in columns.items()} for time in times]


def early(run):
    """Area and volume of a run of the sharp engine to 0.5 µs, and their times, a fortieth of a decade apart or 0.1 µs."""
    times = np.union1d(np.geomspace(1e-3, 0.5, 109), np.arange(1, 6) / 10)
    columns = {"area_nm2": "membrane_area_nm2", "volume_nm3": "volume_extracellular_nm3"}
    return [{"time_us": f"{time:.10g}"} | {name: at(run, column, time) for name, column in columns.items()} for time in times]


def membrane(run, time):
    """The membrane at a time (µs): points of equal arc from the axis to the rim."""
    shape = run.shape_at(time)
    arcs = np.linspace(0, shape.s[-1], 121)
    values = {"r_nm": shape.r, "z_nm": shape.z, "c": shape.c}
    return [{"s_nm": f"{s:.4g}"} | {name: float(np.interp(s, shape.s, column)) for name, column in values.items()} for s in arcs]


def differences(sharp, diffuse, times):
    """A row for each time (µs): relative differences of a diffuse run from a sharp one, and both necks (nm)."""
    rows = []
    for time in times:
        row = {"time_us": f"{time:g}"}
        row |= {name: value(diffuse, time) / value(sharp, time) - 1 for name, value in COMPARED.items()}
        necks = [at(run, "neck_radius_nm", time) for run in (diffuse, sharp)]
        rows.append(row | {"neck_nm": necks[0], "neck_sharp_nm": necks[1], "neck": necks[0] / necks[1] - 1})
    return rows


def kept(run, law_from=0.02):
    """What a run of the diffuse engine keeps or loses; the energy law's residual over the dissipation from a time (µs) on."""
    h = run.history
    late = h["time_us"] >= law_from
    law = np.abs(h["energy_law_residual_pN_nm_per_us"][late] / h["viscous_dissipation_pN_nm_per_us"][late])
    mass = h["molecule_mass_nm2"]
    return {
        "strain": float(h["area_strain_max"].max()),
        "thickness": float(h["thickness_error_max"].max()),
        "profile": float(h["profile_error_max"].max()),
        "mass": float(np.abs(mass / mass[0] - 1).max()),
        "law_median": float(np.median(law)),
        "law_largest": float(law.max()),
    }


def largest_differences(sharp, diffuse):
    """Largest relative differences of the histories from a two-hundredth of their common time on, and of the budding time."""
    end = min(run.history["time_us"][-1] for run in (sharp, diffuse))
    times = np.linspace(end / 200, end, 400)
    columns = {"area": "membrane_area_nm2", "volume": "volume_extracellular_nm3", "energy": "bending_energy_pN_nm", "neck": "neck_radius_nm"}
    row = {}
    for name, column in columns.items():
        off = np.abs(diffuse.history_at(column, times) / sharp.history_at(column, times) - 1)
        row[name] = float(np.nanmax(off)) if np.isfinite(off).any() else None
    buddings = [run.event_time("budding") for run in (sharp, diffuse)]
    late = buddings[1] / buddings[0] - 1 if all(buddings) else None
    return {"budding_sharp_us": buddings[0], "budding_us": buddings[1], "late": late} | row


def refinement(run):
    """Settings, results and cost of a run of the sharp engine."""
    end = run.history["time_us"][-1]
    return {
        "elements": run.record["notes"]["elements"],
        "tolerance": run.record["notes"]["time_tolerance"],
        "points": run.parameters["boundary_integral"]["quadrature_order"],
        "budding_us": run.event_time("budding"),
        "neck_nm": at(run, "neck_radius_nm", end),
        "area_nm2": at(run, "membrane_area_nm2", end),
        "strain": float(run.history["area_strain_max"].max()),
    } | cost(run)


def chosen_resolution(run, converged):
    """How far a run at default accuracy is from the converged budding time (µs)."""
    budding = run.event_time("budding")
    counts = [step["elements"] for step in run.record["notes"]["elements_from"]]
    return {
        "elements": " → ".join(map(str, counts)),
        "budding_us": budding,
        "converged_us": converged,
        "off": abs(budding / converged - 1),
        "estimate": run.record["accuracy"]["resolution"]["largest"],
        "cpu_s": run.record["cpu_s"],
    }


def alarmed(run, reference):
    """When the energy balance raised the alarm, and the errors of neck and energy before and in all; the larger of both."""
    alarm = next((alarm.time for alarm in run.alarms if alarm.name == "energy-balance"), None)
    times = run.history["time_us"]
    errors = np.zeros_like(times)
    for column in ("neck_radius_nm", "bending_energy_pN_nm"):
        off = np.abs(run.history[column] / reference.history_at(column, times) - 1)
        errors = np.fmax(errors, np.where(np.isfinite(off), off, 0))
    before = errors if alarm is None else errors[times < alarm]
    return {
        "alarm_us": alarm,
        "before": float(before.max()) if len(before) else None,
        "balance": float(np.nanmax(run.history["energy_balance_relative"])),
        "error": float(errors.max()),
        "end_us": float(times[-1]),
        "state": run.record["state"],
    }


def patch(run):
    """What Figs. 5 to 7 show of a patch radius, at the end of a run or where its neck closed."""
    end, shape = run.history["time_us"][-1], run.shapes[-1]
    necked = neck_index(shape) is not None
    budding = run.record["events"].get("budding", {})
    return {
        "budding_us": run.event_time("budding"),
        "end_us": float(end),
        "neck_nm": at(run, "neck_radius_nm", end) if necked else None,
        "diameter_nm": at(run, "bud_diameter_nm", end) if necked else None,
        "height_nm": at(run, "bud_height_nm", end),
        "shape": morphology(shape),
        "neck_1_nm": at(run, "neck_radius_nm", 1),
        "diameter_at_budding_nm": budding.get("bud_diameter_nm"),
    }


def thin_layer(sharp, diffuse):
    """A uniform layer of the standard case beside the sharp engine."""

    def off(column, time):
        return at(diffuse, column, time) / at(sharp, column, time) - 1

    budding = diffuse.event_time("budding")
    row = {"budding_us": budding, "late": budding / sharp.event_time("budding") - 1}
    row |= {f"neck_{time}": off("neck_radius_nm", time) for time in (0.4, 0.6, 0.8)}
    row |= {f"energy_{time}": off("bending_energy_pN_nm", time) for time in (0.25, 0.5, 0.8)}
    row |= {f"volume_{time}": off("volume_extracellular_nm3", time) for time in (0.25, 0.5, 0.8)}
    return row | {name: value for name, value in cost(diffuse).items() if name in ("steps", "cpu_s")}


def relaxation(sharp, diffuse, times):
    """Rows of a closed vesicle: relative differences of energy and height from the sharp engine's, of the volume from the start."""
    start = diffuse.history["volume_extracellular_nm3"][0]
    rows = []
    for time in times:
        energies, heights = ([at(run, column, time) for run in (sharp, diffuse)] for column in ("bending_energy_pN_nm", "bud_height_nm"))
        row = {"time_us": f"{time:g}", "energy_sharp_pN_nm": energies[0], "energy": energies[1] / energies[0] - 1}
        rows.append(row | {"height": heights[1] / heights[0] - 1, "volume": at(diffuse, "volume_extracellular_nm3", time) / start - 1})
    return rows


#: Columns of the printed numerics' history.
PRINTED = (
    "membrane_area_nm2", "neck_radius_nm", "bud_diameter_nm", "bud_height_nm", "volume_extracellular_nm3", "bending_energy_pN_nm",
    "area_strain_max", "thickness_error_max", "net_vertical_force_pN",
)  # fmt: skip


def history(run, interval):
    """Rows of a run's history, no two nearer in time than an interval (µs)."""
    rows, last = [], -np.inf
    for index, time in enumerate(run.history["time_us"]):
        if time >= last + interval:
            rows.append({"time_us": f"{time:.4g}"} | {column: float(run.history[column][index]) for column in PRINTED})
            last = time
    return rows


def limits(rows):
    """Limits ε → 0 of the budding times v0 + a ε^p in rows with `epsilon_nm` and `late`, relative to the sharp one."""
    epsilon, late = (np.array([float(row[key]) for row in rows]) for key in ("epsilon_nm", "late"))

    def square(kept):
        return float(np.polyfit(epsilon[kept] ** 2, late[kept], 1)[1])

    free = curve_fit(lambda e, v, a, p: v + a * e**p, epsilon, late, p0=(0, 0.02, 2))[0]
    return [
        {"fit": "square-all", "limit": square(slice(None)), "order": 2},
        {"fit": "square-three", "limit": square(np.argsort(epsilon)[:3]), "order": 2},
        {"fit": "free", "limit": float(free[0]), "order": float(free[2])},
    ]


#: Quantities of the smooth case whose limits are told, with their times, µs.
SMOOTH = (
    ("budding_time", 1.0), ("neck_radius", 0.5), ("neck_radius", 1.0), ("bud_diameter", 1.0), ("membrane_area", 0.5),
    ("volume_extracellular", 0.25), ("volume_extracellular", 1.0), ("bending_energy", 0.5), ("bending_energy", 1.0),
)  # fmt: skip


def smooth_limits(rows):
    """Limits v0 + a ε^p through the three thinnest layers, relative to the sharp engine, and the order between the two thinnest."""
    found = []
    for quantity, time in SMOOTH:
        thin = sorted((row for row in rows if row["time_us"] == time), key=lambda row: row["epsilon_nm"])[:3]
        sharp_column = next(name for name in thin[0] if name.startswith(f"{quantity}_sharp"))
        unit, sharp = sharp_column.removeprefix(f"{quantity}_sharp_"), thin[0][sharp_column]
        epsilon = np.array([row["epsilon_nm"] for row in thin])
        values = np.array([row[f"{quantity}_{unit}"] for row in thin])
        fit, _ = extrapolated(epsilon, values)
        errors = np.abs(values - sharp)
        order = np.log(errors[1] / errors[0]) / np.log(epsilon[1] / epsilon[0])
        found.append(
            {"quantity": f"{quantity}_{unit}", "time_us": f"{time:g}", "sharp": sharp, "order": float(order)}
            | {"limit": fit.value / sharp - 1 if fit else None, "power": fit.order if fit else None}
        )
    return found


def local_orders(rows, name):
    """Orders of a column's absolute values between neighbouring ε of rows, from the largest on."""
    epsilon, errors = (np.abs([float(row[key]) for row in rows]) for key in ("epsilon_nm", name))
    return np.diff(np.log(errors)) / np.diff(np.log(epsilon))


def tube(run):
    """How far the force of a tube is from its plateau, relative to it, beyond 300 nm and at its largest length up to 620 nm."""
    membrane = run.parameters["membrane"]
    plateau = 2 * np.pi * np.sqrt(membrane["bending_stiffness"] * membrane["rim_tension"])  # of β = b/2, as printed
    length, off = run.history["bud_height_nm"], run.history["followed_value"] / plateau - 1
    beyond, last = length > 300, np.flatnonzero(length <= 620)[-1]
    return {"plateau_pN": float(plateau), "beyond_300": float(off[beyond][np.argmax(np.abs(off[beyond]))]), "at_620": float(off[last])}


def branch(run, columns):
    """The points of a branch of stationary shapes: columns {name: column of history.csv}."""
    points = len(run.history["followed_value"])
    return [{"point": f"{i}"} | {name: float(run.history[column][i]) for name, column in columns.items()} for i in range(points)]


def folds(run):
    """Where a branch of stationary shapes folds."""
    found = [fold["value"] for fold in run.record["notes"]["branch"]["folds"]]
    return {f"fold_{number}": value for number, value in enumerate(found, start=1)}


def noise(directory, times):
    """Rows of a noise's table at the computed times nearest to those asked for (µs)."""
    found = endoflow.load_modes(directory).noise
    rows = []
    for time in times:
        index = int(np.argmin(np.abs(found.times - time)))
        rows.append({"time_us": f"{time:g}"} | {name: float(values[index]) for name, values in found.table.items() if name != "time_us"})
    return rows


def ensemble(directory):
    """Rows of the nonlinear runs from random starts beside the linear noise that they inherit."""
    table = endoflow.load_modes(directory).noise.ensemble
    columns = [name for name in table if name not in ("time_us", "members")]
    return [{"time_us": f"{time:.4g}"} | {name: float(table[name][i]) for name in columns} for i, time in enumerate(table["time_us"])]


def noise_of_budding(directory):
    """Budding time and its spread, µs."""
    found = endoflow.load_modes(directory).noise
    return {"budding_us": found.budding, "spread_us": found.budding_spread, "spread": found.budding_spread / found.budding, "linear_until_us": found.linear_until}


def inherited_spread(rows, budding):
    """The spread of the budding time that fluctuations of the start alone would give, µs: rows of both tables of the noise."""
    found = budding[0]
    row = min(rows, key=lambda one: abs(one["time_us"] - found["budding_us"]))
    return [{"run": "standard", "spread_us": found["spread_us"] * row["neck_inherited_nm"] / row["neck_rms_nm"]}]


#: Columns of a noise's table: bud and neck.
ELLIPTICITIES = ("ellipticity_rms", "ellipticity_inherited", "neck_ellipticity_rms", "neck_ellipticity_inherited")


def ellipses(directory, radius):
    """Rows of a coat: displacements by the mode m = 2 and ellipticities at 310 K, from the start to the end."""
    found = endoflow.load_modes(directory).noise
    columns = {"rms_m2_nm": found.modes[2]["rms_nm"], "inherited_m2_nm": found.modes[2]["inherited_nm"]}
    columns |= {name: found.table[name] for name in ELLIPTICITIES}
    return [
        {"radius_nm": f"{radius}", "time_us": float(time)} | {name: float(values[i]) for name, values in columns.items()}
        for i, time in enumerate(found.times)
    ]


def section(directory, run):
    """What thermal noise has made of a coat by budding, or by the end: m = 2, and the radii of bud and neck (nm)."""
    noise, end = endoflow.load_modes(directory).noise, run.history["time_us"][-1]
    row = {"budding_us": run.event_time("budding"), "bud_nm": at(run, "bud_diameter_nm", end) / 2, "neck_nm": at(run, "neck_radius_nm", end)}
    return row | {name: float(noise.table[name][noise.last_index]) for name in ELLIPTICITIES}


def flow(run, time, spacing):
    """The fluids' velocity at a time (µs) on a square lattice of points (nm)."""
    fields = run.fields_at(time)
    lattice = np.meshgrid(*(np.arange(0, values.max() + 1, spacing) for values in (fields.r, fields.z)), indexing="ij")
    r, z = (axis.ravel() for axis in lattice)
    velocity = griddata(np.column_stack((fields.r, fields.z)), fields["velocity"][:, :2], (r, z))
    rows = np.column_stack((r, z, velocity))
    return [{"point": f"{i}"} | dict(zip(("r_nm", "z_nm", "u_r", "u_z"), map(float, row))) for i, row in enumerate(rows)]


def certificate(run):
    """The relative error of the budding time that a run's certificate measures."""
    budding = run.record["certificate"]["values"]["budding_time_us"]
    return {"budding_us": budding["value"], "error": budding["error"] / budding["value"]}


def extremes_of_radii(rows):
    """Coats whose budding is fastest, and whose neck is narrowest at 1 µs (nm), and the line through the diameters at the end."""

    def columns(name):
        return np.array([(row["radius_nm"], row[name]) for row in rows if row[name] is not None]).T

    slope, first, explained = line_fit(*columns("diameter_nm"))
    row = {"coats": "twelve", "fastest_nm": best(*columns("budding_us"))[0], "narrowest_nm": best(*columns("neck_1_nm"))[0]}
    return [row | {"slope": float(slope), "first_nm": float(first), "r_squared": float(explained)}]


def perturbations(directory, initials):
    """A row for each initial shape: the largest displacement at budding (nm), of 0.1 nm at the start; of `worst` the gain."""
    found = endoflow.load_modes(directory)
    end = found.last_index
    return [
        {"initial": initial}
        | {f"m{m}": float(found.perturbations[m, initial]["gain" if initial == "worst" else "peak_nm"][end]) for m in found.modes}
        for initial in initials
    ]


def perturbed(directory):
    """What perturbations of 0.1 nm of the coat's place become, the largest gain, and the largest rates before budding."""
    found = endoflow.load_modes(directory)
    end = found.last_index
    row = {"budding_us": found.budding} | {f"rate_m{m}": float(found.rates[m][1 : end + 1].max()) for m in (1, 2, 3)}
    coat = {m: found.perturbations[m, "coat"]["peak_nm"] for m in (2, 3)}
    row |= {"most_m2_nm": float(coat[2][1 : end + 1].max())} | {f"end_m{m}_nm": float(coat[m][end]) for m in (2, 3)}
    return row | {"gain_m2": float(found.perturbations[2, "worst"]["gain"][end])}


def rates(directory):
    """A row for each time: the largest growth rate of each mode, 1/µs."""
    found = endoflow.load_modes(directory)
    return [{"time_us": f"{time:.4g}"} | {f"m{m}": float(found.rates[m][i]) for m in found.modes} for i, time in enumerate(found.times)]
