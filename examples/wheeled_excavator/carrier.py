"""What carries the digger: undercarriage with its axles' seats and the stabilisers' frame, upper structure with towers,
cab and counterweight. Machine frame, millimetres.

Lateral layout, from the middle: axle hangers 100, frame 330, brackets of the stabilisers to 900; boom 222, towers
228-268, boom cylinders 297-407 between them and lugs 411-437, cab and tanks beside them.
"""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.digger import Linkage
from drawing.product import BLACK, GLASS, GREY, STEEL, YELLOW, Assembly, Colour, Part
from drawing.solids import X, Z, bored, box, cut, fuse, moved, plate, ring, rod, sheet_box, shift, turned
from drawing.stabiliser import PIN_LEG, PIN_LEG_CYL, fit_stabiliser_pins
from drawing.steer_axle import PIN_OSCILLATION
from excavator.undercarriage import hollow
from excavator.upper import casting, draw_towers, fit_boom_pins

from . import values as v
from .linkage import AXLE_Z, FRONT_X, LEG_X, RADIUS, REAR_X, SPINDLE, TREAD, solve_stabiliser

DARK: Colour = (0.16, 0.16, 0.17)
HALF = 330.0
"""Of the frame's width."""
LOW, TOP, SEAT = 670.0, 980.0, 1_110.0
"""Underside and top of the frame, and of the swing bearing's seat on it."""
FLOOR = 1_230.0
"""Underside of the revolving frame."""
DECK = 1_390.0
BEARING = (430.0, 500.0, 501.0, 570.0)
"""Radii of the swing bearing's races: the undercarriage's, the upper structure's."""


def draw_undercarriage(hardware: Assembly) -> Assembly:
    """Frame, hangers of the front axle, rear axle, frame of the stabilisers, the bearing's inner race."""
    tree, body, leg = Assembly("UNDERCARRIAGE"), "undercarriage", solve_stabiliser()

    def put(name: str, shape: TopoDS_Shape, colour: Colour = DARK, role: str = "") -> None:
        tree.add(Part(name, shape, colour), body, role)

    front, back = FRONT_X + 420.0, LEG_X[1] + 30.0
    side = [(back, LOW), (front, LOW), (front, LOW + 130), (900.0, TOP), (-900.0, TOP), (back, TOP - 80)]
    put("CHASSIS FRAME", hollow([(x, z, 0.0) for x, z in side], "xz", -HALF, HALF, 14.0))
    inner, outer, _, _ = BEARING
    put("BEARING SEAT", ring((0, 0, TOP), Z, outer + 40, inner - 40, SEAT - TOP))
    put("SWING BEARING INNER RACE", ring((0, 0, SEAT), Z, outer, inner, FLOOR - SEAT - 12), STEEL, "swing_bearing")
    for name, x in (("FRT", FRONT_X + 100), ("RR", FRONT_X - 140)):
        hanger = box(x, x + 40, -100, 100, AXLE_Z - 60, LOW)
        put(f"AXLE HANGER {name}", bored(hanger, X, ((0, 0, AXLE_Z), PIN_OSCILLATION / 2)))
    reach, case = TREAD / 2 + 60, RADIUS - v.GROUND_CLEARANCE.value
    half = [(110, case), (160, 110), (700, 90), (700, SPINDLE), (reach, SPINDLE), (reach, 0)]
    axle = turned([*half, *[(-y, r) for y, r in reversed(half)]])
    pads = [box(-110, 110, y, y + 60, 0, LOW - RADIUS) for y in (230.0, -290.0)]
    put("REAR AXLE", moved(fuse(axle, *pads), shift(REAR_X, 0, RADIUS)), GREY)
    put("TRANSMISSION", fuse(box(-760, -300, -200, 200, 520, LOW), rod((-840, 0, RADIUS + 40), X, 60, 100)), GREY)
    put("DRIVE SHAFT", rod((-300, 0, LOW - 90), X, 40, FRONT_X - 200), GREY)
    for name, y in (("LH", HALF), ("RH", -HALF - 330)):
        put(f"TOOL BOX {name}", sheet_box(-340, 560, y, y + 330, 560, 900, 4.0), YELLOW)
        put(f"STEP {name}", box(-60, 340, y + (330 if y > 0 else -220), y + (550 if y > 0 else 0), 560, 590))
    (ly, lz), (by, bz) = leg.pin, leg.barrel
    first, last = LEG_X[0] - 10, LEG_X[1] + 10
    plates = [(-900.0, 640.0, 0.0), (-ly, lz, 95.0), (ly, lz, 95.0), (900.0, 640.0, 0.0), (by + 60, bz + 70, 0.0)]
    plates.append((-by - 60, bz + 70, 0.0))
    holes = [((0.0, sign * y, z), size / 2) for y, z, size in ((ly, lz, PIN_LEG), (by, bz, PIN_LEG_CYL))
             for sign in (1.0, -1.0)]  # fmt: skip
    for name, x in (("RR", first - 20), ("FRT", last)):
        put(f"STABILISER FRAME PL {name}", bored(plate(plates, "yz", x, x + 20), X, *holes))
    for y in (-200.0, 160.0):
        put("STABILISER FRAME SPACER", box(first, last, y, y + 40, 700, 900))
    fit_stabiliser_pins(leg, (first - 28, last + 28), body, hardware)
    return tree


def draw_upper(k: Linkage, hardware: Assembly) -> Assembly:
    """Revolving frame, towers, decks, counterweight, engine, tanks and cab."""
    tree, body, half = Assembly("UPPER STRUCTURE"), "upperstructure", v.UPPER_WIDTH.value / 2
    (ax, az), (cx, cz), tail = k.A, k.C, v.TAIL_RADIUS.value

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW) -> None:
        tree.add(Part(name, shape, colour), body)

    _, _, inner, outer = BEARING
    put("SWING BEARING OUTER RACE", ring((0, 0, SEAT + 20), Z, outer, inner, FLOOR - SEAT - 20), STEEL)
    base, skirt = FLOOR + 40, v.COUNTERWEIGHT_CLEARANCE.value
    plan = [(-1_380.0, 440.0), (680.0, 440.0), (680.0, -440.0), (-1_380.0, -440.0)]
    put("BASE PL", bored(plate([(x, y, 0.0) for x, y in plan[::-1]], "xy", FLOOR, base), Z, ((0, 0, 0), 240.0)))
    tower = [(cx, cz, 112.0), (ax, az, 150.0), (-420.0, 1_700.0, 0.0), (-1_690.0, 1_480.0, 0.0)]
    draw_towers(tree, k, [*tower, (-1_690.0, base, 0.0), (660.0, base, 0.0)], base)
    put("TOWER BULKHEAD", box(-420, -390, -228, 228, base, 1_640))
    for name, y0, y1 in (("LH", 440.0, half), ("RH", -half, -440.0)):
        put(f"DECK {name}", sheet_box(-1_650, 1_150, y0, y1, skirt, DECK, 6.0), GREY)
    put("SWING MOTOR", fuse(rod((-700, 0, base), Z, 110, 300), rod((-700, 0, base + 300), Z, 70, 140)), GREY)
    block = casting(tail, half - 10, -1_700.0, skirt, 2_080.0)
    put("COUNTERWEIGHT", cut(block, casting(tail - 200, half - 210, -1_760.0, skirt + 150, 1_930.0)), DARK)
    hood = box(-1_690, -700, -half + 10, half - 10, DECK, 2_130)
    put("ENGINE HOOD", cut(hood, box(-1_684, -706, -half + 16, half - 16, DECK - 1, 2_124)))
    put("ENGINE", sheet_box(-1_500, -850, -900, 900, DECK, 2_050, 14.0), GREY)
    put("FUEL TANK", sheet_box(-690, 250, -half + 10, -460, DECK, 1_950, 5.0))
    put("HYDRAULIC TANK", sheet_box(270, 1_000, -half + 10, -460, DECK, 1_800, 5.0))
    put("EXHAUST", rod((-1_150, -800, 2_130), Z, 50, 420), BLACK)
    _draw_cab(tree, body, 458.0, half - 10)
    fit_boom_pins(k, hardware)
    return tree


def _draw_cab(tree: Assembly, body: str, right: float, left: float) -> None:
    """The cab on the left deck: its shell with windows, panes, seat and levers."""
    top, middle = v.CAB_HEIGHT.value, 0.5 * (right + left)

    def put(name: str, shape: TopoDS_Shape, colour: Colour = BLACK) -> None:
        tree.add(Part(name, shape, colour), body)

    side = [(-600.0, DECK), (1_140.0, DECK), (1_180.0, 1_900.0), (960.0, top), (-600.0, top)]
    window = [(300.0, 1_500.0, 0.0), (1_060.0, 1_500.0, 0.0), (1_090.0, 1_900.0, 0.0), (900.0, top - 90, 0.0)]
    window.append((300.0, top - 90, 0.0))
    rear = [(-520.0, 2_050.0, 0.0), (220.0, 2_050.0, 0.0), (220.0, top - 90, 0.0), (-520.0, top - 90, 0.0)]
    openings = [plate(corners, "xz", right - 1, left + 1) for corners in (window, rear)]
    openings.append(box(940, 1_300, right + 50, left - 50, 1_480, top - 70))
    put("CAB FRAME", cut(hollow([(x, z, 0.0) for x, z in side], "xz", right, left, 14.0), *openings), YELLOW)
    for name, y in (("LH", left - 10), ("RH", right + 4)):
        put(f"DOOR GLASS {name}", plate(window, "xz", y, y + 6), GLASS)
        put(f"SIDE GLASS {name}", plate(rear, "xz", y, y + 6), GLASS)
    slope = [(1_178.0, 1_900.0, 0.0), (1_184.0, 1_900.0, 0.0), (980.0, top - 70, 0.0), (974.0, top - 70, 0.0)]
    put("WINDSCREEN", plate(slope, "xz", right + 40, left - 40), GLASS)
    put("SEAT PEDESTAL", sheet_box(0, 350, middle - 150, middle + 150, DECK + 14, 1_800, 6.0), GREY)
    put("SEAT", fuse(box(-60, 440, middle - 230, middle + 230, 1_800, 1_900),
                     box(-140, -60, middle - 230, middle + 230, 1_800, 2_500)))  # fmt: skip
    put("STEERING COLUMN", rod((830, middle, DECK + 14), Z, 35, 650), GREY)
    put("STEERING WHEEL", rod((830, middle, 2_054), Z, 190, 25))
    for name, y in (("LH", middle + 260), ("RH", middle - 340)):
        put(f"CONSOLE {name}", sheet_box(0, 480, y, y + 80, DECK + 14, 2_000, 5.0), GREY)
        put(f"CONTROL LEVER {name}", rod((430, y + 40, 2_000), Z, 14, 200))
