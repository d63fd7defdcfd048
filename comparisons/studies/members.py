"""The members of a study, runs of one case that differ in some parameters: directories, state, what is left to do."""

import json
import os
import subprocess
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import quote

import endoflow
from comparisons.errors import BAD_INPUT, IO_FAILURE, RUN_FAILED, StudyError
from comparisons.measures.metrics import flattened
from endoflow.errors import last_word
from endoflow.run_directory import damage_of
from endoflow.run_state import KILLED, current_record

#: The exit_reason of a run, or of a branch of stationary shapes, whose neck closed.
NECK_CLOSED = "neck-closed"

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


def program():
    """The endoflow that started this script."""
    found = os.environ.get("ENDOFLOW_PROGRAM")
    if not found:
        raise StudyError("start this as a command of endoflow, or name that program in ENDOFLOW_PROGRAM", BAD_INPUT)
    return Path(found)


def answer(*words):
    """What `endoflow WORDS` prints. Raises StudyError with the message and the exit code of a refusal."""
    try:
        done = subprocess.run([str(program()), *words], capture_output=True, text=True, check=False)
    except OSError as error:
        raise StudyError(f"{program()}: {error.strerror}; build or install endoflow", IO_FAILURE) from None
    if done.returncode:
        raise StudyError(last_word(done.stderr) or f"{program()} {words[0]} failed", done.returncode)
    return done.stdout


def resolved_parameters(case, settings):
    """Every parameter {section: {key: value}} of a case (path) with some settings, as `endoflow check` resolves them."""
    return json.loads(answer("check", str(case), "--json", *(part for setting in settings for part in ("--set", setting))))


def parameter_units():
    """{"section.key": unit} of every parameter that has one, as `endoflow params` knows them."""
    return {row["name"]: row["unit"] for row in json.loads(answer("params", "--json")) if row["unit"]}


def axis_label(key, units):
    """A parameter's key with its unit, if it has one in parameter_units()."""
    return f"{key} ({units[key]})" if key in units else key


def checked_member(name, case, directory, engine, settings, values=None):
    """The Member, its parameters resolved. values: those of its settings that the study varies. Raises StudyError."""
    settings = tuple(settings)
    return Member(name, case, directory, engine, settings, values or {}, resolved_parameters(case, settings))


def settings_of(values):
    """("section.key=value", …) of {key: value}."""
    return tuple(f"{key}={str(value).lower() if isinstance(value, bool) else value}" for key, value in values.items())


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


def records_of(members):
    """run.json of every member that has one."""
    return [record for member in members if (record := read_record(member.directory))]


def load_run(member):
    """The endoflow.Run of a member, up to its end. Raises endoflow.EndoflowError, and StudyError for a run of another study."""
    run = endoflow.load(member.directory)
    if covers(run.record, member):
        return run.until(member.end)
    if differing_parameters(run.parameters, member.parameters, member.engine):
        raise StudyError(f"{member.directory} holds a run with other parameters", RUN_FAILED)
    return run


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
    found, wanted = flattened(found), flattened(wanted)
    return [
        key
        for key in dict.fromkeys([*found, *wanted])
        if found.get(key) != wanted.get(key) and key not in WITHOUT_EFFECT and not key.startswith(OTHER_SECTION[engine])
    ]


def run_command(program, member, work, processes=1, mpirun=("mpirun",)):
    """The command line (list of str) with which a program runs a member."""
    launcher = [*mpirun, "-n", str(processes)] if processes > 1 and member.engine == "phase-field" else []
    settings = [part for setting in member.settings for part in ("--set", setting)]
    restart = ["--restart"] if work == CONTINUE else []
    run = [str(program), "run", member.engine, str(member.case), *settings, "-o", str(member.directory), *restart]
    return launcher + run
