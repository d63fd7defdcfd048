"""How pages write a value: a format of Python's, with signs, spaces and powers of ten as in print."""

import math
import re

RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def as_number(text):
    """A cell as a number where it is one, else as it is; None if it is empty."""
    if text == "":
        return None
    try:
        return float(text)
    except ValueError:
        return text


def written(value, form=""):
    """A cell as pages show it. form: a format of Python's, behind "|" for the absolute value; a comma separates thousands."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return "–"
    if isinstance(value, str):
        return value
    value, form = (abs(value), form[1:]) if form.startswith("|") else (value, form)
    text = format(value, form or ".10g").replace(",", " ").replace("%", " %")
    text = re.sub(r"(.*)e([+-]?)0*(\d+)$", power, text)
    return text.replace("-", "−")


def power(match):
    """1.5e-07 as 1.5·10⁻⁷, 1e-07 as 10⁻⁷."""
    factor, sign, exponent = match.groups()
    raised = "10" + (sign.replace("+", "") + exponent).translate(RAISED)
    return raised if factor == "1" else f"{factor}·{raised}"
