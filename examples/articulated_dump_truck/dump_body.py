"""The dump body, drawn lowered. Machine frame, millimetres."""

from __future__ import annotations

from drawing.hardware import CLEARANCE, fit_pin
from drawing.product import GREY, YELLOW, Assembly, Colour, Part, add_pair
from drawing.solids import Y, bored, box, plate

from . import values as v
from .layout import FLOOR, HEAD_TOP, HEAD_X, HOIST_Y, TAIL, TAIL_LOW, TIPPER, solve_hoist
from .trailer import HOIST_EARS, PIN_BODY, PIN_HOIST, RAIL

BODY = "dump_body"
SHEET, RIB = 18.0, 50.0
"""Thickness of floor and sides; how far the ribs stand out."""
INNER = v.BODY_WIDTH.value / 2 - RIB - SHEET
"""Half of the width inside."""


def draw_body(raised: float, hardware: Assembly) -> Assembly:
    """Floor, sides, headboard, ribs and rails; beneath it sills, the hinge's ears, lugs of the hoist cylinders."""
    lowered, (hx, hz), (dx, dz) = Assembly("DUMP BODY"), TIPPER.hinge, solve_hoist().D
    tail, top = TAIL_LOW, v.LOADING_HEIGHT.value

    def put(name: str, low: float, high: float, outline: list[tuple[float, float]], colour: Colour = YELLOW) -> None:
        lowered.add(Part(name, plate([(x, z, 0.0) for x, z in outline], "xz", low, high), colour), BODY)

    knee, front = (hx, FLOOR), (HEAD_X, FLOOR)
    floor = [(TAIL, tail), knee, front, (HEAD_X, FLOOR + SHEET), (hx, FLOOR + SHEET), (TAIL, tail + SHEET)]
    put("BODY FLOOR", -INNER, INNER, floor)
    side = [(TAIL, tail), knee, front, (HEAD_X, top), (hx, top), (TAIL + 150, tail + 500)]
    shape = plate([(x, z, 0.0) for x, z in side], "xz", INNER, INNER + SHEET)
    add_pair(lowered, "BODY SIDE", shape, BODY)
    for x in (-4600.0, -3600.0, -2600.0, -1600.0, -600.0):
        rib = box(x - 60, x, INNER + SHEET, INNER + SHEET + RIB, FLOOR, top - 60)
        add_pair(lowered, "BODY RIB", rib, BODY)
    add_pair(lowered, "TOP RAIL", box(hx, HEAD_X, INNER + SHEET, INNER + SHEET + RIB, top - 60, top), BODY)
    head = HEAD_TOP
    put("HEADBOARD", -INNER, INNER, [(HEAD_X - SHEET, FLOOR + SHEET), (HEAD_X, FLOOR + SHEET), (HEAD_X, head),
                                     (HEAD_X - SHEET, head)])  # fmt: skip
    inside, outside, _, high = RAIL
    add_pair(lowered, "BODY SILL", box(hx + 420, HEAD_X - 250, inside, outside, high + 30, FLOOR), BODY, GREY)
    for x in (-4300.0, -3200.0, -1400.0):
        lowered.add(Part("BODY X-BEARER", box(x, x + 120, -inside, inside, FLOOR - 200, FLOOR), GREY), BODY)
    for name, low, end in (("IN", inside - 60, inside - 10), ("OUT", outside + 10, outside + 60)):
        ear = plate([(hx, hz, 120), (hx + 400, FLOOR, 0), (hx - 250, FLOOR, 0)], "xz", low, end)
        shape = bored(ear, Y, ((hx, 0, hz), PIN_BODY / 2 + CLEARANCE))
        add_pair(lowered, f"HINGE EAR {name}", shape, BODY)
    for name, (low, end) in zip(("IN", "OUT"), HOIST_EARS, strict=True):
        lug = plate([(dx, dz, 75), (dx + 120, FLOOR, 0), (dx - 120, FLOOR, 0)], "xz", low, end)
        add_pair(lowered, f"HOIST LUG {name}", bored(lug, Y, ((dx, 0, dz), PIN_HOIST / 2)), BODY)
    tree = TIPPER.raise_parts(lowered, raised)
    x, z = (float(c) for c in TIPPER.carry(raised, solve_hoist().D))
    half = HOIST_EARS[1][1] + 10 - HOIST_Y
    for letter, y in (("l", HOIST_Y), ("r", -HOIST_Y)):
        fit_pin(hardware, (x, y - half, z), PIN_HOIST, 2 * half, BODY, f"hoist_piston_rod_{letter}_pin")
    return tree
