"""Boom, rocker, link and bucket. Each is drawn in its own frame (x along the part, z up, y left) and then put
where the linkage has it.

Lateral layout, millimetres from the middle: rocker and bucket link ears 75-115, link and eyes within 65,
rocker brackets of the boom 130-175, lift cylinders about 450, boom arms 560-640, their ears on frame and
bucket either side.
"""

from __future__ import annotations

import math

from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape
from scipy.optimize import brentq

from drawing.hardware import CLEARANCE, bush, fit_pin, placed
from drawing.loader import Pose
from drawing.product import GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, bored, box, cut, fuse, mirrored, moved, plate, prism, ring, rod, shift

from . import values as v
from .linkage import EDGE_DEPTH, FRONT_AXLE_X, TYRE_RADIUS, Linkage, direction

PIN_A, PIN_B, PIN_D, PIN_F, PIN_G, PIN_H, PIN_J = 100.0, 90.0, 80.0, 100.0, 120.0, 90.0, 90.0
NOSE = 98.0
TUBE = (1700.0, 50.0, 130.0)
"""Boom cross tube in the boom's frame: x, z, radius."""
WALL = 16.0
HEEL = 250.0
"""Bucket wrapper: thickness, and outer radius of the heel."""
SIDE = 16.0
"""Thickness of the bucket's side plates."""


def _both(tree: Assembly, name: str, shape: TopoDS_Shape, at: gp_Trsf, body: str, colour: Colour = YELLOW) -> None:
    """A part on the left and its mirror image on the right."""
    tree.add(Part(f"{name}_LH", moved(shape, at), colour), body)
    tree.add(Part(f"{name}_RH", moved(mirrored(shape), at), colour), body)


def draw_boom(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """Two arms, cross tube, rocker brackets, and the clevises of the lift cylinders."""
    at = placed((k.A[0], 0, k.A[1]), pose.boom_angle)
    tree = Assembly("LIFT ARM ASSY")
    (du, dw), (gu, gw) = k.D, k.G
    arm = plate(
        [(0, 0, 140), (du, dw, 100), (2500, -80, 100), (k.boom, 0, NOSE), (2250, 190, 110), (1500, 190, 140)],
        "xz",
        560,
        640,
    )
    arm = bored(
        arm,
        Y,
        ((0, 0, 0), 60.0),
        ((k.boom, 0, 0), 55.0),
        ((du, 0, dw), PIN_D / 2),
        ((TUBE[0], 0, TUBE[1]), TUBE[2]),
    )
    _both(tree, "BOOM", arm, at, "boom")
    pipe = ring((TUBE[0], -640, TUBE[1]), Y, TUBE[2], TUBE[2] - 25, 1280)
    tree.add(Part("CROSS TUBE 260x25", moved(pipe, at)), "boom")
    bracket = plate(
        [(TUBE[0], TUBE[1], TUBE[2] + 55), (gu, gw, 125), (TUBE[0] + 40, TUBE[1] + 250, 60)], "xz", 130, 175
    )
    bracket = bored(bracket, Y, ((gu, 0, gw), PIN_G / 2 + CLEARANCE), ((TUBE[0], 0, TUBE[1]), TUBE[2]))
    _both(tree, "BELLCRANK BRKT", bracket, at, "boom")
    cheek = plate([(du, dw, 95), (du + 190, dw + 10, 40), (du + 190, dw + 60, 40)], "xz", 350, 390)
    _both(tree, "LIFT CYL CHEEK", bored(cheek, Y, ((du, 0, dw), PIN_D / 2)), at, "boom")
    web = plate(
        [(du + 130, dw - 70, 0), (du + 165, dw - 70, 0), (du + 165, dw + 90, 0), (du + 130, dw + 90, 0)],
        "xz",
        390,
        560,
    )
    _both(tree, "WEB", web, at, "boom")
    collar = ring((du, 510, dw), Y, 90, PIN_D / 2, 50)
    _both(tree, "Ring", collar, at, "boom", GREY)
    hub = cut(rod((0, 530, 0), Y, 125, 30), rod((0, 500, 0), Y, 60, 200))
    _both(tree, "ARM HUB IN", hub, at, "boom")
    tip = cut(rod((k.boom, 540, 0), Y, 92, 20), rod((k.boom, 500, 0), Y, 55, 200))
    _both(tree, "NOSE BOSS IN", tip, at, "boom")
    tree.add(Part("Solid17", moved(box(1250, 2400, 552, 560, 60, 100), at), GREY), "boom")
    for side in (1.0, -1.0):
        a = at.Multiplied(shift(0, 530 if side > 0 else -640, 0))
        tree.add(bush(120, PIN_A, 110), "boom", at=a)
        b = at.Multiplied(shift(k.boom, 540 if side > 0 else -640, 0))
        tree.add(bush(110, PIN_B, 100), "boom", at=b)
        y = 350.0 if side > 0 else -640.0
        fit_pin(
            hardware,
            (pose.D[0], y, pose.D[1]),
            PIN_D,
            290,
            "boom",
            f"boom_piston_rod_{'l' if side > 0 else 'r'}_pin",
            keep=(side,),
            turned=-90.0 - math.degrees(pose.boom_angle),
        )
    return tree


def draw_rocker(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """Two plates with a hub and two spacers; its pivot pin turns with it, in the boom's brackets."""
    at = placed((pose.G[0], 0, pose.G[1]), pose.rocker_angle)
    tree = Assembly("BELLCRANK ASSY")
    f, (hx, hz) = k.rocker, k.H
    side = plate([(f, 0, 105), (hx, hz, 95), (0, -40, 150)], "xz", 75, 115)
    side = bored(side, Y, ((0, 0, 0), 110.0), ((f, 0, 0), PIN_F / 2 + CLEARANCE), ((hx, 0, hz), PIN_H / 2 + CLEARANCE))
    tree.add(Part("Bellcrank", moved(side, at)), "rocker")
    tree.add(Part("Bellcrank RH", moved(mirrored(side), at)), "rocker")
    tree.add(Part("BELLCRANK HUB", moved(ring((0, -120, 0), Y, 110, PIN_G / 2, 240), at), GREY), "rocker")
    for x, z in ((0.42 * f, 0.0), (0.45 * hx, 0.45 * hz)):
        tree.add(Part("隔套", moved(rod((x, -75, z), Y, 45, 150), at)), "rocker")
    # fast in the hub, loose in the boom's brackets; end discs hold it
    fit_pin(hardware, (pose.G[0], -180, pose.G[1]), PIN_G, 360, "rocker", "rocker_pin")
    for y in (180.0, -190.0):
        hardware.add(_end_disc(PIN_G), "rocker", at=shift(pose.G[0], y, pose.G[1]))
    fit_pin(hardware, (pose.F[0], -120, pose.F[1]), PIN_F, 240, "bucket_piston_rod", "bucket_piston_rod_pin")
    for y in (120.0, -130.0):
        hardware.add(_end_disc(PIN_F), "bucket_piston_rod", at=shift(pose.F[0], y, pose.F[1]))
    return tree


_DISCS: dict[float, Part] = {}


def _end_disc(diameter: float) -> Part:
    """Disc on the end of a pin that is fast in its inner member; drawn from the origin along +y."""
    if diameter not in _DISCS:
        _DISCS[diameter] = Part(f"PIN CAP {diameter:g}", rod((0, 0, 0), Y, diameter / 2 + 8, 10), STEEL)
    return _DISCS[diameter]


def draw_link(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """A bar with two eyes; the rocker's pin is fast in it, the bucket's turns in a bush."""
    at = placed((pose.H[0], 0, pose.H[1]), direction(pose.J - pose.H))
    tree = Assembly("LINK ASSY")
    bar = fuse(
        plate([(0, 0, 85), (k.link, 0, 85)], "xz", -40, 40),
        rod((0, -65, 0), Y, 88, 130),
        rod((k.link, -65, 0), Y, 88, 130),
    )
    bar = bored(bar, Y, ((0, 0, 0), PIN_H / 2), ((k.link, 0, 0), 55.0))
    tree.add(Part("Zuglasche", moved(bar, at)), "bucket_link")
    tree.add(bush(110, PIN_J, 130), "bucket_link", at=at.Multiplied(shift(k.link, -65, 0)))
    fit_pin(hardware, (pose.H[0], -120, pose.H[1]), PIN_H, 240, "bucket_link", "bucket_link_pin")
    for y in (120.0, -130.0):
        hardware.add(_end_disc(PIN_H), "bucket_link", at=shift(pose.H[0], y, pose.H[1]))
    return tree


# ---- bucket --------
def heel_x(k: Linkage, carry: Pose) -> float:
    """x at which the floor ends and the heel begins: the heel touches the line of the published carry
    position, which rises at the approach angle from the front tyre."""
    rise = math.radians(v.APPROACH_ANGLE_CARRY.value)
    n = (math.sin(rise), -math.cos(rise))
    foot = TYRE_RADIUS + (FRONT_AXLE_X - carry.B[0]) * n[0] + (TYRE_RADIUS - carry.B[1]) * n[1]
    phi = rise - carry.bucket_angle
    return (foot + math.cos(phi) * (-EDGE_DEPTH + HEEL) - HEEL) / math.sin(phi)


class BucketShape:
    """Side view of the bucket in its own frame (origin at the hinge pin, level)."""

    def __init__(self, heel: float) -> None:
        self.heel = heel
        self.back = heel - HEEL
        self.bend = 800.0
        self.arc = math.radians(v.RACK_BACK_MAX.value)
        """The top of the wrapper leans forward so that its edge is level in the highest position."""
        self.top = 150.0
        u = (math.sin(self.arc), math.cos(self.arc))
        cx = self.back + self.bend
        end = (cx - self.bend * math.cos(self.arc), self.top + self.bend * math.sin(self.arc))
        height = v.OPERATING_HEIGHT.value - v.HINGE_HEIGHT_MAX.value
        self.straight = height - (end[0] * u[0] + end[1] * u[1])
        self.end, self.u, self.centre = end, u, (cx, self.top)
        inside = (v.BUCKET_WIDTH.value - 2 * SIDE) * 1e-9
        self.lip_at = float(
            brentq(
                lambda s: self.struck_area(s) * inside - v.BUCKET_CAPACITY_STRUCK.value,
                0.0,
                self.straight,
                xtol=1e-9,
            )
        )
        """How far up the straight top the wrapper reaches, from the published struck capacity; the spill
        guard goes on."""

    def skin(self, inset: float, length: float, front: float) -> list[tuple[tuple[float, float], ...]]:
        """Floor, heel, back and top from the front of the floor to `length` up the straight top; inset from
        the outside."""
        r, b, c = HEEL - inset, self.bend - inset, math.cos
        z0, s = -EDGE_DEPTH + inset, math.sin
        hx, hz = self.heel, -EDGE_DEPTH + HEEL
        q = math.sqrt(0.5)
        cx, cz, arc = *self.centre, self.arc
        end = (cx - b * c(arc), cz + b * s(arc))
        tip = (end[0] + length * self.u[0], end[1] + length * self.u[1])
        return [
            ((front, z0), (hx, z0)),
            ((hx, z0), (hx - r * q, hz - r * q), (hx - r, hz)),
            ((hx - r, hz), (hx - r, cz)),
            ((hx - r, cz), (cx - b * c(arc / 2), cz + b * s(arc / 2)), end),
            (end, tip),
        ]

    def lip(self, length: float, inset: float) -> tuple[float, float]:
        """End of the skin."""
        return self.skin(inset, length, 0.0)[-1][-1]

    def sheet(self, inner: float, outer: float, length: float, front: float) -> list[tuple[tuple[float, float], ...]]:
        """Closed path between two insets."""
        out, back = self.skin(outer, length, front), self.skin(inner, length, front)
        turn = [tuple(reversed(seg)) for seg in reversed(back)]
        return [*out, (out[-1][-1], turn[0][0]), *turn, (turn[-1][-1], out[0][0])]

    def back_at(self, z: float) -> float:
        """x of the outside of the back at a height below the end of its bend."""
        (cx, cz), b = self.centre, self.bend
        return self.back if z <= cz else cx - math.sqrt(b * b - (z - cz) ** 2)

    def struck_area(self, lip: float) -> float:
        """Area of the inside below the line edge - lip, square millimetres."""
        pts: list[tuple[float, float]] = []
        for seg in self.skin(WALL, lip, 1541.0):
            pts += _sampled(seg)
        area = sum(p[0] * q[1] - q[0] * p[1] for p, q in zip(pts, pts[1:] + pts[:1], strict=True))
        return abs(area) / 2


def _sampled(seg: tuple[tuple[float, float], ...]) -> list[tuple[float, float]]:
    if len(seg) == 2:
        return list(seg)
    (ax, ay), (bx, by), (cx, cy) = seg
    d = 2 * (ax * (by - cy) + bx * (cy - ay) + cx * (ay - by))
    a, b, c = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
    ox, oy = (
        (a * (by - cy) + b * (cy - ay) + c * (ay - by)) / d,
        (a * (cx - bx) + b * (ax - cx) + c * (bx - ax)) / d,
    )
    r = math.hypot(ax - ox, ay - oy)
    start, end = math.atan2(ay - oy, ax - ox), math.atan2(cy - oy, cx - ox)
    sweep = (end - start + math.pi) % (2 * math.pi) - math.pi
    return [(ox + r * math.cos(start + sweep * i / 24), oy + r * math.sin(start + sweep * i / 24)) for i in range(25)]


def draw_bucket(k: Linkage, pose: Pose, heel: float, hardware: Assembly) -> Assembly:
    """Wrapper, sides, edge, teeth, spill guard and the ears of its pins."""
    at = placed((pose.B[0], 0, pose.B[1]), pose.bucket_angle)
    tree = Assembly("BUCKET ASSY 4.2M3")
    shape = BucketShape(heel)
    half = v.BUCKET_WIDTH.value / 2
    floor = -EDGE_DEPTH

    def put(name: str, body: TopoDS_Shape, colour: Colour = YELLOW) -> None:
        tree.add(Part(name, moved(body, at), colour), "bucket")

    put("WRAPPER", prism(shape.sheet(WALL, 0.0, shape.lip_at, 1180.0), "xz", -half + SIDE, half - SIDE))
    tip = shape.lip(shape.straight, 0.0)
    low, low_in = shape.lip(shape.lip_at, 0.0), shape.lip(shape.lip_at, 20.0)
    tip_in = shape.lip(shape.straight, 20.0)
    guard = [(tip_in, low_in), (low_in, low), (low, tip), (tip, tip_in)]
    put("SPILL GUARD", prism(guard, "xz", -half + 300, half - 300))
    edge = [
        (1150, floor, 0),
        (1430, floor, 0),
        (1430, floor + 18, 0),
        (1395, floor + 40, 0),
        (1150, floor + 40, 0),
    ]
    put("CUTTING EDGE", plate(edge, "xz", -half, half), GREY)
    outer = shape.skin(0.0, shape.lip_at, 1150.0)
    near = shape.lip(shape.lip_at, 0.0)
    rim = [*outer, (near, (1395.0, floor + 170)), ((1395.0, floor + 170), (1395.0, floor + 40))]
    rim += [((1395.0, floor + 40), (1150.0, floor + 40)), ((1150.0, floor + 40), (1150.0, floor))]
    wall = prism(rim, "xz", half - SIDE, half)
    _both(tree, "SIDE PL", wall, at, "bucket")
    lip_x, lip_z = near
    cutter = plate(
        [
            (1290, floor + 40, 0),
            (1425, floor + 40, 0),
            (1425, floor + 190, 0),
            (lip_x + 90, lip_z - 60, 0),
            (lip_x - 10, lip_z - 90, 0),
        ],
        "xz",
        half - SIDE - 25,
        half - SIDE,
    )
    _both(tree, "SIDE CUTTER", cutter, at, "bucket", GREY)
    end = k.T[0]
    tooth = [
        (1430, floor, 0),
        (end, floor, 0),
        (end, floor + 9, 0),
        (1400, floor + 95, 0),
        (1270, floor + 95, 0),
    ]
    tooth += [(1270, floor + 40, 0), (1430, floor + 40, 0)]
    tooth_part = Part("TOOTH", plate(tooth, "xz", -55, 55), GREY)
    for i in range(8):
        y = (i - 3.5) * (2 * half - 190) / 7
        tree.add(tooth_part, "bucket", at=at.Multiplied(shift(0, y, 0)))
    wear = Part("WEAR PL", box(heel + 60, 1100, -140, 140, floor + WALL, floor + WALL + 12), GREY)
    for y in (-1180, -590, 0, 590, 1180):
        tree.add(wear, "bucket", at=at.Multiplied(shift(0, y, 0)))
    back = shape.back + 5
    ear = [
        (0, 0, 100),
        (back + 26, -150, 0),
        (back, -20, 0),
        (back, 150, 0),
        (shape.back_at(330) + 5, 330, 0),
    ]
    for name, y in (("HINGE EAR IN", 490.0), ("HINGE EAR OUT", 670.0)):
        _both(tree, name, bored(plate(ear, "xz", y, y + 40), Y, ((0, 0, 0), PIN_B / 2)), at, "bucket")
    jx, jz = k.J
    ear = [(jx, jz, 92), *((shape.back_at(z) + 5, z, 0) for z in (80.0, 220.0, 340.0, 440.0))]
    _both(tree, "LINK EAR", bored(plate(ear, "xz", 75, 115), Y, ((jx, 0, jz), PIN_J / 2)), at, "bucket")
    rib = [
        (shape.back - 60, 60, 0),
        (shape.back + 5, 60, 0),
        (shape.back + 5, 200, 0),
        (shape.back - 60, 200, 0),
    ]
    put("TORSION BAR", plate(rib, "xz", 710, half - 200), YELLOW)
    put("TORSION BAR", plate(rib, "xz", -half + 200, -710), YELLOW)
    angle = -math.degrees(pose.bucket_angle)
    for side in (1.0, -1.0):
        fit_pin(
            hardware,
            (pose.B[0], 490 if side > 0 else -710, pose.B[1]),
            PIN_B,
            220,
            "bucket",
            "bucket_pin",
            keep=(side,),
            turned=angle - 90,
        )
    fit_pin(
        hardware,
        (pose.J[0], -115, pose.J[1]),
        PIN_J,
        230,
        "bucket",
        "bucket_link_bucket_pin",
        keep=(1.0, -1.0),
        turned=angle - 90,
    )
    return tree
