"""What a build left open, one line a cause, the gravest first: the same in the command line and in the page."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from yellowiron.model.mechanism import Measurement
from yellowiron.report.document import within_tolerance
from yellowiron.report.words import counted

SHOWN = 6
"""Names that a line has; the rest are counted."""
_SET = re.compile(r'--set "([^"]*)"')
_PATH = re.compile(r"(?<![\w.:/])(?:/[\w-]+)+/([\w-]+)")
_UNITS = {"m": "mm", "rad": "deg", "kg": "kg", "Pa": "MPa", "N": "kN", "s": "s"}
"""SI unit → the one that a person gives a value in."""
_STATUSES = (("conflict", "with two values"), ("unreadable", "that cannot be read"), ("review", "to review"))


@dataclass(frozen=True)
class Cause:
    """One cause of open points: how grave, `words`, how many points it stands for, and the values whose `--set` would
    settle it (`settings`, such as `Boom Cylinder Stroke=… mm`)."""

    severity: Literal["error", "warning"]
    words: str
    count: int = 1
    settings: tuple[str, ...] = ()

    @property
    def block(self) -> str:
        """What to paste into the command line."""
        return " ".join(f'--set "{setting}"' for setting in self.settings)


def causes(document: Mapping[str, Any]) -> list[Cause]:
    """The causes of all that `fell_short` tells of a report's document, errors first; empty where it tells nothing."""
    found = [
        *_mobility(document), *_roles(document), *_missing(document), *_off(document), *_findings(document),
        *_statuses(document), *_review(document),
    ]  # fmt: skip
    return sorted(found, key=lambda cause: cause.severity != "error")


def tally(document: Mapping[str, Any]) -> str:
    """`1 error, 6 warnings, 21 notes`, of causes and of remarks that leave nothing to do."""
    found = causes(document)
    numbers = {kind: sum(cause.severity == kind for cause in found) for kind in ("error", "warning")}
    driven = [entry for run in document["simulation"].values() for entry in run["findings"]]
    numbers["note"] = sum(f.get("severity") == "info" for f in (*document["findings"], *driven))
    return ", ".join(counted(number, kind) for kind, number in numbers.items() if number) or "nothing open"


def named(text: str) -> str:
    """A text with the names of things in place of their paths in a USD file."""
    return _PATH.sub(r"\1", text)


def _listed(names: Sequence[str]) -> str:
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return ", ".join(names[:SHOWN]) + more


def _mobility(document: Mapping[str, Any]) -> list[Cause]:
    mobility = document["mobility"]
    if mobility is None or mobility["computed"] == mobility["expected"]:
        return []
    return [Cause("error", f"The mobility is {mobility['computed']}, and {mobility['expected']} is expected")]


def _roles(document: Mapping[str, Any]) -> list[Cause]:
    missing = document["alignment"]["missing"]
    grave = {f["where"] for f in document["findings"] if f["code"] == "ALN001" and f["severity"] == "error"}
    words = f"No part plays {_listed(missing)}"
    return [Cause("error" if grave & set(missing) else "warning", words, len(missing))] if missing else []


def _missing(document: Mapping[str, Any]) -> list[Cause]:
    """Limits that nothing gives: `3 strokes missing`."""
    missing = document["missing"]
    if not missing:
        return []
    units = {s["name"]: _UNITS.get(s["unit"], s["unit"]) for s in document["specifications"]}
    strokes = all(name.casefold().endswith("stroke") for name in missing)
    words = f"{counted(len(missing), 'stroke' if strokes else 'limit')} missing"
    settings = tuple(f"{name}=… {units.get(name, '')}".rstrip() for name in missing)
    return [Cause("error", f"{words}: {_listed(missing)}", len(missing), settings)]


def _off(document: Mapping[str, Any]) -> list[Cause]:
    off = [
        f"{m['name']} by {m['error_percent']:+.2f} %" if m["error_percent"] is not None else m["name"]
        for m in document["measurements"]
        if m["role"] == "checked" and within_tolerance(Measurement(**m)) is False
    ]
    return [Cause("error", f"Off the sheet: {_listed(off)}", len(off))] if off else []


def _findings(document: Mapping[str, Any]) -> list[Cause]:
    """One line a code; what a missing limit or role has caused is said with that."""
    unplayed, missing = set(document["alignment"]["missing"]), document["missing"]
    told: dict[tuple[str, str, str], list[Mapping[str, Any]]] = {}
    for entry in document["findings"]:
        caused = entry["code"] == "ALN001" and entry["where"] in unplayed
        caused |= any(f"'{name}'" in entry["message"] for name in missing)
        if entry["severity"] != "info" and not caused:
            told.setdefault((entry["severity"], entry["code"], ""), []).append(entry)
    for engine, run in document["simulation"].items():
        for entry in run["findings"]:
            if (severity := entry.get("severity", "warning")) != "info":
                told.setdefault((severity, entry["code"], f"{engine}, "), []).append(entry)
    return [_alike(key, entries) for key, entries in told.items()]


def _alike(key: tuple[str, str, str], entries: Sequence[Mapping[str, Any]]) -> Cause:
    severity, code, engine = key
    settings = tuple(dict.fromkeys(s for e in entries for s in _SET.findall(e.get("hint", ""))))
    message = named(entries[0]["message"]).rstrip(".")
    said = entries[0].get("hint", "").strip()
    # Where a hint is more than a value to set, it names the value, which is there to paste below.
    hint = "" if _SET.fullmatch(said) else named(_SET.sub(lambda found: found[1].partition("=")[0], said))
    places = _listed(list(dict.fromkeys(engine + named(e["where"]) for e in entries)))
    differ = len({e["message"] for e in entries}) > 1
    words = f"{places}: {message}" + (" (the first of them; the others likewise)" if differ else "")
    words += f". {hint}" if hint else ""
    return Cause("error" if severity == "error" else "warning", f"{code} {words}", len(entries), settings)


def _statuses(document: Mapping[str, Any]) -> list[Cause]:
    found = []
    for status, words in _STATUSES:
        names = [s["name"] for s in document["specifications"]
                 if s["status"] == status and s["name"] not in document["missing"]]  # fmt: skip
        if names:
            line = f"{counted(len(names), 'value')} of the sheet {words}: {_listed(names)}"
            found.append(Cause("warning", line, len(names)))
    return found


def _review(document: Mapping[str, Any]) -> list[Cause]:
    alignment = document["alignment"]
    items = [item for item in alignment["to_review"] if item not in alignment["missing"]]
    words = f"{counted(len(items), 'part or role', 'parts or roles')} to review: {_listed(items)}"
    return [Cause("warning", words, len(items))] if items else []
