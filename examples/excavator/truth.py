"""The truth about the drawn machine: what each part is, where each joint is, what the linkage gives. CAD frame,
metres."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from OCP.gp import gp_Trsf
from scipy.optimize import brentq

from drawing.cylinders import Cylinder
from drawing.digger import Linkage, Pose, wrapped
from drawing.digger_truth import arm_force, bucket_force, moves
from drawing.planar import Point
from drawing.product import Assembly, Occurrence, extent, farthest, occurrences
from drawing.truth import CadFrame, value_rows

from . import values as v
from .bucket import floor_angle
from .equipment import CYLINDER_Y
from .linkage import (
    ARM_MAX,
    BOOM_MAX,
    BOOM_MIN,
    BUCKET_MAX,
    LEVEL,
    ranges,
)
from .track import CARRIER_X, COUNT, HALF, ROLLER_X, Loop, solve_track
from .undercarriage import GAUGE
from .upper import FLOOR

Array = NDArray[np.float64]
Y, Z = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def frame() -> CadFrame:
    """CAD x is right, y up, z backward, as the drawing office of this example has it; the origin is on the sprockets'
    axis in the middle of the machine."""
    return CadFrame((-HALF, 0.0, solve_track().axle), x=(0.0, -1.0, 0.0), z=(-1.0, 0.0, 0.0))


def _row(body: str, count: int) -> list[str]:
    return [f"{body}_{i + 1}" for i in range(count)]


def track_bodies() -> list[str]:
    """Bodies of their own where every shoe is one; otherwise they move with the undercarriage."""
    out: list[str] = []
    for letter in "lr":
        out += [f"sprocket_{letter}", f"idler_{letter}"]
        out += _row(f"track_roller_{letter}", len(ROLLER_X)) + _row(f"carrier_roller_{letter}", len(CARRIER_X))
        out += _row(f"track_shoe_{letter}", COUNT)
    return out


def joints(k: Linkage, pose: Pose, loop: Loop) -> dict[str, dict[str, Any]]:
    """Every joint of the machine; `when` names the choice that a joint belongs to. Anchors and axes in the CAD frame;
    pitch axes towards the machine's left, the swing's up, slides outward."""
    out: dict[str, dict[str, Any]] = {}
    shoes = {"tracks": "shoes"}

    def add(
        name: str,
        bodies: tuple[str, str],
        at: tuple[float, float, float],
        *,
        kind: str = "revolute",
        axis: tuple[float, float, float] = Y,
        when: dict[str, str] | None = None,
    ) -> None:
        out[name] = {
            "type": kind,
            "body0": bodies[0],
            "body1": bodies[1],
            "anchor": frame().point(at),
            "axis": frame().axis(axis),
        }
        if when:
            out[name]["when"] = when

    def pivot(a: str, b: str, at: Point, y: float = 0.0) -> None:
        add(f"{a}2{b}_joint", (a, b), (at[0], y, at[1]))

    def slide(barrel: str, piston: str, start: Point, end: Point, y: float = 0.0) -> None:
        d = end - start
        at = (start[0], y, start[1])
        add(f"{barrel}2{piston}_joint", (barrel, piston), at, kind="prismatic", axis=(d[0], 0.0, d[1]))

    add("undercarriage2upperstructure_joint", ("undercarriage", "upperstructure"), (0, 0, FLOOR), axis=Z)
    pivot("upperstructure", "boom", k.A)
    for letter, y in (("l", CYLINDER_Y), ("r", -CYLINDER_Y)):
        pivot("upperstructure", f"boom_cylinder_barrel_{letter}", k.C, y)
        pivot("boom", f"boom_piston_rod_{letter}", pose.D, y)
        slide(f"boom_cylinder_barrel_{letter}", f"boom_piston_rod_{letter}", k.C, pose.D, y)
    pivot("boom", "arm", pose.B)
    pivot("boom", "arm_cylinder_barrel", pose.M)
    pivot("arm", "arm_piston_rod", pose.P)
    slide("arm_cylinder_barrel", "arm_piston_rod", pose.M, pose.P)
    pivot("arm", "bucket", pose.K)
    pivot("arm", "bucket_cylinder_barrel", pose.E)
    slide("bucket_cylinder_barrel", "bucket_piston_rod", pose.E, pose.H)
    pivot("arm", "tipping_link", pose.G)
    pivot("bucket_piston_rod", "tipping_link", pose.H)
    pivot("bucket_piston_rod", "bucket_link", pose.H)
    pivot("bucket_link", "bucket", pose.J)
    for letter, y in (("l", GAUGE), ("r", -GAUGE)):

        def turns(body: str, x: float, z: float, y: float = y, name: str = "", parent: str = "undercarriage") -> None:
            add(name or f"{parent}2{body}_joint", (parent, body), (x, y, z), when=shoes)

        turns(f"sprocket_{letter}", -HALF, loop.axle)
        turns(f"idler_{letter}", HALF, loop.axle)
        rows = (
            ("track_roller", [(x, loop.roller) for x in reversed(ROLLER_X)]),
            ("carrier_roller", [(x, loop.carrier(x)) for x in reversed(CARRIER_X)]),
        )
        for row, places in rows:
            for i, (x, z) in enumerate(places, 1):
                turns(f"{row}_{letter}_{i}", x, z, name=f"undercarriage2{row}_{letter}_joint_{i}")
        shoe = f"track_shoe_{letter}"
        for i in range(1, COUNT + 1):
            following = i % COUNT + 1
            x, z, _ = loop.pins[following - 1]
            turns(f"{shoe}_{following}", x, z, name=f"{shoe}2{shoe}_joint_{i}", parent=f"{shoe}_{i}")
    return out


def _slides(cylinders: dict[str, Cylinder]) -> dict[str, dict[str, float]]:
    out = {f"{n}_cylinder_barrel2{n}_piston_rod_joint": cylinders[n].slide() for n in ("arm", "bucket")}
    for letter in "lr":
        out[f"boom_cylinder_barrel_{letter}2boom_piston_rod_{letter}_joint"] = cylinders["boom"].slide()
    return out


def measured(k: Linkage) -> dict[str, float]:
    """What the solved linkage gives for the working ranges, by the value's name; millimetres and kilonewtons."""
    e = k.ends()
    got = {n: x for n, x in ranges(k.A, k.tip, e).items() if n != LEVEL}

    def miss(depth: float) -> float:
        return ranges(k.A, k.tip, e, depth)[LEVEL] - v.LEVEL_LENGTH

    return got | {
        v.LEVEL_DEPTH.name: float(brentq(miss, 6000.0, v.DIGGING_DEPTH.value - 1.0, xtol=1e-9)),
        v.WALL_DEPTH.name: k.wall_depth(floor_angle(k)),
        v.BUCKET_FORCE.name: bucket_force(k, v.MAIN_PRESSURE.value, v.BUCKET_BORE.value),
        v.ARM_FORCE.name: arm_force(k, v.MAIN_PRESSURE.value, v.ARM_BORE.value),
    }


def drawn(root: Assembly, k: Linkage, pose: Pose) -> dict[str, float]:
    """What the drawn shapes give for the values, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> list[Occurrence]:
        return [leaf for leaf in leaves if leaf.body.startswith(bodies)]

    def named(name: str) -> list[Occurrence]:
        return [leaf for leaf in leaves if leaf.part.name.startswith(name)]

    front = ("boom", "arm", "bucket", "tipping_link")
    hanging = [leaf for leaf in of("arm", "bucket", "tipping_link") if not leaf.part.name.startswith("BOLT")]

    def bounds(group: list[Occurrence], moves: dict[str, gp_Trsf]) -> Array:
        parts = [extent([leaf], moves[leaf.body]) for leaf in group]
        return np.array([np.min([b[0] for b in parts], axis=0), np.max([b[1] for b in parts], axis=0)])

    def folded(boom: float) -> dict[str, gp_Trsf]:
        return moves(k, pose, k.pose(boom, ARM_MAX, BUCKET_MAX), ("_l", "_r"))

    down = float(brentq(lambda c: bounds(hanging, folded(c))[0, 2], BOOM_MIN + 200, BOOM_MAX - 200, xtol=1e-3))
    resting = bounds(of(*front), folded(down))
    upper = of("upperstructure")
    swung = farthest(of(*front), folded(BOOM_MAX))
    shoes = extent(of("track_shoe_l", "track_shoe_r"))
    left = extent(of("track_shoe_l"))
    clear = [leaf for leaf in of("undercarriage") if "CENTRE" in leaf.path]
    return {
        v.OVERALL_LENGTH.name: float(resting[1, 0] - extent(upper)[0, 0]),
        v.BOOM_HEIGHT.name: float(resting[1, 2]),
        v.SWING_RADIUS_MIN.name: swung,
        v.TAIL_RADIUS.name: farthest([leaf for leaf in upper if "COUNTERWEIGHT" in leaf.path], {}),
        v.OVERALL_WIDTH.name: float(shoes[1, 1] - shoes[0, 1]),
        v.TRACK_LENGTH.name: float(left[1, 0] - left[0, 0]),
        v.TRACK_HEIGHT.name: float(left[1, 2]),
        v.SHOE_WIDTH.name: float(left[1, 1] - left[0, 1]),
        v.TRACK_GAUGE.name: float(left.mean(0)[1] - extent(of("track_shoe_r")).mean(0)[1]),
        v.TRACK_ON_GROUND.name: float(
            extent(named("IDLER AXLE")).mean(0)[0] - extent(named("FINAL DRIVE CASE")).mean(0)[0]
        ),
        v.GROUND_CLEARANCE.name: float(extent(clear)[0, 2]),
        v.COUNTERWEIGHT_CLEARANCE.name: float(extent(named("COUNTERWEIGHT"))[0, 2]),
        v.UPPER_WIDTH.name: float(extent(named("DECK"))[1, 1] - extent(named("DECK"))[0, 1]),
        v.CAB_HEIGHT.name: float(extent(named("CAB ROOF"))[1, 2]),
        v.HANDRAIL_HEIGHT.name: float(extent(upper)[1, 2]),
        v.BUCKET_WIDTH.name: float(np.ptp(extent(named("CUTTING EDGE"))[:, 1])),
    }


def truth(root: Assembly, k: Linkage, pose: Pose, cylinders: dict[str, Cylinder]) -> dict[str, Any]:
    """The document written as `truth.json`."""
    got, shapes = measured(k), drawn(root, k, pose)
    return {
        "about": "CAD frame, metres. A part's key is its product names from the root joined by '/', in tree "
        "order; the second of two equal keys ends in '#2', the third in '#3'. Bodies and joints are those with "
        "every track shoe a body; where the track is not, 'undercarriage_with' move with the undercarriage and "
        "joints whose 'when' says so are absent.",
        "frame": frame().matrix(),
        "undercarriage_with": track_bodies(),
        "joints": joints(k, pose, solve_track()),
        "parts": {leaf.path: {"body": leaf.body, "role": leaf.role} for leaf in occurrences(root)},
        "cylinders": _slides(cylinders),
        "sites": {
            "bucket_tip": frame().point((pose.T[0], 0.0, pose.T[1])),
            "bucket_pin": frame().point((pose.K[0], 0.0, pose.K[1])),
        },
        "drawn": {
            "boom_angle": round(math.degrees(pose.boom_angle), 9),
            "arm_angle": round(math.degrees(pose.arm_angle), 9),
            "bucket_angle": round(math.degrees(pose.bucket_angle), 9),
            "bucket_floor": round(math.degrees(wrapped(pose.bucket_angle - floor_angle(k))), 9),
        },
        "values": value_rows((*v.PUBLISHED, *v.EXAMPLE), got, shapes),
    }
