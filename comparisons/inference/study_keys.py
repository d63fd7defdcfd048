"""Every key of a study: what it may hold, what holds without it, what it means. Checks and the documentation come from here."""

import difflib
import re
from dataclasses import dataclass

from comparisons import ENGINES
from comparisons.inference.study_values import (
    LENGTHS,
    TIMES,
    Choice,
    Flag,
    Heads,
    Number,
    Text,
    Texts,
    Unit,
    ValueRefused,
    Whole,
    choice,
    shown,
)
from comparisons.inference.text_file import ENCODINGS
from comparisons.measures.coat import COAT
from comparisons.measures.quantities import columns
from endoflow.history import name_and_unit

#: Columns of history.csv that may be data.
MEASURABLE = columns("data")

#: Separators of cells by the names that a study may give them.
SEPARATORS = {",": ",", ";": ";", "|": "|", "tab": "\t", "space": " "}

#: Keys of each kind of prior.
KINDS = {
    "uniform": ("low", "high"),
    "log-uniform": ("low", "high"),
    "normal": ("mean", "sd"),
    "log-normal": ("median", "factor"),
}

#: Largest seed: every generator of random numbers takes it, and those that follow it.
MOST_SEED = 2**31 - 1


def error_column(quantity):
    """Name of the column, or the key, with a quantity's error: neck_radius_nm has neck_radius_error_nm."""
    stem = name_and_unit(quantity)[0].replace(" ", "_")
    return f"{stem}_error{quantity.removeprefix(stem)}"


PARAMETER = Text('a parameter, "section.key"', r"[A-Za-z_][\w.]*\.\w+")


PARAMETERS = Texts(PARAMETER, 'a list of parameters, ["section.key", …]')


FILE = Text("the path of a CSV, relative to the study")


NAME = Text("plain text on one line without $", r"[^\x00-\x1f\x7f$]*[^\x00-\x20\x7f$][^\x00-\x1f\x7f$]*")


COLUMNS = Texts(choice(*MEASURABLE), f"a list of some of {', '.join(MEASURABLE)}")


POSITIVE = Number(above=0)


@dataclass(frozen=True)
class Key:
    """A key. kind: what it may hold; default: what holds without it, None for nothing; needed: it must be there."""

    name: str
    kind: object
    meaning: str
    default: object = None
    needed: bool = False


#: How a CSV is written.
LAYOUT = (
    Key("heads", Heads(), "which columns are which, where the file calls them otherwise"),
    Key("ignore", Texts(Text("a head", r"[^\x00-\x1f\x7f]*"), "a list of heads"), "heads of columns that are no data", ()),
    Key("separator", Choice(tuple(SEPARATORS), {"\t": "tab", " ": "space"}), "what stands between cells", ","),
    Key("decimal", choice(".", ","), "the decimal mark", "."),
    Key("encoding", choice(*ENCODINGS), "of a file without a byte-order mark", "utf-8"),
    Key("length_unit", Unit(tuple(LENGTHS), {}), "unit of the file's lengths, areas and volumes", "nm"),
    Key("pixel_nm", POSITIVE, "nm: size of a pixel"),
)


#: What is known of the times of pits that were each seen once.
MOMENTS = (
    Key(
        "moments",
        choice("any", "even"),
        "of the pits' times nothing is known, or they are even between `from_us` and the run's end, as of pits that were seen at random",
        "any",
    ),
    Key("from_us", Number(least=0), "µs of the run: no pit was seen before", 0.0),
)


EVERY, HALF_PLANES, Z_FROM = (
    Key("every", Whole(1, 10**6), "n: of the rows only every n-th one counts", 1),
    Key("half_planes", choice("right", "both"), "both: points with r < 0 are mirrored to the right", "right"),
    Key("z_from", choice("rim", "floor"), "where z is 0: at the level of the rim or on the floor of the box", "rim"),
)


TIME_UNIT = Key("time_unit", Unit(tuple(TIMES), {}), "unit of the file's times", "µs")


#: {part of the study: its keys}. A [[data]] has the keys of what it is.
TABLES = {
    "[study]": (
        Key("case", Text("name or path of a case"), "name or path of a case", "standard"),
        Key("engine", choice(*ENGINES), "what makes the runs", ENGINES[0]),
        Key("horizon", POSITIVE, "µs: how far runs go unless they bud; without it, `time.end`"),
        Key("seed", Whole(0, MOST_SEED), "of all random numbers", 1),
    ),
    "[[unknown]]": (
        Key("name", NAME, "how it is called; without it, `key`"),
        Key("key", PARAMETER, "the parameter whose value is unknown"),
        Key("scales", PARAMETERS, "parameters that an unknown factor multiplies", ()),
        Key("divides", PARAMETERS, "parameters that the same factor divides", ()),
        Key("time_offset", Flag(), "whether it is a shift of the data's time, in µs", False),
        Key("prior", choice(*KINDS), "kind of the prior", needed=True),
        Key("low", Number(), "lower limit"),
        Key("high", Number(), "upper limit"),
        Key("mean", Number(), "of a normal prior"),
        Key("sd", POSITIVE, "standard deviation of a normal prior"),
        Key("median", POSITIVE, "of a log-normal prior"),
        Key("factor", Number(above=1), "one standard deviation of a log-normal prior"),
    ),
    "[[data]] file": (
        Key("file", FILE, "a CSV of curves against time", needed=True),
        Key("error", POSITIVE, "nm, nm², nm³: of every number without an error of its own"),
        TIME_UNIT,
        *LAYOUT,
    ),
    "[[data]] run": (
        Key("run", Text("the path of a run's directory, relative to the study"), "directory of a run", needed=True),
        Key("columns", COLUMNS, "its curves", ("neck_radius_nm",)),
        Key("error", POSITIVE, "of each number, in the unit of its column", needed=True),
        Key("points", Whole(1, 10000), "numbers taken from each curve", 30),
        Key("from", Number(least=0), "µs: time of the first one; without it, where the curves begin"),
        Key("to", POSITIVE, "µs: time of the last one; without it, budding or the end"),
    ),
    "[[data]] event": (
        Key("event", choice("budding"), "what happened", needed=True),
        Key("time_us", Number(), "µs: when", needed=True),
        Key("error_us", POSITIVE, "µs: its error", needed=True),
    ),
    "[[data]] contour": (
        Key("contour", FILE, "a CSV of an outline's points", needed=True),
        Key("error_nm", POSITIVE, "nm: of each point", needed=True),
        Key("time_us", Number(), "µs: when it was taken, where that is known"),
        Key("low_us", Number(), "µs: earliest time where it is unknown", 0.0),
        Key("high_us", Number(), "µs: latest time where it is unknown"),
        EVERY,
        HALF_PLANES,
        Z_FROM,
        *LAYOUT,
    ),
    "[[data]] pits": (
        Key("pits", FILE, "a CSV of coats, a pit in each row, seen once", needed=True),
        *(
            Key(error_column(column), POSITIVE, f"{quantity.unit}: of every {quantity.title.lower()} without an error of its own")
            for column, quantity in COAT.items()
        ),
        *MOMENTS,
        EVERY,
        *LAYOUT,
    ),
    "[[data]] outlines": (
        Key("outlines", FILE, "a CSV of points on outlines of pits, each seen once", needed=True),
        Key("error_nm", POSITIVE, "nm: of each point", needed=True),
        *MOMENTS,
        EVERY,
        HALF_PLANES,
        Z_FROM,
        *LAYOUT,
    ),
}

#: What a [[data]] can be: the key that says so.
DATA_KINDS = tuple(name.split()[1] for name in TABLES if name.startswith("[[data]]"))


class KeyRefused(ValueError):
    """A key that cannot be there or whose value cannot be; the message begins with the key."""


def read_keys(part, content):
    """{name: value or default} of a table of the study (dict), whose keys are those of TABLES[part]. Raises KeyRefused."""
    known = {key.name: key for key in TABLES[part]}
    for name in content:
        if name not in known:
            raise KeyRefused(unknown(name, known, part))
    for key in known.values():
        if key.needed and key.name not in content:
            raise KeyRefused(f"needs {key.name}: {allowed(key)}")
    return {key.name: _value(key, content[key.name]) if key.name in content else key.default for key in known.values()}


def _value(key, value):
    try:
        return key.kind.read(value)
    except ValueRefused as error:
        raise KeyRefused(f"{key.name} = {shown(value)}: {error}") from None


def unknown(name, known, part=""):
    """What is said about a name that is none of `known`: the nearest one, or the part of the study where it belongs."""
    elsewhere = [other for other, keys in TABLES.items() if other != part and name in [key.name for key in keys]]
    near = difflib.get_close_matches(name, known, 1)
    hint = f"; it belongs to {elsewhere[0]}" if elsewhere else f"; did you mean {near[0]}?" if near else ""
    return f"unknown key {name!r}{hint}; known: {', '.join(known)}"


def allowed(key):
    """What a Key may hold, in words that say what for."""
    return f"{key.kind.words} ({key.meaning})" if key.meaning != key.kind.words else key.meaning


def documentation():
    """The tables of all keys as Markdown, as docs/inference.md has them."""
    lines = []
    own = {part: tuple(key for key in keys if key not in LAYOUT) for part, keys in TABLES.items()}
    for part, keys in {**own, "[[data]] file, contour, pits, outlines": LAYOUT}.items():
        lines += [f"**`{part}`**", "", "| key | may be | without it | meaning |", "| --- | --- | --- | --- |"]
        for key in keys:
            default = "needed" if key.needed else "–" if key.default in (None, ()) else f"`{_toml(key.default)}`"
            lines.append(f"| `{key.name}` | {_cell(key.kind.words)} | {default} | {_cell(key.meaning)} |")
        lines.append("")
    return "\n".join(lines).rstrip() + "\n"


def _toml(value):
    return "[" + ", ".join(map(_toml, value)) + "]" if isinstance(value, tuple) else shown(value)


def _cell(text):
    """Words as a cell of a table: what is in quotes or brackets as code."""
    return re.sub(r'(\{.*\}|\[[^\]]*\]|"[^"]*")', r"`\1`", text).replace("|", r"\|")
