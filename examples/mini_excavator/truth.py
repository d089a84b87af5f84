"""The truth about the drawn machine: what each part is, where each joint is, what the linkage and the shapes give. CAD
frame, metres."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from drawing.cylinders import Cylinder
from drawing.digger import Linkage, Pose
from drawing.digger_truth import moves
from drawing.planar import Point, direction
from drawing.product import Assembly, extent, farthest, occurrences
from drawing.truth import CadFrame, value_rows

from . import values as v
from .carrier import FLOOR, TRACK
from .equipment import floor_angle
from .linkage import BLADE_BARREL, BLADE_PIN, PIVOT, STROKES, SWING_Z, ranges, solve_blade, solve_swing

Y, Z = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
FRAME = CadFrame((0.0, 0.0, FLOOR), x=(0.0, 1.0, 0.0), z=(0.0, 0.0, 1.0))
"""From the swing axis at the revolving frame's underside: x to the left, y backward, z up."""


def joints(k: Linkage, pose: Pose, drawn: dict[str, Cylinder]) -> dict[str, dict[str, Any]]:
    """Every joint of the machine; `when` names the choice that a joint belongs to. Anchors and axes in the CAD frame;
    pitch axes towards the machine's left, upright ones up, slides outward."""
    out: dict[str, dict[str, Any]] = {}
    swing, blade = solve_swing(), solve_blade()
    blade_rod = blade.pins(blade.angle(drawn["blade"].drawn))[0]

    def add(
        bodies: tuple[str, str],
        at: tuple[float, float, float],
        axis: tuple[float, float, float] = Y,
        *,
        kind: str = "revolute",
        name: str = "",
        when: dict[str, str] | None = None,
    ) -> None:
        entry = {
            "type": kind,
            "body0": bodies[0],
            "body1": bodies[1],
            "anchor": FRAME.point(at),
            "axis": FRAME.axis(axis),
        }
        out[name or f"{bodies[0]}2{bodies[1]}_joint"] = entry | ({"when": when} if when else {})

    def pivot(a: str, b: str, at: Point) -> None:
        add((a, b), (at[0], 0.0, at[1]))

    def slide(name: str, start: Point, end: Point) -> None:
        d = end - start
        halves = (f"{name}_cylinder_barrel", f"{name}_piston_rod")
        add(halves, (start[0], 0.0, start[1]), (d[0], 0.0, d[1]), kind="prismatic")

    add(("undercarriage", "upperstructure"), (0, 0, FLOOR), Z)
    add(("upperstructure", "swing_bracket"), (*PIVOT, SWING_Z), Z)
    add(("upperstructure", "swing_cylinder_barrel"), (*swing.barrel, SWING_Z), Z)
    add(("swing_bracket", "swing_piston_rod"), (*swing.rod(0.0), SWING_Z), Z)
    along = swing.rod(0.0) - swing.barrel
    halves = ("swing_cylinder_barrel", "swing_piston_rod")
    add(halves, (*swing.barrel, SWING_Z), (along[0], along[1], 0.0), kind="prismatic")
    pivot("swing_bracket", "boom", k.A)
    pivot("swing_bracket", "boom_cylinder_barrel", k.C)
    pivot("boom", "boom_piston_rod", pose.D)
    slide("boom", k.C, pose.D)
    pivot("boom", "arm", pose.B)
    pivot("boom", "arm_cylinder_barrel", pose.M)
    pivot("arm", "arm_piston_rod", pose.P)
    slide("arm", pose.M, pose.P)
    pivot("arm", "bucket", pose.K)
    pivot("arm", "bucket_cylinder_barrel", pose.E)
    slide("bucket", pose.E, pose.H)
    pivot("arm", "tipping_link", pose.G)
    pivot("bucket_piston_rod", "tipping_link", pose.H)
    pivot("bucket_piston_rod", "bucket_link", pose.H)
    pivot("bucket_link", "bucket", pose.J)
    pivot("undercarriage", "blade", BLADE_PIN)
    pivot("undercarriage", "blade_cylinder_barrel", BLADE_BARREL)
    pivot("blade", "blade_piston_rod", blade_rod)
    slide("blade", BLADE_BARREL, blade_rod)
    for letter, y in (("l", TRACK.side), ("r", -TRACK.side)):
        shoes = {"tracks": "shoes"}
        for body, x in ((f"sprocket_{letter}", -TRACK.half), (f"idler_{letter}", TRACK.half)):
            add(("undercarriage", body), (x, y, TRACK.axle), when=shoes)
        for row, places in TRACK.rollers().items():
            for i, (x, z) in enumerate(places, 1):
                name = f"undercarriage2{row}_{letter}_joint_{i}"
                add(("undercarriage", f"{row}_{letter}_{i}"), (x, y, z), name=name, when=shoes)
        shoe, pins = f"track_shoe_{letter}", TRACK.pins()
        for i in range(1, len(pins) + 1):
            after = i % len(pins) + 1
            x, z = pins[after - 1]
            add((f"{shoe}_{i}", f"{shoe}_{after}"), (x, y, z), name=f"{shoe}2{shoe}_joint_{i}", when=shoes)
    return out


def measured(k: Linkage) -> dict[str, float]:
    """What the solved linkages give, by the value's name; millimetres and degrees."""
    swing, blade = solve_swing(), solve_blade()

    def turned(length: float) -> float:
        """The boom swing at a length of its cylinder, degrees to the left of straight ahead."""
        p, q = float(np.hypot(*(swing.barrel - PIVOT))), swing.arm
        opening = math.acos((p * p + q * q - length * length) / (2 * p * q))
        return math.degrees(opening - direction(swing.rod(0.0) - PIVOT) + direction(swing.barrel - PIVOT)) % 360.0

    low, high = (turned(swing.closed + share * v.SWING_STROKE.value) for share in (0.0, 1.0))
    ends = [blade.pins(blade.angle(blade.closed + share * v.BLADE_STROKE.value))[1][1] for share in (0.0, 1.0)]
    return ranges(k.A, k.tip, k.ends()) | {
        v.WALL_DEPTH.name: k.wall_depth(floor_angle(k)),
        v.SWING_RIGHT.name: 360.0 - low,
        v.SWING_LEFT.name: high,
        v.BLADE_LIFT.name: float(ends[0]),
        v.BLADE_DIG.name: -float(ends[1]),
    }


def drawn_values(root: Assembly, k: Linkage, pose: Pose) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.body.startswith(bodies)])

    def named(name: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.part.name.startswith(name)])

    folded = moves(k, pose, k.pose(STROKES.boom[1], STROKES.arm[1], STROKES.bucket[1]))
    shoes, left, upper = of("track_shoe"), of("track_shoe_l"), of("upperstructure")
    return {
        v.SWING_RADIUS_MIN.name: farthest([leaf for leaf in leaves if leaf.body in folded], folded),
        v.TAIL_RADIUS.name: farthest([leaf for leaf in leaves if leaf.part.name == "COUNTERWEIGHT"], {}),
        v.CANOPY_HEIGHT.name: float(upper[1, 2]),
        v.UPPER_WIDTH.name: float(np.ptp(upper[:, 1])),
        v.KINGPOST_CLEARANCE.name: float(of("swing_bracket")[0, 2]),
        v.OVERALL_WIDTH.name: float(np.ptp(shoes[:, 1])),
        v.TRACK_LENGTH.name: float(np.ptp(left[:, 0])),
        v.SHOE_WIDTH.name: float(np.ptp(left[:, 1])),
        v.TRACK_GAUGE.name: float(left.mean(0)[1] - of("track_shoe_r").mean(0)[1]),
        v.TRACK_ON_GROUND.name: float(of("idler_l").mean(0)[0] - of("sprocket_l").mean(0)[0]),
        v.GROUND_CLEARANCE.name: float(named("CENTRE FRAME")[0, 2]),
        v.BLADE_WIDTH.name: float(np.ptp(of("blade")[:, 1])),
        v.BUCKET_WIDTH.name: float(np.ptp(named("CUTTING EDGE")[:, 1])),
    }


def truth(root: Assembly, k: Linkage, pose: Pose, drawn: dict[str, Cylinder]) -> dict[str, Any]:
    """The document written as `truth.json`."""
    got, shapes = measured(k), drawn_values(root, k, pose)
    return {
        "about": "CAD frame, metres; parts, bodies and joints as in the excavator's truth.",
        "frame": FRAME.matrix(),
        "undercarriage_with": TRACK.bodies(),
        "joints": joints(k, pose, drawn),
        "parts": {leaf.path: {"body": leaf.body, "role": leaf.role} for leaf in occurrences(root)},
        "cylinders": {f"{n}_cylinder_barrel2{n}_piston_rod_joint": c.slide() for n, c in drawn.items()},
        "sites": {
            "bucket_tip": FRAME.point((pose.T[0], 0.0, pose.T[1])),
            "bucket_pin": FRAME.point((pose.K[0], 0.0, pose.K[1])),
        },
        "values": value_rows((*v.PUBLISHED, *v.EXAMPLE), got, shapes),
    }
