"""Calls a command and turns whatever it raises into one line on stderr and an exit code."""

import errno
import importlib
import sys
from pathlib import Path

from comparisons.errors import BAD_INPUT, INTERRUPTED, IO_FAILURE, StudyError
from comparisons.files import shown, take_any_name

from . import NAMES


def call(arguments):
    """Run `NAME …`, the arguments of `endoflow`; returns the exit code."""
    take_any_name(sys.stdout, sys.stderr)
    name = arguments[0] if arguments else ""
    if name not in NAMES:
        print(f"endoflow: unknown command '{name}'; known: {', '.join(NAMES)}", file=sys.stderr)
        return BAD_INPUT

    def body():
        module = importlib.import_module(f"comparisons.commands.{name}")
        code = module.run(module.parsed(arguments[1:]))
        sys.stdout.flush()
        return code

    return guarded(name, body)


def remedy(error):
    """What to do about an OSError."""
    full = error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
    return "free some space and repeat the command" if full else "choose another directory with -o"


def required():
    """Names of the packages that commands need."""
    text = (Path(__file__).resolve().parents[1] / "requirements.txt").read_text(encoding="utf-8")
    return [name for line in text.splitlines() if (name := line.partition("#")[0].strip())]


def lacking(error):
    """What to do about an ImportError."""
    name = (error.name or "").partition(".")[0]
    if name not in required():
        return f"unexpected {type(error).__name__}: {error}; please report this with the command line"
    return (
        f"{sys.executable} lacks {name} ({error}); install Debian's python3-{name}, or `{sys.executable} -m pip install {name}`, "
        "or name another Python in the environment variable ENDOFLOW_PYTHON"
    )


def guarded(command, body):
    """Call body() for an exit code; whatever it raises becomes one line on stderr and an exit code."""

    def complain(text, code):
        print(f"endoflow {command}: {shown(text)}", file=sys.stderr)
        return code

    try:
        from comparisons.measures.metrics import NoCommonTimeError
        from comparisons.studies.ranges import RangeError
        from endoflow import EndoflowError

        try:
            return body()
        except (RangeError, NoCommonTimeError) as error:
            return complain(error, BAD_INPUT)
        except StudyError as error:
            return complain(error, error.exit_code)
        except EndoflowError as error:
            return complain(error, IO_FAILURE)
    except KeyboardInterrupt:
        return INTERRUPTED
    except ImportError as error:
        return complain(lacking(error), IO_FAILURE)
    except OSError as error:
        return complain(f"{error.filename or 'standard output'}: {error.strerror}; {remedy(error)}", IO_FAILURE)
    except Exception as error:  # a user never meets a stack trace; what is wrong here is ours
        problem = f"{type(error).__name__}: {error}".splitlines()[0]
        return complain(f"unexpected {problem}; please report this with the command line", IO_FAILURE)
