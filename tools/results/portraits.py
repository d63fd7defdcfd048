"""Figures of the flow around a bud, of what thermal noise makes of coats, and of a map of outcomes."""

import numpy as np
from scipy.integrate import cumulative_trapezoid

from results import ink, tables
from results.tables import columns


def flow():
    """Streamlines left of the axis, velocities right of it, and the membrane with its coat."""
    r, z, u_r, u_z = columns("flow", "r_nm", "z_nm", "u_r", "u_z")
    shape = (len(np.unique(r)), len(np.unique(z)))
    r, z, u_r, u_z = (values.reshape(shape) for values in (r, z, u_r, u_z))
    stream = cumulative_trapezoid(r * u_z, r, axis=0, initial=0)
    figure, axes = ink.panels(size=(5.4, 4.6))
    levels = np.linspace(stream.min(), stream.max(), 22)[1:-1]
    axes.contour(-r, z, stream, levels=levels, colors=[ink.FAINT[0]], linewidths=0.9, linestyles="solid")
    r, z, u_r, u_z = (values[1::2, 1::2] for values in (r, z, u_r, u_z))
    root = np.sqrt(np.hypot(u_r, u_z))  # lengths of arrows go with the root of the speed
    length = 10 / (root * root.max())
    look = {"angles": "xy", "scale_units": "xy", "scale": 1, "width": 0.005, "color": ink.SHARP[0]}
    axes.quiver(r, z, u_r * length, u_z * length, **look)
    membrane_r, membrane_z, c = columns("flow-membrane", "r_nm", "z_nm", "c")
    for side in (-1, 1):
        axes.plot(side * membrane_r, membrane_z, color=ink.INK[0], linewidth=1.8)
        axes.plot(side * membrane_r[c > 0.5], membrane_z[c > 0.5], color=ink.DIFFUSE[0], linewidth=3.5, solid_capstyle="butt")
    axes.axvline(0, color=ink.FAINT[0], linewidth=1, linestyle="-.")
    axes.set(xlim=(-81, 81), ylim=(-1, 161), xlabel="r (nm)", ylabel="z (nm)")
    axes.set_aspect("equal")
    axes.set_xticks((-80, -40, 0, 40, 80), ("80", "40", "0", "40", "80"))
    axes.grid(visible=False)
    return figure


#: How the coats of the figure of noise look, by their radii (nm).
COATS = {
    28: {"color": ink.FAINT[0], "marker": "^"}, 36: {"color": ink.SHARP[0], "marker": "o"},
    40: {"color": ink.THIRD[0], "marker": "D"}, 44: {"color": ink.DIFFUSE[0], "marker": "s"},
}  # fmt: skip

#: Coats whose buds are shown from above.
FROM_ABOVE = (36, 44)


def ellipses():
    """Ellipticity of buds and necks by thermal noise against time; buds at budding from above, one standard deviation."""
    figure, (*over_time, above) = ink.panels(1, 3, (8.4, 3.1), gridspec_kw={"width_ratios": (1.2, 1.2, 1)})
    for axes, name, title in zip(over_time, ("ellipticity", "neck_ellipticity"), ("ellipticity of the bud (%)", "of the neck (%)")):
        for coat, look in COATS.items():
            time, total, inherited = columns("noise-of-radii", "time_us", f"{name}_rms", f"{name}_inherited", radius_nm=coat)
            axes.plot(time, 100 * total, markersize=3, label=f"{coat} nm", **look)
            axes.plot(time, 100 * inherited, linestyle="--", linewidth=1, color=look["color"])
        axes.set(title=title, xlabel="time (µs)")
    over_time[1].legend()
    around = np.linspace(0, 2 * np.pi, 181)
    for coat in FROM_ABOVE:
        (size,), (ellipticity,) = columns("noise-sections", "bud_nm", "ellipticity_rms", radius_nm=coat)
        out_of_round = size * (1 + ellipticity * np.cos(2 * around))
        for radius, look in ((out_of_round, {"linewidth": 2}), (size, {"linewidth": 1, "linestyle": ":"})):
            above.plot(radius * np.cos(around), radius * np.sin(around), color=COATS[coat]["color"], **look)
    above.set(title="buds from above (nm)", aspect="equal")
    return figure


#: How outcomes look: marker and colour.
OUTCOMES = {
    "flat": ("o", ink.GRID), "dome": ("o", ink.FAINT), "neck": ("D", ink.THIRD), "bud": ("^", ink.SHARP), "closed": ("s", ink.DIFFUSE),
    "failed": ("x", ink.INK),
}  # fmt: skip


def outcomes():
    """Outcomes of runs over coat and tension, the boundaries between them, and folds of stationary shapes."""
    figure, axes = ink.panels(size=(7.2, 3.8))
    rows = tables.read("phase-diagram").rows
    for outcome, (marker, colour) in OUTCOMES.items():
        own = [(row["radius_nm"], row["tension_pN_per_nm"]) for row in rows if row["outcome"] == outcome]
        if own:
            axes.plot(*zip(*own), linestyle="", marker=marker, markersize=4.5, color=colour[0], label=outcome)
    axes.plot(*columns("phase-diagram-boundaries", "radius_nm", "tension_pN_per_nm"), linestyle="", marker=".", markersize=2.5, color=ink.INK[0], label="boundary")
    tension, *places = columns("phase-diagram-folds", "tension_pN_per_nm", "fold_1", "fold_2", "closes")
    for radius, label in zip(places, ("fold at rest", None, "neck closes at rest")):
        marker = "P" if label and "neck" in label else "*"
        axes.plot(radius, tension, linestyle="", marker=marker, markersize=9, color=ink.INK[0], markerfacecolor="none", label=label)
    axes.set_xlabel("coat's radius (nm)")
    axes.set_ylabel("tension (pN/nm)")
    axes.legend(loc="center left", bbox_to_anchor=(1, 0.5))
    return figure


#: {name of the file: (title, what draws it, the tables it shows)}.
PORTRAITS = {
    "flow": ("Streamlines and velocities around a bud of the standard case", flow, ("flow", "flow-membrane")),
    "noise-ellipses": ("Ellipticity of buds and necks by thermal noise, coats of four radii", ellipses, ("noise-of-radii", "noise-sections")),
    "phase-diagram": (
        "Outcomes over the coat's radius and tension", outcomes,
        ("phase-diagram", "phase-diagram-boundaries", "phase-diagram-folds"),
    ),
}  # fmt: skip
