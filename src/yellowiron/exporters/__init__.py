"""Export: the same machine in other simulators' formats. MJCF first; the names here import what they need when used.

One concept a module: `geometry` (a machine file's visuals and colliders), `assets` (mesh files), `mjcf` (the
documents).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.exporters.geometry import BodyGeometry, Geometry, read_geometry
    from yellowiron.exporters.mjcf.document import actuator_names, export_mjcf

__all__ = ["BodyGeometry", "Geometry", "actuator_names", "export_mjcf", "read_geometry"]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "BodyGeometry": "geometry",
        "Geometry": "geometry",
        "actuator_names": "mjcf.document",
        "export_mjcf": "mjcf.document",
        "read_geometry": "geometry",
    },
)
