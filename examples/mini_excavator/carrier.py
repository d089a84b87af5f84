"""What carries the digger: undercarriage with tracks and blade, upper structure, swing bracket. Machine frame,
millimetres."""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.digger import Linkage
from drawing.hardware import CLEARANCE, fit_pin, placed
from drawing.planar import rot, vec
from drawing.product import BLACK, GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, Z, bored, box, cut, fuse, mirrored, plate, ring, rod, sheet_box
from drawing.track import DARK, Track
from excavator.undercarriage import hollow
from excavator.upper import casting

from . import values as v
from .equipment import PIN
from .linkage import BLADE_BARREL, BLADE_PIN, PIVOT, SWING_Z, Blade, Swing

TRACK = Track(
    v.TRACK_ON_GROUND.value / 2, 10, 4, v.TRACK_GAUGE.value, v.SHOE_WIDTH.value, v.TRACK_LENGTH.value, (180.0, -180.0),
    35.0, (0.0,), 25.0, "undercarriage",
)  # fmt: skip
DECK, FLOOR = 330.0, 390.0
"""Top of the centre frame, underside of the revolving frame."""
BEARING = (150.0, 179.0, 180.0, 225.0)
"""Radii of the swing bearing's races: the undercarriage's, the upper structure's."""
UPRIGHT = 40.0
"""Diameter of the bracket's pin."""
LUGS = ((410.0, 443.0), (547.0, 580.0))
"""Heights of the frame's lugs that hold the bracket's pin; the bracket's lie between."""
SWING_PIN = 22.0


def draw_undercarriage(hardware: Assembly) -> Assembly:
    """Centre frame between the tracks, the bearing's inner race, the lugs of the blade."""
    tree, body = Assembly("UNDERCARRIAGE"), "undercarriage"
    inner, outer, _, _ = BEARING
    belly, step = v.GROUND_CLEARANCE.value, 235.0
    side = [(-230.0, belly), (200.0, belly), (200.0, step), (90.0, step), (90.0, DECK), (-230.0, DECK)]
    centre = hollow([(x, z, 0.0) for x, z in side], "xz", -160.0, 160.0, 8.0)
    tree.add(Part("CENTRE FRAME", centre, DARK), body)
    for y in (-TRACK.side + 42, 160.0):
        tree.add(Part("X BEAM", sheet_box(-150, 150, y, y + TRACK.side - 202, 120, 200, 8.0), DARK), body)
    race = ring((0, 0, DECK), Z, outer, inner, FLOOR - DECK - 12)
    tree.add(Part("SWING BEARING INNER RACE", race, STEEL), body, "swing_bearing")
    wx, wz = BLADE_PIN
    for y in (-135.0, 100.0):
        lug = plate([(wx, wz, 30), (200, wz + 38, 0), (200, wz - 40, 0)], "xz", y, y + 35)
        tree.add(Part("BLADE PIVOT LUG", bored(lug, Y, ((wx, 0, wz), PIN / 2)), DARK), body)
    bx, bz = BLADE_BARREL
    for y in (-50.0, 24.0):
        lug = plate([(bx, bz, 24), (90, bz + 25, 0), (90, bz - 60, 0)], "xz", y, y + 26)
        tree.add(Part("BLADE CYL LUG", bored(lug, Y, ((bx, 0, bz), 12.5)), DARK), body)
    fit_pin(hardware, (wx, -170, wz), PIN, 340, body, "blade_pin")
    fit_pin(hardware, (bx, -50, bz), 25.0, 100, body, "blade_cylinder_barrel_pin")
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        tree.add(TRACK.draw_side(letter, sign))
    return tree


def draw_blade(blade: Blade, angle: float, hardware: Assembly) -> Assembly:
    """The blade with its two arms and the cylinder's lugs; drawn along the line from the arms' pin to the edge."""
    tree, body = Assembly("DOZER BLADE"), "blade"
    at = placed((BLADE_PIN[0], 0, BLADE_PIN[1]), angle)
    (qx, qz), level = blade.rod, blade.at(0.0)
    far = float(blade.pins(0.0)[1][0] - BLADE_PIN[0])
    high, half = v.BLADE_HEIGHT.value, v.BLADE_WIDTH.value / 2

    def up(along: float, back: float) -> tuple[float, float, float]:
        """A corner of the blade's section, which is upright on the ground: how high, and how far behind its face."""
        x, z = rot(-level, vec(-back, along))
        return far + float(x), float(z), 0.0

    section = [up(0, 0), up(high, 0), up(high, 14), up(22, 14)]
    tree.add(Part("BLADE MOULDBOARD", plate(section, "xz", -half, half), YELLOW), body, at=at)
    for y in (-165.0, 140.0):
        arm = plate([(0, 0, 28), up(40, 14), up(110, 14)], "xz", y, y + 25)
        tree.add(Part("BLADE ARM", bored(arm, Y, ((0, 0, 0), PIN / 2 + CLEARANCE)), YELLOW), body, at=at)
    low, top = up(60, 14), up(150, 14)
    for y in (-34.0, 24.0):
        lug = plate([(qx, qz, 24), low, top], "xz", y, y + 10)
        tree.add(Part("BLADE ROD LUG", bored(lug, Y, ((qx, 0, qz), 12.5)), YELLOW), body, at=at)
    pin = blade.pins(angle)[0]
    fit_pin(hardware, (pin[0], -36, pin[1]), 25.0, 72, body, "blade_piston_rod_pin")
    return tree


# ---- swing bracket --------
def draw_bracket(k: Linkage, swing: Swing, hardware: Assembly) -> Assembly:
    """The bracket that swings before the frame: two lugs about the upright pin, which reach out to the cylinder's rod,
    and two plates that carry boom and boom cylinder."""
    tree, body = Assembly("SWING BRACKET"), "swing_bracket"
    sx, (rx, ry) = float(PIVOT[0]), swing.rod(0.0)
    front = sx + 62.0
    (ax, az), (cx, cz) = k.A, k.C
    for low, high in ((445.0, 473.0), (517.0, 545.0)):
        plan = [(sx, 0, 42.0), (float(rx), float(ry), 26.0), (front + 70, -51, 0.0), (front + 70, 51, 0.0)]
        lug = bored(
            plate(plan, "xy", low, high), Z, ((sx, 0, 0), UPRIGHT / 2 + CLEARANCE), ((rx, ry, 0), SWING_PIN / 2)
        )
        tree.add(Part("BRACKET LUG", lug, YELLOW), body)
    side = [(front, v.KINGPOST_CLEARANCE.value, 0.0), (front + 60, v.KINGPOST_CLEARANCE.value, 0.0), (cx, cz, 34.0)]
    side += [(ax, az, 40.0), (front, 560.0, 0.0)]
    web = bored(plate(side, "xz", 51, 66), Y, ((ax, 0, az), PIN / 2), ((cx, 0, cz), PIN / 2))
    for name, shape in (("LH", web), ("RH", mirrored(web))):
        tree.add(Part(f"BRACKET SIDE PL {name}", shape, YELLOW), body)
    boss = ring((cx, 24, cz), Y, 32, PIN / 2, 27)
    for name, shape in (("LH", boss), ("RH", mirrored(boss))):
        tree.add(Part(f"BOOM CYL BOSS {name}", shape, YELLOW), body)
    fit_pin(hardware, (ax, -78, az), PIN, 156, body, "swing_bracket_boom_pin")
    fit_pin(hardware, (cx, -78, cz), PIN, 156, body, "swing_bracket_boom_cylinder_barrel_pin")
    fit_pin(hardware, (float(rx), float(ry), 444), SWING_PIN, 102, body, "swing_piston_rod_pin", upright=True)
    return tree


# ---- upper structure --------
def draw_upper(swing: Swing, hardware: Assembly) -> Assembly:
    """Revolving frame with the nose that holds the bracket, counterweight, hood, seat and canopy."""
    tree, body = Assembly("UPPER STRUCTURE"), "upperstructure"
    half, tail = v.UPPER_WIDTH.value / 2, v.TAIL_RADIUS.value
    _, _, inner, outer = BEARING
    sx, (bx, by) = float(PIVOT[0]), swing.barrel

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW) -> None:
        tree.add(Part(name, shape, colour), body)

    put("SWING BEARING OUTER RACE", ring((0, 0, FLOOR - 44), Z, outer, inner, 44), STEEL)
    deck = LUGS[0][0]
    plan = [(-480, -half), (150, -half), (260, -90), (330, -60), (330, 60), (260, 90), (150, half), (-480, half)]
    put("BASE PL", bored(plate([(float(x), float(y), 0.0) for x, y in plan], "xy", FLOOR, deck), Z, ((0, 0, 0), 90.0)))
    for name, (low, high) in zip(("LOWER", "UPPER"), LUGS, strict=True):
        lug = plate([(sx, 0, 46), (200, 78, 0), (200, -78, 0)], "xy", low, high)
        put(f"NOSE LUG {name}", bored(lug, Z, ((sx, 0, 0), UPRIGHT / 2)))
    put("NOSE WEB", box(200, 216, -78, 78, LUGS[0][1], LUGS[1][0]))
    for y in (-78.0, 64.0):
        put("NOSE RIB", box(80, 200, y, y + 14, deck, LUGS[1][1]))
    for low, high in ((SWING_Z - 62, SWING_Z - 24), (SWING_Z + 24, SWING_Z + 50)):
        ear = plate([(float(bx), float(by), 26), (-130, -160, 0), (-130, -250, 0)], "xy", low, high)
        put("SWING CYL LUG", bored(ear, Z, ((bx, by, 0), SWING_PIN / 2)))
    put("SWING CYL POST", box(-160, -130, -260, -150, deck, SWING_Z + 50))
    fit_pin(hardware, (sx, 0, 400), UPRIGHT, 190, body, "swing_bracket_pin", upright=True)
    fit_pin(
        hardware, (float(bx), float(by), SWING_Z - 66), SWING_PIN, 120, body, "swing_cylinder_barrel_pin", upright=True
    )

    put(
        "COUNTERWEIGHT",
        cut(casting(tail, half, -480, FLOOR, 640), casting(tail - 45, half - 45, -525, FLOOR + 25, 615)),
    )
    put(
        "ENGINE HOOD", cut(casting(tail - 30, half - 10, -300, 640, 980), casting(tail - 36, half - 16, -306, 646, 974))
    )
    put("ENGINE", sheet_box(-470, -200, -140, 140, deck, 640, 7.0), GREY)
    put("FUEL TANK", sheet_box(-170, 60, 190, half - 10, deck, 640, 4.0))
    put("HYDRAULIC TANK", sheet_box(-100, 60, -half + 8, -270, deck, 640, 4.0))
    put("SWING MOTOR", fuse(rod((60, 120, deck), Z, 42, 110), rod((60, 120, deck + 110), Z, 30, 60)), GREY)
    put("SEAT BASE", sheet_box(-300, 40, -185, 185, 640, 700, 3.0), GREY)
    put("SEAT CUSHION", box(-260, 60, -180, 180, 700, 760), BLACK)
    put("SEAT BACK", box(-300, -240, -180, 180, 760, 1120), BLACK)
    for y in (-215.0, 185.0):
        put("CONSOLE", sheet_box(-120, 60, y, y + 30, 640, 900, 3.0), GREY)
        put("CONTROL LEVER", rod((40, y + 15, 900), Z, 9, 160), BLACK)
    for y in (-290.0, 250.0):
        put("CANOPY POST", sheet_box(-420, -380, y, y + 40, 980, v.CANOPY_HEIGHT.value - 40, 3.0), BLACK)
    roof = box(-430, 240, -300, 300, v.CANOPY_HEIGHT.value - 40, v.CANOPY_HEIGHT.value)
    put(
        "CANOPY ROOF",
        cut(roof, box(-370, 235, -295, 295, v.CANOPY_HEIGHT.value - 41, v.CANOPY_HEIGHT.value - 4)),
        BLACK,
    )
    return tree
