"""Numbers in pages: what stands between markers is what the tables say.

    buds at <!-- value standard-sharp/to-20/budding_us .6f -->0.825919<!-- end --> µs     TABLE/ROW/COLUMN and how it is written

    <!-- table standard-diffuse -->            the whole table, with the titles that its study gives

    <!-- end of table -->

    <!-- origin standard-diffuse -->…<!-- end -->      what made the table
"""

import re

from results import tables
from results.writing import written
from results.places import all_pages

VALUE = re.compile(r"<!-- value (?P<table>[\w-]+)/(?P<row>[^\s/]+)/(?P<column>\w\S*?)(?: (?P<form>\S+))? -->(?P<text>.*?)<!-- end -->")
TABLE = re.compile(r"<!-- table (?P<table>[\w-]+) -->\n(?P<text>.*?)<!-- end of table -->", re.S)
ORIGIN = re.compile(r"<!-- origin (?P<table>[\w-]+) -->(?P<text>.*?)<!-- end -->")

#: A block of code, in which markers are only shown.
BLOCK = re.compile(r"(^```.*?^```$)", re.S | re.M)


class UnknownValue(Exception):
    """A marker names what no table has."""


def stored(name):
    """The table of a name. Raises UnknownValue."""
    found = tables.read(name)
    if found is None:
        raise UnknownValue(f"{name}: no such table in docs/results/data")
    return found


def value_text(marker):
    """What stands in the place of a value."""
    place = "/".join(marker.group("table", "row", "column"))
    try:
        value = stored(marker["table"]).row(marker["row"])[marker["column"]]
    except KeyError as missing:
        raise UnknownValue(f"{place}: the table has no {missing}") from None
    return written(value, marker["form"] or "")


def table_text(marker, columns):
    """What stands in the place of a table. columns: {table: its columns}."""
    return tables.markdown(columns[marker["table"]], stored(marker["table"]).rows)


def origin_text(marker):
    """One sentence on what made a table."""
    found = stored(marker["table"])
    if found.recorded:
        return f"Recorded at commit {found.recorded}, not made anew since."
    return f"Numerics revision {found.revision}, commit {found.about[tables.COMMIT]}."


def filled(text, columns):
    """A page's text with all that stands between markers as the tables have it."""

    def put(marker, inside):
        start, end = marker.span("text")
        return marker[0][: start - marker.start()] + inside + marker[0][end - marker.start() :]

    def fill(part):
        part = VALUE.sub(lambda marker: put(marker, value_text(marker)), part)
        part = ORIGIN.sub(lambda marker: put(marker, origin_text(marker)), part)
        return TABLE.sub(lambda marker: put(marker, f"\n{table_text(marker, columns)}\n\n"), part)

    return "".join(part if part.startswith("```") else fill(part) for part in BLOCK.split(text))


def fill_all(columns):
    """Fill all pages; returns those that changed."""
    changed = []
    for page in all_pages():
        before = page.read_text("utf-8")
        after = filled(before, columns)
        if after != before:
            page.write_text(after, "utf-8")
            changed.append(page)
    return changed


def typed_by_hand():
    """[(page, number)]: numbers of four digits and more that stand between markers somewhere, and elsewhere without.

    Blocks of code, fenced or indented, show what programs print.
    """
    marked, bare = set(), []
    for page in all_pages():
        text = BLOCK.sub("", page.read_text("utf-8"))
        markers = [*VALUE.finditer(text), *TABLE.finditer(text)]
        marked |= {number for marker in markers for number in long_numbers(marker["text"])}
        text = TABLE.sub("", ORIGIN.sub("", VALUE.sub("", re.sub(r"^ {4}.*$", "", text, flags=re.M))))
        bare += [(page, number) for number in long_numbers(text)]
    return [(page, number) for page, number in bare if number in marked]


def long_numbers(text):
    """The decimal numbers of four digits or more in a text, leading zeros apart, and those whose thousands are set off."""
    found = re.findall(r"(?<![\d.])\d+\.\d+(?![\d.])|(?<![\d.] )(?<![\d.])\d{1,3}(?: \d{3})+(?![\d.])", text)
    return [number for number in found if len(re.sub(r"[. ]", "", number).lstrip("0")) >= 4]
