"""The truth about the drawn truck: what each part is, where each joint is, what layout and shapes give. CAD frame,
metres."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from drawing.cylinders import Cylinder
from drawing.planar import vec
from drawing.product import Assembly, extent, occurrences
from drawing.truth import CadFrame, Joints, Y, document, twin_slides, value_rows
from drawing.wheels import wheel_places

from . import values as v
from .layout import (
    CANOPY_X,
    FRONT_X,
    HOIST_Y,
    KING,
    LOCK,
    NOSE,
    RADIUS,
    STEER_Z,
    TAIL,
    TAIL_LOW,
    TIE,
    TIPPER,
    outer,
    solve_hoist,
    solve_steering,
)

FRAME = CadFrame((0.0, 0.0, 1000.0), x=(0.0, 1.0, 0.0), z=(1.0, 0.0, 0.0))
"""From over the rear axle, as the drawing office of this example has it: x to the left, y down, z forward."""
Z = (0.0, 0.0, 1.0)
WHEELS = wheel_places({"front": (FRONT_X, v.FRONT_TREAD.value), "rear": (0.0, v.REAR_TREAD.value)}, RADIUS)


def joints(raised: float) -> dict[str, dict[str, Any]]:
    """Every joint of the truck, its body raised so far (radians)."""
    found, steering, hoist = Joints(FRAME), solve_steering(), solve_hoist()
    found.pivot("chassis", "dump_body", (float(TIPPER.hinge[0]), 0, float(TIPPER.hinge[1])))
    rod = TIPPER.carry(raised, hoist.D)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        knuckle = f"knuckle_{letter}"
        found.pivot("chassis", knuckle, (float(KING[0]), sign * float(KING[1]), RADIUS), Z)
        found.pivot(knuckle, "tie_rod", (float(TIE[0]), sign * float(TIE[1]), RADIUS), Z)
        p, q = ((float(at[0]), sign * float(at[1]), STEER_Z) for at in (steering.P, steering.Q))
        found.cylinder("steering", f"_{letter}", ("chassis", knuckle), p, q, Z)
        c, d = ((float(at[0]), sign * HOIST_Y, float(at[1])) for at in (hoist.C, rod))
        found.cylinder("hoist", f"_{letter}", ("chassis", "dump_body"), c, d, Y)
        for end, carrier in (("front", knuckle), ("rear", "chassis")):
            wheel = f"{end}_wheel_{letter}"
            found.pivot(carrier, wheel, WHEELS[wheel], name=f"{wheel}_joint")
    return found.found


def measured() -> dict[str, float]:
    """What the solved layout gives, by the value's name; millimetres and degrees."""
    hoist, steering = solve_hoist(), solve_steering()
    raised = hoist.raised(v.HOIST_CLOSED.value + v.HOIST_STROKE.value)
    corners = [(CANOPY_X, v.CANOPY_HEIGHT.value), (TAIL, TAIL_LOW)]
    canopy, tail = (float(TIPPER.carry(raised, vec(x, z))[1]) for x, z in corners)
    return {
        v.LENGTH.name: NOSE - TAIL,
        v.BODY_LENGTH.name: CANOPY_X - TAIL,
        v.RAISED_HEIGHT.name: canopy,
        v.DUMP_CLEARANCE.name: tail,
        v.DUMP_ANGLE.name: math.degrees(raised),
        v.STEER_STROKE.name: steering.length(-outer(LOCK)) - steering.length(LOCK),
    }


def drawn_values(root: Assembly, raised: float) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> Any:
        return [leaf for leaf in leaves if leaf.body.startswith(bodies)]

    def named(name: str, where: Any = None) -> Any:
        return extent([leaf for leaf in leaves if leaf.part.name.startswith(name)], where)

    lowered = TIPPER.carried(raised).Inverted()
    up = TIPPER.carried(TIPPER.dump).Multiplied(lowered)
    chassis, tyres, low, high = extent(of("chassis")), named("TYRE"), extent(of("dump_body"), lowered), None
    high = extent(of("dump_body"), up)
    return {
        v.LENGTH.name: float(chassis[1, 0] - low[0, 0]),
        v.BODY_LENGTH.name: float(np.ptp(low[:, 0])),
        v.REAR_OVERHANG.name: -float(low[0, 0]),
        v.HEIGHT.name: float(chassis[1, 2]),
        v.CANOPY_HEIGHT.name: float(low[1, 2]),
        v.RAISED_HEIGHT.name: float(high[1, 2]),
        v.DUMP_CLEARANCE.name: float(high[0, 2]),
        v.LOADING_HEIGHT.name: float(named("TOP RAIL", lowered)[1, 2]),
        v.CANOPY_WIDTH.name: float(np.ptp(named("CANOPY", lowered)[:, 1])),
        v.BODY_WIDTH.name: float(np.ptp(named("BODY RIB", lowered)[:, 1])),
        v.TYRES_WIDTH.name: float(np.ptp(tyres[:, 1])),
        v.TYRE_DIAMETER.name: float(np.ptp(tyres[:, 2])),
        v.WHEELBASE.name: float(extent(of("front_wheel")).mean(0)[0] - extent(of("rear_wheel")).mean(0)[0]),
        v.AXLE_CLEARANCE.name: float(named("REAR AXLE HOUSING")[0, 2]),
    }


def truth(root: Assembly, raised: float, drawn: dict[str, Cylinder]) -> dict[str, Any]:
    """The document written as `truth.json`."""
    values = value_rows((*v.PUBLISHED, *v.EXAMPLE), measured(), drawn_values(root, raised))
    return document(FRAME, root, joints(raised), twin_slides(drawn), values)
