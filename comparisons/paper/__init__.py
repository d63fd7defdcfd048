"""The paper, item by item: Lowengrub, Allard & Aland (2016). Each module below is one figure or table.

A module has TITLE; wanted(quick), the list of runs it needs (item.Wanted); and result(runs, quick), which makes an
item.Result from them, runs being {Wanted.name: {engine: endoflow.Run or item.NotRun}}.
"""

from . import derenyi2002, hassinger2017, juelicher1996
from . import attribution, inertia, mobility, timescale
from . import fig3, fig4, fig5, fig6, fig7, fig_a2, table2

#: Items in the paper's order, by the names the command line uses.
PRINTED = {"table2": table2, "fig3": fig3, "fig4": fig4, "fig5": fig5, "fig6": fig6, "fig7": fig7, "figA2": fig_a2}

#: Why ours differ from the print.
QUESTIONS = {"mobility": mobility, "attribution": attribution, "timescale": timescale, "inertia": inertia}

ITEMS = PRINTED | QUESTIONS

#: Items of other papers: branches of stationary shapes. Each module has SOURCE, too.
OTHERS = {"hassinger2017": hassinger2017, "derenyi2002": derenyi2002, "juelicher1996": juelicher1996}
