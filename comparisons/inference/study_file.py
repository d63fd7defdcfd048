"""STUDY.toml of `endoflow infer`: the case, the unknowns with their priors, the data with their errors."""

import tomllib
from dataclasses import dataclass

from comparisons.errors import BAD_INPUT, IO_FAILURE, StudyError
from comparisons.inference.observations import contour, event, history_data, run_data
from comparisons.inference.priors import KINDS, PriorError, prior_of

#: Keys of each part.
STUDY_KEYS = {"case", "engine", "seed", "horizon"}
UNKNOWN_KEYS = {"name", "key", "scales", "divides", "time_offset", "prior", *(k for keys in KINDS.values() for k in keys)}
DATA_KEYS = {
    "file": {"file", "error"},
    "run": {"run", "columns", "points", "from", "to", "error"},
    "event": {"event", "time_us", "error_us"},
    "contour": {"contour", "time_us", "error_nm", "low_us", "high_us"},
}

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
    """A study as its file says. case: path or name; settings: {key: value}; data: list of observations.Datum; horizon: µs or None."""

    case: str
    engine: str
    settings: dict
    unknowns: tuple
    data: tuple
    contours: tuple
    seed: int
    horizon: float | None


def read_study(path):
    """The StudyFile of a path. Raises StudyError that names file and key: exit code 4 for a file that cannot be read, else 2."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "is no text in UTF-8"
        raise StudyError(f"{path}: {reason}; give the path of a study in TOML", IO_FAILURE) from None
    try:
        content = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise StudyError(f"{path}: {error}", BAD_INPUT) from None
    return _Reader(path).study(content)


class _Reader:
    """Turns the file's tables into objects; every complaint begins with the file's name."""

    def __init__(self, path):
        self.path = path

    def fail(self, where, what):
        raise StudyError(f"{self.path}: {where}: {what}", BAD_INPUT)

    def table(self, content, where, allowed):
        """A table whose keys are all known."""
        if not isinstance(content, dict):
            self.fail(where, "must be a table")
        for key in content:
            if key not in allowed:
                self.fail(where, f"unknown key {key!r}; known: {', '.join(sorted(allowed))}")
        return content

    def study(self, content):
        self.table(content, "the study", {"study", "set", "unknown", "data"})
        head = self.table(content.get("study", {}), "[study]", STUDY_KEYS)
        engine = head.get("engine", "boundary-integral")
        if engine not in ("boundary-integral", "phase-field"):
            self.fail("[study]", f'engine = {engine!r}: it is "boundary-integral" or "phase-field"')
        unknowns = [self.unknown(entry, f"[[unknown]] {i + 1}") for i, entry in enumerate(content.get("unknown", []))]
        if not unknowns:
            self.fail("the study", "needs at least one [[unknown]]")
        names = [unknown.name for unknown in unknowns]
        if len(set(names)) < len(names):
            self.fail("[[unknown]]", f"{next(n for n in names if names.count(n) > 1)} is there twice")
        data, contours = [], []
        for number, entry in enumerate(content.get("data", [])):
            self.datum(entry, f"[[data]] {number + 1}", data, contours)
        for outline in contours:
            if outline.time is None:
                prior = prior_of("uniform", {"low": outline.low, "high": outline.high})
                unknowns.append(Unknown(outline.time_name, prior))
        horizon = head.get("horizon")
        if horizon is not None and not (isinstance(horizon, (int, float)) and horizon > 0):
            self.fail("[study]", f"horizon = {horizon!r}: a positive time in µs")
        case = str(head.get("case", "standard"))
        if (self.path.parent / case).is_file():
            case = str(self.path.parent / case)
        settings = content.get("set", {})
        if not isinstance(settings, dict) or any(isinstance(value, dict) for value in settings.values()):
            self.fail("[set]", 'holds lines "section.key" = value, the keys in quotes')
        return StudyFile(
            case, engine, settings, tuple(unknowns), tuple(data), tuple(contours), int(head.get("seed", 1)), horizon
        )

    def unknown(self, entry, where):
        """One [[unknown]]."""
        self.table(entry, where, UNKNOWN_KEYS)
        kinds = [kind for kind in ("key", "scales", "time_offset") if entry.get(kind)]
        if len(kinds) != 1:
            self.fail(where, "needs one of key (a parameter), scales (parameters that it multiplies), time_offset = true")
        lists = {name: self.keys_of(entry.get(name, []), where, name) for name in ("scales", "divides")}
        name = str(entry.get("name") or entry.get("key") or ("time_offset" if kinds == ["time_offset"] else ""))
        if not name:
            self.fail(where, "a factor needs a name")
        numbers = {}
        for key in {k for keys in KINDS.values() for k in keys} & entry.keys():
            if isinstance(entry[key], bool) or not isinstance(entry[key], (int, float)):
                self.fail(where, f"{key} = {entry[key]!r}: a number is needed")
            numbers[key] = float(entry[key])
        try:
            prior = prior_of(str(entry.get("prior", "none")), numbers)
        except PriorError as error:
            self.fail(f"{where} ({name})", error)
        if lists["scales"] and not prior.logarithmic and prior.value(prior.lowest) <= 0:
            self.fail(f"{where} ({name})", "a factor is positive; take log-uniform, or low > 0")
        return Unknown(name, prior, entry.get("key", ""), lists["scales"], lists["divides"], "time_offset" in kinds)

    def keys_of(self, found, where, name):
        """A list of parameters' keys."""
        if not isinstance(found, list) or not all(isinstance(key, str) and "." in key for key in found):
            self.fail(where, f'{name} is a list of keys, ["section.key", …]')
        return tuple(found)

    def datum(self, entry, where, data, contours):
        """One [[data]], appended to data or contours."""
        kinds = [kind for kind in DATA_KEYS if isinstance(entry, dict) and kind in entry]
        if len(kinds) != 1:
            self.fail(where, f"needs one of {', '.join(DATA_KEYS)}")
        kind = kinds[0]
        self.table(entry, where, DATA_KEYS[kind])
        try:
            if kind == "contour":
                contours.append(contour(self.path.parent / entry["contour"], entry, len(contours)))
            else:
                reader = {"file": history_data, "run": run_data, "event": event}[kind]
                data.extend(reader(self.path.parent, entry))
        except (ValueError, TypeError) as error:
            self.fail(where, error)


def is_exact_time_scale(unknown, parameters):
    """Whether an unknown only slows the motion down, by itself: no run is needed to know what it does.

    parameters: resolved, of the case. Without inertia and exchange, the equations have no other time than the viscosities'
    and that of the molecules' mobility or diffusivity.
    """
    rates = TRANSPORT_RATES.get(parameters["molecules"]["transport"])
    return (
        set(unknown.scales) == VISCOSITIES
        and rates is not None
        and rates <= set(unknown.divides) <= TRANSPORT_RATES["cahn-hilliard"] | TRANSPORT_RATES["fickian"]
        and not parameters["fluid"]["inertia"]
        and parameters["fluid"]["dynamics"] == "flow"
        and parameters["molecules"].get("exchange", "none") == "none"
    )

