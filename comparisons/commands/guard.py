"""Calls a command and turns whatever it raises into one line on stderr and an exit code."""

import errno
import importlib
import sys

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
        return complain(f"{error}; install python3-numpy python3-scipy python3-h5py python3-matplotlib python3-emcee", IO_FAILURE)
    except OSError as error:
        return complain(f"{error.filename or 'standard output'}: {error.strerror}; {remedy(error)}", IO_FAILURE)
    except Exception as error:  # a user never meets a stack trace; what is wrong here is ours
        problem = f"{type(error).__name__}: {error}".splitlines()[0]
        return complain(f"unexpected {problem}; please report this with the command line", IO_FAILURE)
