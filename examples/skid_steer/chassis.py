"""Chassis with its axles, engine, tail and cab, and the wheels. Machine frame, millimetres."""

from __future__ import annotations

import math

from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import bolt
from drawing.product import AMBER, BLACK, GLASS, GREY, RED, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, Z, bored, box, cut, fuse, mirrored, plate, ring, rod, sheet_box, shift, turned

from . import values as v
from .equipment import ARM_END, ARM_Y, LINK_PIN, LINK_Y, PIN, Outline, twins
from .linkage import AXLE_X, RADIUS, Linkage

BODY = "chassis"
INSIDE, OUTSIDE = 480.0, 500.0
"""The side plates."""
WHEEL_Y = (v.OVERALL_WIDTH.value - v.TYRE_WIDTH.value) / 2
SPINDLE, HOUSING = 45.0, 75.0
"""Radii."""
BEARING = 370.0
"""Where the axles' housings end, inside the chain cases."""
TAIL_FRONT, FLOOR = -1440.0, 20.0
"""Front of the tail; thickness of the belly plate."""
TYRE_DENSITY = 1100.0


def _pair(tree: Assembly, name: str, shape: TopoDS_Shape, colour: Colour = YELLOW) -> None:
    tree.add(Part(f"{name} LH", shape, colour), BODY)
    tree.add(Part(f"{name} RH", mirrored(shape), colour), BODY)


def draw_frame(k: Linkage, hardware: Assembly) -> Assembly:
    """Side plates with the bosses of arms, links and lift cylinders; floor, cross plates, chain cases with axles."""
    tree = Assembly("CHASSIS WELDMENT")
    belly = v.GROUND_CLEARANCE.value
    arms = ("boom",) if len(k.links) == 1 else ("rear_link", "front_link")
    boss_end, pin_end = (ARM_Y - 4, ARM_END + 4) if len(k.links) == 1 else (LINK_Y[0] - 2, LINK_Y[1] + 6)
    side: Outline = [(-1440, 330, 0), (-1180, belly, 0), (640, belly, 0), (700, 330, 0), (700, 840, 0), (-160, 930, 0)]
    plates = plate([*side, (-1440, 930, 0)], "xz", INSIDE, OUTSIDE)
    holes = [((x, 0.0, RADIUS), HOUSING) for x in (AXLE_X, -AXLE_X)]
    for arm, (at, _) in zip(arms, k.links, strict=True):
        x, z = float(at[0]), float(at[1])
        if z > 900.0:
            plates = fuse(plates, plate([(x, z, 75), (x - 160, 900, 0), (x + 200, 900, 0)], "xz", INSIDE, OUTSIDE))
        boss = ring((x, OUTSIDE, z), Y, LINK_PIN / 2 + 20, LINK_PIN / 2, boss_end - OUTSIDE)
        _pair(tree, f"{arm.upper().replace('_', ' ')} BOSS", boss)
        holes.append(((x, 0.0, z), LINK_PIN / 2))
        twins(hardware, INSIDE - 5, pin_end, at, LINK_PIN, BODY, f"{arm}_pin")
    x, z = float(k.C[0]), float(k.C[1])
    _pair(tree, "LIFT CYL BOSS", ring((x, OUTSIDE, z), Y, 40, PIN / 2, 22))
    twins(hardware, INSIDE - 5, 580, k.C, PIN, BODY, "boom_cylinder_barrel_{}_pin")
    _pair(tree, "SIDE PL", bored(plates, Y, *holes, ((x, 0.0, z), PIN / 2)))
    tree.add(Part("BELLY PL", box(-1180, 640, -INSIDE, INSIDE, belly, belly + FLOOR), GREY), BODY)
    tree.add(Part("FRONT PL", box(680, 700, -INSIDE, INSIDE, 335, 840)), BODY)
    tree.add(Part("REAR X-MEMBER", box(-1440, -1420, -INSIDE, INSIDE, 335, 900)), BODY)
    case = bored(sheet_box(-AXLE_X - 130, AXLE_X + 130, 420, INSIDE, 300, 540, 12.0), Y, *holes[:2])
    for x in (AXLE_X, -AXLE_X):
        tube = rod((x, BEARING, RADIUS), Y, HOUSING, WHEEL_Y - 75 - BEARING)
        case = fuse(case, tube, rod((x, OUTSIDE, RADIUS), Y, SPINDLE, WHEEL_Y + 15 - OUTSIDE))
    _pair(tree, "CHAIN CASE AND AXLES", case, GREY)
    return tree


def draw_engine(k: Linkage) -> Assembly:
    """Engine under its hood, tanks, and the tail with its door, as wide as the published radius lets it."""
    tree = Assembly("POWER PACK")
    half = math.sqrt(v.REAR_RADIUS.value**2 - k.tail**2)

    def put(name: str, shape: TopoDS_Shape, colour: Colour = GREY) -> None:
        tree.add(Part(name, shape, colour), BODY)

    put("ENGINE", sheet_box(-1150, -560, -240, 240, 300, 800, 14.0))
    put("ENGINE MOUNT", box(-1050, -660, -200, 200, v.GROUND_CLEARANCE.value + FLOOR, 300))
    put("HYDROSTATIC PUMP", rod((-420, -160, 420), Y, 110, 320))
    put("PUMP FOOT", box(-480, -360, -150, 150, v.GROUND_CLEARANCE.value + FLOOR, 320))
    put("FUEL TANK", sheet_box(-250, 560, 280, 360, 230, 700, 4.0), BLACK)
    put("HYDRAULIC TANK", sheet_box(-250, 560, -360, -280, 230, 700, 4.0), BLACK)
    hood = cut(box(-1440, -640, -INSIDE, INSIDE, 930, 1240), box(-1436, -644, -476, 476, 926, 1236))
    put("ENGINE HOOD", hood, YELLOW)
    put("RADIATOR", box(-1410, -1330, -400, 400, 420, 900), BLACK)
    inside = box(k.tail + 20, TAIL_FRONT - 12, -half + 12, half - 12, 455, 1288)
    tail = cut(box(k.tail, TAIL_FRONT, -half, half, 430, 1300), inside)
    put("TAILGATE", cut(tail, box(k.tail - 1, k.tail + 21, -300, 300, 620, 1150)), YELLOW)
    put("TAIL GRILLE", box(k.tail + 4, k.tail + 12, -300, 300, 620, 1150), BLACK)
    for name, y in (("LH", half - 150), ("RH", -half + 50)):
        put(f"TAIL LAMP {name}", box(k.tail + 30, k.tail + 90, y, y + 100, 1300, 1360), RED)
    put("BEACON", rod((-1500, 0, 1300), Z, 50, 90), AMBER)
    return tree


def draw_cab() -> Assembly:
    """Posts, roof, floor, side screens, seat and levers."""
    tree = Assembly("CAB ASSY")
    top, half = v.HEIGHT.value, 465.0

    def put(name: str, shape: TopoDS_Shape, colour: Colour = BLACK) -> None:
        tree.add(Part(name, shape, colour), BODY)

    put("CAB FLOOR", box(-400, 680, -INSIDE, INSIDE, 700, 712), GREY)
    side: Outline = [(-620, 1250, 0), (-300, 935, 0), (610, 935, 0), (640, 1040, 0)]
    side += [(560, top - 60, 0), (-560, top - 60, 0)]
    window: Outline = [(-500, 1290, 0), (-230, 1060, 0), (540, 1060, 0)]
    window += [(480, top - 130, 0), (-480, top - 130, 0)]
    for name, y in (("LH", half - 12), ("RH", -half)):
        put(f"CAB SIDE {name}", cut(plate(side, "xz", y, y + 12), plate(window, "xz", y - 1, y + 13)))
        put(f"SIDE SCREEN {name}", plate(window, "xz", y + 4, y + 8), GLASS)
    put("CAB SILL", box(-300, 640, half - 12, INSIDE, 712, 935), YELLOW)
    put("CAB SILL", box(-300, 640, -INSIDE, -half + 12, 712, 935), YELLOW)
    back = box(-580, -570, -half + 12, half - 12, 1240, top - 60)
    put("CAB BACK", cut(back, box(-601, -569, -330, 330, 1400, top - 200)))
    put("REAR GLASS", box(-578, -572, -330, 330, 1400, top - 200), GLASS)
    put("CAB ROOF", sheet_box(-580, 590, -half - 5, half + 5, top - 60, top, 4.0))
    put("WORK LAMP", box(590, 640, 250, 350, top - 60, top - 10), GREY)
    put("WORK LAMP", box(590, 640, -350, -250, top - 60, top - 10), GREY)
    put("SEAT BASE", sheet_box(-260, 120, -200, 200, 712, 900, 4.0), GREY)
    put("SEAT CUSHION", sheet_box(-280, 200, -240, 240, 900, 1020, 3.0))
    put("SEAT BACK", sheet_box(-380, -280, -240, 240, 900, 1560, 3.0))
    for name, y in (("LH", 300.0), ("RH", -310.0)):
        put(f"LEVER CONSOLE {name}", box(150, 330, y, y + 10, 712, 1180), GREY)
        put(f"LEVER {name}", rod((240, y + 5, 1180), Z, 5, 140))
    stays = [box(166, 194, y, y + 14, 1040, 1240) for y in (-260.0, 246.0)]
    put("LAP BAR", fuse(rod((180, -260, 1240), Y, 14, 520), *stays))
    return tree


def draw_wheel() -> Assembly:
    """Tyre, rim, hub and six bolts about the origin, the axle along y, outwards +y; tagged "wheel" and "tyre"."""
    tree = Assembly(f"WHEEL {v.TYRE_SIZE}")
    r, w = RADIUS, v.TYRE_WIDTH.value / 2
    outside = [(-105, 208), (-w, 270), (-w, 320), (-140, r - 42), (-118, r)]
    inside = [(-92, 208), (-w + 16, 276), (-w + 16, 312), (-118, r - 60), (-96, r - 30)]
    profile = outside + [(-s, q) for s, q in reversed(outside)] + [(-s, q) for s, q in inside] + list(reversed(inside))
    tree.add(Part("TYRE", turned(profile), BLACK, TYRE_DENSITY), "wheel", "tyre")
    rim = [(-112, 208), (-112, 228), (-105, 228), (-105, 208), (105, 208), (105, 228), (112, 228), (112, 208)]
    rim += [(112, 196), (16, 196), (16, 60), (2, 60), (2, 196), (-112, 196)]
    circle = [(110 * math.cos(math.radians(60 * i)), 110 * math.sin(math.radians(60 * i))) for i in range(6)]
    holes = [rod((x, -60, z), Y, 8.2, 200) for x, z in circle]
    tree.add(Part("RIM", cut(turned(rim), *holes), YELLOW), "wheel")
    hub = turned([(-70, SPINDLE + 0.2), (2, SPINDLE + 0.2), (2, 140), (-14, 140), (-20, 82), (-70, 76)])
    tree.add(Part("HUB", cut(hub, *holes), STEEL), "wheel")
    tree.add(Part("HUB CAP", turned([(16, 0), (16, 78), (40, 70), (52, 40), (52, 0)]), GREY), "wheel")
    for x, z in circle:
        tree.add(bolt(16, 28), "wheel", at=shift(x, 16, z))
    return tree
