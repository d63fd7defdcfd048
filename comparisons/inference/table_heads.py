"""Which column of a CSV is what: its line of heads, read by the study's keys, or what these would have to be."""

import json
import re
import unicodedata

from comparisons.inference.study_keys import LENGTHS, SEPARATORS, TIMES, unit_of_text, unknown
from endoflow.history import name_and_unit

#: A head with a unit in parentheses or brackets, and a head that is a number.
WITH_UNIT = re.compile(r"(.*\S)\s*[(\[]\s*([^()\[\]]*?)\s*[)\]]")
NUMBER = re.compile(r"[+-]?\d[\d.,]*(e[+-]?\d+)?", re.ASCII | re.IGNORECASE)

#: Most heads that a message lists.
MOST_LISTED = 12

#: Longest head that a message shows whole.
LONGEST = 60

#: Columns that tell what a table is.
FIRST_COLUMNS = {"contour": ("r_nm", "z_nm"), "file": ("time_us",)}


class HeadsRefused(ValueError):
    """Heads that say not what the columns are; the message says what they are and which key would help."""


def columns_of(rows, needed, allowed, layout):
    """(name of each column, "" for one that is no data; index of the first row of numbers) of rows [(line, cells)].

    needed, allowed: names of columns; layout: a csv_table.Layout. Raises HeadsRefused.
    """
    cells = rows[0][1]
    _require_separator(rows, allowed, layout)
    if isinstance(layout.heads, tuple):
        names, start = _given(cells, allowed, layout), 0
    else:
        while cells and not cells[-1]:
            cells.pop()
        names, start = _named(cells, needed, allowed, layout), 1
    present = [name for name in names if name]
    twice = [name for name in present if present.count(name) > 1]
    if twice:
        raise HeadsRefused(f"the column {twice[0]} is there twice; leave one out")
    missing = [name for name in needed if name not in names]
    if missing:
        raise HeadsRefused(f"lacks the column {missing[0]}; known: {', '.join(allowed)}; its heads are {_listed(cells)}")
    return names, start


def _given(cells, allowed, layout):
    """Names of the columns of a file without heads, as the study lists them."""
    for name in layout.heads:
        if name and name not in allowed:
            raise HeadsRefused(f'heads: {unknown(name, allowed)}; "" for a column that is no data')
    if len(layout.heads) != len(cells):
        raise HeadsRefused(f"has {len(cells)} columns where heads lists {len(layout.heads)}")
    return list(layout.heads)


def _named(cells, needed, allowed, layout):
    """Names of the columns by their heads."""
    own = layout.heads or {}
    for name, head in own.items():
        if name not in allowed:
            raise HeadsRefused(f"heads: {unknown(name, allowed)}")
        if head not in cells:
            raise HeadsRefused(f"heads: {name} = {_quoted(head)} is none of its heads {_listed(cells)}")
    for head in layout.ignore:
        if head not in cells:
            raise HeadsRefused(f"ignore: {_quoted(head)} is none of its heads {_listed(cells)}")
    if all(NUMBER.fullmatch(cell) for cell in cells):
        names = json.dumps(list(needed))
        remedy = f"say heads = {names}, the columns in their order, in {layout.where}"
        raise HeadsRefused(f"has numbers where the heads belong; {remedy}")
    by_head = {head: name for name, head in own.items()}
    names = []
    for cell in cells:
        name = "" if cell in layout.ignore else by_head.get(cell, cell)
        if name and name not in allowed or not name and cell not in layout.ignore:
            raise HeadsRefused(_complaint(cell, cells, allowed, layout))
        if name:
            _require_unit(name, cell, layout)
        names.append(name)
    return names


def _require_separator(rows, allowed, layout):
    """Refuses a table of one column that another separator would cut into columns with heads that say something."""
    cells, numbers = rows[0][1], rows[1][1] if len(rows) > 1 else []
    if len(cells) > 1:
        return
    for name, separator in SEPARATORS.items():
        parts = [part.strip() for part in cells[0].split(separator)]
        if name == layout.separator or len(parts) < 2 or not any(guess(part, allowed)[0] for part in parts):
            continue
        keys = [f'separator = "{name}"']
        if name != "," and layout.decimal == "." and (len(numbers) > 1 or any("," in cell for cell in numbers)):
            keys.append('decimal = ","')
        raise HeadsRefused(f"its heads are one cell, {_listed(cells)}; say {' and '.join(keys)} in {layout.where}")


def _require_unit(name, head, layout):
    """Refuses a head whose unit in parentheses is not that of its numbers."""
    stated, found = layout.stated_unit(name), WITH_UNIT.fullmatch(head)
    unit = unit_of_text(found[2]) if found else stated
    if stated is not None and unit != stated and unit in (*LENGTHS, *TIMES):
        key = "time_unit" if unit in TIMES else "length_unit"
        raise HeadsRefused(f'{_quoted(head)} is in {unit}, and {name} is taken for {stated}; say {key} = "{unit}"')


def _complaint(head, cells, allowed, layout):
    """What is said about a head that is not known: which keys would read the file."""
    guesses, units = {}, {}
    for cell in cells:
        name, unit = guess(cell, allowed)
        if name and name != cell and name not in guesses:
            guesses[name] = cell
            if unit and unit != layout.stated_unit(name):
                units["time_unit" if unit in TIMES else "length_unit"] = unit
    text = f"unknown head {_quoted(head)}; its heads are {_listed(cells)}; known: {', '.join(allowed)}"
    if guesses:
        pairs = ", ".join(f"{name} = {_quoted(cell)}" for name, cell in guesses.items())
        keys = [f"heads = {{ {pairs} }}", *(f'{key} = "{unit}"' for key, unit in units.items())]
        return f"{text}; say {' and '.join(keys)} in {layout.where}"
    others = [kind for kind, columns in FIRST_COLUMNS.items() if columns[0] not in allowed and set(columns) <= set(cells)]
    if others:
        return f"{text}; a table with {' and '.join(FIRST_COLUMNS[others[0]])} is given as {others[0]} = …"
    if not set(cells) & set(allowed):
        pairs = ", ".join(f'{name} = "…"' for name in allowed[:2])
        return f"{text}; say heads = {{ {pairs} }} with its own heads; lines before these must begin with #"
    free = [f"heads = {{ {name} = {_quoted(head)} }} if it is that, or " for name in allowed if name not in cells]
    return f"{text}; say {(free or [''])[0]}ignore = [{_quoted(head)}] in {layout.where}"


def guess(head, allowed):
    """(name, unit) that a head may stand for, None for what it does not tell: "r (nm)", "Time [ns]", "neck radius"."""
    found = WITH_UNIT.fullmatch(head)
    base, unit = (found[1], unit_of_text(found[2])) if found else (head, None)
    words = re.sub(r"\W+", "_", unicodedata.normalize("NFKC", base).lower()).strip("_")
    if words not in allowed:
        stem, _, last = words.rpartition("_")
        if unit is None and unit_of_text(last) in (*LENGTHS, *TIMES):
            words, unit = stem, unit_of_text(last)
        stems = {name_and_unit(name)[0].replace(" ", "_"): name for name in allowed}
        words = stems.get(words)
    return words, unit if unit in (*LENGTHS, *TIMES) else None


def _listed(cells):
    """Heads in quotes."""
    return ", ".join(map(_quoted, cells[:MOST_LISTED])) + (" …" if len(cells) > MOST_LISTED else "")


def _quoted(head):
    """A head in quotes, a long one cut."""
    return json.dumps(head if len(head) <= LONGEST else f"{head[:LONGEST]}…", ensure_ascii=False)
