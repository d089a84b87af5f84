"""Draws a 7 t counterbalance forklift of the Mitsubishi FD70N class as one STEP assembly, and the truth about it.

`python -m forklift.draw [folder]`, run in `examples/`, writes `forklift.step` and `truth.json`; the same bytes every
time. The values it is drawn to are in `values.py`. `draw_machine(Mast("triplex", …))` draws it with another mast.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

from drawing.cylinders import Cylinder, draw_cylinder
from drawing.files import run, write_example
from drawing.hardware import placed
from drawing.product import Assembly, Use
from drawing.solids import Z, shift, turn
from drawing.steer_axle import draw_steer_axle

from . import values as v
from .chassis import TILT_ANCHOR, draw_frame, draw_front_axle, draw_top
from .mast import MID, PIN_TILT, PIVOT, TILT_BACK, Mast, draw_mast, half_depth, tilt_pin_y
from .steer_axle import AXLE
from .truth import FRAME, truth
from .wheels import draw_wheel


def tilt_lengths(pin: tuple[float, float]) -> tuple[float, float, float]:
    """Of a tilt cylinder whose rod's pin is at `pin` with the mast upright: tilted back, upright, tilted forward."""
    arm, anchor = np.array(pin) - PIVOT, np.array(TILT_ANCHOR) - PIVOT

    def length(forward: float) -> float:
        c, s = math.cos(math.radians(forward)), math.sin(math.radians(forward))
        return float(np.hypot(*(np.array([c * arm[0] + s * arm[1], c * arm[1] - s * arm[0]]) - anchor)))

    return length(-v.TILT_BACKWARD.value), length(0.0), length(v.TILT_FORWARD.value)


def tilt_pin(mast: Mast) -> tuple[float, float]:
    """Where the tilt cylinders' rods are pinned to the upright mast: so high that the published stroke gives both
    angles."""
    x = MID - half_depth(mast.stages - 1) - TILT_BACK

    def over(z: float) -> float:
        back, _, forward = tilt_lengths((x, z))
        return forward - back - v.TILT_STROKE.value

    return x, float(brentq(over, 700.0, 1600.0, xtol=1e-12))


def tilt_cylinder(mast: Mast) -> Cylinder:
    """Sizes of a tilt cylinder."""
    back, upright, _ = tilt_lengths(tilt_pin(mast))
    return Cylinder(
        "TILT CYL", v.TILT_BORE.value, v.TILT_ROD.value, v.TILT_STROKE.value, back, upright,
        outside=110, pin=PIN_TILT, eye=42, eye_width=44, base=75, cap=25, piston=45, gland=55,
    )  # fmt: skip


def _wheel_names(end: str, letter: str) -> dict[str, str]:
    return {"wheel": f"{end}_wheel_{letter}", "tyre": f"{end}_tyre_{letter}"}


def draw_machine(mast: Mast) -> Assembly:
    """The whole product tree, in the machine frame."""
    hardware = Assembly("HARDWARE")
    root = Assembly("FORKLIFT GA")
    rod = tilt_pin(mast)
    axle = draw_front_axle(mast, hardware)
    rear = draw_steer_axle(AXLE, hardware)
    tilt = draw_cylinder(tilt_cylinder(mast))
    hydraulics = Assembly("TILT CYLINDERS")
    angle = math.atan2(rod[1] - TILT_ANCHOR[1], rod[0] - TILT_ANCHOR[0])
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        at = placed((TILT_ANCHOR[0], sign * tilt_pin_y(mast), TILT_ANCHOR[1]), angle)
        names = {"barrel": f"tilt_cylinder_barrel_{letter}", "rod": f"tilt_piston_rod_{letter}"}
        hydraulics.uses.append(Use(tilt, at, names=names))
    wheel = draw_wheel()
    z = v.TYRE_DIAMETER.value / 2
    places = (
        ("front", axle, 0.0, v.FRONT_TREAD.value / 2), ("rear", rear, -v.WHEELBASE.value, v.REAR_TREAD.value / 2),
    )  # fmt: skip
    for end, group, x, half in places:
        group.uses.append(Use(wheel, shift(x, half, z), names=_wheel_names(end, "l")))
        right = shift(x, -half, z).Multiplied(turn(Z, 180.0))
        group.uses.append(Use(wheel, right, names=_wheel_names(end, "r")))
    frame = Assembly("CHASSIS ASSY")
    for child in (draw_frame(mast, hardware), axle, draw_top()):
        frame.add(child)
    for child in (frame, rear, draw_mast(mast, rod, hardware), hydraulics, hardware):
        root.add(child)
    return root


def main(folder: Path, mast: Mast | None = None) -> None:
    """Writes both files into `folder`."""
    mast = mast or Mast()
    root = draw_machine(mast)
    document = truth(root, mast, tilt_pin(mast), TILT_ANCHOR, tilt_cylinder(mast))
    write_example(folder, "forklift", root, FRAME, document)


if __name__ == "__main__":
    run(main, __file__)
