"""The tractor: frame with its half of the articulation, front axle, engine under its hood, deck and cab. Machine frame,
millimetres.

The forks hold the upright pins on which the hitch turns; the bulkhead has windows for the steering cylinders, whose
barrels are pinned to ears on the rails.
"""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import fit_pin
from drawing.product import AMBER, BLACK, GLASS, GREY, RED, YELLOW, Assembly, Colour, Part, add_pair
from drawing.solids import Z, bored, box, cut, fuse, moved, plate, rod, sheet_box, shift

from . import values as v
from .layout import FRONT_X, NOSE, RADIUS, STEER_Z, bumper_low, solve_steering
from .trailer import HITCH_PLATES, PIN_ARTICULATION, PIN_STEER, SPINDLE, STEER_EARS, housing

BODY = "front_frame"
BULKHEAD = 430.0
"""Where the rails begin."""
RAIL = (570.0, 630.0, 1080.0, 1420.0)
"""Inside, outside, underside, top."""
AXLE = 135.0
"""Radius of the front axle's tube."""
DECK = 1850.0


def draw_frame(hardware: Assembly) -> Assembly:
    """Rails, bulkhead, forks, ears of the steering cylinders, bumper."""
    tree = Assembly("TRACTOR FRAME")
    inside, outside, low, high = RAIL
    add_pair(tree, "FRONT RAIL", box(BULKHEAD, 3950, inside, outside, low, high), BODY)
    wall = box(BULKHEAD, BULKHEAD + 40, -inside, inside, 860, 1590)
    tree.add(Part("BULKHEAD", cut(wall, box(0, 1000, -555, 555, 1120, 1345))), BODY)
    for z in (low + 40.0, high - 80.0):
        tree.add(Part("X-MEMBER FRT", box(3880, 3920, -inside, inside, z, z + 40)), BODY)
    for z0, z1 in HITCH_PLATES:
        for name, start in (("FORK PL LWR", z0 - 60), ("FORK PL UPR", z1 + 10)):
            fork = plate([(0, 0, 125), (BULKHEAD, -330, 0), (BULKHEAD, 330, 0)], "xy", start, start + 50)
            tree.add(Part(name, bored(fork, Z, ((0, 0, 0), PIN_ARTICULATION / 2))), BODY)
        at, length = (0.0, 0.0, z0 - 60), z1 - z0 + 120
        fit_pin(hardware, at, PIN_ARTICULATION, length, BODY, "articulation_pin", upright=True, keep=(1.0,), turned=-90)
    px, py = solve_steering().P
    for name, start in STEER_EARS:
        ear = plate([(px, py, 52), (px + 140, inside, 0), (px - 20, inside, 0)], "xy", start, start + 30)
        add_pair(tree, f"STRG BRKT {name}", bored(ear, Z, ((px, py, 0), PIN_STEER / 2)), BODY)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        role = f"steering_cylinder_barrel_{letter}_pin"
        fit_pin(hardware, (px, sign * py, STEER_Z - 80), PIN_STEER, 160, BODY, role, upright=True)
    tree.add(Part("BUMPER", box(3950, NOSE, -1250, 1250, bumper_low(), 1500)), BODY)
    for name, y in (("LH", 900.0), ("RH", -1150.0)):
        tree.add(Part(f"HEAD LAMP {name}", box(NOSE - 90, NOSE - 10, y, y + 250, 1500, 1620), (0.9, 0.9, 0.85)), BODY)
    return tree


def draw_axle() -> Assembly:
    """The front axle, which is fast on the rails, with its spindles."""
    tree, half = Assembly("FRONT AXLE ASSY"), v.FRONT_TREAD.value / 2
    left = [(half + 60, 0), (half + 60, SPINDLE), (half - 230, SPINDLE), (half - 230, AXLE)]
    profile = housing(left, AXLE, half - 300)
    pads = [box(FRONT_X - 140, FRONT_X + 140, y, y + 100, RADIUS, RAIL[2]) for y in (530.0, -630.0)]
    tree.add(Part("AXLE HOUSING FRT", fuse(moved(profile, shift(FRONT_X, 0, RADIUS)), *pads), GREY), BODY)
    return tree


def draw_power() -> Assembly:
    """Engine, transmission, tanks, radiator, hood, exhaust."""
    tree = Assembly("POWER TRAIN")

    def put(name: str, shape: TopoDS_Shape, colour: Colour = GREY) -> None:
        tree.add(Part(name, shape, colour), BODY)

    put("ENGINE C15", sheet_box(2300, 3850, -420, 420, 1100, 1800, 40.0))
    for name, x in (("RR", 2500.0), ("FRT", 3500.0)):
        add_pair(tree, f"ENGINE MOUNT {name}", box(x, x + 150, 420, RAIL[0], 1250, 1350), BODY, GREY)
    put("TRANSMISSION", sheet_box(1450, 2300, -300, 300, 1100, 1600, 40.0))
    put("RADIATOR", box(3960, 4040, -690, 690, 1500, 2400), BLACK)
    hood = cut(box(2450, 4060, -720, 720, DECK + 15, 2650), box(2442, 4052, -712, 712, DECK, 2642))
    put("HOOD", cut(hood, box(4000, 4100, -600, 600, 1950, 2500)), YELLOW)
    put("GRILLE", box(4054, 4060, -600, 600, 1950, 2500), BLACK)
    put("EXHAUST STACK", rod((2700, -560, 2650), Z, 80, 700), BLACK)
    for name, low, high, colour in (("FUEL TANK", RAIL[1], 900.0, BLACK), ("HYDRAULIC TANK", -900.0, -RAIL[1], GREY)):
        put(name, sheet_box(2050, 2950, low, high, 850, 1380, 8.0), colour)
    return tree


def draw_cab() -> Assembly:
    """Deck on its posts, fenders, and the cab."""
    tree, top = Assembly("CAB ASSY"), v.HEIGHT.value

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW) -> None:
        tree.add(Part(name, shape, colour), BODY)

    put("DECK PL", box(450, 3940, -940, 940, DECK, DECK + 15))
    for name, x in (("RR", 600.0), ("MID", 2200.0), ("FRT", 3700.0)):
        add_pair(tree, f"DECK POST {name}", box(x, x + 100, RAIL[0], RAIL[1], RAIL[3], DECK), BODY, GREY)
    add_pair(tree, "FENDER STAY", box(800, 1100, 850, 940, DECK + 15, 1900), BODY, GREY)
    add_pair(tree, "FENDER", box(330, 1760, 700, 1690, 1900, 1912), BODY)
    low, roof = 1912.0, top - 90.0
    put("CAB FLOOR", box(850, 2400, -690, 690, DECK + 15, low), GREY)
    shell = cut(box(850, 2400, -850, 850, low, roof), box(862, 2388, -838, 838, low - 1, roof - 12))
    side = [(1000.0, 2500.0, 0.0), (2250.0, 2350.0, 0.0), (2250.0, roof - 90, 0.0), (1000.0, roof - 90, 0.0)]
    windows = fuse(plate(side, "xz", -900, 900), box(800, 2500, -740, 740, 2480, roof - 90))
    put("CAB SHELL", cut(shell, windows), YELLOW)
    add_pair(tree, "SIDE GLASS", plate(side, "xz", 840, 848), BODY, GLASS)
    put("WINDSHIELD", box(2390, 2398, -740, 740, 2480, roof - 90), GLASS)
    put("REAR GLASS", box(852, 860, -740, 740, 2480, roof - 90), GLASS)
    put("CAB ROOF", box(820, 2460, -880, 880, roof, top), YELLOW)
    put("SEAT", fuse(box(1300, 1800, -260, 260, low, 2400), box(1200, 1300, -260, 260, low, 3000)), BLACK)
    put("BEACON", rod((1100, 500, top - 90), Z, 60, 90), AMBER)
    for name, y in (("LH", 700.0), ("RH", -850.0)):
        put(f"TAIL LAMP {name}", box(442, 450, y, y + 150, DECK - 60, DECK + 15), RED)
        put(f"LADDER {name}", box(2960, 3010, y, y + 150, 700, DECK), GREY)
    return tree
