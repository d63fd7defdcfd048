"""Values of varied parameters: `section.key=start:stop:step` or `section.key=value,value,...`."""

import itertools
import math
from decimal import Decimal

from comparisons.errors import StudyError
from comparisons.files import as_number

#: Most values of one parameter, and most combinations of all: more is a slip of the keyboard.
MOST_VALUES = 10000


class RangeError(StudyError):
    """A range that cannot be read; the message says what is allowed."""


def parsed_variation(text):
    """(key, values) of "section.key=values": values is the list of texts, numbers in their shortest form."""
    key, equals, values = text.partition("=")
    if not equals or key.count(".") != 1 or not all(key.split(".")):
        raise RangeError(f"--vary {text}: it must read section.key=start:stop:step or section.key=value,value,...")
    return key, parsed_values(values, f"--vary {text}")


def parsed_values(text, where):
    """The list of value texts of "start:stop:step" (stop included) or "value,value,..."; `where` begins messages."""
    values = _range(text, where) if ":" in text else [shortest(part.strip()) for part in text.split(",")]
    if not all(values):
        raise RangeError(f"{where}: a value is empty")
    repeated = sorted({value for value in values if values.count(value) > 1})
    if repeated:
        raise RangeError(f"{where}: {repeated[0]} is given twice")
    return values


def shortest(text):
    """A number in its shortest form ("64e3" becomes "64000"); other text as it is."""
    number = as_number(text)
    return text if number is None else f"{number:.12g}"


def positive_numbers(text, option):
    """The numbers of a comma list or range, all positive."""
    numbers = [as_number(value) for value in parsed_values(text, f"{option} {text}")]
    if any(number is None or number <= 0 for number in numbers):
        raise RangeError(f"{option} {text}: positive numbers separated by commas are needed")
    return numbers


def two_intervals(texts):
    """[(key, low, high)] of two texts section.key=low:high with different keys."""
    found = []
    for text in texts:
        key, _, limits = text.partition("=")
        numbers = [as_number(part) for part in limits.split(":")]
        if key.count(".") < 1 or len(numbers) != 2 or None in numbers or not numbers[0] < numbers[1]:
            raise RangeError(f"--vary {text}: it must read section.key=low:high with low below high")
        found.append((key, *numbers))
    if len(found) != 2 or found[0][0] == found[1][0]:
        raise RangeError("a map needs --vary for two parameters")
    return found


def _range(text, where):
    """Texts of start, start + step, … up to and including stop, counted in decimals: 0.1:0.3:0.1 has three values."""
    parts = text.split(":")
    if len(parts) != 3 or any(as_number(part) is None for part in parts):
        raise RangeError(f"{where}: a range reads start:stop:step, three numbers")
    start, stop, step = map(Decimal, parts)
    if step == 0 or (stop > start) == (step < 0) and stop != start:
        raise RangeError(f"{where}: a step of {parts[2]} does not lead from {parts[0]} to {parts[1]}")
    if abs(stop - start) >= MOST_VALUES * abs(step):
        raise RangeError(f"{where}: more than {MOST_VALUES} values")
    count = int((stop - start) / step) + 1
    return [f"{float(start + i * step):.12g}" for i in range(count)]


def combinations(variations):
    """Every combination of [(key, values)] as a list of {key: value text}; the last key varies fastest."""
    keys = [key for key, _ in variations]
    if len(set(keys)) < len(keys):
        raise RangeError(f"--vary {next(key for key in keys if keys.count(key) > 1)}: a parameter can be varied once")
    count = math.prod(len(values) for _, values in variations)
    if count > MOST_VALUES:
        raise RangeError(f"--vary: {count} combinations; at most {MOST_VALUES} are allowed")
    return [dict(zip(keys, chosen)) for chosen in itertools.product(*(values for _, values in variations))]
