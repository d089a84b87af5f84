"""The machine for the page's 3D view: meshes, joints, pose tables and what is known of every part."""

from __future__ import annotations

import base64
import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from importlib import resources
from typing import Any

import numpy as np

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Actuator, Joint, Mechanism
from yellowiron.model.poses import PoseTables
from yellowiron.report.html.packing import Binary, largest, mesh_entry, packed, rgb
from yellowiron.report.html.pictures import YELLOW, body_colors
from yellowiron.report.html.sensors import views
from yellowiron.report.rows import in_rows
from yellowiron.report.words import titled

MOST_TRIANGLES = 700_000
"""Distinct triangles; the smallest shapes beyond are not drawn, and the view says so."""
MOST_BYTES = 2_300_000
"""Of the packed machine, which keeps a page under 5 MB; what is more goes in the same way."""
NOT_BUNDLED = (
    "The 3D view was not bundled when yellowiron was installed: install it again where the npm registry can be reached."
)


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
    most, before = MOST_TRIANGLES, MOST_TRIANGLES + 1
    while (made := _packed(mechanism, assembly, alignment, tables, poses or {}, most=most)) is not None:
        data, drawn = made
        # The largest shape is drawn however large it is.
        if len(data) <= MOST_BYTES or drawn >= before:
            return Viewer(data, script("yellowiron.report", "viewer"), asset("viewer.css"))
        most, before = min(int(0.95 * drawn * MOST_BYTES / len(data)), drawn - 1), drawn
    return None


def _packed(
    mechanism: Mechanism,
    assembly: Assembly,
    alignment: Alignment,
    tables: PoseTables,
    poses: Mapping[str, Mapping[str, Floats]],
    *,
    most: int,
) -> tuple[str, int] | None:
    """A machine as base64, and how many distinct triangles are drawn of it; `most` is their budget."""
    binary = Binary()
    frame = np.asarray(alignment.frame, dtype=np.float64)
    assigned = {a.part: a for a in alignment.parts}
    review = set(alignment.to_review)
    by_id = {p.id: p for p in assembly.parts}
    wanted = [(index, bp, by_id[bp.part]) for index, body in enumerate(mechanism.bodies) for bp in body.parts]
    numbers = largest(assembly, list(dict.fromkeys(part.shape for _, _, part in wanted)), most=most)
    parts = [
        {
            **drawn_part(part, assembly, frame, numbers[part.shape]),
            "body": body,
            **assignment_entry(assigned.get(part.id), role=body_part.role, review=part.id in review),
        }
        for body, body_part, part in wanted
        if part.shape in numbers
    ]
    if not parts:
        return None
    shapes = [mesh_entry(assembly.shapes[key].mesh, binary) for key in numbers]
    header = {
        **machine_entry(mechanism, tables, binary, poses=poses),
        "parts": parts,
        "shapes": shapes,
        "leftOut": len(wanted) - len(parts),
    }
    drawn = sum(len(assembly.shapes[key].mesh.triangles) for key in numbers)
    return base64.b64encode(packed(header, binary)).decode("ascii"), drawn


def script(package: str, name: str) -> str:
    """The script of a page, which is made from `studio/` when the package is (`hatch_build.py`);
    empty where it was not."""
    file = resources.files(package).joinpath("data", f"{name}.bundle.js")
    return file.read_text(encoding="utf-8") if file.is_file() else ""


def asset(*names: str) -> str:
    """Files of `report/data`, one after the other."""
    folder = resources.files("yellowiron.report").joinpath("data")
    return "".join(folder.joinpath(name).read_text(encoding="utf-8") for name in names)


def machine_entry(
    mechanism: Mechanism,
    tables: PoseTables,
    binary: Binary,
    *,
    poses: Mapping[str, Mapping[str, Floats]] | None = None,
) -> dict[str, Any]:
    """A machine as the view takes it, but for its parts: bodies, joints, how they move, and what there is to set."""
    colors = body_colors(mechanism)
    tilting = {m.quantity.get("site") for m in mechanism.measurements if m.quantity.get("kind") == "angle"}
    return {
        "root": mechanism.root,
        "bodies": [{"name": b.name, "color": rgb(colors[b.name])} for b in mechanism.bodies],
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


def drawn_part(part: Part, assembly: Assembly, frame: Floats, shape: int) -> dict[str, Any]:
    """Where a part is, in the machine frame, and how it looks; `shape` is the number of its mesh."""
    place = frame @ part.transform
    return {
        "name": part.id.rsplit("/", 1)[-1],
        "path": part.id,
        "shape": shape,
        "place": [float(f"{x:.7g}") for x in place[:3].T.reshape(-1)],
        "color": rgb(part.color or assembly.shape_of(part).color or YELLOW),
    }


def assignment_entry(entry: PartAssignment | None, *, role: str | None = None, review: bool = False) -> dict[str, Any]:
    """What is known of a part; `role` is that of one of which the alignment says nothing."""
    return {
        "role": (entry.role if entry else role) or "",
        "confidence": round(entry.confidence, 2) if entry else None,
        "reason": entry.why if entry else "",
        "review": review,
    }


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
    """One for each actuator, but on loops only for those that have a table; and one for each free joint besides."""
    return [*_actuator_sliders(mechanism, tables), *_free_sliders(mechanism, tables)]


def _actuator_sliders(mechanism: Mechanism, tables: PoseTables) -> Iterator[dict[str, Any]]:
    cylinders = {cylinder.slide: cylinder for cylinder in mechanism.cylinders}
    tabled = {driver for table in tables.tables for driver in table.drivers}
    looped = {name for loop in mechanism.loops for name in loop.joints}
    for actuator in mechanism.actuators:
        moved = [entry for entry in actuator.joints if entry.joint in tables.independent]
        # Without a table, a coupled joint would tear its loop open.
        if not moved or (moved[0].joint in looped and moved[0].joint not in tabled):
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
    ends = np.array([(hull.min(axis=0), hull.max(axis=0)) for hull in hulls if mechanism.sensors]).reshape(-1, 2, 3)
    size = float(np.linalg.norm(ends[:, 1].max(axis=0) - ends[:, 0].min(axis=0))) if len(ends) else 1.0
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
    pins = {name for cylinder in mechanism.cylinders for name in cylinder.pins}
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
