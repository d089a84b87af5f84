"""The truth about the drawn truck: what each part is, where each joint is, what layout and shapes give. CAD frame,
metres."""

from __future__ import annotations

from typing import Any

import numpy as np

from drawing.cylinders import Cylinder
from drawing.product import Assembly, extent, occurrences
from drawing.truth import CadFrame, Joints, Y, document, twin_slides, value_rows
from drawing.wheels import wheel_places

from . import values as v
from .layout import (
    BOGIE_X,
    FRONT_X,
    HOIST_Y,
    MIDDLE_X,
    RADIUS,
    REAR_X,
    ROLL_Z,
    STEER_Z,
    TIPPER,
    measured,
    solve_hoist,
    solve_steering,
)

FRAME = CadFrame((FRONT_X, 0.0, RADIUS), x=(0.0, -1.0, 0.0), z=(1.0, 0.0, 0.0))
"""From the middle of the front axle, as the drawing office of this example has it: x to the right, y up, z forward."""
X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
WHEELS = wheel_places(
    {"front": (FRONT_X, v.FRONT_TREAD.value), "middle": (MIDDLE_X, v.REAR_TREAD.value),
     "rear": (REAR_X, v.REAR_TREAD.value)}, RADIUS,
)  # fmt: skip


def joints(raised: float) -> dict[str, dict[str, Any]]:
    """Every joint of the truck, its body raised so far (radians)."""
    found, steering, hoist = Joints(FRAME), solve_steering(), solve_hoist()
    found.pivot("front_frame", "hitch", (0, 0, STEER_Z), Z)
    found.pivot("hitch", "rear_frame", (0, 0, ROLL_Z), X)
    found.pivot("rear_frame", "dump_body", (float(TIPPER.hinge[0]), 0, float(TIPPER.hinge[1])))
    rod = TIPPER.carry(raised, hoist.D)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        beam = f"bogie_beam_{letter}"
        found.pivot("rear_frame", beam, (BOGIE_X, 0, RADIUS))
        p, q = ((float(at[0]), sign * float(at[1]), STEER_Z) for at in (steering.P, steering.Q))
        found.cylinder("steering", f"_{letter}", ("front_frame", "hitch"), p, q, Z)
        c, d = ((float(at[0]), sign * HOIST_Y, float(at[1])) for at in (hoist.C, rod))
        found.cylinder("hoist", f"_{letter}", ("rear_frame", "dump_body"), c, d, Y)
        for end, carrier in (("front", "front_frame"), ("middle", beam), ("rear", beam)):
            wheel = f"{end}_wheel_{letter}"
            found.pivot(carrier, wheel, WHEELS[wheel], name=f"{wheel}_joint")
    return found.found


def drawn_values(root: Assembly, raised: float) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> Any:
        return [leaf for leaf in leaves if leaf.body.startswith(bodies)]

    tractor, tyres = extent(of("front_frame")), extent([x for x in leaves if x.part.name.startswith("TYRE")])
    body = of("dump_body")
    lowered = TIPPER.carried(raised).Inverted()
    up = TIPPER.carried(TIPPER.dump).Multiplied(lowered)
    low, high = extent(body, lowered), extent(body, up)
    walls = extent([leaf for leaf in body if leaf.part.name.startswith("BODY SIDE")], lowered)

    def middle(wheel: str) -> Any:
        return extent(of(wheel)).mean(0)

    return {
        v.LENGTH.name: float(tractor[1, 0] - low[0, 0]),
        v.OVERALL_WIDTH.name: float(np.ptp(tyres[:, 1])),
        v.HEIGHT.name: float(tractor[1, 2]),
        v.RAISED_HEIGHT.name: float(high[1, 2]),
        v.DUMP_CLEARANCE.name: float(high[0, 2]),
        v.LOADING_HEIGHT.name: float(walls[1, 2]),
        v.BODY_WIDTH.name: float(np.ptp(low[:, 1])),
        v.BOGIE_SPACING.name: float(middle("middle_wheel_l")[0] - middle("rear_wheel_l")[0]),
        v.FRONT_OVERHANG.name: float(tractor[1, 0] - middle("front_wheel_l")[0]),
        v.GROUND_CLEARANCE.name: float(extent(of("front_frame", "hitch", "rear_frame"))[0, 2]),
        v.TYRE_DIAMETER.name: float(np.ptp(tyres[:, 2])),
    }


def truth(root: Assembly, raised: float, drawn: dict[str, Cylinder]) -> dict[str, Any]:
    """The document written as `truth.json`."""
    values = value_rows((*v.PUBLISHED, *v.EXAMPLE), measured(), drawn_values(root, raised))
    return document(FRAME, root, joints(raised), twin_slides(drawn), values)
