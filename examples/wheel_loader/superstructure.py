"""What stands on the rear frame: cab, hood, engine, tanks, steps, fenders. Machine frame, millimetres."""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import bolt
from drawing.product import AMBER, BLACK, GLASS, GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import X, Y, Z, box, cut, fuse, mirrored, pipe, plate, ring, rod, shift, turn, turned

from . import values as v

BODY = "rear_frame"
DECK = 1512.0
"""Top of the deck on the rear frame's side plates."""
FLOOR = 2010.0
"""Top of the cab's platform."""


def _pair(tree: Assembly, name: str, shape: TopoDS_Shape, colour: Colour = YELLOW, density: float = 7850.0) -> None:
    tree.add(Part(f"{name} LH", shape, colour, density), BODY)
    tree.add(Part(f"{name} RH", mirrored(shape), colour, density), BODY)


def _shell(x0: float, x1: float, y: float, z0: float, z1: float, wall: float) -> TopoDS_Shape:
    """A box open at the bottom."""
    return cut(box(x0, x1, -y, y, z0, z1), box(x0 + wall, x1 - wall, -y + wall, y - wall, z0 - 1, z1 - wall))


def draw_cab() -> Assembly:
    """Base, platform, pillars, roof, glazing, seat and steering column."""
    tree = Assembly("CAB ASSY ROPS")
    tree.add(Part("CAB BASE", _shell(-1750, -400, 580, DECK, FLOOR - 12, 8)), BODY)
    floor = fuse(box(-1760, -340, -790, 790, FLOOR - 12, FLOOR), box(-800, -420, -1110, 1110, FLOOR - 12, FLOOR))
    tree.add(Part("PLATFORM", floor, GREY), BODY)
    top = v.CAB_HEIGHT.value
    frame = Assembly("ROPS FRAME")
    tree.add(frame)
    post = Part("PILLAR 90x90", cut(box(0, 90, 0, 90, 0, top - 80 - FLOOR), box(8, 82, 8, 82, -1, 3000)))
    for x in (-1750.0, -1100.0, -440.0):
        for y in (-780.0, 690.0):
            frame.add(post, BODY, at=shift(x, y, FLOOR))
    roof = plate(
        [(-1720, top - 50, 30), (-370, top - 50, 30), (-370, top - 30, 30), (-1720, top - 30, 30)],
        "xz",
        -790,
        790,
    )
    inner = plate(
        [(-1720, top - 50, 24), (-370, top - 50, 24), (-370, top - 30, 24), (-1720, top - 30, 24)],
        "xz",
        -784,
        784,
    )
    frame.add(Part("ROOF", cut(roof, inner)), BODY)
    glazing = Assembly("GLASS")
    tree.add(glazing)
    pane = (GLASS, 2500.0)
    glazing.add(Part("WINDSHIELD", box(-365, -357, -690, 690, FLOOR, top - 80), *pane), BODY)
    glazing.add(Part("GLASS RR", box(-1735, -1727, -690, 690, FLOOR + 350, top - 80), *pane), BODY)
    for name, x0, x1 in (("GLASS QTR", -1660.0, -1100.0), ("DOOR GLASS", -1010.0, -440.0)):
        for side, y in (("LH", 740.0), ("RH", -748.0)):
            glazing.add(Part(f"{name} {side}", box(x0, x1, y, y + 8, FLOOR + 500, top - 80), *pane), BODY)
    panel = Part("DOOR PANEL", box(0, 570, 0, 6, 0, 505), YELLOW)
    for x in (-1010.0, -1665.0):
        for y in (742.0, -748.0):
            tree.add(panel, BODY, at=shift(x, y, FLOOR))
    tree.add(Part("REAR WALL", box(-1736, -1730, -690, 690, FLOOR, FLOOR + 352), YELLOW), BODY)
    seat = fuse(
        box(-1350, -900, -230, 230, FLOOR + 350, FLOOR + 380),
        box(-1370, -1340, -230, 230, FLOOR + 350, FLOOR + 1050),
    )
    tree.add(Part("Fahrersitz", seat, BLACK), BODY)
    tree.add(Part("SEAT BASE", ring((-1130, 0, FLOOR), Z, 120, 110, 350), BLACK), BODY)
    tree.add(Part("STRG COLUMN", rod((-560, 0, FLOOR), (-0.25, 0, 0.97), 45, 720), BLACK), BODY)
    wheel = turned([(-14, 175), (14, 175), (14, 200), (-14, 200)], axis=Z)
    spokes = fuse(rod((0, 0, -15), Z, 48, 30), box(-180, 180, -15, 15, -8, 8), box(-15, 15, -180, 180, -8, 8))
    lean = shift(-738, 0, FLOOR + 690).Multiplied(turn(Y, -14.45))
    tree.add(Part("STEERING WHEEL", fuse(wheel, spokes), BLACK), BODY, at=lean)
    tree.add(
        Part(
            "CONSOLE",
            cut(
                box(-1250, -850, -420, -260, FLOOR, FLOOR + 560),
                box(-1246, -854, -416, -264, FLOOR - 1, FLOOR + 556),
            ),
            BLACK,
        ),
        BODY,
    )
    lamp = Part("WORK LAMP", fuse(box(0, 70, -80, 80, 0, 110), rod((70, 0, 55), X, 45, 12)), AMBER)
    for y in (-560.0, 560.0):
        tree.add(lamp, BODY, at=shift(-342, y, top - 125))
    return tree


def draw_hood() -> Assembly:
    """Deck, hood, grille, exhaust, intake, rear fenders."""
    tree = Assembly("HOOD ASSY")
    tree.add(Part("DECK", box(-3962, -658, -600, 600, DECK - 12, DECK), GREY), BODY)
    side = [
        (-3960, DECK, 0),
        (-1790, DECK, 0),
        (-1790, 2640, 0),
        (-3000, 2600, 0),
        (-3880, 2380, 0),
        (-3960, 2250, 0),
    ]
    inner = [
        (-3952, DECK - 5, 0),
        (-1798, DECK - 5, 0),
        (-1798, 2631, 0),
        (-2999, 2592, 0),
        (-3875, 2373, 0),
        (-3952, 2248, 0),
    ]
    tree.add(Part("HOOD", cut(plate(side, "xz", -590, 590), plate(inner, "xz", -582, 582))), BODY)
    tree.add(Part("KUEHLERGRILL", box(-3975, -3960, -480, 480, DECK + 120, 2180), BLACK), BODY)
    slat = Part("GRILLE BAR", box(-3990, -3975, -470, 470, 0, 25), GREY)
    for i in range(5):
        tree.add(slat, BODY, at=shift(0, 0, DECK + 180 + 100 * i))
    stack = fuse(
        ring((-2150, 250, 2560), Z, 130, 124, 420),
        ring((-2150, 250, 2960), Z, 130, 70, 8),
        ring((-2150, 250, 2900), Z, 75, 70, v.STACK_HEIGHT.value - 2900),
    )
    tree.add(Part("EXHAUST STACK", stack, GREY), BODY)
    intake = cut(
        fuse(rod((-2150, -250, 2600), Z, 70, 320), rod((-2150, -250, 2880), Z, 140, 190)),
        rod((-2150, -250, 2590), Z, 64, 440),
    )
    tree.add(Part("PRE-CLEANER", intake, BLACK), BODY)
    sheet = [
        (-2620, 1980, 0),
        (-2400, 2120, 0),
        (-1765, 2120, 0),
        (-1765, 2128, 0),
        (-2404, 2128, 0),
        (-2626, 1988, 0),
    ]
    sheet = [(x, z + 60 if x < -2500 else z, r) for x, z, r in sheet]
    _pair(tree, "RR FENDER", plate(sheet, "xz", 588, 1480))
    handle = Part("HANDLE", pipe([(0, 0, 0), (0, 60, 0), (200, 60, 0), (200, 0, 0)], 9, 25), BLACK)
    for x in (-3300.0, -2500.0):
        tree.add(handle, BODY, at=shift(x, 590, 1900))
    return tree


def draw_power_train() -> Assembly:
    """Engine, radiator, transmission; blocks, their density that of the real thing."""
    tree = Assembly("POWER TRAIN")
    engine = fuse(box(-3350, -2250, -330, 330, DECK, 2150), box(-3250, -2350, -180, 180, 2150, 2450))
    engine = cut(engine, box(-3320, -2280, -300, 300, DECK + 30, 2120), box(-3220, -2380, -150, 150, 2119, 2420))
    tree.add(Part("ENGINE", engine, GREY), BODY)
    tree.add(
        Part(
            "RADIATOR",
            cut(box(-3900, -3700, -520, 520, DECK, 2330), box(-3950, -3600, -470, 470, DECK + 50, 2280)),
            BLACK,
        ),
        BODY,
    )
    tree.add(Part("COOLER CORE", box(-3812, -3800, -471, 471, DECK + 49, 2281), GREY), BODY)
    tree.add(Part("FAN SHROUD", ring((-3801, 0, 1960), X, 400, 392, 250), BLACK), BODY)
    case = fuse(box(-1060, -720, -250, 250, 800, 1330), rod((-1000, 0, 1080), X, 240, 330))
    case = cut(case, box(-1035, -745, -225, 225, 825, 1305), rod((-980, 0, 1080), X, 215, 285))
    tree.add(Part("TRANSMISSION", case, GREY), BODY)
    _pair(tree, "T/M MOUNT", box(-960, -840, 248, 352, 1150, 1230), BLACK)
    return tree


def draw_sides() -> Assembly:
    """Fuel and hydraulic tank, steps, hand rails."""
    tree = Assembly("TANKS & STEPS")
    tank = cut(box(-820, -480, 560, 1100, 760, 1380), box(-812, -488, 568, 1092, 768, 1372))
    tree.add(Part("FUEL TANK", tank, GREY), BODY)
    tree.add(Part("HYD TANK", mirrored(tank), GREY), BODY)
    _pair(tree, "TANK BRKT", box(-800, -680, 388, 562, 900, 1100))
    for sign, name in ((1.0, "LH"), (-1.0, "RH")):
        steps = Assembly(f"STEP ASSY {name}")
        tree.add(steps)
        for x in (-805.0, -505.0):
            shape = box(x, x + 10, 1098, 1360, 570, 1380)
            steps.add(Part("STRINGER", shape if sign > 0 else mirrored(shape), BLACK), BODY)
        tread = box(-796, -504, 1110, 1360, 0, 12)
        part = Part("TREAD", tread if sign > 0 else mirrored(tread), BLACK)
        for z in (575.0, 840.0, 1105.0, 1368.0):
            steps.add(part, BODY, at=shift(0, 0, z))
        rail = pipe([(-785, sign * 1085, 1379), (-785, sign * 1085, 2900), (-785, sign * 782, 2900)], 17, 120)
        steps.add(Part("HANDRAIL", rail, BLACK), BODY)
        front = pipe([(-500, sign * 1085, 1379), (-500, sign * 1085, 2450), (-440, sign * 770, 2450)], 17, 100)
        steps.add(Part("HANDRAIL", front, BLACK), BODY)
    cap = Part("FILLER CAP", rod((0, 0, 0), Z, 60, 45), STEEL)
    for y in (760.0, -760.0):
        tree.add(cap, BODY, at=shift(-650, y, 1380))
    small = bolt(20, 40)
    for x in (-770.0, -710.0):
        for y, direction in ((562.0, 0.0), (-562.0, 180.0)):
            del direction
            tree.add(small, BODY, at=shift(x, y * 0.86, 1100).Multiplied(turn(X, 90)))
    return tree
