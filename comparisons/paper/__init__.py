"""The paper, item by item: Lowengrub, Allard & Aland (2016). Each item, a figure or table, is a module of its name.

It has TITLE; wanted(quick), the list of runs it needs (item.Wanted); and result(runs, quick), which makes an item.Result from
them, runs being {Wanted.name: {engine: endoflow.Run or item.NotRun}}. Items of other papers also have SOURCE.
"""

import importlib

#: In the paper's order, by the names the command line uses.
PRINTED = ("table2", "fig3", "fig4", "fig5", "fig6", "fig7", "figA2")

#: Why ours differ from the print.
QUESTIONS = ("mobility", "attribution", "timescale", "inertia")

#: What `endoflow reproduce all` makes.
NAMES = PRINTED + QUESTIONS

#: Items of other papers and questions, which `all` leaves out: branches of stationary shapes, and mund2023, runs.
OTHER_NAMES = ("hassinger2017", "derenyi2002", "juelicher1996", "akamatsu2020", "collar", "mund2023")


def item_module(item):
    """The module of an item, by the command line's name."""
    return importlib.import_module(f"comparisons.paper.{item}")
