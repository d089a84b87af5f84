"""The truth about the drawn machine: what each part is, where each joint is, what the linkage gives. CAD
frame, metres."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from OCP.gp import gp_Trsf
from scipy.optimize import brentq

from drawing.articulation import Steering
from drawing.cylinders import Cylinder
from drawing.hardware import placed
from drawing.loader import Pose
from drawing.product import Assembly, Occurrence, extent, occurrences
from drawing.solids import turn
from drawing.truth import CadFrame, value_rows

from . import values as v
from .linkage import (
    EDGE_DEPTH,
    FRONT_AXLE_X,
    LIFT_MAX,
    LIFT_MIN,
    TILT_MAX,
    TILT_MIN,
    TYRE_RADIUS,
    Linkage,
)

Array = NDArray[np.float64]
FRAME = CadFrame((-v.WHEELBASE.value / 2, 0.0, v.TYRE_DIAMETER.value / 2), x=(-1.0, 0.0, 0.0), z=(0.0, 1.0, 0.0))
"""From the middle of the rear axle: x backward, y up, z left, as the drawing office of this example has it."""
Y, Z, X = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)


def joints(k: Linkage, pose: Pose, s: Steering, steer_z: float, lift_y: float) -> dict[str, dict[str, Any]]:
    """Every joint of the machine. Anchors and axes in the CAD frame; pitch axes towards the machine's left,
    slides outward."""
    out: dict[str, dict[str, Any]] = {}

    def add(
        name: str,
        kind: str,
        bodies: tuple[str, str],
        at: tuple[float, float, float],
        axis: tuple[float, float, float],
    ) -> None:
        out[name] = {
            "type": kind,
            "body0": bodies[0],
            "body1": bodies[1],
            "anchor": FRAME.point(at),
            "axis": FRAME.axis(axis),
        }

    def pivot(a: str, b: str, at: tuple[float, float, float], axis: tuple[float, float, float] = Y) -> None:
        add(f"{a}2{b}_joint", "revolute", (a, b), at, axis)

    z = TYRE_RADIUS
    add("rear2front_joint", "revolute", ("rear_frame", "front_frame"), (0, 0, 1060.0), Z)
    pivot("rear_frame", "rear_axle", (-FRONT_AXLE_X, 0, z), X)
    half = v.TREAD.value / 2
    for end, parent, x in (("front", "front_frame", FRONT_AXLE_X), ("rear", "rear_axle", -FRONT_AXLE_X)):
        for letter, y in (("l", half), ("r", -half)):
            add(f"{end}_wheel_{letter}_joint", "revolute", (parent, f"{end}_wheel_{letter}"), (x, y, z), Y)
    along = s.Q - s.P
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        barrel, piston = f"steering_cylinder_barrel_{letter}", f"steering_piston_rod_{letter}"
        p, q = (s.P[0], sign * s.P[1], steer_z), (s.Q[0], sign * s.Q[1], steer_z)
        pivot("rear_frame", barrel, p, Z)
        pivot("front_frame", piston, q, Z)
        add(f"{barrel}2{piston}_joint", "prismatic", (barrel, piston), p, (along[0], sign * along[1], 0.0))
    pivot("front_frame", "boom", (k.A[0], 0, k.A[1]))
    d = pose.D - k.C
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        barrel, piston = f"boom_cylinder_barrel_{letter}", f"boom_piston_rod_{letter}"
        c = (k.C[0], sign * lift_y, k.C[1])
        pivot("front_frame", barrel, c)
        pivot("boom", piston, (pose.D[0], sign * lift_y, pose.D[1]))
        add(f"{barrel}2{piston}_joint", "prismatic", (barrel, piston), c, (d[0], 0.0, d[1]))
    e = (k.E[0], 0.0, k.E[1])
    pivot("front_frame", "bucket_cylinder_barrel", e)
    f = pose.F - k.E
    slide = ("bucket_cylinder_barrel", "bucket_piston_rod")
    add("bucket_piston_rod2bucket_cylinder_barrel_joint", "prismatic", slide, e, (f[0], 0.0, f[1]))
    pivot("bucket_piston_rod", "rocker", (pose.F[0], 0, pose.F[1]))
    pivot("boom", "rocker", (pose.G[0], 0, pose.G[1]))
    pivot("rocker", "bucket_link", (pose.H[0], 0, pose.H[1]))
    pivot("bucket_link", "bucket", (pose.J[0], 0, pose.J[1]))
    pivot("boom", "bucket", (pose.B[0], 0, pose.B[1]))
    return out


def _slides(cylinders: dict[str, Cylinder]) -> dict[str, dict[str, float]]:
    out = {"bucket_piston_rod2bucket_cylinder_barrel_joint": cylinders["tilt"].slide()}
    for letter in "lr":
        out[f"boom_cylinder_barrel_{letter}2boom_piston_rod_{letter}_joint"] = cylinders["lift"].slide()
        out[f"steering_cylinder_barrel_{letter}2steering_piston_rod_{letter}_joint"] = cylinders["steer"].slide()
    return out


def measured(k: Linkage, s: Steering) -> dict[str, float]:
    """What the solved linkage gives for the values it was solved for, by the value's name; millimetres and
    degrees."""
    degrees = math.degrees
    ground = k.lift_for_hinge(EDGE_DEPTH)
    level = k.pose(ground, k.tilt_for(ground, 0.0))
    dump = k.pose(LIFT_MAX, k.tilt_for(LIFT_MAX, math.radians(-45.0)))
    low = k.pose(LIFT_MIN, k.tilt_for(LIFT_MIN, 0.0))
    return {
        v.HINGE_HEIGHT_MAX.name: float(dump.B[1]),
        v.DUMP_CLEARANCE.name: float(dump.T[1]),
        v.DUMP_REACH.name: float(dump.T[0] - FRONT_AXLE_X - TYRE_RADIUS),
        v.OVERALL_LENGTH.name: float(level.T[0] + FRONT_AXLE_X + v.REAR_OVERHANG.value),
        v.RACK_BACK_GROUND.name: degrees(k.pose(ground, TILT_MAX).bucket_angle),
        v.RACK_BACK_MAX.name: degrees(k.pose(LIFT_MAX, TILT_MAX).bucket_angle),
        v.DUMP_ANGLE_MAX.name: -degrees(k.pose(LIFT_MAX, TILT_MIN).bucket_angle),
        v.DIG_DEPTH.name: -float(low.T[1]),
        v.STEER_ANGLE.name: degrees(s.lock(v.STEER_CLOSED.value, v.STEER_STROKE.value)),
    }


def drawn(root: Assembly, k: Linkage, pose: Pose) -> dict[str, float]:
    """What the drawn shapes give for the published values, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> list[Occurrence]:
        return [leaf for leaf in leaves if leaf.body in bodies]

    def named(name: str) -> list[Occurrence]:
        return [leaf for leaf in leaves if leaf.part.name.startswith(name)]

    bucket, fixed = of("bucket"), of("rear_frame", "rear_axle", "front_frame")
    tyres = extent(named("TYRE"))
    at = placed((pose.B[0], 0, pose.B[1]), pose.bucket_angle).Inverted()

    def put(other: Pose) -> gp_Trsf:
        return placed((other.B[0], 0, other.B[1]), other.bucket_angle).Multiplied(at)

    ground = k.lift_for_hinge(EDGE_DEPTH)
    level = extent(bucket, put(k.pose(ground, k.tilt_for(ground, 0.0))))
    high = extent(bucket, put(k.pose(LIFT_MAX, TILT_MAX)))
    dump = extent(bucket, put(k.pose(LIFT_MAX, k.tilt_for(LIFT_MAX, math.radians(-45.0)))))
    slope = turn(Y, v.APPROACH_ANGLE_CARRY.value, (FRONT_AXLE_X, 0.0, TYRE_RADIUS))
    heel = [leaf for leaf in bucket if leaf.part.name.startswith(("WRAPPER", "HINGE EAR", "SIDE PL"))]

    def above(hinge: float) -> float:
        return float(extent(heel, slope.Multiplied(put(k.pose(k.lift_for_hinge(hinge), TILT_MAX))))[0, 2])

    return {
        v.WHEELBASE.name: float(extent(of("front_wheel_l")).mean(0)[0] - extent(of("rear_wheel_l")).mean(0)[0]),
        v.WIDTH_OVER_TYRES.name: float(tyres[1, 1] - tyres[0, 1]),
        v.BUCKET_WIDTH.name: float(level[1, 1] - level[0, 1]),
        v.OVERALL_LENGTH.name: float(level[1, 0] - extent(fixed)[0, 0]),
        v.OPERATING_HEIGHT.name: float(high[1, 2]),
        v.DUMP_CLEARANCE.name: float(dump[0, 2]),
        v.HINGE_HEIGHT_CARRY.name: float(brentq(above, 500.0, 700.0, xtol=1e-6)),
        v.GROUND_CLEARANCE.name: float(extent(fixed)[0, 2]),
        v.HITCH_HEIGHT.name: float(extent(named("HITCH PIN")).mean(0)[2]),
        v.STACK_HEIGHT.name: float(extent(named("EXHAUST STACK"))[1, 2]),
        v.CAB_HEIGHT.name: float(extent(named("ROOF"))[1, 2]),
    }


def truth(
    root: Assembly,
    k: Linkage,
    pose: Pose,
    s: Steering,
    cylinders: dict[str, Cylinder],
    steer_z: float,
    lift_y: float,
) -> dict[str, Any]:
    """The document written as `truth.json`."""
    got = measured(k, s)
    shapes = drawn(root, k, pose)
    return {
        "about": "CAD frame, metres. A part's key is its product names from the root joined by '/', in tree "
        "order; the second of two equal keys ends in '#2', the third in '#3'.",
        "frame": FRAME.matrix(),
        "joints": joints(k, pose, s, steer_z, lift_y),
        "parts": {leaf.path: {"body": leaf.body, "role": leaf.role} for leaf in occurrences(root)},
        "cylinders": _slides(cylinders),
        "sites": {
            "bucket_edge": FRAME.point((pose.T[0], 0.0, pose.T[1])),
            "bucket_hinge": FRAME.point((pose.B[0], 0.0, pose.B[1])),
        },
        "drawn": {
            "boom_angle": round(math.degrees(pose.boom_angle), 9),
            "bucket_angle": round(math.degrees(pose.bucket_angle), 9),
        },
        "values": value_rows((*v.PUBLISHED, *v.EXAMPLE), got, shapes),
    }
