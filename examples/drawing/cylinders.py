"""Hydraulic cylinders, drawn in their own frame: barrel pin at the origin, rod along +x, pins along y.
Millimetres.

The piston meets the base cap at the closed length and the gland at closed length + stroke, so the drawn
travel is the stroke.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from OCP.TopoDS import TopoDS_Shape

from .product import CHROME, GREY, STEEL, YELLOW, Assembly, Colour, Part, Use
from .solids import Vector, X, Y, Z, ball, bored, box, cut, frame, fuse, plate, ring, rod, shift, turn


@dataclass(frozen=True, slots=True)
class Cylinder:
    """Sizes of one cylinder, millimetres; `drawn` is its pin-to-pin length in the file."""

    name: str
    bore: float
    rod: float
    stroke: float
    closed: float
    drawn: float
    outside: float
    pin: float
    eye: float
    eye_width: float
    base: float
    cap: float
    piston: float
    gland: float
    colour: Colour = YELLOW
    port: float = 22.0
    """Radius of the ports, which stand out in proportion."""

    @property
    def inside(self) -> float:
        """Length of the bore between base cap and gland: stroke + piston."""
        return self.stroke + self.piston

    @property
    def gland_face(self) -> float:
        """Outer face of the gland, from the barrel pin."""
        return self.base + self.inside + self.gland

    @property
    def rod_showing_closed(self) -> float:
        """Gland face to rod pin at the closed length."""
        return self.closed - self.gland_face

    def slide(self) -> dict[str, float]:
        """What the truth about a machine says of its slide, metres."""
        mm = {
            "stroke": self.stroke,
            "bore": self.bore,
            "rod_diameter": self.rod,
            "closed_length": self.closed,
            "drawn_length": self.drawn,
        }
        return {key: round(value / 1000.0, 9) for key, value in mm.items()}


PISTON_CLEARANCE = 0.25
ROD_CLEARANCE = 0.25
PIN_CLEARANCE = 0.2
"""Radial clearances, millimetres."""


def _tube(c: Cylinder) -> Part:
    outer, inner = c.outside / 2, c.bore / 2
    size = c.port / 22.0
    port = (
        rod((c.base + 35 * size, 0, 0), Z, c.port, outer + 28 * size),
        rod((c.gland_face - c.gland - 40 * size, 0, 0), Z, c.port, outer + 28 * size),
    )
    tube = fuse(rod((c.base - c.cap, 0, 0), X, outer, c.cap + c.inside + c.gland - 30), *port)
    return Part(f"{c.name} TUBE", cut(tube, rod((c.base, 0, 0), X, inner, c.inside + c.gland)), c.colour)


def _gland(c: Cylinder) -> Part:
    nose = rod((c.gland_face - 30, 0, 0), X, c.outside / 2, 30.0)
    gland = fuse(rod((c.gland_face - c.gland, 0, 0), X, c.bore / 2, c.gland), nose)
    # A hole reaches 4 m either way.
    at = c.gland_face if c.gland_face > 3_900.0 else 0.0
    return Part(f"{c.name} GLAND", bored(gland, X, ((at, 0, 0), c.rod / 2 + ROD_CLEARANCE)), GREY)


def _rod_and_piston(c: Cylinder) -> tuple[Part, Part]:
    piston_at = c.base + c.drawn - c.closed
    head = c.drawn - c.eye * 0.8
    piston = ring((piston_at, 0, 0), X, c.bore / 2 - PISTON_CLEARANCE, c.rod / 2, c.piston)
    shaft = rod((piston_at, 0, 0), X, c.rod / 2, head - piston_at)
    return Part(f"{c.name} ROD", shaft, CHROME), Part(f"{c.name} PISTON", piston, STEEL)


def draw_cylinder(c: Cylinder, pin_fast_in_rod: bool = False) -> Assembly:
    """The cylinder at its drawn length. Bodies are tagged "barrel" and "rod"; the user of the assembly names
    them.

    `pin_fast_in_rod`: the rod's pin is held in the rod eye (bore of the pin's size) rather than in the other
    machine part.
    """
    tree = Assembly(c.name)
    half, start = c.eye_width / 2, c.base - c.cap
    tree.add(_tube(c), "barrel")
    lug = plate([(0, 0, c.eye), (start + 2, -c.eye * 0.9, 0), (start + 2, c.eye * 0.9, 0)], "xz", -half, half)
    eye = bored(lug, Y, ((0, 0, 0), c.pin / 2 + PIN_CLEARANCE))
    tree.add(Part(f"{c.name} BRL EYE", eye, c.colour), "barrel")
    tree.add(_gland(c), "barrel")
    for part in _rod_and_piston(c):
        tree.add(part, "rod")
    shank = box(-c.eye * 0.8 - 12, 0, -half * 0.8, half * 0.8, -c.rod / 2 - 6, c.rod / 2 + 6)
    shape = fuse(rod((0, -half, 0), Y, c.eye, c.eye_width), shank)
    clearance = 0.0 if pin_fast_in_rod else PIN_CLEARANCE
    tree.add(
        Part(f"{c.name} ROD EYE", bored(shape, Y, ((0, 0, 0), c.pin / 2 + clearance)), c.colour),
        "rod",
        at=shift(c.drawn),
    )
    return tree


def draw_hung_cylinder(c: Cylinder, ball_radius: float, *, collar: float = 0.0) -> Assembly:
    """A cylinder with a socket for a ball stud of that radius at its rod's end, drawn like `draw_cylinder`. At the
    other end it has another; or, with a `collar` of a radius, a ball around the tube at the origin, which sits in a
    socket of what carries it: `base` is then negative. Bodies are tagged as there."""
    tree, tube = Assembly(c.name), _tube(c)
    if collar:
        grown = fuse(tube.shape, cut(ball((0, 0, 0), collar), rod((-2 * collar, 0, 0), X, c.bore / 2, 4 * collar)))
        tube = Part(f"{c.name} TUBE", grown, c.colour)
    tree.add(tube, "barrel")
    if not collar:
        tree.add(Part(f"{c.name} BRL SOCKET", _socket(c, ball_radius, c.base - c.cap, 0.7 * c.eye), c.colour), "barrel")
    tree.add(_gland(c), "barrel")
    for part in _rod_and_piston(c):
        tree.add(part, "rod")
    shape = _socket(c, ball_radius, -0.8 * c.eye, 0.5 * c.rod + 8.0)
    tree.add(Part(f"{c.name} ROD SOCKET", shape, c.colour), "rod", at=shift(c.drawn))
    return tree


def _socket(c: Cylinder, radius: float, to: float, neck: float) -> TopoDS_Shape:
    """A block around a ball at the origin, open for its stud, which comes along +y; its neck, of that radius, ends at
    `to`."""
    along = X if to > 0.0 else (-1.0, 0.0, 0.0)
    shape = fuse(
        rod((0, -c.eye_width / 2, 0), Y, c.eye, c.eye_width + radius / 2), rod((0, 0, 0), along, neck, abs(to))
    )
    far = max(abs(to), c.eye) + 1.0
    if abs(to) < c.eye:  # the rod ends in the block
        shape = cut(shape, box(-far, to, -neck - 20, neck + 20, -neck - 20, neck + 20))
    shape = cut(shape, ball((0, 0, 0), radius + PIN_CLEARANCE))
    return cut(shape, rod((0, -2.0 * radius, 0), Y, 0.62 * radius, 2.0 * radius))


def put_pair(tree: Assembly, cylinder: Assembly, name: str, start: Vector, end: Vector) -> None:
    """A drawn cylinder on the left, from its barrel's pin to its rod's, and its mirror image's place on the right; its
    pins are level where it lies in a plane y, else upright."""
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        along = (end[0] - start[0], sign * (end[1] - start[1]), end[2] - start[2])
        upright = start[1] != end[1]
        at = frame((start[0], sign * start[1], start[2]), along, Z if upright else (-along[2], 0.0, along[0]))
        at = at.Multiplied(turn(X, 90.0)) if upright else at  # it is drawn with its pins along y
        halves = {"barrel": f"{name}_cylinder_barrel_{letter}", "rod": f"{name}_piston_rod_{letter}"}
        tree.uses.append(Use(cylinder, at, names=halves))


def draw_pairs(sizes: Mapping[str, Cylinder], pins: Mapping[str, tuple[Vector, Vector]]) -> Assembly:
    """Pairs of cylinders in one assembly, as a parts book has them; `pins`: of each pair's left barrel and rod."""
    tree = Assembly("HYDRAULIC CYLINDERS")
    for name, (start, end) in pins.items():
        put_pair(tree, draw_cylinder(sizes[name]), name, start, end)
    return tree


@dataclass(frozen=True, slots=True)
class Ram:
    """Sizes of a cylinder whose halves are fixed, millimetres; its barrel's foot at the origin, its rod along +z.

    `out`: how far it is drawn out; `long`: from the foot to the rod's end when closed; `base` the thickness of its
    bottom. With `through` the rod comes out of both ends alike, and `long` is half of it. `lugs` are one with its tube.
    """

    name: str
    bore: float
    rod: float
    stroke: float
    out: float
    outside: float
    long: float
    base: float = 40.0
    piston: float = 60.0
    gland: float = 60.0
    through: bool = False
    lugs: TopoDS_Shape | None = None
    colour: Colour = GREY

    @property
    def length(self) -> float:
        """Of the barrel."""
        return self.base + self.stroke + self.piston + self.gland

    def slide(self) -> dict[str, float]:
        """What the truth about a machine says of its slide, metres."""
        mm = {"stroke": self.stroke, "bore": self.bore, "rod_diameter": self.rod, "extension": self.out}
        return {key: round(value / 1000.0, 9) for key, value in mm.items()}


def draw_ram(r: Ram) -> Assembly:
    """The ram as drawn; bodies are tagged "barrel" and "rod", roles "barrel_role" and "rod_role": the user of the
    assembly names them."""
    tree = Assembly(r.name)
    inner, shaft = r.bore / 2, r.rod / 2
    tube = rod((0, 0, 0), Z, r.outside / 2, r.length - 30)
    tube = fuse(tube, r.lugs) if r.lugs is not None else tube
    tube = cut(tube, rod((0, 0, r.base), Z, inner, r.length))
    if r.through:
        tube = bored(tube, Z, ((0, 0, 0), shaft + ROD_CLEARANCE))
    tree.add(Part(f"{r.name} TUBE", tube, r.colour), "barrel", "barrel_role")
    top = r.length - r.gland
    gland = fuse(rod((0, 0, top), Z, inner, r.gland), rod((0, 0, r.length - 30), Z, r.outside / 2, 30))
    gland = bored(gland, Z, ((0, 0, 0), shaft + ROD_CLEARANCE))
    tree.add(Part(f"{r.name} GLAND", gland, GREY), "barrel", "barrel_role")
    low = r.base + r.out
    start, end = (r.length / 2 - r.long + r.out - r.stroke / 2, r.length / 2 + r.long + r.out - r.stroke / 2) if (
        r.through
    ) else (low, r.long + r.out)  # fmt: skip
    tree.add(Part(f"{r.name} ROD", rod((0, 0, start), Z, shaft, end - start), CHROME), "rod", "rod_role")
    piston = ring((0, 0, low), Z, inner - PISTON_CLEARANCE, shaft, r.piston)
    tree.add(Part(f"{r.name} PISTON", piston, STEEL), "rod", "rod_role")
    return tree
