"""Cases from Python: a file's path, the name of a case that comes with the program, TOML text, or a dict."""

from __future__ import annotations

import contextlib
import json
import tempfile
from pathlib import Path
from typing import Any, Iterator, Mapping, Union

from .errors import EndoflowError

#: A case: {"section": {"key": value}} or anything else the module's first line names.
Case = Union[str, Path, Mapping[str, Any]]


@contextlib.contextmanager
def case_file(case: Case) -> Iterator[str]:
    """What the command line takes for a case: a path or name as given, or a temporary file with its text."""
    if isinstance(case, Path) or (isinstance(case, str) and not is_text(case)):
        yield str(case)
        return
    text = case if isinstance(case, str) else toml_of(case)
    with tempfile.TemporaryDirectory(prefix="endoflow-") as directory:
        file = Path(directory) / "case.toml"
        file.write_text(text, encoding="utf-8")
        try:
            yield str(file)
        except EndoflowError as error:  # the file is gone when somebody reads this
            error.args = (str(error).replace(str(file), "the case"),)
            raise


def case_name(case: Case) -> str:
    """What the directory of its runs is called."""
    if isinstance(case, Mapping):
        return str(case.get("case", {}).get("name", "case"))
    return "case" if is_text(str(case)) else Path(case).stem


def is_text(case: str) -> bool:
    """Whether a string is TOML text and no path: it is empty, or has a line break or an assignment."""
    return not case.strip() or "\n" in case or "=" in case


def toml_of(sections: Mapping[str, Any], above: str = "") -> str:
    """TOML text of {"section": {"key": value}}; sections may stand in sections."""
    text = ""
    for name, values in sections.items():
        if not isinstance(values, Mapping):
            raise TypeError(
                f"{above}{name} = {values!r}: a case is a dict of sections, {{'section': {{'key': value}}}}"
            )
        own = {key: value for key, value in values.items() if not isinstance(value, Mapping)}
        below = {key: value for key, value in values.items() if isinstance(value, Mapping)}
        text += f"[{above}{name}]\n" + "".join(f"{key} = {literal(value)}\n" for key, value in own.items())
        text += toml_of(below, f"{above}{name}.")
    return text


def literal(value: Any) -> str:
    """A value in TOML: numbers (also NumPy's), true, false, strings, lists of these."""
    if hasattr(value, "item"):
        value = value.item()
    if isinstance(value, bool) or isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(literal, value)) + "]"
    raise TypeError(f"{value!r}: a parameter is a number, two numbers, a string, True or False")


def settings(values: Mapping[str, Any] | None) -> list[str]:
    """Command line of {"section.key": value}."""
    return [part for key, value in (values or {}).items() for part in ("--set", f"{key}={literal(value)}")]
