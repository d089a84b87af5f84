"""Export: the same machine in other simulators' formats. MJCF first; the names here import what they need when used.

One concept a module: `geometry` (a machine file's visuals and colliders), `assets` (mesh files), `mjcf` (the
documents).
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from yellowiron.exporters.geometry import BodyGeometry, Geometry, read_geometry
    from yellowiron.exporters.mjcf.document import actuator_names, export_mjcf

__all__ = ["BodyGeometry", "Geometry", "actuator_names", "export_mjcf", "read_geometry"]

_HOMES = {
    "BodyGeometry": "geometry",
    "Geometry": "geometry",
    "actuator_names": "mjcf.document",
    "export_mjcf": "mjcf.document",
    "read_geometry": "geometry",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_HOMES[name]}"), name)
