"""The base machine: main frame between its tracks, engine under its hood, cab, and what the blade hangs on. Machine
frame, millimetres."""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import fit_pin
from drawing.product import AMBER, BLACK, GLASS, GREY, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, Z, bored, box, cut, fuse, mirrored, plate, ring, rod, sheet_box
from drawing.track import DARK, Track

from . import values as v
from .linkage import LIFT_FOOT, LIFT_Y, PIVOT

BODY = "main_frame"
HALF, WALL = 420.0, 20.0
"""Half of the main frame's width, and its plates."""
FRONT, TOP = 1_830.0, 900.0
HOOD = 390.0
"""Half of the hood's width."""
PIVOT_PIN, LIFT_PIN = 90.0, 60.0
"""Diameters."""
LIFT_EYE = 60.0
"""Width of the lift cylinders' eyes."""
TRACK = Track(
    v.TRACK_ON_GROUND.value / 2, 15, 6, v.TRACK_GAUGE.value, v.SHOE_WIDTH.value, v.TRACK_LENGTH.value,
    tuple(1_225.0 - 350.0 * i for i in range(int(v.TRACK_ROLLERS.value))), 95.0, (450.0, -450.0), 55.0, BODY, 2.2,
)  # fmt: skip
Outline = list[tuple[float, float, float]]


def twins(hardware: Assembly, at: tuple[float, float, float], size: float, half: float, body: str, role: str) -> None:
    """A level pin on the left about a point, and its like on the right; `{}` in the role is the side."""
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        fit_pin(hardware, (at[0], sign * at[1] - half, at[2]), size, 2 * half, body, role.format(letter))


def clevis(at: tuple[float, float], base: list[tuple[float, float]], size: float) -> Outline:
    """The outline of a lug about an eye, from its base; the base's corners counter-clockwise."""
    return [(at[0], at[1], size), *((a, b, 0.0) for a, b in base)]


def draw_frame(hardware: Assembly) -> Assembly:
    """The hull with the C-frame's pivots and the lift cylinders' lugs, axle beams to the tracks, drawbar."""
    tree = Assembly("MAIN FRAME WELDMENT")
    belly, rear = v.GROUND_CLEARANCE.value, -1_500.0
    px, _, pz = PIVOT
    hull = bored(sheet_box(rear, FRONT, -HALF, HALF, belly, TOP, WALL), Y, ((px, 0, pz), PIVOT_PIN / 2))

    def pair(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW) -> None:
        tree.add(Part(f"{name} LH", shape, colour), BODY)
        tree.add(Part(f"{name} RH", mirrored(shape), colour), BODY)

    tree.add(Part("HULL", hull, YELLOW), BODY)
    pair("C-FRAME BOSS", ring((px, HALF, pz), Y, 85, PIVOT_PIN / 2, 16))
    twins(hardware, (px, 468.0, pz), PIVOT_PIN, 70.0, BODY, "c_frame_pin")
    lx, _, lz = LIFT_FOOT
    pair("LIFT CYL BRKT", box(lx - 130, lx + 110, HOOD, LIFT_Y + 56, 1_140, 1_225))
    outline = clevis((lx, lz), [(lx - 120, 1_225), (lx + 50, 1_225)], 50)
    lugs = [plate(outline, "xz", y, y + 13) for y in (LIFT_Y - LIFT_EYE / 2 - 15, LIFT_Y + LIFT_EYE / 2 + 2)]
    foot = box(lx - 120, lx + 50, LIFT_Y - 56, LIFT_Y + 56, 1_225, 1_243)
    pair("LIFT CYL LUG", bored(fuse(foot, *lugs), Y, ((lx, 0, lz), LIFT_PIN / 2)))
    twins(hardware, (lx, LIFT_Y, lz), LIFT_PIN, 50.0, BODY, "lift_cylinder_barrel_{}_pin")
    inner = TRACK.side - 30 * TRACK.scale - 12 * TRACK.scale
    for name, x in (("FRONT", -60.0), ("REAR", -1_100.0)):
        pair(f"AXLE BEAM {name}", sheet_box(x - 110, x + 110, HALF, inner, 430, 560, 14.0), DARK)
    back = v.TRACK_LENGTH.value / 2 - v.BARE_LENGTH.value
    tree.add(Part("DRAWBAR", box(back, rear, -90, 90, 420, 520), DARK), BODY)
    return tree


def draw_power() -> Assembly:
    """Engine, hood, radiator guard, tanks."""
    tree = Assembly("POWER PACK")

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW) -> None:
        tree.add(Part(name, shape, colour), BODY)

    hood = box(150, FRONT - 60, -HOOD, HOOD, TOP, 1_680)
    put("ENGINE HOOD", cut(hood, box(156, FRONT - 66, -HOOD + 6, HOOD - 6, TOP - 1, 1_674)))
    put("RADIATOR GUARD", sheet_box(FRONT - 60, FRONT, -HOOD, HOOD, TOP, 1_700, 8.0), BLACK)
    put("ENGINE", sheet_box(450, 1_500, -280, 280, TOP, 1_450, 16.0), GREY)
    put("RADIATOR", box(1_620, 1_720, -340, 340, TOP, 1_600), BLACK)
    put("EXHAUST STACK", rod((900, 180, 1_680), Z, 55, 700), BLACK)
    put("FUEL TANK", sheet_box(-1_500, -900, -600, 600, 1_100, 1_750, 5.0))
    put("TANK FOOT", box(-1_450, -950, -380, 380, TOP, 1_100), DARK)
    put("HYDRAULIC TANK", sheet_box(-880, -560, 440, 700, 1_100, 1_600, 5.0))
    put("TANK BRKT", box(-860, -580, 380, 440, 1_050, 1_300), DARK)
    return tree


def draw_cab() -> Assembly:
    """Cab with its roof, floor, seat, levers and lamps."""
    tree = Assembly("CAB ASSY")
    top, half = v.HEIGHT.value, 640.0

    def put(name: str, shape: TopoDS_Shape, colour: Colour = BLACK) -> None:
        tree.add(Part(name, shape, colour), BODY)

    put("CAB FLOOR", box(-880, 150, -380, 380, TOP, 930), DARK)
    put("CAB SILL", sheet_box(-880, 150, -half, half, 1_050, 1_120, 6.0), YELLOW)
    put("SILL POST", box(-880, 150, -370, 370, 930, 1_050), DARK)
    side: Outline = [(-850, 1_120, 0), (140, 1_120, 0), (60, top - 90, 0), (-830, top - 90, 0)]
    window: Outline = [(-760, 1_700, 0), (30, 1_700, 0), (-10, top - 190, 0), (-760, top - 190, 0)]
    for name, y in (("LH", half - 40), ("RH", -half)):
        put(f"CAB SIDE {name}", cut(plate(side, "xz", y, y + 40), plate(window, "xz", y - 1, y + 41)))
        put(f"SIDE GLASS {name}", plate(window, "xz", y + 16, y + 24), GLASS)
    put("CAB ROOF", sheet_box(-880, 120, -half - 20, half + 20, top - 90, top, 5.0))
    put("CAB BACK", box(-845, -815, -half + 40, half - 40, 1_120, top - 90))
    put("SEAT BASE", sheet_box(-640, -200, -230, 230, 1_120, 1_420, 4.0), GREY)
    put("SEAT", fuse(box(-660, -160, -250, 250, 1_420, 1_540), box(-780, -660, -250, 250, 1_420, 2_180)))
    for name, y in (("LH", 330.0), ("RH", -350.0)):
        put(f"CONSOLE {name}", sheet_box(-420, -120, y, y + 20, 1_120, 1_620, 4.0), GREY)
        put(f"LEVER {name}", rod((-220, y + 10, 1_620), Z, 9, 180))
    for y in (-500.0, 400.0):
        put("WORK LAMP", box(120, 180, y, y + 100, top - 80, top - 10), AMBER)
    return tree


def draw_undercarriage() -> Assembly:
    """Both tracks."""
    tree = Assembly("UNDERCARRIAGE")
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        tree.add(TRACK.draw_side(letter, sign))
    return tree
