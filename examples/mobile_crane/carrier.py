"""The carrier: rails, axles' mounts, boxes of the outriggers with beams and jacks, the slewing ring's inner race,
engine and tanks. Machine frame, millimetres.

Lateral layout, from the middle: rails 350-450; boxes of the beams under them, those of the left beams ahead of those
of the right ones; wheels outside 892.
"""

from __future__ import annotations

from OCP.gp import gp_Trsf
from OCP.TopoDS import TopoDS_Shape

from drawing.cylinders import Ram, draw_ram
from drawing.product import BLACK, GREY, STEEL, YELLOW, Assembly, Colour, Part, Use, add_pair
from drawing.solids import X, Z, box, cut, ring, rod, sheet_box, shift, turn

from . import values as v
from .linkage import HALF_BASE, RADIUS, Pose

BODY = "carrier"
RAIL = (350.0, 450.0, 760.0, 1_150.0)
"""Inside, outside, underside, top."""
REAR, FRONT = -4_030.0, 3_615.0
ENDS = {"front": HALF_BASE + 1_325.0, "rear": HALF_BASE + 1_325.0 - v.BASE.value}
"""x of the outriggers, in the middle between left and right."""
ASIDE, WIDE, HIGH, LOOSE, WALL = 130.0, 100.0, 130.0, 5.0, 12.0
"""Of a beam: from the outriggers' middle; half its width and height; the room about it; its walls and its box's."""
BEAM_Z = RAIL[2] - HIGH - LOOSE - WALL
FLOAT_Y = v.SPREAD.value / 2 - v.BEAM_STROKE.value
"""Middle of a float, drawn in."""
BOX_Y, TAIL_Y, END_Y = 1_050.0, 1_290.0, FLOAT_Y - 90.0
JACK_TOP, FLOAT = 1_130.0, (150.0, 60.0)
RING = (450.0, 600.0, 720.0)
"""Of the slewing ring: radii inside, between its races, outside."""
SEAT, DECK = 1_300.0, 1_420.0
"""Underside of the slewing ring's races; of the superstructure."""


def jack(out: float) -> Ram:
    """A jack's cylinder, out by so much."""
    return Ram("JACK CYL", v.JACK_BORE.value, v.JACK_ROD.value, v.JACK_STROKE.value, out, 150.0, 720.0)


def beam_ram(out: float) -> Ram:
    """An outrigger beam's cylinder."""
    long = END_Y - 15.0 + TAIL_Y + 5.0
    return Ram("BEAM CYL", v.BEAM_BORE.value, v.BEAM_ROD.value, v.BEAM_STROKE.value, out, 80.0, long)


GROUNDED = (JACK_TOP - 720.0 - FLOAT[1]) / v.JACK_STROKE.value
"""The share that the jacks are out with their floats on the ground on which the tyres stand."""


def draw_outriggers(end: str, pose: Pose) -> Assembly:
    """Both outriggers at one end of the carrier."""
    tree = Assembly(f"{end.upper()} OUTRIGGERS")
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        _outrigger(tree, f"{end}_outrigger", letter, (ENDS[end] + sign * ASIDE, sign), pose)
    return tree


def _outrigger(tree: Assembly, name: str, letter: str, at: tuple[float, float], pose: Pose) -> None:
    """Box, beam and jack, drawn for the left side and turned about the upright for the right one."""
    x, sign = at
    place = shift(x, 0, 0) if sign > 0.0 else shift(x, 0, 0).Multiplied(turn(Z, 180.0))
    side, out = {"l": "LH", "r": "RH"}[letter], pose.beam * v.BEAM_STROKE.value
    beam, foot = f"{name}_beam_{letter}", f"{name}_jack_{letter}"

    def put(title: str, shape: TopoDS_Shape, body: str, colour: Colour = YELLOW, moved: float = 0.0) -> None:
        tree.add(Part(f"{title} {side}", shape, colour), body, at=place.Multiplied(shift(0, moved, 0)))

    wide, high = WIDE + LOOSE, HIGH + LOOSE
    outer = box(-wide - WALL, wide + WALL, -BOX_Y, BOX_Y, BEAM_Z - high - WALL, BEAM_Z + high + WALL)
    put("OUTRIGGER BOX", cut(outer, box(-wide, wide, -BOX_Y - 1, BOX_Y + 1, BEAM_Z - high, BEAM_Z + high)), BODY, GREY)
    back = TAIL_Y + LOOSE
    put("BEAM CYL BRKT", box(-60, 60, -back - 15, -BOX_Y, BEAM_Z + high, BEAM_Z + high + WALL), BODY, GREY)
    put("BEAM CYL BASE PL", box(-60, 60, -back - 15, -back, BEAM_Z - 60, BEAM_Z + high), BODY, GREY)
    hollow = box(-WIDE + WALL, WIDE - WALL, -TAIL_Y - 1, END_Y - 15, BEAM_Z - HIGH + WALL, BEAM_Z + HIGH - WALL)
    put("OUTRIGGER BEAM", cut(box(-WIDE, WIDE, -TAIL_Y, END_Y, BEAM_Z - HIGH, BEAM_Z + HIGH), hollow), beam, moved=out)
    head = box(-90, 90, END_Y, FLOAT_Y, BEAM_Z - HIGH, BEAM_Z + HIGH)
    put("JACK HOUSING", cut(head, rod((0, FLOAT_Y, 0), Z, 75.0, 2_000.0)), beam, moved=out)
    names = {"barrel": BODY, "rod": beam, "barrel_role": f"{name}_beam_barrel_{letter}",
             "rod_role": f"{name}_beam_rod_{letter}"}  # fmt: skip
    along = place.Multiplied(shift(0, -back, BEAM_Z)).Multiplied(turn(X, -90.0))
    tree.uses.append(Use(draw_ram(beam_ram(out)), along, names=names))
    down = pose.jack * v.JACK_STROKE.value
    names = {"barrel": beam, "rod": foot, "barrel_role": f"{name}_jack_barrel_{letter}",
             "rod_role": f"{name}_jack_rod_{letter}"}  # fmt: skip
    upright = place.Multiplied(shift(0, FLOAT_Y + out, JACK_TOP)).Multiplied(turn(X, 180.0))
    tree.uses.append(Use(draw_ram(jack(down)), upright, names=names))
    radius, thick = FLOAT
    put("FLOAT", rod((0, FLOAT_Y, JACK_TOP - 720.0 - down - thick), Z, radius, thick), foot, STEEL, out)


def place_of(end: str, letter: str, pose: Pose) -> tuple[float, float]:
    """x and y of a float's middle."""
    sign = 1.0 if letter == "l" else -1.0
    return ENDS[end] + sign * ASIDE, sign * (FLOAT_Y + pose.beam * v.BEAM_STROKE.value)


def draw_frame() -> Assembly:
    """Rails, mounts of the axles, pedestal, the ring's inner race, what stands on it."""
    tree = Assembly("CARRIER FRAME")
    inside, outside, low, high = RAIL
    half = v.WIDTH.value / 2

    def put(name: str, shape: TopoDS_Shape, colour: Colour = GREY, role: str = "", at: gp_Trsf | None = None) -> None:
        tree.add(Part(name, shape, colour), BODY, role, at)

    add_pair(tree, "FRAME RAIL", sheet_box(REAR + 12, FRONT - 40, inside, outside, low, high, 10.0), BODY, GREY)
    put("REAR BUMPER", box(REAR, REAR + 12, -half, half, low - 150, high))
    put("FRONT BUMPER", box(FRONT - 40, FRONT, -half, half, low - 150, high))
    for x in (-2_900.0, -1_160.0, 1_120.0, 2_800.0):
        put("X-MEMBER", box(x, x + 40, -inside, inside, low, high))
    for end, x in (("FRT", HALF_BASE), ("RR", -HALF_BASE)):
        add_pair(tree, f"{end} AXLE MOUNT", box(x - 60, x + 60, inside, outside, RADIUS + 50, low), BODY, GREY)
    put("BELLY PAN", sheet_box(-1_000, 1_000, -outside, outside, v.CLEARANCE.value, low, 8.0))
    put("PEDESTAL", sheet_box(-700, 700, -outside, outside, high, SEAT - 40, 20.0))
    inner, between, _ = RING
    put("RING SEAT", ring((0, 0, SEAT - 40), Z, between + 60, inner - 60, 40.0))
    put("SLEWING BEARING INNER RACE", ring((0, 0, SEAT), Z, between, inner, DECK - SEAT - 12), STEEL, "slewing_bearing")
    put("FUEL TANK", sheet_box(-1_100, 1_100, outside, half, 620, 1_100, 6.0), BLACK)
    put("HYDRAULIC TANK", sheet_box(-1_100, 1_100, -half, -outside, 620, 1_100, 6.0), BLACK)
    put("ENGINE", sheet_box(-3_600, -2_640, -340, 340, low, high + 60, 15.0))
    put("ENGINE HOOD", sheet_box(-3_980, -2_620, 450, BOX_Y, low, 1_350, 5.0), YELLOW)
    put("TRANSMISSION", sheet_box(-1_120, -720, -345, 345, low, high, 30.0))
    for name, y in (("LH", outside), ("RH", -BOX_Y)):
        put(f"FRONT DECK {name}", box(2_640, FRONT - 40, y, y + BOX_Y - outside, high - 150, high), YELLOW)
    put("FRONT WEIGHT", box(2_860, FRONT - 40, -inside, inside, low, high + 140))
    return tree
