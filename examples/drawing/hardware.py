"""Pins, bushes, keeper plates and bolts; shapes are shared between their occurrences. Millimetres."""

from __future__ import annotations

import functools
import math

from OCP.gp import gp_Trsf

from .product import BRONZE, GREY, STEEL, Assembly, Part
from .solids import X, Y, Z, bored, fuse, plate, ring, rod, shift, turn

CLEARANCE = 0.2
"""Radial clearance between a pin and the bores that turn on it."""
KEEPER = 14.0
"""Thickness of a pin's keeper plate."""


@functools.cache
def pin(diameter: float, length: float) -> Part:
    """A plain pin from the origin along +y."""
    return Part(f"PIN D{diameter:g}x{length:g}", rod((0, 0, 0), Y, diameter / 2, length), STEEL)


@functools.cache
def bush(outer: float, inner: float, length: float) -> Part:
    """A bush from the origin along +y; `inner` is the pin's diameter, the bore is larger by the clearance."""
    return Part(
        f"BUSH {outer:g}/{inner:g}x{length:g}",
        ring((0, 0, 0), Y, outer / 2, inner / 2 + CLEARANCE, length),
        BRONZE,
    )


@functools.cache
def bolt(size: float, length: float) -> Part:
    """A hexagon bolt: the shank goes from the origin along -y, the head sits at y = 0 .. 0.65 size."""
    r = 0.75 * size / math.cos(math.pi / 6)
    hexagon = [(r * math.cos(math.radians(60 * i)), r * math.sin(math.radians(60 * i)), 0.0) for i in range(6)]
    shape = fuse(plate(hexagon, "xz", 0.0, 0.65 * size), rod((0, -length, 0), Y, size / 2, length))
    return Part(f"BOLT M{size:g}x{length:g}", shape, GREY)


@functools.cache
def keeper(diameter: float) -> Part:
    """Keeper plate lying on y = 0: over half of the pin's end and on to the plate below it (towards -z)."""
    low = diameter / 2 + 32
    corners = [(-28.0, -low, 0.0), (28.0, -low, 0.0), (28.0, 0.0, 0.0), (-28.0, 0.0, 0.0)]
    hole = ((0.0, 0.0, -diameter / 2 - 15), 8.0)
    return Part(f"KEEPER PL {diameter:g}", bored(plate(corners, "xz", 0.0, KEEPER), Y, hole), STEEL)


def fit_pin(
    tree: Assembly,
    at: tuple[float, float, float],
    diameter: float,
    length: float,
    body: str,
    role: str,
    *,
    upright: bool = False,
    keep: tuple[float, ...] = (),
    turned: float = 0.0,
) -> None:
    """A pin from `at` along +y (upright: +z), and keeper plates with a bolt on the ends named in `keep` (-1
    first end, +1 last).

    `turned`: degrees about the pin axis that bring the keeper from "towards -z" to where the plate under it
    has its meat.
    """
    base = shift(*at)
    if upright:
        base = base.Multiplied(turn(X, 90.0))
    tree.add(pin(diameter, length), body, role, base)
    for end in keep:
        place = base.Multiplied(shift(0, length if end > 0 else 0.0, 0)).Multiplied(turn(Y, turned))
        if end < 0:
            place = place.Multiplied(turn(Z, 180.0))
        tree.add(keeper(diameter), body, at=place)
        tree.add(bolt(16, 30), body, at=place.Multiplied(shift(0, KEEPER, -diameter / 2 - 15)))


def placed(origin: tuple[float, float, float], angle: float) -> gp_Trsf:
    """Frame of a linkage part: x axis raised by `angle` (radians) from the machine's x axis."""
    return shift(*origin).Multiplied(turn(Y, -math.degrees(angle)))
