"""What the key of a study may hold: kinds of values, each with what is allowed in words, and how one is read."""

import json
import math
import re
import unicodedata
from dataclasses import dataclass

#: Longest value that a message shows.
SHOWN = 60

#: Units of lengths in nm and of times in µs. A pixel is as long as the study says.
LENGTHS = {"nm": 1.0, "Å": 0.1, "µm": 1e3, "pixel": None}
TIMES = {"ns": 1e-3, "µs": 1.0, "ms": 1e3, "s": 1e6}

#: Other spellings of units.
SPELLINGS = {"A": "Å", "angstrom": "Å", "Angstrom": "Å", "um": "µm", "px": "pixel", "pixels": "pixel", "us": "µs"}


class ValueRefused(ValueError):
    """A value that its key may not have; the message says what is allowed."""


def shown(value):
    """A value of TOML as a message shows it: true, "text", inf; long ones cut."""
    text = json.dumps(value, ensure_ascii=False) if isinstance(value, (bool, str)) else str(value)
    text = text.replace("\n", "\\n")
    return text if len(text) <= SHOWN else f"{text[:SHOWN]}…"


@dataclass(frozen=True)
class Number:
    """A finite number; above: less than it, least: not greater than it."""

    above: float | None = None
    least: float | None = None

    @property
    def words(self):
        """What is allowed."""
        if self.above is not None:
            return f"a finite number > {self.above:g}"
        return "a finite number" if self.least is None else f"a finite number ≥ {self.least:g}"

    def read(self, value):
        """The value as a float."""
        number = None if isinstance(value, bool) or not isinstance(value, (int, float)) else _float(value)
        if number is None or not math.isfinite(number):
            raise ValueRefused(f"must be {self.words}")
        if (self.above is not None and not number > self.above) or (self.least is not None and not number >= self.least):
            raise ValueRefused(f"must be {self.words}")
        return number


@dataclass(frozen=True)
class Whole:
    """A whole number from least to most."""

    least: int
    most: int

    @property
    def words(self):
        """What is allowed."""
        return f"a whole number, {self.least} … {self.most}"

    def read(self, value):
        """The value."""
        if isinstance(value, bool) or not isinstance(value, int) or not self.least <= value <= self.most:
            raise ValueRefused(f"must be {self.words}")
        return value


@dataclass(frozen=True)
class Flag:
    """true or false."""

    words = "true or false"

    def read(self, value):
        """The value."""
        if not isinstance(value, bool):
            raise ValueRefused(f"must be {self.words}")
        return value


@dataclass(frozen=True)
class Choice:
    """One of some texts; spellings: {other spelling: text} are accepted, too."""

    texts: tuple
    spellings: dict

    @property
    def words(self):
        """What is allowed."""
        return ", ".join(json.dumps(text, ensure_ascii=False) for text in self.texts)

    def read(self, value):
        """The text, in its first spelling."""
        found = self.spellings.get(value, value) if isinstance(value, str) else None
        if found not in self.texts:
            raise ValueRefused(f"must be one of {self.words}")
        return found


def choice(*texts, **spellings):
    """The Choice of some texts."""
    return Choice(texts, spellings)


@dataclass(frozen=True)
class Text:
    """A text that matches a pattern."""

    words: str
    pattern: str = r"[^\x00-\x1f\x7f]*\S[^\x00-\x1f\x7f]*"

    def read(self, value):
        """The text."""
        if not isinstance(value, str) or not re.fullmatch(self.pattern, value):
            raise ValueRefused(f"must be {self.words}")
        return value


@dataclass(frozen=True)
class Texts:
    """A list of different texts of one kind, at least one."""

    of: object
    words: str

    def read(self, value):
        """A tuple of the texts."""
        if not isinstance(value, list) or not value:
            raise ValueRefused(f"must be {self.words}")
        found = []
        for entry in value:
            try:
                found.append(self.of.read(entry))
            except ValueRefused as error:
                raise ValueRefused(f"must be {self.words}; {shown(entry)} {error}") from None
        twice = [text for text in found if found.count(text) > 1]
        if twice:
            raise ValueRefused(f"has {shown(twice[0])} twice")
        return tuple(found)


@dataclass(frozen=True)
class Heads:
    """Whose heads are whose: {name: the file's own head}, or a list of names for a file without heads."""

    words = '{ name = "the file\'s own head", … }, or a list of names for a file that has no line of heads'

    def read(self, value):
        """A dict, or a tuple of names, "" for a column that is no data."""
        if isinstance(value, dict) and value and all(isinstance(head, str) and head.strip() for head in value.values()):
            heads = [head.strip() for head in value.values()]
            twice = [head for head in heads if heads.count(head) > 1]
            if twice:
                raise ValueRefused(f"has {shown(twice[0])} twice")
            return dict(zip(value, heads))
        if isinstance(value, list) and value and all(isinstance(name, str) for name in value):
            return tuple(value)
        raise ValueRefused(f"must be {self.words}")


def _float(value):
    """A number as a float, infinite where it is too large for one."""
    try:
        return float(value)
    except OverflowError:
        return math.inf


def unit_of_text(text):
    """The unit that a text spells, in the letters of LENGTHS and TIMES; other text as it is."""
    plain = unicodedata.normalize("NFC", text).replace("μ", "µ")
    return SPELLINGS.get(plain, plain)


class Unit(Choice):
    """One of some units, however it is spelled."""

    def read(self, value):
        """The unit."""
        return super().read(unit_of_text(value) if isinstance(value, str) else value)
