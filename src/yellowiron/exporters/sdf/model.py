"""The links and tree joints of an SDFormat model. Poses in the model's frame, which is the machine frame."""

from __future__ import annotations

import math
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

from yellowiron.exporters.link_table import Edge, Link, LinkTable
from yellowiron.exporters.shapes import Shape, Shapes
from yellowiron.exporters.values import minus, roll_pitch_yaw, row, srgb, text
from yellowiron.model.geometry import Floats

KINDS = {"fixed": "fixed", "revolute": "revolute", "prismatic": "prismatic", "spherical": "ball"}
"""Our joint types in SDFormat; a distance joint has none."""


def add_links(model: ET.Element, table: LinkTable, shapes: Shapes, meshes: str, *, contact: bool) -> None:
    """Every body as a link; meshes are at `meshes` + file name. `contact`: with Gazebo's friction of each shape."""
    for link in table.links:
        made = child(model, "link", name=link.name)
        child(made, "pose", row((*link.origin, 0.0, 0.0, 0.0)))
        _inertial(made, link)
        shift = minus(link.body.origin, link.origin)
        for shape in shapes.seen(link.body.name, shift):
            visual = _shape(made, "visual", shape, meshes)
            color = row((*(round(srgb(v), 6) for v in shape.color or (0.5, 0.5, 0.5)), 1.0))
            material = child(visual, "material")
            child(material, "ambient", color)
            child(material, "diffuse", color)
        for shape in shapes.touched(link.body.name, shift):
            collision = _shape(made, "collision", shape, meshes)
            if contact and shape.friction is not None:
                ode = child(child(child(collision, "surface"), "friction"), "ode")
                child(ode, "mu", text(shape.friction))
                child(ode, "mu2", text(shape.friction))


def add_frames(model: ET.Element, table: LinkTable) -> None:
    """Sites and sensors as frames attached to their links."""
    for frame in table.frames:
        made = child(model, "frame", name=frame.name, attached_to=frame.link)
        child(made, "pose", row((*frame.position, *roll_pitch_yaw(frame.axes))))


def add_joint(model: ET.Element, one: Edge, table: LinkTable) -> ET.Element:
    """A joint where its anchor is. Without a drive its effort is 0: nothing pushes it."""
    made = child(model, "joint", name=one.name, type=KINDS[one.kind])
    origin = next(link.origin for link in table.links if link.name == one.child)
    child(made, "pose", row((*minus(one.anchor, origin), 0.0, 0.0, 0.0)))
    child(made, "parent", one.parent)
    child(made, "child", one.child)
    if one.kind not in ("revolute", "prismatic"):
        return made
    axis = child(made, "axis")
    child(axis, "xyz", row(one.axis))
    limit = child(axis, "limit")
    if one.lower is not None and one.upper is not None:
        child(limit, "lower", text(one.lower))
        child(limit, "upper", text(one.upper))
    drive = one.drive
    if one.spring is not None:
        dynamics = child(axis, "dynamics")
        child(dynamics, "damping", text(one.spring.damping))
        child(dynamics, "spring_reference", text(one.spring.rest))
        child(dynamics, "spring_stiffness", text(one.spring.stiffness))
    elif drive is None:
        child(limit, "effort", "0")
    elif 0.0 < drive.strongest < math.inf:
        child(limit, "effort", text(drive.strongest))
    if drive is not None and 0.0 < drive.slowest < math.inf:
        child(limit, "velocity", text(drive.slowest))
    return made


def child(parent: ET.Element, tag: str, words: str | None = None, **attributes: str) -> ET.Element:
    """A new element under another, with a text."""
    made = ET.SubElement(parent, tag, attributes)
    made.text = words
    return made


def write(top: ET.Element, path: Path) -> None:
    """A document, the same bytes for the same elements."""
    ET.indent(top)
    path.write_bytes(ET.tostring(top, encoding="utf-8", xml_declaration=True) + b"\n")


def distance_words(table: LinkTable) -> list[str]:
    """A sentence about distance joints, where there are any."""
    names = [cut.name for cut in table.cuts if cut.kind == "distance"]
    return [f"SDFormat has no distance joint: left out: {', '.join(names)}."] if names else []


def _inertial(made: ET.Element, link: Link) -> None:
    inertial = child(made, "inertial")
    child(inertial, "pose", row((*minus(link.body.center_of_mass, link.origin), 0.0, 0.0, 0.0)))
    child(inertial, "mass", text(link.body.mass))
    inertia = 0.5 * (np.asarray(link.body.inertia) + np.asarray(link.body.inertia).T)
    entries = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
    section = child(inertial, "inertia")
    for name, at in entries.items():
        child(section, name, text(inertia[at]))


def _shape(link: ET.Element, tag: str, shape: Shape, meshes: str) -> ET.Element:
    made = child(link, tag, name=shape.name if tag == "collision" else f"{shape.name}_visual")
    child(made, "pose", row((*shape.matrix[:3, 3], *_turn(shape.matrix))))
    geometry = child(child(made, "geometry"), shape.kind)
    if shape.kind == "mesh":
        child(geometry, "uri", f"{meshes}{shape.file}")
    elif shape.kind == "box":
        child(geometry, "size", row(shape.size))
    else:
        child(geometry, "radius", text(shape.size[0]))
        if shape.kind != "sphere":
            child(geometry, "length", text(shape.size[1]))
    return made


def _turn(matrix: Floats) -> Floats:
    return roll_pitch_yaw(matrix[:3, :3])
