"""What stands on the ground and what slews on it: tracks, carbody, slewing ring; base plate, cheeks of the boom's foot,
gantry, counterweight, cab. Machine frame, millimetres.

Lateral layout, from the middle: gantry's plates 190-230; boom's foot within 650, cheeks 660-700; houses 720.
"""

from __future__ import annotations

import math

from OCP.TopoDS import TopoDS_Shape

from drawing.hardware import CLEARANCE, fit_pin
from drawing.product import BLACK, GLASS, GREY, STEEL, YELLOW, Assembly, Colour, Part, add_pair
from drawing.solids import Y, Z, bored, box, cut, plate, ring, rod, sheet_box
from drawing.track import DARK, Track

from . import values as v
from .linkage import G, P

TRACK = Track(
    v.ON_GROUND.value / 2, 22, 6, v.GAUGE.value, v.SHOE.value, v.TRACK.value,
    tuple(2_000.0 - 500.0 * i for i in range(9)), 120.0, (900.0, -900.0), 70.0, "undercarriage", 2.4,
)  # fmt: skip
DECK, SEAT, FLOOR = 1_000.0, 1_130.0, 1_180.0
"""Top of the carbody; underside and top of the superstructure's base plate."""
RACE = (560.0, 680.0, 800.0)
"""Radii of the slewing ring: inside, between its races, outside."""
CHEEK, GANTRY_Y = (660.0, 700.0), (190.0, 230.0)
PIN_BOOM, PIN_GANTRY = 110.0, 100.0
CWT_Y, CWT_FRONT = 1_480.0, -2_870.0
CWT_X = -math.sqrt(v.TAIL.value**2 - CWT_Y**2)
CWT_HIGH = v.COUNTERWEIGHT.value / 7.85e-6 / (2.0 * CWT_Y * (CWT_FRONT - CWT_X))


def draw_undercarriage() -> Assembly:
    """Carbody with its axle beams, the ring's inner race, both tracks."""
    tree, body = Assembly("UNDERCARRIAGE"), "undercarriage"
    inner, between, _ = RACE
    tree.add(Part("CARBODY", sheet_box(-950, 950, -820, 820, v.CLEARANCE.value, DECK, 30.0), DARK), body)
    for x in (-850.0, 450.0):
        for side in (1.0, -1.0):
            low, high = sorted((side * 820.0, side * (TRACK.side - 42.0 * TRACK.scale)))
            tree.add(Part("AXLE BEAM", sheet_box(x, x + 400, low, high, 420, 700, 25.0), DARK), body)
    race = ring((0, 0, DECK), Z, between, inner, SEAT - DECK - 12)
    tree.add(Part("SLEWING BEARING INNER RACE", race, STEEL), body, "slewing_bearing")
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        tree.add(TRACK.draw_side(letter, sign))
    return tree


def draw_superstructure(hardware: Assembly) -> Assembly:
    """All that slews, without the boom, and the pins of the boom's foot and of the gantry's head."""
    tree, body = Assembly("SUPERSTRUCTURE"), "superstructure"
    (px, pz), (gx, gz) = (float(c) for c in P), (float(c) for c in G)
    inside, outside = CHEEK

    def put(name: str, shape: TopoDS_Shape, colour: Colour = YELLOW, role: str = "") -> None:
        tree.add(Part(name, shape, colour), body, role)

    _, between, outer = RACE
    put("SLEWING BEARING OUTER RACE", ring((0, 0, DECK + 12), Z, outer, between + CLEARANCE, SEAT - DECK - 12), STEEL)
    put("REVOLVING FRAME", box(-3_300, 1_150, -715, 715, SEAT, FLOOR))
    cheek = [(px - 450, FLOOR, 0.0), (px + 140, FLOOR, 0.0), (px, pz, 140.0)]
    add_pair(tree, "BOOM FOOT CHEEK", bored(plate(cheek, "xz", inside, outside), Y, ((px, 0, pz), PIN_BOOM / 2)), body)
    fit_pin(hardware, (px, -outside - 10, pz), PIN_BOOM, 2 * outside + 20, body, "boom_pin")
    _draw_gantry(tree, hardware, (gx, gz))
    low = FLOOR
    put("COUNTERWEIGHT", box(CWT_X, CWT_FRONT, -CWT_Y, CWT_Y, low, low + CWT_HIGH), GREY, "counterweight")
    for name, x in (("BOOM HOIST DRUM", -1_100.0), ("MAIN HOIST DRUM", -250.0)):
        put(name, rod((x, -150, FLOOR + 210), Y, 210, 300), BLACK)
    put("DECK LH", sheet_box(-2_800, 1_150, 715, 1_500, SEAT, FLOOR, 8.0))
    put("DECK RH", sheet_box(-2_800, 1_150, -1_500, -715, SEAT, FLOOR, 8.0))
    put("ENGINE HOUSE", sheet_box(-2_800, -400, 720, 1_500, FLOOR, 2_400, 5.0))
    put("ENGINE", sheet_box(-2_500, -900, 800, 1_400, FLOOR + 5, 2_000, 40.0), GREY)
    put("FUEL TANK", sheet_box(-2_800, 100, -1_500, -720, FLOOR, 2_200, 6.0), BLACK)
    _draw_cab(tree, body)
    return tree


def _draw_gantry(tree: Assembly, hardware: Assembly, at: tuple[float, float]) -> None:
    """The A-frame: two plates with the window between their legs, tied at the foot, and the pin of its sheaves."""
    x, z = at
    low, high = GANTRY_Y
    side = [(x - 250.0, FLOOR, 0.0), (x + 1_250.0, FLOOR, 0.0), (x, z, v.GANTRY.value - z)]
    window = [(x - 60.0, FLOOR + 250, 0.0), (x + 900.0, FLOOR + 250, 0.0), (x + 30.0, z - 450, 0.0)]
    shape = cut(plate(side, "xz", low, high), plate(window, "xz", low - 1, high + 1))
    shape = bored(shape, Y, ((x, 0, z), PIN_GANTRY / 2))
    for name, sign in (("LH", 1.0), ("RH", -1.0)):
        one = shape if sign > 0.0 else bored(
            cut(plate(side, "xz", -high, -low), plate(window, "xz", -high - 1, 1 - low)), Y, ((x, 0, z), PIN_GANTRY / 2)
        )  # fmt: skip
        tree.add(Part(f"GANTRY {name}", one), "superstructure", "gantry")
    tie = box(x + 300, x + 400, -low, low, FLOOR, FLOOR + 240)
    tree.add(Part("GANTRY TIE", tie), "superstructure", "gantry")
    fit_pin(hardware, (x, -high - 10, z), PIN_GANTRY, 2 * high + 20, "superstructure", "boom_hoist_rope_pin")


def _draw_cab(tree: Assembly, body: str) -> None:
    low, top = FLOOR, 3_000.0
    outline = [(250.0, low, 0.0), (1_150.0, low, 0.0), (1_500.0, 1_900.0, 0.0), (1_350.0, top, 0.0), (250.0, top, 0.0)]
    pane = [(400.0, 1_900.0, 0.0), (1_350.0, 1_900.0, 0.0), (1_250.0, top - 130, 0.0), (400.0, top - 130, 0.0)]
    for name, y in (("OUTER", 1_480.0), ("INNER", 720.0)):
        shape = cut(plate(outline, "xz", y, y + 20), plate(pane, "xz", y - 1, y + 21))
        tree.add(Part(f"CAB SIDE {name}", shape), body)
        tree.add(Part(f"SIDE GLASS {name}", plate(pane, "xz", y + 7, y + 13), GLASS), body)
    tree.add(Part("CAB FLOOR", box(250, 1_150, 740, 1_480, low, low + 30), GREY), body)
    tree.add(Part("CAB ROOF", box(250, 1_350, 740, 1_480, top - 30, top)), body)
    tree.add(Part("SEAT", sheet_box(400, 900, 850, 1_350, low + 30, low + 550, 3.0), BLACK), body)
