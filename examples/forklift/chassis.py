"""Chassis: front axle, side frames, floor, counterweight, hood and overhead guard. Machine frame, millimetres."""

from __future__ import annotations

from drawing.hardware import fit_pin
from drawing.product import BLACK, GREY, YELLOW, Assembly, Colour, Part
from drawing.solids import X, Y, bored, box, cut, fuse, mirrored, plate, rod, turned
from drawing.steer_axle import PIN_OSCILLATION

from . import values as v
from .mast import PIN_MAST, PIN_TILT, PIVOT, Mast, outside, tilt_pin_y
from .steer_axle import AXLE
from .wheels import SPINDLE

FRONT_Z = v.TYRE_DIAMETER.value / 2
TILT_ANCHOR = (-450.0, 860.0)
"""x and z of the tilt cylinders' pins on the chassis."""
TAIL = v.LOAD_DISTANCE.value - v.LENGTH_TO_FORK.value
BODY = "chassis"


def _pair(tree: Assembly, name: str, shape: object, colour: Colour = YELLOW) -> None:
    tree.add(Part(f"{name} LH", shape, colour), BODY)
    tree.add(Part(f"{name} RH", mirrored(shape), colour), BODY)


def draw_front_axle(mast: Mast, hardware: Assembly) -> Assembly:
    """Housing with spindles, ears of the mast's pivots and flanges to the frame, in one piece."""
    tree = Assembly("DRIVE AXLE ASSY")
    half, y = v.FRONT_TREAD.value / 2, outside(mast.stages - 1)
    px, pz = PIVOT
    shape = fuse(rod((0, -640, FRONT_Z), Y, 90, 1280), rod((0, -half - 20, FRONT_Z), Y, SPINDLE / 2, 2 * half + 40))
    ears = []
    for low in (y - 44, y + 44):
        ear = plate([(0, FRONT_Z, 95), (px, pz, 55)], "xz", low, low + 40)
        ears += [ear, mirrored(ear)]
    flange = box(-110, -40, 380, 470, FRONT_Z - 70, FRONT_Z + 70)
    banjo = turned([(-150, 0), (-150, 100), (-90, 185), (90, 185), (150, 100), (150, 0)], (0, 0, FRONT_Z))
    shape = fuse(shape, *ears, flange, mirrored(flange), banjo)
    shape = cut(shape, rod((0, -600, FRONT_Z), Y, 74, 1200))
    shape = bored(shape, Y, ((px, 0, pz), PIN_MAST / 2))
    tree.add(Part("DRIVE AXLE HOUSING", shape, GREY), BODY)
    for sign in (1.0, -1.0):
        start = (y - 44) if sign > 0 else -(y + 84)
        fit_pin(hardware, (px, start, pz), PIN_MAST, 128, BODY, "mast_pin", keep=(sign,), turned=90)
    return tree


def draw_frame(mast: Mast, hardware: Assembly) -> Assembly:
    """Side frames, front plate, deck, hangers of the steer axle, clevises of the tilt cylinders."""
    tree = Assembly("FRAME ASSY")
    _pair(tree, "SIDE FRAME", box(-1850, -150, 430, 470, 350, 900))
    tree.add(Part("FRONT PLATE", box(-150, -110, -470, 470, 300, 900)), BODY)
    tree.add(Part("FRAME X-MEMBER", box(-1850, -1810, -430, 430, 400, 850)), BODY)
    tree.add(Part("DECK PL", box(-2760, -1700, -470, 470, 900, 960)), BODY)
    for name, x in (("AXLE HANGER FRT", AXLE.x + 100), ("AXLE HANGER RR", AXLE.x - 140)):
        hanger = bored(box(x, x + 40, -100, 100, AXLE.z - 80, 900), X, ((0, 0, AXLE.z), PIN_OSCILLATION / 2))
        tree.add(Part(name, hanger), BODY)
    (px, pz), y = TILT_ANCHOR, tilt_pin_y(mast)
    _pair(tree, "TILT CYL BASE", box(px - 95, px - 48, 470, y + 60, pz - 70, pz + 20))
    for name, low in (("IN", y - 50), ("OUT", y + 25)):
        ear = plate([(px, pz, 42), (px - 48, pz + 18, 0), (px - 48, pz - 65, 0)], "xz", low, low + 25)
        _pair(tree, f"TILT CYL EAR {name}", bored(ear, Y, ((px, 0, pz), PIN_TILT / 2)))
    for sign, letter in ((1.0, "l"), (-1.0, "r")):
        start = (y - 50) if sign > 0 else -(y + 50)
        role = f"tilt_cylinder_barrel_{letter}_pin"
        fit_pin(hardware, (px, start, pz), PIN_TILT, 100, BODY, role, keep=(sign,), turned=60)
    return tree


def draw_top() -> Assembly:
    """Counterweight, hood, floor, seat, tanks and the overhead guard."""
    tree = Assembly("SUPERSTRUCTURE")
    weight = fuse(
        box(TAIL, -2350, -850, 850, 960, 1380),
        box(TAIL, -2760, -540, 540, 420, 960),
    )
    tree.add(Part("COUNTERWEIGHT", weight, GREY), BODY)
    tree.add(Part("HOOD", cut(box(-2350, -1300, -430, 430, 960, 1330), box(-2300, -1350, -400, 400, 900, 1300))), BODY)
    tree.add(Part("ENGINE", box(-1780, -900, -250, 250, 480, 880), GREY), BODY)
    _pair(tree, "ENGINE MOUNT", box(-1400, -1300, 250, 430, 560, 620), GREY)
    tree.add(Part("FLOOR PL", box(-1300, -150, -470, 470, 900, 920), GREY), BODY)
    seat = fuse(box(-1250, -800, -260, 260, 920, 1250), box(-1250, -1130, -260, 260, 1250, 1750))
    tree.add(Part("SEAT", seat, BLACK), BODY)
    tree.add(Part("DASH", box(-260, -170, -300, 300, 920, 1350), BLACK), BODY)
    _pair(tree, "TANK", box(-1600, -700, 470, 700, 420, 800), GREY)
    top = v.GUARD_HEIGHT.value
    _pair(tree, "GUARD POST FRT", box(-260, -200, 400, 470, 920, top - 60), BLACK)
    _pair(tree, "GUARD POST RR", box(-1760, -1690, 360, 430, 1330, top - 60), BLACK)
    roof = box(-1800, -180, -480, 480, top - 60, top)
    slots = [box(-1700 + 220 * i, -1560 + 220 * i, -380, 380, top - 100, top + 10) for i in range(7)]
    tree.add(Part("GUARD ROOF", cut(roof, *slots), BLACK), BODY)
    return tree
