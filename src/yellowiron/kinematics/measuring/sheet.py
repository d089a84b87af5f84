"""What the sheet says of a value that is measured, or that a measurement needs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from yellowiron.model.mechanism import Mechanism
from yellowiron.model.specification import fold


def specified(mechanism: Mechanism, name: str) -> tuple[float | None, bool, str]:
    """(value in SI if its status is `ok`, whether it is the publisher's example value, else why there is none)."""
    entry = _entry(mechanism, name)
    if entry is None or entry.get("status", "ok") == "missing":
        return None, False, ""
    status, value = str(entry.get("status", "ok")), entry.get("value")
    if status != "ok" or value is None:
        return None, bool(entry.get("example")), f"the specification's status is '{status}'"
    return float(value), bool(entry.get("example")), ""


def _entry(mechanism: Mechanism, name: str) -> Mapping[str, Any] | None:
    wanted = fold(name)
    for key, entry in mechanism.specifications.items():
        if fold(key) == wanted:
            return entry
    return None
