"""The figures of a machine that a fleet's table has, from its build's report; and the table's columns."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, Literal

from yellowiron.report import tally

Kind = Literal["text", "integer", "number", "flag", "texts"]

FIGURES: Mapping[str, Kind] = {
    "machine": "text",
    "verdict": "text",
    "open": "text",
    "bodies": "integer",
    "joints": "integer",
    "loops": "integer",
    "cylinders": "integer",
    "mobility": "integer",
    "mass_kg": "number",
    "parts": "integer",
    "parts_to_review": "integer",
    "specifications_ok": "integer",
    "specifications_open": "integer",
    "measurements_checked": "integer",
    "worst_error_percent": "number",
    "worst_error_deg": "number",
    "worst_measurement": "text",
    "errors": "integer",
    "warnings": "integer",
    "findings": "texts",
    "engines": "texts",
    "engine_findings": "integer",
    "pin_error_mm": "number",
}
"""Of a machine that was built. `worst_error_percent` is of lengths, masses and forces, `worst_error_deg` of angles,
both of published values alone; `pin_error_mm` is the largest of the engines that drove it."""

COLUMNS: Mapping[str, Kind] = {
    "id": "text",
    "type": "text",
    "status": "text",
    "code": "integer",
    "message": "text",
    "where": "text",
    "hint": "text",
    **FIGURES,
    "variants": "integer",
    "key": "text",
    "seconds": "number",
    "peak_mb": "number",
}
"""Of `fleet.parquet` and `fleet.csv`, in this order. `seconds` and `peak_mb` alone differ between two runs."""


def figures_of(document: Mapping[str, Any], fell_short: Sequence[str]) -> dict[str, Any]:
    """The figures of a build's document."""
    statuses = Counter(entry["status"] for entry in document["specifications"])
    severities = Counter(entry["severity"] for entry in document["findings"])
    checked = [m for m in document["measurements"] if m["role"] == "checked" and _known(m)]
    angles = {m["name"]: abs(m["model"] - m["spec"]) * 57.29577951308232 for m in checked if m["unit"] == "rad"}
    others = {
        m["name"]: abs(m["error_percent"]) for m in checked if m["unit"] != "rad" and m["error_percent"] is not None
    }
    runs = document["simulation"]
    pins = [run["pin_error_mm"] for run in runs.values() if run.get("pin_error_mm") is not None]
    mobility = document["mobility"]
    return {
        "machine": document["machine"],
        "verdict": document["verdict"],
        "open": tally(document) if fell_short else "",
        "bodies": len(document["bodies"]),
        "joints": len(document["joints"]),
        "loops": len(document["loops"]),
        "cylinders": len(document["cylinders"]),
        "mobility": mobility["computed"] if mobility is not None else None,
        "mass_kg": _round(sum(body["mass"] for body in document["bodies"])),
        "parts": document["alignment"]["assigned"],
        "parts_to_review": len(document["alignment"]["to_review"]),
        "specifications_ok": statuses["ok"],
        "specifications_open": statuses["review"] + statuses["conflict"] + statuses["unreadable"],
        "measurements_checked": len(checked),
        "worst_error_percent": _round(max(others.values(), default=None)),
        "worst_error_deg": _round(max(angles.values(), default=None)),
        "worst_measurement": max(others or angles, key=(others or angles).__getitem__, default=""),
        "errors": severities["error"],
        "warnings": severities["warning"],
        "findings": sorted({entry["code"] for entry in document["findings"] if entry["severity"] != "info"}),
        "engines": list(runs),
        "engine_findings": sum(len(run["findings"]) for run in runs.values()),
        "pin_error_mm": _round(max(pins, default=None)),
    }


def _known(measurement: Mapping[str, Any]) -> bool:
    return measurement["spec"] is not None and measurement["model"] is not None


def _round(value: float | None) -> float | None:
    """Six decimals: what is left beyond is round-off, and a zero has no sign."""
    return None if value is None else round(value, 6) + 0.0
