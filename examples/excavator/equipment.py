"""Boom and arm: plate boxes with their bosses, lugs and pins. Each is drawn in its own frame (x from pin to pin, z up,
y left) and put where the linkage has it.

Lateral layout, millimetres from the middle: arm and bucket cylinder eyes within 65, their lugs to 110; arm 156, its
nose and the bucket link 160; tipping links 172-197 and bucket ears 166-206; boom 216, its tip 236; boom cylinders 352.
"""

from __future__ import annotations

import math

from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.digger import Linkage, Pose
from drawing.hardware import bush, fit_pin, placed
from drawing.product import BLACK, GREY, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, bored, box, cut, mirrored, moved, outline, pipe, plate, ring, rod, shift, turn

from .linkage import BOOM

PIN_A = PIN_B = 100.0
PIN_C = PIN_D = PIN_K = PIN_M = PIN_P = 90.0
PIN_E = PIN_G = PIN_H = PIN_J = 80.0
"""Diameters of the pins, by the linkage's letters."""
BOOM_Y, ARM_Y = 216.0, 156.0
"""Half widths outside."""
CYLINDER_Y = 352.0
"""Boom cylinders from the middle."""
WEB = 16.0
Outline = list[tuple[float, float, float]]


def pair(tree: Assembly, name: str, shape: TopoDS_Shape, at: gp_Trsf, body: str, colour: Colour = YELLOW) -> None:
    """A part on the left and its mirror image on the right."""
    tree.add(Part(f"{name} LH", moved(shape, at), colour), body)
    tree.add(Part(f"{name} RH", moved(mirrored(shape), at), colour), body)


def smaller(outline: Outline, by: float) -> Outline:
    """The outline moved inwards; round corners only."""
    return [(x, z, r - by) for x, z, r in outline]


def skin(outline: Outline, half: float, thick: float, *cuts: TopoDS_Shape) -> TopoDS_Shape:
    """The flange plates of a box: a band inside the outline, between the webs, less the cuts."""
    band = cut(plate(outline, "xz", -half, half), plate(smaller(outline, thick), "xz", -half - 1, half + 1))
    return cut(band, *cuts)


def _polygon(points: list[tuple[float, float]], half: float) -> TopoDS_Shape:
    return plate([(x, z, 0.0) for x, z in points], "xz", -half, half)


def between(p: tuple[float, float], q: tuple[float, float], share: float) -> tuple[float, float]:
    """A point on the way from `p` to `q`."""
    return p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])


def crossing(
    p: tuple[float, float], q: tuple[float, float], r: tuple[float, float], s: tuple[float, float]
) -> tuple[float, float]:
    """Where the lines p-q and r-s cross."""
    u, w = (q[0] - p[0], q[1] - p[1]), (s[0] - r[0], s[1] - r[1])
    share = ((r[0] - p[0]) * w[1] - (r[1] - p[1]) * w[0]) / (u[0] * w[1] - u[1] * w[0])
    return between(p, q, share)


# ---- boom --------


def _boom_outline(boom: float, s: float) -> Outline:
    """Foot, hollow underside, tip, crown of a boom of a length, `s` times that of the excavator."""
    return [(0, 0, 140), (2780 * s, -1300 * s, -1640 * s), (boom, 0, 118), (2540 * s, 300 * s, 560 * s)]


def draw_boom(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """The boom with its bosses, the arm cylinder's lugs, pipes and a lamp."""
    at = placed((k.A[0], 0, k.A[1]), pose.boom_angle)
    turned = -math.degrees(pose.boom_angle)
    boom, s = k.boom, k.boom / BOOM
    side, slot = _boom_outline(boom, s), boom - 480.0  # from there on the tip is a fork
    tree = Assembly("BOOM ASSY")
    (dx, dz), (mx, mz) = k.D, k.M
    body = "boom"
    weld = Assembly("BOOM WELDMENT")
    tree.add(weld)
    holes = (((0.0, 0.0, 0.0), 60.0), ((dx, 0.0, dz), 60.0), ((boom, 0.0, 0.0), PIN_B / 2))
    web = bored(plate(side, "xz", BOOM_Y - WEB, BOOM_Y), Y, *holes)
    pair(weld, "BOOM WEB", web, at, body)
    inside = BOOM_Y - WEB
    ends = (_polygon([(-400, -400), (125, -400), (125, 400), (-400, 400)], 400.0),
            _polygon([(slot, -600), (boom + 500, -600), (boom + 500, 600), (slot, 600)], 400.0))  # fmt: skip
    lower = [(-500, -900), (6300, -900), (6300, 0), (boom, 0), (2600 * s, 600 * s), (0, 0), (-500, 0)]
    upper = [(-500, 0), (0, 0), (2600 * s, 600 * s), (boom, 0), (6300, 0), (6300, 1600), (-500, 1600)]
    for name, away in (("BOOM TOP FLANGE", lower), ("BOOM BOTTOM FLANGE", upper)):
        flange = skin(side, inside, WEB, *ends, _polygon([(float(a), float(b)) for a, b in away], 400.0))
        weld.add(Part(name, moved(flange, at), YELLOW), body)
    middle = plate(smaller(side, WEB), "xz", -inside, inside)
    for x in (1250.0 * s, 3500.0 * s, slot - 14.0):
        keep = cut(middle, box(-900, x, -400, 400, -2000, 2000), box(x + 14, 7000, -400, 400, -2000, 2000))
        weld.add(Part("BOOM DIAPHRAGM", moved(keep, at), YELLOW), body)
    foot = ring((0, -222, 0), Y, 125, 60, 444)
    weld.add(Part("BOOM FOOT BOSS", moved(foot, at), YELLOW), body)
    pair(weld, "BOOM CYL BOSS", ring((dx, 60, dz), Y, 105, PIN_D / 2, 232), at, body)
    pair(weld, "BOOM TIP BOSS", ring((boom, 166, 0), Y, 112, PIN_B / 2, 70), at, body)
    lug = plate([(mx, mz, 100), (mx - 330, mz - 200, 0), (mx + 98, mz - 190, 0)], "xz", 68, 108)
    pair(weld, "ARM CYL LUG", bored(lug, Y, ((mx, 0, mz), PIN_M / 2)), at, body)
    for y in (-222.0, 112.0):
        tree.add(bush(120, PIN_A, 110), body, at=at.Multiplied(shift(0, y, 0)))
    # steel pipes along the crown, and the clamps that hold them
    above = outline(smaller(side, -38.0))
    (tip, bend_out), (bend_in, foot_end) = above[5], above[7]
    crown = crossing(tip, bend_out, bend_in, foot_end)
    first, last = between(crown, foot_end, 0.62), between(crown, tip, 0.72)
    for y in (-172.0, 126.0, 172.0):
        run = pipe([(first[0], y, first[1]), (crown[0], y, crown[1]), (last[0], y, last[1])], 14, 600)
        tree.add(Part("BOOM PIPE", moved(run, at), BLACK), body)
    clamp = Part("PIPE CLAMP", box(-30, 30, -34, 34, -45, 26), GREY)
    for end, shares in ((foot_end, (0.35, 0.55)), (tip, (0.3, 0.62))):
        for share in shares:
            x, z = between(crown, end, share)
            slope = turn(Y, -math.degrees(math.atan((end[1] - crown[1]) / (end[0] - crown[0]))))
            for y in (-160.0, 152.0):
                tree.add(clamp, body, at=at.Multiplied(shift(x, y, z)).Multiplied(slope))
    x, z = 1500 * s, 520 * s
    lamp = cut(box(x, x + 140, 216, 330, z, z + 140), box(x + 100, x + 141, 230, 316, z + 15, z + 125))
    tree.add(Part("BOOM LAMP", moved(lamp, at), BLACK), body)
    lens = box(x + 100, x + 130, 230, 316, z + 15, z + 125)
    tree.add(Part("BOOM LAMP LENS", moved(lens, at), (0.93, 0.93, 0.85)), body)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        y = 60.0 if sign > 0 else -420.0
        fit_pin(hardware, (pose.D[0], y, pose.D[1]), PIN_D, 360, body, f"boom_piston_rod_{letter}_pin")
        cap = ring((0, 0, 0), Y, PIN_D / 2 + 20, 9.0, 14)
        there = shift(pose.D[0], sign * 420 - (14 if sign < 0 else 0), pose.D[1])
        hardware.add(Part("PIN CAP 90", cap, GREY), body, at=there)
    fit_pin(hardware, (pose.B[0], -250, pose.B[1]), PIN_B, 500, body, "arm_pin", keep=(1.0, -1.0), turned=turned + 90)
    fit_pin(
        hardware,
        (pose.M[0], -118, pose.M[1]),
        PIN_M,
        236,
        body,
        "arm_cylinder_barrel_pin",
        keep=(1.0, -1.0),
        turned=turned,
    )
    return tree


# ---- arm --------
def arm_outline(k: Linkage) -> Outline:
    """Tail, underside of the hinge, nose, top under the bucket cylinder."""
    return [(k.P[0], k.P[1], 105), (0, 0, 168), (k.arm, 0, 98), (300, 235, 180)]


def draw_arm(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """The arm with its bosses and the bucket cylinder's lugs."""
    at = placed((pose.B[0], 0, pose.B[1]), pose.arm_angle)
    turned = -math.degrees(pose.arm_angle)
    tree = Assembly("ARM ASSY")
    weld = Assembly("ARM WELDMENT")
    tree.add(weld)
    body = "arm"
    (px, pz), (ex, ez), (gx, gz) = k.P, k.E, k.G
    side, arm = arm_outline(k), k.arm
    holes = (((px, 0.0, pz), 60.0), ((0.0, 0.0, 0.0), 60.0), ((gx, 0.0, gz), 50.0), ((arm, 0.0, 0.0), 55.0))
    web = bored(plate(side, "xz", ARM_Y - WEB, ARM_Y), Y, *holes)
    pair(weld, "ARM WEB", web, at, body)
    inside = ARM_Y - WEB
    tail = _polygon(
        [(px - 400, -900), (-120, -900), (-120, 0), (px + 190, pz - 40), (px + 190, pz + 400), (px - 400, pz + 400)],
        400,
    )
    nose = _polygon([(arm - 110, -400), (arm + 400, -400), (arm + 400, 400), (arm - 110, 400)], 400.0)
    hinge = rod((0, -400, 0), Y, 138, 800)
    below = [(px - 400, -900.0), (arm + 400, -900.0), (arm + 400, 0.0), (400.0, 60.0), (px, pz), (px - 400, pz)]
    above = [(px - 400, pz), (px, pz), (400.0, 60.0), (arm + 400, 0.0), (arm + 400, 900.0), (px - 400, 900.0)]
    for name, away in (("ARM TOP FLANGE", below), ("ARM BOTTOM FLANGE", above)):
        flange = skin(side, inside, 14.0, tail, nose, hinge, _polygon(away, 400.0))
        weld.add(Part(name, moved(flange, at), YELLOW), body)
    for x, z, r, bore, half, name in (
        (0.0, 0.0, 140.0, 60.0, 160.0, "ARM HINGE BOSS"),
        (gx, gz, 72.0, PIN_G / 2, 168.0, "TIPPING LINK BOSS"),
        (arm, 0.0, 96.0, PIN_K / 2, 160.0, "ARM NOSE BOSS"),
    ):
        weld.add(Part(name, moved(ring((x, -half, z), Y, r, bore, 2 * half), at), YELLOW), body)
    pair(weld, "ARM TAIL BOSS", ring((px, 72, pz), Y, 98, PIN_P / 2, 98), at, body)
    lug = plate([(ex, ez, 88), (ex - 260, ez - 250, 0), (ex + 86, ez - 220, 0)], "xz", 62, 97)
    pair(weld, "BUCKET CYL LUG", bored(lug, Y, ((ex, 0, ez), PIN_E / 2)), at, body)
    stop = plate([(-330, 150, 0), (-120, 150, 0), (-120, 164, 0), (-330, 164, 0)], "xz", -inside, inside)
    weld.add(Part("ARM DIAPHRAGM", moved(stop, at), YELLOW), body)
    for y in (-160.0, 50.0):
        tree.add(bush(120, PIN_B, 110), body, at=at.Multiplied(shift(0, y, 0)))
    fit_pin(
        hardware,
        (pose.P[0], -172, pose.P[1]),
        PIN_P,
        344,
        body,
        "arm_piston_rod_pin",
        keep=(1.0, -1.0),
        turned=turned - 90,
    )
    fit_pin(
        hardware,
        (pose.E[0], -107, pose.E[1]),
        PIN_E,
        214,
        body,
        "bucket_cylinder_barrel_pin",
        keep=(1.0, -1.0),
        turned=turned,
    )
    fit_pin(hardware, (pose.G[0], -222, pose.G[1]), PIN_G, 444, body, "tipping_link_pin")
    fit_pin(hardware, (pose.K[0], -226, pose.K[1]), PIN_K, 452, body, "bucket_pin")
    for at_pin, length, size in ((pose.G, 444.0, PIN_G), (pose.K, 452.0, PIN_K)):
        disc = Part(f"PIN CAP {size:g}", rod((0, 0, 0), Y, size / 2 + 10, 10), GREY)
        for y in (length / 2, -length / 2 - 10):
            hardware.add(disc, body, at=shift(at_pin[0], y, at_pin[1]))
    return tree
