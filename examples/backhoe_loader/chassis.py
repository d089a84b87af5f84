"""Chassis with its towers, rear frame, axles and cab, and the stabilisers. Machine frame, millimetres.

Lateral layout, from the middle: rails 220-260, hood 250, loader's lift cylinders about 318, towers 376-402 and 448-475,
loader arms 405-445.
"""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import fit_pin
from drawing.product import BLACK, GLASS, GREY, YELLOW, Assembly, Colour, Part, add_pair
from drawing.solids import X, Y, Z, bored, box, cut, fuse, moved, plate, rod, sheet_box, shift, turned
from drawing.stabiliser import PIN_LEG, PIN_LEG_CYL, fit_stabiliser_pins
from drawing.steer_axle import PIN_OSCILLATION

from . import values as v
from .linkage import (
    AXLE_Z,
    FRONT_X,
    REAR_RADIUS,
    SWING_X,
    SWING_Z,
    solve_loader,
    solve_stabiliser,
    solve_swing,
)

BODY = "chassis"
RAIL = (220.0, 260.0, 600.0, 760.0)
"""Inside, outside, underside, top."""
LIFT_Y, ARM_Y = 318.0, (405.0, 445.0)
TOWERS = ((376.0, 402.0), (448.0, 475.0))
PIN_ARM, PIN_LIFT, PIN_TILT = 70.0, 55.0, 60.0
PIN_POST, PIN_SWING = 80.0, 45.0
REAR_SPINDLE = 60.0
LEG_X = (-1150.0, -1070.0)
"""A stabiliser's leg lies between the plates of the rear frame, which begin 10 from it."""
POST_LUGS = ((600.0, 640.0), (820.0, 860.0))
"""Heights of the lugs that hold the swing post."""


def draw_frame(hardware: Assembly) -> Assembly:
    """Rails, towers with the arms' and lift cylinders' pins, the bracket of the bucket cylinder, the axle's hangers."""
    tree, k = Assembly("MAIN FRAME"), solve_loader()
    inside, outside, low, high = RAIL
    (ax, az), (cx, cz), (ex, ez) = k.A, k.C, k.E
    add_pair(tree, "FRAME RAIL", box(-1040, 2330, inside, outside, low, high), BODY)
    for x, top in ((-900.0, low + 50), (300.0, high), (1250.0, high), (2290.0, high)):
        tree.add(Part("X-MEMBER", box(x, x + 40, -inside, inside, low, top)), BODY)
    side = [(900.0, low, 0.0), (1330.0, low, 0.0), (cx + 80, cz, 0.0), (1320.0, 1500.0, 0.0), (ax, az, 95.0)]
    holes = [((ax, 0, az), PIN_ARM / 2), ((cx, 0, cz), PIN_LIFT / 2)]
    outer = [(900.0, low, 0.0), (1080.0, low, 0.0), (ax, az, 95.0)]
    for name, outline, (y0, y1) in zip(("IN", "OUT"), (side, outer), TOWERS, strict=True):
        shape = bored(plate(outline, "xz", y0, y1), Y, *(holes if name == "IN" else holes[:1]))
        add_pair(tree, f"TOWER PL {name}", shape, BODY)
    add_pair(tree, "TOWER FOOT", box(900, 1080, outside, TOWERS[1][0], low, high), BODY)
    add_pair(tree, "LIFT CYL FOOT", box(1080, 1330, outside, TOWERS[0][0], low, high), BODY)
    inner = [(cx - 70, high, 0.0), (cx + 70, high, 0.0), (cx, cz, 60.0)]
    add_pair(tree, "LIFT CYL PL", bored(plate(inner, "xz", 234, 260), Y, holes[1]), BODY)
    beam = sheet_box(1180, 1300, -TOWERS[0][0], TOWERS[0][0], 1390, 1490, 14.0)
    tree.add(Part("TOWER X-MEMBER", beam), BODY)
    lug = bored(plate([(ex, ez, 62), (1300, 1490, 0), (1300, 1390, 0)], "xz", 56, 82), Y, ((ex, 0, ez), PIN_TILT / 2))
    add_pair(tree, "TILT CYL LUG", lug, BODY)
    for name, x in (("FRT", FRONT_X + 100), ("RR", FRONT_X - 140)):
        hanger = fuse(box(x, x + 40, -100, 100, AXLE_Z - 60, high), box(x, x + 40, -inside, inside, high - 60, high))
        tree.add(Part(f"AXLE HANGER {name}", bored(hanger, X, ((0, 0, AXLE_Z), PIN_OSCILLATION / 2))), BODY)
    fit_pin(hardware, (ex, -88, ez), PIN_TILT, 176, BODY, "loader_bucket_cylinder_barrel_pin")
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        for role, x, z, size, start, end in (
            ("loader_arm_pin", ax, az, PIN_ARM, 370.0, 482.0),
            (f"loader_lift_cylinder_barrel_{letter}_pin", cx, cz, PIN_LIFT, 232.0, 408.0),
        ):
            at = (float(x), start if sign > 0 else -end, float(z))
            fit_pin(hardware, at, size, end - start, BODY, role)
    return tree


def draw_rear(hardware: Assembly) -> Assembly:
    """The rear frame: two plates that hold the stabilisers between them, lugs of swing post and swing cylinders."""
    tree, leg, swing = Assembly("REAR FRAME"), solve_stabiliser(), solve_swing()
    half = v.FRAME_WIDTH.value / 2
    (ly, lz), (by, bz) = leg.pin, leg.barrel
    right = [(-half, 900.0, 0.0), (-half, 620.0, 0.0), (-ly, lz, 95.0)]
    side = [*right, (ly, lz, 95.0), (half, 620.0, 0.0), (half, 900.0, 0.0), (620.0, 1260.0, 0.0), (-620.0, 1260.0, 0.0)]
    window = box(-2000, 0, -380, 380, SWING_Z - 75, SWING_Z + 75)
    holes = [((0.0, sign * y, z), size / 2) for y, z, size in ((ly, lz, PIN_LEG), (by, bz, PIN_LEG_CYL))
             for sign in (1.0, -1.0)]  # fmt: skip
    first, last = LEG_X[0] - 10, LEG_X[1] + 10
    for name, x in (("RR", first - 20), ("FRT", last)):
        shape = bored(cut(plate(side, "yz", x, x + 20), window), X, *holes)
        tree.add(Part(f"REAR FRAME PL {name}", shape), BODY)
    for y in (-300.0, 260.0):
        tree.add(Part("REAR FRAME SPACER", box(first, last, y, y + 40, 900, 940)), BODY)
    add_pair(tree, "REAR FRAME RAIL", box(last + 20, -1000, RAIL[0], RAIL[1], 610, 750), BODY)
    for name, (low, high) in zip(("LWR", "UPR"), POST_LUGS, strict=True):
        lug = plate([(SWING_X, 0, 58), (first - 20, -58, 0), (first - 20, 58, 0)], "xy", low, high)
        tree.add(Part(f"SWING LUG {name}", bored(lug, Z, ((SWING_X, 0, 0), PIN_POST / 2))), BODY)
    bx, bz2 = SWING_X + float(swing.barrel[0]), float(swing.barrel[1])
    for low, high in ((SWING_Z - 62, SWING_Z - 36), (SWING_Z + 36, SWING_Z + 62)):
        lug = plate([(bx, bz2, 42), (-400, bz2 - 45, 0), (-400, bz2 + 45, 0)], "xy", low, high)
        lug = bored(lug, Z, ((bx, bz2, 0), PIN_SWING / 2))
        add_pair(tree, f"SWING CYL LUG {'LWR' if low < SWING_Z else 'UPR'}", lug, BODY)
    tree.add(Part("SWING CYL BEAM", box(-400, -340, -RAIL[0], RAIL[0], SWING_Z - 62, SWING_Z + 62)), BODY)
    for start, length in ((510.0, 135.0), (815.0, 95.0)):
        fit_pin(hardware, (SWING_X, 0, start), PIN_POST, length, BODY, "swing_post_pin", upright=True)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        at = (bx, sign * bz2, SWING_Z - 68)
        fit_pin(hardware, at, PIN_SWING, 136, BODY, f"swing_cylinder_barrel_{letter}_pin", upright=True)
    fit_stabiliser_pins(leg, (first - 28, last + 28), BODY, hardware)
    return tree


def draw_top() -> Assembly:
    """Rear axle, engine with hood, cab, tanks."""
    tree, top = Assembly("SUPERSTRUCTURE"), v.CAB_HEIGHT.value
    inside, outside, low, high = RAIL

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW) -> None:
        tree.add(Part(name, shape, colour), BODY)

    reach = v.REAR_TREAD.value / 2 + 60
    half = [(110, 190), (160, 110), (600, 95), (600, REAR_SPINDLE), (reach, REAR_SPINDLE), (reach, 0)]
    axle = turned([*half, *[(-y, r) for y, r in reversed(half)]])
    pads = [box(-160, 160, y, y + 40, -112, 42) for y in (outside, -outside - 40)]
    put("REAR AXLE", moved(fuse(axle, *pads), shift(0, 0, REAR_RADIUS)), GREY)
    put("ENGINE", sheet_box(1350, 2050, -inside, inside, high - 90, 1250, 20.0), GREY)
    put("TRANSMISSION", sheet_box(350, 1100, -inside, inside, low + 30, 1000, 20.0), GREY)
    put("RADIATOR", box(2080, 2150, -inside, inside, high - 60, 1280), BLACK)
    hood = cut(box(1330, 2190, -250, 250, high, 1330), box(1329, 2184, -242, 242, high - 1, 1322))
    put("ENGINE HOOD", hood)
    put("FUEL TANK", sheet_box(-250, 700, -600, -outside, 700, 1050, 5.0), BLACK)
    put("HYDRAULIC TANK", sheet_box(-250, 700, outside, 600, 700, 1050, 5.0))
    put("CAB FLOOR", box(-800, 880, -610, 610, 1050, 1080), GREY)
    front = [(-760.0, 1080.0, 0.0), (860.0, 1080.0, 0.0), (780.0, top - 60, 0.0), (-700.0, top - 60, 0.0)]
    pane = [(-620.0, 1300.0, 0.0), (720.0, 1300.0, 0.0), (660.0, top - 180, 0.0), (-580.0, top - 180, 0.0)]
    for name, y in (("LH", 590.0), ("RH", -610.0)):
        wall = cut(plate(front, "xz", y, y + 20), plate(pane, "xz", y - 1, y + 21))
        put(f"CAB SIDE {name}", wall, BLACK)
        put(f"SIDE GLASS {name}", plate(pane, "xz", y + 7, y + 13), GLASS)
    put("CAB ROOF", sheet_box(-760, 840, -620, 620, top - 60, top, 5.0))
    put(
        "FRONT GLASS",
        plate([(858, 1080, 0), (864, 1080, 0), (786, top - 60, 0), (780, top - 60, 0)], "xz", -580, 580),
        GLASS,
    )
    put("SEAT BASE", sheet_box(-250, 250, -250, 250, 1080, 1450, 5.0), GREY)
    put("SEAT", fuse(box(-260, 240, -240, 240, 1450, 1560), box(-340, -240, -240, 240, 1450, 2150)), BLACK)
    put("STEERING COLUMN", rod((520, 0, 1080), Z, 40, 780), BLACK)
    put("STEERING WHEEL", rod((520, 0, 1860), Z, 200, 25), BLACK)
    put("EXHAUST", rod((1500, 180, 1330), Z, 45, 900), BLACK)
    return tree
