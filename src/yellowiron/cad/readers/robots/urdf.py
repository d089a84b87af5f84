"""A URDF file with its meshes to an `Assembly`. Runs in the guard's child process.

What is drawn is what becomes parts; what only collides stands in where nothing is drawn. Every link is an assembly in
the tree, at its pose with every joint at zero; the joints are kept as the file declares them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from yellowiron.cad.mesh import assembly, polygons
from yellowiron.cad.mesh.assembly import Occurrence
from yellowiron.cad.naming import decode_name
from yellowiron.cad.readers.declared import declared_joint
from yellowiron.cad.readers.robots.mesh_files import loose_meshes
from yellowiron.model.assembly import Assembly, DeclaredJoint
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Mesh
from yellowiron.support.text import with_article

_DAMAGED = "Check the file with the program that made it."
_JOINTS = {"fixed": "fixed", "revolute": "revolute", "continuous": "revolute", "prismatic": "prismatic"}
_JOINTS |= {"floating": "free", "planar": "planar"}


def read_urdf(path: str) -> Assembly:
    """The assembly in a URDF file, in metres; meshes are looked for beside it, and `package://` in the folders above.

    `CadError` if it is no URDF, its tree is broken, or nothing is drawn.
    """
    try:
        root = ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        raise CadError(f"The URDF file is broken: {error}", where=path, hint=_DAMAGED) from error
    if root.tag != "robot":
        words = f"This is not a URDF file: its root is '{root.tag}'"
        raise CadError(words, where=path, hint="Where it is a xacro file, run xacro on it first.")
    findings: list[Finding] = []
    poses, joints = _tree(root, path)
    colors = {m.get("name", ""): _rgba(m) for m in root.iterfind("material")}
    known: dict[Path, list[tuple[str, Mesh, Color | None]]] = {}
    occurrences: list[Occurrence] = []
    declared = 0
    for link in root.iterfind("link"):
        name = decode_name(link.get("name", ""), "utf-8") or "link"
        visuals = list(link.iterfind("visual")) or list(link.iterfind("collision"))
        declared += len(visuals)
        for visual in visuals:
            color = _material(visual, colors)
            place = poses[link.get("name", "")] @ _origin(visual, path)
            for title, mesh, own in _geometry(visual, path, known, findings):
                label = decode_name(visual.get("name", ""), "utf-8") or title or name
                occurrences.append(Occurrence(label, (name,), mesh, place, color or own))
    read = assembly.assemble(
        occurrences, name=root.get("name") or Path(path).stem, format="URDF", unit=1.0, path=path, findings=findings,
        declared=declared,
    )  # fmt: skip
    return replace(read, joints=tuple(joints))


def _tree(root: ElementTree.Element, path: str) -> tuple[dict[str, Floats], list[DeclaredJoint]]:
    """(4, 4) poses of all links with every joint at zero, and the joints in that pose."""
    links = [link.get("name", "") for link in root.iterfind("link")]
    arms: dict[str, list[ElementTree.Element]] = {}
    children = set()
    for joint in root.iterfind("joint"):
        parent, child = (_one(joint, end, path).get("link", "") for end in ("parent", "child"))
        if parent not in links or child not in links or child in children:
            words = f"The URDF tree is broken at joint '{joint.get('name')}'"
            raise CadError(words, where=path, hint="Every link has one parent, and both links of a joint exist.")
        children.add(child)
        arms.setdefault(parent, []).append(joint)
    poses: dict[str, Floats] = {}
    joints: list[DeclaredJoint] = []
    stack = [(name, np.eye(4)) for name in links if name not in children]
    while stack:
        name, pose = stack.pop()
        poses[name] = pose
        for joint in arms.get(name, []):
            child = _one(joint, "child", path).get("link", "")
            here = pose @ _origin(joint, path)
            joints.append(_declared(joint, name, child, here, path))
            stack.append((child, here))
    if len(poses) < len(links):
        raise CadError("The URDF tree is broken: links go round in a circle", where=path, hint=_DAMAGED)
    return poses, joints


def _declared(joint: ElementTree.Element, parent: str, child: str, pose: Floats, path: str) -> DeclaredJoint:
    kind = joint.get("type", "")
    if kind not in _JOINTS:
        raise CadError(f"Joint '{joint.get('name')}' is of no known type: '{kind}'", where=path, hint=_DAMAGED)
    entry, limit = joint.find("axis"), joint.find("limit")
    axis = pose[:3, :3] @ (_numbers(entry, "xyz", path) if entry is not None else np.array([1.0, 0.0, 0.0]))
    bounds: list[float | None] = [None, None]
    if limit is not None and kind in ("revolute", "prismatic"):
        bounds = [float(_number(limit.get(end, "0"), path)) for end in ("lower", "upper")]
    ends = (bounds[0], bounds[1])
    return declared_joint(joint.get("name", ""), _JOINTS[kind], (parent, child), pose[:3, 3], axis, ends)


def _geometry(
    visual: ElementTree.Element,
    path: str,
    known: dict[Path, list[tuple[str, Mesh, Color | None]]],
    findings: list[Finding],
) -> Iterator[tuple[str, Mesh, Color | None]]:
    """Names, meshes (metres, in the visual's frame) and colours of what a visual draws."""
    shape = visual.find("geometry")
    entry = next(iter(shape), None) if shape is not None else None
    if entry is None:
        return
    if entry.tag == "box":
        yield "", polygons.box(_numbers(entry, "size", path)), None
    elif entry.tag in ("cylinder", "capsule"):
        make = polygons.cylinder if entry.tag == "cylinder" else polygons.capsule
        yield "", make(*(_number(entry.get(k, "0"), path) for k in ("radius", "length"))), None
    elif entry.tag == "sphere":
        yield "", polygons.ball(_number(entry.get("radius", "0"), path)), None
    elif entry.tag == "mesh":
        name = entry.get("filename", "")
        file = _found(name, Path(path))
        if file is None:
            findings.append(
                Finding("CAD008", "error", name, "A mesh of the robot is missing", "Put it where the URDF file says.")
            )
            return
        scale = _numbers(entry, "scale", path) if entry.get("scale") else np.ones(3)
        if file not in known:
            known[file] = loose_meshes(file, findings)
        for title, mesh, color in known[file]:
            yield title, _scaled(mesh, scale), color


def _found(name: str, robot: Path) -> Path | None:
    """The file that a mesh's name stands for: where it says, or in a package in one of the folders above the robot's,
    or beside it."""
    folder = robot.absolute().parent
    text = name.removeprefix("file://")
    if "://" in text and not text.startswith("package://"):
        return None
    if not text.startswith("package://"):
        candidate = folder / text
        return candidate if candidate.is_file() else None
    inside = Path(text.removeprefix("package://"))
    for above in (folder, *folder.parents):
        for part in (inside, Path(*inside.parts[1:])):
            if part.parts and (above / part).is_file():
                return above / part
    # Downloaded without its package's folders.
    beside = folder / inside.name
    return beside if beside.is_file() else None


def _scaled(mesh: Mesh, scale: Floats) -> Mesh:
    triangles = mesh.triangles[:, ::-1] if np.prod(scale) < 0.0 else mesh.triangles
    return Mesh(mesh.points * scale, triangles, None, mesh.triangle_colors)


def _material(visual: ElementTree.Element, colors: Mapping[str, Color | None]) -> Color | None:
    entry = visual.find("material")
    if entry is None:
        return None
    return _rgba(entry) or colors.get(entry.get("name", ""))


def _rgba(entry: ElementTree.Element) -> Color | None:
    found = entry.find("color")
    try:
        values = [min(max(float(v), 0.0), 1.0) for v in (found.get("rgba", "") if found is not None else "").split()]
    except ValueError:
        return None
    return (values[0], values[1], values[2]) if len(values) >= 3 else None


def _origin(entry: ElementTree.Element, path: str) -> Floats:
    """(4, 4) of an `origin`: xyz, and roll, pitch, yaw about fixed axes."""
    found = entry.find("origin")
    matrix = np.eye(4)
    if found is not None:
        if found.get("xyz"):
            matrix[:3, 3] = _numbers(found, "xyz", path)
        if found.get("rpy"):
            r, p, y = _numbers(found, "rpy", path)
            matrix[:3, :3] = _turn(2, y) @ _turn(1, p) @ _turn(0, r)
    return matrix


def _turn(axis: int, angle: float) -> Floats:
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = math.cos(angle)
    matrix[j, i], matrix[i, j] = math.sin(angle), -math.sin(angle)
    return matrix


def _numbers(entry: ElementTree.Element, key: str, path: str) -> Floats:
    values = [_number(v, path) for v in (entry.get(key) or "").split()]
    if len(values) != 3:
        raise CadError(
            f"'{key}' of {with_article(entry.tag)} in the robot has not three numbers", where=path, hint=_DAMAGED
        )
    return np.array(values)


def _number(text: str, path: str) -> float:
    try:
        return float(text)
    except ValueError as error:
        raise CadError(f"'{text[:40]}' in the robot is no number", where=path, hint=_DAMAGED) from error


def _one(entry: ElementTree.Element, name: str, path: str) -> ElementTree.Element:
    found = entry.find(name)
    if found is None:
        raise CadError(f"Joint '{entry.get('name')}' has no {name}", where=path, hint=_DAMAGED)
    return found
