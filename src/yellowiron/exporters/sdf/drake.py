"""SDFormat for Drake: the tree, every cut a ball constraint (`drake:ball_constraint`), which its SAP solver holds.

The folder is a package of the machine's name (`package.xml`, `<machine>.sdf`, `meshes/`).
"""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

from yellowiron.exporters.assets import Assets
from yellowiron.exporters.geometry import Geometry, read_geometry
from yellowiron.exporters.link_table import Edge, LinkTable, links_of
from yellowiron.exporters.ros.urdf import package_name, still_words
from yellowiron.exporters.sdf.model import add_frames, add_joint, add_links, child, distance_words, write
from yellowiron.exporters.shapes import Shapes
from yellowiron.exporters.values import minus, row, text
from yellowiron.model.mechanism import Mechanism

_ARM = 0.5
"""Metres between the points at which a weld that closes a loop is held."""


def export_drake(mechanism: Mechanism, geometry: Geometry | str | Path, folder: Path) -> Path:
    """Writes the package; returns the path of `<machine>.sdf`. `geometry`: the machine's USD file, or what
    `read_geometry` made of one. Joint positions are 0 in the drawn pose; metres and radians.

    Raises `MechanismError` where the joints are no tree with cuts.
    """
    table = links_of(mechanism)
    shapes = read_geometry(geometry)
    (folder / "meshes").mkdir(parents=True, exist_ok=True)
    package = package_name(table.name)
    made = _document(table, Shapes(shapes, Assets(folder / "meshes", form="obj")), f"package://{package}/meshes/")
    path = folder / f"{table.name}.sdf"
    write(made, path)
    about = ET.Element("package", format="2")
    child(about, "name", package)
    write(about, folder / "package.xml")
    return path


def drake_unsaid(mechanism: Mechanism) -> tuple[str, ...]:
    """What Drake's SDFormat cannot say of a machine, one sentence each."""
    table = links_of(mechanism)
    said = []
    if table.cuts or any(e.follows is not None for e in table.tree):
        said.append(
            "Drake holds ball constraints and mimics in a discrete plant with the SAP solver alone "
            "(discrete_contact_approximation 'sap')."
        )
    said += distance_words(table)
    if any(e.kind == "spherical" for e in (*table.tree, *table.cuts)):
        said.append("Drake's ball has no limits: the cones of the machine's balls are left out.")
    if any(e.drive is not None and e.drive.kind == "velocity" for e in table.tree):
        said.append("Drake's models have no velocity drive: motors are actuators that take a torque.")
    return (*said, *still_words(table))


def _document(table: LinkTable, shapes: Shapes, meshes: str) -> ET.Element:
    top = ET.Element("sdf", {"version": "1.9", "xmlns:drake": "http://drake.mit.edu"})
    model = child(top, "model", name=table.name, canonical_link=table.links[0].name)
    add_links(model, table, shapes, meshes, contact=False)
    add_frames(model, table)
    for one in table.tree:
        made = add_joint(model, one, table)
        if one.drive is not None and one.drive.kind == "position":
            gains = {"p": text(one.drive.stiffness), "d": text(one.drive.damping)}
            child(made, "drake:controller_gains", **gains)
        if one.follows is not None:
            leader, ratio, offset = one.follows
            child(made, "drake:mimic", joint=leader, multiplier=text(ratio), offset=text(offset))
    for cut in table.cuts:
        if cut.kind != "distance":
            _constraints(model, cut, table)
    # The machine does not collide with itself, as in its USD file.
    group = child(model, "drake:collision_filter_group", name="machine")
    for link in table.links:
        child(group, "drake:member", link.name)
    child(group, "drake:ignored_collision_filter_group", "machine")
    return top


def _constraints(model: ET.Element, cut: Edge, table: LinkTable) -> None:
    origins = {link.name: link.origin for link in table.links}
    arms = [np.zeros(3)]
    if cut.kind == "fixed":
        axis = np.asarray(cut.axis)
        beside = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
        arms += [_ARM * axis, _ARM * beside / np.linalg.norm(beside)]
    for arm in arms:
        point = np.asarray(cut.anchor) + arm
        held = child(model, "drake:ball_constraint")
        child(held, "drake:ball_constraint_body_A", cut.parent)
        child(held, "drake:ball_constraint_body_B", cut.child)
        child(held, "drake:ball_constraint_p_AP", row(minus(point, origins[cut.parent])))
        child(held, "drake:ball_constraint_p_BQ", row(minus(point, origins[cut.child])))
