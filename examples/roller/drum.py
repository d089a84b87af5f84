"""The drums and the frames about them. Machine frame, millimetres.

A drum is a shell on two heads, which its exciter's housing joins; its journals turn in the side plates of a frame that
goes all round it.
"""

from __future__ import annotations

from drawing.product import GREY, STEEL, YELLOW, Assembly, Part, add_pair
from drawing.solids import X, Y, Z, bored, box, cut, fuse, plate, ring, rod

from . import values as v
from .layout import DRUM, HALF, ROLL_Z

JOURNAL = 80.0
CLEARANCE = 0.2
HEAD = 820.0
"""How far from the middle the heads are."""
SIDE = (HALF + 25.0, v.OVERALL_WIDTH.value / 2)
"""Inner and outer face of a frame's side plates."""
BEAM = (760.0, 850.0)
"""Where the cross beams are, ahead of and behind the drum's axis."""
LOW, HIGH = 900.0, 1200.0
TUBE, RING = 160.0, 235.0
"""Radius of the tube that rolls in the hitch's ring; of the ring outside."""


def draw_drum(body: str, x: float) -> Assembly:
    """Shell, heads, exciter's housing and journals about the axis at `x`."""
    tree = Assembly(body.replace("_", " ").upper())
    inner = DRUM - v.SHELL.value
    tree.add(Part("DRUM SHELL", ring((x, -HALF, DRUM), Y, DRUM, inner, 2 * HALF), STEEL), body)
    for name, y in (("LH", HEAD), ("RH", -HEAD - 30)):
        head = ring((x, y, DRUM), Y, inner, JOURNAL, 30)
        holes = [((x + dx, 0.0, DRUM + dz), 60.0) for dx, dz in ((330.0, 0.0), (-330.0, 0.0), (0.0, 330.0))]
        tree.add(Part(f"DRUM HEAD {name}", bored(head, Y, *holes), GREY), body)
        start = y if y > 0 else -SIDE[1]
        tree.add(Part(f"JOURNAL {name}", rod((x, start, DRUM), Y, JOURNAL, SIDE[1] - HEAD), STEEL), body)
    tree.add(Part("EXCITER HOUSING", ring((x, -HEAD, DRUM), Y, 170, 150, 2 * HEAD), GREY), body)
    return tree


def draw_frame(body: str, x: float, *, tube: bool = False) -> Assembly:
    """Side plates with the bearings, cross beams ahead and behind; with a `tube`, which rolls, on the rear one."""
    tree = Assembly(f"{body.replace('_', ' ').upper()} WELDMENT")
    low, (near, far) = v.CURB_CLEARANCE.value, BEAM
    outline = [(x, DRUM, DRUM - low), (x + far, LOW, 0), (x + far, HIGH, 0), (x - far, HIGH, 0), (x - far, LOW, 0)]
    side = bored(plate(outline, "xz", *SIDE), Y, ((x, 0, DRUM), JOURNAL + CLEARANCE))
    add_pair(tree, "DRUM FRAME SIDE PL", side, body)
    tree.add(Part("X-BEAM FRT", box(x + near, x + far, -SIDE[0], SIDE[0], LOW, HIGH)), body)
    beam = box(x - far, x - near, -SIDE[0], SIDE[0], LOW - 20, HIGH)
    if tube:
        start = 430.0
        beam = fuse(beam, rod((start, 0, ROLL_Z), X, TUBE, x - near - start))
        beam = bored(beam, X, ((0, 0, ROLL_Z), TUBE - 35))
    tree.add(Part("X-BEAM RR", beam), body)
    return tree


def draw_scrapers(body: str, x: float, ahead: float) -> Assembly:
    """The scraper on one of the cross beams, clear of the drum."""
    tree = Assembly("SCRAPER ASSY")
    z, at = LOW + 60.0, x + ahead * BEAM[0]
    start, end = sorted((at, at - ahead * 70.0))
    tree.add(Part("SCRAPER BAR", box(start, end, -HALF + 60, HALF - 60, z + 40, z + 60), GREY), body)
    return tree


def draw_tank(body: str, x: float) -> Assembly:
    """The water tank over the drum, on posts on the cross beams."""
    tree = Assembly("WATER TANK ASSY")
    near, far = BEAM
    for name, start in (("FRT", x + near), ("RR", x - far)):
        add_pair(tree, f"TANK POST {name}", box(start, start + far - near, 600, 700, HIGH, 1440), body, GREY)
    shell = cut(box(x - far, x + far, -900, 900, 1440, 1760), box(x - far + 8, x + far - 8, -892, 892, 1448, 1752))
    tree.add(Part("WATER TANK", shell, YELLOW), body)
    tree.add(Part("FILLER CAP", rod((x + 500, 500, 1760), Z, 80, 40), GREY), body)
    return tree
