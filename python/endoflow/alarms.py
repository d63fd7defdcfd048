"""What a run found wrong with itself: quantities of run.json that left the bounds of an accurate run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping


@dataclass(frozen=True)
class Alarm:
    """A quantity `name` that first left its bound at `time` (µs), where it was `value`.

    meaning: what the quantity is; remedy: what to change. str(alarm) is one line.
    """

    name: str
    time: float
    value: float
    bound: float
    meaning: str = ""
    remedy: str = ""

    def __str__(self) -> str:
        what = f"{self.meaning or 'value'}: {self.value:.2g}, allowed {self.bound:g}"
        return f"{self.name} at t = {self.time:.4g} µs: {what}" + (f"; {self.remedy}" if self.remedy else "")


def is_alarm(entry: Any) -> bool:
    """Whether an entry of run.json's `alarms` says what, when and how much."""
    numbers = ("time_us", "value", "bound")
    named = isinstance(entry, dict) and isinstance(entry.get("name"), str)
    return named and all(isinstance(entry.get(key), (int, float)) for key in numbers)


def alarms_of(record: Mapping[str, Any]) -> list[Alarm]:
    """The Alarms of a run.json (dict), in the order in which they were raised; entries that are none are left out."""
    return [
        Alarm(
            name=entry["name"],
            time=float(entry["time_us"]),
            value=float(entry["value"]),
            bound=float(entry["bound"]),
            meaning=entry.get("meaning", ""),
            remedy=entry.get("remedy", ""),
        )
        for entry in record.get("alarms") or []
        if is_alarm(entry)
    ]
