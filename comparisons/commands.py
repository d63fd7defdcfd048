"""What every command in Python shares: exit codes, and errors that become one line on stderr."""

import sys

BAD_INPUT, RUN_FAILED, IO_FAILURE, INTERRUPTED = 2, 3, 4, 130


def positive_integer(text):
    """For argparse."""
    if not text.isdigit() or int(text) == 0:
        raise ValueError(text)
    return int(text)


def start(command, parsed, body):
    """Run a script as `endoflow COMMAND` and exit: parsed(arguments) gives the options, body(options) the exit code."""
    sys.exit(guarded(command, lambda: body(parsed(sys.argv[1:]))))


def guarded(command, body):
    """Call body() for an exit code; whatever it raises becomes one line on stderr and an exit code."""

    def complain(text, code):
        print(f"endoflow {command}: {text}", file=sys.stderr)
        return code

    try:
        from endoflow import EndoflowError
        from members import StudyError
        from metrics import NoCommonTimeError
        from ranges import RangeError

        try:
            return body()
        except RangeError as error:
            return complain(error, BAD_INPUT)
        except StudyError as error:
            return complain(error, error.exit_code)
        except (EndoflowError, NoCommonTimeError) as error:
            return complain(error, IO_FAILURE)
    except KeyboardInterrupt:
        return INTERRUPTED
    except ImportError as error:
        return complain(f"{error}; install python3-numpy python3-scipy python3-h5py python3-matplotlib", IO_FAILURE)
    except OSError as error:
        return complain(f"{error.filename}: {error.strerror}; choose another directory with -o", IO_FAILURE)
    except Exception as error:  # a user never meets a stack trace; what is wrong here is ours
        problem = f"{type(error).__name__}: {error}".splitlines()[0]
        return complain(f"unexpected {problem}; please report this with the command line", IO_FAILURE)
