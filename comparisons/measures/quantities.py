"""Every quantity of a run that is compared, fitted, drawn or tabulated: one row each, from which all lists of them come."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Quantity:
    """A number of a run.

    column: where it stands in history.csv, sweep.csv and metrics.json, in `unit`; title: what it is called; meaning: what it is;
    roles: where it takes part, see columns(); plotted: unit of plots and what they multiply the numbers with; logarithmic: whether
    its axis may span decades.
    """

    column: str
    title: str
    unit: str
    meaning: str
    roles: str
    plotted: tuple | None = None
    logarithmic: bool = False

    @property
    def name(self):
        """Title and unit of the numbers in files."""
        return f"{self.title} ({self.unit})"

    @property
    def plot_unit(self):
        """Of plots."""
        return self.plotted[0] if self.plotted else self.unit

    @property
    def factor(self):
        """What plots multiply the numbers in files with."""
        return self.plotted[1] if self.plotted else 1

    @property
    def label(self):
        """Title and unit of plots, of an axis."""
        return f"{self.title} ({self.plot_unit})"


#: Times of events, distances between two runs, columns of history.csv, then what measures/coat.py reads off a shape.
QUANTITIES = (
    Quantity("budding_time_us", "Budding time", "µs", "when the neck radius falls below 5 nm", "certified swept"),
    Quantity("mean_distance_nm", "Mean distance", "nm", "symmetric, between curves, averaged over arc length", "distance"),
    Quantity("hausdorff_distance_nm", "Hausdorff distance", "nm", "symmetric, between curves", "distance"),
    Quantity(
        "neck_radius_nm",
        "Neck radius",
        "nm",
        "smallest distance from the axis below the bud",
        "compared converging certified swept drawn data of_neck",
    ),
    Quantity(
        "bud_diameter_nm",
        "Bud diameter",
        "nm",
        "twice the largest radius above the neck",
        "compared converging swept drawn data of_neck",
    ),
    Quantity(
        "bud_height_nm",
        "Bud height",
        "nm",
        "over the rim's level, of the point farthest from it",
        "compared swept drawn data signed",
    ),
    Quantity(
        "membrane_area_nm2",
        "Membrane area",
        "nm²",
        "of the surface of revolution",
        "compared converging certified swept drawn data",
        plotted=("10³ nm²", 1e-3),
    ),
    Quantity(
        "volume_extracellular_nm3",
        "Volume gained",
        "nm³",
        "by the extracellular fluid",
        "compared converging drawn data",
        plotted=("10³ nm³", 1e-3),
    ),
    Quantity(
        "bending_energy_pN_nm",
        "Bending energy",
        "pN nm",
        "of the membrane",
        "compared converging swept drawn",
        logarithmic=True,
    ),
    Quantity(
        "area_strain_max",
        "Largest area strain",
        "1",
        "of the membrane, which should not stretch",
        "drawn",
        plotted=("%", 100),
        logarithmic=True,
    ),
    Quantity("closing_angle_deg", "Closing angle", "°", "of the membrane to the horizontal at the coat's edge, c = ½", "of_coat signed"),
    Quantity("coat_area_nm2", "Coat's area", "nm²", "∫ c dA", "of_coat", plotted=("10³ nm²", 1e-3)),
    Quantity("coat_curvature_per_nm", "Coat's mean curvature", "1/nm", "½ ∫ κ c dA/∫ c dA", "of_coat signed"),
)


def columns(role):
    """{column: Quantity} of a role: "compared" (by two runs' difference at equal times), "distance" (between two runs),
    "converging" (studied for ε → 0), "certified" (given with an error), "swept" (in sweep.csv), "drawn" (against time), "data" (may be measured),
    "of_neck" (exists only where there is a neck), "of_coat" (of a shape's coat), "signed" (may be negative)."""
    return {quantity.column: quantity for quantity in QUANTITIES if role in quantity.roles.split()}


#: Those that many lists need.
BUDDING = "budding_time_us"
COMPARED, DISTANCES, DRAWN, SWEPT = (columns(role) for role in ("compared", "distance", "drawn", "swept"))

#: {column: title and unit} of all.
NAMES = {quantity.column: quantity.name for quantity in QUANTITIES}
