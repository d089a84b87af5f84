"""The truth about the drawn machine: what each part is, where each joint is, what linkages and shapes give. CAD frame,
metres."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from drawing.cylinders import Cylinder
from drawing.digger_truth import arm_force, bucket_force, dig, moves
from drawing.product import Assembly, extent, farthest, occurrences
from drawing.stabiliser import FOOT, RAISED, leg_joints
from drawing.steer_axle import steering_joints
from drawing.truth import CadFrame, Joints, document, twin_slides, value_rows
from drawing.wheels import wheel_places
from excavator.equipment import CYLINDER_Y

from . import values as v
from .carrier import FLOOR
from .linkage import FRONT_X, LEG_X, RADIUS, REAR_X, STROKES, TREAD, ranges, solve, solve_axle, solve_stabiliser

if TYPE_CHECKING:
    from .draw import Drawn

FRAME = CadFrame((0.0, 0.0, FLOOR), x=(0.0, 1.0, 0.0), z=(1.0, 0.0, 0.0))
"""From the swing axis at the revolving frame's underside: x to the left, y up, z forward."""
Z = (0.0, 0.0, 1.0)
TWINS = ("boom", "stabilizer")


def joints(d: Drawn) -> dict[str, dict[str, Any]]:
    """Every joint of the machine."""
    found = Joints(FRAME)
    found.pivot("undercarriage", "upperstructure", (0.0, 0.0, FLOOR), Z)
    dig(found, d.k, d.pose, "upperstructure", CYLINDER_Y)
    steering_joints(found, solve_axle())
    for wheel, place in wheel_places({"front": (FRONT_X, TREAD), "rear": (REAR_X, TREAD)}, RADIUS).items():
        carrier = wheel.replace("front_wheel", "knuckle") if wheel.startswith("front") else "undercarriage"
        found.pivot(carrier, wheel, place, name=f"{wheel}_joint")
    leg_joints(found, solve_stabiliser(), d.leg, sum(LEG_X) / 2, "undercarriage")
    return found.found


def measured() -> dict[str, float]:
    """What the solved linkages give, by the value's name; millimetres, degrees, kilonewtons."""
    k, axle, leg = solve(), solve_axle(), solve_stabiliser()
    half, e = v.STEER_STROKE.value / 2, k.ends()
    inner = axle.knuckle_angle(-half)
    ahead = math.hypot(v.WHEELBASE.value, axle.king + axle.king + v.WHEELBASE.value / math.tan(inner))
    return ranges(k.A, k.tip, e) | {
        v.WALL_DEPTH.name: k.wall_depth(k.floor_angle(v.WALL_DEPTH.value)),
        v.BUCKET_ROTATION.name: math.degrees(e.open - e.curl),
        v.BUCKET_FORCE.name: bucket_force(k, v.MAIN_PRESSURE.value, v.BUCKET_BORE.value),
        v.ARM_FORCE.name: arm_force(k, v.MAIN_PRESSURE.value, v.ARM_BORE.value),
        v.STEER_ANGLE.name: math.degrees(inner),
        v.TURNING_RADIUS.name: ahead + 0.5 * (TREAD + v.TYRE_WIDTH.value) - axle.king,
        v.SPREAD.name: leg.widest,
        v.STABILISER_LIFT.name: FOOT - float(leg.pin[1]) - leg.long * math.sin(leg.lowered),
        v.STABILISER_STROKE.name: leg.length(leg.lowered) - leg.length(RAISED),
    }


def drawn_values(root: Assembly, d: Drawn) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.body.startswith(bodies)])

    def named(name: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.part.name.startswith(name)])

    folded = moves(d.k, d.pose, d.k.pose(STROKES.boom[1], STROKES.arm[1], STROKES.bucket[1]), ("_l", "_r"))
    front, rear = of("front_wheel"), of("rear_wheel")
    return {
        v.SWING_RADIUS_MIN.name: farthest([leaf for leaf in leaves if leaf.body in folded], folded),
        v.TAIL_RADIUS.name: farthest([leaf for leaf in leaves if leaf.part.name == "COUNTERWEIGHT"], {}),
        v.CAB_HEIGHT.name: float(named("CAB FRAME")[1, 2]),
        v.UPPER_WIDTH.name: float(np.ptp(of("upperstructure")[:, 1])),
        v.COUNTERWEIGHT_CLEARANCE.name: float(named("COUNTERWEIGHT")[0, 2]),
        v.GROUND_CLEARANCE.name: float(of("undercarriage")[0, 2]),
        v.WHEELBASE.name: float(front.mean(0)[0] - rear.mean(0)[0]),
        v.SLEW_TO_FRONT.name: float(front.mean(0)[0]),
        v.OVERALL_WIDTH.name: float(np.ptp(named("TYRE")[:, 1])),
        v.TYRE_DIAMETER.name: float(np.ptp(rear[:, 2])),
        v.BUCKET_WIDTH.name: float(np.ptp(named("CUTTING EDGE")[:, 1])),
    }


def truth(root: Assembly, d: Drawn, drawn: dict[str, Cylinder]) -> dict[str, Any]:
    """The document written as `truth.json`."""
    slides: dict[str, Any] = twin_slides({name: drawn[name] for name in TWINS})
    slides |= {f"{n}_cylinder_barrel2{n}_piston_rod_joint": c.slide() for n, c in drawn.items() if n not in TWINS}
    slides["front_axle2steering_piston_rod_joint"] = solve_axle().ram().slide()
    values = value_rows((*v.PUBLISHED, *v.EXAMPLE), measured(), drawn_values(root, d))
    return document(FRAME, root, joints(d), slides, values)
