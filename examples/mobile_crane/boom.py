"""The boom's sections, one in the other, the sheaves of its head with the rope, and the hook block: the sections
drawn in the boom's frame and put where the linkage has it. Millimetres.
"""

from __future__ import annotations

from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import CLEARANCE, fit_pin, placed
from drawing.planar import Point, rot, vec
from drawing.product import GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, Z, bored, box, cut, fuse, mirrored, moved, plate, ring, rod, shift

from . import values as v
from .linkage import HAUL, RAISED, D, P, Pose
from .superstructure import PIN_BOOM, PIN_LUFFING

AXIS = 450.0
"""Height of the sections' middle, in the boom's frame."""
TUBES = ((210.0, 300.0, 10.0), (194.0, 284.0, 9.0), (179.0, 269.0, 8.0), (165.0, 255.0, 7.0))
"""Half width, half height, wall of the sections, from the outermost."""
BODIES = ("boom", "middle_boom", "second_middle_boom", "inner_boom")
START, ENDS = (120.0, 260.0, 340.0, 420.0), (7_950.0, 8_150.0, 8_350.0, 8_800.0)
TELESCOPE = vec(500.0, AXIS + TUBES[0][1] + 105.0)
PIN_TELESCOPE, PIN_HEAD = 80.0, 80.0
NOSE = 630.0
"""How far the head reaches beyond the pin of its sheaves."""
ROPE, SHEAVE = v.ROPE.value / 2, 138.0
FALLS = [(x, y) for y in (-60.0, -20.0, 20.0, 60.0) for x in (SHEAVE - ROPE, ROPE - SHEAVE)]
BLOCK = (240.0, -540.0)
"""Top and bottom of the hook block, from the pin of its sheaves."""


def _at(pose: Pose) -> gp_Trsf:
    return placed((float(P[0]), 0.0, float(P[1])), pose.boom)


def _both(tree: Assembly, name: str, shape: TopoDS_Shape, at: gp_Trsf, body: str, colour: Colour = YELLOW) -> None:
    for hand, one in (("LH", shape), ("RH", mirrored(shape))):
        tree.add(Part(f"{name} {hand}", moved(one, at), colour), body)


def _tube(section: int, out: float) -> TopoDS_Shape:
    half, high, wall = TUBES[section]
    start, end = START[section] + out, ENDS[section] + out
    outer = box(start, end, -half, half, AXIS - high, AXIS + high)
    return cut(outer, box(start - 1, end + 1, wall - half, half - wall, AXIS - high + wall, AXIS + high - wall))


def telescope(pose: Pose) -> tuple[Point, Point]:
    """The telescoping cylinder's pins."""
    along = v.TELESCOPE_CLOSED.value + pose.out * v.TELESCOPE_STROKE.value
    return P + rot(pose.boom, TELESCOPE), P + rot(pose.boom, TELESCOPE + vec(along, 0.0))


def _pin(tree: Assembly, at: Point, size: float, half: float, body: str, role: str) -> None:
    fit_pin(tree, (float(at[0]), -half, float(at[1])), size, 2 * half, body, role)


def draw_boom(pose: Pose, hardware: Assembly) -> Assembly:
    """All sections, with what hangs on them."""
    tree, at, body = Assembly("BOOM"), _at(pose), "boom"
    half, high, _ = TUBES[0]
    low, top = AXIS - high, AXIS + high
    for number, name in enumerate(BODIES):
        tube = moved(_tube(number, number * pose.out * v.TELESCOPE_STROKE.value), at)
        tree.add(Part(f"BOOM SECTION {number + 1}", tube, YELLOW), name)
    tail = plate([(0, 0, 150), (900, low + 10, 0), (900, top - 10, 0), (200, top - 10, 0)], "xz", half, half + 16)
    _both(tree, "BOOM TAIL PL", bored(tail, Y, ((0, 0, 0), PIN_BOOM / 2 + CLEARANCE)), at, body)
    hub = ring((0, -half, 0), Y, 125, PIN_BOOM / 2 + CLEARANCE, 2 * half)
    tree.add(Part("BOOM HUB", moved(hub, at), YELLOW), body)
    dx, dz = (float(c) for c in D)
    lug = plate([(dx, dz, 110), (dx + 230, low, 0), (dx - 230, low, 0)], "xz", 112, 162)
    _both(tree, "LUFFING CYL LUG", bored(lug, Y, ((dx, 0, dz), PIN_LUFFING / 2)), at, body)
    tx, tz = (float(c) for c in TELESCOPE)
    lug = plate([(tx, tz, 60), (tx - 110, top, 0), (tx + 110, top, 0)], "xz", 85, 115)
    _both(tree, "TELESCOPE CYL LUG", bored(lug, Y, ((tx, 0, tz), PIN_TELESCOPE / 2)), at, body)
    _pin(hardware, pose.rod, PIN_LUFFING, 175, body, "luffing_piston_rod_pin")
    first, second = telescope(pose)
    _pin(hardware, first, PIN_TELESCOPE, 122, body, "telescope_cylinder_barrel_pin")
    body, out = "middle_boom", pose.out * v.TELESCOPE_STROKE.value
    rx, top = tx + v.TELESCOPE_CLOSED.value + out, AXIS + TUBES[1][1]
    lug = plate([(rx, tz, 60), (ENDS[0] + 15 + out, top, 0), (ENDS[1] + out, top, 0)], "xz", 85, 115)
    _both(tree, "TELESCOPE ROD LUG", bored(lug, Y, ((rx, 0, tz), PIN_TELESCOPE / 2)), at, body)
    _pin(hardware, second, PIN_TELESCOPE, 122, body, "middle_telescope_piston_rod_pin")
    return tree


def draw_head(pose: Pose, hardware: Assembly) -> Assembly:
    """The head on the innermost section: plates that hold the sheaves' pin, and the nose."""
    tree, at, body = Assembly("BOOM HEAD"), _at(pose), "inner_boom"
    half, high, _ = TUBES[3]
    x, back, top = pose.length, ENDS[3] + 3 * pose.out * v.TELESCOPE_STROKE.value - 260.0, AXIS + high - 20.0
    side = [(x, 0, 105), (x + 60, top, 0), (back, top, 0), (back, AXIS - high + 40, 0)]
    side_pl = bored(plate(side, "xz", half, half + 20), Y, ((x, 0, 0), PIN_HEAD / 2))
    _both(tree, "HEAD PL", side_pl, at, body)
    tree.add(Part("HEAD TIE", moved(box(x - 120, x + 40, -half, half, top - 90, top), at), YELLOW), body)
    nose = plate([(x + NOSE - 90, 420, 90), (x + 40, top - 10, 0), (x + 40, top - 90, 0)], "xz", 60, 80)
    _both(tree, "SINGLE TOP PL", nose, at, body)
    _pin(hardware, pose.head, PIN_HEAD, half + 25, body, "hoist_rope_pin")
    return tree


def block_drop() -> float:
    """From the pin of the head's sheaves down to that of the hook block's, as drawn."""
    return RAISED + HAUL + sum(BLOCK) / 2


def draw_hoist(pose: Pose) -> Assembly:
    """Rope with the head's sheaves, and the hook block on it; upright under the boom's head."""
    tree, drop = Assembly("HOIST"), block_drop()
    nx, nz = (float(c) for c in pose.head)
    sheaves = ring((0, -95, 0), Y, SHEAVE, PIN_HEAD / 2 + CLEARANCE, 190)
    falls = [rod((x, y, -drop), Z, ROPE, drop) for x, y in FALLS]
    bore = rod((0, -100, 0), Y, PIN_HEAD / 2 + CLEARANCE, 200)
    tree.add(Part("HOIST ROPE", cut(fuse(sheaves, *falls), bore), STEEL), "hoist_rope", at=shift(nx, 0, nz))
    at, body = shift(nx, 0, nz - drop), "hook_block"
    top, bottom = BLOCK
    guard = box(-172, 172, -92, 92, top - 85, top - 5)
    for x, y in FALLS:
        guard = cut(guard, rod((x, y, 0), Z, 12.0, 2 * top))
    tree.add(Part("ROPE GUARD", guard, YELLOW), body, at=at)
    cheek = plate([(-70, -170, 70), (70, -170, 70), (172, top, 0), (-172, top, 0)], "xz", 92, 117)
    for name, one in (("LH", cheek), ("RH", mirrored(cheek))):
        tree.add(Part(f"HOOK BLOCK CHEEK {name}", one, YELLOW), body, at=at)
    sheaves = rod((0, -92, 0), Y, SHEAVE - 2 * ROPE - 2, 184)
    tree.add(Part("BLOCK SHEAVES", sheaves, GREY), body, at=at)
    trunnion = box(-70, 70, -92, 92, -240, -150)
    tree.add(Part("HOOK TRUNNION", trunnion, GREY), body, at=at)
    bow = cut(ring((0, -40, bottom + 130), Y, 130, 65, 80), box(0, 200, -60, 60, bottom + 130, bottom + 300))
    hook = fuse(rod((0, 0, bottom + 210), Z, 45, -240 - bottom - 210), bow)
    tree.add(Part("HOOK", hook, GREY), body, at=at)
    return tree
