"""STUDY.toml of `endoflow infer`: the case, the unknowns with their priors, the data with their errors."""

import math
import tomllib
from collections import Counter
from dataclasses import dataclass

from comparisons.errors import BAD_INPUT, IO_FAILURE, StudyError
from comparisons.inference.observations import contour, event, history_data, outlines, pits, run_data
from comparisons.inference.priors import KINDS, PriorError, prior_of
from comparisons.inference.study_keys import DATA_KINDS, TABLES, read_keys, unknown
from comparisons.inference.study_values import shown
from comparisons.inference.text_file import FileError, read_text

#: Keys of a study as a whole: how often each may be there is in its brackets.
PARTS = {"study": "[study]", "set": "[set]", "unknown": "[[unknown]]", "data": "[[data]]"}

#: Keys of an unknown that say what it is; it has one of them.
WHAT = ("key", "scales", "time_offset")

#: What reads the data that are numbers with times of their own.
READERS = {"file": history_data, "run": run_data, "event": event}

#: Most unknowns that need runs: an emulator of third degree has 84 coefficients then.
MOST_UNKNOWNS = 6

#: Both viscosities times f, and these over f: the same motion, f times slower.
VISCOSITIES = frozenset(("fluid.viscosity_extracellular", "fluid.viscosity_intracellular"))
TRANSPORT_RATES = {
    "cahn-hilliard": frozenset(("molecules.mobility",)),
    "fickian": frozenset(("molecules.diffusivity",)),
    "advection": frozenset(),
}


@dataclass(frozen=True)
class Unknown:
    """One unknown. It is the value of `key`, or a factor on `scales` and one over `divides` (keys), or a shift of time (µs)."""

    name: str
    prior: object
    key: str = ""
    scales: tuple = ()
    divides: tuple = ()
    time_offset: bool = False

    @property
    def unit(self):
        """µs for a shift of time; a factor has none, and a parameter's is known to the program."""
        return "µs" if self.time_offset else ""


@dataclass(frozen=True)
class StudyFile:
    """A study as its file says. path: of it; case: path or name; settings: {key: value}; data: of observations.Datum, without
    those of contours and pits; horizon: µs or None."""

    path: str
    case: str
    engine: str
    settings: dict
    unknowns: tuple
    data: tuple
    contours: tuple
    pits: tuple
    seed: int
    horizon: float | None


def read_study(path):
    """The StudyFile of a path. Raises StudyError that names file and key: exit code 4 for a file that cannot be read, else 2."""
    try:
        text = read_text(path, "give the path of a study in TOML")
    except FileError as error:
        raise StudyError(error, IO_FAILURE) from None
    try:
        content = tomllib.loads(text)
    except RecursionError:
        raise StudyError(f"{path}: lists in lists, too many of them", BAD_INPUT) from None
    except ValueError as error:
        raise StudyError(f"{path}: {str(error).splitlines()[0]}", BAD_INPUT) from None
    return _Reader(path).study(content)


class _Reader:
    """Turns the file's tables into objects; every complaint begins with the file's name."""

    def __init__(self, path):
        self.path = path

    def fail(self, where, what):
        raise StudyError(f"{self.path}: {where}: {what}", BAD_INPUT)

    def keys(self, part, content, where):
        """The keys of a table by TABLES[part]."""
        try:
            return read_keys(part, content)
        except ValueError as error:
            self.fail(where, error)

    def study(self, content):
        for name, value in content.items():
            if name not in PARTS:
                self.fail("the study", unknown(name, PARTS))
            listed = PARTS[name].startswith("[[")
            if not isinstance(value, list if listed else dict) or listed and not all(isinstance(v, dict) for v in value):
                self.fail(name, f"must be written {PARTS[name]}, with {'two brackets each time' if listed else 'one bracket'}")
        head = self.keys("[study]", content.get("study", {}), "[study]")
        settings = self.settings(content.get("set", {}), head["horizon"])
        unknowns = [self.unknown(entry, f"[[unknown]] {i + 1}") for i, entry in enumerate(content.get("unknown", []))]
        if not unknowns:
            self.fail("the study", "needs at least one [[unknown]]")
        data, contours, pits_seen = self.data(content.get("data", []))
        for outline in contours:
            if outline.is_dated_by_unknown:
                prior = prior_of("uniform", {"low": outline.low, "high": outline.high})
                unknowns.append(Unknown(outline.time_name, prior))
        self.require_apart(unknowns, settings)
        case = head["case"]
        if (self.path.parent / case).is_file():
            case = str(self.path.parent / case)
        return StudyFile(
            str(self.path),
            case,
            head["engine"],
            settings,
            tuple(unknowns),
            tuple(data),
            tuple(contours),
            tuple(pits_seen),
            head["seed"],
            head["horizon"],
        )

    def settings(self, found, horizon):
        """[set]: lines "section.key" = value."""
        for key, value in found.items():
            if isinstance(value, dict) or "." not in key:
                self.fail("[set]", f'{key}: holds lines "section.key" = value, the keys in quotes')
            if not isinstance(value, (bool, int, float, str)) or isinstance(value, float) and not math.isfinite(value):
                self.fail("[set]", f"{key} = {shown(value)}: must be a finite number, a text, true or false")
        if horizon is not None and "time.end" in found:
            self.fail("[set]", "time.end: horizon gives it a value, too; leave one out")
        return found

    def unknown(self, entry, where):
        """One [[unknown]]."""
        keys = self.keys("[[unknown]]", entry, where)
        if sum(bool(keys[kind]) for kind in WHAT) != 1:
            self.fail(where, "needs one of key (a parameter), scales (parameters that it multiplies), time_offset = true")
        if keys["divides"] and not keys["scales"]:
            self.fail(where, "divides: needs scales, what the same factor multiplies")
        both = set(keys["scales"]) & set(keys["divides"])
        if both:
            self.fail(where, f"divides: {min(both)} stands under scales, too")
        name = keys["name"] or keys["key"] or ("time_offset" if keys["time_offset"] else "")
        if not name:
            self.fail(where, "a factor needs a name")
        numbers = {k: keys[k] for k in ("low", "high", *(k for own in KINDS.values() for k in own)) if keys[k] is not None}
        try:
            prior = prior_of(keys["prior"], numbers)
        except PriorError as error:
            self.fail(f"{where} ({name})", error)
        if keys["scales"] and not prior.logarithmic and prior.value(prior.lowest) <= 0:
            self.fail(f"{where} ({name})", "a factor is positive; take log-uniform, or low > 0")
        return Unknown(name, prior, keys["key"] or "", keys["scales"], keys["divides"], keys["time_offset"])

    def require_apart(self, unknowns, settings):
        """Each unknown has a name of its own, and nothing else gives it a value."""
        for what, found in (
            ("name", [unknown.name for unknown in unknowns]),
            ("key", [unknown.key for unknown in unknowns if unknown.key]),
            ("time_offset", ["true" for unknown in unknowns if unknown.time_offset]),
            ("scales", [" and ".join(sorted(unknown.scales)) for unknown in unknowns if unknown.scales]),
        ):
            twice = [one for one, count in Counter(found).items() if count > 1]
            if twice:
                self.fail("[[unknown]]", f"{what} = {twice[0]} is there twice")
        for unknown in unknowns:
            if unknown.key in settings:
                self.fail("[set]", f"{unknown.key}: is an unknown, too; leave one out")
            if unknown.key == "time.end":
                self.fail("[[unknown]]", "key = time.end: how far runs go is no unknown; it is horizon in [study]")

    def data(self, entries):
        """(Data, Contours, Pits) of all [[data]]."""
        data, contours, pits_seen, sources = [], [], [], []
        for number, entry in enumerate(entries, start=1):
            where = f"[[data]] {number}"
            kinds = [kind for kind in DATA_KINDS if kind in entry]
            if not kinds:
                known = dict.fromkeys(key.name for kind in DATA_KINDS for key in TABLES[f"[[data]] {kind}"])
                wrong = [name for name in entry if name not in known]
                what = f"; {unknown(wrong[0], known)}" if wrong else ""
                self.fail(where, f"needs one of {', '.join(DATA_KINDS)}{what}")
            if len(kinds) > 1:
                self.fail(where, f"has {' and '.join(kinds)}; each needs a [[data]] of its own")
            kind = kinds[0]
            keys = self.keys(f"[[data]] {kind}", entry, where)
            try:
                if kind == "contour":
                    contours.append(contour(self.path.parent, keys, where, len(contours)))
                elif kind == "outlines":
                    contours.extend(outlines(self.path.parent, keys, where, len(contours)))
                elif kind == "pits":
                    pits_seen.extend(pits(self.path.parent, keys, where))
                else:
                    data.extend(READERS[kind](self.path.parent, keys, where))
            except ValueError as error:
                self.fail(where, error)
            if kind != "event":
                own = [(kind, (self.path.parent / keys[kind]).resolve(), column) for column in keys.get("columns", ("",))]
                if any(source in sources for source in own):
                    self.fail(where, f"{kind} = {shown(keys[kind])} is there twice; its data would count twice")
                sources += own
        return data, contours, pits_seen


def horizon(study, parameters):
    """Time (µs) to which runs go unless they bud: the study's, or the case's."""
    return study.horizon or parameters["time"]["end"]


def is_exact_time_scale(unknown, parameters):
    """Whether an unknown only slows the motion down, by itself: no run is needed to know what it does.

    parameters: resolved, of the case. Without inertia, exchange and maturation, the equations have no other time than the viscosities'
    and that of the molecules' mobility or diffusivity.
    """
    rates = TRANSPORT_RATES.get(parameters["molecules"]["transport"])
    return (
        set(unknown.scales) == VISCOSITIES
        and rates is not None
        and rates <= set(unknown.divides) <= TRANSPORT_RATES["cahn-hilliard"] | TRANSPORT_RATES["fickian"]
        and not parameters["fluid"]["inertia"]
        and parameters["fluid"]["dynamics"] == "flow"
        and all(parameters["molecules"].get(clock, "none") == "none" for clock in ("exchange", "maturation"))
    )
