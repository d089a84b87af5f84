"""Saddle, drawbar, circle, the blade's carrier and the moldboard. The drawbar and what it carries are drawn as they
stand with the edge on the ground and carried from there. Machine frame, millimetres."""

from __future__ import annotations

import itertools
import math

from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.cylinders import Cylinder, Ram, draw_ram
from drawing.hardware import CLEARANCE, pin
from drawing.product import GREY, STEEL, YELLOW, Assembly, Colour, Part, Use
from drawing.solids import X, Y, Z, ball, bored, box, cut, fuse, mirrored, plate, prism, ring, rod, shift, turn

from . import values as v
from .linkage import BACK, CENTRE_FOOT, CIRCLE, EDGE_X, LIFT_FOOT, NOSE, SADDLE, TIP_FOOT, TIP_PIVOT, Linkage

LIFT_BALL, CENTRE_BALL, COLLAR, NOSE_BALL = 55.0, 48.0, 110.0, 70.0
"""Radii: of the studs' balls, of the ball around a lift cylinder, of the drawbar's at the nose."""
PIN_SADDLE, PIN_CARRIER, PIN_TIP = 90.0, 70.0, 45.0
"""Diameters."""
BOSS = 75.0
"""Radius of the saddle's boss."""
TABLE = (780.0, 840.0)
"""Underside and top of the drawbar's plate over the circle."""
RING = (640.0, v.CIRCLE_DIAMETER.value / 2, 690.0, 765.0)
"""The circle: radii, underside, top."""
ARM = (505.0, 545.0)
"""The circle's arms across."""
CHEEK = (440.0, 480.0)
"""The carrier's cheeks across."""
SHIFT_AT = (2_540.0, 320.0)
"""x and z of the side shift cylinder."""
HALF = v.BLADE_LENGTH.value / 2


def stud(tree: Assembly, at: tuple[float, float, float], axis: tuple[float, float, float], radius: float, length: float,
         body: str, role: str, place: gp_Trsf | None = None) -> None:  # fmt: skip
    """A ball stud about a point, its shank so long against the axis."""
    x, y, z = (c - length * a for c, a in zip(at, axis, strict=True))
    shape = fuse(rod((x, y, z), axis, 0.45 * radius, length), ball(at, radius))
    tree.add(Part(f"BALL STUD D{2 * radius:g}", shape, STEEL), body, role, place)


def draw_saddle(hardware: Assembly) -> Assembly:
    """Its boss over the frame's beam, an arm on either side with a lift cylinder's socket, the centre shift's arm."""
    tree, body = Assembly("SADDLE ASSY"), "saddle"
    x, _, z = (float(c) for c in SADDLE)
    fx, fy, fz = (float(c) for c in LIFT_FOOT)
    boss = bored(rod((x - 60, 0, z), X, BOSS, 260), X, ((0, 0, z), PIN_SADDLE / 2 + CLEARANCE))
    tree.add(Part("SADDLE BOSS", boss), body)
    around = rod((x - 300, 0, z), X, BOSS, 600)
    block = box(fx - 150, fx + 150, fy - 150, fy + 150, fz - 58, fz + 58)
    arm = cut(plate([(0, z, 68), (fy - 190, fz - 10, 55)], "yz", fx - 40, fx + 40), around, block)
    block = cut(block, ball((fx, fy, fz), COLLAR + CLEARANCE))
    for name, shape in (("SADDLE ARM", arm), ("LIFT SOCKET", block)):
        tree.add(Part(f"{name} LH", shape), body)
        tree.add(Part(f"{name} RH", mirrored(shape)), body)
    cx, cy, cz = (float(c) for c in CENTRE_FOOT)
    knee = (-330.0, z, 60.0)
    lug = fuse(*(plate([one, two], "yz", cx - 100, cx - 60) for one, two in (((0, z, 68), knee), (knee, (cy, cz, 48)))))
    lug = cut(lug, around)
    tree.add(Part("CENTER SHIFT LUG", bored(lug, X, ((0, cy, cz), 0.45 * CENTRE_BALL))), body)
    stud(hardware, (cx, cy, cz), X, CENTRE_BALL, 105.0, body, "centre_shift_cylinder_barrel_pin")
    return tree


class Drawer:
    """Puts parts where the drawbar carries them."""

    def __init__(self, name: str, hardware: Assembly, down: float) -> None:
        self.tree, self.hardware = Assembly(name), hardware
        self.at = turn(Y, -math.degrees(down), (float(NOSE[0]), 0.0, float(NOSE[2])))

    def put(self, name: str, shape: TopoDS_Shape, body: str, colour: Colour = YELLOW, role: str = "") -> None:
        """A part."""
        self.tree.add(Part(name, shape, colour), body, role, self.at)

    def pair(self, name: str, shape: TopoDS_Shape, body: str, colour: Colour = YELLOW) -> None:
        """A part drawn on the left, and its mirror image."""
        self.put(f"{name} LH", shape, body, colour)
        self.put(f"{name} RH", mirrored(shape), body, colour)

    def pin(self, x: float, z: float, y: tuple[float, float], size: float, body: str, role: str) -> None:
        """A level pin from one y to another."""
        place = self.at.Multiplied(shift(x, y[0], z))
        self.hardware.add(pin(size, y[1] - y[0]), body, role, place)


def draw_drawbar(k: Linkage, down: float, hardware: Assembly) -> Assembly:
    """Nose with its socket, two arms, the table over the circle and the ring that guides that, the cylinders' studs."""
    d, body = Drawer("DRAWBAR ASSY", hardware, down), "drawbar"
    nx, _, nz = (float(c) for c in NOSE)
    hollow = ball((nx, 0, nz), NOSE_BALL + CLEARANCE)
    d.put("DRAWBAR NOSE", cut(box(nx - 150, nx + 36, -105, 105, nz - 105, nz + 105), hollow), body)
    arm = plate([(nx - 150, 20, 0), (nx - 150, 105, 0), (3_340, 610, 0), (3_340, 490, 0)], "xy", TABLE[1], nz + 60)
    d.pair("DRAWBAR ARM", arm, body)
    table = box(2_060, 3_400, -620, 620, *TABLE)
    d.put("DRAWBAR TABLE", bored(table, Z, ((float(CIRCLE[0]), 0, 0), 420.0)), body)
    cx = float(CIRCLE[0])
    guide = ring((cx, 0, RING[2] - 5), Z, RING[0] - CLEARANCE, 560, TABLE[0] - RING[2] + 5)
    d.put("CIRCLE GUIDE RING", guide, body, STEEL, "circle_bearing")
    d.put("CIRCLE RETAINER", ring((cx, 0, RING[2] - 35), Z, 658, 560, 30), body, GREY)
    lx, ly, lz = (float(c) for c in k.lift_eye)
    bracket = bored(box(lx - 55, lx + 55, 560, ly - 60, TABLE[1], lz + 40), Y, ((lx, 0, lz), 0.45 * LIFT_BALL))
    d.pair("LIFT BRKT", bracket, body)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        stud(hardware, (lx, sign * ly, lz), (0.0, sign, 0.0), LIFT_BALL, 150.0, body,
             f"blade_lift_piston_rod_{letter}_pin", d.at)  # fmt: skip
    sx, sy, sz = (float(c) for c in k.centre_eye)
    lug = plate([(sy, sz, 48), (sy - 90, TABLE[1], 0), (sy + 60, TABLE[1], 0)], "yz", sx - 100, sx - 60)
    d.put("CENTER SHIFT LUG", bored(lug, X, ((0, sy, sz), 0.45 * CENTRE_BALL)), body)
    stud(hardware, (sx, sy, sz), X, CENTRE_BALL, 105.0, body, "centre_shift_piston_rod_pin", d.at)
    d.put("CIRCLE MOTOR", rod((2_190, 0, TABLE[1]), Z, 110, 230), body, GREY)
    return d.tree


def draw_circle(k: Linkage, down: float, hardware: Assembly) -> Assembly:
    """The ring, its two arms down to the carrier, the foot of the tip cylinder."""
    d, body = Drawer("CIRCLE ASSY", hardware, down), "circle"
    inner, outside, low, high = RING
    d.put("CIRCLE RING", ring((float(CIRCLE[0]), 0, low), Z, outside, inner, high - low), body)
    px, pz = (float(c) for c in TIP_PIVOT)
    leg = plate([(2_262, low, 0), (2_170, low, 0), (2_330, pz - 50, 0), (2_440, pz - 50, 0), (2_440, pz + 68, 0)], "xz",
                *ARM)  # fmt: skip
    arm = fuse(leg, plate([(2_400, pz, 50), (px, pz, 68)], "xz", *ARM))
    d.pair("CIRCLE ARM", bored(arm, Y, ((px, 0, pz), PIN_CARRIER / 2)), body)
    fx, fz = (float(c) for c in TIP_FOOT)
    cheeks = [plate([(fx, fz, 38), (fx + 40, low, 0), (fx - 40, low, 0)], "xz", y, y + 14) for y in (-39.0, 25.0)]
    for name, shape in zip(("LH", "RH"), cheeks, strict=True):
        d.put(f"TIP CYL LUG {name}", bored(shape, Y, ((fx, 0, fz), PIN_TIP / 2)), body)
    d.pin(fx, fz, (-45, 45), PIN_TIP, body, "blade_tip_cylinder_barrel_pin")
    for start, end in ((CHEEK[0] + 1, ARM[1] + 5), (-ARM[1] - 5, -CHEEK[0] - 1)):
        d.pin(px, pz, (start, end), PIN_CARRIER, body, "blade_carrier_pin")
    return d.tree


def side_ram() -> Ram:
    """Sizes of the side shift cylinder, drawn with the blade in the middle."""
    feet = [box(-70, -30, -30, 30, at, at + 40) for at in (300.0, 1_150.0)]
    return Ram(
        "SIDE SHIFT CYL", v.SIDE_BORE.value, v.SIDE_ROD.value, v.SIDE_STROKE.value, v.SHIFT_RIGHT.value, 78.0, 1_380.0,
        base=30.0, piston=45.0, gland=45.0, lugs=fuse(*feet),
    )  # fmt: skip


def draw_carrier(k: Linkage, down: float, hardware: Assembly) -> Assembly:
    """Two cheeks on the circle's arms with the shoes that the moldboard slides in, between them a tube with the tip
    cylinder's lug; the side shift cylinder."""
    d, body = Drawer("BLADE CARRIER ASSY", hardware, down), "blade_carrier"
    px, pz = (float(c) for c in TIP_PIVOT)
    sx, sz = SHIFT_AT
    cheek = plate([(px, pz, 75), (2_590, 95, 0), (2_590, 455, 0), (2_440, 455, 0)], "xz", *CHEEK)
    cheek = cut(cheek, box(2_573, 2_620, 0, 700, 108, 172), box(2_573, 2_620, 0, 700, 388, 442))
    cheek = bored(cheek, Y, ((px, 0, pz), PIN_CARRIER / 2 + CLEARANCE), ((sx, 0, sz), 46.0))
    d.pair("CARRIER CHEEK", cheek, body)
    d.put("CARRIER TUBE", box(px - 40, px + 40, -CHEEK[0], CHEEK[0], pz - 40, pz + 40), body)
    ex, ez = px + float(k.tip_eye[0]), pz + float(k.tip_eye[1])
    for name, y in (("LH", -39.0), ("RH", 25.0)):
        lug = plate([(ex, ez, 38), (px - 40, pz + 40, 0), (px + 10, pz + 40, 0)], "xz", y, y + 14)
        d.put(f"TIP ROD LUG {name}", bored(lug, Y, ((ex, 0, ez), PIN_TIP / 2)), body)
    d.pin(ex, ez, (-45, 45), PIN_TIP, body, "blade_tip_piston_rod_pin")
    for y in (-428.0, 422.0):
        d.put("RAM FOOT", box(2_440, sx - 70, y - 12, y + 18, sz - 60, sz + 50), body)
    names = {
        "barrel": body,
        "rod": "moldboard",
        "barrel_role": "side_shift_cylinder_barrel",
        "rod_role": "side_shift_piston_rod",
    }
    at = d.at.Multiplied(shift(sx, -740.0, sz)).Multiplied(turn(X, -90.0))
    d.tree.uses.append(Use(draw_ram(side_ram()), at, names=names))
    return d.tree


def draw_moldboard(down: float) -> Assembly:
    """The curved plate with its rails, edge and end bits, and what the side shift cylinder pushes."""
    d, body = Drawer("MOLDBOARD ASSY", Assembly(""), down), "moldboard"
    radius, thick, high = v.BLADE_RADIUS.value, v.BLADE_THICK.value, v.BLADE_HEIGHT.value
    middle = (EDGE_X + math.sqrt(radius**2 - (high / 2) ** 2), high / 2)

    def on(r: float, z: float) -> tuple[float, float]:
        return (middle[0] - math.sqrt(r**2 - (z - middle[1]) ** 2), z)

    # The lower end of the face lies on the edge's back, the plate's own back on the rails.
    flat = ((EDGE_X - 92, 160.0), (EDGE_X - 64, 90.0))
    face = (on(radius, high), on(radius, 0.5 * (high + 180.0)), on(radius, 180.0))
    back = [flat[1], (EDGE_X - 64 - thick, 90.0), (2_600.0, 118.0), (2_600.0, 432.0), on(radius + thick, high)]
    corners = [face[2], *flat[:1], *back, face[0]]
    path = [face, *itertools.pairwise(corners)]
    d.put("MOLDBOARD PL", prism(path, "xz", -HALF + 12, HALF - 12), body)
    side = HALF - 12
    for name, z0, z1 in (("LWR", 115.0, 165.0), ("UPR", 395.0, 435.0)):
        d.put(f"SLIDE RAIL {name}", box(2_580, 2_600, -side, side, z0, z1), body, STEEL)
    edge = [(EDGE_X, 0, 0.0), (EDGE_X - 66, 160, 0.0), (EDGE_X - 92, 160, 0.0), (EDGE_X - 28, 0, 0.0)]
    d.put("CUTTING EDGE", plate(edge, "xz", -side + 160, side - 160), body, STEEL, "cutting_edge")
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        bit = plate(edge, "xz", *((side - 160, side) if sign > 0 else (-side, -side + 160)))
        d.put(f"END BIT {letter.upper()}H", bit, body, STEEL, f"end_bit_{letter}")
    gusset = [(EDGE_X - 28, 0, 0.0), (EDGE_X, 0, 0.0), (EDGE_X - 62, 160, 0.0), (EDGE_X - 95, 300, 0.0),
              (EDGE_X, high, 0.0), (EDGE_X - 60, high, 0.0), *((x, z, 0.0) for x, z in reversed(BACK))]  # fmt: skip
    d.pair("MOLDBOARD END PL", plate(gusset, "xz", side, HALF), body)
    sx = SHIFT_AT[0]
    end = -740.0 + side_ram().long + v.SHIFT_RIGHT.value
    lug = box(sx - 60, 2_600, end, end + 30, 172.0, 388.0)
    d.put("SIDE SHIFT LUG", lug, body)
    return d.tree


def pin_saddle(hardware: Assembly) -> None:
    """The pin that the saddle turns on, in the frame's lugs."""
    x, _, z = (float(c) for c in SADDLE)
    place = shift(x - 140, 0, z).Multiplied(turn(Z, -90.0))
    hardware.add(pin(PIN_SADDLE, 420), "front_frame", "saddle_pin", place)


def sizes(k: Linkage, lift: float, centre: float) -> dict[str, Cylinder]:
    """Of a lift, the centre shift and the tip cylinder, at drawn lengths; the tip cylinder's is that of the blade
    upright."""
    return {
        "lift": Cylinder(
            "BLADE LIFT CYL", v.LIFT_BORE.value, v.LIFT_ROD.value, v.LIFT_STROKE.value, k.lift_closed, lift,
            outside=130, pin=0, eye=88, eye_width=84, base=-780, cap=40, piston=60, gland=70, port=12.0,
        ),
        "centre": Cylinder(
            "CENTER SHIFT CYL", v.CENTRE_BORE.value, v.CENTRE_ROD.value, v.CENTRE_STROKE.value, k.centre_closed, centre,
            outside=120, pin=0, eye=78, eye_width=72, base=120, cap=30, piston=55, gland=60, port=11.0,
        ),
        "tip": Cylinder(
            "BLADE TIP CYL", v.TIP_BORE.value, v.TIP_ROD.value, v.TIP_STROKE.value, k.closed("tip"), k.tip_length(0.0),
            outside=100, pin=PIN_TIP, eye=38, eye_width=46, base=70, cap=22, piston=45, gland=45, port=10.0,
        ),
    }  # fmt: skip
