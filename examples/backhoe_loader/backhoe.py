"""Swing post, boom, dipper with its extension, bucket links and bucket: each drawn in its own frame (x outwards from
pin to pin, z up) and put where the linkage has it, behind the machine. Millimetres.

Lateral layout, from the middle: cylinder eyes within 34, their lugs 38-56; dipper 75, extension 79-89, its nose and the
bucket link 95; tipping links 96-112, bucket ears 96-116; boom 110, the post's plates 116-136.
"""

from __future__ import annotations

import math

from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.digger import Linkage, Pose
from drawing.hardware import CLEARANCE, fit_pin, placed
from drawing.planar import Point, direction
from drawing.product import GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, Z, bored, box, cut, mirrored, moved, outline, plate, ring, shift, turn

from . import values as v
from .chassis import PIN_POST, PIN_SWING
from .linkage import BOOM, SWING_X, SWING_Z, solve_swing

PIN, SMALL = 70.0, 55.0
"""Diameters of the pins: boom, dipper and their cylinders; the bucket, its cylinder and links."""
BOOM_Y, WEB = 110.0, 12.0
POST_Y = (116.0, 136.0)
BEAM, TUBE = (75.0, 100.0), (79.0, 104.0)
"""Half width and half height: of the dipper's beam outside, of the extension inside."""
WALL = 10.0
BEAM_END, TUBE_START, HUB = 1_640.0, 270.0, 92.0
"""Where the beam ends; where the extension begins when it is drawn in; radius of the dipper's hub."""
ROD_PIN = 370.0
"""The extension cylinder's rod pin, from the bucket's."""
BACKWARD = shift(SWING_X, 0, 0).Multiplied(turn(Z, 180.0))
"""The backhoe's plane in the machine's frame."""
Outline = list[tuple[float, float, float]]


def out(pin: Point, angle: float) -> gp_Trsf:
    """Where a part about a pin of the backhoe's plane goes, its x axis raised by an angle."""
    return BACKWARD.Multiplied(placed((float(pin[0]), 0.0, float(pin[1])), angle))


def _both(tree: Assembly, name: str, shape: TopoDS_Shape, at: gp_Trsf, body: str) -> None:
    for hand, one in (("RH", shape), ("LH", mirrored(shape))):
        tree.add(Part(f"{name} {hand}", moved(one, at), YELLOW), body)


def _pin(tree: Assembly, at: Point, size: float, half: float, body: str, role: str) -> None:
    fit_pin(tree, (SWING_X - float(at[0]), -half, float(at[1])), size, 2 * half, body, role)


# ---- swing post --------
def draw_post(k: Linkage, hardware: Assembly) -> Assembly:
    """Two lugs above and below the rear frame's, two plates that carry boom and boom cylinder, the swing's lugs."""
    tree, body, low, swing = Assembly("SWING POST"), "swing_post", v.KINGPOST_CLEARANCE.value, solve_swing()
    (ax, az), (cx, cz) = (float(c) for c in k.A), (float(c) for c in k.C)
    for name, z0, z1 in (("LWR", low, 598.0), ("UPR", 862.0, 905.0)):
        shape = plate([(0, 0, 60), (40, -116, 0), (88, -116, 0), (88, 116, 0), (40, 116, 0)], "xy", z0, z1)
        shape = bored(shape, Z, ((0, 0, 0), PIN_POST / 2 + CLEARANCE))
        tree.add(Part(f"POST LUG {name}", moved(shape, BACKWARD), YELLOW), body)
    side: Outline = [(42, low, 0), (110, low, 0), (cx, cz, 70), (ax, az, 72), (42, 940, 0)]
    web = bored(plate(side, "xz", *POST_Y), Y, ((ax, 0, az), PIN / 2), ((cx, 0, cz), PIN / 2))
    _both(tree, "POST SIDE PL", web, BACKWARD, body)
    _both(tree, "BOOM CYL BOSS", ring((cx, 40, cz), Y, 58, PIN / 2, POST_Y[0] - 40), BACKWARD, body)
    rx, ry = (float(c) for c in swing.rod(0.0))
    for name, z0, z1 in (("LWR", SWING_Z - 56, SWING_Z - 34), ("UPR", SWING_Z + 34, SWING_Z + 56)):
        ear = plate([(-rx, ry, 36), (45, POST_Y[1], 0), (120, POST_Y[1], 0)], "xy", z0, z1)
        _both(tree, f"SWING EAR {name}", bored(ear, Z, ((-rx, ry, 0), PIN_SWING / 2)), BACKWARD, body)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        at = (SWING_X + rx, sign * ry, SWING_Z - 60)
        fit_pin(hardware, at, PIN_SWING, 120, body, f"swing_piston_rod_{letter}_pin", upright=True)
    _pin(hardware, k.A, PIN, 140, body, "boom_pin")
    _pin(hardware, k.C, PIN, 140, body, "boom_cylinder_barrel_pin")
    return tree


# ---- boom --------
BOOM_OUTLINE: Outline = [(0, 0, 72), (1406, -627, -788), (BOOM, 0, 66), (1254, 148, 266)]
"""Foot, hollow underside, tip, crown."""


def draw_boom(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """The boom with its bosses and the lugs of both cylinders."""
    tree, at, body = Assembly("BOOM"), out(k.A, pose.boom_angle), "boom"
    (dx, dz), (mx, mz), inside = k.D, k.M, BOOM_Y - WEB
    web = bored(plate(BOOM_OUTLINE, "xz", inside, BOOM_Y), Y, ((0, 0, 0), 50.0), ((BOOM, 0, 0), PIN / 2))
    _both(tree, "BOOM WEB", web, at, body)
    band = cut(
        plate(BOOM_OUTLINE, "xz", -inside, inside),
        plate([(x, z, r - WEB) for x, z, r in BOOM_OUTLINE], "xz", -inside - 1, inside + 1),
        box(-400, 180, -400, 400, -400, 400), box(BOOM - 230, BOOM + 400, -400, 400, -400, 400),
    )  # fmt: skip
    middle = [(-400.0, 0.0), (0.0, 0.0), (1254.0, 280.0), (BOOM, 0.0), (BOOM + 400, 0.0)]
    above, below = [(BOOM + 400, 1800.0), (-400.0, 1800.0)], [(BOOM + 400, -1800.0), (-400.0, -1800.0)]
    for name, away in (("TOP", [*below[::-1], *middle[::-1]]), ("BOTTOM", [*middle, *above])):
        half = cut(band, plate([(x, z, 0.0) for x, z in away], "xz", -400, 400))
        tree.add(Part(f"BOOM {name} FLANGE", moved(half, at), YELLOW), body)
    # Two halves: the boom's cylinder is between them as it is out.
    hub = ring((0, 64, 0), Y, 70, PIN / 2 + CLEARANCE, BOOM_Y - 64)
    _both(tree, "BOOM FOOT BOSS", hub, at, body)
    _both(tree, "BOOM CYL LUG", _lug(dx, dz, 50, (dx + 110, dz + 260), (dx - 110, dz + 260)), at, body)
    _both(tree, "BOOM CYL BLOCK", box(dx - 70, dx + 70, 56, inside, dz + 190, dz + 250), at, body)
    _both(tree, "DIPPER CYL LUG", _lug(mx, mz, 50, (mx - 120, mz - 220), (mx + 80, mz - 220)), at, body)
    _both(tree, "DIPPER CYL BLOCK", box(mx - 80, mx + 50, 56, inside, mz - 210, mz - 150), at, body)
    for pin, half, role in (
        (pose.D, 60, "boom_piston_rod_pin"), (pose.M, 60, "dipper_cylinder_barrel_pin"), (pose.B, 116, "dipper_pin"),
    ):  # fmt: skip
        _pin(hardware, pin, PIN, half, body, role)
    return tree


def _lug(x: float, z: float, r: float, one: tuple[float, float], other: tuple[float, float]) -> TopoDS_Shape:
    """A cylinder's lug, on the one side."""
    corners: Outline = [(x, z, r), (*one, 0), (*other, 0)]
    return bored(plate(corners, "xz", 38, 56), Y, ((x, 0, z), PIN / 2))


# ---- dipper --------
def draw_dipper(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """A hollow beam, on it the hub and two plates up to the dipper cylinder's rod."""
    tree, at, body = Assembly("DIPPER"), out(pose.B, pose.arm_angle), "dipper"
    (px, pz), (half, high) = k.P, BEAM
    barrel = v.DIPPER_LENGTH.value - ROD_PIN - v.EXTENSION_CLOSED.value
    beam = box(HUB + 4, BEAM_END, -half, half, -high, high)
    beam = cut(beam, box(HUB + 3, BEAM_END + 1, -half + WALL, half - WALL, WALL - high, high - WALL))
    beam = bored(beam, Y, ((barrel, 0, 0), 20.0))
    tree.add(Part("DIPPER BEAM", moved(beam, at), YELLOW), body)
    hub = ring((0, -half, 0), Y, HUB, PIN / 2 + CLEARANCE, 2 * half)
    tree.add(Part("DIPPER HUB", moved(hub, at), YELLOW), body)
    tail = plate(
        [(px, pz, 58), (0, 0, HUB + 4), (TUBE_START - 30, -80, 0), (TUBE_START - 30, 80, 0)], "xz", half, half + 16
    )
    tail = bored(tail, Y, ((0, 0, 0), 50.0), ((px, 0, pz), PIN / 2))
    _both(tree, "DIPPER TAIL PL", tail, at, body)
    _both(tree, "ROD BOSS", ring((px, 38, pz), Y, 52, PIN / 2, half - 38), at, body)
    _pin(hardware, pose.P, PIN, 95, body, "dipper_piston_rod_pin")
    along = pose.B + barrel * (pose.K - pose.B) / k.arm
    _pin(hardware, along, 40.0, half - 1, body, "extension_cylinder_barrel_pin")
    return tree


def draw_extension(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """A box around the dipper's beam that ends in the nose; lugs of the bucket's cylinder."""
    tree, at, body = Assembly("DIPPER EXTENSION"), out(pose.B, pose.arm_angle), "dipper_extension"
    (ex, ez), (gx, gz), (half, high), far = k.E, k.G, TUBE, k.arm
    start = TUBE_START + far - v.DIPPER_LENGTH.value
    tube = cut(
        box(start, far - 62, -half - WALL, half + WALL, -high - WALL, high + WALL),
        box(start - 1, far - 150, -half, half, -high, high),
    )
    rod_at = far - ROD_PIN
    tube = bored(tube, Y, ((rod_at, 0, 0), 20.0), ((gx, 0, gz), 46.0))
    tree.add(Part("EXTENSION TUBE", moved(tube, at), YELLOW), body)
    nose = plate([(far - 300, -90, 0), (far, 0, 62), (far - 300, 90, 0)], "xz", half + WALL, 95)
    nose = bored(nose, Y, ((far, 0, 0), SMALL / 2), ((gx, 0, gz), 46.0))
    _both(tree, "NOSE PL", nose, at, body)
    for name, x, z, r, long in (("NOSE", far, 0.0, 62.0, half + WALL), ("TIPPING LINK", gx, gz, 46.0, 95.0)):
        boss = ring((x, -long, z), Y, r, SMALL / 2, 2 * long)
        tree.add(Part(f"{name} BOSS", moved(boss, at), YELLOW), body)
    lug = plate([(ex, ez, 44), (ex - 120, high + WALL, 0), (ex + 70, high + WALL, 0)], "xz", 36, 52)
    _both(tree, "BUCKET CYL LUG", bored(lug, Y, ((ex, 0, ez), SMALL / 2)), at, body)
    for pin, half_length, role in (
        (pose.E, 56, "extension_backhoe_bucket_cylinder_barrel_pin"), (pose.G, 116, "extension_tipping_link_pin"),
        (pose.K, 120, "extension_backhoe_bucket_pin"),
    ):  # fmt: skip
        _pin(hardware, pin, SMALL, half_length, body, role)
    there = pose.B + rod_at * (pose.K - pose.B) / k.arm
    _pin(hardware, there, 40.0, half + WALL + 3, body, "extension_piston_rod_pin")
    return tree


# ---- links and bucket --------
def draw_links(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """Two flat tipping links outside the nose; the bucket link inside them."""
    tree, hole = Assembly("BUCKET LINKAGE"), SMALL / 2 + CLEARANCE
    at = out(pose.G, direction(pose.H - pose.G))
    flat = bored(
        plate([(0, 0, 44), (k.tipping, 0, 44)], "xz", 96, 112), Y, ((0, 0, 0), hole), ((k.tipping, 0, 0), hole)
    )
    _both(tree, "TIPPING LINK", flat, at, "tipping_link")
    at, n = out(pose.H, direction(pose.J - pose.H)), k.link
    bar = bored(plate([(0, 0, 42), (n, 0, 56)], "xz", 40, 62), Y, ((0, 0, 0), hole), ((n, 0, 0), 44.0))
    _both(tree, "BUCKET LINK BAR", bar, at, "bucket_link")
    eye = ring((n, -92, 0), Y, 44, hole, 184)
    tree.add(Part("BUCKET LINK EYE", moved(eye, at), YELLOW), "bucket_link")
    _pin(hardware, pose.H, SMALL, 116, "backhoe_bucket_piston_rod", "backhoe_bucket_piston_rod_pin")
    return tree


SKIN, TOOTH, HEEL, BACK, FLOOR = 10.0, 90.0, 150.0, 100.0, math.radians(36.0)
"""Of the bucket: sheet, tooth, heel's and back's radius, angle between the line to the tooth points and the floor."""


def draw_bucket(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """Wrapper, sides, cutting edge, teeth, ears with the link's pin; x towards the tooth points, z to the back."""
    tree, at, body = Assembly("BACKHOE BUCKET"), out(pose.K, pose.bucket_angle), "backhoe_bucket"
    half = 300.0
    inner = half - SKIN

    def floor(s: float, up: float = 0.0) -> tuple[float, float]:
        """A point `s` back from the tooth points along the floor, `up` inside its underside."""
        return k.tip - s * math.cos(FLOOR) - up * math.sin(FLOOR), s * math.sin(FLOOR) - up * math.cos(FLOOR)

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW, role: str = "") -> None:
        tree.add(Part(name, moved(shape, at), colour), body, role)

    heel, back, top = floor(430.0, HEEL), (187.0, 280.0), (60.0, 67.0)
    outer: Outline = [(*floor(TOOTH + 100), 0), (*heel, HEEL), (*back, BACK), (*top, 0)]
    roof = outline(outer)[-2]
    (sx, sz), (ex, ez) = roof[-1], roof[0]
    (ax, az), (bx, bz) = ((sx + s * (ex - sx), sz + s * (ez - sz)) for s in (0.1, 0.9))
    far = math.hypot(bx - ax, bz - az)
    along = ((bx - ax) / far, (bz - az) / far)
    below = (top[0] - 130 * along[0] + SKIN * along[1], top[1] - 130 * along[1] - SKIN * along[0])
    cave: Outline = [(*floor(TOOTH - 200, SKIN), 0), (*heel, HEEL - SKIN), (*back, BACK - SKIN), (*below, 0)]
    put("HOE BUCKET WRAPPER", cut(plate(outer, "xz", -inner, inner), plate(cave, "xz", -inner - 1, inner + 1)))
    _both(tree, "HOE BUCKET SIDE", plate([(*floor(TOOTH + 14), 0), *outer[1:]], "xz", inner, half), at, body)
    lip = [floor(TOOTH), floor(TOOTH + 100), floor(TOOTH + 100, 20.0), floor(TOOTH, 20.0)]
    put("HOE BUCKET EDGE", plate([(x, z, 0.0) for x, z in lip], "xz", -inner, inner), GREY, "backhoe_cutting_edge")
    corners = [floor(0.0), floor(TOOTH), floor(TOOTH, 26.0), floor(0.0, 5.0)]
    tooth = Part("HOE BUCKET TOOTH", plate([(x, z, 0.0) for x, z in corners], "xz", -24, 24), STEEL)
    for i in range(5):
        tree.add(tooth, body, at=at.Multiplied(shift(0, (i - 2) * (2 * half - 70) / 4, 0)))
    jx, jz = k.J
    ear: Outline = [(0, 0, 50), (ax, az, 0), (bx, bz, 0), (jx, jz, 46)]
    shape = bored(plate(ear, "xz", 96, 116), Y, ((0, 0, 0), SMALL / 2 + CLEARANCE), ((jx, 0, jz), SMALL / 2))
    _both(tree, "HOE BUCKET EAR", shape, at, body)
    _pin(hardware, pose.J, SMALL, 120, body, "bucket_link_pin")
    return tree
