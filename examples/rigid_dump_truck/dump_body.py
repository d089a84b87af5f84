"""The dual slope body with its canopy, drawn lowered. Machine frame, millimetres."""

from __future__ import annotations

from drawing.hardware import CLEARANCE, fit_pin
from drawing.product import GREY, YELLOW, Assembly, Colour, Part, add_pair
from drawing.solids import Y, bored, box, plate

from . import values as v
from .chassis import HOIST_EARS, PIN_BODY, PIN_HOIST, RAIL
from .layout import CANOPY_X, FLOOR, HOIST_Y, TAIL, TAIL_LOW, TIPPER, solve_hoist

BODY = "dump_body"
SHEET, RIB = 20.0, 90.0
INNER = v.BODY_WIDTH.value / 2 - RIB - SHEET
"""Half of the width inside."""
HEAD_X = 3520.0


def draw_body(raised: float, hardware: Assembly) -> Assembly:
    """Floor, sides, front wall, canopy, ribs; beneath it sills, the hinge's ears, lugs of the hoist cylinders."""
    lowered, (dx, dz) = Assembly("DUMP BODY"), solve_hoist().D
    hx, hz = (float(c) for c in TIPPER.hinge)
    rim, roof, (inside, outside, _, high) = v.LOADING_HEIGHT.value, v.CANOPY_HEIGHT.value, RAIL

    def put(name: str, low: float, end: float, outline: list[tuple[float, float]], colour: Colour = YELLOW) -> None:
        lowered.add(Part(name, plate([(x, z, 0.0) for x, z in outline], "xz", low, end), colour), BODY)

    knee, front = (hx + 600, FLOOR), (HEAD_X, FLOOR)

    def under(x: float) -> float:
        """Height of the sloping floor's underside behind the knee."""
        return FLOOR + (TAIL_LOW - FLOOR) * (knee[0] - x) / (knee[0] - TAIL)

    floor = [(TAIL, TAIL_LOW), knee, front, (HEAD_X, FLOOR + SHEET), (knee[0], FLOOR + SHEET), (TAIL, TAIL_LOW + SHEET)]
    put("BODY FLOOR", -INNER, INNER, floor)
    top = roof - 60
    wall = [(HEAD_X - SHEET, FLOOR + SHEET), (HEAD_X, FLOOR + SHEET), (HEAD_X, top), (HEAD_X - SHEET, top)]
    put("FRONT WALL", -INNER, INNER, wall)
    side = [(TAIL, TAIL_LOW), knee, front, (HEAD_X, top), (2000.0, rim), (TAIL + 700, rim), (TAIL, TAIL_LOW + 700)]
    shape = plate([(x, z, 0.0) for x, z in side], "xz", INNER, INNER + SHEET)
    add_pair(lowered, "BODY SIDE", shape, BODY)
    for x in (-1600.0, -500.0, 700.0, 1900.0):
        add_pair(lowered, "BODY RIB", box(x, x + 140, INNER + SHEET, INNER + SHEET + RIB, 2250, rim - 60), BODY)
    add_pair(lowered, "TOP RAIL", box(TAIL + 700, 2000, INNER + SHEET, INNER + SHEET + RIB, rim - 60, rim), BODY)
    half = v.CANOPY_WIDTH.value / 2
    lowered.add(Part("CANOPY", box(HEAD_X - SHEET, CANOPY_X, -half, half, top, roof)), BODY)
    for y in (-700.0, 680.0):
        gusset = [(HEAD_X, 3900.0), (HEAD_X + 300, top), (HEAD_X, top)]
        put("CANOPY GUSSET", y, y + 20, gusset)
    add_pair(lowered, "BODY SILL", box(hx + 500, HEAD_X - 200, inside, outside, high + 40, FLOOR), BODY, GREY)
    for x in (0.0, 1500.0, 2900.0):
        lowered.add(Part("BODY X-BEARER", box(x, x + 140, -inside, inside, 1700, FLOOR), GREY), BODY)
    for name, low, end in (("IN", inside - 65, inside - 12), ("OUT", outside + 12, outside + 65)):
        ear = plate([(hx, hz, 130), (hx + 450, under(hx + 450), 0), (hx - 100, under(hx - 100), 0)], "xz", low, end)
        add_pair(lowered, f"HINGE EAR {name}", bored(ear, Y, ((hx, 0, hz), PIN_BODY / 2 + CLEARANCE)), BODY)
    for name, (low, end) in zip(("IN", "OUT"), HOIST_EARS, strict=True):
        lug = plate([(dx, dz, 80), (dx + 150, FLOOR, 0), (dx - 150, FLOOR, 0)], "xz", low, end)
        add_pair(lowered, f"HOIST LUG {name}", bored(lug, Y, ((dx, 0, dz), PIN_HOIST / 2)), BODY)
    x, z = (float(c) for c in TIPPER.carry(raised, solve_hoist().D))
    long = HOIST_EARS[1][1] + 8 - HOIST_Y
    for letter, y in (("l", HOIST_Y), ("r", -HOIST_Y)):
        fit_pin(hardware, (x, y - long, z), PIN_HOIST, 2 * long, BODY, f"hoist_piston_rod_{letter}_pin")
    return TIPPER.raise_parts(lowered, raised)
