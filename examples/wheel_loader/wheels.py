"""Wheels and axles. A wheel is drawn about the origin with its axle along y and its outer side towards +y.
Millimetres."""

from __future__ import annotations

import math

from drawing.hardware import bolt
from drawing.product import BLACK, GREY, STEEL, YELLOW, Assembly, Part
from drawing.solids import X, Y, bored, box, cut, fuse, ring, rod, shift, turn, turned

from . import values as v

SPINDLE = 190.0
"""Diameter of the spindle a wheel turns on."""
BANJO = v.TYRE_DIAMETER.value / 2 - v.GROUND_CLEARANCE.value
"""Radius of the axle's middle: its lowest point is the published ground clearance."""
TYRE_DENSITY = 1100.0


def draw_wheel() -> Assembly:
    """Tyre, rim, hub, cap and twelve wheel bolts; everything is tagged "wheel"."""
    tree = Assembly("WHEEL ASSY 26.5R25")
    r, w = v.TYRE_DIAMETER.value / 2, v.TYRE_WIDTH.value / 2
    outside = [
        (-255, 318),
        (-262, 345),
        (-310, 430),
        (-w, 560),
        (-w, 640),
        (-325, 800),
        (-300, r - 18),
        (-270, r),
    ]
    inside = [(-200, 318), (-205, 370), (-255, 450), (-288, 560), (-288, 640), (-275, 740), (-240, r - 95)]
    profile = outside + [(-s, q) for s, q in reversed(outside)] + [(-s, q) for s, q in inside] + list(reversed(inside))
    tree.add(Part("TYRE 26.5R25", turned(profile), BLACK, TYRE_DENSITY), "wheel")
    rim = [
        (-272, 318),
        (-272, 352),
        (-257, 352),
        (-257, 318),
        (257, 318),
        (257, 352),
        (272, 352),
        (272, 318),
        (272, 300),
    ]
    rim += [(90, 300), (90, 190), (66, 190), (66, 300), (-272, 300)]
    disc = turned(rim)
    circle = [(235 * math.cos(math.radians(30 * i)), 235 * math.sin(math.radians(30 * i))) for i in range(12)]
    disc = cut(disc, *(rod((x, 0, z), Y, 11, 200) for x, z in circle))
    tree.add(Part("RIM DW25", disc), "wheel")
    hub = turned([(-215, 95.2), (66, 95.2), (66, 270), (34, 270), (20, 180), (-120, 180), (-215, 150)])
    hub = cut(hub, *(rod((x, 0, z), Y, 11, 200) for x, z in circle))
    tree.add(Part("HUB", hub, GREY), "wheel")
    cap = turned([(66, 70), (66, 188), (150, 178), (185, 120), (185, 0), (160, 0), (160, 70)])
    tree.add(Part("PLANET COVER", cap, YELLOW), "wheel")
    for x, z in circle:
        tree.add(bolt(22, 60), "wheel", at=shift(x, 90, z))
    return tree


def axle_housing() -> Part:
    """Axle beam with its spindles, about the axle's middle; used for both axles."""
    half = v.TREAD.value / 2
    ball = [(BANJO * math.cos(math.radians(a)), BANJO * math.sin(math.radians(a))) for a in range(138, 41, -12)]
    left = [(-s, q) for s, q in _beam(half)]
    hollow = [
        (-820, 0),
        (-820, 120),
        (-345, 125),
        *[(c * 0.86, r * 0.86) for c, r in ball],
        (345, 125),
        (820, 120),
        (820, 0),
    ]
    shape = cut(turned([*left, *ball, *reversed(_beam(half))]), turned(hollow))
    return Part("AXLE HOUSING", shape, GREY)


def _beam(half: float) -> list[tuple[float, float]]:
    """Half of the beam's profile, from the end of the spindle inwards."""
    s = SPINDLE / 2
    return [
        (half + 60, 0),
        (half + 60, s),
        (half - 222, s),
        (half - 222, 175),
        (700, 175),
        (700, 150),
        (345, 172),
    ]


def pinion_nose() -> Part:
    """Housing of the bevel pinion, from the axle's middle along +x."""
    profile = [(300, 60), (300, 190), (380, 150), (470, 140), (470, 0), (455, 0), (455, 60)]
    return Part("PINION NOSE", turned(profile, axis=X), GREY)


def draw_front_axle() -> Assembly:
    """Housing, pinion nose, pads and clamping bolts under the front frame."""
    x, z = v.WHEELBASE.value / 2, v.TYRE_DIAMETER.value / 2
    tree = Assembly("FRONT AXLE ASSY")
    at = shift(x, 0, z)
    tree.add(axle_housing_part, "front_frame", at=at)
    tree.add(nose_part, "front_frame", at=at.Multiplied(turn((0, 0, 1), 180)))
    pad = fuse(box(-120, 120, 232, 312, 100, 240), box(-120, 120, 300, 344, 100, 205))
    pad = cut(pad, rod((0, 0, 0), Y, 155, 600))
    pad_part = Part("AXLE PAD", pad)
    tree.add(pad_part, "front_frame", at=at)
    tree.add(pad_part, "front_frame", at=at.Multiplied(turn((0, 0, 1), 180)))
    stud = bolt(20, 60)
    for dx in (-90, 90):
        for y in (-326, 326):
            tree.add(stud, "front_frame", at=shift(x + dx, y, z + 205).Multiplied(turn(X, 90)))
    plug = Part("DRAIN PLUG", rod((0, 0, 0), X, 15, 20), STEEL)
    tree.add(plug, "front_frame", at=at.Multiplied(shift(345, 0, 30)))
    return tree


def draw_rear_axle(trunnion: float) -> Assembly:
    """Housing, pinion nose and the two trunnions that swing about the pins on the x axis; `trunnion` is the
    pin diameter."""
    x, z = -v.WHEELBASE.value / 2, v.TYRE_DIAMETER.value / 2
    tree = Assembly("REAR AXLE ASSY")
    at = shift(x, 0, z)
    tree.add(axle_housing_part, "rear_axle", at=at)
    tree.add(nose_part, "rear_axle", at=at)
    front = bored(rod((465, 0, 0), X, 130, 85), X, ((0, 0, 0), trunnion / 2 + 0.2))
    tree.add(Part("TRUNNION FRT", front, GREY), "rear_axle", at=at)
    rear = cut(rod((-425, 0, 0), X, 130, 160), rod((-425, 0, 0), X, trunnion / 2 + 0.2, 75))
    tree.add(Part("TRUNNION RR", rear, GREY), "rear_axle", at=at)
    cover = Part("DIFF COVER", ring((-345, 0, 0), X, 175, 125, 45), STEEL)
    tree.add(cover, "rear_axle", at=at)
    return tree


axle_housing_part = axle_housing()
nose_part = pinion_nose()
