"""Whether anybody works on a run: run.json says what was written last, the kernel's lock whether somebody still writes."""

from __future__ import annotations

import contextlib
import json
import os
import socket
from pathlib import Path
from typing import Any

try:
    import fcntl
except ImportError:  # systems on which no run can be at work
    fcntl = None  # type: ignore[assignment]

#: The state of a run whose record says "running" although nobody holds its directory's lock.
KILLED = "killed"


def current_record(directory: Path) -> dict[str, Any]:
    """run.json of a run's directory, its `state` "killed" where it says "running" and nobody runs.

    Raises OSError, and ValueError for what is no JSON object.
    """
    free = lock_is_free(directory)
    record = json.loads((directory / "run.json").read_text(encoding="utf-8"))
    if not isinstance(record, dict):
        raise ValueError("is not a JSON object")
    # Free before and after: who wrote "running" did not begin or end meanwhile.
    if record.get("state") == "running" and free and lock_is_free(directory):
        return {**record, "state": KILLED}
    return record


def lock_is_free(directory: Path) -> bool:
    """Whether it is certain that no process holds the lock of a run's directory.

    It is not where the file system keeps no locks, and where the lock was left on another host, whose locks need not be seen here.
    """
    if fcntl is None:
        return False
    try:
        descriptor = os.open(directory / "lock", os.O_RDONLY)
    except FileNotFoundError:
        return True
    except OSError:
        return False
    with contextlib.closing(os.fdopen(descriptor, "rb")) as file:
        holder = file.read(300).decode("utf-8", "replace")
        if holder and f" on {socket.gethostname()} since " not in holder:
            return False
        try:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except OSError:
            return False
        return True


def unfinished(directory: Path, record: dict[str, Any]) -> str:
    """How it stands with a run that did not finish, in words; "" for one that did. record: as current_record() has it."""
    state = record.get("state")
    if state == "finished":
        return ""
    if state == KILLED:
        return f"killed, no longer running; {how_to_go_on(directory, record)}"
    reason = record.get("exit_reason")
    return f"{state}: {reason}" if reason and reason != state else f"{state}"


def how_to_go_on(directory: Path, record: dict[str, Any]) -> str:
    """What to do about a run that was killed."""
    if record.get("engine") != "statics" and any((directory / "checkpoint").glob("state*.h5")):
        return "continue with --restart"
    return "run it again, it left no checkpoint"
