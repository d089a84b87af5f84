"""The truth about the drawn machine: what each part is, where each joint is, what linkages and shapes give. CAD frame,
metres."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from drawing.cylinders import Cylinder
from drawing.planar import Point, rot
from drawing.product import Assembly, extent, occurrences
from drawing.stabiliser import HEEL, LOWERED, RAISED, leg_joints
from drawing.steer_axle import steering_joints
from drawing.truth import CadFrame, Joints, document, twin_slides, value_rows
from drawing.wheels import wheel_places

from . import values as v
from .chassis import LEG_X, LIFT_Y
from .linkage import (
    DEPTH,
    FRONT_RADIUS,
    FRONT_X,
    HALF_ARC,
    LIFTS,
    REAR_RADIUS,
    SWING_X,
    SWING_Z,
    TILTS,
    ranges,
    solve_axle,
    solve_backhoe,
    solve_loader,
    solve_stabiliser,
    solve_swing,
)

if TYPE_CHECKING:
    from .draw import Drawn

FRAME = CadFrame((200.0, 0.0, 400.0), x=(0.0, 0.0, 1.0), z=(1.0, 0.0, 0.0))
"""From a point of the drawing office's: x up, y to the right, z forward."""
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
TWINS = ("loader_lift", "swing", "stabilizer")


def joints(d: Drawn) -> dict[str, dict[str, Any]]:
    """Every joint of the machine."""
    found, k, hoe, pose = Joints(FRAME), d.shovel, d.hoe, d.pose
    swing = solve_swing()
    places = wheel_places({"front": (FRONT_X, v.FRONT_TREAD.value), "rear": (0.0, v.REAR_TREAD.value)}, 0.0)
    steering_joints(found, solve_axle())
    leg_joints(found, solve_stabiliser(), d.leg, sum(LEG_X) / 2, "chassis")

    def at(p: Point, y: float = 0.0) -> tuple[float, float, float]:
        return float(p[0]), y, float(p[1])

    def behind(p: Point) -> tuple[float, float, float]:
        return SWING_X - float(p[0]), 0.0, float(p[1])

    for letter, sign in (("l", 1.0), ("r", -1.0)):
        side, knuckle = f"_{letter}", f"knuckle_{letter}"
        for end, carrier, radius in (("front", knuckle, FRONT_RADIUS), ("rear", "chassis", REAR_RADIUS)):
            wheel = f"{end}_wheel_{letter}"
            found.pivot(carrier, wheel, (*places[wheel][:2], radius), name=f"{wheel}_joint")
        y = sign * LIFT_Y
        found.cylinder("loader_lift", side, ("chassis", "loader_arm"), at(k.C, y), at(d.arms.D, y), Y)
        p, q = ((SWING_X + float(c[0]), sign * float(c[1]), SWING_Z) for c in (swing.barrel, swing.rod(0.0)))
        found.cylinder("swing", side, ("chassis", "swing_post"), p, q, Z)
    found.pivot("chassis", "loader_arm", at(k.A))
    found.pivot("loader_arm", "loader_lever", at(d.arms.G))
    found.cylinder("loader_bucket", "", ("chassis", "loader_lever"), at(k.E), at(d.arms.F), Y)
    found.pivot("loader_lever", "loader_link", at(d.arms.H))
    found.pivot("loader_link", "loader_bucket", at(d.arms.J))
    found.pivot("loader_arm", "loader_bucket", at(d.arms.B))
    found.pivot("chassis", "swing_post", (SWING_X, 0, SWING_Z), Z)
    found.pivot("swing_post", "boom", behind(hoe.A))
    found.cylinder("boom", "", ("swing_post", "boom"), behind(hoe.C), behind(pose.D), Y)
    found.pivot("boom", "dipper", behind(pose.B))
    found.cylinder("dipper", "", ("boom", "dipper"), behind(pose.M), behind(pose.P), Y)
    start, end = (behind(p) for p in d.extension)
    along = tuple(b - a for a, b in zip(start, end, strict=True))
    found.slide("dipper", "dipper_extension", start, along)  # type: ignore[arg-type]
    found.cylinder("extension", "", ("dipper", "dipper_extension"), start, end, Y)
    found.pivot("dipper_extension", "backhoe_bucket", behind(pose.K))
    found.cylinder("backhoe_bucket", "", ("dipper_extension", "tipping_link"), behind(pose.E), behind(pose.H), Y)
    found.found["backhoe_bucket_piston_rod2tipping_link_joint"] = found.found.pop(
        "tipping_link2backhoe_bucket_piston_rod_joint"
    ) | {"body0": "backhoe_bucket_piston_rod", "body1": "tipping_link"}
    found.pivot("dipper_extension", "tipping_link", behind(pose.G))
    found.pivot("backhoe_bucket_piston_rod", "bucket_link", behind(pose.H))
    found.pivot("bucket_link", "backhoe_bucket", behind(pose.J))
    return found.found


def measured() -> dict[str, float]:
    """What the solved linkages give, by the value's name; millimetres and degrees."""
    k, hoe, leg, swing = solve_loader(), solve_backhoe(), solve_stabiliser(), solve_swing()
    high, ground = k.pose(LIFTS[1], TILTS[0]), k.pose(k.lift_for_hinge(DEPTH), TILTS[1])
    dump = k.pose(LIFTS[1], k.tilt_for_angle(LIFTS[1], math.radians(-45.0), TILTS))
    return ranges(hoe.A, hoe.tip, hoe.ends()) | {
        v.HINGE_HEIGHT.name: float(high.B[1]),
        v.DUMP_ANGLE.name: -math.degrees(high.bucket_angle),
        v.ROLLBACK.name: math.degrees(ground.bucket_angle),
        v.DUMP_HEIGHT.name: float(dump.T[1]),
        v.DUMP_REACH.name: float(dump.T[0]) - FRONT_X - FRONT_RADIUS,
        v.LOADER_DEPTH.name: -float(k.pose(LIFTS[0], TILTS[0]).B[1] + k.T[1]),
        v.SPREAD.name: leg.widest,
        v.FEET_CLEARANCE.name: float(leg.pin[1]) - HEEL,
        v.STABILISER_STROKE.name: leg.length(LOWERED) - leg.length(RAISED),
        v.SWING_STROKE.name: swing.length(HALF_ARC) - swing.length(-HALF_ARC),
        v.SWING_ARC.name: math.degrees(2.0 * HALF_ARC),
        v.STEER_ANGLE.name: math.degrees(solve_axle().knuckle_angle(-v.STEER_STROKE.value / 2)),
    }


def forces() -> dict[str, float]:
    """Calculated breakout forces by the value's name, kN: by virtual work, weights left out, the dipper drawn out."""
    k, hoe, step = solve_loader(), solve_backhoe(), 1e-3
    lift = k.lift_for_hinge(DEPTH)
    level = k.tilt_for_angle(lift, 0.0, TILTS)

    def rise(tilt: float) -> float:
        pose = k.pose(lift, tilt)
        return float((pose.B + rot(pose.bucket_angle, k.T - np.array([100.0, 0.0])))[1])

    def push(bore: v.Value) -> float:
        return v.PRESSURE.value * math.pi / 4 * bore.value**2 / 1000

    def curl(length: float) -> float:
        """Radians that the bucket turns a millimetre of its cylinder."""
        return abs(hoe.four_bar(length + step)[0] - hoe.four_bar(length - step)[0]) / (2 * step)

    def crowd(length: float) -> float:
        return abs(hoe.arm_angle(length + step) - hoe.arm_angle(length - step)) / (2 * step)

    bucket = min(np.linspace(*hoe.strokes.bucket, 201), key=lambda c: curl(float(c)))
    dipper = min(np.linspace(*hoe.strokes.arm, 201), key=lambda c: crowd(float(c)))
    gamma = hoe.four_bar(float(bucket))[0]
    far = float(np.hypot(*(np.array([hoe.arm, 0.0]) + rot(gamma, np.array([hoe.tip, 0.0])))))
    return {
        v.LOADER_FORCE.name: push(v.TILT_BORE) * 2 * step / (rise(level + step) - rise(level - step)),
        v.BUCKET_FORCE.name: push(v.BUCKET_BORE) / (curl(float(bucket)) * hoe.tip),
        v.DIPPER_FORCE.name: push(v.DIPPER_BORE) / (crowd(float(dipper)) * far),
    }


def drawn_values(root: Assembly) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.body.startswith(bodies)])

    def named(name: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.part.name.startswith(name)])

    chassis = of("chassis")
    return {
        v.WHEELBASE.name: float(of("front_wheel").mean(0)[0] - of("rear_wheel").mean(0)[0]),
        v.CAB_HEIGHT.name: float(chassis[1, 2]),
        v.GROUND_CLEARANCE.name: float(chassis[0, 2]),
        v.FRAME_WIDTH.name: float(np.ptp(named("REAR FRAME PL")[:, 1])),
        v.SHOVEL_WIDTH.name: float(np.ptp(of("loader_bucket")[:, 1])),
        v.KINGPOST_CLEARANCE.name: float(named("POST")[0, 2]),
        v.TYRE_DIAMETER.name: float(np.ptp(of("rear_tyre", "rear_wheel")[:, 2])),
        v.SLEW_TO_AXLE.name: -float(extent([x for x in leaves if x.role == "swing_post_pin"]).mean(0)[0]),
    }


def truth(root: Assembly, d: Drawn, drawn: dict[str, Cylinder]) -> dict[str, Any]:
    """The document written as `truth.json`."""
    slides: dict[str, Any] = twin_slides({name: drawn[name] for name in TWINS})
    slides |= {f"{n}_cylinder_barrel2{n}_piston_rod_joint": c.slide() for n, c in drawn.items() if n not in TWINS}
    slides["front_axle2steering_piston_rod_joint"] = solve_axle().ram().slide()
    values = value_rows((*v.PUBLISHED, *v.EXAMPLE), measured(), drawn_values(root))
    return document(FRAME, root, joints(d), slides, values)
