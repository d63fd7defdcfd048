"""All studies, in the order in which they are made."""

from results.load_studies import growth, line_tension, loaded, phase_diagram, pit, stationary
from results.other_studies import paper, smooth, vesicles
from results.sharp_studies import accuracy, alarms, branches, fickian, flow, modes, noise, radii
from results.standard_studies import layers, relatives, standard

GROUPS = (
    standard, relatives, layers, accuracy, alarms, radii, fickian, flow, modes, noise, growth, line_tension, loaded, pit, phase_diagram, branches, stationary,
    vesicles, smooth, paper,
)  # fmt: skip

STUDIES = tuple(study for group in GROUPS for study in group())

#: {table: its columns}.
COLUMNS = {table.name: table.columns for study in STUDIES for table in study.tables}
