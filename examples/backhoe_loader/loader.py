"""Loader arms, rocker, link and bucket, each drawn in its own frame (x along the part, z up, y left) and put where the
linkage has it. Machine frame, millimetres.

Lateral layout, from the middle: link and cylinder eye within 38, rocker 44-72, its brackets 78-104, arms 405-445, the
bucket's ears 379-401 and 449-471.
"""

from __future__ import annotations

from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import CLEARANCE, fit_pin, placed
from drawing.loader import Linkage, Pose
from drawing.planar import Point, direction
from drawing.product import STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import Y, bored, box, cut, mirrored, moved, plate, ring

from . import values as v
from .chassis import ARM_Y, LIFT_Y, PIN_ARM, PIN_LIFT, PIN_TILT

PIN_BUCKET, PIN_ROCKER, PIN_LINK = 60.0, 70.0, 55.0
TUBE = (1950.0, 340.0, 70.0)
"""The arms' cross tube in their frame: x, z, radius."""
EARS = ((379.0, 401.0), (449.0, 471.0))
SKIN, CHEEK = 10.0, 16.0
Outline = list[tuple[float, float, float]]


def _at(pin: Point, angle: float) -> gp_Trsf:
    return placed((float(pin[0]), 0.0, float(pin[1])), angle)


def _both(tree: Assembly, name: str, shape: TopoDS_Shape, at: gp_Trsf, body: str) -> None:
    for hand, one in (("LH", shape), ("RH", mirrored(shape))):
        tree.add(Part(f"{name} {hand}", moved(one, at), YELLOW), body)


def _twins(tree: Assembly, at: Point, size: float, low: float, high: float, body: str, role: str) -> None:
    """A pin on the left, from `low` to `high`, and its like on the right; `{}` in the role is the side."""
    for letter, start in (("l", low), ("r", -high)):
        fit_pin(tree, (float(at[0]), start, float(at[1])), size, high - low, body, role.format(letter))


def draw_arms(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """Two arms, the tube between them, the rocker's brackets, bosses of the lift cylinders."""
    tree, at, body = Assembly("LOADER ARMS"), _at(k.A, pose.boom_angle), "loader_arm"
    (dx, dz), (gx, gz), far = k.D, k.G, k.boom
    arm: Outline = [(0, 0, 95), (dx, dz, 80), (far, 0, 70), (1950, 340, 105), (1450, 310, 110)]
    holes = [
        ((0, 0, 0), PIN_ARM / 2 + CLEARANCE),
        ((far, 0, 0), PIN_BUCKET / 2 + CLEARANCE),
        ((dx, 0, dz), PIN_LIFT / 2),
    ]
    shape = bored(plate(arm, "xz", *ARM_Y), Y, *holes, ((TUBE[0], 0, TUBE[1]), TUBE[2]))
    _both(tree, "LOADER ARM", shape, at, body)
    tube = ring((TUBE[0], -ARM_Y[1], TUBE[1]), Y, TUBE[2], TUBE[2] - 12, 2 * ARM_Y[1])
    tree.add(Part("CROSS TUBE", moved(tube, at), YELLOW), body)
    bracket = plate([(TUBE[0], TUBE[1], TUBE[2] + 35), (gx, gz, 65)], "xz", 78, 104)
    bracket = bored(bracket, Y, ((TUBE[0], 0, TUBE[1]), TUBE[2]), ((gx, 0, gz), PIN_ROCKER / 2))
    _both(tree, "ROCKER BRKT", bracket, at, body)
    _both(tree, "LIFT CYL BOSS", ring((dx, 352, dz), Y, 62, PIN_LIFT / 2, ARM_Y[0] - 352), at, body)
    _twins(hardware, pose.D, PIN_LIFT, LIFT_Y - 34, ARM_Y[1] + 4, body, "loader_lift_piston_rod_{}_pin")
    x, z = (float(c) for c in pose.G)
    fit_pin(hardware, (x, -110, z), PIN_ROCKER, 220, body, "loader_lever_pin")
    return tree


def draw_rocker(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """The rocker's two plates about its hub, and the link."""
    tree, at, body = Assembly("ROCKER AND LINK"), _at(pose.G, pose.rocker_angle), "loader_lever"
    (hx, hz), far = k.H, k.rocker
    side: Outline = [(0, 0, 85), (far, 0, 58), (hx, hz, 55)]
    holes = [((0, 0, 0), PIN_ROCKER / 2 + CLEARANCE), ((far, 0, 0), PIN_TILT / 2), ((hx, 0, hz), PIN_LINK / 2)]
    _both(tree, "ROCKER PL", bored(plate(side, "xz", 44, 72), Y, *holes), at, body)
    hub = ring((0, -44, 0), Y, 60, PIN_ROCKER / 2 + CLEARANCE, 88)
    tree.add(Part("ROCKER HUB", moved(hub, at), YELLOW), body)
    for pin, size, role in ((pose.F, PIN_TILT, "loader_bucket_piston_rod_pin"), (pose.H, PIN_LINK, "loader_link_pin")):
        fit_pin(hardware, (float(pin[0]), -76, float(pin[1])), size, 152, body, role)
    hole = PIN_LINK / 2 + CLEARANCE
    bar = plate([(0, 0, 50), (k.link, 0, 50)], "xz", -38, 38)
    bar = bored(bar, Y, ((0, 0, 0), hole), ((k.link, 0, 0), hole))
    at = _at(pose.H, direction(pose.J - pose.H))
    tree.add(Part("BUCKET LINK ROD", moved(bar, at), YELLOW), "loader_link")
    return tree


def draw_bucket(k: Linkage, pose: Pose, hardware: Assembly) -> Assembly:
    """The loader bucket with its ears, level in its own frame."""
    tree, at, body = Assembly("LOADER BUCKET"), _at(pose.B, pose.bucket_angle), "loader_bucket"
    (jx, jz), (edge, floor), half = k.J, k.T, v.SHOVEL_WIDTH.value / 2
    inner, back, top = half - CHEEK, 100.0, 640.0

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW, role: str = "") -> None:
        tree.add(Part(name, moved(shape, at), colour), body, role)

    heel: tuple[float, float, float] = (back + 150, floor + 150, 150)
    outer: Outline = [heel, (edge - 150, floor, 0), (back + 120, top, 0), (back, 430, 0)]
    cave: Outline = [(*heel[:2], 150 - SKIN), (edge, floor + SKIN, 0), (edge, top + 84, 0), (back + 178, top + 84, 0)]
    cave.append((back + SKIN, 430, 0))
    put("BUCKET WRAPPER", cut(plate(outer, "xz", -inner, inner), plate(cave, "xz", -inner - 1, inner + 1)))
    cheek: Outline = [heel, (edge - 60, floor, 0), (edge - 60, floor + 24, 0), *outer[2:]]
    for name, low, high in (("LH", inner, half), ("RH", -half, -inner)):
        put(f"BUCKET SIDE {name}", plate(cheek, "xz", low, high))
    lip: Outline = [(edge - 150, floor, 0), (edge, floor, 0), (edge - 36, floor + 24, 0), (edge - 150, floor + 24, 0)]
    put("BUCKET EDGE", plate(lip, "xz", -inner, inner), STEEL, "loader_cutting_edge")
    for name, (low, high) in zip(("IN", "OUT"), EARS, strict=True):
        ear = plate([(0, 0, 62), (back, -35, 0), (back, 190, 0)], "xz", low, high)
        _both(tree, f"BUCKET EAR {name}", bored(ear, Y, ((0, 0, 0), PIN_BUCKET / 2)), at, body)
    lug = plate([(jx, jz, 50), (back, jz - 130, 0), (back, jz + 150, 0)], "xz", 44, 72)
    _both(tree, "LINK LUG", bored(lug, Y, ((jx, 0, jz), PIN_LINK / 2)), at, body)
    _both(tree, "BACK STIFFENER", box(back - 24, back, 120, inner - 60, 300, 360), at, body)
    _twins(hardware, pose.B, PIN_BUCKET, EARS[0][0] - 5, EARS[1][1] + 5, body, "loader_bucket_pin")
    fit_pin(hardware, (float(pose.J[0]), -76, float(pose.J[1])), PIN_LINK, 152, body, "loader_link_bucket_pin")
    return tree
