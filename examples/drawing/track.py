"""A track of plain shoes around two equal wheels, one side at a time: sprocket behind, idler ahead, rollers below and
above, and the two plates of its frame. Machine frame, millimetres."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

from OCP.TopoDS import TopoDS_Shape
from scipy.optimize import brentq

from .product import STEEL, Assembly, Colour, Part
from .solids import Y, bored, box, cut, fuse, mirrored, moved, plate, ring, rod, shift, turn

DARK: Colour = (0.16, 0.16, 0.17)
Places = list[tuple[float, float]]


@dataclass(frozen=True)
class Track:
    """Sizes of a track: `half` of the distance of its axles; `run` links along the ground and `turn` around a wheel;
    `gauge` between the sides' middles; `over` its whole length; the rollers' places and radii, front to rear. Details
    are `scale` times those of a small one."""

    half: float
    run: int
    turn: int
    gauge: float
    width: float
    over: float
    low: tuple[float, ...]
    low_radius: float
    high: tuple[float, ...]
    high_radius: float
    body: str
    scale: float = 1.0

    @property
    def pitch(self) -> float:
        """Between a link's pins."""
        return 2 * self.half / self.run

    @property
    def pitch_radius(self) -> float:
        """Of the pins around a wheel."""
        return self.pitch / (2 * math.sin(math.pi / (2 * self.turn)))

    @property
    def eye(self) -> float:
        """Radius of a link's eyes."""
        return 16.0 * self.scale

    @property
    def side(self) -> float:
        """Where a side's middle is."""
        return self.gauge / 2

    def _reach(self, out: float) -> float:
        """How far the shoes around a wheel reach from its axis, level, for a shoe's height below its pins."""
        angle = math.pi / (2 * self.turn)
        level = self.pitch_radius * math.cos(angle) + out
        odd = range(1, self.turn, 2)
        return max(level * math.cos(i * angle) + 0.45 * self.pitch * math.sin(i * angle) for i in odd)

    @functools.cached_property
    def depth(self) -> float:
        """From a shoe's pins to its grouser: what the length over the tracks takes."""
        ahead = self.over / 2 - self.half
        return float(brentq(lambda out: self._reach(out) - ahead, 10.0, 200.0, xtol=1e-12))

    @property
    def axle(self) -> float:
        """Height of the sprocket's and idler's axes."""
        return self.depth + self.pitch_radius

    def rollers(self) -> dict[str, Places]:
        """Axes (x, z) of a side's rollers, front to rear."""
        low = self.depth + self.eye + self.low_radius + 1
        high = self.axle + self.pitch_radius - self.eye - self.high_radius - 1
        return {"track_roller": [(x, low) for x in self.low], "carrier_roller": [(x, high) for x in self.high]}

    def pins(self) -> Places:
        """A side's pins (x, z), from the rear of the ground run forward and around."""
        z, r, step = self.axle, self.pitch_radius, math.pi / self.turn
        pins = [(-self.half + i * self.pitch, z - r) for i in range(self.run)]
        angles = [i * step - math.pi / 2 for i in range(self.turn)]
        around = [(r * math.cos(angle), r * math.sin(angle)) for angle in angles]
        pins += [(self.half + x, z + up) for x, up in around]
        pins += [(self.half - i * self.pitch, z + r) for i in range(self.run)]
        return pins + [(-self.half - x, z - up) for x, up in around]

    def bodies(self) -> list[str]:
        """Bodies of their own where every shoe is one; otherwise they move with what carries the track."""
        out: list[str] = []
        for letter in "lr":
            out += [f"sprocket_{letter}", f"idler_{letter}"]
            out += [f"{row}_{letter}_{i + 1}" for row, places in self.rollers().items() for i in range(len(places))]
            out += [f"track_shoe_{letter}_{i + 1}" for i in range(len(self.pins()))]
        return out

    def _shoe(self) -> Part:
        """A link with its shoe, in the frame of its rear pin, which it carries; the ground is towards -z."""
        out, half, p, s = self.depth, self.width / 2, self.pitch, self.scale
        sole = box(0.05 * p, 0.95 * p, -half, half, -out, 8 * s - out)
        cheek: list[tuple[float, float, float]] = [(0, 0, self.eye), (10 * s, 8 * s - out, 0)]
        cheek.append((p - 30 * s, 8 * s - out, 0))
        cheeks = [plate(cheek, "xz", a * s, (a + 12) * s) for a in (22.0, -34.0)]
        tongue = plate([(p, 0, self.eye), (30 * s, 8 * s - out, 0), (p - 6 * s, 8 * s - out, 0)], "xz", -20 * s, 20 * s)
        tongue = bored(tongue, Y, ((p, 0, 0), 8 * s + 0.3))
        tongue = cut(tongue, rod((0, -30 * s, 0), Y, self.eye + 1, 60 * s))
        bar = rod((0, -34 * s, 0), Y, 8 * s, 68 * s)
        return Part(f"TRACK SHOE {self.width:g}", fuse(sole, *cheeks, tongue, bar), DARK)

    def draw_side(self, letter: str, sign: float) -> Assembly:
        """One side: shoes, wheels on their axles, and the two plates of its frame."""
        tree, s = Assembly(f"TRACK {letter.upper()}H"), self.scale
        y = sign * self.side
        shoe, pins = self._shoe(), self.pins()
        for i, (a, b) in enumerate(zip(pins, pins[1:] + pins[:1], strict=True)):
            tilt = -math.degrees(math.atan2(b[1] - a[1], b[0] - a[0]))
            tree.add(shoe, f"track_shoe_{letter}_{i + 1}", at=shift(a[0], y, a[1]).Multiplied(turn(Y, tilt)))
        r = self.pitch_radius
        tooth = box(-12 * s, 12 * s, -14 * s, 14 * s, 0.53 * r, r - 7 * s)
        teeth = [moved(tooth, turn(Y, 360.0 * (i + 0.5) / (2 * self.turn))) for i in range(2 * self.turn)]
        axle, small = 18.0 * s, 10.0 * s
        hub = fuse(_wheel(r - self.eye - 4, axle + 0.2, 36 * s), *teeth)
        idler = _wheel(r - self.eye - 1, axle + 0.2, 40 * s)
        places = [(f"sprocket_{letter}", Part("SPROCKET", hub, DARK), -self.half, self.axle, axle)]
        places.append((f"idler_{letter}", Part("IDLER", idler, DARK), self.half, self.axle, axle))
        for row, radius in (("track_roller", self.low_radius), ("carrier_roller", self.high_radius)):
            part = Part(row.upper().replace("_", " "), _wheel(radius, small + 0.2, 52 * s), DARK)
            for i, (x, z) in enumerate(self.rollers()[row]):
                places.append((f"{row}_{letter}_{i + 1}", part, x, z, small))
        (ahead, low), (behind, _) = self.rollers()["track_roller"][0], self.rollers()["track_roller"][-1]
        outline = [(-self.half, self.axle, 46 * s), (behind, low, 22 * s), (ahead, low, 22 * s)]
        carriers = [(x, z, 22 * s) for x, z in self.rollers()["carrier_roller"]]
        frame = plate([*outline, (self.half, self.axle, 46 * s), *carriers], "xz", 30 * s, 42 * s)
        for role, part, x, z, bore in places:
            tree.add(part, role, at=shift(x, y, z))
            tree.add(Part(f"AXLE D{2 * bore:g}", rod((x, y - 42 * s, z), Y, bore, 84 * s), STEEL), self.body)
            frame = cut(frame, rod((x, 0, z), Y, bore, 60 * s))
        tree.add(Part("TRACK FRAME PL", frame, DARK), self.body, at=shift(0, y, 0))
        tree.add(Part("TRACK FRAME PL", mirrored(frame), DARK), self.body, at=shift(0, y, 0))
        return tree


def _wheel(radius: float, bore: float, width: float) -> TopoDS_Shape:
    return ring((0, -width / 2, 0), Y, radius, bore, width)
