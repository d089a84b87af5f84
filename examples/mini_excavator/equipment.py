"""Boom, arm, bucket links and bucket, each drawn in its own frame (x from pin to pin, z up, y left) and put where the
linkage has it.

Lateral layout, millimetres from the middle: cylinder eyes within 22, their lugs to 34; arm 40, its nose and the bucket
link 42; tipping links 44-52, bucket ears 44-56; boom 50, the bracket's plates 52-66.
"""

from __future__ import annotations

import math

from OCP.TopoDS import TopoDS_Shape

from drawing.digger import Linkage, Pose
from drawing.hardware import CLEARANCE, bush, fit_pin, placed
from drawing.planar import direction
from drawing.product import BLACK, GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, bored, box, cut, moved, plate, ring, shift
from excavator.equipment import pair, skin

from . import values as v
from .linkage import ARM, BOOM

PIN, SMALL = 30.0, 25.0
"""Diameters of the pins: boom, arm, bucket and their cylinders; the bucket's links."""
BOOM_Y, ARM_Y, WEB = 50.0, 40.0, 8.0
Outline = list[tuple[float, float, float]]


def _blank(points: list[tuple[float, float]]) -> TopoDS_Shape:
    return plate([(x, z, 0.0) for x, z in points], "xz", -400.0, 400.0)


def _frame(x0: float, x1: float) -> TopoDS_Shape:
    """What lies between two places along a part."""
    return box(x0, x1, -400, 400, -900, 900)


# ---- boom --------
BOOM_OUTLINE: Outline = [(0, 0, 42), (740, -330, -415), (BOOM, 0, 34), (660, 78, 140)]
"""Foot, hollow underside, tip, crown."""


def draw_boom(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """The boom with its bosses and the lugs of both cylinders."""
    at, body = placed((k.A[0], 0, k.A[1]), pose.boom_angle), "boom"
    tree = Assembly("BOOM ASSY")
    (dx, dz), (mx, mz) = k.D, k.M
    inside = BOOM_Y - WEB

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW) -> None:
        tree.add(Part(name, moved(shape, at), colour), body)

    web = plate(BOOM_OUTLINE, "xz", inside, BOOM_Y)
    web = bored(web, Y, ((0, 0, 0), 22.0), ((BOOM, 0, 0), PIN / 2))
    pair(tree, "BOOM WEB", web, at, body)
    middle = [(-200.0, 0.0), (0.0, 0.0), (660.0, 150.0), (BOOM, 0.0), (BOOM + 200, 0.0)]
    above, below = [(BOOM + 200, 900.0), (-200.0, 900.0)], [(BOOM + 200, -900.0), (-200.0, -900.0)]
    for name, away in (("TOP", [*below[::-1], *middle[::-1]]), ("BOTTOM", [*middle, *above])):
        ends = (_frame(-400, 48), _frame(BOOM - 150, BOOM + 400))
        put(f"BOOM {name} FLANGE", skin(BOOM_OUTLINE, inside, WEB, *ends, _blank(away)))
    put("BOOM FOOT BOSS", ring((0, -BOOM_Y, 0), Y, 38, 22, 2 * BOOM_Y))
    pair(tree, "BOOM TIP BOSS", ring((BOOM, BOOM_Y, 0), Y, 32, PIN / 2, 8), at, body)
    lug = plate([(dx, dz, 26), (dx + 45, dz + 50, 0), (dx - 45, dz + 50, 0)], "xz", 24, 34)
    pair(tree, "BOOM CYL LUG", bored(lug, Y, ((dx, 0, dz), PIN / 2)), at, body)
    lug = plate([(mx, mz, 26), (mx - 60, mz - 66, 0), (mx + 40, mz - 66, 0)], "xz", 24, 34)
    pair(tree, "ARM CYL LUG", bored(lug, Y, ((mx, 0, mz), PIN / 2)), at, body)
    for y in (-BOOM_Y, BOOM_Y - 34):
        tree.add(bush(44, PIN, 34), body, at=at.Multiplied(shift(0, y, 0)))
    put("BOOM LAMP", box(900, 940, BOOM_Y, BOOM_Y + 34, 130, 170), BLACK)
    fit_pin(hardware, (pose.D[0], -36, pose.D[1]), PIN, 72, body, "boom_piston_rod_pin")
    fit_pin(hardware, (pose.B[0], -60, pose.B[1]), PIN, 120, body, "arm_pin")
    fit_pin(hardware, (pose.M[0], -36, pose.M[1]), PIN, 72, body, "arm_cylinder_barrel_pin")
    return tree


# ---- arm --------
def draw_arm(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """The arm with its bosses and the bucket cylinder's lugs."""
    at, body = placed((pose.B[0], 0, pose.B[1]), pose.arm_angle), "arm"
    tree = Assembly("ARM ASSY")
    (px, pz), (ex, ez), (gx, gz) = k.P, k.E, k.G
    inside = ARM_Y - WEB
    side: Outline = [(px, pz, 32), (0, 0, 50), (ARM, 0, 30), (100, 64, 50)]

    def put(name: str, shape: TopoDS_Shape) -> None:
        tree.add(Part(name, moved(shape, at), YELLOW), body)

    web = plate(side, "xz", inside, ARM_Y)
    web = bored(web, Y, ((px, 0, pz), 15.0), ((0, 0, 0), 22.0), ((gx, 0, gz), SMALL / 2), ((ARM, 0, 0), PIN / 2))
    pair(tree, "ARM WEB", web, at, body)
    ends = (_frame(px - 90, 42), _frame(ARM - 34, ARM + 90))
    middle = [(px - 100, 12.0), (60.0, 12.0), (ARM + 100, 0.0)]
    above, below = [(ARM + 100, 500.0), (px - 100, 500.0)], [(ARM + 100, -500.0), (px - 100, -500.0)]
    for name, away in (("TOP", [*below[::-1], *middle[::-1]]), ("BOTTOM", [*middle, *above])):
        put(f"ARM {name} FLANGE", skin(side, inside, WEB, *ends, _blank(away)))
    put("ARM HINGE BOSS", ring((0, -ARM_Y, 0), Y, 42, 22, 2 * ARM_Y))
    pair(tree, "ARM TAIL BOSS", ring((px, 23, pz), Y, 30, PIN / 2, 9), at, body)
    put("TIPPING LINK BOSS", ring((gx, -42, gz), Y, 20, SMALL / 2, 84))
    put("ARM NOSE BOSS", ring((ARM, -42, 0), Y, 28, PIN / 2, 84))
    lug = plate([(ex, ez, 24), (ex - 70, ez - 34, 0), (ex + 40, ez - 40, 0)], "xz", 22, 32)
    pair(tree, "BUCKET CYL LUG", bored(lug, Y, ((ex, 0, ez), SMALL / 2)), at, body)
    for y in (-ARM_Y, ARM_Y - 30):
        tree.add(bush(44, PIN, 30), body, at=at.Multiplied(shift(0, y, 0)))
    fit_pin(hardware, (pose.P[0], -44, pose.P[1]), PIN, 88, body, "arm_piston_rod_pin")
    fit_pin(hardware, (pose.E[0], -34, pose.E[1]), SMALL, 68, body, "bucket_cylinder_barrel_pin")
    fit_pin(hardware, (pose.G[0], -58, pose.G[1]), SMALL, 116, body, "tipping_link_pin")
    fit_pin(hardware, (pose.K[0], -62, pose.K[1]), PIN, 124, body, "bucket_pin")
    return tree


# ---- links --------
def draw_links(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """Two flat tipping links outside the arm; the bucket link inside them, its wide eye between the bucket's ears."""
    tree = Assembly("BUCKET LINKAGE")
    at = placed((pose.G[0], 0, pose.G[1]), direction(pose.H - pose.G))
    flat = plate([(0, 0, 22), (k.tipping, 0, 22)], "xz", 44, 52)
    flat = bored(flat, Y, ((0, 0, 0), SMALL / 2 + CLEARANCE), ((k.tipping, 0, 0), SMALL / 2 + CLEARANCE))
    pair(tree, "TIPPING LINK", flat, at, "tipping_link")
    at, n = placed((pose.H[0], 0, pose.H[1]), direction(pose.J - pose.H)), k.link
    bar = plate([(0, 0, 21), (n, 0, 23)], "xz", 22, 32)
    bar = bored(bar, Y, ((0, 0, 0), SMALL / 2 + CLEARANCE), ((n, 0, 0), 16.0))
    pair(tree, "BUCKET LINK BAR", bar, at, "bucket_link")
    eye = ring((n, -42, 0), Y, 23, 16, 84)
    tree.add(Part("BUCKET LINK EYE", moved(eye, at), YELLOW), "bucket_link")
    tree.add(Part("BUCKET LINK WEB", moved(box(0.45 * n, 0.45 * n + 34, -22, 22, -7, 7), at), YELLOW), "bucket_link")
    for y in (-42.0, 12.0):
        tree.add(bush(32, SMALL, 30), "bucket_link", at=at.Multiplied(shift(n, y, 0)))
    fit_pin(hardware, (pose.H[0], -58, pose.H[1]), SMALL, 116, "bucket_piston_rod", "bucket_piston_rod_pin")
    return tree


# ---- bucket --------
SKIN, TOOTH, HEEL, BACK = 6.0, 52.0, 100.0, 82.0


def floor_angle(k: Linkage) -> float:
    """Angle between K -> T reversed and the floor's underside, radians: what the vertical wall depth takes."""
    return k.floor_angle(v.WALL_DEPTH.value)


def draw_bucket(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """Wrapper, sides, cutting edge, four teeth, ears with the link's pin; x towards the tooth points, z to the back."""
    at, body = placed((pose.K[0], 0, pose.K[1]), pose.bucket_angle), "bucket"
    tree = Assembly("BUCKET ASSY 300")
    phi, half = floor_angle(k), v.BUCKET_WIDTH.value / 2
    inner = half - SKIN

    def floor(s: float, up: float = 0.0) -> tuple[float, float]:
        """A point `s` back from the tooth points along the floor, `up` inside its underside."""
        return k.tip - s * math.cos(phi) - up * math.sin(phi), s * math.sin(phi) - up * math.cos(phi)

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW, role: str = "") -> None:
        tree.add(Part(name, moved(shape, at), colour), body, role)

    heel, back, top = floor(300.0, HEEL), (112.0, 168.0), (36.0, 40.0)
    outer: Outline = [(*floor(TOOTH + 60), 0), (*heel, HEEL), (*back, BACK), (*top, 0)]
    cave: Outline = [(*floor(TOOTH, SKIN), 0), (*heel, HEEL - SKIN), (*back, BACK - SKIN), (top[0] + 14, top[1] - 8, 0)]
    put("BUCKET WRAPPER", cut(plate(outer, "xz", -inner, inner), plate(cave, "xz", -inner - 1, inner + 1)))
    side: Outline = [(*floor(TOOTH + 8), 0), *outer[1:]]
    pair(tree, "BUCKET SIDE PL", plate(side, "xz", inner, half), at, body)
    lip = [floor(TOOTH), floor(TOOTH + 60), floor(TOOTH + 60, 12.0), floor(TOOTH, 12.0)]
    put("CUTTING EDGE", plate([(x, z, 0.0) for x, z in lip], "xz", -half, half), GREY, "cutting_edge")
    corners = [floor(0.0), floor(TOOTH), floor(TOOTH, 16.0), floor(0.0, 3.0)]
    tooth = Part("BUCKET TOOTH", plate([(x, z, 0.0) for x, z in corners], "xz", -14, 14), STEEL)
    for i in range(4):
        tree.add(tooth, body, at=at.Multiplied(shift(0, (i - 1.5) * (2 * half - 40) / 3, 0)))
    jx, jz = k.J
    ear: Outline = [(0, 0, 28), (top[0] + 10, top[1] + 26, 0), (back[0] - 60, back[1] + 30, 0), (jx, jz, 26)]
    ear_plate = bored(plate(ear, "xz", 44, 56), Y, ((0, 0, 0), PIN / 2 + CLEARANCE), ((jx, 0, jz), SMALL / 2))
    pair(tree, "BUCKET EAR", ear_plate, at, body)
    fit_pin(hardware, (pose.J[0], -62, pose.J[1]), SMALL, 124, body, "bucket_link_pin")
    return tree
