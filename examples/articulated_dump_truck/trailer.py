"""Hitch, rear frame and bogie. Machine frame, millimetres.

The hitch turns on two upright pins in the tractor's forks; the rear frame's tube turns in the hitch's ring. The bogie's
beams rock on pins in the rear frame and carry the wheels; the axles' middles hang on the rear frame.
"""

from __future__ import annotations

from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import CLEARANCE, bush, fit_pin
from drawing.product import GREY, RED, STEEL, Assembly, Part, add_pair
from drawing.solids import X, Y, Z, bored, box, cut, fuse, mirrored, moved, plate, ring, rod, shift, turn, turned

from . import values as v
from .layout import BOGIE_X, HOIST_Y, MIDDLE_X, RADIUS, REAR_X, ROLL_Z, STEER_Z, TIPPER, solve_hoist, solve_steering

PIN_ARTICULATION, PIN_STEER, PIN_HOIST, PIN_BODY, PIN_BOGIE = 110.0, 50.0, 90.0, 100.0, 160.0
SPINDLE = 95.0
"""Radius of what the wheels turn on."""
HITCH_PLATES = ((950.0, 1030.0), (1400.0, 1480.0))
"""Heights of the hitch's lower and upper plate."""
STEER_EARS = (("LWR", STEER_Z - 75.0), ("UPR", STEER_Z + 45.0))
JOURNAL = 200.0
"""Radius of the rear frame's tube."""
HOIST_EYE = 120.0
"""Width of the hoist cylinders' eyes."""
HOIST_EARS = ((HOIST_Y - 95.0, HOIST_Y - 65.0), (HOIST_Y + 65.0, HOIST_Y + 95.0))
RAIL = (400.0, 480.0, 1100.0, 1420.0)
"""Inside, outside, underside, top."""
BEAM = (780.0, 880.0)


def draw_hitch(hardware: Assembly) -> Assembly:
    """Two plates on the upright pins, a wall behind them with ears for the steering cylinders, the ring."""
    tree, body = Assembly("HITCH ASSY"), "hitch"
    wall = -340.0
    for (low, high), name in zip(HITCH_PLATES, ("HITCH PL LWR", "HITCH PL UPR"), strict=True):
        shape = plate([(0, 0, 150), (wall, 330, 0), (wall, -330, 0)], "xy", low, high)
        tree.add(Part(name, bored(shape, Z, ((0, 0, 0), 75.0))), body)
        tree.add(bush(150, PIN_ARTICULATION, high - low), body, at=shift(0, 0, low).Multiplied(turn(X, 90.0)))
    tree.add(Part("HITCH WALL", box(wall - 80, wall, -400, 400, HITCH_PLATES[0][0], HITCH_PLATES[1][1])), body)
    qx, qy = solve_steering().Q
    for name, start in STEER_EARS:
        ear = plate([(qx, qy, 52), (wall, qy + 60, 0), (wall, qy - 90, 0)], "xy", start, start + 30)
        add_pair(tree, f"STRG EAR {name}", bored(ear, Z, ((qx, qy, 0), PIN_STEER / 2)), body)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        role = f"steering_piston_rod_{letter}_pin"
        fit_pin(hardware, (qx, sign * qy, STEER_Z - 80), PIN_STEER, 160, body, role, upright=True)
    housing = ring((-760, 0, ROLL_Z), X, 290, JOURNAL + CLEARANCE, 760 + wall - 80)
    tree.add(Part("ROLL BEARING HOUSING", housing, GREY), body)
    return tree


def draw_rear_frame(hardware: Assembly) -> Assembly:
    """Tube, rails, brackets of the bogie and of the hoist cylinders, axle middles, the body's hinge."""
    tree, body = Assembly("REAR FRAME ASSY"), "rear_frame"
    inside, outside, low, high = RAIL
    head = fuse(box(-940, -900, -outside, outside, 930, 1430), rod((-900, 0, ROLL_Z), X, JOURNAL, 440))
    tree.add(Part("FRAME HEAD", bored(head, X, ((0, 0, ROLL_Z), 160.0))), body)
    hx, hz = TIPPER.hinge
    side = plate(
        [(-940, low, 0), (-940, high, 0), (hx + 280, high, 0), (hx, hz, 140), (hx, low, 0)], "xz", inside, outside
    )
    add_pair(tree, "RR RAIL", bored(side, Y, ((hx, 0, hz), PIN_BODY / 2)), body)
    for x in (-1300.0, -2800.0, -4400.0):
        tree.add(Part("X-MEMBER", box(x - 40, x, -inside, inside, low + 40, high - 40)), body)
    tree.add(Part("TAIL PL", box(hx - 40, hx, -inside, inside, low + 20, 1320)), body)
    for name, y in (("LH", 200.0), ("RH", -300.0)):
        tree.add(Part(f"REAR LAMP {name}", box(hx - 60, hx - 40, y, y + 100, 1200, 1280), RED), body)
    add_pair(tree, "BODY REST", box(-1100, -950, inside, outside, high, high + 18), body, GREY)
    add_pair(tree, "BOGIE BRKT", _bogie_bracket(), body)
    carrier = ring((BOGIE_X, outside, RADIUS), Y, 130, PIN_BOGIE / 2, BEAM[0] - 15 - outside)
    add_pair(tree, "BOGIE TRUNNION", carrier, body, GREY)
    c = solve_hoist().C
    cx, cz = float(c[0]), float(c[1])
    add_pair(tree, "HOIST BRKT", box(cx + 100, cx + 140, outside, HOIST_EARS[1][1], 900, 1250), body)
    for name, (y0, y1) in zip(("IN", "OUT"), HOIST_EARS, strict=True):
        ear = plate([(cx, cz, 95), (cx + 100, 905, 0), (cx + 100, 1120, 0)], "xz", y0, y1)
        add_pair(tree, f"HOIST EAR {name}", bored(ear, Y, ((cx, 0, cz), PIN_HOIST / 2)), body)
    for name, x in (("MID", MIDDLE_X), ("RR", REAR_X)):
        _axle_middle(tree, name, x, body)
    shaft = rod((REAR_X + 300, 0, RADIUS), X, 50, MIDDLE_X - REAR_X - 600)
    tree.add(Part("PROP SHAFT", shaft, STEEL), body)
    for letter, sign in (("l", 1.0), ("r", -1.0)):

        def across(role: str, x: float, z: float, size: float, start: float, end: float, sign: float = sign) -> None:
            fit_pin(hardware, (x, start if sign > 0 else -end, z), size, end - start, body, role)

        across("dump_body_pin", hx, hz, PIN_BODY, inside - 75, outside + 75)
        across(f"hoist_cylinder_barrel_{letter}_pin", cx, cz, PIN_HOIST, HOIST_EARS[0][0] - 10, HOIST_EARS[1][1] + 10)
        across(f"bogie_beam_{letter}_pin", BOGIE_X, RADIUS, PIN_BOGIE, inside - 10, BEAM[1] + 10)
    return tree


def _bogie_bracket() -> TopoDS_Shape:
    inside, outside, low, _ = RAIL
    shape = plate([(BOGIE_X, RADIUS, 170), (BOGIE_X + 350, low, 0), (BOGIE_X - 350, low, 0)], "xz", inside, outside)
    return bored(shape, Y, ((BOGIE_X, 0, RADIUS), PIN_BOGIE / 2))


def housing(left: list[tuple[float, float]], tube: float, hollow: float) -> TopoDS_Shape:
    """An axle's hollow housing about the origin along y: `left` is its profile from the left end inwards, to where it
    is a tube of that radius; hollow so far from the middle."""
    ball, wall = RADIUS - v.GROUND_CLEARANCE.value, 25.0
    left = [*left, (230.0, tube), (170.0, ball)]
    inside = [(hollow, 0.0), (hollow, tube - wall), (220.0, tube - wall), (160.0, ball - wall)]
    outer, inner = (turned([*half, *[(-s, q) for s, q in reversed(half)]]) for half in (left, inside))
    return cut(outer, inner)


def _axle_middle(tree: Assembly, name: str, x: float, body: str) -> None:
    """An axle's differential with short tubes, its pads under the rails."""
    inside, outside, low, _ = RAIL
    case = moved(housing([(outside, 0.0), (outside, 120.0)], 120.0, outside - 30), shift(x, 0, RADIUS))
    pads = [box(x - 120, x + 120, y, y + outside - inside, RADIUS, low) for y in (inside, -outside)]
    tree.add(Part(f"AXLE CASE {name}", fuse(case, *pads), GREY), body)


def draw_bogie() -> Assembly:
    """A beam on either side, with a spindle for a wheel at either end."""
    tree, half = Assembly("BOGIE"), v.BOGIE_SPACING.value / 2
    end = v.REAR_TREAD.value / 2 + 60
    outline = [(BOGIE_X - half, RADIUS, 150.0), (BOGIE_X + half, RADIUS, 150.0), (BOGIE_X, RADIUS + 30, 200.0)]
    beam = plate(outline, "xz", *BEAM)
    for x in (MIDDLE_X, REAR_X):
        flange, neck = rod((x, BEAM[1], RADIUS), Y, 140, 50), rod((x, BEAM[1], RADIUS), Y, SPINDLE, end - BEAM[1])
        beam = fuse(beam, flange, neck)
    beam = bored(beam, Y, ((BOGIE_X, 0, RADIUS), PIN_BOGIE / 2 + CLEARANCE))
    for letter, shape in (("l", beam), ("r", mirrored(beam))):
        tree.add(Part(f"BOGIE BEAM {letter.upper()}H", shape), f"bogie_beam_{letter}")
    return tree
