"""The lattice boom, the tackles in the gantry's head and below the boom's, the pendants and the hook block: the boom
drawn in its own frame, a tackle along the x axis of its rope, and put where the linkage has them. Millimetres.

Lateral layout, from the middle: sheaves within 95; head's plates 110-140; pendants' eyes 155-195.
"""

from __future__ import annotations

import itertools
import math

from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import CLEARANCE, fit_pin, placed
from drawing.planar import Point
from drawing.product import GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import X, Y, bored, box, cut, fuse, mirrored, moved, plate, ring, rod
from excavator.undercarriage import inset

from . import values as v
from .carrier import PIN_BOOM, PIN_GANTRY
from .linkage import HAUL, RAISED, D, G, P, Pose

HALF, WALL, CHORD = 650.0, 16.0, 110.0
"""Half of the boom's width and depth; thickness of its walls; width of its chords."""
JOINT, END = 5_000.0, 9_200.0
"""Where its two sections meet; where its lattice ends."""
PIN_HEAD, PIN_PENDANT = 100.0, 80.0
HEAD_Y, EYE_Y = (110.0, 140.0), (155.0, 195.0)
ROPE, SHEAVE = 10.0, 190.0
FALLS = [(y, z) for y in (-60.0, -20.0, 20.0, 60.0) for z in (SHEAVE - ROPE, ROPE - SHEAVE)]
BLOCK = (-300.0, 560.0)
"""The hook block's ends along its rope, from the pin of its sheaves."""
BAIL = (-300.0, 220.0)
"""The bail's."""


def _at(pose: Pose) -> gp_Trsf:
    return placed((float(P[0]), 0.0, float(P[1])), pose.boom)


def _both(tree: Assembly, name: str, shape: TopoDS_Shape, at: gp_Trsf, body: str, colour: Colour = YELLOW) -> None:
    for hand, one in (("LH", shape), ("RH", mirrored(shape))):
        tree.add(Part(f"{name} {hand}", moved(one, at), colour), body)


def _lattice(side: list[tuple[float, float]], bays: int) -> TopoDS_Shape:
    """A section of the boom with an outline seen from the side: a tube without the triangles between its lacings."""
    corners = [(x, z, 0.0) for x, z in side]
    tube = cut(plate(corners, "xz", -HALF, HALF), plate(inset(corners, WALL), "xz", WALL - HALF, HALF - WALL))
    start, end = min(x for x, _ in side) + CHORD, max(x for x, _ in side) - CHORD
    bay = (end - start) / bays
    for i in range(bays):
        x = start + i * bay
        up = 1.0 if i % 2 else -1.0
        mid, near, far = x + bay / 2, x + 40, x + bay - 40
        wide = HALF - CHORD
        across = [(near, -up * wide, 0.0), (far, -up * wide, 0.0), (mid, up * wide, 0.0)]
        tube = cut(tube, plate(across if up > 0.0 else across[::-1], "xy", -2 * HALF, 2 * HALF))
        deep = min(_depth(side, near), _depth(side, far)) - CHORD
        if deep > CHORD:
            tall = [(near, -up * deep, 0.0), (far, -up * deep, 0.0), (mid, up * deep, 0.0)]
            tube = cut(tube, plate(tall if up > 0.0 else tall[::-1], "xz", -2 * HALF, 2 * HALF))
    return tube


def _depth(side: list[tuple[float, float]], x: float) -> float:
    """How far an outline reaches at x to the nearer side of the boom's middle."""
    found = []
    for sign in (1.0, -1.0):
        edge = sorted((a, sign * z) for a, z in side if sign * z > 0.0)
        pieces = itertools.pairwise(edge)
        found += [za + (zb - za) * (x - a) / (b - a) for (a, za), (b, zb) in pieces if a <= x <= b]
    return min(found, default=0.0)


def draw_boom(pose: Pose, hardware: Assembly) -> Assembly:
    """Foot section, top section and head, and the pins in the head."""
    tree, at, body = Assembly("BOOM"), _at(pose), "boom"
    foot = [(250.0, -130.0), (2_600.0, -HALF), (JOINT, -HALF), (JOINT, HALF), (2_600.0, HALF), (250.0, 130.0)]
    top = [(JOINT, -HALF), (7_000.0, -HALF), (END, -20.0), (END, 280.0), (7_400.0, HALF), (JOINT, HALF)]
    tree.add(Part("BOOM FOOT SECTION", moved(_lattice(foot, 7), at)), body)
    tree.add(Part("BOOM TOP SECTION", moved(_lattice(top, 6), at)), body)
    lug = plate([(0, 0, 110), (250, -130, 0), (250, 130, 0)], "xz", HALF - 60, HALF)
    _both(tree, "BOOM FOOT LUG", bored(lug, Y, ((0, 0, 0), PIN_BOOM / 2 + CLEARANCE)), at, body)
    (low, high), x, (dx, dz) = HEAD_Y, v.BOOM.value, (float(c) for c in D)
    side = [(END, -20, 0), (x, 0, 130), (dx, dz, 90), (END, 280, 0)]
    head = bored(plate(side, "xz", low, high), Y, ((x, 0, 0), PIN_HEAD / 2), ((dx, 0, dz), PIN_PENDANT / 2))
    _both(tree, "BOOM HEAD PL", head, at, body)
    _pin(hardware, pose.head, PIN_HEAD, high + 10, body, "hoist_rope_pin")
    _pin(hardware, pose.pendant, PIN_PENDANT, EYE_Y[1] + 10, body, "boom_pendant_pin")
    return tree


def _pin(tree: Assembly, at: Point, size: float, half: float, body: str, role: str) -> None:
    fit_pin(tree, (float(at[0]), -half, float(at[1])), size, 2 * half, body, role)


def _rope(length: float, pin: float) -> TopoDS_Shape:
    """Sheaves on a pin and the falls from them, along x."""
    sheaves = ring((0, -95, 0), Y, SHEAVE, pin / 2 + CLEARANCE, 190)
    falls = [rod((0, y, z), X, ROPE, length) for y, z in FALLS]
    return cut(fuse(sheaves, *falls), rod((0, -100, 0), Y, pin / 2 + CLEARANCE, 200))


def _guard(start: float, half: float) -> TopoDS_Shape:
    """The block's near end, through which the falls run; along x from `start`."""
    guard = box(start, start + 80, -half, half, -230, 230)
    for y, z in FALLS:
        guard = cut(guard, rod((start - 1, y, z), X, ROPE + 2, 82))
    return guard


def _sheaves() -> TopoDS_Shape:
    return rod((0, -92, 0), Y, SHEAVE - 2 * ROPE - 2, 184)


def draw_boom_hoist(pose: Pose) -> Assembly:
    """The ropes in the gantry's head, and the bail with the pendants to the boom's."""
    tree, rope = Assembly("BOOM HOIST"), pose.rope
    at = placed((float(G[0]), 0.0, float(G[1])), pose.line)
    tree.add(Part("BOOM HOIST ROPE", _rope(rope, PIN_GANTRY), STEEL), "boom_hoist_rope", at=at)
    turned = (math.cos(pose.line) * rope, math.sin(pose.line) * rope)
    at, body = placed((float(G[0]) + turned[0], 0.0, float(G[1]) + turned[1]), pose.line), "boom_pendant"
    (start, end), (near, far) = BAIL, EYE_Y
    tree.add(Part("BAIL GUARD", _guard(start, near), YELLOW), body, at=at)
    cheek = box(start, end, 92, near, -120, 120)
    for name, one in (("LH", cut(cheek, box(start - 1, start + 80, 90, 156, -121, 121))),):
        tree.add(Part(f"BAIL CHEEK {name}", one), body, at=at)
        tree.add(Part("BAIL CHEEK RH", mirrored(one)), body, at=at)
    tree.add(Part("BAIL SHEAVES", _sheaves(), GREY), body, at=at)
    reach = pose.span - rope
    eye = fuse(rod((reach, near, 0), Y, 75, far - near), box(0, reach, near, far, -30, 30))
    eye = cut(eye, rod((reach, near - 1, 0), Y, PIN_PENDANT / 2 + CLEARANCE, far - near + 2))
    for name, one in (("LH", eye), ("RH", mirrored(eye))):
        tree.add(Part(f"BOOM PENDANT {name}", one, STEEL), body, at=at)
    return tree


def block_drop() -> float:
    """From the pin of the head's sheaves down to that of the hook block's, as drawn."""
    return RAISED + HAUL - sum(BLOCK) / 2


def draw_hoist(pose: Pose) -> Assembly:
    """Rope with the head's sheaves, and the hook block on it; upright under the boom's head."""
    tree, drop = Assembly("HOIST"), block_drop()
    x, z = (float(c) for c in pose.head)
    down = placed((x, 0.0, z), -math.pi / 2)
    tree.add(Part("HOIST ROPE", _rope(drop, PIN_HEAD), STEEL), "hoist_rope", at=down)
    at, body, (start, end) = placed((x, 0.0, z - drop), -math.pi / 2), "hook_block", BLOCK
    tree.add(Part("HOOK BLOCK GUARD", _guard(start, 92), YELLOW), body, at=at)
    cheek = plate([(start, -230, 0), (180, -90, 0), (180, 90, 0), (start, 230, 0)], "xz", 92, 172)
    for name, one in (("LH", cheek), ("RH", mirrored(cheek))):
        tree.add(Part(f"HOOK BLOCK CHEEK {name}", one, YELLOW), body, at=at)
    tree.add(Part("BLOCK SHEAVES", _sheaves(), GREY), body, at=at)
    tree.add(Part("HOOK TRUNNION", box(172, 260, -92, 92, -80, 80), GREY), body, at=at)
    bow = cut(ring((end - 130, -45, 0), Y, 130, 65, 90), box(end - 300, end - 130, -60, 60, 0, 200))
    tree.add(Part("HOOK", fuse(rod((260, 0, 0), X, 50, end - 470), bow), GREY), body, at=at)
    return tree
