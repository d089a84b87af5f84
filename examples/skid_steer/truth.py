"""The truth about the drawn machine: what each part is, where each joint is, what linkage and shapes give. CAD frame,
metres."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from drawing.cylinders import Cylinder
from drawing.planar import Point, rot
from drawing.product import Assembly, extent, farthest, occurrences
from drawing.truth import CadFrame, document, twin_slides, value_rows

from . import values as v
from .chassis import WHEEL_Y
from .equipment import carried
from .linkage import AXLE_X, FOOT, RADIUS, Linkage

FRAME = CadFrame((400.0, 0.0, 250.0), x=(0.0, 0.0, 1.0), z=(0.0, 1.0, 0.0))
"""From a point of the drawing office's: x up, y forward, z to the left."""
Y = (0.0, 1.0, 0.0)


def joints(k: Linkage, pose: tuple[float, float]) -> dict[str, dict[str, Any]]:
    """Every joint of the machine, by name; pitch axes to the left, slides outwards."""
    out: dict[str, dict[str, Any]] = {}
    lifted, tilted = pose

    def add(a: str, b: str, at: Point, y: float = 0.0, name: str = "", end: Point | None = None) -> None:
        axis = Y if end is None else (float(end[0] - at[0]), 0.0, float(end[1] - at[1]))
        entry = {"type": "revolute" if end is None else "prismatic", "body0": a, "body1": b}
        where = {"anchor": FRAME.point((float(at[0]), y, float(at[1]))), "axis": FRAME.axis(axis)}
        out[name or f"{a}2{b}_joint"] = entry | where

    if len(k.links) == 1:
        add("chassis", "boom", k.links[0][0])
    else:
        for name, (base, pin) in zip(("rear_link", "front_link"), k.links, strict=True):
            add("chassis", name, base)
            add(name, "boom", k.carry(lifted, pin))
    hinge = k.carry(lifted, k.B)
    add("boom", "bucket", hinge)
    rows = (
        ("boom", "chassis", "boom", k.C, k.carry(lifted, k.D)),
        ("bucket", "boom", "bucket", k.carry(lifted, k.E), hinge + rot(lifted + tilted, k.J)),
    )
    for name, base, moved, start, end in rows:
        for letter in "lr":
            barrel, piston = f"{name}_cylinder_barrel_{letter}", f"{name}_piston_rod_{letter}"
            add(base, barrel, start)
            add(moved, piston, end)
            add(barrel, piston, start, end=end)
    for place, x in (("front", AXLE_X), ("rear", -AXLE_X)):
        for letter, y in (("l", WHEEL_Y), ("r", -WHEEL_Y)):
            wheel = f"{place}_wheel_{letter}"
            add("chassis", wheel, np.array([x, RADIUS]), y, f"{wheel}_joint")
    return out


def measured(k: Linkage) -> dict[str, float]:
    """What the solved linkage gives, by the value's name; millimetres and degrees."""
    high, ground = k.carry(k.turn, k.B), k.carry(k.level(), k.B)
    raised = k.turn + k.angle(v.TILT_CLOSED.value + v.TILT_STROKE.value)
    back = k.angle(v.TILT_CLOSED.value)
    corner = k.B + rot(back, k.T)
    return {
        v.LENGTH.name: float(ground[0] + k.T[0] - k.tail),
        v.BARE_LENGTH.name: float(k.B[0]) + FOOT - k.tail,
        v.HINGE_HEIGHT.name: float(high[1]),
        v.REACH.name: float(high[0] + rot(raised, k.T)[0]) - AXLE_X - RADIUS,
        v.TURNING_RADIUS.name: math.hypot(float(corner[0]), v.BUCKET_WIDTH.value / 2),
        v.DUMP_ANGLE.name: -math.degrees(raised),
        v.ROLLBACK.name: math.degrees(k.level() + back),
        v.DIG_DEPTH.name: -float(k.B[1] + k.T[1]),
    }


def drawn_values(root: Assembly, k: Linkage, pose: tuple[float, float]) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> list[Any]:
        return [leaf for leaf in leaves if leaf.body.startswith(bodies)]

    chassis, tyres = extent(of("chassis")), extent([leaf for leaf in leaves if leaf.part.name == "TYRE"])
    lowered = extent(of("boom"), carried(k, pose[0]).Inverted())
    return {
        v.BARE_LENGTH.name: float(lowered[1, 0] - chassis[0, 0]),
        v.OVERALL_WIDTH.name: float(np.ptp(tyres[:, 1])),
        v.BUCKET_WIDTH.name: float(np.ptp(extent(of("bucket"))[:, 1])),
        v.WHEELBASE.name: float(extent(of("front_wheel")).mean(0)[0] - extent(of("rear_wheel")).mean(0)[0]),
        v.HEIGHT.name: float(chassis[1, 2]),
        v.TYRE_DIAMETER.name: float(np.ptp(tyres[:, 2])),
        v.GROUND_CLEARANCE.name: float(chassis[0, 2]),
        v.REAR_RADIUS.name: farthest([leaf for leaf in of("chassis") if leaf.part.name == "TAILGATE"], {}),
    }


def truth(root: Assembly, k: Linkage, pose: tuple[float, float], drawn: dict[str, Cylinder]) -> dict[str, Any]:
    """The document written as `truth.json`."""
    values = value_rows((*v.PUBLISHED, *v.EXAMPLE), measured(k), drawn_values(root, k, pose))
    path = "radial" if len(k.links) == 1 else "vertical"
    return document(FRAME, root, joints(k, pose), twin_slides(drawn), values, lift_path=path)
