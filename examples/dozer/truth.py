"""The truth about the drawn machine: what each part is, where each joint is, what the linkage and the shapes give. CAD
frame, metres."""

from __future__ import annotations

from typing import Any

import numpy as np

from drawing.cylinders import Cylinder
from drawing.product import Assembly, extent, occurrences
from drawing.truth import CadFrame, Joints, Triple, document, twin_slides, value_rows

from . import values as v
from .carrier import TRACK
from .linkage import (
    ANGLE_FOOT,
    BALL,
    CORNER,
    LIFT_FOOT,
    LINK,
    PIVOT,
    Linkage,
    angle_of,
    raised,
    tilt_of,
)

FRAME = CadFrame((0.0, 0.0, 0.0), x=(0.0, -1.0, 0.0), z=(0.0, 0.0, 1.0))
"""From the ground below the middle of the tracks: x to the right, y forward, z up."""


def joints(k: Linkage, up: float) -> dict[str, Any]:
    """Every joint of the machine but the tracks'."""
    out = Joints(FRAME)

    def at(p: Any, sign: float = 1.0) -> Triple:
        x, y, z = (float(c) for c in raised(up, np.array(p)))
        return (x, sign * y, z)

    out.pivot("main_frame", "c_frame", tuple(map(float, PIVOT)))  # type: ignore[arg-type]
    out.ball("c_frame", "blade", at(BALL))
    out.ball("c_frame", "pitch_link", at(LINK[0]))
    out.ball("pitch_link", "blade", at(LINK[1]))
    for letter, sign in (("_l", 1.0), ("_r", -1.0)):
        foot = (float(LIFT_FOOT[0]), sign * float(LIFT_FOOT[1]), float(LIFT_FOOT[2]))
        out.ball_cylinder("lift", letter, ("main_frame", "c_frame"), foot, at(k.lift_eye, sign))
        out.ball_cylinder("angle", letter, ("c_frame", "blade"), at(ANGLE_FOOT, sign), at(k.angle_eye, sign))
    out.ball_cylinder("tilt", "", ("c_frame", "blade"), at(k.tilt_foot), at(k.tilt_eye))
    return out.found


def measured(k: Linkage, up: float) -> dict[str, float]:
    """What the solved linkage gives, by the value's name; millimetres and degrees."""
    high, low = (k.turn_at(k.lift_closed + share * v.LIFT_STROKE.value) for share in (0.0, 1.0))
    return {
        v.LIFT_HEIGHT.name: float(raised(high, CORNER)[2]),
        v.DIG_DEPTH.name: -float(raised(low, CORNER)[2]),
        v.MAX_TILT.name: tilt_of(k.blade(v.TILT_STROKE.value / 2, 0.0), up),
        v.BLADE_ANGLE.name: angle_of(k.blade(0.0, -v.ANGLE_STROKE.value / 2), up),
    }


def drawn_values(root: Assembly) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.body.startswith(bodies)])

    shoes, left, frame = of("track_shoe"), of("track_shoe_l"), of("main_frame")
    hull = extent([leaf for leaf in leaves if leaf.part.name == "HULL"])
    return {
        v.TRACK_GAUGE.name: float(left.mean(0)[1] - of("track_shoe_r").mean(0)[1]),
        v.SHOE_WIDTH.name: float(np.ptp(left[:, 1])),
        v.WIDTH.name: float(np.ptp(shoes[:, 1])),
        v.TRACK_ON_GROUND.name: 2 * TRACK.half,
        v.GROUND_CLEARANCE.name: float(hull[0, 2]),
        v.HEIGHT.name: float(frame[1, 2]),
        v.BARE_LENGTH.name: float(np.ptp(of("main_frame", "track_shoe")[:, 0])),
        v.BLADE_WIDTH.name: float(np.ptp(of("blade")[:, 1])),
    }


def truth(root: Assembly, k: Linkage, up: float, drawn: dict[str, Cylinder]) -> dict[str, Any]:
    """The document written as `truth.json`."""
    slides = twin_slides({name: drawn[name] for name in ("lift", "angle")})
    slides["tilt_cylinder_barrel2tilt_piston_rod_joint"] = drawn["tilt"].slide()
    rows = value_rows((*v.PUBLISHED, *v.EXAMPLE), measured(k, up), drawn_values(root))
    return document(FRAME, root, joints(k, up), slides, rows, main_frame_with=TRACK.bodies())
