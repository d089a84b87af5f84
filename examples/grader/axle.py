"""The front axle: beam on its pin, yokes that lean with the bar that couples them, knuckles with tie rod and cylinders.
Machine frame, millimetres; wheels straight and upright."""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.cylinders import Cylinder
from drawing.hardware import CLEARANCE, pin
from drawing.product import GREY, YELLOW, Assembly, Part
from drawing.solids import Vector, X, Y, Z, bored, box, cut, fuse, mirrored, plate, rod, shift, turn

from . import values as v
from .linkage import (
    AXLE_X,
    BAR_Z,
    KING_Y,
    LEAN_EYE_Z,
    LEAN_FOOT_Y,
    LEAN_Y,
    LEAN_Z,
    RADIUS,
    STEER_FOOT,
    STEER_Z,
    TIE,
    TIE_Z,
    Linkage,
)

OSCILLATION_Z = 720.0
PIN_OSCILLATION, PIN_LEAN, PIN_KING, PIN_TIE, PIN_STEER, PIN_LEANER, PIN_BAR = 80.0, 60.0, 60.0, 34.0, 36.0, 38.0, 36.0
"""Diameters."""
SPINDLE = 62.0
"""Radius of what the wheels turn on."""
EYE_AHEAD = 80.0
"""How far the bar is ahead of the axle, and the lean cylinder behind it."""
BODY = "front_axle"


def _level(hardware: Assembly, at: Vector, size: float, half: float, body: str, role: str) -> None:
    """A lengthwise pin about a point."""
    place = shift(at[0] - half, at[1], at[2]).Multiplied(turn(Z, -90.0))
    hardware.add(pin(size, 2 * half), body, role, place)


def _upright(hardware: Assembly, at: Vector, size: float, half: float, body: str, role: str) -> None:
    """An upright pin about a point."""
    place = shift(at[0], at[1], at[2] - half).Multiplied(turn(X, 90.0))
    hardware.add(pin(size, 2 * half), body, role, place)


def _pair(tree: Assembly, name: str, shape: TopoDS_Shape, body: str) -> None:
    """A part of a left body, and its mirror image of the right one; `{}` in the body is the side."""
    tree.add(Part(f"{name} LH", shape, YELLOW), body.format("l"))
    tree.add(Part(f"{name} RH", mirrored(shape), YELLOW), body.format("r"))


def draw_axle(k: Linkage, hardware: Assembly) -> Assembly:
    """Everything but wheels and cylinders."""
    tree, x = Assembly("FRONT AXLE ASSY"), AXLE_X
    beam = fuse(
        box(x - 75, x + 75, -570, 570, 470, 600),
        box(x - 75, x + 75, -90, 90, 600, OSCILLATION_Z),
        rod((x - 75, 0, OSCILLATION_Z), X, 90, 150),
    )
    tree.add(Part("AXLE BEAM", bored(beam, X, ((x, 0, OSCILLATION_Z), PIN_OSCILLATION / 2 + CLEARANCE)), GREY), BODY)
    for name, start in (("FRT", 57.0), ("RR", -92.0)):
        fork = plate([(LEAN_Y, LEAN_Z, 62), (520, 600, 0), (520, 470, 0)], "yz", x + start, x + start + 35)
        fork = cut(fork, box(x - 75, x + 75, 0, 570, 470, 600))
        _pair(tree, f"AXLE FORK {name}", bored(fork, X, ((x, LEAN_Y, LEAN_Z), PIN_LEAN / 2)), BODY)
    _level(hardware, (x, 0, OSCILLATION_Z), PIN_OSCILLATION, 165.0, "front_frame", f"{BODY}_pin")
    # The yoke: a hub on the lean pin, a post up to bar and cylinder, two plates for the kingpin.
    hub = rod((x - 52, LEAN_Y, LEAN_Z), X, 60, 104)
    post = plate([(LEAN_Y, BAR_Z, 42), (LEAN_Y, 530, 55)], "yz", x - 42, x + 42)
    plates = [
        plate([(x, KING_Y, 60), (x - 52, LEAN_Y, 0), (x + 52, LEAN_Y, 0)], "xy", z, z + 36) for z in (474.0, 714.0)
    ]
    yoke = fuse(hub, post, *plates)
    yoke = bored(yoke, X, ((x, LEAN_Y, LEAN_Z), PIN_LEAN / 2 + CLEARANCE))
    ahead = rod((x - 200, LEAN_Y, BAR_Z), X, PIN_BAR / 2, 400)
    yoke = bored(cut(yoke, ahead), Z, ((x, KING_Y, 0), PIN_KING / 2))
    _pair(tree, "LEAN YOKE", yoke, "lean_yoke_{}")
    bar = plate([(LEAN_Y, BAR_Z, 36), (-LEAN_Y, BAR_Z, 36)], "yz", x + EYE_AHEAD - 18, x + EYE_AHEAD + 18)
    bar = bored(bar, X, *(((x, sign * LEAN_Y, BAR_Z), PIN_BAR / 2 + CLEARANCE) for sign in (1.0, -1.0)))
    tree.add(Part("LEANING BAR", bar, GREY), "leaning_bar")
    _cylinder_lug(tree, k)
    _knuckles(tree, k)
    _pins(k, hardware)
    return tree


def _cylinder_lug(tree: Assembly, k: Linkage) -> None:
    """On the beam the feet of the lean and steering cylinders, on the left yoke the lug of the lean cylinder's eye."""
    x, y, z = AXLE_X - EYE_AHEAD, LEAN_FOOT_Y, k.lean_foot_z
    cheeks = [plate([(y, z, 36), (y - 50, 600, 0), (y + 50, 600, 0)], "yz", x + a, x + a + 14)
              for a in (-37.0, 23.0)]  # fmt: skip
    foot = fuse(box(x - 37, x + 37, y - 50, y + 50, 600, 612), *cheeks)
    tree.add(Part("LEAN CYL LUG", bored(foot, X, ((x, y, z), PIN_LEANER / 2)), GREY), BODY)
    ears = [plate([(LEAN_Y, LEAN_EYE_Z, 36), (LEAN_Y + 30, 760, 0), (LEAN_Y + 52, 800, 0)], "yz", x + a, x + a + 14)
            for a in (-37.0, 23.0)]  # fmt: skip
    back = box(x - 37, AXLE_X - 42, LEAN_Y + 38, LEAN_Y + 54, 760, 880)
    ear = fuse(back, *ears)
    tree.add(Part("LEAN ROD LUG", bored(ear, X, ((x, LEAN_Y, LEAN_EYE_Z), PIN_LEANER / 2)), YELLOW), "lean_yoke_l")
    fx, fy = AXLE_X + float(STEER_FOOT[0]), KING_Y + float(STEER_FOOT[1])
    cheeks = [plate([(fx, fy, 34), (AXLE_X - 75, fy - 40, 0), (AXLE_X - 75, fy + 60, 0)], "xy", z0, z0 + 14)
              for z0 in (STEER_Z - 37.0, STEER_Z + 23.0)]  # fmt: skip
    wall = box(AXLE_X - 90, AXLE_X - 75, fy - 40, fy + 60, 520, STEER_Z + 37)
    lug = bored(fuse(wall, *cheeks), Z, ((fx, fy, 0), PIN_STEER / 2))
    tree.add(Part("STEER CYL LUG LH", lug, GREY), BODY)
    tree.add(Part("STEER CYL LUG RH", mirrored(lug), GREY), BODY)


def _knuckles(tree: Assembly, k: Linkage) -> None:
    """Knuckles with their arms, the tie rod between them."""
    x, out = AXLE_X, v.TREAD.value / 2 + 60
    hub = rod((x, KING_Y, 512), Z, 58, 200)
    spindle = fuse(hub, rod((x, KING_Y, RADIUS), Y, SPINDLE, out - KING_Y))
    ex, ey = x + float(k.steer_eye[0]), KING_Y + float(k.steer_eye[1])
    tx, ty = x + float(TIE[0]), KING_Y + float(TIE[1])
    arm = plate([(x, KING_Y, 50), (ex, ey, 34), (tx, ty, 34)], "xy", 520, 576)
    arm = fuse(spindle, arm)
    arm = bored(arm, Z, ((x, KING_Y, 0), PIN_KING / 2 + CLEARANCE))
    arm = cut(arm, rod((ex, ey, 400), Z, PIN_STEER / 2, 400), rod((tx, ty, 400), Z, PIN_TIE / 2, 400))
    _pair(tree, "KNUCKLE", arm, "knuckle_{}")
    tie = plate([(tx, ty, 32), (tx, -ty, 32)], "xy", TIE_Z - 19, TIE_Z + 19)
    tie = bored(tie, Z, ((tx, ty, 0), PIN_TIE / 2 + CLEARANCE), ((tx, -ty, 0), PIN_TIE / 2 + CLEARANCE))
    tree.add(Part("TIE ROD", tie, GREY), "tie_rod")


def _pins(k: Linkage, hardware: Assembly) -> None:
    x = AXLE_X
    ex, ey = x + float(k.steer_eye[0]), KING_Y + float(k.steer_eye[1])
    tx, ty = x + float(TIE[0]), KING_Y + float(TIE[1])
    fx, fy = x + float(STEER_FOOT[0]), KING_Y + float(STEER_FOOT[1])
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        yoke, knuckle = f"lean_yoke_{letter}", f"knuckle_{letter}"
        _level(hardware, (x, sign * LEAN_Y, LEAN_Z), PIN_LEAN, 98.0, BODY, f"{yoke}_pin")
        _level(hardware, (x + 35, sign * LEAN_Y, BAR_Z), PIN_BAR, 80.0, yoke, f"leaning_bar_{letter}_pin")
        _upright(hardware, (x, sign * KING_Y, 612), PIN_KING, 145.0, yoke, f"{knuckle}_pin")
        _upright(hardware, (tx, sign * ty, 525), PIN_TIE, 56.0, knuckle, f"tie_rod_{letter}_pin")
        _upright(hardware, (ex, sign * ey, 575), PIN_STEER, 62.0, knuckle, f"steering_piston_rod_{letter}_pin")
        _upright(hardware, (fx, sign * fy, STEER_Z), PIN_STEER, 42.0, BODY, f"steering_cylinder_barrel_{letter}_pin")
    at = (x - EYE_AHEAD, LEAN_FOOT_Y, k.lean_foot_z)
    _level(hardware, at, PIN_LEANER, 42.0, BODY, "wheel_lean_cylinder_barrel_pin")
    at = (x - EYE_AHEAD, LEAN_Y, LEAN_EYE_Z)
    _level(hardware, at, PIN_LEANER, 37.0, "lean_yoke_l", "wheel_lean_piston_rod_pin")


def sizes(k: Linkage) -> dict[str, Cylinder]:
    """Of a steering and the lean cylinder, at drawn lengths."""
    return {
        "steer": Cylinder(
            "STEER CYL", v.STEER_BORE.value, v.STEER_ROD.value, v.STEER_STROKE.value, k.closed("steer"),
            k.steer_length(0.0), outside=74, pin=PIN_STEER, eye=30, eye_width=40, base=62, cap=18, piston=40,
            gland=42, port=8.0,
        ),
        "lean": Cylinder(
            "WHEEL LEAN CYL", v.LEAN_BORE.value, v.LEAN_ROD.value, v.LEAN_STROKE.value, k.closed("lean"),
            k.lean_length(0.0), outside=92, pin=PIN_LEANER, eye=34, eye_width=42, base=70, cap=20, piston=42,
            gland=44, port=9.0,
        ),
    }  # fmt: skip
