"""The truth about a drawn machine: what each part is, where each joint is, what linkage and shapes give. CAD frame,
metres."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from drawing.cylinders import Cylinder
from drawing.planar import Point
from drawing.product import Assembly, extent, occurrences
from drawing.stabiliser import leg_joints
from drawing.steer_axle import steering_joints
from drawing.truth import CadFrame, Joints, Triple, document, twin_slides, value_rows
from drawing.wheels import wheel_places

from . import values as v
from .linkage import (
    FRONT_X,
    HIGH,
    LEG_X,
    LEVEL_FROM,
    LEVEL_ON,
    LOW,
    RADIUS,
    TREAD,
    printed,
    solve_axle,
    solve_stabiliser,
    turning_radius,
)

if TYPE_CHECKING:
    from .draw import Drawn

FRAME = CadFrame((1_200.0, 0.0, 0.0), x=(0.0, 1.0, 0.0), z=(0.0, 0.0, 1.0))
"""From a point of the drawing office's: x to the left, y backward, z up."""
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
STEERING = {end: f"{end}_axle2{end}_steering_piston_rod_joint" for end in ("front", "rear")}


def _high(p: Point) -> Triple:
    return float(p[0]), 0.0, float(p[1])


def joints(d: Drawn) -> dict[str, dict[str, Any]]:
    """Every joint of the machine."""
    found, k, pose = Joints(FRAME), d.k, d.pose
    places = wheel_places({"front": (FRONT_X, TREAD), "rear": (0.0, TREAD)}, RADIUS)
    for end in ("front", "rear"):
        axle = solve_axle(end, k.sections)
        steering_joints(found, axle)
        if axle.fast:
            found.found[STEERING[end]]["body0"] = "chassis"
        for letter in "lr":
            wheel = f"{end}_wheel_{letter}"
            found.pivot(f"{end}_knuckle_{letter}", wheel, places[wheel], name=f"{wheel}_joint")
    found.pivot("chassis", "boom", _high(k.P))
    pins = {name: (_high(p), _high(q)) for name, (p, q) in d.pins.items()}
    found.cylinder("lift", "", ("chassis", "boom"), *pins["lift"], Y)
    found.cylinder("compensation", "", ("chassis", "boom"), *pins["compensation"], Y)
    along = (math.cos(pose.boom), 0.0, math.sin(pose.boom))
    first = "inner_boom" if k.sections == 2 else "middle_boom"
    found.slide("boom", first, _high(k.P), along)
    if k.sections > 2:
        found.slide("middle_boom", "inner_boom", _high(k.P), along)
    found.cylinder("telescope", "", ("boom", first), *pins["telescope"], Y)
    found.pivot("inner_boom", "carriage", _high(pose.N))
    found.cylinder("tilt", "", ("inner_boom", "carriage"), *pins["tilt"], Y)
    if k.sections > 2:
        p, q = ((FRONT_X, float(at[0]), float(at[1])) for at in (LEVEL_FROM, LEVEL_ON))
        found.cylinder("levelling", "", ("chassis", "front_axle"), p, q, X)
        leg_joints(found, solve_stabiliser(), d.leg, sum(LEG_X) / 2, "chassis")
    return found.found


def drawn_values(root: Assembly) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.body.startswith(bodies)])

    chassis, wheels = of("chassis"), of("front_wheel", "rear_wheel")
    return {
        v.WHEELBASE.name: float(of("front_wheel").mean(0)[0] - of("rear_wheel").mean(0)[0]),
        v.OVERALL_HEIGHT.name: float(chassis[1, 2]),
        v.GROUND_CLEARANCE.name: float(chassis[0, 2]),
        v.OVERALL_WIDTH.name: float(np.ptp(wheels[:, 1])),
        v.TYRE_DIAMETER.name: float(np.ptp(of("rear_wheel")[:, 2])),
    }


def calculated(d: Drawn) -> dict[str, float]:
    """What the linkages give, by the value's name; millimetres, degrees, seconds at the pump's flow."""

    def seconds(bore: v.Value, stroke: v.Value) -> float:
        return math.pi / 4 * bore.value**2 * stroke.value * 1e-6 / (v.FLOW.value / 60)

    front = solve_axle("front", d.k.sections)
    return d.k.values() | {
        v.LIFT_STROKE.name: d.k.lift(HIGH) - d.k.lift(LOW),
        v.STEER_ANGLE.name: math.degrees(front.knuckle_angle(-v.STEER_STROKE.value / 2)),
        v.TURNING_RADIUS.name: turning_radius(front, v.TYRE_WIDTH.value),
        v.LIFT_TIME.name: seconds(v.LIFT_BORE, v.LIFT_STROKE),
        v.EXTEND_TIME.name: seconds(v.TELESCOPE_BORE, v.TELESCOPE_STROKE),
    }


def truth(root: Assembly, d: Drawn, drawn: dict[str, Cylinder]) -> dict[str, Any]:
    """The document written as `truth.json`."""
    slides: dict[str, Any] = twin_slides({name: c for name, c in drawn.items() if name == "stabilizer"})
    single = ("lift", "compensation", "telescope", "tilt", "levelling")
    slides |= {f"{n}_cylinder_barrel2{n}_piston_rod_joint": c.slide() for n, c in drawn.items() if n in single}
    slides |= {slide: solve_axle(end, d.k.sections).ram().slide() for end, slide in STEERING.items()}
    values = [printed(value, d.k.sections) for value in (*v.PUBLISHED, *v.EXAMPLE)]
    return document(FRAME, root, joints(d), slides, value_rows(values, calculated(d), drawn_values(root)))
