"""Upper structure: revolving frame, counterweight, engine under its hood, tanks, guard rails. Machine frame,
millimetres."""

from __future__ import annotations

import itertools
import math

from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.TopoDS import TopoDS_Shape
from scipy.optimize import brentq

from drawing.digger import Linkage
from drawing.hardware import bolt, fit_pin
from drawing.product import BLACK, GREY, RED, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import (
    X,
    Y,
    Z,
    bored,
    box,
    cut,
    fuse,
    mirrored,
    pipe,
    plate,
    prism,
    ring,
    rod,
    sheet_box,
    shift,
    turn,
    turned,
)

from . import values as v
from .equipment import PIN_A, PIN_C
from .undercarriage import BEARING, BEARING_Z

BODY = "upperstructure"
FLOOR = 1050.0
"""Underside of the revolving frame."""
SKIRT = v.COUNTERWEIGHT_CLEARANCE.value
"""Underside of decks and counterweight."""
DECK = 1180.0
HALF = v.UPPER_WIDTH.value / 2
FRONT_OF_CWT = -2360.0
HOOD = 2080.0
"""Top of hood and counterweight."""


def _pair(tree: Assembly, name: str, shape: TopoDS_Shape, colour: Colour = YELLOW) -> None:
    tree.add(Part(f"{name} LH", shape, colour), BODY)
    tree.add(Part(f"{name} RH", mirrored(shape), colour), BODY)


def draw_towers(tree: Assembly, k: Linkage, tower: list[tuple[float, float, float]], deck: float) -> None:
    """The plates with an outline that hold boom and boom cylinders, and the cylinders' lugs on the deck."""
    (ax, az), (cx, cz) = k.A, k.C
    side = bored(plate(tower, "xz", 228, 268), Y, ((ax, 0, az), PIN_A / 2), ((cx, 0, cz), PIN_C / 2))
    _pair(tree, "TOWER PL", side)
    lug = plate([(cx, cz, 100), (cx - 230, deck, 0), (cx + 25, deck, 0)], "xz", 411, 437)
    _pair(tree, "BOOM CYL BOSS", ring((cx, 268, cz), Y, 78, PIN_C / 2, 25))
    _pair(tree, "BOOM CYL LUG", bored(lug, Y, ((cx, 0, cz), PIN_C / 2)))


def fit_boom_pins(k: Linkage, hardware: Assembly) -> None:
    """The pins of boom and boom cylinders in the towers."""
    (ax, az), (cx, cz) = k.A, k.C
    cap = Part(f"PIN CAP {PIN_C:g}", rod((0, 0, 0), Y, PIN_C / 2 + 10, 6), GREY)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        start, role = (228.0, -440.0)[sign < 0], f"boom_cylinder_barrel_{letter}_pin"
        fit_pin(hardware, (cx, start, cz), PIN_C, 212, BODY, role)
        hardware.add(cap, BODY, at=shift(cx, 440.0 if sign > 0 else -446.0, cz))
    fit_pin(hardware, (ax, -280, az), PIN_A, 560, BODY, "boom_pin", keep=(1.0, -1.0), turned=30)


def draw_frame(k: Linkage, hardware: Assembly) -> Assembly:
    """Bearing race, base plate, towers for boom and boom cylinders, decks either side, and their pins."""
    tree = Assembly("REVOLVING FRAME")
    (ax, az), (cx, cz) = k.A, k.C
    _, _, inner, outer = BEARING
    _, _, low, high = BEARING_Z
    race = cut(rod((0, 0, low), Z, outer, high - low), rod((0, 0, low - 1), Z, inner, high - low + 2))
    tree.add(Part("SWING BEARING OUTER RACE", race, STEEL), BODY)
    # narrow in front, where the lowered boom cylinders pass beside it
    half = [(-1700, 560), (300, 560), (620, 438), (620, 270), (730, 270)]
    corners = [(float(x), -float(y), 0.0) for x, y in half] + [(float(x), float(y), 0.0) for x, y in reversed(half)]
    base = plate(corners, "xy", FLOOR, FLOOR + 40)
    tree.add(Part("BASE PL", bored(base, Z, ((0, 0, 0), 240.0)), YELLOW), BODY)
    deck = FLOOR + 40
    tower = [(cx, cz, 112.0), (ax, az, 150.0), (-260.0, 1560.0, 0.0), (-900.0, 1400.0, 0.0), (-2355.0, 1330.0, 0.0)]
    tower += [(-2355.0, deck, 0.0), (700.0, deck, 0.0)]
    draw_towers(tree, k, tower, deck)
    _pair(tree, "TOWER RIB", box(-290, -262, 268, 560, deck, 1400))
    tree.add(Part("TOWER BULKHEAD", box(-290, -262, -228, 228, deck, 1500), YELLOW), BODY)
    tree.add(Part("NOSE X-MEMBER", box(330, 360, -228, 228, deck, 1180), YELLOW), BODY)
    deck_l = sheet_box(-2355, 1500, 440, HALF, SKIRT, DECK, 7.0)
    tree.add(Part("DECK LH", deck_l, GREY), BODY)
    tree.add(Part("DECK RH", sheet_box(-2355, 1330, -HALF, -440, SKIRT, DECK, 7.0), GREY), BODY)
    for x0 in (-2100.0, -1200.0, -200.0):
        _pair(tree, "OUTRIGGER", box(x0, x0 + 24, 268, 440, SKIRT, DECK))
    _pair(tree, "OUTRIGGER FRT", box(300, 324, 437, 440, SKIRT, DECK))
    fit_boom_pins(k, hardware)
    big = bolt(24, 60)
    r = (inner + outer) / 2
    for i in range(8):
        a = math.radians(45 * i + 15)
        at = shift(r * math.cos(a), r * math.sin(a), deck).Multiplied(turn(X, 90.0))
        hardware.add(big, BODY, at=at)
    tree.add(
        Part("SWING MOTOR", fuse(rod((-420, 150, deck), Z, 120, 330), rod((-420, 150, deck + 330), Z, 80, 170)), GREY),
        BODY,
    )
    valve = cut(box(-1000, -620, -200, 200, deck, 1400), box(-970, -650, -150, 150, deck + 30, 1370))
    tree.add(Part("CONTROL VALVE", valve, GREY), BODY)
    return tree


def casting(r: float, half: float, front: float, low: float, high: float) -> TopoDS_Shape:
    """A block whose rear is an arc about the swing axis."""
    back = -math.sqrt(r * r - half * half)
    arc = ((back, half), (-r, 0.0), (back, -half))
    corners = [(back, -half), (front, -half), (front, half), (back, half)]
    return prism([arc, *itertools.pairwise(corners)], "xy", low, high)


def draw_counterweight(hardware: Assembly) -> Assembly:
    """A casting whose rear is an arc about the swing axis; hollow so far that it has the published mass."""
    tree = Assembly("COUNTERWEIGHT ASSY")

    radius, half = v.TAIL_RADIUS.value, HALF - 15
    block = casting(radius, half, FRONT_OF_CWT, SKIRT, HOOD)
    for edge, up, high, deep in ((SKIRT, -1.0, 160.0, 70.0), (HOOD, 1.0, 60.0, 60.0)):
        # bevelled along the rear: less a ring about the swing axis
        bevel = [(edge - up * high, radius), (edge, radius - deep), (edge + 20 * up, radius - deep)]
        bevel += [(edge + 20 * up, radius + 200), (edge - up * high, radius + 200)]
        block = cut(block, turned(bevel, axis=Z))
    notch = box(FRONT_OF_CWT - 10, FRONT_OF_CWT + 10, -290, 290, SKIRT - 10, 1340)

    def hollowed(wall: float) -> TopoDS_Shape:
        cavity = casting(radius - wall, half - wall, FRONT_OF_CWT - wall, SKIRT + wall, HOOD - wall)
        return cut(block, notch, cavity)

    def excess(wall: float) -> float:
        props = GProp_GProps()
        BRepGProp.VolumeProperties_s(hollowed(wall), props)
        return props.Mass() * 7850e-9 - v.COUNTERWEIGHT.value

    tree.add(Part("COUNTERWEIGHT", hollowed(round(float(brentq(excess, 40.0, 140.0, xtol=1e-4)), 3)), GREY), BODY)
    eye = plate([(0, 0, 60), (-90, -130, 0), (90, -130, 0)], "xz", -20, 20)
    eye = Part("LIFTING EYE", bored(eye, Y, ((0, 0, 0), 32.0)), STEEL)
    for y in (-700.0, 700.0):
        tree.add(eye, BODY, at=shift(-2560, y, HOOD + 128))
    nut = bolt(36, 90)
    for y in (-248.0, 248.0):
        for z in (1160.0, 1280.0):
            hardware.add(nut, BODY, at=shift(-2330, y, z).Multiplied(turn(Z, -90)))
    lamp = Part("TAIL LAMP", box(0, 30, -70, 70, 0, 90), RED)
    for y in (-1000.0, 1000.0):
        tree.add(lamp, BODY, at=shift(-2500, y, HOOD))
    return tree


def draw_hood() -> Assembly:
    """Engine, pump, radiator and muffler under a sheet hood with side doors."""
    tree = Assembly("ENGINE COMPARTMENT")
    front, back = -1110.0, FRONT_OF_CWT + 2
    outline = [
        (-HALF + 20, DECK, 0.0),
        (HALF - 20, DECK, 0.0),
        (HALF - 150, HOOD - 130, 130.0),
        (-HALF + 150, HOOD - 130, 130.0),
    ]
    inner = [(-HALF + 26, DECK - 10, 0.0), (HALF - 26, DECK - 10, 0.0), *((y, z, r - 6) for y, z, r in outline[2:])]
    hood = cut(plate(outline, "yz", back, front), plate(inner, "yz", back - 10, front - 6))
    tree.add(Part("ENGINE HOOD", hood, YELLOW), BODY)
    door = box(-2280, -1720, HALF - 22, HALF - 8, 1230, 1880)
    grille = box(-1680, -1160, HALF - 22, HALF - 8, 1230, 1880)
    slots = [box(-1640, -1200, HALF - 40, HALF, z, z + 28) for z in range(1280, 1850, 70)]
    _pair(tree, "SIDE DOOR", door, YELLOW)
    _pair(tree, "COOLING GRILLE", cut(grille, *slots), BLACK)
    handle = Part("DOOR HANDLE", fuse(box(-60, 60, 0, 22, -14, 14)), BLACK)
    for y in (HALF - 8, -HALF - 14):
        tree.add(handle, BODY, at=shift(-1800, y, 1540))
    bonnet = plate(
        [(-1150, HOOD - 4, 0), (-1150, HOOD + 60, 40), (-2230, HOOD + 40, 40), (-2280, HOOD - 4, 0)], "xz", -480, 480
    )
    tree.add(Part("BONNET", cut(bonnet, box(-2240, -1156, -474, 474, HOOD - 20, HOOD + 74)), YELLOW), BODY)
    block = fuse(box(-2080, -1560, -420, 330, 1250, 1700), box(-2040, -1620, -300, 240, 1700, 1860))
    hollow = box(-2055, -1585, -395, 305, 1275, 1675)
    tree.add(Part("ENGINE", cut(block, hollow), GREY), BODY)
    tree.add(Part("ENGINE SUBFRAME", sheet_box(-2200, -1500, -438, 438, 1200, 1250, 10.0), GREY), BODY)
    _pair(tree, "SUBFRAME FOOT", box(-2200, -2140, 268, 438, 1150, 1200), GREY)
    _pair(tree, "SUBFRAME FOOT FRT", box(-1560, -1500, 268, 438, 1150, 1200), GREY)
    tree.add(Part("MAIN PUMP", rod((-1820, -780, 1450), Y, 125, 362), GREY), BODY)
    tree.add(
        Part(
            "RADIATOR",
            cut(box(-2150, -1300, 900, 990, DECK, 1900), box(-2120, -1330, 912, 978, DECK + 30, 1870)),
            BLACK,
        ),
        BODY,
    )
    muffler = rod((-2000, -640, 1880), X, 110, 560)
    tree.add(Part("MUFFLER", cut(muffler, rod((-1990, -640, 1880), X, 104, 540)), STEEL), BODY)
    stack = cut(rod((-1560, -640, 1975), Z, 62, 395), rod((-1560, -640, 1900), Z, 56, 600))
    tree.add(Part("EXHAUST STACK", stack, BLACK), BODY)
    return tree


def draw_tanks() -> Assembly:
    """Hydraulic tank, fuel tank and a step box on the right, before the hood."""
    tree = Assembly("TANKS")
    y0, y1 = -HALF + 20, -456.0

    def tank(name: str, x0: float, x1: float, high: float, colour: Colour) -> None:
        outline = [(y0, DECK, 0.0), (y1, DECK, 0.0), (y1, high, 0.0), (y0 + 90, high - 90, 90.0)]
        outer = plate(outline, "yz", x0, x1)
        inner = [(y0 + 6, DECK + 6, 0.0), (y1 - 6, DECK + 6, 0.0), (y1 - 6, high - 6, 0.0), (y0 + 90, high - 90, 84.0)]
        tree.add(Part(name, cut(outer, plate(inner, "yz", x0 + 6, x1 - 6)), colour), BODY)

    tank("HYDRAULIC TANK", -1090, -330, 2000, YELLOW)
    left = [(440.0, DECK, 0.0), (HALF - 20, DECK, 0.0), (HALF - 110, 1910.0, 90.0), (440.0, 2000.0, 0.0)]
    inner = [(446.0, DECK + 6, 0.0), (HALF - 26, DECK + 6, 0.0), (HALF - 110, 1910.0, 84.0), (446.0, 1994.0, 0.0)]
    locker = cut(plate(left, "yz", -1090, -370), plate(inner, "yz", -1084, -376))
    tree.add(Part("AIR CLEANER LOCKER", locker, YELLOW), BODY)
    tree.add(Part("LOCKER DOOR", box(-1060, -400, HALF - 22, HALF - 10, 1230, 1840), YELLOW), BODY)
    tank("FUEL TANK", -320, 620, 1880, YELLOW)
    tank("TOOL BOX", 630, 1040, 1560, YELLOW)
    tree.add(Part("STEP BOX", sheet_box(1046, 1322, y0, y1, DECK, 1380, 6.0), GREY), BODY)
    for x, z in ((-700.0, 2000.0), (150.0, 1880.0)):
        tree.add(Part("FILLER CAP", rod((x, -850, z), Z, 70, 45), BLACK), BODY)
    for x0, x1, z in ((640.0, 1030.0, 1560.0), (1056.0, 1312.0, 1380.0)):
        plates = cut(box(x0, x1, y0 + 60, y1 - 40, z, z + 8), box(x0 + 30, x1 - 30, y0 + 100, y1 - 80, z - 1, z + 9))
        tree.add(Part("ANTI-SLIP PL", plates, BLACK), BODY)
    return tree


def draw_rails() -> Assembly:
    """Guard rails on hood and tanks; the highest is the published height."""
    tree = Assembly("HANDRAILS")
    r = 17.0
    top = v.HANDRAIL_HEIGHT.value - r
    y = -HALF + 150
    high = [(-2250.0, y, HOOD - 4), (-2250.0, y, top), (-1180.0, y, top), (-1180.0, y, HOOD - 4)]
    tree.add(Part("GUARD RAIL HOOD", pipe(high, r, 110), BLACK), BODY)
    middle = 0.5 * (top + HOOD)
    tree.add(Part("GUARD RAIL MID", rod((-2250, y, middle), X, 13, 1070), BLACK), BODY)
    low = [(-1000.0, y, 1990.0), (-1000.0, y, 2880.0), (-390.0, y, 2880.0), (520.0, y, 2500.0), (520.0, y, 1870.0)]
    tree.add(Part("GUARD RAIL TANK", pipe(low, r, 100), BLACK), BODY)
    tree.add(Part("GUARD RAIL POST", rod((-390, y, 1870), Z, 14, 1010), BLACK), BODY)
    step = [(1330.0, -640.0, 1240.0), (1400.0, -640.0, 1240.0), (1400.0, -640.0, 2300.0), (1100.0, -640.0, 2300.0)]
    step += [(800.0, -640.0, 1800.0), (800.0, -640.0, 1550.0)]
    tree.add(Part("STEP HANDRAIL", pipe([(1316.0, *step[0][1:]), *step[1:]], r, 70), BLACK), BODY)
    return tree
