#!/usr/bin/env python3
"""Stands in for the program `endoflow`: `check` and `run` as the real ones, with a membrane known in closed form.

The diffuse engine's membrane lies 0.2 ε² off, the sharp one's 100 times what time.tolerance is above 1e-4.
Settings steer it: a patch radius of 13 or an ε of 0.7 makes `run` fail as a solver does, geometric dynamics are refused by
the boundary-integral engine, the case.name "slow" makes it run until SIGINT or SIGTERM and end with a checkpoint, so does a patch radius that
stands in the file `slow` in the working directory. A patch radius of 17 fails in the midst of the run, whose record says so. A patch radius
above 1000 and unknown keys are refused. The motion is as slow as the
intracellular viscosity. Every run appends a line to runs.log in the working directory, where defaults.json holds the parameters.
"""

import json
import signal
import sys
import time
import tomllib
from pathlib import Path


def fail(message, code):
    print(f"endoflow: {message}", file=sys.stderr)
    sys.exit(code)


def options(arguments):
    """(words, settings, output, flags) of a command line."""
    words, settings, output, flags = [], [], None, []
    rest = iter(arguments)
    for word in rest:
        if word == "--set":
            settings.append(next(rest))
        elif word == "-o":
            output = Path(next(rest))
        elif word.startswith("--"):
            flags.append(word)
        else:
            words.append(word)
    return words, settings, output, flags


def assignments(sections, prefix=""):
    """The keys of a case file as "section.key=value"; sections may hold sections."""
    for key, value in sections.items():
        if isinstance(value, dict):
            yield from assignments(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}={value}"


def resolved(case, settings):
    """The parameters of a case."""
    if not Path(case).is_file():
        fail(f"{case}: no such case file; give the path of a TOML file", 2)
    parameters = json.loads(Path("defaults.json").read_text())
    sections = tomllib.loads(Path(case).read_text())
    for setting in [*assignments(sections), *settings]:
        key, _, text = setting.partition("=")
        *path, name = key.split(".")
        section = parameters
        for part in path:
            section = section.get(part, {})
        if name not in section:
            fail(f"--set {setting}: unknown key {key}", 2)
        section[name] = text if isinstance(section[name], (str, bool)) else float(text)
    if parameters["molecules"]["patch_radius"] > 1000:
        fail("molecules.patch_radius: must be at most 1000", 2)
    return parameters


def run(engine, case, settings, output, restart):
    """Write a run directory."""
    parameters = resolved(case, settings)
    with open("runs.log", "a", encoding="utf-8") as file:
        file.write(f"{output} {'restart' if restart else 'fresh'}\n")
    name, patch_radius = parameters["case"]["name"], parameters["molecules"]["patch_radius"]
    epsilon = parameters["phase_field"]["epsilon"]
    if patch_radius == 13 or epsilon == 0.7:
        fail("step-underflow: the step became too small; lower time.tolerance", 3)
    if engine == "boundary-integral" and parameters["fluid"]["dynamics"] == "geometric":
        fail('fluid.dynamics: the boundary-integral engine offers "flow"', 2)

    import locations  # noqa: F401
    import synthetic

    end = parameters["time"]["end"]
    inaccuracy = 100 * max(0.0, parameters["time"]["tolerance"] - 1e-4)
    offset = 0.2 * epsilon**2 if engine == "phase-field" else inaccuracy
    duration = parameters["fluid"]["viscosity_intracellular"] / 1e-2
    times = [0.25 * end * i for i in range(5)]
    named = Path("slow").exists() and float(Path("slow").read_text()) == patch_radius
    slow = (name == "slow" and not restart) or named
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: None)
    synthetic.write_run(output, engine, lambda t: synthetic.budding_membrane(t, duration, offset), times, 400, parameters)
    (output / "checkpoint").mkdir(exist_ok=True)
    (output / "checkpoint" / "state.h5").write_text("")
    if patch_radius == 17:
        note(output, "failed", "step-underflow")
        fail("step-underflow: the step became too small; lower time.tolerance", 3)
    if slow:
        note(output, "running")
        stopping = {signal.SIGINT, signal.SIGTERM}
        signal.pthread_sigmask(signal.SIG_BLOCK, stopping)
        (output / "ready").write_text("")
        caught = signal.sigtimedwait(stopping, 600)
        time.sleep(0.2)
        note(output, "interrupted")
        sys.exit(128 + (caught.si_signo if caught else signal.SIGINT))


def note(output, state, reason=None):
    """Change the state in run.json."""
    record = json.loads((output / "run.json").read_text())
    (output / "run.json").write_text(json.dumps({**record, "state": state, "exit_reason": reason or state}, indent=2))


def main():
    words, settings, output, flags = options(sys.argv[1:])
    if words[0] == "laws":
        laws = [
            f"{law}_{column}" for law in ("linear", "coarse-grained", "lumped") for column in ("b_pN_nm", "H0_per_nm")
        ]
        print(",".join(["c", *laws]))
        for c in (0, 0.5, 1):
            print(",".join([str(c), *(f"{100 + 1100 * c},{c / 14.1}" for _ in range(3))]))
    elif words[0] == "params":
        print(json.dumps([{"name": "molecules.patch_radius", "unit": "nm"}, {"name": "molecules.transport", "unit": ""}]))
    elif words[0] == "check":
        print(json.dumps(resolved(words[1], settings)))
    else:
        run(words[1], words[2], settings, output, "--restart" in flags)


main()
