"""Chassis: rails, the tower that carries boom and cylinders, what holds the axles, cab, engine, counterweight; of the
machine with three sections the stabilisers' frame. Machine frame, millimetres.

Lateral layout, from the middle: cylinder eyes within 36, barrels within 74, lugs of the lift cylinder 76-100; boom 150,
its tail 166, tower plates 180-206, rails 220-270, cab and engine beside them.
"""

from __future__ import annotations

from drawing.hardware import fit_pin
from drawing.product import BLACK, GLASS, GREY, YELLOW, Assembly, Part, add_pair
from drawing.solids import X, Y, Z, bored, box, cut, fuse, plate, ring, rod, sheet_box, shift
from drawing.stabiliser import PIN_LEG, PIN_LEG_CYL, fit_stabiliser_pins
from drawing.steer_axle import PIN_OSCILLATION

from . import values as v
from .linkage import AXLE_Z, FRONT_X, LEG_X, LEVEL_FROM, REAR_X, Linkage, solve_stabiliser

BODY = "chassis"
RAIL = (220.0, 270.0, 650.0, 800.0)
"""Inside, outside, underside, top."""
TOWER = (180.0, 206.0)
PIN_BOOM, PIN_LIFT, PIN_COMPENSATION, PIN_LEVEL = 90.0, 70.0, 45.0, 45.0


def _hanger(tree: Assembly, end: str, x: float) -> None:
    """Two plates on which an axle oscillates."""
    inside, _, low, _ = RAIL
    for name, start in (("FRT", x + 100), ("RR", x - 140)):
        plates = box(start, start + 40, -100, 100, AXLE_Z - 60, low + 60)
        hanger = fuse(plates, box(start, start + 40, -inside, inside, low, low + 60))
        part = Part(f"{end} AXLE HANGER {name}", bored(hanger, X, ((0, 0, AXLE_Z), PIN_OSCILLATION / 2)))
        tree.add(part, BODY)


def draw_frame(k: Linkage, hardware: Assembly) -> Assembly:
    """Rails, tower, lugs of the lift cylinder, what holds the axles, counterweight."""
    tree = Assembly("MAIN FRAME")
    inside, outside, low, high = RAIL
    (px, pz), (cx, cz), (ex, ez) = k.P, k.C, k.E
    add_pair(tree, "FRAME RAIL", box(-560, 3_050 if k.sections == 2 else 3_100, inside, outside, low, high), BODY)
    for x in (-540.0, 1_920.0, 2_900.0):
        tree.add(Part("X-MEMBER", box(x, x + 40, -inside, inside, low, high - 40)), BODY)
    side = [(-520.0, low, 0.0), (430.0, low, 0.0), (px, pz, 100.0), (ex, ez, 62.0)]
    holes = (((px, 0, pz), PIN_BOOM / 2), ((ex, 0, ez), PIN_COMPENSATION / 2))
    add_pair(tree, "TOWER PL", bored(plate(side, "xz", *TOWER), Y, *holes), BODY)
    add_pair(tree, "TOWER FOOT", box(-500, 410, TOWER[1], inside, low + 10, high - 10), BODY)
    boss = ring((ex, 48, ez), Y, 52, PIN_COMPENSATION / 2, TOWER[0] - 48)
    add_pair(tree, "COMP CYL BOSS", boss, BODY)
    tree.add(Part("LIFT CYL BEAM", box(0, 98, -inside, inside, low, low + 40)), BODY)
    lug = bored(
        plate([(cx, cz, 62), (0, low + 40, 0), (98, low + 40, 0)], "xz", 76, 100), Y, ((cx, 0, cz), PIN_LIFT / 2)
    )
    add_pair(tree, "LIFT CYL LUG", lug, BODY)
    _hanger(tree, "RR", 0.0)
    if k.sections == 2:
        add_pair(tree, "FRT AXLE MOUNT", box(FRONT_X - 58, FRONT_X + 58, 160, outside, AXLE_Z + 50, low), BODY)
    else:
        _hanger(tree, "FRT", FRONT_X)
    # Between the rear wheels as they turn.
    tree.add(Part("COUNTERWEIGHT", box(REAR_X, -560, -430, 430, 480, 1_260), GREY), BODY)
    tree.add(Part("TOWER BALLAST", box(-500, -150, -TOWER[0], TOWER[0], 720, 1_450), GREY), BODY)
    for role, x, z, size, half in (
        ("boom_pin", px, pz, PIN_BOOM, 212.0), ("lift_cylinder_barrel_pin", cx, cz, PIN_LIFT, 106.0),
        ("compensation_cylinder_barrel_pin", ex, ez, PIN_COMPENSATION, 212.0),
    ):  # fmt: skip
        fit_pin(hardware, (float(x), -half, float(z)), size, 2 * half, BODY, role)
    return tree


def draw_front(hardware: Assembly) -> Assembly:
    """The stabilisers' frame between whose plates the legs swing, and the levelling cylinder's bracket."""
    tree, leg = Assembly("FRONT FRAME"), solve_stabiliser()
    _, outside, low, _ = RAIL
    (ly, lz), (by, bz) = leg.pin, leg.barrel
    first, last = LEG_X[0] - 10, LEG_X[1] + 10
    right = [(-680.0, 900.0, 0.0), (-ly, lz, 95.0)]
    side = [*right, (ly, lz, 95.0), (680.0, 900.0, 0.0), (640.0, 1_230.0, 0.0), (-640.0, 1_230.0, 0.0)]
    window = box(3_000, 3_400, -250, 250, 840, 1_300)
    holes = [((0.0, sign * y, z), size / 2) for y, z, size in ((ly, lz, PIN_LEG), (by, bz, PIN_LEG_CYL))
             for sign in (1.0, -1.0)]  # fmt: skip
    for name, x in (("RR", first - 20), ("FRT", last)):
        shape = bored(cut(plate(side, "yz", x, x + 20), window), X, *holes)
        tree.add(Part(f"STABILISER FRAME PL {name}", shape), BODY)
    for y in (-150.0, 110.0):
        tree.add(Part("STABILISER FRAME SPACER", box(first, last, y, y + 40, 740, 790)), BODY)
    fit_stabiliser_pins(leg, (first - 28, last + 28), BODY, hardware)
    qy, qz = (float(c) for c in LEVEL_FROM)
    for name, x in (("RR", FRONT_X - 76), ("FRT", FRONT_X + 52)):
        lug = plate([(qy, qz, 42), (outside, qz + 40, 0), (outside, low, 0), (outside + 60, low, 0)], "yz", x, x + 24)
        tree.add(Part(f"LEVELLING LUG {name}", bored(lug, X, ((0, qy, qz), PIN_LEVEL / 2))), BODY)
    bar = Part(f"PIN D{PIN_LEVEL:g}", rod((0, 0, 0), X, PIN_LEVEL / 2, 164))
    hardware.add(bar, BODY, "levelling_cylinder_barrel_pin", shift(FRONT_X - 82, qy, qz))
    return tree


def draw_top() -> Assembly:
    """Belly pan, engine on the right, cab on the left, tanks."""
    tree, top = Assembly("SUPERSTRUCTURE"), v.OVERALL_HEIGHT.value
    inside, outside, low, high = RAIL
    ground = v.GROUND_CLEARANCE.value

    def put(name: str, shape: object, colour: tuple[float, float, float] = YELLOW) -> None:
        tree.add(Part(name, shape, colour), BODY)

    put("BELLY PAN", sheet_box(620, 1_880, -inside, inside, ground, low, 12.0), GREY)
    put("ENGINE", sheet_box(720, 1_780, -880, -outside - 60, low + 20, 1_300, 20.0), GREY)
    put("ENGINE BEARER", box(800, 1_700, -outside - 60, -outside, low + 20, high - 60), GREY)
    hood = sheet_box(705, 1_795, -950, -outside, high - 50, 1_420, 6.0)
    put("ENGINE HOOD", cut(hood, box(711, 1_789, -940, -outside - 6, high - 51, 1_400)))
    put("FUEL TANK", sheet_box(900, 1_600, outside, 640, 440, high - 70, 5.0), BLACK)
    put("EXHAUST", rod((760, -900, 1_420), Z, 40, 700), BLACK)
    put("CAB FLOOR", box(705, 1_765, outside, 960, high - 60, high - 30), GREY)
    front = [(710.0, high - 30, 0.0), (1_760.0, high - 30, 0.0), (1_700.0, top - 60, 0.0), (730.0, top - 60, 0.0)]
    pane = [(780.0, 1_300.0, 0.0), (1_660.0, 1_300.0, 0.0), (1_620.0, top - 180, 0.0), (790.0, top - 180, 0.0)]
    for name, y in (("LH", 940.0), ("RH", outside + 10)):
        put(f"CAB SIDE {name}", cut(plate(front, "xz", y, y + 20), plate(pane, "xz", y - 1, y + 21)), BLACK)
        put(f"SIDE GLASS {name}", plate(pane, "xz", y + 7, y + 13), GLASS)
    put("CAB ROOF", sheet_box(705, 1_720, outside + 10, 960, top - 60, top, 5.0))
    glass = [(1_754.0, high - 30, 0.0), (1_760.0, high - 30, 0.0), (1_706.0, top - 60, 0.0), (1_700.0, top - 60, 0.0)]
    put("FRONT GLASS", plate(glass, "xz", outside + 30, 940), GLASS)
    put("SEAT BASE", sheet_box(830, 1_200, 400, 820, high - 30, 1_150, 5.0), GREY)
    put("SEAT", fuse(box(820, 1_210, 400, 820, 1_150, 1_260), box(740, 820, 400, 820, 1_150, 1_850)), BLACK)
    put("STEERING COLUMN", rod((1_450, 610, high - 30), Z, 40, 700), BLACK)
    put("STEERING WHEEL", rod((1_450, 610, high + 670), Z, 190, 25), BLACK)
    return tree
