"""Wheels of earthmoving machines, drawn about the origin, the axle along y, the outer side towards +y. Millimetres."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from .hardware import bolt
from .product import BLACK, GREY, YELLOW, Assembly, Part, Use
from .solids import Y, Z, cut, rod, shift, turn, turned

TYRE_DENSITY = 1100.0
CLEARANCE = 0.2
"""Radial, between hub and spindle."""


@dataclass(frozen=True, slots=True)
class WheelSizes:
    """Radii of tyre, bead and spindle, the tyre's width, radius of the circle of bolts and their number; `inner` is how
    far the hub reaches inwards."""

    name: str
    radius: float
    width: float
    bead: float
    spindle: float
    circle: float
    bolts: int
    inner: float = 215.0


def draw_wheel(w: WheelSizes) -> Assembly:
    """Tyre, rim, hub, cap and bolts; bodies are tagged "wheel", the tyre's role "tyre"."""
    tree = Assembly(f"WHEEL ASSY {w.name}")
    r, b, h = w.radius, w.bead, w.width / 2
    outside = [(-0.74 * h, b), (-0.78 * h, b + 30), (-0.92 * h, 0.47 * r), (-h, 0.62 * r), (-h, 0.7 * r)]
    outside += [(-0.95 * h, 0.88 * r), (-0.88 * h, r - 18), (-0.78 * h, r)]
    inside = [(-0.58 * h, b), (-0.6 * h, b + 55), (-0.76 * h, 0.5 * r), (-0.86 * h, 0.62 * r), (-0.86 * h, 0.7 * r)]
    inside += [(-0.82 * h, 0.82 * r), (-0.7 * h, r - 100)]
    profile = outside + [(-s, q) for s, q in reversed(outside)] + [(-s, q) for s, q in inside] + list(reversed(inside))
    tree.add(Part(f"TYRE {w.name}", turned(profile), BLACK, TYRE_DENSITY), "wheel", "tyre")
    edge, lip = 0.74 * h, 0.8 * h
    rim = [(-lip, b), (-lip, b + 34), (-edge, b + 34), (-edge, b), (edge, b), (edge, b + 34), (lip, b + 34), (lip, b)]
    rim += [(lip, b - 18), (90, b - 18), (90, 2 * w.spindle), (66, 2 * w.spindle), (66, b - 18), (-lip, b - 18)]
    steps = [2.0 * math.pi * i / w.bolts for i in range(w.bolts)]
    places = [(w.circle * math.cos(a), w.circle * math.sin(a)) for a in steps]
    holes = [rod((x, 0, z), Y, 11, 200) for x, z in places]
    tree.add(Part("RIM", cut(turned(rim), *holes), YELLOW), "wheel")
    bore, flange = w.spindle + CLEARANCE, w.circle + 35
    hub = [(-w.inner, bore), (66, bore), (66, flange), (34, flange), (20, 1.85 * w.spindle)]
    hub += [(0.4 * -w.inner, 1.85 * w.spindle), (-w.inner, 1.5 * w.spindle)]
    tree.add(Part("HUB", cut(turned(hub), *holes), GREY), "wheel")
    q = 1.9 * w.spindle
    cap = turned([(66, 0.75 * w.spindle), (66, q), (150, 0.95 * q), (185, 0.65 * q), (185, 0), (160, 0)])
    tree.add(Part("PLANET COVER", cap, YELLOW), "wheel")
    for x, z in places:
        tree.add(bolt(22, 60), "wheel", at=shift(x, 90, z))
    return tree


def draw_dual(w: WheelSizes, apart: float) -> Assembly:
    """Two tyres on their rims, their middles `apart`, on one hub; bodies are tagged "wheel", the tyres' role "tyre"."""
    tree, single = Assembly(f"DUAL WHEEL ASSY {w.name}"), draw_wheel(w)
    tyre, (half, b) = single.uses[0].child, (w.width / 2, w.bead)
    edge, lip = 0.74 * half, 0.8 * half
    ends = [(-lip, b), (-lip, b + 34), (-edge, b + 34), (-edge, b)]
    profile = [*ends, *[(-s, r) for s, r in reversed(ends)], (lip, b - 18), (-lip, b - 18)]
    rim = Part("DUAL RIM", turned(profile), YELLOW)
    for y in (apart / 2, -apart / 2):
        tree.add(tyre, "wheel", "tyre", shift(0, y, 0))
        tree.add(rim, "wheel", at=shift(0, y, 0))
    out, long, s = apart / 2 + edge, 0.62 * apart, w.spindle
    drum = [(long, s + CLEARANCE), (long, s + 60), (40.0, s + 60), (40.0, b - 50), (out, b - 50), (out, b - 18)]
    tree.add(Part("DUAL HUB", turned([*drum, *[(-y, r) for y, r in reversed(drum)]]), GREY), "wheel")
    cap = turned([(long, 0.0), (long, s + 50), (long + 60, s + 20), (long + 60, 0.0)])
    tree.add(Part("PLANET COVER", cap, YELLOW), "wheel")
    return tree


def wheel_places(treads: Mapping[str, tuple[float, float]], height: float) -> dict[str, tuple[float, float, float]]:
    """`<end>_wheel_<side>` → the wheel's middle, of (x, tread) by end."""
    return {
        f"{end}_wheel_{letter}": (x, sign * tread / 2, height)
        for end, (x, tread) in treads.items()
        for letter, sign in (("l", 1.0), ("r", -1.0))
    }


def put_wheels(tree: Assembly, wheel: Assembly, places: Mapping[str, tuple[float, float, float]]) -> None:
    """A wheel at each place, the right ones turned round; its tyre's role is as its body's."""
    for body, (x, y, z) in places.items():
        at = shift(x, y, z) if y > 0 else shift(x, y, z).Multiplied(turn(Z, 180.0))
        tree.uses.append(Use(wheel, at, names={"wheel": body, "tyre": body.replace("wheel", "tyre")}))
