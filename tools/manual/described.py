"""What the program says of itself: its commands with their options, and its parameters."""

import json
import subprocess

ENGINES = ("boundary-integral", "phase-field")


def commands(program):
    """{words: {command, description, options}} of every command; an engine that was not built is described as the other one."""
    names = subprocess.run([program, "--describe"], capture_output=True, text=True, check=True).stdout.split()
    names.remove("help")
    found = {}
    for words in (words for name in names for words in ([(name, one) for one in ENGINES] if name == "run" else [(name,)])):
        process = subprocess.run([program, *words, "--describe"], capture_output=True, text=True, check=False)
        if process.returncode and words == ("run", ENGINES[1]):
            other = found["run", ENGINES[0]]
            found[words] = json.loads(json.dumps(other).replace(*ENGINES))
            continue
        if process.returncode:
            raise SystemExit(f"endoflow {' '.join(words)} --describe: {process.stderr.strip()}")
        found[words] = json.loads(process.stdout)
    return found


def parameters(program):
    """Every parameter as `endoflow params --json` lists them."""
    return json.loads(subprocess.run([program, "params", "--json"], capture_output=True, text=True, check=True).stdout)


def version(program):
    """The version's number."""
    return subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
