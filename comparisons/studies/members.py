"""The members of a study, runs of one case that differ in some parameters: directories, state, what is left to do."""

import json
import subprocess
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import quote

from comparisons.errors import StudyError
from comparisons.measures.metrics import flat_parameters
from endoflow.errors import last_word
from endoflow.run_directory import damage_of
from endoflow.run_state import KILLED, current_record

ENGINES = ("boundary-integral", "phase-field")

#: Section of the case file that only the other engine reads.
OTHER_SECTION = {"boundary-integral": "phase_field.", "phase-field": "boundary_integral."}

#: Parameters that do not change what a run computes.
WITHOUT_EFFECT = ("case.name", "case.description", "output.checkpoint_interval")

#: What is to be done with a member.
FRESH, CONTINUE, FINISHED = "fresh", "continue", "finished"


@dataclass(frozen=True)
class Member:
    """One run. case: its file; settings: ("section.key=value", …); values: {varied key: text}; parameters: resolved, by section."""

    name: str
    case: Path
    directory: Path
    engine: str
    settings: tuple
    values: dict = field(hash=False)
    parameters: dict = field(hash=False, repr=False)

    @property
    def end(self):
        """Simulated time at its end, µs."""
        return float(self.parameters["time"]["end"])


def resolved_parameters(program, case, settings):
    """Every parameter {section: {key: value}} of a case (path) with some settings, as `endoflow check` resolves them.

    Raises StudyError with the message and exit code of the check.
    """
    arguments = [part for setting in settings for part in ("--set", setting)]
    try:
        check = subprocess.run(
            [str(program), "check", str(case), "--json", *arguments], capture_output=True, text=True, check=False
        )
    except OSError as error:
        raise StudyError(f"{program}: {error.strerror}; build or install endoflow", 4) from None
    if check.returncode:
        raise StudyError(last_word(check.stderr) or f"{program} check failed", check.returncode)
    return json.loads(check.stdout)


def parameter_units(program):
    """{"section.key": unit} of every parameter that has one, as `endoflow params` knows them."""
    listed = subprocess.run([str(program), "params", "--json"], capture_output=True, text=True, check=False)
    if listed.returncode:
        raise StudyError(last_word(listed.stderr) or f"{program} params failed", listed.returncode)
    return {row["name"]: row["unit"] for row in json.loads(listed.stdout) if row["unit"]}


def directory_name(values):
    """Readable relative path of varied values {section.key: text}, e.g. "patch_radius=36/epsilon=1.2".

    The section is left out unless two keys would look alike. Letters that a path should not hold are percent-encoded, so
    that different values have different paths.
    """
    short = [key.split(".")[-1] for key in values]
    names = [key if short.count(name) > 1 else name for key, name in zip(values, short)]
    return "/".join(f"{name}={quote(value, safe='+=')}" for name, value in zip(names, values.values()))


def read_record(directory):
    """run.json of a directory as a dict, `state` as endoflow.load has it, or None when there is no whole one."""
    try:
        record = current_record(directory)
    except (OSError, ValueError):
        return None
    whole = isinstance(record.get("parameters"), dict) and damage_of(record) is None
    return record if whole else None


def work_left(member):
    """FRESH, CONTINUE or FINISHED, from what lies in the member's directory.

    A run with other parameters counts for nothing, except that one that ended earlier is continued to a later end, and
    that one with a later end, having come so far, holds all that an earlier end asks for.
    """
    record = read_record(member.directory)
    if record is None or record.get("engine") != member.engine:
        return FRESH
    if covers(record, member):
        return FINISHED
    differing = differing_parameters(record["parameters"], member.parameters, member.engine)
    can_continue = any((member.directory / "checkpoint").glob("*.h5"))
    if differing and differing != ["time.end"]:
        return FRESH
    if not differing and record.get("state") == "finished":
        return FINISHED
    unfinished = record.get("state") in ("interrupted", "running", KILLED) or record.get("exit_reason") == "done"
    return CONTINUE if can_continue and unfinished else FRESH


def covers(record, member):
    """Whether a run.json (dict, or None) is of a run that went on longer than the member and is the same otherwise."""
    if record is None or record.get("engine") != member.engine:
        return False
    if differing_parameters(record["parameters"], member.parameters, member.engine) != ["time.end"]:
        return False
    later = record["parameters"]["time"]["end"] > member.end
    return later and (record.get("state") == "finished" or (record.get("time_us") or 0.0) >= member.end)


def differing_parameters(found, wanted, engine):
    """Keys "section.key" whose values differ in two sets of parameters and matter to the engine."""
    found, wanted = flat_parameters(found), flat_parameters(wanted)
    return [
        key
        for key in dict.fromkeys([*found, *wanted])
        if found.get(key) != wanted.get(key) and key not in WITHOUT_EFFECT and not key.startswith(OTHER_SECTION[engine])
    ]


def run_command(program, member, work, processes=1, mpirun=("mpirun",)):
    """The command line (list of str) that runs a member."""
    launcher = [*mpirun, "-n", str(processes)] if processes > 1 and member.engine == "phase-field" else []
    settings = [part for setting in member.settings for part in ("--set", setting)]
    restart = ["--restart"] if work == CONTINUE else []
    run = [str(program), "run", member.engine, str(member.case), *settings, "-o", str(member.directory), *restart]
    return launcher + run
