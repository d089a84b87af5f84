"""C-frame, pitch link and blade, drawn as they stand with the edge on the ground and carried from there with the
C-frame. Machine frame, millimetres."""

from __future__ import annotations

import math

from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.cylinders import Cylinder
from drawing.hardware import CLEARANCE, pin
from drawing.product import GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import Vector, X, Y, Z, ball, bored, box, cut, fuse, mirrored, plate, rod, sheet_box, shift, turn

from . import values as v
from .carrier import LIFT_PIN, PIVOT_PIN, clevis
from .linkage import ANGLE_FOOT, BALL, EDGE_X, LIFT_Y, LINK, PIVOT, Linkage

ARM = (440.0, 520.0)
"""The C-frame's arms across."""
BALL_RADIUS, NECK = 75.0, 32.0
"""Radii of the ball and of its stud."""
LINK_PIN, TILT_PIN, ANGLE_PIN = 45.0, 55.0, 45.0
"""Diameters."""
BACK = 2_640.0
"""The blade's back plate."""


def carried(turn_up: float) -> gp_Trsf:
    """Where the C-frame and what it carries go when it turns up (radians)."""
    px, py, pz = (float(c) for c in PIVOT)
    return turn(Y, -math.degrees(turn_up), (px, py, pz))


class Drawer:
    """Puts parts where the C-frame carries them."""

    def __init__(self, name: str, hardware: Assembly, up: float) -> None:
        self.tree, self._hardware, self._at = Assembly(name), hardware, carried(up)

    def put(self, name: str, shape: TopoDS_Shape, body: str, colour: Colour = YELLOW) -> None:
        """A part."""
        self.tree.add(Part(name, shape, colour), body, at=self._at)

    def pair(self, name: str, shape: TopoDS_Shape, body: str, colour: Colour = YELLOW) -> None:
        """A part drawn on the left, and its mirror image."""
        self.put(f"{name} LH", shape, body, colour)
        self.put(f"{name} RH", mirrored(shape), body, colour)

    def pin(self, at: Vector, diameter: float, half: float, body: str, role: str, *, upright: bool = False) -> None:
        """A pin about a point, level or upright."""
        place = shift(*at).Multiplied(turn(X, 90.0)) if upright else shift(*at)
        middle = place.Multiplied(shift(0, -half, 0))
        self._hardware.add(pin(diameter, 2 * half), body, role, self._at.Multiplied(middle))

    def pins(self, at: Vector, diameter: float, half: float, body: str, role: str, *, upright: bool = False) -> None:
        """One on the left and its like on the right."""
        for letter, sign in (("l", 1.0), ("r", -1.0)):
            self.pin((at[0], sign * at[1], at[2]), diameter, half, body, role.format(letter), upright=upright)


def _lugs(d: Drawer, name: str, outline: list[tuple[float, float, float]], plane: str, gaps: tuple[float, float, float],
          hole: float, body: str, *, twin: bool = False) -> None:  # fmt: skip
    """A clevis: two plates about a middle, so far apart inside, so thick, on a foot plate."""
    middle, inside, thick = gaps
    axis = Y if plane == "xz" else Z
    x, y, _ = outline[0]
    at = (x, 0.0, y) if plane == "xz" else (x, y, 0.0)
    (ax, ay, _), (bx, by, _) = outline[1:]
    size = math.hypot(bx - ax, by - ay)
    nx, ny = -(by - ay) / size * 18, (bx - ax) / size * 18
    foot = [(ax, ay, 0.0), (bx, by, 0.0), (bx + nx, by + ny, 0.0), (ax + nx, ay + ny, 0.0)]
    wide = inside + thick + 14
    cheeks = [plate(outline, plane, low, low + thick) for low in (middle - inside - thick, middle + inside)]
    shape = fuse(plate(foot, plane, middle - wide, middle + wide), *cheeks)
    (d.pair if twin else d.put)(name, bored(shape, axis, (at, hole / 2)), body)


def draw_c_frame(k: Linkage, up: float, hardware: Assembly, sizes: dict[str, Cylinder]) -> Assembly:
    """Two arms from the pivots to the cross box before the radiator, the nose with the blade's bearing, the tower."""
    d, body = Drawer("C-FRAME WELDMENT", hardware, up), "c_frame"
    px, _, pz = PIVOT
    outline = [(px, pz, 95), (1_000, 440, 0), (2_300, 440, 0), (2_300, 640, 0), (1_000, 640, 0)]
    arm = bored(plate([(float(a), float(b), float(c)) for a, b, c in outline], "xz", *ARM), Y,
                ((px, 0, pz), PIVOT_PIN / 2 + CLEARANCE))  # fmt: skip
    d.pair("C-FRAME ARM", arm, body)
    d.put("CROSS BOX", sheet_box(2_110, 2_300, -ARM[0], ARM[0], 440, 640, 18.0), body)
    bx, _, bz = BALL
    nose = box(2_300, bx - 95, -95, 95, bz - 95, bz + 95)
    d.put("NOSE", bored(nose, X, ((0, 0, bz), NECK)), body)
    stud = fuse(rod((2_304, 0, bz), X, NECK, bx - 2_304), ball((bx, 0, bz), BALL_RADIUS))
    d.tree.add(Part("BALL STUD", stud, STEEL), body, "blade_ball_pin", carried(up))
    d.put("TOWER", sheet_box(2_180, 2_300, -90, 90, 640, 1_170, 14.0), body)
    ex, _, ez = k.lift_eye
    half = sizes["lift"].eye_width / 2 + 2
    _lugs(d, "LIFT ROD LUG", clevis((ex, ez), [(ex - 110, 640), (ex + 110, 640)], 50), "xz",
          (LIFT_Y, half, 12), LIFT_PIN, body, twin=True)  # fmt: skip
    d.pins((ex, LIFT_Y, ez), LIFT_PIN, 48.0, body, "lift_piston_rod_{}_c_frame_pin")
    (lx, _, lz), _ = LINK
    _lugs(d, "PITCH LINK LUG", clevis((lx, lz), [(2_300, lz + 35), (2_300, lz - 35)], 34), "xz",
          (0.0, 22.0, 14), LINK_PIN, body)  # fmt: skip
    d.pin((lx, 0, lz), LINK_PIN, 40.0, body, "pitch_link_pin")
    tx, ty, tz = k.tilt_foot
    half = sizes["tilt"].eye_width / 2 + 2
    _lugs(d, "TILT CYL LUG", clevis((tx, ty), [(2_300, 70), (2_300, -70)], 48), "xy",
          (tz, half, 20), TILT_PIN, body)  # fmt: skip
    d.pin((tx, ty, tz), TILT_PIN, half + 22, body, "tilt_cylinder_barrel_pin", upright=True)
    ax, ay, az = ANGLE_FOOT
    half = sizes["angle"].eye_width / 2 + 2
    d.pair("ANGLE CYL BRKT", box(ax - 170, ax - 70, ARM[1], 622, 560, az + half + 14), body)
    _lugs(d, "ANGLE CYL LUG", clevis((ax, ay), [(ax - 70, 618), (ax - 70, 540)], 36), "xy",
          (az, half, 12), ANGLE_PIN, body, twin=True)  # fmt: skip
    d.pins((ax, ay, az), ANGLE_PIN, half + 14, body, "angle_cylinder_barrel_{}_pin", upright=True)
    return d.tree


def draw_link(up: float, hardware: Assembly) -> Assembly:
    """The pitch link."""
    d = Drawer("PITCH LINK", hardware, up)
    (ax, _, az), (bx, _, bz) = LINK
    shape = plate([(ax, az, 33), (bx, bz, 33)], "xz", -20, 20)
    d.put("PITCH LINK", bored(shape, Y, *(((x, 0, z), LINK_PIN / 2 + CLEARANCE) for x, z in ((ax, az), (bx, bz)))),
          "pitch_link", GREY)  # fmt: skip
    return d.tree


def draw_blade(k: Linkage, up: float, hardware: Assembly, sizes: dict[str, Cylinder]) -> Assembly:
    """Mouldboard, back plate and ribs, edge and end bits, and the lugs on its back."""
    d, body = Drawer("BLADE WELDMENT", hardware, up), "blade"
    half, high = v.BLADE_WIDTH.value / 2, v.BLADE_HEIGHT.value
    face = [(EDGE_X - 60, 160), (EDGE_X - 150, 420), (EDGE_X - 175, 680), (EDGE_X - 140, 950), (EDGE_X - 40, high)]
    thick = [(x - 28, z) for x, z in reversed(face)]
    board = plate([(x, z, 0.0) for x, z in (*face, *thick)], "xz", -half + 40, half - 40)
    d.put("MOULDBOARD", board, body)
    d.put("BACK PL", box(BACK, BACK + 25, -half + 120, half - 120, 250, 1_150), body)
    for y in (-half + 120, -820.0, -300.0, 284.0, 804.0, half - 136):
        rib = [(BACK + 25, 300, 0.0), (EDGE_X - 178 - 28, 420, 0.0), (EDGE_X - 203, 680, 0.0),
               (EDGE_X - 168, 950, 0.0), (BACK + 25, 1_100, 0.0)]  # fmt: skip
        d.put("RIB", plate(rib, "xz", y, y + 16), body)
    edge = [(EDGE_X, 0, 0.0), (EDGE_X - 60, 160, 0.0), (EDGE_X - 88, 160, 0.0), (EDGE_X - 28, 0, 0.0)]
    d.tree.add(Part("CUTTING EDGE", plate(edge, "xz", -half + 260, half - 260), STEEL), body, "cutting_edge",
               carried(up))  # fmt: skip
    bit = plate(edge, "xz", half - 260, half)
    for letter, shape in (("l", bit), ("r", mirrored(bit))):
        d.tree.add(Part(f"END BIT {letter.upper()}H", shape, STEEL), body, f"end_bit_{letter}", carried(up))
    bx, _, bz = BALL
    hollow = ball((bx, 0, bz), BALL_RADIUS + CLEARANCE)
    d.put("BALL SOCKET", cut(box(bx, BACK, -115, 115, bz - 115, bz + 115), hollow), body)
    d.put("SOCKET CAP", cut(box(bx - 32, bx, -115, 115, bz - 115, bz + 115), hollow), body, GREY)
    _, (lx, _, lz) = LINK
    _lugs(d, "PITCH LINK LUG", clevis((lx, lz), [(BACK, lz - 40), (BACK, lz + 20)], 34), "xz",
          (0.0, 22.0, 14), LINK_PIN, body)  # fmt: skip
    d.pin((lx, 0, lz), LINK_PIN, 40.0, body, "pitch_link_blade_pin")
    tx, ty, tz = k.tilt_eye
    gap = sizes["tilt"].eye_width / 2 + 2
    _lugs(d, "TILT ROD LUG", clevis((tx, ty), [(BACK, ty - 60), (BACK, ty + 60)], 48), "xy",
          (tz, gap, 20), TILT_PIN, body)  # fmt: skip
    # The pin stands out farther above than below: the bearing is in the eye, not in its middle.
    d.pin((tx, ty, tz + 15), TILT_PIN, gap + 37, body, "tilt_piston_rod_pin", upright=True)
    ax, ay, az = k.angle_eye
    gap = sizes["angle"].eye_width / 2 + 2
    _lugs(d, "ANGLE ROD LUG", clevis((ax, ay), [(BACK, ay - 50), (BACK, ay + 50)], 36), "xy",
          (az, gap, 12), ANGLE_PIN, body, twin=True)  # fmt: skip
    d.pins((ax, ay, az), ANGLE_PIN, gap + 14, body, "angle_piston_rod_{}_pin", upright=True)
    return d.tree
