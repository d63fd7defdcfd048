"""The program `endoflow`: where it is, how it is called, and its complaints as exceptions."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import signal
import subprocess
import tempfile
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from typing import Callable, Sequence
from urllib.parse import unquote, urlsplit

from .errors import EndoflowError, last_word

#: Seconds between two looks at a running program.
POLL_INTERVAL = 0.1

HOW_TO_GET_IT = (
    "the program endoflow was not found: install its Debian package, or build it (make build) and put the build directory "
    "into PATH or the program's path into the environment variable ENDOFLOW"
)


class ProgramError(EndoflowError):
    """The program ended with an error; the message is its own. exit_code as documented for the command line."""

    exit_code = 1

    def __init__(self, message: str, exit_code: int | None = None):
        super().__init__(message)
        self.exit_code = self.exit_code if exit_code is None else exit_code


class InputError(ProgramError):
    """A bad case, setting or option."""

    exit_code = 2


class SolverError(ProgramError):
    """The solver stopped: a step became too small, the membrane came too near to a wall, and the like."""

    exit_code = 3


class FileError(ProgramError):
    """Something cannot be read or written."""

    exit_code = 4


#: The exceptions by exit code.
ERRORS = {error.exit_code: error for error in (InputError, SolverError, FileError)}


def program() -> Path:
    """Path of the program: the environment variable ENDOFLOW, PATH, the installation or build directory beside this package or beside
    the directory from which pip installed it.

    Raises FileError that says how to get it.
    """
    chosen = os.environ.get("ENDOFLOW")
    if chosen:
        problem = unusable(Path(chosen))
        if problem:
            raise FileError(f"ENDOFLOW={chosen}: {problem}; give the path of the program endoflow")
        return Path(chosen)
    in_path = shutil.which("endoflow")
    above = Path(__file__).resolve().parents
    candidates = [Path(in_path)] if in_path else []
    candidates += [above[2] / "build" / "endoflow", *(root / "bin" / "endoflow" for root in above[4:5])]
    candidates += [directory.parent / "build" / "endoflow" for directory in _pip_source()]
    for candidate in candidates:
        if os.access(candidate, os.X_OK):
            return candidate
    raise FileError(HOW_TO_GET_IT)


def unusable(path: Path) -> str:
    """Why a path is no program, in words; "" for one that is."""
    if path.is_dir():
        return "is a directory"
    if not path.exists():
        return "no such program"
    return "" if os.access(path, os.X_OK) else "is not executable (chmod +x)"


def _pip_source() -> list[Path]:
    """The directory given to `pip install`, if there was one (direct_url.json of PEP 610)."""
    with contextlib.suppress(PackageNotFoundError, KeyError, ValueError):
        origin = distribution("endoflow").read_text("direct_url.json")
        url = urlsplit(json.loads(origin)["url"] if origin else "")
        if url.scheme == "file":
            return [Path(unquote(url.path))]
    return []


def call(arguments: Sequence[str], watch: Callable[[], None] | None = None, launcher: Sequence[str] = ()) -> None:
    """Run `[launcher] endoflow ARGUMENTS` to its end, calling watch() now and then.

    Raises the ProgramError of its exit code. A KeyboardInterrupt stops the program, which writes its checkpoint first, and
    is raised again; a second one kills it.
    """
    command = [*launcher, str(program()), *arguments]
    with tempfile.TemporaryFile() as errors:
        # In a session of its own: Ctrl-C reaches it through us alone.
        try:
            process = subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=errors, start_new_session=True
            )
        except OSError as error:
            raise FileError(f"{command[0]}: cannot be started: {error.strerror}") from None
        try:
            while True:
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(POLL_INTERVAL)
                    break
                if watch is not None:
                    watch()
        except BaseException:
            _stop(process)
            raise
        if watch is not None:
            watch()
        if process.returncode:
            errors.seek(0)
            raise _error(errors.read().decode("utf-8", "replace"), process.returncode)


def _stop(process: subprocess.Popen[bytes]) -> None:
    """Interrupt the program and wait for its end; kill it when that is interrupted too."""
    try:
        process.send_signal(signal.SIGINT)
        process.wait()
    except BaseException:
        process.kill()
        process.wait()
        raise


def _error(text: str, code: int) -> ProgramError:
    """The exception of an exit code; its message is the program's last word."""
    message = last_word(text) or f"endoflow ended with exit code {code}"
    return ERRORS[code](message) if code in ERRORS else ProgramError(message, code)
