"""A wheel, drawn about the origin with its axle along y and its outer side towards +y. Millimetres."""

from __future__ import annotations

import math

from drawing.hardware import bolt
from drawing.product import BLACK, GREY, YELLOW, Assembly, Part
from drawing.solids import Y, cut, rod, shift, turned

from . import values as v

SPINDLE = 100.0
"""Diameter of the spindle it turns on."""
TYRE_DENSITY = 1100.0


def draw_wheel() -> Assembly:
    """Tyre, rim, hub, cap and eight wheel bolts; everything is tagged "wheel", the tyre's role "tyre"."""
    tree = Assembly(f"WHEEL {v.TYRE_SIZE}")
    r, w = v.TYRE_DIAMETER.value / 2, v.TYRE_WIDTH.value / 2
    outside = [(-100, 190), (-110, 215), (-w, 290), (-w, 330), (-106, 395), (-82, r)]
    inside = [(-82, 190), (-86, 215), (-97, 285), (-97, 325), (-88, 365), (-70, r - 34)]
    profile = outside + [(-s, q) for s, q in reversed(outside)] + [(-s, q) for s, q in inside] + list(reversed(inside))
    tree.add(Part("TYRE", turned(profile), BLACK, TYRE_DENSITY), "wheel", "tyre")
    rim = [(-108, 190), (-108, 212), (-101, 212), (-101, 190), (101, 190), (101, 212), (108, 212), (108, 190)]
    rim += [(108, 176), (30, 176), (30, 100), (14, 100), (14, 176), (-108, 176)]
    circle = [(125 * math.cos(math.radians(45 * i)), 125 * math.sin(math.radians(45 * i))) for i in range(8)]
    holes = [rod((x, -50, z), Y, 9, 200) for x, z in circle]
    tree.add(Part("RIM", cut(turned(rim), *holes), YELLOW), "wheel")
    hub = turned([(-90, SPINDLE / 2 + 0.2), (14, SPINDLE / 2 + 0.2), (14, 150), (0, 150), (-4, 95), (-90, 88)])
    tree.add(Part("HUB", cut(hub, *holes), GREY), "wheel")
    cap = turned([(30, 60), (30, 108), (62, 98), (76, 64), (76, 0), (64, 0), (64, 60)])
    tree.add(Part("HUB CAP", cap, GREY), "wheel")
    for x, z in circle:
        tree.add(bolt(18, 34), "wheel", at=shift(x, 30, z))
    return tree
