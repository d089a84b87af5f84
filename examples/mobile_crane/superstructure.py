"""What slews on the carrier: ring, base plate, cheeks that carry the boom and its luffing cylinder, counterweight,
winch, cab. Machine frame, millimetres.

Lateral layout, from the middle: luffing cylinder's eyes within 100, their bosses from 108 on; boom within 226; cheeks
235-275; cab beside the boom.
"""

from __future__ import annotations

import math

from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import CLEARANCE, fit_pin
from drawing.product import BLACK, GLASS, GREY, STEEL, YELLOW, Assembly, Colour, Part, add_pair
from drawing.solids import Y, Z, bored, box, cut, plate, ring, rod, sheet_box

from . import values as v
from .carrier import DECK, RING, SEAT
from .linkage import P, barrel

BODY = "superstructure"
CHEEK = (235.0, 275.0)
PIN_BOOM, PIN_LUFFING = 140.0, 120.0
FLOOR = DECK + 40.0
BALLAST_Y, BALLAST = 900.0, 60.0
BALLAST_X = -math.sqrt(v.TAIL.value**2 - BALLAST_Y**2)


def draw_superstructure(hardware: Assembly) -> Assembly:
    """All of it, and the pins of the boom and of the luffing barrel."""
    tree = Assembly("SUPERSTRUCTURE")
    (px, pz), (cx, cz) = (float(c) for c in P), barrel()
    inside, outside = CHEEK

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW, role: str = "") -> None:
        tree.add(Part(name, shape, colour), BODY, role)

    _, between, outer = RING
    put("SLEWING BEARING OUTER RACE", ring((0, 0, SEAT + 12), Z, outer, between + CLEARANCE, DECK - SEAT - 12), STEEL)
    put("BASE PLATE", box(-2_300, 1_900, -650, 650, DECK, FLOOR))
    side = [(px - 120, FLOOR, 0.0), (-1_220.0, FLOOR, 0.0), (px, pz, 190.0)]
    cheek = bored(plate(side, "xz", inside, outside), Y, ((px, 0, pz), PIN_BOOM / 2), ((cx, 0, cz), PIN_LUFFING / 2))
    add_pair(tree, "BOOM CHEEK", cheek, BODY)
    add_pair(tree, "LUFFING CYL BOSS", ring((cx, 108, cz), Y, 110, PIN_LUFFING / 2, inside - 108), BODY)
    ballast = box(BALLAST_X, -2_310, outside, BALLAST_Y, FLOOR, FLOOR + BALLAST)
    for name, sign in (("LH", 1.0), ("RH", -1.0)):
        shape = ballast if sign > 0.0 else box(BALLAST_X, -2_310, -BALLAST_Y, -outside, FLOOR, FLOOR + BALLAST)
        put(f"COUNTERWEIGHT {name}", shape, GREY, "counterweight")
    put("MAIN WINCH DRUM", rod((px - 20, -inside, 1_950), Y, 130, 2 * inside), BLACK)
    fit_pin(hardware, (px, -outside - 10, pz), PIN_BOOM, 2 * outside + 20, BODY, "boom_pin")
    fit_pin(hardware, (cx, -outside - 10, cz), PIN_LUFFING, 2 * outside + 20, BODY, "luffing_cylinder_barrel_pin")
    _draw_cab(put)
    put("CONTROL BOX", sheet_box(-1_250, 350, 300, 1_150, FLOOR, 2_000, 5.0))
    put("OIL COOLER", sheet_box(-1_250, 1_700, -1_150, -300, FLOOR, 2_050, 5.0))
    return tree


def _draw_cab(put: object) -> None:
    assert callable(put)
    low, top = FLOOR, v.HEIGHT.value
    outline = [(380.0, low, 0.0), (1_880.0, low, 0.0), (1_700.0, top, 0.0), (450.0, top, 0.0)]
    pane = [(500.0, 2_150.0, 0.0), (1_740.0, 2_150.0, 0.0), (1_640.0, top - 130, 0.0), (540.0, top - 130, 0.0)]
    for name, y in (("OUTER", 1_230.0), ("INNER", 300.0)):
        put(f"CAB SIDE {name}", cut(plate(outline, "xz", y, y + 20), plate(pane, "xz", y - 1, y + 21)), YELLOW)
        put(f"SIDE GLASS {name}", plate(pane, "xz", y + 7, y + 13), GLASS)
    put("CAB FLOOR", box(380, 1_880, 320, 1_230, low, low + 30), GREY)
    put("CAB ROOF", box(450, 1_700, 320, 1_230, top - 30, top), YELLOW)
    front = [(1_874.0, low + 30, 0.0), (1_880.0, low + 30, 0.0), (1_705.0, top - 30, 0.0), (1_699.0, top - 30, 0.0)]
    put("FRONT GLASS", plate(front, "xz", 330, 1_220), GLASS)
    put("SEAT", sheet_box(650, 1_150, 520, 1_030, low + 30, low + 500, 3.0), BLACK)
