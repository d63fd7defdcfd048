"""Fig. A.2: the constitutive laws, and what they do to the standard case."""

import csv

import numpy as np

from comparisons import BOUNDARY_INTEGRAL
from comparisons.drawing.plots import legend_on_top
from comparisons.drawing.style import plt
from comparisons.paper.figures import COLOURS, history_figure
from comparisons.paper.item import Printed, Result, Wanted, is_run, text, value_at
from comparisons.studies.members import answer

TITLE = "Fig. A.2: constitutive laws"

#: Titles and line styles of the laws by their name in membrane.constitutive_law; the dashes show lines that coincide.
LAWS = {
    "linear": ("linear (Table 1)", "-"),
    "coarse-grained": ("coarse-grained (A.7)", (0, (5, 2))),
    "lumped": ("lumped (A.8)", (0, (1, 1.5))),
}

#: End (µs) of the runs, which are an addition to the paper's figure, and the time their height is compared at.
END, EARLY = 3.0, 0.5


def wanted(quick):
    """The standard case with each law, in the sharp engine."""
    return [
        Wanted(law, BOUNDARY_INTEGRAL, "standard", {"membrane.constitutive_law": law} if law != "linear" else {}, END)
        for law in LAWS
    ]


def constitutive_laws():
    """{column: array} of `endoflow laws`: c, and for each law LAW_b_pN_nm and LAW_H0_per_nm. Raises StudyError."""
    header, *rows = csv.reader(answer("laws").splitlines())
    return dict(zip(header, np.array(rows, dtype=float).T))


def draw(laws):
    """b(c) and H₀(c)."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.4, 3.9), layout="constrained")
    for (law, (title, dashes)), colour in zip(LAWS.items(), COLOURS):
        look = {"color": colour, "linestyle": dashes, "linewidth": 2.4}
        left.plot(laws["c"], laws[f"{law}_b_pN_nm"] / 100, **look)
        right.plot(laws["c"], laws[f"{law}_H0_per_nm"], **look)
    left.set(xlabel="concentration c", ylabel="b (10⁻¹⁹ J)", xlim=(0, 1), ylim=(0, None))
    right.set(xlabel="concentration c", ylabel="H₀ (1/nm)", xlim=(0, 1), ylim=(0, None))
    left.set_title("Bending stiffness")
    right.set_title("Spontaneous curvature")
    handles = [plt.Line2D([], [], color=c, linestyle=d, linewidth=2.4) for (_, d), c in zip(LAWS.values(), COLOURS)]
    legend_on_top(figure, handles, [title for title, _ in LAWS.values()])
    return figure


def result(runs, quick):
    """See item.Result."""
    laws = constitutive_laws()
    rows = [{name: float(values[i]) for name, values in laws.items()} for i in range(len(laws["c"]))]
    middle = len(rows) // 2
    printed = []
    for law, (title, _) in LAWS.items():
        b, h = laws[f"{law}_b_pN_nm"], laws[f"{law}_H0_per_nm"]
        ours = f"{b[0]:.4g}, {b[middle]:.4g}, {b[-1]:.4g} pN nm; {h[middle]:.4g}, {h[-1]:.4g} /nm"
        printed.append(Printed(f"{title}: b at c = 0, ½, 1; H₀ at ½, 1", "in the plot only", {"": ours}))
        run = runs[law].get(BOUNDARY_INTEGRAL)
        if is_run(run):
            neck, time = value_at(run, "neck_radius_nm", END), run.event_time("budding")
            height = value_at(run, "bud_height_nm", EARLY)
            words = f"budding {text(time)} µs; height at {EARLY:g} µs {text(height)} nm; neck at {END:g} µs {text(neck, 3)} nm"
            printed.append(Printed(f"{title}: standard case", "not explored", {BOUNDARY_INTEGRAL: words}))
    remarks = [
        "b_c in (A.4)–(A.8) is what the molecules add to b_m, so that b(1) = b_m + b_c = 12 b_m; Table 1 gives 12 b_m to "
        "b_c itself. With this reading the linear and the lumped law have the same b.",
        "(A.7) and (A.8) reach H₀ b_c/(b_c + b_m) at full cover, 11/12 of H₀, because the bare bilayer under the coat resists.",
        "The runs are an addition: the paper leaves the effect of the laws to future work. The function P(c) of (A.6) is "
        "left out as there; it would matter where molecules diffuse.",
    ]
    names = {(law, BOUNDARY_INTEGRAL): title for law, (title, _) in LAWS.items()}
    figures = {
        "figA2": ("The laws", draw(laws)),
        "figA2_runs": ("The standard case with each law, boundary integral", history_figure(runs, names)),
    }
    return Result(rows, figures, printed, remarks)
