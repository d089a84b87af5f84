"""URDF as a ROS 2 description package: the tree with meshes and `ros2_control`, and beside it the joints that loops
determine (`joints.json`, `joint_states.py`).

    DIR/package.xml, CMakeLists.txt          the package <machine>_description
    DIR/urdf/<machine>.urdf                  links, joints, meshes as package://…, ros2_control
    DIR/meshes/*.stl, *.obj                  what is seen, what collides
    DIR/scripts/joints.json, joint_states.py strokes → positions of every joint
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

from yellowiron.exporters.assets import Assets
from yellowiron.exporters.geometry import Geometry, read_geometry
from yellowiron.exporters.link_table import Edge, Link, LinkTable, joints_document, links_of, with_pivots
from yellowiron.exporters.shapes import Shape, Shapes
from yellowiron.exporters.values import minus, roll_pitch_yaw, row, srgb, text
from yellowiron.model.geometry import Color, Floats
from yellowiron.model.mechanism import Body, Mechanism
from yellowiron.support.text import to_json

BASE = "base_link"
"""The root link: the machine frame, without mass, as the KDL tree of `robot_state_publisher` wants it."""
_FAR = 1e3
"""Metres or rad/s where URDF asks for a number and there is none."""
_PIVOT_MASS, _PIVOT_INERTIA = 1e-3, 1e-6
"""kg, kg·m² of the links between the three pivots of a ball: engines take no moving link without."""


def export_urdf(mechanism: Mechanism, geometry: Geometry | str | Path, folder: Path) -> Path:
    """Writes the description package into a folder; returns the URDF's path. `geometry`: the machine's USD file, or
    what `read_geometry` made of one. Joint positions are 0 in the drawn pose; metres and radians.

    Raises `MechanismError` where the joints are no tree with cuts.
    """
    table = links_of(mechanism)
    shapes = read_geometry(geometry)
    package = package_name(table.name)
    # STL takes the colour that the document says in every viewer; Drake takes hulls from OBJ alone.
    hulls = Assets(folder / "meshes", form="obj")
    robot = _Robot(
        table, Shapes(shapes, Assets(folder / "meshes"), hulls=hulls), f"package://{package}/meshes/"
    ).element()
    path = folder / "urdf" / f"{table.name}.urdf"
    for part in ("urdf", "meshes", "scripts"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    ET.indent(robot)
    path.write_bytes(ET.tostring(robot, encoding="utf-8", xml_declaration=True) + b"\n")
    (folder / "scripts" / "joints.json").write_text(to_json(joints_document(table)), encoding="utf-8")
    script = Path(__file__).with_name("joint_states.py").read_text(encoding="utf-8")
    (folder / "scripts" / "joint_states.py").write_text(script + _MAIN, encoding="utf-8")
    (folder / "package.xml").write_text(_PACKAGE.format(package=package, machine=table.name), encoding="utf-8")
    (folder / "CMakeLists.txt").write_text(_CMAKE.format(package=package), encoding="utf-8")
    return path


def urdf_unsaid(mechanism: Mechanism) -> tuple[str, ...]:
    """What URDF cannot say of a machine, one sentence each."""
    table = links_of(mechanism)
    said: list[str] = []
    if table.cuts:
        names = ", ".join(cut.name for cut in table.cuts)
        said.append(f"URDF has no loops: these pins are cut, and joint_states.py closes them: {names}.")
    balls = [e.name for e in table.tree if e.kind == "spherical"]
    if balls:
        said.append(f"URDF has no ball: each is three pivots (pitch, roll, yaw), without its cone: {', '.join(balls)}.")
    endless = [e.name for e in table.tree if e.kind == "prismatic" and (e.lower is None or e.upper is None)]
    if endless:
        said.append(f"URDF's slides need ends: {_FAR:g} m to either side for {', '.join(endless)}.")
    said += still_words(table)
    springs = [e.name for e in table.tree if e.spring is not None]
    if springs:
        said.append(f"URDF has no springs: their damping alone is written, of {', '.join(springs)}.")
    if any(e.drive is not None for e in table.tree):
        said.append("URDF has no gains and no friction of materials: the drives' stiffness and damping are left out.")
    return tuple(said)


def still_words(table: LinkTable) -> list[str]:
    """A sentence about chains that stay with the root, where there are any."""
    if not table.still:
        return []
    return [f"The {len(table.still)} links of its tracks' rings are fixed to {table.links[0].name} as drawn."]


def package_name(machine: str) -> str:
    """The name of a machine's ROS package: lower case letters, digits and single underscores, a letter first."""
    name = re.sub(r"[^a-z0-9]+", "_", machine.lower()).strip("_")
    return f"{name if name[:1].isalpha() else f'machine_{name}'}_description"


class _Robot:
    def __init__(self, table: LinkTable, shapes: Shapes, meshes: str) -> None:
        self._table = table
        self._shapes = shapes
        self._meshes = meshes
        self._colors: dict[Color, str] = {}
        self._tree, self._balls = with_pivots(table)
        self._origins: dict[str, tuple[float, ...]] = {BASE: (0.0, 0.0, 0.0)}
        self._origins |= {link.name: link.origin for link in table.links}
        for one in self._tree:
            self._origins.setdefault(one.child, one.anchor)

    def element(self) -> ET.Element:
        robot = ET.Element("robot", name=self._table.name)
        root = self._table.links[0]
        links = [ET.Element("link", name=BASE), *(self._link(link) for link in self._table.links)]
        known = {link.name for link in self._table.links}
        links += [_pivot_link(e.child) for e in self._tree if e.child not in known]
        for color, name in self._colors.items():
            made = ET.SubElement(robot, "material", name=name)
            ET.SubElement(made, "color", rgba=row((*(round(srgb(v), 6) for v in color), 1.0)))
        robot.extend(links)
        robot.append(self._joint(Edge(f"{BASE}_joint", "", "fixed", BASE, root.name, root.origin, (0.0, 0.0, 1.0))))
        robot.extend(self._joint(one) for one in self._tree)
        for frame in self._table.frames:
            ET.SubElement(robot, "link", name=frame.name)
            mount = ET.SubElement(robot, "joint", name=f"{frame.name}_mount", type="fixed")
            mount.append(_origin(frame.position, frame.axes))
            ET.SubElement(mount, "parent", link=frame.link)
            ET.SubElement(mount, "child", link=frame.name)
        control = self._control()
        if control is not None:
            robot.append(control)
        return robot

    def _link(self, link: Link) -> ET.Element:
        made = ET.Element("link", name=link.name)
        made.append(_inertial(link.body, minus(link.body.center_of_mass, link.origin)))
        shift = minus(link.body.origin, link.origin)
        for shape in self._shapes.seen(link.body.name, shift):
            color = self._colors.setdefault(shape.color or (0.5, 0.5, 0.5), f"color_{len(self._colors) + 1}")
            visual = self._shape("visual", shape)
            ET.SubElement(visual, "material", name=color)
            made.append(visual)
        made.extend(self._shape("collision", s) for s in self._shapes.touched(link.body.name, shift, capsules=False))
        return made

    def _shape(self, tag: str, shape: Shape) -> ET.Element:
        made = ET.Element(tag, name=shape.name)
        made.append(_origin(shape.matrix[:3, 3], shape.matrix[:3, :3]))
        geometry = ET.SubElement(made, "geometry")
        if shape.kind == "mesh":
            ET.SubElement(geometry, "mesh", filename=f"{self._meshes}{shape.file}")
        elif shape.kind == "box":
            ET.SubElement(geometry, "box", size=row(shape.size))
        elif shape.kind == "sphere":
            ET.SubElement(geometry, "sphere", radius=text(shape.size[0]))
        else:
            ET.SubElement(geometry, "cylinder", radius=text(shape.size[0]), length=text(shape.size[1]))
        return made

    def _joint(self, one: Edge) -> ET.Element:
        bounded = one.lower is not None and one.upper is not None
        kind = "continuous" if one.kind == "revolute" and not bounded else one.kind
        made = ET.Element("joint", name=one.name, type=kind)
        made.append(_origin(minus(one.anchor, self._origins[one.parent])))
        ET.SubElement(made, "parent", link=one.parent)
        ET.SubElement(made, "child", link=one.child)
        if kind == "fixed":
            return made
        ET.SubElement(made, "axis", xyz=row(one.axis))
        drive = one.drive
        # One limit both ways: the stronger one's force, the slower one's speed.
        limit = {
            "effort": text(drive.strongest if drive is not None and math.isfinite(drive.strongest) else 0.0),
            "velocity": text(drive.slowest if drive is not None and 0.0 < drive.slowest < math.inf else _FAR),
        }
        if kind != "continuous":
            low, high = (one.lower, one.upper) if bounded else (-_FAR, _FAR)
            limit = {"lower": text(low or 0.0), "upper": text(high or 0.0), **limit}
        ET.SubElement(made, "limit", limit)
        if one.spring is not None:
            ET.SubElement(made, "dynamics", damping=text(one.spring.damping))
        if one.follows is not None:
            leader, ratio, offset = one.follows
            ET.SubElement(made, "mimic", joint=leader, multiplier=text(ratio), offset=text(offset))
        return made

    def _control(self) -> ET.Element | None:
        """Command interfaces by the kind of drive; what loops determine has none and is not listed."""
        driven = [e for e in self._tree if e.drive is not None and e.follows is None and e.name in self._table.given]
        if not driven:
            return None
        made = ET.Element("ros2_control", name=self._table.name, type="system")
        hardware = ET.SubElement(made, "hardware")
        ET.SubElement(hardware, "plugin").text = "mock_components/GenericSystem"
        for one in driven:
            drive = one.drive
            assert drive is not None
            joint = ET.SubElement(made, "joint", name=one.name)
            command = ET.SubElement(joint, "command_interface", name=drive.kind)
            ends: tuple[float | None, float | None] = (one.lower, one.upper)
            if drive.kind == "velocity":
                fast = drive.max_velocity if 0.0 < drive.max_velocity < math.inf else None
                ends = (-fast, fast) if fast is not None else (None, None)
            for name, value in zip(("min", "max"), ends, strict=True):
                if value is not None:
                    ET.SubElement(command, "param", name=name).text = text(value)
            position = ET.SubElement(joint, "state_interface", name="position")
            ET.SubElement(position, "param", name="initial_value").text = "0.0"
            ET.SubElement(joint, "state_interface", name="velocity")
        return made


def _origin(position: Floats, rotation: Floats | None = None) -> ET.Element:
    turn = roll_pitch_yaw(rotation) if rotation is not None else np.zeros(3)
    return ET.Element("origin", xyz=row(position), rpy=row(turn))


def _inertial(body: Body, center: Floats) -> ET.Element:
    made = ET.Element("inertial")
    made.append(_origin(center))
    ET.SubElement(made, "mass", value=text(body.mass))
    inertia = 0.5 * (np.asarray(body.inertia) + np.asarray(body.inertia).T)
    entries = {"ixx": (0, 0), "ixy": (0, 1), "ixz": (0, 2), "iyy": (1, 1), "iyz": (1, 2), "izz": (2, 2)}
    ET.SubElement(made, "inertia", {name: text(inertia[at]) for name, at in entries.items()})
    return made


def _pivot_link(name: str) -> ET.Element:
    made = ET.Element("link", name=name)
    inertial = ET.SubElement(made, "inertial")
    ET.SubElement(inertial, "mass", value=text(_PIVOT_MASS))
    round_ = dict.fromkeys(("ixy", "ixz", "iyz"), "0") | {n: text(_PIVOT_INERTIA) for n in ("ixx", "iyy", "izz")}
    ET.SubElement(inertial, "inertia", round_)
    return made


_MAIN = """

def main() -> None:
    \"\"\"Prints the joint positions at the strokes of the command line.\"\"\"
    try:
        strokes = {name: float(value) for name, _, value in (word.partition("=") for word in sys.argv[1:])}
        positions = JointStates(Path(__file__).with_name("joints.json")).positions(strokes)
    except (KeyError, ValueError) as error:
        sys.exit(str(error.args[0]))
    print(json.dumps(positions, indent=2))


if __name__ == "__main__":
    import sys

    main()
"""
"""What the script beside an export has besides the module: a command line."""
_PACKAGE = """<?xml version="1.0"?>
<package format="3">
  <name>{package}</name>
  <version>0.0.0</version>
  <description>The {machine} as yellowiron exported it.</description>
  <maintainer email="nobody@example.com">nobody</maintainer>
  <license>Proprietary</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <exec_depend>robot_state_publisher</exec_depend>
  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
"""
_CMAKE = """cmake_minimum_required(VERSION 3.8)
project({package} NONE)
find_package(ament_cmake REQUIRED)
install(DIRECTORY urdf meshes scripts DESTINATION share/${{PROJECT_NAME}})
ament_package()
"""
