"""Chassis with its axles, engine, deck and cab; knuckles and tie rod. Machine frame, millimetres."""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import CLEARANCE, fit_pin
from drawing.product import BLACK, GLASS, GREY, STEEL, YELLOW, Assembly, Colour, Part, add_pair
from drawing.solids import Y, Z, bored, box, cut, fuse, mirrored, moved, plate, ring, rod, sheet_box, shift, turned

from . import values as v
from .layout import FRONT_X, HOIST_Y, KING, NOSE, RADIUS, STEER_Z, TIE, TIPPER, solve_hoist, solve_steering

BODY = "chassis"
RAIL = (270.0, 350.0, 1250.0, 1600.0)
"""Inside, outside, underside, top."""
PIN_BODY, PIN_HOIST, PIN_KING, PIN_TIE, PIN_STEER = 110.0, 90.0, 130.0, 50.0, 50.0
SPINDLE, REAR_SPINDLE = 110.0, 150.0
"""Radii of what front and rear wheels turn on."""
HOIST_EARS = ((HOIST_Y - 115.0, HOIST_Y - 85.0), (HOIST_Y + 85.0, HOIST_Y + 115.0))
EYE = (940.0, 1210.0)
"""Heights of the axle's eyes about the kingpins."""
FORK = ((880.0, 930.0), (1220.0, 1270.0))
"""Heights of a knuckle's two plates; the lower one is its arm too."""
DECK = 2300.0


def draw_frame(hardware: Assembly) -> Assembly:
    """Rails, cross members, the body's hinge, the hoist cylinders' brackets, bumper, engine guard."""
    tree = Assembly("MAIN FRAME")
    inside, outside, low, high = RAIL
    hx, hz = (float(c) for c in TIPPER.hinge)
    side = [(7300.0, low, 0.0), (7300.0, high, 0.0), (hx + 300, high, 0.0), (hx, hz, 150.0), (hx, low, 0.0)]
    add_pair(tree, "FRAME RAIL", bored(plate(side, "xz", inside, outside), Y, ((hx, 0, hz), PIN_BODY / 2)), BODY)
    for x in (hx, 1000.0, 2600.0, 4700.0, 7260.0):
        tree.add(Part("X-MEMBER", box(x, x + 40, -inside, inside, low + 30, 1500)), BODY)
    tree.add(Part("BUMPER", box(7300, NOSE, -1900, 1900, 1000, 1600)), BODY)
    tree.add(Part("ENGINE GUARD", box(4900, 7000, -inside, inside, 700, 720), GREY), BODY)
    add_pair(tree, "GUARD STAY", box(5200, 6800, inside - 40, inside, 720, 1500), BODY, GREY)
    cx, cz = (float(c) for c in solve_hoist().C)
    add_pair(tree, "HOIST BRKT", box(cx + 110, cx + 150, outside, HOIST_EARS[1][1], 920, 1500), BODY)
    for name, (y0, y1) in zip(("IN", "OUT"), HOIST_EARS, strict=True):
        ear = plate([(cx, cz, 100), (cx + 110, 925, 0), (cx + 110, 1180, 0)], "xz", y0, y1)
        add_pair(tree, f"HOIST EAR {name}", bored(ear, Y, ((cx, 0, cz), PIN_HOIST / 2)), BODY)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        for role, x, z, size, start, end in (
            ("dump_body_pin", hx, hz, PIN_BODY, inside - 80, outside + 80),
            (f"hoist_cylinder_barrel_{letter}_pin", cx, cz, PIN_HOIST, HOIST_EARS[0][0] - 8, HOIST_EARS[1][1] + 8),
        ):
            fit_pin(hardware, (x, start if sign > 0 else -end, z), size, end - start, BODY, role)
    return tree


def draw_axles(hardware: Assembly) -> Assembly:
    """The front axle's beam with its eyes, the steering cylinders' ears, the rear axle's housing."""
    tree, king = Assembly("AXLES"), (float(KING[0]), float(KING[1]))
    inside, outside, low, _ = RAIL
    # The steering cylinders pass below it.
    beam = box(FRONT_X - 180, FRONT_X + 180, -900, 900, 1060, low)
    for sign in (1.0, -1.0):
        eye = [(king[0], sign * king[1], 130.0), (king[0] - 150, sign * 890, 0.0), (king[0] + 150, sign * 890, 0.0)]
        eye = eye if sign > 0 else [eye[0], eye[2], eye[1]]
        beam = fuse(beam, plate([eye[0], eye[1], eye[2]], "xy", *EYE))
    holes = [((king[0], sign * king[1], 0.0), PIN_KING / 2) for sign in (1.0, -1.0)]
    tree.add(Part("FRONT AXLE BEAM", bored(beam, Z, *holes), GREY), BODY)
    px, py = (float(c) for c in solve_steering().P)
    tree.add(Part("STRG X-MEMBER", box(3640, 3740, -outside, outside, 900, low)), BODY)
    for name, start in (("LWR", STEER_Z - 65), ("UPR", STEER_Z + 40)):
        ear = plate([(px, py, 52), (3740, py + 80, 0), (3740, py - 80, 0)], "xy", start, start + 25)
        add_pair(tree, f"STRG EAR {name}", bored(ear, Z, ((px, py, 0), PIN_STEER / 2)), BODY)
    half, ball = v.REAR_TREAD.value / 2, RADIUS - v.AXLE_CLEARANCE.value
    left = [(half + 490, 0), (half + 490, REAR_SPINDLE), (640, REAR_SPINDLE), (640, 210), (300, 210), (220, ball)]
    hollow = [(half + 600, 0), (half + 600, 95), (620, 95), (600, 170), (290, 170), (210, ball - 40)]
    outer, inner = (turned([*one, *[(-s, q) for s, q in reversed(one)]]) for one in (left, hollow))
    pads = [box(-150, 150, y, y + outside - inside, 0, low - RADIUS) for y in (inside, -outside)]
    tree.add(Part("REAR AXLE HOUSING", moved(fuse(cut(outer, inner), *pads), shift(0, 0, RADIUS)), GREY), BODY)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        at, length = (king[0], sign * king[1], FORK[0][0] - 10), FORK[1][1] - FORK[0][0] + 20
        fit_pin(hardware, at, PIN_KING, length, BODY, f"knuckle_{letter}_pin", upright=True)
        role = f"steering_cylinder_barrel_{letter}_pin"
        fit_pin(hardware, (px, sign * py, STEER_Z - 70), PIN_STEER, 140, BODY, role, upright=True)
    return tree


def draw_knuckles(hardware: Assembly) -> Assembly:
    """A knuckle on either side: two plates about the axle's eye, the spindle, the arm; and the tie rod."""
    tree, (kx, ky), (tx, ty) = Assembly("STEERING KNUCKLES"), KING, TIE
    qx, qy = (float(c) for c in solve_steering().Q)
    low, high = FORK
    fork = [plate([(kx, ky, 125), (kx + 150, 1330, 0), (kx - 150, 1330, 0)], "xy", *z) for z in FORK]
    arm = plate([(kx, ky, 125), (tx, ty, 60)], "xy", *low)
    web = box(kx - 150, kx + 150, 1320, 1375, low[0], high[1])
    spindle = rod((kx, 1370, RADIUS), Y, SPINDLE, v.FRONT_TREAD.value / 2 + 60 - 1370)
    shape = fuse(fork[0], fork[1], arm, web, spindle)
    shape = bored(shape, Z, ((kx, ky, 0), PIN_KING / 2 + CLEARANCE))
    shape = bored(shape, Z, ((tx, ty, 0), PIN_TIE / 2), ((qx, qy, 0), PIN_STEER / 2))
    bar = rod((tx, 60 - ty, 845), Y, 30, 2 * ty - 120)
    for sign in (1.0, -1.0):
        bar = fuse(bar, rod((tx, sign * ty, 815), Z, 65, 60))
    bar = bored(bar, Z, *[((tx, sign * ty, 0.0), PIN_TIE / 2 + CLEARANCE) for sign in (1.0, -1.0)])
    tree.add(Part("TIE ROD", bar, STEEL), "tie_rod")
    for letter, sign, one in (("l", 1.0, shape), ("r", -1.0, mirrored(shape))):
        body = f"knuckle_{letter}"
        tree.add(Part(f"KNUCKLE {letter.upper()}H", one, GREY), body)
        fit_pin(hardware, (tx, sign * ty, 805), PIN_TIE, low[1] - 805, body, f"tie_rod_{letter}_pin", upright=True)
        role = f"steering_piston_rod_{letter}_pin"
        fit_pin(hardware, (qx, sign * qy, low[0]), PIN_STEER, STEER_Z + 50 - low[0], body, role, upright=True)
    return tree


def draw_top() -> Assembly:
    """Engine, deck on its posts, cab, hood, tanks."""
    tree, top = Assembly("SUPERSTRUCTURE"), v.HEIGHT.value

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW) -> None:
        tree.add(Part(name, shape, colour), BODY)

    inside, outside, low, high = RAIL
    put("ENGINE", sheet_box(4950, 6900, -230, 230, low, 2100, 40.0), GREY)
    add_pair(tree, "ENGINE MOUNT", box(5300, 5500, 230, inside, 1350, 1500), BODY, GREY)
    put("TRANSMISSION", sheet_box(1100, 2500, -200, 200, 1200, 1640, 40.0), GREY)
    for x in (1300.0, 2200.0):
        add_pair(tree, "TRANSMISSION MOUNT", box(x, x + 120, 200, inside, 1300, 1420), BODY, GREY)
    put("RADIATOR", box(7180, 7290, -inside, inside, 1500, 2280), BLACK)
    for x in (3750.0, 5400.0, 7100.0):
        add_pair(tree, "DECK POST", box(x, x + 110, inside, outside, high, DECK), BODY, GREY)
    put("DECK PL", box(3700, 7300, -1900, 1900, DECK, DECK + 20))
    shell = cut(box(3900, 5500, 250, 1800, DECK + 20, top), box(3912, 5488, 262, 1788, DECK + 19, top - 12))
    side = [(4050.0, 3000.0, 0.0), (5350.0, 2800.0, 0.0), (5350.0, top - 110, 0.0), (4050.0, top - 110, 0.0)]
    windows = fuse(plate(side, "xz", 200, 1900), box(3800, 5600, 350, 1700, 2950, top - 110))
    put("CAB ROPS", cut(shell, windows))
    for name, y in (("LH", 1790.0), ("RH", 252.0)):
        put(f"SIDE GLASS {name}", plate(side, "xz", y, y + 8), GLASS)
    put("WINDSHIELD", box(5490, 5498, 350, 1700, 2950, top - 110), GLASS)
    put("REAR GLASS", box(3902, 3910, 350, 1700, 2950, top - 110), GLASS)
    put("AIR CLEANERS", sheet_box(5700, 6500, -1500, -700, DECK + 20, 3000, 6.0), GREY)
    put("HYDRAULIC TANK", sheet_box(3950, 4700, -1700, -600, DECK + 20, 2900, 6.0))
    put("EXHAUST", rod((6800, -1200, DECK + 20), Z, 110, 500), BLACK)
    put("FUEL TANK", sheet_box(2450, 3050, outside, 950, 1150, 1550, 8.0), BLACK)
    for name, y in (("LH", 1300.0), ("RH", -1500.0)):
        put(f"LADDER {name}", box(7305, 7345, y, y + 200, 1600, DECK + 20), GREY)
    put("GRILLE", ring((7291, 0, 1900), (1.0, 0.0, 0.0), 300, 250, 9), BLACK)
    return tree
