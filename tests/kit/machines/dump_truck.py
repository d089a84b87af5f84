"""An articulated dump truck of somebody's, drawn to be looked at: named assemblies, plain meshes, no pin, no bore.

`dump_truck()` is the CAD model as a reader of triangles returns it, `BODIES` says which body each of its parts is of,
and `HIERARCHY`, `JOINTS` are the template that its owner wrote by hand.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import trimesh

from kit.machines.solids import Array
from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Mesh

HITCH_X, TIP, AXLES, TRACK = 0.0, (-4.6, 1.55), (2.1, -2.3, -4.0), 1.15
"""Metres: the articulation, the dump body's hinge (x, z), the axles' x, half the wheels' tread."""
STEER = ((0.75, 0.75, 1.05), (-0.75, 0.55, 1.05))
HOIST = ((-1.2, 0.6, 0.9), (-2.6, 0.6, 1.9))
"""A cylinder's ends on the left side: its tube's, its rod's."""
BODIES: dict[str, str] = {}
"""Part id → the body it is of; filled by `dump_truck`."""


def _body(rigid: bool, kind: str = "", **child: Any) -> dict[str, Any]:
    return {"rigid body": "Y" if rigid else "N", **({"kind": kind} if kind else {}), "child": child}


def _hierarchy() -> dict[str, Any]:
    wheels = {f"{place}_wheel_{side}": _body(True, "wheel") for place in ("mid", "rear") for side in "lr"}
    hoists = {f"tip_cyl_tube_{side}": _body(True, "barrel") for side in "lr"}
    rods = {f"tip_cyl_rod_{side}": _body(True, "rod") for side in "lr"}
    steering = {f"steer_cyl_tube_{side}": _body(True, "barrel") for side in "lr"}
    pistons = {f"steer_cyl_rod_{side}": _body(True, "rod") for side in "lr"}
    front = {f"front_wheel_{side}": _body(True, "wheel") for side in "lr"}
    rear = _body(True, "frame", **wheels, **hoists, **pistons, dump_body=_body(True, "", **rods))
    return {
        "dumper": _body(
            False, "group", tractor=_body(True, "frame", **front, **steering, hitch=_body(True, rear_chassis=rear))
        )
    }


def _joints() -> dict[str, Any]:
    def turning(a: str, b: str, **more: Any) -> dict[str, Any]:
        return {"joint_type": "Revolute", "Body": [a, b], **more}

    found: dict[str, Any] = {
        "articulation": turning("tractor", "hitch", Limit=["-45 deg", "45 deg"]),
        "oscillation": turning("hitch", "rear_chassis", free="Y"),
        "tipping": turning("rear_chassis", "dump_body"),
    }
    for side in "lr":
        found[f"front_wheel_{side}_joint"] = turning("tractor", f"front_wheel_{side}", free="Y")
        for place in ("mid", "rear"):
            found[f"{place}_wheel_{side}_joint"] = turning("rear_chassis", f"{place}_wheel_{side}", free="Y")
        for kind, base, far, stroke in (
            ("steer", "tractor", "rear_chassis", "500 mm"), ("tip", "rear_chassis", "dump_body", "1500 mm"),
        ):  # fmt: skip
            tube, rod = f"{kind}_cyl_tube_{side}", f"{kind}_cyl_rod_{side}"
            found[f"{kind}_foot_{side}"] = turning(base, tube)
            found[f"{kind}_head_{side}"] = turning(far, rod)
            found[f"{kind}_slide_{side}"] = {
                "joint_type": "Prismatic", "Body": [tube, rod], "Limit": ["0", stroke], "Drive": ["Linear Drive"],
            }  # fmt: skip
    return found


HIERARCHY, JOINTS = _hierarchy(), _joints()


def _box(size: tuple[float, float, float], at: tuple[float, float, float]) -> trimesh.Trimesh:
    made = trimesh.creation.box(size)
    made.apply_translation(at)
    return made


def _bar(start: Array, end: Array, radius: float) -> trimesh.Trimesh:
    return trimesh.creation.cylinder(radius, segment=np.array([start, end]), sections=16)


def dump_truck() -> Assembly:
    """About eighty parts in their assemblies, Y to the left, Z up, metres; the ground at z = 0."""
    drawn: list[tuple[tuple[str, ...], str, str, trimesh.Trimesh]] = []

    def add(path: str, name: str, body: str, mesh: trimesh.Trimesh) -> None:
        drawn.append((("DUMPER D30", *path.split("/")), name, body, mesh))

    for side, y in (("L", 0.45), ("R", -0.45)):
        add("TRACTOR", f"RAIL {side}", "tractor", _box((3.1, 0.16, 0.4), (1.75, y, 0.95)))
        add("TRACTOR", f"FENDER {side}", "tractor", _box((1.4, 0.6, 0.08), (2.1, 2.2 * y, 1.85)))
        add("TRACTOR", f"STEP {side}", "tractor", _box((0.5, 0.35, 0.5), (1.1, 2.3 * y, 0.75)))
        add("TRACTOR", f"LAMP {side}", "tractor", _box((0.08, 0.25, 0.2), (3.62, 1.4 * y, 1.4)))
        add("REAR CHASSIS", f"SIDE MEMBER {side}", "rear_chassis", _box((4.3, 0.15, 0.35), (-2.75, y, 1.0)))
        add("REAR CHASSIS", f"WALKING BEAM {side}", "rear_chassis", _box((1.5, 0.2, 0.3), (-3.15, 1.6 * y, 0.85)))
        add("DUMP BODY", f"SIDE WALL {side}", "dump_body", _box((4.4, 0.08, 1.0), (-2.9, 2.9 * y, 2.5)))
        add("DUMP BODY", f"RAIL {side}", "dump_body", _box((4.0, 0.12, 0.2), (-2.9, 1.1 * y, 1.86)))
    add("TRACTOR", "ENGINE", "tractor", _box((1.5, 0.8, 0.8), (2.75, 0.0, 1.5)))
    add("TRACTOR", "HOOD", "tractor", _box((1.7, 1.5, 0.12), (2.75, 0.0, 2.0)))
    add("TRACTOR", "GRILLE", "tractor", _box((0.08, 1.3, 0.9), (3.6, 0.0, 1.5)))
    add("TRACTOR", "BUMPER", "tractor", _box((0.2, 2.3, 0.35), (3.75, 0.0, 0.85)))
    add("TRACTOR", "FRONT AXLE", "tractor", _bar(np.array([2.1, -0.85, 0.85]), np.array([2.1, 0.85, 0.85]), 0.16))
    add("TRACTOR/CAB ASSY", "CAB", "tractor", _box((1.3, 1.4, 1.5), (1.2, 0.0, 2.3)))
    add("TRACTOR/CAB ASSY", "ROOF", "tractor", _box((1.4, 1.5, 0.1), (1.2, 0.0, 3.1)))
    add("TRACTOR/CAB ASSY", "SEAT", "tractor", _box((0.5, 0.5, 0.6), (1.1, 0.0, 1.9)))
    add("TRACTOR/CAB ASSY", "MIRROR", "tractor", _box((0.1, 0.3, 0.4), (1.8, 1.0, 2.6)))
    add("TRACTOR", "EXHAUST", "tractor", _bar(np.array([2.0, -0.55, 2.0]), np.array([2.0, -0.55, 3.2]), 0.08))
    add("HITCH", "HITCH FORK", "hitch", _box((0.4, 0.5, 0.6), (-0.1, 0.0, 1.0)))
    add("HITCH", "HITCH TUBE", "hitch", _bar(np.array([-0.3, 0.0, 1.0]), np.array([-0.75, 0.0, 1.0]), 0.22))
    add("REAR CHASSIS", "CROSS MEMBER 1", "rear_chassis", _box((0.25, 1.0, 0.4), (-0.75, 0.0, 1.0)))
    add("REAR CHASSIS", "CROSS MEMBER 2", "rear_chassis", _box((0.2, 0.8, 0.3), (-2.6, 0.0, 1.0)))
    add("REAR CHASSIS", "CROSS MEMBER 3", "rear_chassis", _box((0.3, 1.2, 0.4), (-4.7, 0.0, 1.05)))
    for x, name in zip(AXLES[1:], ("MID", "REAR"), strict=True):
        ends = np.array([x, -0.85, 0.85]), np.array([x, 0.85, 0.85])
        add("REAR CHASSIS", f"{name} AXLE", "rear_chassis", _bar(*ends, 0.15))
    add("DUMP BODY", "FLOOR", "dump_body", _box((4.4, 2.6, 0.08), (-2.9, 0.0, 2.0)))
    add("DUMP BODY", "FRONT WALL", "dump_body", _box((0.08, 2.6, 1.2), (-0.7, 0.0, 2.6)))
    add("DUMP BODY", "TAIL", "dump_body", _box((0.5, 2.4, 0.08), (-5.2, 0.0, 2.15)))
    for n in range(6):
        add("DUMP BODY", f"RIB {n + 1}", "dump_body", _box((0.1, 2.4, 0.12), (-1.2 - 0.65 * n, 0.0, 1.9)))
    for x, name in zip(AXLES, ("FRONT", "MID", "REAR"), strict=True):
        for side, sign in (("L", 1.0), ("R", -1.0)):
            body = f"{name.lower()}_wheel_{side.lower()}"
            ends = np.array([x, sign * (TRACK - 0.3), 0.85]), np.array([x, sign * (TRACK + 0.3), 0.85])
            ring = trimesh.creation.annulus(0.5, 0.85, 0.6, sections=24)
            ring.apply_transform(trimesh.transformations.rotation_matrix(math.pi / 2, (1.0, 0.0, 0.0)))
            ring.apply_translation((x, sign * TRACK, 0.85))
            add(f"WHEELS/{name} {side}", "TYRE", body, ring)
            add(f"WHEELS/{name} {side}", "RIM", body, _bar(*ends, 0.5))
    for ends, kind in ((STEER, "STEERING"), (HOIST, "HOIST")):
        short = {"STEERING": "steer", "HOIST": "tip"}[kind]
        for side, sign in (("L", 1.0), ("R", -1.0)):
            foot, head = (np.array(end) * (1.0, sign, 1.0) for end in ends)
            along = (head - foot) / np.linalg.norm(head - foot)
            reach = float(np.linalg.norm(head - foot))
            path = f"{kind} CYLINDER {side}"
            tube, rod = f"{short}_cyl_tube_{side.lower()}", f"{short}_cyl_rod_{side.lower()}"
            add(path, "TUBE", tube, _bar(foot + 0.06 * along, foot + 0.62 * reach * along, 0.09))
            add(path, "FOOT EYE", tube, _box((0.16, 0.14, 0.16), tuple(foot)))
            add(path, "ROD", rod, _bar(foot + 0.3 * reach * along, head - 0.06 * along, 0.05))
            add(path, "ROD EYE", rod, _box((0.16, 0.14, 0.16), tuple(head)))
    occurrences = [
        Occurrence(name, path, Mesh(np.asarray(m.vertices), np.asarray(m.faces, dtype=np.int32)), np.eye(4))
        for path, name, _, m in drawn
    ]
    assembly = assemble(occurrences, name="dumper", format="glTF", unit=1.0, path="dumper.glb")
    bodies = [body for *_, body, _ in drawn]
    BODIES.update({part.id: body for part, body in zip(assembly.parts, bodies, strict=True)})
    return assembly
