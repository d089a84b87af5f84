"""Front frame, rear frame and the hinges between them, in the machine frame. Millimetres.

The rear frame's forks hold the upright articulation pins, the front frame's tongues turn on them. The rear
axle swings on two short pins along x that hang from the rear frame's cross members.
"""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.articulation import Steering
from drawing.hardware import bolt, bush, fit_pin
from drawing.product import BLACK, GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import X, Y, Z, bored, box, cut, fuse, mirrored, pipe, plate, ring, rod, shift, turn

from . import values as v
from .front_end import PIN_A
from .linkage import Linkage

HINGES = ((690.0, 770.0), (1350.0, 1430.0))
"""Heights of the front frame's lower and upper tongue."""
PIN_ARTICULATION, PIN_STEER, PIN_C, PIN_E, PIN_TRUNNION = 110.0, 50.0, 80.0, 100.0, 140.0
STEER_Z = 1050.0
"""Height of the steering cylinders."""
REAR_AXLE_X = -v.WHEELBASE.value / 2
AXLE_Z = v.TYRE_DIAMETER.value / 2
TAIL = REAR_AXLE_X - v.REAR_OVERHANG.value
"""Rearmost point of the machine."""


def _pair(
    tree: Assembly, name: str, shape: TopoDS_Shape, body: str, colour: Colour = YELLOW, suffix: str = "_"
) -> None:
    tree.add(Part(f"{name}{suffix}LH", shape, colour), body)
    tree.add(Part(f"{name}{suffix}RH", mirrored(shape), colour), body)


def draw_front_frame(k: Linkage, s: Steering, hardware: Assembly) -> Assembly:
    """Side plates, bulkhead, tongues, towers for the boom, clevises of the lift, tilt and steering
    cylinders."""
    body = "front_frame"
    tree = Assembly("FRONT FRAME ASSY")
    (ax, az), (cx, cz), (ex, ez) = k.A, k.C, k.E
    side = plate(
        [
            (620, 650, 0),
            (1340, 690, 40),
            (1460, 1115, 0),
            (1960, 1115, 0),
            (1960, 1260, 0),
            (1500, 1560, 0),
            (1130, 1930, 0),
            (1040, 2100, 40),
            (500, 2140, 40),
            (460, 1650, 0),
            (420, 1550, 0),
            (420, 1360, 0),
            (622, 1290, 0),
        ],
        "xz",
        270,
        310,
    )
    side = bored(side, Y, ((cx, 0, cz), PIN_C / 2))
    _pair(tree, "SIDE PL", side, body)
    tree.add(Part("BULKHEAD", box(580, 622, -272, 272, 640, 1650)), body)
    tree.add(Part("X-MEMBER FRT", box(1900, 1940, -270, 270, 1115, 1240)), body)
    tree.add(Part("BELLY PL", box(640, 1350, -270, 270, 650, 670), GREY), body)
    for (low, high), name in zip(HINGES, ("TONGUE LOWER", "TONGUE UPPER"), strict=True):
        tongue = plate([(0, 0, 130), (600, -300, 0), (600, 300, 0)], "xy", low, high)
        tree.add(Part(name, bored(tongue, Z, ((0, 0, 0), 75.0))), body)
        place = shift(0, 0, low).Multiplied(turn(X, 90.0))
        tree.add(bush(150, PIN_ARTICULATION, high - low), body, at=place)

    tree.add(Part("MAIN VALVE", box(760, 960, -120, 120, 670, 812), GREY), body)
    shaft = fuse(rod((620, 0, AXLE_Z), X, 42, 640), rod((1225, 0, AXLE_Z), X, 85, 34), rod((620, 0, AXLE_Z), X, 85, 34))
    tree.add(Part("PROP SHAFT FRT", shaft, GREY), body)
    hose = Part("HOSE 3/4", pipe([(0, 0, 0), (0, 0, 500), (120, 0, 620), (120, 0, 1090)], 14, 90), BLACK)
    for y in (-95, -65, 65, 95):
        tree.add(hose, body, at=shift(790, y, 811))

    tower = Assembly("TOWER")
    tree.add(tower)
    _pair(tower, "TOWER BACK PL", box(440, 470, 300, 720, 1700, 2180), body)
    ear = [(ax, az, 140), (470, 2180, 0), (465, 2180, 0), (465, 1800, 0)]
    for name, y in (("TOWER EAR IN", 480.0), ("TOWER EAR OUT", 680.0)):
        shape = bored(plate(ear, "xz", y, y + 40), Y, ((ax, 0, az), PIN_A / 2))
        _pair(tower, name, shape, body)
    rib = plate([(300, 1700, 0), (700, 1700, 0), (700, 1740, 0), (300, 1740, 0)], "yz", 380, 442)
    _pair(tower, "TOWER RIB", rib, body)

    clevis = Assembly("CYL BRKT WELDMENT")
    tree.add(clevis)
    boss = ring((cx, 308, cz), Y, 85, PIN_C / 2, 85)
    _pair(clevis, "LIFT CYL BOSS", boss, body)
    outer = [(cx, cz, 88), (cx - 165, cz + 70, 0), (cx - 165, cz - 70, 0)]
    outer_pl = bored(plate(outer, "xz", 512, 552), Y, ((cx, 0, cz), PIN_C / 2))
    _pair(clevis, "LIFT CYL BRKT", outer_pl, body)
    _pair(clevis, "LIFT CYL BRKT WEB", box(cx - 190, cx - 150, 305, 552, cz - 70, cz + 70), body)
    _pair(clevis, "LIFT CYL BRKT GUSSET", box(cx - 152, cx - 95, 308, 340, cz - 60, cz + 60), body)
    head = box(760, 1060, -275, 275, 1900, 1930)
    tree.add(Part("TILT BOX LOWER", head), body)
    tree.add(Part("TILT BOX UPPER", box(700, 1000, -275, 275, 2110, 2140)), body)
    tree.add(Part("TILT BOX FRONT", box(1020, 1055, -275, 275, 1925, 2095), YELLOW), body)
    lug = [(ex, ez, 105), (1050, 2100, 0), (1000, 2135, 0), (760, 2135, 0), (760, 1905, 0), (1050, 1905, 0)]
    lug_pl = bored(plate(lug, "xz", 75, 115), Y, ((ex, 0, ez), PIN_E / 2))
    _pair(clevis, "TILT CYL EAR", lug_pl, body)
    qx, qy = s.Q
    for z0, name in ((STEER_Z - 75, "STRG EAR LWR"), (STEER_Z + 45, "STRG EAR UPR")):
        ear_pl = plate([(qx, qy, 52), (600, 300, 0), (800, 300, 0), (800, 330, 0)], "xy", z0, z0 + 30)
        _pair(clevis, name, bored(ear_pl, Z, ((qx, qy, 0), PIN_STEER / 2)), body)

    for sign in (1.0, -1.0):
        letter = "l" if sign > 0 else "r"
        fit_pin(
            hardware,
            (ax, 480 if sign > 0 else -720, az),
            PIN_A,
            240,
            body,
            "boom_pin",
            keep=(sign,),
            turned=75,
        )
        fit_pin(
            hardware,
            (cx, 270 if sign > 0 else -552, cz),
            PIN_C,
            282,
            body,
            f"boom_cylinder_barrel_{letter}_pin",
            keep=(sign,),
            turned=90,
        )
        fit_pin(
            hardware,
            (qx, sign * qy, STEER_Z - 75),
            PIN_STEER,
            150,
            body,
            f"steering_piston_rod_{letter}_pin",
            upright=True,
            keep=(1.0,),
            turned=-90,
        )
    fit_pin(hardware, (ex, -115, ez), PIN_E, 230, body, "bucket_cylinder_barrel_pin", keep=(1.0, -1.0), turned=80)
    return tree


def draw_front_fenders() -> Assembly:
    """Bent plates over the front tyres on beams from the towers, and the head lights."""
    body = "front_frame"
    tree = Assembly("FRT FENDER")
    _pair(tree, "FENDER BEAM", box(400, 442, 640, 815, 1765, 1825), body, GREY)
    _pair(tree, "FENDER ARM", box(440, 1250, 760, 810, 1765, 1815), body, GREY)
    sheet = [
        (700, 1815, 0),
        (1000, 1825, 0),
        (1500, 1905, 0),
        (1950, 1870, 0),
        (1950, 1878, 0),
        (1500, 1913, 0),
        (1000, 1833, 0),
    ]
    _pair(tree, "FENDER", plate([*sheet, (700, 1823, 0)], "xz", 765, 1500), body)
    post = plate([(840, 1820, 0), (900, 1820, 0), (900, 2250, 0), (840, 2250, 0)], "xz", 770, 800)
    _pair(tree, "LAMP POST", post, body, GREY)
    lamp = fuse(box(820, 930, 765, 960, 2230, 2380), rod((925, 862, 2305), X, 60, 20))
    _pair(tree, "HEAD LAMP", lamp, body, (0.9, 0.9, 0.85))
    return tree


def draw_rear_frame(s: Steering, hardware: Assembly) -> Assembly:
    """Side plates, bulkhead, forks, trunnion brackets, steering ears, tail plate."""
    body = "rear_frame"
    tree = Assembly("REAR FRAME ASSY")
    side = plate(
        [
            (-4000, 1060, 0),
            (-2350, 900, 60),
            (-2080, 900, 0),
            (-2010, 1190, 0),
            (-1440, 1190, 0),
            (-1370, 900, 0),
            (-1000, 760, 60),
            (-620, 700, 0),
            (-620, 1500, 0),
            (-4000, 1500, 0),
        ],
        "xz",
        350,
        390,
    )
    _pair(tree, "RR SIDE PL", side, body)
    tree.add(Part("Stirnwand", box(-660, -620, -390, 390, 600, 1540)), body)
    fork = Assembly("ARTIC FORK")
    tree.add(fork)
    for low, high in HINGES:
        for z0, name in ((low - 50, "FORK PL LWR"), (high + 10, "FORK PL UPR")):
            shape = plate([(0, 0, 125), (-630, 330, 0), (-630, -330, 0)], "xy", z0, z0 + 40)
            fork.add(Part(name, bored(shape, Z, ((0, 0, 0), PIN_ARTICULATION / 2))), body)
        length = high - low + 100
        fit_pin(
            hardware,
            (0, 0, low - 50),
            PIN_ARTICULATION,
            length,
            body,
            "rear_front_pin",
            upright=True,
            keep=(1.0,),
            turned=90,
        )
    gusset = plate([(-640, 1470, 0), (-200, 1478, 0), (-200, 1500, 0), (-640, 1540, 0)], "xz", 90, 120)
    _pair(fork, "FORK GUSSET", gusset, body)
    px, py = s.P
    for z0, name in ((STEER_Z - 75, "STRG BRKT LWR"), (STEER_Z + 45, "STRG BRKT UPR")):
        shape = plate([(px, py, 52), (-640, py + 90, 0), (-640, py - 90, 0)], "xy", z0, z0 + 30)
        _pair(tree, name, bored(shape, Z, ((px, py, 0), PIN_STEER / 2)), body)
    for name, x0, pin_x in (("TRUNNION BRKT FRT", 560.0, 478.0), ("TRUNNION BRKT RR", -505.0, -515.0)):
        x0 += REAR_AXLE_X
        shape = plate(
            [(0, AXLE_Z, 130), (352, 1200, 0), (352, 1480, 0), (-352, 1480, 0), (-352, 1200, 0)],
            "yz",
            x0,
            x0 + 70,
        )
        shape = bored(shape, X, ((0, 0, AXLE_Z), PIN_TRUNNION / 2))
        tree.add(Part(name, shape), body)
        length = 162.0 if pin_x > 0 else 157.0
        place = shift(REAR_AXLE_X + pin_x, 0, AXLE_Z).Multiplied(turn(Z, -90.0))
        hardware.add(trunnion_pin(length), body, "rear_axle_pin", place)
    tree.add(Part("TAIL PL", box(-4000, -3960, -390, 390, 1060, 1500)), body)
    tree.add(Part("X-MEMBER", box(-3000, -2960, -352, 352, 1200, 1480)), body)
    _pair(tree, "AXLE STOP", box(-1850, -1600, 350, 390, 1165, 1192), body, GREY)
    for sign in (1.0, -1.0):
        letter = "l" if sign > 0 else "r"
        fit_pin(
            hardware,
            (px, sign * py, STEER_Z - 75),
            PIN_STEER,
            150,
            body,
            f"steering_cylinder_barrel_{letter}_pin",
            upright=True,
            keep=(1.0,),
            turned=90,
        )
    hose = Part("SCHLAUCH", pipe([(0, 0, 0), (0, -90, 0), (0, -90, 150), (0, -175, 150)], 16, 35), BLACK)
    for x in (-775, -735):
        tree.add(hose, body, at=shift(x, 562, 1180))
    return tree


_TRUNNION: dict[float, Part] = {}


def trunnion_pin(length: float) -> Part:
    """Short pin of the rear axle, from the origin along +y."""
    if length not in _TRUNNION:
        name = f"PIN D{PIN_TRUNNION:g}x{length:g}"
        _TRUNNION[length] = Part(name, rod((0, 0, 0), Y, PIN_TRUNNION / 2, length), STEEL)
    return _TRUNNION[length]


def draw_counterweight(hardware: Assembly) -> Assembly:
    """Cast counterweight with the hitch jaw and its pin, tail lamps and mounting bolts."""
    body = "rear_frame"
    tree = Assembly("CWT ASSY")
    x = TAIL
    block = plate(
        [
            (x, -900, 0),
            (x + 120, -1180, 0),
            (x + 400, -1180, 0),
            (x + 430, -1100, 0),
            (x + 430, -430, 0),
            (x + 225, -430, 0),
            (x + 225, 430, 0),
            (x + 430, 430, 0),
            (x + 430, 1100, 0),
            (x + 400, 1180, 0),
            (x + 120, 1180, 0),
            (x, 900, 0),
        ],
        "xy",
        860,
        1500,
    )
    jaw = box(x - 10, x + 130, -75, 75, 1130, 1270)
    hole = rod((x + 65, 0, 1000), Z, 26, 400)
    tree.add(Part("CWT", cut(block, jaw, hole), GREY), body)
    hardware.add(Part("HITCH PIN", rod((x + 65, 0, v.HITCH_HEIGHT.value - 150), Z, 26, 300), STEEL), body)
    big = bolt(30, 60)
    for y in (-300, -150, 150, 300):
        for z in (1250, 1400):
            tree.add(big, body, at=shift(-3960, y, z).Multiplied(turn(Z, -90)))
    lamp = Part("TAIL LAMP", box(0, 40, -70, 70, 0, 90), (0.8, 0.05, 0.05))
    for y in (-800, 800):
        tree.add(lamp, body, at=shift(x + 30, y, 1500))
    return tree
