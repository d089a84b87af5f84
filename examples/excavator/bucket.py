"""Bucket, bucket link and tipping links, each drawn in its own frame and put where the linkage has it.

The bucket's frame: origin at the bucket pin, x towards the tooth points, z towards the back. Millimetres.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from OCP.TopoDS import TopoDS_Shape

from drawing.digger import Linkage, Pose
from drawing.hardware import CLEARANCE, bush, fit_pin, placed
from drawing.planar import direction
from drawing.product import GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, bored, box, cut, moved, outline, plate, ring, rod, shift

from . import values as v
from .equipment import PIN_G, PIN_H, PIN_J, PIN_K, between, pair

SKIN, SIDE, LIP = 20.0, 20.0, 40.0
"""Thickness of the wrapper, the sides and the cutting edge."""
TOOTH = 175.0
"""How far the teeth stand before the cutting edge."""
HEEL, BACK = 330.0, 270.0
"""Outer radii of the wrapper's heel and back."""
EAR = (166.0, 206.0)
"""Lateral place of the ears that take both pins."""


@dataclass(frozen=True, slots=True)
class Sizes:
    """What a bucket is drawn to: its width, its capacity (m3), the vertical wall depth that its floor's angle is for;
    `scale` of its side view."""

    width: float
    capacity: float
    wall_depth: float
    scale: float = 1.0


OWN = Sizes(v.BUCKET_WIDTH.value, v.BUCKET_CAPACITY.value, v.WALL_DEPTH.value)


def floor_angle(k: Linkage) -> float:
    """Angle between K -> T reversed and the floor's underside, radians: what the vertical wall depth takes."""
    return k.floor_angle(OWN.wall_depth)


@dataclass(frozen=True, slots=True)
class Profile:
    """Side view: the floor's direction from the tooth points backwards and its outward normal; the lip, the corner
    circles of heel and back, and the upper lip."""

    tip: float
    along: tuple[float, float]
    normal: tuple[float, float]
    heel: tuple[float, float]
    back: tuple[float, float]
    top: tuple[float, float]
    scale: float = 1.0

    def floor(self, s: float, up: float = 0.0) -> tuple[float, float]:
        """A point `s` back from the tooth points along the floor, `up` inside its underside."""
        return (
            self.tip + s * self.along[0] - up * self.normal[0],
            s * self.along[1] - up * self.normal[1],
        )

    def outside(self, lip: float) -> list[tuple[float, float, float]]:
        """Outline of the side, from `lip` back along the floor around to the upper lip."""
        heel, back = HEEL * self.scale, BACK * self.scale
        return [(*self.floor(lip), 0.0), (*self.heel, heel), (*self.back, back), (*self.top, 0.0)]

    def inside(self, lip: float) -> list[tuple[float, float, float]]:
        """The same less the wrapper, open at the mouth."""
        down = (self.top[0] - self.back[0], self.top[1] - self.back[1])
        n = math.hypot(*down)
        d = (down[0] / n, down[1] / n)
        lip_in = self.floor(lip - 200.0, SKIN)
        end = (self.top[0] + 60 * d[0] + 2.2 * SKIN * -d[1], self.top[1] + 60 * d[1] + 2.2 * SKIN * d[0])
        heel, back = HEEL * self.scale - SKIN, BACK * self.scale - SKIN
        return [(*lip_in, 0.0), (*self.heel, heel), (*self.back, back), (*end, 0.0)]

    def seat(self) -> list[tuple[float, float, float]]:
        """Corners inside the wrapper's thickness, from the upper lip up the back: where the ears stand."""
        segments = outline([(x, z, r - 7.0 if r else 0.0) for x, z, r in self.outside(TOOTH)])
        bend, lip = segments[-3], segments[-2]
        middle, end = bend[1], lip[0]
        low = between(end, lip[1], 0.93)
        return [(*low, 0.0), (*end, 0.0), (*middle, 0.0)]


def profile(k: Linkage, own: Sizes = OWN) -> Profile:
    """The bucket's side view for a linkage."""
    phi, s = k.floor_angle(own.wall_depth), own.scale
    along, normal = (-math.cos(phi), math.sin(phi)), (math.sin(phi), math.cos(phi))
    base = Profile(k.tip, along, normal, (0, 0), (0, 0), (0, 0))
    heel = base.floor(930.0 * s, HEEL * s)
    return Profile(k.tip, along, normal, heel, (345.0 * s, 520.0 * s), (118.0 * s, 118.0 * s), s)


def struck(k: Linkage) -> float:
    """Struck volume between the sides, m3: below the line from lip to upper lip."""
    p = profile(k)
    corners = [
        (*p.floor(TOOTH, SKIN), 0.0),
        (*p.heel, HEEL - SKIN),
        (*p.back, BACK - SKIN),
        (p.top[0] + SKIN, p.top[1], 0),
    ]
    points: list[tuple[float, float]] = []
    for seg in outline(corners):
        points += seg[:-1] if len(seg) == 3 else seg[:1]
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, points[1:] + points[:1], strict=True)) / 2
    return area * (v.BUCKET_WIDTH.value - 2 * SIDE) * 1e-9


def draw_bucket(k: Linkage, pose: Pose, hardware: Assembly, own: Sizes = OWN) -> Assembly:
    """Wrapper, sides, cutting edge, five teeth on adapters, side cutters, ears with the link's pin."""
    at = placed((pose.K[0], 0, pose.K[1]), pose.bucket_angle)
    tree = Assembly(f"BUCKET ASSY {own.capacity:g}M3")
    weld = Assembly("BUCKET WELDMENT")
    tree.add(weld)
    p = profile(k, own)
    half = own.width / 2
    inner = half - SIDE

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW, into: Assembly = weld) -> None:
        into.add(Part(name, moved(shape, at), colour), "bucket")

    shell = cut(
        plate(p.outside(TOOTH + 245), "xz", -inner, inner), plate(p.inside(TOOTH + 245), "xz", -inner - 1, inner + 1)
    )
    put("BUCKET WRAPPER", shell)
    side = plate(p.outside(TOOTH + 20), "xz", inner, half)
    pair(weld, "BUCKET SIDE PL", side, at, "bucket")
    edge = [(*p.floor(TOOTH), 0.0), (*p.floor(TOOTH + 250), 0.0), (*p.floor(TOOTH + 250, LIP), 0.0)]
    edge += [(*p.floor(TOOTH + 40, LIP), 0.0), (*p.floor(TOOTH, 16.0), 0.0)]
    weld.add(Part("CUTTING EDGE", moved(plate(edge, "xz", -half, half), at), GREY), "bucket", "cutting_edge")
    pair(tree, "SIDE CUTTER", _cutter(p, half), at, "bucket", GREY)
    tooth = _tooth(p)
    part = Part("BUCKET TOOTH", tooth, STEEL)
    adapter = Part("TOOTH ADAPTER", _adapter(p), GREY)
    for i in range(5):
        y = (i - 2) * (half - 62) / 2
        tree.add(adapter, "bucket", at=at.Multiplied(shift(0, y, 0)))
        tree.add(part, "bucket", at=at.Multiplied(shift(0, y, 0)))
    put("TORQUE TUBE", rod((175 * p.scale, -inner, 200 * p.scale), Y, 42, 2 * inner))
    jx, jz = k.J
    shape = plate([(0.0, 0.0, 98.0), *p.seat(), (jx, jz, 88.0)], "xz", *EAR)
    shape = bored(shape, Y, ((0, 0, 0), PIN_K / 2 + CLEARANCE), ((jx, 0, jz), PIN_J / 2))
    pair(weld, "BUCKET EAR", shape, at, "bucket")
    turned = -math.degrees(pose.bucket_angle)
    fit_pin(
        hardware,
        (pose.J[0], -220, pose.J[1]),
        PIN_J,
        440,
        "bucket",
        "bucket_link_pin",
        keep=(1.0, -1.0),
        turned=turned - 90,
    )
    return tree


def _cutter(p: Profile, half: float) -> TopoDS_Shape:
    """A side cutter: a plate outside the side's front edge."""
    a, b = p.floor(TOOTH - 25, 0.0), p.floor(TOOTH + 200, 0.0)
    c, d = p.floor(TOOTH + 330, 330.0), p.floor(TOOTH + 190, 360.0)
    corners = [(*a, 0.0), (*b, 0.0), (*c, 0.0), (*d, 0.0), (*p.floor(TOOTH - 25, 60.0), 0.0)]
    return plate(corners, "xz", half - 24, half - SIDE)


def _tooth(p: Profile) -> TopoDS_Shape:
    """A tooth point about y = 0, its underside in the floor's."""
    side = [(*p.floor(0.0), 0.0), (*p.floor(150.0), 0.0), (*p.floor(150.0, 72.0), 0.0), (*p.floor(0.0, 10.0), 0.0)]
    return plate(side, "xz", -38, 38)


def _adapter(p: Profile) -> TopoDS_Shape:
    """What a tooth sits on: welded around the cutting edge."""
    side = [
        (*p.floor(150.0), 0.0),
        (*p.floor(TOOTH), 0.0),
        (*p.floor(TOOTH, LIP), 0.0),
        (*p.floor(TOOTH + 170, LIP), 0.0),
    ]
    side += [(*p.floor(TOOTH + 170, LIP + 14), 0.0), (*p.floor(TOOTH, 78.0), 0.0), (*p.floor(150.0, 64.0), 0.0)]
    return plate(side, "xz", -34, 34)


# ---- links --------
def draw_bucket_link(k: Linkage, pose: Pose) -> Assembly:
    """H-shaped link: two bars with eyes for the rod's pin, one wide eye for the bucket's."""
    at = placed((pose.H[0], 0, pose.H[1]), direction(pose.J - pose.H))
    tree = Assembly("BUCKET LINK ASSY")
    n = k.link
    bar = plate([(0, 0, 68), (n, 0, 74)], "xz", 104, 140)
    bar = bored(bar, Y, ((0, 0, 0), PIN_H / 2 + CLEARANCE), ((n, 0, 0), 50.0))
    pair(tree, "BUCKET LINK BAR", bar, at, "bucket_link")
    eye = ring((0, 58, 0), Y, 66, PIN_H / 2 + CLEARANCE, 110)
    pair(tree, "LINK SPACER", eye, at, "bucket_link")
    tube = ring((n, -160, 0), Y, 78, 50, 320)
    tree.add(Part("BUCKET LINK EYE", moved(tube, at), YELLOW), "bucket_link")
    web = box(0.42 * n, 0.42 * n + 120, -104, 104, -22, 22)
    tree.add(Part("BUCKET LINK WEB", moved(web, at), YELLOW), "bucket_link")
    for y in (-160.0, 60.0):
        tree.add(bush(100, PIN_J, 100), "bucket_link", at=at.Multiplied(shift(n, y, 0)))
    return tree


def draw_tipping_links(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """Two flat links either side of the arm; the rod's pin joins them to the rod and the bucket link."""
    at = placed((pose.G[0], 0, pose.G[1]), direction(pose.H - pose.G))
    tree = Assembly("TIPPING LINK ASSY")
    flat = plate([(0, 0, 70), (k.tipping, 0, 68)], "xz", 172, 197)
    flat = bored(flat, Y, ((0, 0, 0), PIN_G / 2 + CLEARANCE), ((k.tipping, 0, 0), PIN_H / 2 + CLEARANCE))
    pair(tree, "TIPPING LINK", flat, at, "tipping_link")
    body = "bucket_piston_rod"
    fit_pin(hardware, (pose.H[0], -212, pose.H[1]), PIN_H, 424, body, "bucket_piston_rod_pin")
    disc = Part(f"PIN CAP {PIN_H:g}", rod((0, 0, 0), Y, PIN_H / 2 + 10, 10), GREY)
    for y in (212.0, -222.0):
        hardware.add(disc, body, at=shift(pose.H[0], y, pose.H[1]))
    return tree
