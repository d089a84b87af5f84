"""The truth about the drawn machine: what each part is, where each joint is, what linkage and shapes give. CAD frame,
metres."""

from __future__ import annotations

from typing import Any

import numpy as np

from drawing.articulation import Steering
from drawing.ball import Array
from drawing.cylinders import Cylinder
from drawing.product import Assembly, extent, occurrences
from drawing.truth import CadFrame, Joints, Triple, Y, document, twin_slides, value_rows
from drawing.wheels import wheel_places

from . import values as v
from .axle import EYE_AHEAD, OSCILLATION_Z
from .blade import SHIFT_AT, side_ram
from .frames import BEND_Z, FRONT, REAR, RIP_Y
from .linkage import (
    AXLE_X,
    BAR_Z,
    CENTRE_FOOT,
    CIRCLE,
    KING_Y,
    LEAN_EYE_Z,
    LEAN_FOOT_Y,
    LEAN_Y,
    LEAN_Z,
    LIFT_FOOT,
    MIDDLE_X,
    MIRROR,
    NOSE,
    RADIUS,
    REAR_X,
    RIPPER_FOOT,
    RIPPER_PIVOT,
    STEER_FOOT,
    STEER_Z,
    TANDEM_X,
    TIE,
    TIE_Z,
    TIP_FOOT,
    TIP_PIVOT,
    Linkage,
    measured,
    pitched,
    ripped,
)

FRAME = CadFrame((AXLE_X, 0.0, 0.0), x=(-1.0, 0.0, 0.0), z=(0.0, 0.0, 1.0))
"""From the ground below the front axle: x to the rear, y to the right, z up."""
X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
WHEELS = wheel_places(
    {"front": (AXLE_X, v.TREAD.value), "middle": (MIDDLE_X, v.TREAD.value), "rear": (REAR_X, v.TREAD.value)}, RADIUS
)


def three(p: Array) -> Triple:
    """A point as the truth has it."""
    return (float(p[0]), float(p[1]), float(p[2]))


def flat(p: Array, y: float = 0.0) -> Triple:
    """A point (x, z) at a y."""
    return (float(p[0]), y, float(p[1]))


def joints(k: Linkage, bend: Steering, down: float, up: float) -> dict[str, dict[str, Any]]:
    """Every joint but the saddle's, the drawbar turned down so far and the ripper up."""
    out = Joints(FRAME)

    def at(p: Array) -> Triple:
        return three(pitched(down, p))

    out.pivot(FRONT, REAR, (0, 0, BEND_Z), Z)
    out.pivot(FRONT, "front_axle", (AXLE_X, 0, OSCILLATION_Z), X)
    out.ball(FRONT, "drawbar", three(NOSE))
    axis = three(pitched(down, CIRCLE + np.array([0.0, 0.0, 1.0])) - pitched(down, CIRCLE))
    out.pivot("drawbar", "circle", at(CIRCLE), axis)
    out.pivot("circle", "blade_carrier", at(np.array(flat(TIP_PIVOT))))
    tip = [at(np.array(flat(p))) for p in (TIP_FOOT, TIP_PIVOT + k.tip_eye)]
    out.cylinder("blade_tip", "", ("circle", "blade_carrier"), tip[0], tip[1], Y)
    out.slide("blade_carrier", "moldboard", at(np.array([SHIFT_AT[0], 0.0, SHIFT_AT[1]])), Y)
    out.ball_cylinder("centre_shift", "", ("saddle", "drawbar"), three(CENTRE_FOOT), at(k.centre_eye))
    for letter, sign in (("_l", 1.0), ("_r", -1.0)):
        mirror = MIRROR if sign < 0 else np.ones(3)
        out.ball_cylinder(
            "blade_lift", letter, ("saddle", "drawbar"), three(LIFT_FOOT * mirror), at(k.lift_eye * mirror)
        )
        yoke, knuckle = f"lean_yoke{letter}", f"knuckle{letter}"
        out.pivot("front_axle", yoke, (AXLE_X, sign * LEAN_Y, LEAN_Z), X)
        out.ball(yoke, "leaning_bar", (AXLE_X + EYE_AHEAD, sign * LEAN_Y, BAR_Z))
        out.pivot(yoke, knuckle, (AXLE_X, sign * KING_Y, RADIUS), Z)
        out.ball(knuckle, "tie_rod", (AXLE_X + float(TIE[0]), sign * (KING_Y + float(TIE[1])), TIE_Z))
        foot, eye = ((AXLE_X + float(p[0]), sign * (KING_Y + float(p[1])), STEER_Z) for p in (STEER_FOOT, k.steer_eye))
        out.ball_cylinder("steering", letter, ("front_axle", knuckle), foot, eye)
        p, q = ((float(c[0]), sign * float(c[1]), BEND_Z) for c in (bend.P, bend.Q))
        out.cylinder("articulation", letter, (FRONT, REAR), p, q, Z)
        rip = [flat(RIPPER_FOOT, sign * RIP_Y), flat(ripped(up, k.ripper_eye), sign * RIP_Y)]
        out.cylinder("ripper_lift", letter, (REAR, "ripper_beam"), rip[0], rip[1], Y)
        case = f"bogie_beam{letter}"
        out.pivot(REAR, case, (TANDEM_X, 0, RADIUS))
        for end, carrier in (("front", knuckle), ("middle", case), ("rear", case)):
            wheel = f"{end}_wheel{letter}"
            out.pivot(carrier, wheel, WHEELS[wheel], name=f"{wheel}_joint")
    out.pivot(REAR, "ripper_beam", flat(RIPPER_PIVOT))
    x = AXLE_X - EYE_AHEAD
    foot = (x, LEAN_FOOT_Y, k.lean_foot_z)
    out.ball_cylinder("wheel_lean", "", ("front_axle", "lean_yoke_l"), foot, (x, LEAN_Y, LEAN_EYE_Z))
    return out.found


def drawn_values(root: Assembly) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.body.startswith(bodies)])

    tyres = {side: extent([x for x in leaves if x.role == f"rear_tyre_{side}"]) for side in "lr"}
    return {
        v.WIDTH.name: float(tyres["l"][1, 1] - tyres["r"][0, 1]),
        v.TREAD.name: float(tyres["l"].mean(0)[1] - tyres["r"].mean(0)[1]),
        v.HEIGHT.name: float(of("front_frame")[1, 2]),
        v.CYLINDERS_HEIGHT.name: float(of("blade_lift_cylinder")[1, 2]),
        v.AXLE_HEIGHT.name: float(of("front_wheel_l").mean(0)[2]),
        v.LENGTH.name: float(np.ptp(of("")[:, 0])),
        v.GROUND_CLEARANCE.name: float(of("rear_frame")[0, 2]),
        v.BLADE_LENGTH.name: float(np.ptp(of("moldboard")[:, 1])),
        v.TANDEM.name: float(of("middle_wheel_l").mean(0)[0] - of("rear_wheel_l").mean(0)[0]),
    }


def truth(
    root: Assembly, k: Linkage, bend: Steering, down: float, up: float, drawn: dict[str, Cylinder]
) -> dict[str, Any]:
    """The document written as `truth.json`."""
    slides = twin_slides({"blade_lift": drawn["lift"], "steering": drawn["steer"], "articulation": drawn["bend"],
                          "ripper_lift": drawn["ripper"]})  # fmt: skip
    for name, key in (("centre_shift", "centre"), ("blade_tip", "tip"), ("wheel_lean", "lean")):
        slides[f"{name}_cylinder_barrel2{name}_piston_rod_joint"] = drawn[key].slide()
    rows = value_rows((*v.PUBLISHED, *v.EXAMPLE), measured(), drawn_values(root))
    rams = {"blade_carrier2moldboard_joint": side_ram().slide()}
    return document(FRAME, root, joints(k, bend, down, up), slides, rows, rams=rams)
