"""The track: where its pins are, and its parts. One side is drawn about the plane y = 0 and used twice.

The pins lie on the tightest line around idler, sprocket and rollers, a link pitch apart (chords, as the links are
rigid), and the 49th link closes the ring: the idler is as large as that takes. The grousers are as high as the
published track length takes. Millimetres, machine frame; x forward, z up.
"""

from __future__ import annotations

import functools
import itertools
import math
from dataclasses import dataclass

from OCP.TopoDS import TopoDS_Shape
from scipy.optimize import brentq

from drawing.hardware import bolt
from drawing.product import GREY, STEEL, Assembly, Colour, Part, Use
from drawing.solids import X, Y, Z, bored, box, cut, fuse, outline, plate, rod, shift, turn, turned

from . import values as v

PITCH = v.LINK_PITCH.value
COUNT = int(v.SHOES.value)
HALF = v.TRACK_ON_GROUND.value / 2
TEETH = 22
"""Every second gap between the sprocket's teeth takes a pin."""
SPROCKET_R = PITCH / (2 * math.sin(2 * math.pi / TEETH))
"""Pitch circle: pins two teeth apart are a link pitch apart."""
RAIL, SEAT, PLATE = 46.0, 40.0, 14.0
"""Above the pins the rail, below them the shoe's seat; thickness of the shoe."""
TREAD, FLANGE = 78.0, 92.0
"""Radii of a track roller."""
ROLLER_X = tuple(-1400.0 + 350.0 * i for i in range(int(v.TRACK_ROLLERS.value)))
FLAT = 8 * PITCH
"""Half of the level ground run: it ends at a pin, past the last roller."""
CARRIER_X = (-620.0, 620.0)
CARRIER_TREAD = 62.0
LIFT = 40.0
"""Idler and sprocket are raised this much, that the machine rocks on to its rollers."""
PIN, BUSHING = 19.0, 30.0
"""Radii of a track pin at the links and between them."""
CLEARANCE = 0.4
"""Radial, of everything that turns in the undercarriage."""
DARK: Colour = (0.16, 0.16, 0.17)


@dataclass(frozen=True, slots=True)
class Loop:
    """The solved track. `pins`: (x, z) and direction of travel (radians) of the link that begins there, in order
    along the ground forward. `idler`: radius of the idler's pin line; `grouser`: pins to grouser tips."""

    pins: tuple[tuple[float, float, float], ...]
    idler: float
    grouser: float

    @property
    def axle(self) -> float:
        """Height of the sprocket's and idler's axes."""
        return self.grouser + SPROCKET_R + LIFT

    @property
    def roller(self) -> float:
        """Height of the track rollers' axes."""
        return self.grouser + RAIL + TREAD

    def carrier(self, x: float) -> float:
        """Height of a carrier roller's axis."""
        return self.axle + _carrier_above(self.idler, x)


def _carrier_above(idler: float, x: float) -> float:
    """Carrier rollers hold the top run a little above the line from sprocket to idler."""
    return idler + (SPROCKET_R - idler) * (HALF - x) / (2 * HALF) + 12.4 - RAIL - CARRIER_TREAD


def _pins(idler: float) -> tuple[list[tuple[float, float]], float]:
    """Pins from the middle of the ground run on, heights above the ground run's pin line, and how far the last is
    from the first along the line (positive: the ring is too long)."""
    up = SPROCKET_R + LIFT
    wheels = [
        (-FLAT, RAIL + TREAD, RAIL + TREAD),
        (FLAT, RAIL + TREAD, RAIL + TREAD),
        (HALF, up, idler),
        *((x, up + _carrier_above(idler, x), RAIL + CARRIER_TREAD) for x in reversed(CARRIER_X)),
        (-HALF, up, SPROCKET_R),
    ]
    path = _Path(outline(wheels))
    start = path.pieces[0][0] + path.pieces[1][0] / 2  # past the first roller's arc, in the middle of the ground run
    s, found = start, [path.at(start)]
    for _ in range(COUNT):
        here = found[-1]

        def miss(t: float, here: tuple[float, float] = here) -> float:
            return math.dist(path.at(t), here) - PITCH

        s = float(brentq(miss, s + 0.9 * PITCH, s + 1.2 * PITCH, xtol=1e-12))
        found.append(path.at(s))
    return found[:-1], path.length - (s - start)


class _Path:
    """Points along a closed path of lines and arcs by length."""

    def __init__(self, segments: list[tuple[tuple[float, float], ...]]) -> None:
        self.pieces: list[tuple[float, tuple[float, ...]]] = []
        for seg in segments:
            if len(seg) == 2:
                (ax, ay), (bx, by) = seg
                self.pieces.append((math.dist(*seg), (ax, ay, bx, by)))
            else:
                (ax, ay), (mx, my), (bx, by) = seg
                d = 2 * (ax * (my - by) + mx * (by - ay) + bx * (ay - my))
                a, m, b = ax * ax + ay * ay, mx * mx + my * my, bx * bx + by * by
                cx = (a * (my - by) + m * (by - ay) + b * (ay - my)) / d
                cy = (a * (bx - mx) + m * (ax - bx) + b * (mx - ax)) / d
                r = math.hypot(ax - cx, ay - cy)
                first = math.atan2(ay - cy, ax - cx)
                sweep = (math.atan2(by - cy, bx - cx) - first) % (2 * math.pi)
                self.pieces.append((r * sweep, (cx, cy, r, first, sweep)))
        self.length = sum(length for length, _ in self.pieces)

    def at(self, s: float) -> tuple[float, float]:
        s %= self.length
        i = 0
        while s > self.pieces[i][0] and i < len(self.pieces) - 1:
            s -= self.pieces[i][0]
            i += 1
        length, p = self.pieces[i]
        part = min(1.0, s / length) if length else 0.0
        if len(p) == 4:
            return p[0] + part * (p[2] - p[0]), p[1] + part * (p[3] - p[1])
        a = p[3] + part * p[4]
        return p[0] + p[2] * math.cos(a), p[1] + p[2] * math.sin(a)


@functools.cache
def solve_track() -> Loop:
    """The track that closes and has the published length."""
    idler = float(brentq(lambda r: _pins(r)[1], 270.0, 350.0, xtol=1e-10))
    flat, _ = _pins(idler)
    ring = [*flat, flat[0]]
    placed = [(p[0], p[1], math.atan2(q[1] - p[1], q[0] - p[0])) for p, q in itertools.pairwise(ring)]

    def length(grouser: float) -> float:
        """Overall length of the shoes, from the corners of their side view."""
        xs = [x + math.cos(a) * u - math.sin(a) * w for x, _, a in placed for u, w in _shoe_outline(grouser)]
        return max(xs) - min(xs)

    grouser = float(brentq(lambda g: length(g) - v.TRACK_LENGTH.value, 60.0, 110.0, xtol=1e-10))
    return Loop(tuple((x, z + grouser, a) for x, z, a in placed), idler, grouser)


def _shoe_outline(grouser: float) -> list[tuple[float, float]]:
    """A triple-grouser shoe from the side in its link's frame: rear pin at the origin, front pin on +x, the ground
    towards -z. It begins behind the rear pin and ends before the front one."""
    back, front, seat, under = -32.0, 150.0, -SEAT, -SEAT - PLATE
    # no grouser behind the pin: it would dig in where the chain rises from the ground
    points = [(back, seat), (back, under), (-6.0, under), (2.0, -grouser), (12.0, -grouser), (18.0, under)]
    for middle in (66.0, 134.0):
        points += [(middle - 13, under), (middle - 5, -grouser), (middle + 5, -grouser), (middle + 13, under)]
    return [*points, (front, under), (front, seat)]


LINK_IN, LINK_OUT = (47.0, 69.0), (71.0, 93.0)
"""Lateral places of a link's front eye, and of its rear eye, which takes the next link's front eye inside."""
BOLT, BOLT_X, BOLT_Y = 18.0, (35.0, 96.0), 82.0


def _link(side: float) -> Part:
    """A link from its rear eye (outside, the pin is fast in it) to its front eye (inside), the shoe's seat below and
    the rail above."""

    def between(pair: tuple[float, float]) -> tuple[float, float]:
        return pair if side > 0 else (-pair[1], -pair[0])

    def half(corners: list[tuple[float, float]], eye: float, pair: tuple[float, float]) -> TopoDS_Shape:
        a, b = between(pair)
        return fuse(plate([(x, z, 0.0) for x, z in corners], "xz", a, b), rod((eye, a, 0), Y, 33.0, b - a))

    low, clear = -SEAT, 7.0 - SEAT  # the front eye passes over the next shoe
    rear = half([(0, low), (110, low), (110, RAIL), (0, RAIL)], 0.0, LINK_OUT)
    front = half([(80, low), (146, low), (150, clear), (PITCH, clear), (PITCH, RAIL), (80, RAIL)], PITCH, LINK_IN)
    waist = box(80, 110, *between((LINK_IN[0], LINK_OUT[1])), -SEAT, RAIL)
    shape = fuse(rear, waist, front)
    holes = [rod((x, side * BOLT_Y, -SEAT - 1), Z, BOLT / 2, 32.0) for x in BOLT_X]
    shape = cut(shape, rod((0, -100, 0), Y, PIN, 200), rod((PITCH, -100, 0), Y, PIN + CLEARANCE, 200), *holes)
    return Part(f"TRACK LINK {'LH' if side > 0 else 'RH'}", shape, DARK)


def draw_shoe(grouser: float) -> Assembly:
    """One link of the chain with its shoe, in the frame of its rear pin. Body tag "shoe"."""
    tree = Assembly("TRACK SHOE ASSY")
    half = v.SHOE_WIDTH.value / 2
    shoe = plate([(x, z, 0) for x, z in _shoe_outline(grouser)], "xz", -half, half)
    for x in BOLT_X:
        for y in (-BOLT_Y, BOLT_Y):
            shoe = cut(shoe, rod((x, y, -SEAT - PLATE - 1), Z, BOLT / 2, PLATE + 2))
    tree.add(Part(f"SHOE {v.SHOE_WIDTH.value:g} TRIPLE GROUSER", shoe, DARK), "shoe")
    tree.add(_link(1.0), "shoe")
    tree.add(_link(-1.0), "shoe")
    end, mid = LINK_OUT[1], LINK_IN[0] - 0.5
    profile = [(-end, 0.0), (-end, PIN), (-mid, PIN), (-mid, BUSHING), (mid, BUSHING), (mid, PIN), (end, PIN), (end, 0)]
    tree.add(Part("TRACK PIN", turned(profile), STEEL), "shoe")
    for x in BOLT_X:
        for y in (-BOLT_Y, BOLT_Y):
            at = shift(x, y, -SEAT - PLATE).Multiplied(turn(X, -90.0))
            tree.add(bolt(BOLT, 40.0), "shoe", at=at)
    return tree


def draw_chain(loop: Loop, letter: str) -> Assembly:
    """All shoes of one side, in order along the ground forward, up around the idler and back."""
    tree = Assembly(f"TRACK CHAIN {letter.upper()}H")
    shoe = _shoe(loop.grouser)
    for i, (x, z, a) in enumerate(loop.pins):
        at = shift(x, 0, z).Multiplied(turn(Y, -math.degrees(a)))
        tree.uses.append(Use(shoe, at, names={"shoe": f"track_shoe_{letter}_{i + 1}"}))
    return tree


@functools.cache
def _shoe(grouser: float) -> Assembly:
    return draw_shoe(grouser)


# ---- wheels --------
def draw_roller() -> tuple[Part, Part]:
    """A track roller's shell, with a flange outside each rail, and its shaft; axis through the origin along y."""
    r, f, side = TREAD - 1.0, FLANGE, LINK_OUT[1] + 4.0
    profile = [(-side - 16, 32), (-side - 16, f), (-side, f), (-side, r), (-36, r), (-36, 62), (36, 62), (36, r)]
    profile += [(side, r), (side, f), (side + 16, f), (side + 16, 32)]
    shell = turned([(float(a), float(b)) for a, b in profile])
    shaft = rod((0, -155, 0), Y, 32 - CLEARANCE, 310)
    return Part("TRACK ROLLER SHELL", shell, GREY), Part("TRACK ROLLER SHAFT", shaft, STEEL)


def draw_carrier() -> tuple[Part, Part]:
    """A carrier roller and its shaft, which the bracket inside holds; axis through the origin along y."""
    r = CARRIER_TREAD - 1.0
    profile = [(-98.0, 25.0), (-98.0, r), (-34.0, r), (-34.0, 46.0), (34.0, 46.0), (34.0, r), (98.0, r), (98.0, 25.0)]
    return Part("CARRIER ROLLER", turned(profile), GREY), Part(
        "CARRIER ROLLER SHAFT", rod((0, -100, 0), Y, 24.6, 330), STEEL
    )


def draw_idler(loop: Loop) -> tuple[Part, Part]:
    """The idler: treads under the rails, a rib between them; and its axle."""
    tread = _tread(loop.idler)
    profile = [(-94.0, 45.0), (-94.0, 95.0), (-70.0, 95.0), (-70.0, tread - 40), (-94.0, tread - 40), (-94.0, tread)]
    profile += [(-42.0, tread), (-38.0, tread + 26)]
    profile += [(-a, r) for a, r in reversed(profile)]
    return Part("IDLER", turned(profile), GREY), Part("IDLER AXLE", rod((0, -190, 0), Y, 44.6, 380), STEEL)


def _tread(pins: float) -> float:
    """Radius under the middle of a rail whose pins lie on the radius `pins`."""
    return math.sqrt(pins**2 - (PITCH / 2) ** 2) - RAIL - 1.0


def draw_sprocket() -> tuple[Part, Part, Part]:
    """Toothed ring, hub with the final drive's case, and a bolt; axis through the origin along y, the hub outside
    (+y). A gap lies on +x."""
    corners: list[tuple[float, float, float]] = []
    for i in range(TEETH):
        a, b = 2 * math.pi * i / TEETH, 2 * math.pi * (i + 0.5) / TEETH
        corners.append((SPROCKET_R * math.cos(a), SPROCKET_R * math.sin(a), -(BUSHING + 1.0)))
        top = SPROCKET_R + 8.0
        corners.append((top * math.cos(b), top * math.sin(b), 9.0))
    ring = bored(plate(corners, "xz", -34.0, 34.0), Y, ((0, 0, 0), 165.0))
    circle = [
        (205 * math.cos(a), 205 * math.sin(a))
        for a in (2 * math.pi * i / SPROCKET_BOLTS for i in range(SPROCKET_BOLTS))
    ]
    ring = bored(ring, Y, *(((x, 0.0, z), 10.0) for x, z in circle))
    case = [(-60.0, 130.0), (-60.0, 165.0), (34.0, 165.0), (34.0, 235.0), (58.0, 235.0), (58.0, 190.0), (150.0, 175.0)]
    case += [(170.0, 150.0), (170.0, 0.0), (150.0, 0.0), (150.0, 130.0)]
    hub = bored(turned(case), Y, *(((x, 0.0, z), 10.0) for x, z in circle))
    return Part("SPROCKET", ring, GREY), Part("FINAL DRIVE CASE", hub, GREY), bolt(20.0, 80.0)


SPROCKET_BOLTS = 9
