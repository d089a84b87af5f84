"""The boom's sections, one in the other, and the carriage with its forks: each drawn in its own frame and put where the
linkage has it. Millimetres.

Lateral layout, from the middle: cylinder eyes within 36, lugs 40-66, carriage lugs 40-64 between bosses from 68 on;
the innermost section's neck outside its tube.
"""

from __future__ import annotations

from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import CLEARANCE, fit_pin, placed
from drawing.planar import Point, rot, vec
from drawing.product import BLACK, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, bored, box, cut, mirrored, moved, plate, ring

from . import values as v
from .chassis import PIN_BOOM, PIN_COMPENSATION, PIN_LIFT
from .linkage import COMPENSATION, DROP, HEEL, ROD, TILT_FROM, Linkage, Pose

AXIS = -120.0
"""Height of the sections' middle, in the boom's frame."""
TUBES = ((150.0, 190.0, 10.0), (135.0, 175.0, 9.0), (121.0, 161.0, 8.0))
"""Half width, half height, wall of the sections, from the outermost."""
START, END, MIDDLE_END = 120.0, 3_400.0, 3_480.0
"""The outermost section's ends; the middle one's outer end, drawn in."""
PIN_CARRIAGE, PIN_TILT, PIN_TELESCOPE = 80.0, 60.0, 40.0
TELESCOPE = {2: vec(190.0, AXIS), 3: vec(700.0, 170.0)}
"""The telescoping cylinder's barrel pin: in the sections, or on top of the outermost."""
Outline = list[tuple[float, float, float]]


def _both(tree: Assembly, name: str, shape: TopoDS_Shape, at: gp_Trsf, body: str, colour: Colour = YELLOW) -> None:
    for hand, one in (("LH", shape), ("RH", mirrored(shape))):
        tree.add(Part(f"{name} {hand}", moved(one, at), colour), body)


def _pin(tree: Assembly, at: Point, size: float, half: float, body: str, role: str) -> None:
    fit_pin(tree, (float(at[0]), -half, float(at[1])), size, 2 * half, body, role)


def _tube(section: int, start: float, end: float) -> TopoDS_Shape:
    half, high, wall = TUBES[section]
    outer = box(start, end, -half, half, AXIS - high, AXIS + high)
    return cut(outer, box(start - 1, end + 1, wall - half, half - wall, AXIS - high + wall, AXIS + high - wall))


def _at(k: Linkage, pose: Pose) -> gp_Trsf:
    return placed((float(k.P[0]), 0.0, float(k.P[1])), pose.boom)


def telescope(k: Linkage, pose: Pose, out: float) -> tuple[Point, Point]:
    """The telescoping cylinder's pins, the cylinder a share out."""
    barrel = TELESCOPE[k.sections]
    rod = barrel + vec(v.TELESCOPE_CLOSED.value + out * v.TELESCOPE_STROKE.value, 0.0)
    return k.P + rot(pose.boom, barrel), k.P + rot(pose.boom, rod)


def draw_boom(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """The outermost section: tube, tail with its hub, lugs of the cylinders."""
    tree, at, body = Assembly("BOOM"), _at(k, pose), "boom"
    half, high, _ = TUBES[0]
    low, top = AXIS - high, AXIS + high
    (dx, dz), (fx, fz), (tx, tz) = ROD, COMPENSATION[1], TELESCOPE[k.sections]
    tube = _tube(0, START, END)
    tube = bored(tube, Y, ((tx, 0, tz), PIN_TELESCOPE / 2)) if k.sections == 2 else tube
    tree.add(Part("BOOM TUBE", moved(tube, at), YELLOW), body)
    tail = plate([(0, 0, 105), (620, low + 10, 0), (620, top - 10, 0)], "xz", half, half + 16)
    tail = bored(tail, Y, ((0, 0, 0), PIN_BOOM / 2 + CLEARANCE), ((tx, 0, tz), PIN_TELESCOPE / 2 + 8))
    _both(tree, "BOOM TAIL PL", tail, at, body)
    hub = ring((0, -half, 0), Y, 100, PIN_BOOM / 2 + CLEARANCE, 2 * half)
    tree.add(Part("BOOM HUB", moved(hub, at), YELLOW), body)
    for name, side in (("LH", 1.0), ("RH", -1.0)):
        collar = box(END - 80, END, side * half, side * (half + 16), low, top)
        tree.add(Part(f"BOOM COLLAR {name}", moved(collar, at), YELLOW), body)
    lug = plate([(dx, dz, 58), (dx + 120, low, 0), (dx - 120, low, 0)], "xz", 40, 64)
    _both(tree, "LIFT CYL LUG", bored(lug, Y, ((dx, 0, dz), PIN_LIFT / 2)), at, body)
    lug = plate([(fx, fz, 42), (fx + 110, low, 0), (fx - 90, low, 0)], "xz", 30, 50)
    _both(tree, "COMP CYL LUG", bored(lug, Y, ((fx, 0, fz), PIN_COMPENSATION / 2)), at, body)
    if k.sections > 2:
        lug = plate([(tx, tz, 40), (tx - 90, top, 0), (tx + 60, top, 0)], "xz", 44, 62)
        _both(tree, "TELESCOPE CYL LUG", bored(lug, Y, ((tx, 0, tz), PIN_TELESCOPE / 2)), at, body)
    _pin(hardware, pose.D, PIN_LIFT, 70, body, "lift_piston_rod_pin")
    _pin(hardware, pose.F, PIN_COMPENSATION, 56, body, "compensation_piston_rod_pin")
    barrel, half_pin = telescope(k, pose, 0.0)[0], half - 1 if k.sections == 2 else 68
    _pin(hardware, barrel, PIN_TELESCOPE, half_pin, body, "telescope_cylinder_barrel_pin")
    return tree


def draw_sections(k: Linkage, pose: Pose, out: float, hardware: Assembly) -> Assembly:
    """The sections that move, a share out: of three the middle one, and the innermost with its neck."""
    tree, at, body = Assembly("BOOM SECTIONS"), _at(k, pose), "inner_boom"
    step = out * v.TELESCOPE_STROKE.value
    end = k.retracted + out * k.travel
    rod = TELESCOPE[k.sections] + vec(v.TELESCOPE_CLOSED.value + step, 0.0)
    rx, rz = (float(c) for c in rod)
    there = telescope(k, pose, out)[1]
    if k.sections > 2:
        half, high, _ = TUBES[1]
        middle, top = "middle_boom", AXIS + high
        tree.add(Part("MIDDLE BOOM TUBE", moved(_tube(1, 260 + step, MIDDLE_END + step), at), YELLOW), middle)
        lug = plate([(rx, rz, 40), (END + 8 + step, top, 0), (MIDDLE_END + step, top, 0)], "xz", 44, 62)
        _both(tree, "TELESCOPE ROD LUG", bored(lug, Y, ((rx, 0, rz), PIN_TELESCOPE / 2)), at, middle)
        _pin(hardware, there, PIN_TELESCOPE, 68, middle, "middle_telescope_piston_rod_pin")
    half, high, _ = TUBES[k.sections - 1]
    tube = _tube(k.sections - 1, (260 if k.sections == 2 else 320) + out * k.travel, end - 180)
    if k.sections == 2:
        tube = bored(tube, Y, ((rx, 0, rz), PIN_TELESCOPE / 2))
        _pin(hardware, there, PIN_TELESCOPE, half - 1, body, "telescope_piston_rod_pin")
    tree.add(Part("INNER BOOM TUBE", moved(tube, at), YELLOW), body)
    bx, bz = end + float(TILT_FROM[0]), float(TILT_FROM[1]) - DROP
    top, left = AXIS + high - 15, bx - 50
    neck: Outline = [(end, -DROP, 85), (end - 180, top, 0), (left, top, 0), (bx, bz, 62)]
    neck_pl = plate(neck, "xz", half, half + 18)
    neck_pl = bored(neck_pl, Y, ((end, 0, -DROP), PIN_CARRIAGE / 2), ((bx, 0, bz), PIN_TILT / 2))
    _both(tree, "NECK PL", neck_pl, at, body)
    for name, x, z, r, size, start in (
        ("NECK", end, -DROP, 75, PIN_CARRIAGE, 68.0), ("TILT CYL", bx, bz, 58, PIN_TILT, 66.0),
    ):  # fmt: skip
        _both(tree, f"{name} BOSS", ring((x, start, z), Y, r, size / 2, half - start), at, body)
    tie = box(end - 210, end - 180, -half, half, AXIS - high - 120, AXIS - high)
    tree.add(Part("NECK TIE", moved(tie, at), YELLOW), body)
    _pin(hardware, pose.N, PIN_CARRIAGE, half + 22, body, "carriage_pin")
    _pin(hardware, pose.B, PIN_TILT, half + 22, body, "tilt_cylinder_barrel_pin")
    return tree


def draw_carriage(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """Lugs on the carriage's pin, bars, backrest, forks; x along the level forks."""
    tree, body = Assembly("CARRIAGE"), "carriage"
    at = placed((float(pose.N[0]), 0.0, float(pose.N[1])), pose.carriage)
    (tx, tz), (hx, hz) = k.arm, HEEL

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW, role: str = "") -> None:
        tree.add(Part(name, moved(shape, at), colour), body, role)

    back, bar = hx - 90, hx - 50
    side: Outline = [(0, 0, 70), (back, -150, 0), (back, 280, 0), (tx, tz, 50)]
    lug = bored(plate(side, "xz", 40, 64), Y, ((0, 0, 0), PIN_CARRIAGE / 2 + CLEARANCE), ((tx, 0, tz), PIN_TILT / 2))
    _both(tree, "CARRIAGE LUG", lug, at, body)
    low = hz - 50
    for name, z0, z1 in (("UPPER", 130.0, 210.0), ("LOWER", low + 20, low + 100)):
        put(f"FORK BAR {name}", box(back, bar, -600, 600, z0, z1))
    _both(tree, "CARRIAGE UPRIGHT", box(back, bar, 24, 64, low + 100, 130), at, body)
    for y in (-580.0, -20.0, 540.0):
        put("BACKREST BAR", box(back, bar, y, y + 40, 210, 860), BLACK)
    put("BACKREST TOP", box(back, bar, -580, 580, 860, 900), BLACK)
    tip = hx + v.FORK_LENGTH.value
    profile: Outline = [(bar, low, 0), (tip, low, 0), (tip, hz, 0), (hx, hz, 0), (hx, 180, 0), (bar, 180, 0)]
    fork = plate(profile, "xz", 240, 360)
    put("FORK LH", fork, BLACK, "forks")
    put("FORK RH", mirrored(fork), BLACK, "forks")
    _pin(hardware, pose.T, PIN_TILT, 68, body, "tilt_piston_rod_pin")
    return tree
