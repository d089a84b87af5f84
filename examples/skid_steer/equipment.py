"""Lift arms, their links, and the bucket with its carrier. Arms are drawn as they stand lowered and then carried; links
and bucket in frames of their own. Machine frame, millimetres.

Lateral layout, from the middle: chassis plates 480-500, lift cylinders about 550, tilt cylinders about 560, links
600-630, the carrier's ears 605-636, arms 640-700.
"""

from __future__ import annotations

import numpy as np
from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import CLEARANCE, bush, fit_pin, placed
from drawing.planar import Point, direction, rot
from drawing.product import GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, bored, box, cut, fuse, mirrored, moved, plate, ring, shift
from excavator.equipment import pair, smaller

from . import values as v
from .linkage import DEPTH, FOOT, Linkage

ARM_Y, ARM_END = 640.0, 700.0
LIFT_Y, TILT_Y = 550.0, 560.0
"""Where the cylinders lie."""
PIN, TILT_PIN, LINK_PIN = 45.0, 35.0, 50.0
"""Diameters: bucket and lift cylinders, tilt cylinders, links and arms."""
LINK_Y = (600.0, 630.0)
WALL, BUSH = 10.0, 72.0
Outline = list[tuple[float, float, float]]


def carried(k: Linkage, turn: float) -> gp_Trsf:
    """Where the lowered arms go when they turn."""
    start = k.carry(turn, np.zeros(2))
    return placed((float(start[0]), 0.0, float(start[1])), turn)


def twins(tree: Assembly, low: float, high: float, at: Point, size: float, body: str, role: str) -> None:
    """A pin on the left, from `low` to `high`, and its like on the right; `{}` in the role is the side."""
    for letter, start in (("l", low), ("r", -high)):
        fit_pin(tree, (float(at[0]), start, float(at[1])), size, high - low, body, role.format(letter))


# ---- arms --------
def _outline(k: Linkage) -> Outline:
    """An arm from the bucket's pin up before the tyre, back over both tyres to its rear pins; counter-clockwise."""
    bx, bz, ex = float(k.B[0]), float(k.B[1]), float(k.E[0])
    rear: Outline = [(float(p[0]), float(p[1]), 72.0) for _, p in k.links]
    return [(bx, bz, FOOT), (bx + 15, 900, 60), (bx - 60, 1085, 80), *rear, (ex, 1065, 90), (bx - 130, 885, -60)]


def draw_arms(k: Linkage, turn: float, hardware: Assembly) -> Assembly:
    """Two hollow arms, the tube between their legs, and the lugs of both kinds of cylinders."""
    tree, at, body = Assembly("LIFT ARM ASSY"), carried(k, turn), "boom"
    (bx, bz), (dx, dz), (ex, ez) = k.B, k.D, k.E
    outline = _outline(k)
    arm = plate(outline, "xz", ARM_Y, ARM_END)
    arm = cut(arm, plate(smaller(outline, WALL), "xz", ARM_Y + WALL, ARM_END - WALL))
    radius = LINK_PIN / 2 if len(k.links) > 1 else BUSH / 2
    rear = [((float(p[0]), 0.0, float(p[1])), radius) for _, p in k.links]
    arm = bored(arm, Y, ((bx, 0, bz), PIN / 2 + CLEARANCE), *rear)
    pair(tree, "LIFT ARM", arm, at, body)
    tube = ring((bx + 20, -ARM_Y, 640), Y, 48, 38, 2 * ARM_Y)
    tree.add(Part("CROSS TUBE 96x10", moved(tube, at), YELLOW), body)
    lug = plate([(dx, dz, 45), (dx + 85, dz + 180, 0), (dx - 85, dz + 180, 0)], "xz", 580, ARM_Y)
    pair(tree, "LIFT CYL LUG", bored(lug, Y, ((dx, 0, dz), PIN / 2)), at, body)
    ear = plate([(ex, ez, 36), (ex + 70, 1050, 0), (ex - 60, 1050, 0)], "xz", 584, 604)
    pair(tree, "TILT CYL LUG", bored(ear, Y, ((ex, 0, ez), TILT_PIN / 2)), at, body)
    pair(tree, "TILT CYL BLOCK", box(ex - 50, ex + 60, 604, ARM_Y, 995, 1045), at, body)
    twins(hardware, 520, ARM_Y, k.carry(turn, k.D), PIN, body, "boom_piston_rod_{}_pin")
    twins(hardware, 534, 606, k.carry(turn, k.E), TILT_PIN, body, "bucket_cylinder_barrel_{}_pin")
    if len(k.links) == 1:
        (x, z), long = k.links[0][1], ARM_END - ARM_Y
        for y in (ARM_Y, -ARM_END):
            tree.add(bush(BUSH, LINK_PIN, long), body, at=at.Multiplied(shift(float(x), y, float(z))))
    else:
        for name, (_, pin) in zip(("rear", "front"), k.links, strict=True):
            twins(hardware, 596, ARM_END + 4, k.carry(turn, pin), LINK_PIN, body, f"{name}_link_boom_pin")
    return tree


def draw_links(k: Linkage, turn: float) -> Assembly:
    """A flat link on either side for each pair of pins."""
    tree, hole = Assembly("LIFT LINKS"), LINK_PIN / 2 + CLEARANCE
    for name, (base, end) in zip(("rear", "front"), k.links, strict=True):
        along = k.carry(turn, end) - base
        far = float(np.hypot(*along))
        bar = bored(plate([(0, 0, 48), (far, 0, 48)], "xz", *LINK_Y), Y, ((0, 0, 0), hole), ((far, 0, 0), hole))
        at = placed((float(base[0]), 0, float(base[1])), direction(along))
        pair(tree, f"{name.upper()} LINK", bar, at, f"{name}_link")
    return tree


# ---- bucket --------
ATTACH, TOP, SKIN, CHEEK = (52.0, 72.0), 400.0, 12.0, 16.0
"""The carrier's plate ahead of the bucket's pin; height of the bucket's back above it; thickness of its sheet
and sides."""


def draw_bucket(k: Linkage, turn: float, angle: float, hardware: Assembly) -> Assembly:
    """The carrier: plate, ears, lugs of the tilt cylinders; and on it a dirt bucket. Drawn about its pin, level."""
    pin = k.carry(turn, k.B)
    at, body = placed((float(pin[0]), 0, float(pin[1])), turn + angle), "bucket"
    tree, carrier, bucket = Assembly("TOOL"), Assembly("QUICK ATTACH"), Assembly("BUCKET 74 IN")
    (jx, jz), edge, half = k.J, float(k.T[0]), v.BUCKET_WIDTH.value / 2
    back, face = ATTACH

    def fit(name: str, shape: TopoDS_Shape) -> None:
        for hand, whole in (("LH", shape), ("RH", mirrored(shape))):
            carrier.add(Part(f"{name} {hand}", moved(whole, at), GREY), body, "quick_attach")

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW, role: str = "") -> None:
        bucket.add(Part(name, moved(shape, at), colour), body, role)

    carrier.add(Part("ATTACH PLATE", moved(box(back, face, -590, 590, -105, 125), at), GREY), body, "quick_attach")
    ear = plate([(0, 0, 42), (back, -90, 0), (back, 110, 0)], "xz", 605, 636)
    fit("ATTACH EAR", fuse(bored(ear, Y, ((0, 0, 0), PIN / 2)), box(back, face, 590, 636, -90, 110)))
    lug: Outline = [(jx, jz, 30), (jx - 30, 70, 0), (back, -60, 0), (back, 120, 0)]
    for low, high in ((516.0, 534.0), (586.0, 604.0)):
        fit("TILT ROD LUG", bored(plate(lug, "xz", low, high), Y, ((jx, 0, jz), TILT_PIN / 2)))
    inner, floor = half - CHEEK, -DEPTH
    hx, hz, front = face + 90, floor + 90, face + 90
    heel: tuple[float, float, float] = (hx, hz, 90)
    outer: Outline = [heel, (edge - 110, floor, 0), (front, TOP, 0), (face, TOP, 0)]
    cave: Outline = [(hx, hz, 90 - SKIN), (edge - 110, floor + SKIN, 0), (front, TOP, 0), (face + SKIN, TOP, 0)]
    sheet = plate(outer, "xz", -inner, inner)
    put("BUCKET WRAPPER", cut(sheet, plate(cave, "xz", -inner - 1, inner + 1)))
    cheek: Outline = [heel, (edge - 110, floor, 0), (edge - 60, floor + 20, 0), *outer[2:]]
    for name, low, high in (("LH", inner, half), ("RH", -half, -inner)):
        put(f"BUCKET SIDE PL {name}", plate(cheek, "xz", low, high))
    lip: Outline = [(edge - 110, floor, 0), (edge, floor, 0), (edge - 30, floor + 20, 0), (edge - 110, floor + 20, 0)]
    put("CUTTING EDGE", plate(lip, "xz", -half, half), STEEL, "cutting_edge")
    put("BUCKET TOP RAIL", box(face - 40, face, -half + 60, half - 60, TOP - 70, TOP - 30))
    tree.add(carrier)
    tree.add(bucket)
    twins(hardware, 601, ARM_END + 4, pin, PIN, body, "bucket_pin")
    twins(hardware, 512, 608, pin + rot(turn + angle, k.J), TILT_PIN, body, "bucket_piston_rod_{}_pin")
    return tree
