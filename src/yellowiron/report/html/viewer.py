"""The machine packed for the page's 3D view: meshes, joints, pose tables and what is known of every part.

The packing is read by `data/viewer.js`: gzip of a little-endian uint32 (the length of what follows), a JSON header
padded to a multiple of 8, and one block of binary in which the header's `[kind, offset, count]` entries point. The
same machine gives the same bytes.
"""

from __future__ import annotations

import base64
import gzip
import json
import math
import struct
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats, Mesh, Shape
from yellowiron.model.mechanism import Actuator, Joint, Mechanism
from yellowiron.model.poses import PoseTables
from yellowiron.report.html.pictures import YELLOW, body_colors
from yellowiron.report.html.sensors import views
from yellowiron.report.rows import in_rows
from yellowiron.report.words import titled

MOST_TRIANGLES = 700_000
"""Distinct triangles that keep a page under 8 MB; the smallest shapes beyond are not drawn, and the view says so."""
_SCRIPTS = ("viewer_pose.js", "viewer_draw.js", "viewer.js")
_STYLES = ("viewer.css",)


@dataclass(frozen=True)
class Viewer:
    """What the page inlines: `data`, base64 of the packing, `script`, which decodes and shows it, and its `style`."""

    data: str
    script: str
    style: str


def viewer(
    mechanism: Mechanism,
    assembly: Assembly,
    alignment: Alignment,
    tables: PoseTables,
    *,
    poses: Mapping[str, Mapping[str, Floats]] | None = None,
) -> Viewer | None:
    """The 3D view of a machine, None where it has nothing to see. `poses` (caption → body → (4, 4) displacement) become
    buttons that set the sliders."""
    binary = _Binary()
    colors = body_colors(mechanism)
    parts, shapes, left_out = _parts(mechanism, assembly, alignment, binary)
    if not parts:
        return None
    tilting = {m.quantity.get("site") for m in mechanism.measurements if m.quantity.get("kind") == "angle"}
    header = {
        "root": mechanism.root,
        "bodies": [{"name": b.name, "color": _rgb(colors[b.name])} for b in mechanism.bodies],
        "parts": parts,
        "shapes": shapes,
        "leftOut": left_out,
        "joints": [_joint(joint, tables) for joint in mechanism.joints],
        "tables": [
            {
                "drivers": table.drivers,
                "axes": [[float(axis[0]), float(axis[-1]), len(axis)] for axis in table.axes],
                "dependent": table.dependent,
                "values": binary.add(table.values.astype("<f4")),
            }
            for table in tables.tables
        ],
        "sliders": _sliders(mechanism, tables),
        "readouts": _readouts(mechanism, tables),
        "sensors": _sensors(mechanism),
        "sites": [
            {"name": s.name, "body": s.body, "at": s.position, "x": s.x_axis, "tilts": s.name in tilting}
            for s in mechanism.sites
        ],
        "poses": [
            {"name": caption, "at": _coordinates(mechanism, tables, displacement)}
            for caption, displacement in (poses or {}).items()
        ],
    }
    text = json.dumps(header, separators=(",", ":"), sort_keys=True, ensure_ascii=False).encode("utf-8")
    text += b" " * (-(4 + len(text)) % 8)
    packed = gzip.compress(struct.pack("<I", len(text)) + text + binary.bytes(), compresslevel=9, mtime=0)
    folder = resources.files("yellowiron.report").joinpath("data")
    script, style = (
        "".join(folder.joinpath(name).read_text(encoding="utf-8") for name in names) for names in (_SCRIPTS, _STYLES)
    )
    return Viewer(base64.b64encode(packed).decode("ascii"), script, style)


class _Binary:
    """Arrays one after the other, each aligned to 8 bytes."""

    def __init__(self) -> None:
        self._pieces: list[bytes] = []
        self._length = 0

    def add(self, array: NDArray[Any]) -> list[Any]:
        """Appends an array; returns its kind, offset in bytes and number of elements."""
        entry = [array.dtype.kind + str(8 * array.dtype.itemsize), self._length, int(array.size)]
        piece = np.ascontiguousarray(array).tobytes()
        piece += b"\0" * (-len(piece) % 8)
        self._pieces.append(piece)
        self._length += len(piece)
        return entry

    def bytes(self) -> bytes:
        return b"".join(self._pieces)


def _parts(
    mechanism: Mechanism, assembly: Assembly, alignment: Alignment, binary: _Binary
) -> tuple[list[dict[str, Any]], list[dict[str, Any]], int]:
    """Every drawn part, the shapes that they share, and how many parts are left out for their size."""
    frame = np.asarray(alignment.frame, dtype=np.float64)
    assigned = {a.part: a for a in alignment.parts}
    review = set(alignment.to_review)
    by_id = {p.id: p for p in assembly.parts}
    wanted = [(index, bp, by_id[bp.part]) for index, body in enumerate(mechanism.bodies) for bp in body.parts]
    numbers = _largest(assembly, list(dict.fromkeys(part.shape for _, _, part in wanted)))
    parts = []
    for body, body_part, part in wanted:
        if part.shape not in numbers:
            continue
        shape = assembly.shape_of(part)
        entry = assigned.get(part.id)
        place = frame @ part.transform
        parts.append(
            {
                "name": part.id.rsplit("/", 1)[-1],
                "path": part.id,
                "body": body,
                "shape": numbers[part.shape],
                "place": [float(f"{x:.7g}") for x in place[:3].T.reshape(-1)],
                "color": _rgb(part.color or shape.color or YELLOW),
                "role": (entry.role if entry else body_part.role) or "",
                "confidence": round(entry.confidence, 2) if entry else None,
                "reason": entry.reason if entry else "",
                "review": part.id in review,
            }
        )
    shapes = [_mesh(assembly.shapes[key].mesh, binary) for key in numbers]
    return parts, shapes, len(wanted) - len(parts)


def _largest(assembly: Assembly, keys: Sequence[str]) -> dict[str, int]:
    """Shape → its number, in the given order, without the smallest ones beyond the budget of triangles."""

    def size(shape: Shape) -> float:
        return float(np.linalg.norm(np.ptp(shape.mesh.points, axis=0))) if len(shape.mesh.points) else 0.0

    budget = MOST_TRIANGLES
    kept: set[str] = set()
    for key in sorted(keys, key=lambda each: -size(assembly.shapes[each])):
        budget -= len(assembly.shapes[key].mesh.triangles)
        if budget < 0 and kept:
            break
        if len(assembly.shapes[key].mesh.triangles):
            kept.add(key)
    return {key: number for number, key in enumerate(key for key in keys if key in kept)}


def _mesh(mesh: Mesh, binary: _Binary) -> dict[str, Any]:
    """A mesh quantised to its own box: positions to 16 bits (planes of differences, which pack well), normals to two
    bytes (octahedral), indices as differences."""
    points = np.asarray(mesh.points, dtype=np.float64)
    low = points.min(axis=0)
    size = np.maximum(points.max(axis=0) - low, 1e-9)
    grid = np.rint((points - low) / size * 65535.0).astype(np.int64)
    steps = np.diff(grid, axis=0, prepend=np.zeros((1, 3), dtype=np.int64))
    indices = np.asarray(mesh.triangles, dtype=np.int64).reshape(-1)
    jumps = np.diff(indices, prepend=0)
    narrow = len(points) <= 65536
    return {
        "low": [float(f"{x:.7g}") for x in low],
        "size": [float(f"{x:.7g}") for x in size],
        "points": binary.add((steps.T % 65536).astype("<u2")),
        "indices": binary.add((jumps % 65536).astype("<u2") if narrow else jumps.astype("<i4")),
        "normals": None if mesh.normals is None else binary.add(_octahedral(mesh.normals).T.astype("i1")),
    }


def _octahedral(normals: Floats) -> NDArray[np.int64]:
    """Unit vectors (n, 3) as two signed bytes (n, 2): the octahedron unfolded (Cigolle et al., JCGT 2014)."""
    n = np.asarray(normals, dtype=np.float64)
    n = n / np.maximum(np.abs(n).sum(axis=1, keepdims=True), 1e-12)
    folded = (1.0 - np.abs(n[:, [1, 0]])) * np.where(n[:, :2] >= 0.0, 1.0, -1.0)
    return np.rint(127.0 * np.where(n[:, 2:] >= 0.0, n[:, :2], folded)).astype(np.int64)


def _srgb(linear: Floats | Sequence[float]) -> NDArray[np.int64]:
    """Linear RGB as display bytes, as in the pictures."""
    return np.rint(255.0 * np.clip(np.asarray(linear, dtype=np.float64), 0.0, 1.0) ** (1.0 / 2.2)).astype(np.int64)


def _rgb(linear: Sequence[float]) -> list[int]:
    return [int(value) for value in _srgb(linear)]


def _joint(joint: Joint, tables: PoseTables) -> dict[str, Any]:
    return {
        "name": joint.name,
        "type": joint.type,
        "parent": joint.body0,
        "child": joint.body1,
        "anchor": joint.anchor,
        "axis": joint.axis,
        "cut": joint.cut,
        "free": joint.free,
        "straight": tables.straight.get(joint.name, 0.0),
    }


def _sliders(mechanism: Mechanism, tables: PoseTables) -> list[dict[str, Any]]:
    """One for each cylinder actuator that has a table, for each other actuator, and for each free joint besides."""
    return [*_actuator_sliders(mechanism, tables), *_free_sliders(mechanism, tables)]


def _actuator_sliders(mechanism: Mechanism, tables: PoseTables) -> Iterator[dict[str, Any]]:
    cylinders = {cylinder.slide: cylinder for cylinder in mechanism.cylinders}
    tabled = {driver for table in tables.tables for driver in table.drivers}
    for actuator in mechanism.actuators:
        moved = [entry for entry in actuator.joints if entry.joint in tables.independent]
        # Without a table, a coupled joint would tear its loop open.
        if not moved or (actuator.kind == "cylinder" and moved[0].joint not in tabled):
            continue
        cylinder = cylinders.get(moved[0].joint)
        yield {
            **_slider(actuator.name, mechanism.joint(moved[0].joint), moved[0].sign),
            "joints": [[entry.joint, entry.sign * moved[0].sign] for entry in _together(actuator, moved)],
            "extension": cylinder.extension if cylinder and math.isfinite(cylinder.extension) else None,
            "stroke": cylinder.stroke if cylinder else None,
        }


def _free_sliders(mechanism: Mechanism, tables: PoseTables) -> Iterator[dict[str, Any]]:
    """Of the independent joints that no actuator moves."""
    joints = {joint.name: joint for joint in mechanism.joints}
    taken = {entry.joint for actuator in mechanism.actuators for entry in actuator.joints}
    # A roller or shoe of a counted row is nothing to set by hand.
    rows = {mechanism.joints[p].name for places in in_rows(list(joints)).values() if len(places) > 1 for p in places}
    hung = Counter(body for joint in mechanism.joints for body in (joint.body0, joint.body1))
    # What cannot be seen and carries nothing, such as a hidden wheel of a track, is nothing to turn.
    unseen = {body.name for body in mechanism.bodies if not body.parts and hung[body.name] < 2}
    for name in tables.independent:
        if unseen & {joints[name].body0, joints[name].body1}:
            continue
        if name not in taken and name not in rows and joints[name].type in ("revolute", "prismatic"):
            yield {**_slider(name, joints[name], 1), "joints": [[name, 1]], "extension": None, "stroke": None}


def _together(actuator: Actuator, moved: Sequence[Any]) -> Sequence[Any]:
    """A motor turns all its joints; of a cylinder pair only the driven slide is given."""
    return moved if actuator.kind == "motor" else moved[:1]


def _slider(name: str, joint: Joint, sign: int) -> dict[str, Any]:
    lower, upper = (-np.pi, np.pi) if joint.lower is None or joint.upper is None else (joint.lower, joint.upper)
    return {
        "name": name,
        "title": titled(name),
        "unit": "m" if joint.type == "prismatic" else "rad",
        "range": [lower, upper],
        "sign": sign,
    }


def _sensors(mechanism: Mechanism) -> list[dict[str, Any]]:
    """Where each sensor sits, and the outlines of what it sees, in the drawn pose."""
    joints = {joint.name: joint for joint in mechanism.joints}
    hulls = [np.asarray(body.hull) for body in mechanism.bodies if len(body.hull)]
    size = float(np.linalg.norm(np.ptp(np.concatenate(hulls), axis=0))) if hulls else 1.0
    made = []
    for sensor in mechanism.sensors:
        joint = joints.get(sensor.joint)
        if not sensor.body and joint is None:
            continue
        made.append(
            {
                "name": sensor.name,
                "type": sensor.type,
                "body": sensor.body or (joint.body0 if joint else ""),
                "at": sensor.position if sensor.body or joint is None else joint.anchor,
                "views": [
                    [kind, [float(f"{x:.5g}") for x in outline.reshape(-1)]]
                    for kind, outline in views([asdict(sensor)], size)
                ],
            }
        )
    return made


def _readouts(mechanism: Mechanism, tables: PoseTables) -> list[str]:
    """Pivots of the loops that are no cylinder's own pin and in no counted row: they say how the machine stands."""
    pins = {name for cylinder in mechanism.cylinders for name in (cylinder.barrel_joint, cylinder.rod_joint)}
    names = [joint.name for joint in mechanism.joints]
    pins |= {names[p] for places in in_rows(names).values() if len(places) > 1 for p in places}
    return [j.name for j in mechanism.joints if j.name in tables.straight and j.name not in pins]


def _coordinates(
    mechanism: Mechanism, tables: PoseTables, displacement: Mapping[str, Floats]
) -> list[tuple[str, float]]:
    """The given coordinates of a pose, read back from where the bodies are."""
    found = []
    tabled = {driver for table in tables.tables for driver in table.drivers}
    for joint in mechanism.joints:
        if joint.name in tabled and joint.type == "prismatic":
            relative = np.linalg.inv(displacement[joint.body0]) @ displacement[joint.body1]
            found.append((joint.name, float(relative[:3, 3] @ np.asarray(joint.axis))))
    return found
