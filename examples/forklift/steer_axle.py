"""Where the forklift's steered rear axle is, and how large. Machine frame, millimetres."""

from __future__ import annotations

from drawing.steer_axle import SteerAxle

from . import values as v
from .wheels import SPINDLE

AXLE = SteerAxle(
    "steer_axle", -v.WHEELBASE.value, 420.0, king=680.0, arm=(-v.WHEELBASE.value - 150.0, 700.0),
    end=(-v.WHEELBASE.value - 200.0, 320.0), ram_z=345.0, tie_z=302.0, wheel_z=v.TYRE_DIAMETER.value / 2,
    spindle=(SPINDLE, 120.0), bore=v.STEER_BORE.value, rod=v.STEER_ROD.value, stroke=v.STEER_STROKE.value,
)  # fmt: skip
