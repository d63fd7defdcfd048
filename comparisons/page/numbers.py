"""How numbers and entries of records are written on a page."""

import html
import re

from comparisons.measures.powers import with_powers


def escaped(text):
    """Text safe inside HTML and attributes."""
    return html.escape(str(text), quote=True)


def code(name):
    """The name of a parameter, an entry or a column, which narrow columns break at its dots and underscores alone."""
    return "<code>" + re.sub(r"([._])(?=.)", r"\1<wbr>", escaped(name)) + "</code>"


def setting(value, digits=9):
    """A parameter or record entry as a case file would have it: numbers with at most that many digits, a dash for None."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return str(value).lower()
    if not isinstance(value, (int, float)):
        return escaped(value)
    return f"{value:.{digits}g}"


def figures(value, digits=4):
    """A measured number with exactly that many significant digits, a dash for None."""
    if value is None:
        return "–"
    if value == 0:
        return "0"
    text = grouped(value) if abs(value) >= 10**digits else f"{value:#.{digits}g}".rstrip(".")
    return with_powers(text).replace("-", "−")


def grouped(value):
    """A whole number, from five digits on in groups of three."""
    return f"{value:.0f}" if abs(value) < 1e4 else f"{value:,.0f}".replace(",", "\u2009")


def count_or_figures(value, digits=4):
    """A number without unit: as it is where it counts something, else with that many significant digits."""
    return grouped(value) if float(value).is_integer() else figures(value, digits)


def prose(text):
    """A sentence with `names` in it, as HTML."""
    return re.sub("`([^`]+)`", lambda found: code(html.unescape(found[1])), escaped(text))


def percent(value):
    """A relative difference in per cent, with its sign."""
    if value is None:
        return "–"
    if abs(value) < 1e-5:
        return "0 %" if value == 0 else "< 0.001 %"
    return f"{with_powers(f'{100 * value:+#.3g}'.rstrip('.'))} %".replace("-", "−")


def quantity(value, digits, unit):
    """A measured number with its unit; "none" when it does not exist."""
    return "none" if value is None else f'{figures(value, digits)} <span class="unit">{unit}</span>'


def flattened(tree, prefix=""):
    """{"a.b": value} of nested dicts; of a list of dicts "a.0.b", any other list becomes text."""
    flat = {}
    for key, value in tree.items():
        if isinstance(value, list) and value and all(isinstance(one, dict) for one in value):
            value = {str(i): one for i, one in enumerate(value)}
        if isinstance(value, dict):
            flat.update(flattened(value, f"{prefix}{key}."))
        else:
            flat[prefix + key] = ", ".join(map(str, value)) if isinstance(value, list) else value
    return flat
