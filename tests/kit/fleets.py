"""Manifests of small machines, and what a fleet's folder holds."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

SETTINGS = ["Arm Angle Up=40 deg", "Arm Angle Down=20 deg"]


def write_manifest(folder: Path, machines: list[dict[str, Any]], **defaults: Any) -> Path:
    """A manifest of small machines, as JSON."""
    usual = {"type": "in/type", "set": SETTINGS, "page": False, "timeout": "120 s", **defaults}
    path = folder / "fleet.json"
    path.write_text(json.dumps({"defaults": usual, "machines": machines}))
    return path


def content(folder: Path) -> dict[str, bytes]:
    """Every file below a folder but those that tell times; the table without its last two columns."""
    found = {}
    for file in sorted(folder.rglob("*")):
        name = file.relative_to(folder).as_posix()
        if not file.is_file() or file.name in ("timings.json", "seconds.json", "seconds.js", "fleet.parquet"):
            continue
        found[name] = file.read_bytes()
        if file.name == "fleet.csv":
            found[name] = b"\n".join(line.rsplit(b",", 2)[0] for line in found[name].splitlines())
    return found
