"""Export: a `Mechanism` and its machine file → the same machine in another simulator's files, in a folder.

In the order in which they build on each other: `geometry` (a machine file's visuals and colliders), `assets` (mesh
files), `values` (numbers as texts), `shapes` (what is seen and touched of a link), `tendons` (a machine whose
cylinders are no bodies), `ropes` (one whose hook hangs on rope alone), `mjcf` (its documents), `link_table` (links
and joints, the table of the others), `ros` (URDF and its helper), `sdf` (Gazebo's and Drake's models), `registry`
(which formats there are, ours and other packages'). The names here import what they need when used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.exporters.geometry import BodyGeometry, Geometry, read_geometry
    from yellowiron.exporters.link_table import LinkTable, links_of
    from yellowiron.exporters.mjcf.actuators import actuator_names
    from yellowiron.exporters.mjcf.document import TIMESTEP, export_mjcf
    from yellowiron.exporters.registry import EXPORTERS, Exporter, export, exporter_names, find_exporter, unsaid
    from yellowiron.exporters.ropes import Rope, with_ropes
    from yellowiron.exporters.ros.joint_states import JointStates
    from yellowiron.exporters.shapes import drawn_of, solids_of
    from yellowiron.exporters.tendons import Tendon, with_tendons

__all__ = [
    "EXPORTERS",
    "TIMESTEP",
    "BodyGeometry",
    "Exporter",
    "Geometry",
    "JointStates",
    "LinkTable",
    "Rope",
    "Tendon",
    "actuator_names",
    "drawn_of",
    "export",
    "export_mjcf",
    "exporter_names",
    "find_exporter",
    "links_of",
    "read_geometry",
    "solids_of",
    "unsaid",
    "with_ropes",
    "with_tendons",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "EXPORTERS": "registry",
        "TIMESTEP": "mjcf.document",
        "BodyGeometry": "geometry",
        "Exporter": "registry",
        "Geometry": "geometry",
        "JointStates": "ros.joint_states",
        "LinkTable": "link_table",
        "Rope": "ropes",
        "Tendon": "tendons",
        "actuator_names": "mjcf.actuators",
        "drawn_of": "shapes",
        "export": "registry",
        "export_mjcf": "mjcf.document",
        "exporter_names": "registry",
        "find_exporter": "registry",
        "links_of": "link_table",
        "read_geometry": "geometry",
        "solids_of": "shapes",
        "unsaid": "registry",
        "with_ropes": "ropes",
        "with_tendons": "tendons",
    },
)
