"""The commands in Python: calls one, and turns whatever it raises into one line on stderr and an exit code."""

import errno
import importlib
import sys

from comparisons import ROOT
from comparisons.commands.options import COMMANDS, parsed
from comparisons.errors import BAD_INPUT, INTERRUPTED, IO_FAILURE, shown, take_any_name


def call(arguments):
    """Run `NAME …`, the arguments of `endoflow`; returns the exit code."""
    take_any_name(sys.stdout, sys.stderr)
    name, *words = arguments or [""]
    if name not in COMMANDS:
        print(f"endoflow: unknown command '{name}'; known: {', '.join(COMMANDS)}", file=sys.stderr)
        return BAD_INPUT

    def body():
        options = parsed(name, words)
        # Not before: who asks for help, or errs, does not wait for SciPy and matplotlib.
        module, function = COMMANDS[name].place.split(".")
        code = getattr(importlib.import_module(f"comparisons.commands.{module}"), function)(options)
        sys.stdout.flush()
        return code

    return guarded(name, body)


def guarded(command, body):
    """Call body() for an exit code; whatever it raises becomes one line on stderr and an exit code."""

    def complain(text, code):
        print(f"endoflow {command}: {shown(text)}", file=sys.stderr)
        return code

    try:
        return body()
    except KeyboardInterrupt:
        return INTERRUPTED
    except ImportError as error:
        return complain(lacking(error), IO_FAILURE)
    except OSError as error:
        return complain(f"{error.filename or 'standard output'}: {error.strerror}; {remedy(error)}", IO_FAILURE)
    except Exception as error:  # a user never meets a stack trace; what has no exit code of its own is our mistake
        if hasattr(error, "exit_code"):
            return complain(error, error.exit_code)
        problem = f"{type(error).__name__}: {error}".splitlines()[0]
        return complain(f"unexpected {problem}; please report this with the command line", IO_FAILURE)


def remedy(error):
    """What to do about an OSError."""
    full = error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
    return "free some space and repeat the command" if full else "choose another directory with -o"


def lacking(error):
    """What to do about an ImportError."""
    name = (error.name or "").partition(".")[0]
    requirements = (ROOT / "comparisons" / "requirements.txt").read_text(encoding="utf-8").splitlines()
    if name not in [line.partition("#")[0].strip() for line in requirements if name]:
        return f"unexpected {type(error).__name__}: {error}; please report this with the command line"
    return (
        f"{sys.executable} lacks {name} ({error}); install Debian's python3-{name}, or `{sys.executable} -m pip install {name}`, "
        "or name another Python in the environment variable ENDOFLOW_PYTHON"
    )
