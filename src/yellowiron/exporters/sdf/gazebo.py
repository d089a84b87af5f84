"""SDFormat for Gazebo: a model folder (`model.sdf`, `model.config`, `meshes/`) with its loops closed by joints.

A joint that closes a loop gives its child link a second parent, which SDFormat allows. Gazebo's default engine,
dartsim, refuses such a joint and leaves the loop open (gz-physics, issue 25); so in `model_welds.sdf` the loops are
closed by welds that the `DetachableJoint` system makes: each cut pin is a light link on the one body, welded to the
other when the simulation begins.
"""

from __future__ import annotations

import math
from pathlib import Path
from xml.etree import ElementTree as ET

from yellowiron.exporters.assets import Assets, unique
from yellowiron.exporters.geometry import Geometry, read_geometry
from yellowiron.exporters.link_table import Edge, LinkTable, links_of, names_of
from yellowiron.exporters.ros.urdf import still_words
from yellowiron.exporters.sdf.model import KINDS, add_frames, add_joint, add_links, child, distance_words, write
from yellowiron.exporters.shapes import Shapes
from yellowiron.exporters.values import row, text
from yellowiron.model.mechanism import Mechanism

VERSION = "1.11"
"""Of SDFormat: the first whose axes may be led by others. Gazebo Harmonic reads it."""
_PIN_MASS, _PIN_INERTIA = 1.0, 1e-3
"""kg, kg·m² of a pin that is welded."""


def export_sdf(mechanism: Mechanism, geometry: Geometry | str | Path, folder: Path) -> Path:
    """Writes the model folder; returns the path of `model.sdf`. `geometry`: the machine's USD file, or what
    `read_geometry` made of one. Joint positions are 0 in the drawn pose; metres and radians.

    Raises `MechanismError` where the joints are no tree with cuts.
    """
    table = links_of(mechanism)
    shapes = read_geometry(geometry)
    (folder / "meshes").mkdir(parents=True, exist_ok=True)
    drawn = Shapes(shapes, Assets(folder / "meshes", form="obj"))
    for name, welds in (("model.sdf", False), ("model_welds.sdf", True)):
        if welds and not table.cuts:
            continue
        write(_document(table, drawn, welds), folder / name)
    config = ET.Element("model")
    child(config, "name", table.name)
    child(config, "version", "1.0")
    child(config, "sdf", "model.sdf", version=VERSION)
    child(config, "description", f"The {table.name} as yellowiron exported it.")
    write(config, folder / "model.config")
    return folder / "model.sdf"


def sdf_unsaid(mechanism: Mechanism) -> tuple[str, ...]:
    """What SDFormat or Gazebo cannot say of a machine, one sentence each."""
    table = links_of(mechanism)
    said = []
    if table.cuts:
        said.append(
            "Gazebo's default engine refuses the joints that close loops, which model.sdf has, and leaves them open; "
            "model_welds.sdf closes them by welds that its DetachableJoint system makes, not tried here in Gazebo."
        )
    said += distance_words(table)
    if any(e.kind == "spherical" for e in (*table.tree, *table.cuts)):
        said.append("SDFormat's ball has no limits: the cones of the machine's balls are left out.")
    if any(e.follows is not None for e in table.tree):
        said.append("What follows another joint is a mimic axis; engines that have none leave it loose.")
    return (*said, *still_words(table))


def _document(table: LinkTable, shapes: Shapes, welds: bool) -> ET.Element:
    top = ET.Element("sdf", version=VERSION)
    model = child(top, "model", name=table.name, canonical_link=table.links[0].name)
    child(model, "self_collide", "false")
    add_links(model, table, shapes, "meshes/", contact=True)
    add_frames(model, table)
    for one in table.tree:
        made = add_joint(model, one, table)
        axis = made.find("axis")
        if one.follows is not None and axis is not None:
            leader, ratio, offset = one.follows
            mimic = child(axis, "mimic", joint=leader)
            child(mimic, "multiplier", text(ratio))
            child(mimic, "offset", text(offset))
            child(mimic, "reference", "0")
            # SDFormat's schema has it before the limits.
            axis.remove(mimic)
            axis.insert(1, mimic)
    taken = names_of(table)
    for cut in table.cuts:
        if cut.kind in KINDS:
            if welds:
                _weld(model, cut, taken)
            else:
                add_joint(model, cut, table)
    for one in table.tree:
        if one.name in table.given and one.drive is not None:
            _controller(model, one)
    state = child(model, "plugin", filename="gz-sim-joint-state-publisher-system")
    state.set("name", "gz::sim::systems::JointStatePublisher")
    return top


def _controller(model: ET.Element, one: Edge) -> None:
    """A position drive is a PID without I, whose output is a force; a velocity drive sets the speed."""
    drive = one.drive
    assert drive is not None
    if drive.kind == "position":
        made = _plugin(model, "joint-position-controller", "JointPositionController")
        child(made, "joint_name", one.name)
        child(made, "p_gain", text(drive.stiffness))
        child(made, "i_gain", "0")
        child(made, "d_gain", text(drive.damping))
        if 0.0 < drive.max_force < math.inf:
            child(made, "cmd_max", text(drive.forces[1]))
            child(made, "cmd_min", text(-drive.forces[0]))
    else:
        child(_plugin(model, "joint-controller", "JointController"), "joint_name", one.name)


def _weld(model: ET.Element, cut: Edge, taken: set[str]) -> None:
    """The pin as a link on the cut's first body, held to its second one by a weld at run time."""
    pin = unique(f"{cut.name}_pin", taken)
    link = child(model, "link", name=pin)
    child(link, "pose", row((*cut.anchor, 0.0, 0.0, 0.0)))
    inertial = child(link, "inertial")
    child(inertial, "mass", text(_PIN_MASS))
    inertia = child(inertial, "inertia")
    for name in ("ixx", "iyy", "izz"):
        child(inertia, name, text(_PIN_INERTIA))
    joint = child(model, "joint", name=cut.name, type=KINDS[cut.kind])
    child(joint, "parent", cut.parent)
    child(joint, "child", pin)
    if cut.kind == "revolute":
        axis = child(joint, "axis")
        child(axis, "xyz", row(cut.axis))
        child(child(axis, "limit"), "effort", "0")
    weld = _plugin(model, "detachable-joint", "DetachableJoint")
    child(weld, "parent_link", pin)
    child(weld, "child_model", "__model__")
    child(weld, "child_link", cut.child)


def _plugin(model: ET.Element, file: str, name: str) -> ET.Element:
    made = child(model, "plugin", filename=f"gz-sim-{file}-system")
    made.set("name", f"gz::sim::systems::{name}")
    return made
