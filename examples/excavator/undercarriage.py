"""Undercarriage: centre frame with its legs, track frames, rollers, sprockets, idlers and the chains. Machine frame,
millimetres."""

from __future__ import annotations

import math

from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import bolt
from drawing.product import GREY, STEEL, Assembly, Part, Use
from drawing.solids import X, Y, Z, bored, box, cut, fuse, mirrored, plate, ring, rod, shift, turn

from . import values as v
from .track import (
    CARRIER_X,
    CLEARANCE,
    DARK,
    HALF,
    ROLLER_X,
    SPROCKET_BOLTS,
    Loop,
    draw_carrier,
    draw_chain,
    draw_idler,
    draw_roller,
    draw_sprocket,
)

BODY = "undercarriage"
GAUGE = v.TRACK_GAUGE.value / 2
BELLY = v.GROUND_CLEARANCE.value
DECK = 905.0
"""Top of the centre frame."""
BEARING = (480.0, 549.0, 550.0, 640.0)
"""Radii of the swing bearing: inner race, which the undercarriage carries, and outer race."""
BEARING_Z = (DECK, 1015.0, 940.0, 1050.0)
"""Heights of the inner race and of the outer race."""


def hollow(corners: list[tuple[float, float, float]], plane: str, low: float, high: float, wall: float) -> TopoDS_Shape:
    """A closed box with an outline: a prism less the same prism smaller all round by the wall."""
    inner = [(a, b, r) for a, b, r in inset(corners, wall)]
    return cut(plate(corners, plane, low, high), plate(inner, plane, low + wall, high - wall))


def inset(corners: list[tuple[float, float, float]], by: float) -> list[tuple[float, float, float]]:
    """A counter-clockwise polygon with every side moved inwards."""
    n, out = len(corners), []
    for i in range(n):
        (ax, ay, _), (bx, by_, _), (cx, cy, _) = corners[i - 1], corners[i], corners[(i + 1) % n]
        d, e = math.hypot(bx - ax, by_ - ay), math.hypot(cx - bx, cy - by_)
        p, q = (-(by_ - ay) / d, (bx - ax) / d), (-(cy - by_) / e, (cx - bx) / e)
        scale = by / (1.0 + p[0] * q[0] + p[1] * q[1])
        out.append((bx + (p[0] + q[0]) * scale, by_ + (p[1] + q[1]) * scale, 0.0))
    return out


def draw_centre_frame(hardware: Assembly) -> Assembly:
    """The box under the swing bearing, four hollow legs to the track frames, the bearing's fixed race."""
    tree = Assembly("CENTRE FRAME WELDMENT")
    body = [(-620, -400, 0), (-470, -560, 0), (470, -560, 0), (620, -400, 0), (620, 400, 0), (470, 560, 0)]
    body += [(-470, 560, 0), (-620, 400, 0)]
    corners = [(float(a), float(b), 0.0) for a, b, _ in body]
    centre = hollow(corners, "xy", BELLY, DECK, 20.0)
    hole = rod((0, 0, DECK - 40), Z, 300, 80)
    tree.add(Part("CENTRE FRAME", cut(centre, hole), DARK), BODY)
    leg = [(420.0, 500.0, 0.0), (640.0, 360.0, 0.0), (1180.0, 1078.0, 0.0), (760.0, 1078.0, 0.0)]
    front = hollow(leg, "xy", 470.0, 610.0, 18.0)
    rear = [(-x, y, r) for x, y, r in reversed(leg)]
    back = hollow(rear, "xy", 470.0, 610.0, 18.0)
    for name, shape in (("X LEG FRONT", front), ("X LEG REAR", back)):
        tree.add(Part(f"{name} LH", shape, DARK), BODY)
        tree.add(Part(f"{name} RH", mirrored(shape), DARK), BODY)
    inner, outer, _, _ = BEARING
    low, high, _, _ = BEARING_Z
    race = ring((0, 0, low), Z, outer, inner, high - low)
    tree.add(Part("SWING BEARING INNER RACE", race, STEEL), BODY, "swing_bearing")
    centre_joint = fuse(rod((0, 0, 620), Z, 110, 360), rod((0, 0, 620), Z, 150, 60))
    tree.add(Part("CENTRE SWIVEL BODY", centre_joint, GREY), BODY)
    tree.add(Part("SWIVEL SEAT", box(-160, 160, -545, 545, 600, 622), DARK), BODY)
    big = bolt(24, 60)
    for i in range(8):
        a = math.radians(45 * i + 15)
        r = (inner + outer) / 2
        at = shift(r * math.cos(a), r * math.sin(a), high).Multiplied(turn(X, 90.0))
        hardware.add(big, BODY, at=at)
    return tree


def _side(letter: str, sign: float, loop: Loop, hardware: Assembly) -> Assembly:
    tree = Assembly(f"TRACK GROUP {letter.upper()}H")
    z_axle, z_roller = loop.axle, loop.roller

    def at(x: float, z: float, flip: bool = True) -> gp_Trsf:
        """On the side's middle plane; flipped on the right, so that +y is outwards."""
        place = shift(x, sign * GAUGE, z)
        return place.Multiplied(turn(X, 180.0)) if flip and sign < 0 else place

    def put(name: str, shape: TopoDS_Shape) -> None:
        """Drawn about y = 0 with +y outwards."""
        frame.add(Part(name, shape if sign > 0 else mirrored(shape), DARK), BODY, at=shift(0, sign * GAUGE, 0))

    frame = Assembly(f"TRACK FRAME WELDMENT {letter.upper()}H")
    tree.add(frame)
    beam = [(-1460.0, 332.0, 0.0), (1500.0, 332.0, 0.0), (1500.0, 540.0, 0.0), (1180.0, 590.0, 0.0)]
    beam += [(-1250.0, 590.0, 0.0), (-1460.0, 560.0, 0.0)]
    put("TRACK FRAME BEAM", hollow(beam, "xz", -112.0, 112.0, 16.0))
    put("SOLE PL", box(-1470, 1500, -152, 152, 316, 332))
    skirt = plate([(-1490, 170, 0), (1490, 170, 0), (1490, 318, 0), (-1490, 318, 0)], "xz", 132, 152)
    skirt = bored(skirt, Y, *(((x, 0.0, z_roller), 32.0) for x in ROLLER_X))
    put("ROLLER GUARD OUT", skirt)
    put("ROLLER GUARD IN", mirrored(skirt))
    yoke = box(1440, 1500, -184, 184, 372, 502)
    arm = plate([(HALF, z_axle, 66), (1440, z_axle + 65, 0), (1440, z_axle - 65, 0)], "xz", 154, 184)
    put("IDLER YOKE", bored(fuse(yoke, arm, mirrored(arm)), Y, ((HALF, 0, z_axle), 45.0)))
    bracket = plate([(-HALF, z_axle, 185), (-1380, 340, 0), (-1380, 600, 0)], "xz", -112, -72)
    put("TRAVEL MOTOR BRKT", bored(bracket, Y, ((-HALF, 0, z_axle), 125.0)))
    motor = fuse(rod((0, -72, 0), Y, 130 - CLEARANCE, 215), rod((0, -270, 0), Y, 125, 200))
    tree.add(Part("TRAVEL MOTOR", motor, GREY), BODY, at=at(-HALF, z_axle))
    for x in CARRIER_X:
        z = loop.carrier(x)
        shape = plate([(x, z, 45), (x - 70, 588, 0), (x + 70, 588, 0)], "xz", -160, -125)
        base = box(x - 70, x + 70, -160, 0, 588, 599)
        put("CARRIER BRKT", bored(fuse(shape, base), Y, ((x, 0, z), 24.6)))

    sprocket, case, nut = draw_sprocket()
    here = min(loop.pins, key=lambda p: p[0])
    phase = math.degrees(math.atan2(here[1] - z_axle, here[0] + HALF))
    # +y is outwards after the flip, which also turns the sense of the phase
    turned_on = at(-HALF, z_axle).Multiplied(turn(Y, -phase * sign))
    name = f"sprocket_{letter}"
    tree.add(sprocket, name, at=turned_on)
    tree.add(case, name, at=turned_on)
    for i in range(SPROCKET_BOLTS):
        a = 2 * math.pi * i / SPROCKET_BOLTS
        tree.add(nut, name, at=turned_on.Multiplied(shift(205 * math.cos(a), 58.0, 205 * math.sin(a))))
    idler, axle = draw_idler(loop)
    tree.add(idler, f"idler_{letter}", at=at(HALF, z_axle))
    tree.add(axle, BODY, at=at(HALF, z_axle))
    shell, shaft = draw_roller()
    for i, x in enumerate(reversed(ROLLER_X)):
        tree.add(shell, f"track_roller_{letter}_{i + 1}", at=at(x, z_roller))
        tree.add(shaft, BODY, at=at(x, z_roller))
    carrier, pin = draw_carrier()
    for i, x in enumerate(reversed(CARRIER_X)):
        place = at(x, loop.carrier(x))
        tree.add(carrier, f"carrier_roller_{letter}_{i + 1}", at=place)
        tree.add(pin, BODY, at=place.Multiplied(turn(Z, 180.0)))
    tree.uses.append(Use(draw_chain(loop, letter), shift(0, sign * GAUGE, 0)))
    return tree


def draw_undercarriage(loop: Loop, hardware: Assembly) -> Assembly:
    """Everything below the swing bearing's outer race."""
    tree = Assembly("UNDERCARRIAGE")
    tree.add(draw_centre_frame(hardware))
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        tree.add(_side(letter, sign, loop, hardware))
    return tree
