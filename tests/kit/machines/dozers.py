"""Parametric dozers straight as `Assembly` objects, with the truth: a blade on a C-frame (straight or angled) or on
push arms (straight or with wings, tilted by one cylinder or two), oval tracks or high sprockets, a radial ripper or
none.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are. Lengths
are in machine sizes; the tracks are those of the drawn excavators.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np

from kit.machines.crawler import merged
from kit.machines.excavators import Digger, Features
from kit.machines.solids import Array, around, bolt, box, lathe, place, plate, tube
from kit.machines.synthetic import XZ, Machine, X, Y, Z
from yellowiron.model.geometry import Shape, SphereFeature

SIDES = ((1, "l"), (-1, "r"))
BALL = 0.075
"""Radius of the ball that an angled blade turns on."""
RIPPER = {"pivot": (-1.62, 0.75), "beam": (-2.3, 0.75), "foot": (-1.63, 1.5), "eye": (-2.05, 0.97),
          "top": (-1.65, 1.22), "end": (-2.33, 1.25)}  # fmt: skip
"""x and z of an adjustable parallelogram's pins, in machine sizes: the link's two, the lift and the tip cylinders'."""


def raised(turn: float, about: Array) -> Array:
    """(4, 4) that turns up (positive) about the line along y through a point."""
    c, n = math.cos(turn), math.sin(turn)
    matrix = np.eye(4)
    matrix[0, [0, 2]], matrix[2, [0, 2]] = (c, -n), (n, c)
    matrix[:3, 3] = about - matrix[:3, :3] @ about
    return matrix


def yawed(turn: float, about: Array) -> Array:
    """(4, 4) that turns to the left about the upright through a point."""
    c, n = math.cos(turn), math.sin(turn)
    matrix = np.eye(4)
    matrix[:2, :2] = [[c, -n], [n, c]]
    matrix[:3, 3] = about - matrix[:3, :3] @ about
    return matrix


def sphere_arc(radius: float, start: float, end: float) -> list[tuple[float, float]]:
    """Corners of a circle about the origin (radius, height), between two angles from its foot."""
    count = max(3, round(abs(end - start) / (math.pi / 16)))
    turns = np.linspace(start, end, count + 1)
    return [
        (max(0.0, radius * math.sin(a)) if 1e-9 < a < math.pi - 1e-9 else 0.0, -radius * math.cos(a)) for a in turns
    ]


class Dozer(Digger):
    """One machine from one generator of random numbers."""

    carrier = "main_frame"
    frame_thick = 0.04
    """Of a track's frame."""

    def __init__(
        self, seed: int, *, arms: bool, dual: bool, wings: bool, high: bool, ripper: str, embedded: bool
    ) -> None:
        self.arms, self.dual, self.wings, self.high, self.ripper = arms, dual, wings, high, ripper
        super().__init__(seed, Features(), embedded=embedded)
        self.m.title = "DOZER"

    def link_pins(self) -> None:
        u, s = self.rng.uniform, self.s
        self.t, self.pin_r, self.eye_w = 0.06 * s * u(0.9, 1.1), 0.03 * s * u(0.9, 1.15), 0.07 * s * u(0.9, 1.1)
        self.clearance = float(self.rng.choice([0.0, 0.0001, 0.0003])) * s
        self.gap = float(self.rng.choice([0.0, 0.001, 0.002])) * s
        self.gauge = 1.95 * s * u(0.97, 1.06)
        self.sprocket_up = 0.55 * float(u(0.85, 1.15))
        half = 0.5 * self.straight * self.pitch
        self.front = (half + self.pitch_r + self.plate_out + self.shoe_t) / s
        self.up, self.yaw = float(u(-0.03, 0.14)), float(u(-0.3, 0.3)) if u() < 0.5 else 0.0
        self.hull, self.wide = 0.42 * u(0.97, 1.03), 1.6 * self.pin_r / s
        self.lug_y = (self.eye_w / 2 + self.gap + self.t / 2) / s
        self.half_blade = (1.62 if not self.arms else 1.72) * u(0.96, 1.08)
        self.tall = 1.2 * u(0.9, 1.15) if self.arms else 1.36 * u(0.97, 1.1)
        self.P: dict[str, Array] = {}

    # ---- tracks ----
    def loop(self) -> tuple[list[tuple[float, float]], list[tuple[str, float, float]]]:
        if not self.high:
            return super().loop()
        half, r = 0.5 * self.straight * self.pitch, self.pitch_r
        low, over = self.sprocket_up * self.s, self.sprocket_up * self.s + 3.0 * self.pitch
        count = round(self._around(half, r, low)[1] / self.pitch) + 1
        for _ in range(60):
            middle = 0.5 * (low + over)
            low, over = (low, middle) if self._laid(half, r, middle, count)[1] > 0 else (middle, over)
        points = self._laid(half, r, low, count)[0]
        wheels = [("sprocket", -0.35 * half, low), ("idler", half, 0.0), ("idler", -half, 0.0)]
        return [(float(x), float(z)) for x, z in points], wheels

    @staticmethod
    def _around(half: float, r: float, up: float) -> tuple[Array, float]:
        """The chain's line about three equal wheels, closely sampled, from the rear end of what lies on the ground; its
        length."""
        wheels = np.array([(half, 0.0), (-0.35 * half, up), (-half, 0.0)])
        line = [np.linspace((-half, -r), (half, -r), 500)]
        start = -math.pi / 2
        for k, wheel in enumerate(wheels):
            following = wheels[(k + 1) % 3] - wheel
            end = math.atan2(following[1], following[0]) - math.pi / 2
            end += 2 * math.pi * math.ceil((start - end) / (2 * math.pi) - 1e-12)
            turns = np.linspace(start, end, 1500)
            line.append(wheel + r * np.stack([np.cos(turns), np.sin(turns)], axis=1))
            if k < 2:
                line.append(
                    np.linspace(line[-1][-1], wheels[k + 1] + r * np.array([math.cos(end), math.sin(end)]), 500)
                )
            start = end
        points = np.concatenate(line)
        return points, float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())

    def _laid(self, half: float, r: float, up: float, count: int) -> tuple[Array, float]:
        """So many pins a pitch apart on the line; how far beyond its end the next would be."""
        points, _ = self._around(half, r, up)
        way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        # The line goes on after its end, as it began.
        points, way = np.concatenate([points, points[1:500]]), np.concatenate([way, way[-1] + way[1:500]])
        whole = way[-500]
        pins, at = [points[0]], 0.0
        for _ in range(count):
            first = int(np.searchsorted(way, at + 0.5 * self.pitch))
            last = int(np.searchsorted(way, at + 2.0 * self.pitch))
            far = np.linalg.norm(points[first:last] - pins[-1], axis=1) - self.pitch
            k = first + int(np.argmax(far >= 0.0))
            share = -far[k - first - 1] / (far[k - first] - far[k - first - 1])
            pins.append(points[k - 1] + share * (points[k] - points[k - 1]))
            at = float(way[k - 1] + share * (way[k] - way[k - 1]))
        return np.array(pins[:-1]), whole - at

    # ---- pieces ----
    def spot(self, x: float, y: float, z: float) -> Array:
        return self.s * np.array([x, y, z])

    def world(self, *at: float) -> Array:
        """Where a point of what is drawn now is."""
        return np.asarray((self.m.pose @ np.array([*self.spot(*at), 1.0]))[:3])

    def wall(
        self, name: str, body: str, y: float, circles: list[tuple[float, ...]], *holes: tuple[float, float]
    ) -> None:
        """An upright plate fore and aft, its outline around circles (x, z, radius or 0)."""
        outline = around(*((self.s * x, self.s * z, self.s * r) for x, z, r in circles))
        bores = [(self.s * x, self.s * z, self.bore_r) for x, z in holes]
        self.m.add(name, body, body, plate(f"{name}_{y:.3f}", outline, self.t, bores), place((0, self.s * y, 0), XZ, X))

    def shelf(
        self, name: str, body: str, z: float, circles: list[tuple[float, ...]], *holes: tuple[float, float]
    ) -> None:
        """A level plate, its outline around circles (x, y, radius or 0)."""
        outline = around(*((self.s * x, self.s * y, self.s * r) for x, y, r in circles))
        bores = [(self.s * x, self.s * y, self.bore_r) for x, y in holes]
        self.m.add(name, body, body, plate(f"{name}_{z:.3f}", outline, self.t, bores), place((0, 0, self.s * z), Z, X))

    def lugs(self, name: str, body: str, y: float, at: tuple[float, float], *feet: tuple[float, float]) -> None:
        """Two upright plates beside a cylinder's eye."""
        for d in (1, -1):
            self.wall(name, body, y + d * self.lug_y, [(*at, self.wide), *((*f, 0.0) for f in feet)], at)

    def shelves(self, name: str, body: str, z: float, at: tuple[float, float], *feet: tuple[float, float]) -> None:
        """Two level plates above and below an eye."""
        for d in (1, -1):
            self.shelf(name, body, z + d * self.lug_y, [(*at, self.wide), *((*f, 0.0) for f in feet)], at)

    def level_pin(self, role: str, body: str, at: tuple[float, float], y: float, half: float = 0.0) -> None:
        half = half or self.lug_y + 0.6 * self.t / self.s
        self.pin(role, body, self.spot(at[0], y - half, at[1]), self.spot(at[0], y + half, at[1]))

    def upright_pin(self, role: str, body: str, at: tuple[float, float], z: float) -> None:
        half = self.lug_y + 0.6 * self.t / self.s
        self.pin(role, body, self.spot(*at, z - half), self.spot(*at, z + half))

    def bar(self, role: str, start: tuple[float, float], end: tuple[float, float], *, level: bool) -> None:
        """A link of one piece between two pins."""
        r, hole = self.wide * self.s, self.bore_r
        ends = [tuple(self.s * c for c in p) for p in (start, end)]
        shape = plate(role, around(*((*p, r) for p in ends)), self.eye_w, [(*p, hole) for p in ends])
        self.m.add(role, role, role, shape, place((0, 0, 0), Z, X) if level else place((0, 0, 0), XZ, X))

    # ---- groups ----
    def draw(self) -> Machine:
        self.tracks()
        self.frame()
        if self.arms:
            self.push_arms()
        else:
            self.c_frame()
        if self.ripper == "radial":
            self.radial_ripper()
        elif self.ripper in ("parallel", "fixed_parallel"):
            self.parallel_ripper()
        return self.m

    def frame(self) -> None:
        s, e, body, u = self.s, self.e / self.s, self.carrier, self.rng.uniform
        t, h, nose = self.t / s, self.hull, self.front - 0.12
        self.pivot = (0.25 * u(0.6, 1.4), 0.56 * u(0.95, 1.05))
        self.foot = (0.42 * self.front, 1.2) if not self.arms else (self.front - 0.5, 1.45)
        corners = [(-1.5, 0.36, 0), (nose, 0.36, 0), (nose, 1.0, 0), (-1.5, 1.0, 0)]
        for side, _ in SIDES:
            self.wall("hull side", body, side * (h - t / 2), corners, *([] if self.arms else [self.pivot]))
        inner = h - t + e
        self.block("belly", body, (-1.48, -inner, 0.38), (nose - 0.02, inner, 0.42))
        self.block("front plate", body, (nose - 0.02, -inner, 0.42 - e), (nose, inner, 0.9 + e))
        self.block("drawbar", body, (-1.5, -inner, 0.5), (-1.3, inner, 0.7))
        self.block("deck", body, (-1.45, -inner, 0.9), (nose - 0.02, inner, 0.95))
        hood = float(u(1.55, 1.75))
        self.block("hood", body, (0.15, -0.3, 0.95 - e), (nose - 0.14, 0.3, hood))
        self.block("radiator guard", body, (nose - 0.14 - e, -0.34, 1.0 - e), (nose, 0.34, hood + 0.03))
        self.block("cab floor", body, (-0.9, -h, 1.0), (0.1, h, 1.1))
        self.block("cab", body, (-0.85, -0.6, 1.1), (0.08, 0.6, float(u(2.5, 3.2))))
        self.block("tank", body, (-1.5, -0.55, 1.0), (-0.92, 0.55, float(u(1.5, 1.8))))
        self.m.add(
            "exhaust", body, body, tube("exhaust", 0.05 * s, 0.04 * s, 0.6 * s), place(self.spot(0.8, 0.1, hood), Z)
        )
        for side, _ in SIDES:
            self.track_beams(side)
            for k in range(3):
                at = self.spot(-1.5, side * 0.2, 1.15 + 0.12 * k)
                self.m.add("M20", body, body, bolt("tank_bolt", 0.012 * s, 0.05 * s), place(at, -X))

    def track_beams(self, side: int) -> None:
        """What joins a track's frame to the main frame."""
        e, inside = self.e / self.s, abs(self.inside(self.gauge / 2)) / self.s - 0.02
        for k, x in enumerate((-0.25, -1.1)):
            low, high = sorted((side * (self.hull - e), side * (inside + e)))
            self.block(f"axle beam {k}", self.carrier, (x - 0.1, low, 0.43), (x + 0.1, high, 0.56))

    def lift(self, letter: str, side: int, y: float, rod_at: Array) -> None:
        halves = (f"lift_cylinder_barrel_{letter}", f"lift_piston_rod_{letter}")
        foot = self.spot(self.foot[0], side * y, self.foot[1])
        self.cylinder(f"lift {letter}", *halves, foot, rod_at, Y, 0.045 * self.s)

    def lift_foot(self, y: float, z: float, inner: float) -> None:
        """What the lift cylinders hang on: two lugs on a block, either side."""
        e, body, (x, _) = self.e / self.s, self.carrier, self.foot
        out = y + self.lug_y + 0.6 * self.t / self.s
        for side, letter in SIDES:
            low, high = sorted((side * inner, side * out))
            self.block("lift bracket", body, (x - 0.14, low, z - 0.06), (x + 0.03, high, z))
            self.lugs("lift lug", body, side * y, self.foot, (x - 0.13, z - e), (x + 0.02, z - e))
            self.level_pin(f"lift_cylinder_barrel_{letter}_pin", body, self.foot, side * y)

    # ---- a C-frame ----
    def c_frame(self) -> None:
        s, e, body, m, f = self.s, self.e / self.s, "c_frame", self.m, self.front
        t, gap = self.t / s, self.gap / s
        y = self.hull + gap + t / 2
        y_lift = self.lift_y = self.hull + gap + 0.01 + self.lug_y + t / 2
        ball = (f + 0.5, 0.56)
        self.lift_foot(y_lift, 1.06, 0.25)
        for side, _ in SIDES:
            self.block("lift stay", self.carrier, *self._sorted((self.foot[0] - 0.1, side * (self.hull - t), 0.99 - e),
                                                                (self.foot[0], side * self.hull, 1.0 + e)))  # fmt: skip
            self.level_pin("c_frame_pin", self.carrier, self.pivot, side * (self.hull + 0.5 * gap), 1.7 * t)
        m.pose = raised(self.up, self.spot(self.pivot[0], 0, self.pivot[1]))
        eye = (f - 0.32, 0.79)
        low, high = 0.44, 0.64
        rods, feet = {}, {}
        for side, letter in SIDES:
            arm = [
                (*self.pivot, 1.4 * self.wide),
                (1.0, low, 0),
                (f + 0.28, low, 0),
                (f + 0.28, high, 0),
                (1.0, high, 0),
            ]
            self.wall("arm", body, side * y, arm, self.pivot)
            span = self._sorted((eye[0] - 0.12, side * (y_lift - self.lug_y - t / 2), high - e),
                                (eye[0] + 0.12, side * (y_lift + self.lug_y + t / 2), high + 0.04))  # fmt: skip
            self.block("lug foot", body, *span)
            top = high + 0.04 - e
            self.lugs("lift rod lug", body, side * y_lift, eye, (eye[0] - 0.1, top), (eye[0] + 0.1, top))
            self.level_pin(f"lift_piston_rod_{letter}_c_frame_pin", body, eye, side * y_lift)
            rods[letter] = self.world(eye[0], side * y_lift, eye[1])
            at, face = (0.55 * f, side * (y + t / 2 + 0.11)), side * (y + t / 2 - e)
            self.shelves("angle lug", body, 0.54, at, (at[0] - 0.1, face), (at[0] + 0.1, face))
            self.upright_pin(f"angle_cylinder_barrel_{letter}_pin", body, at, 0.54)
            feet[letter] = self.world(*at, 0.54)
        inner = self.hull + gap + e
        self.block("cross box", body, (f + 0.1, -inner, low), (f + 0.28, inner, high))
        self.block("tower", body, (f + 0.16, -0.09, high - e), (f + 0.28, 0.09, 1.22))
        nose = box("nose", 0.19 * s, 0.19 * s, (0.11 + e) * s, [(0.0, 0.0, 0.03 * s + self.clearance)])
        m.add("nose", body, body, nose, place(self.spot(f + 0.335 - e / 2, 0, ball[1]), X))
        m.add("stud", "blade_ball_pin", body, self.stud(), place(self.spot(f + 0.28, 0, ball[1]), X))
        base = (f + 0.28 - e, 0.06), (f + 0.28 - e, -0.06)
        tilt, link = (f + 0.45, 0.14), (f + 0.35, 0.0)
        self.shelves("tilt lug", body, 0.96, tilt, *base)
        self.upright_pin("tilt_cylinder_barrel_pin", body, tilt, 0.96)
        self.shelves("link lug", body, 1.15, link, *base)
        self.upright_pin("pitch_link_pin", body, link, 1.15)
        tilt_foot = self.world(*tilt, 0.96)
        self.bar_at("pitch_link", link, ball, 1.15)
        m.pose = m.pose @ yawed(self.yaw, self.spot(ball[0], 0, ball[1]))
        self.blade_on_ball(ball, rods, feet, tilt_foot)

    def bar_at(self, role: str, start: tuple[float, ...], ball: tuple[float, float], z: float) -> None:
        kept, shift = self.m.pose, np.eye(4)
        shift[2, 3] = z * self.s
        self.m.pose = kept @ shift
        self.bar(role, (start[0], start[1]), (ball[0], 0.0), level=True)
        self.m.pose = kept

    @staticmethod
    def _sorted(a: tuple[float, ...], b: tuple[float, ...]) -> tuple[tuple[float, ...], tuple[float, ...]]:
        return tuple(map(min, a, b)), tuple(map(max, a, b))

    def stud(self) -> Shape:
        """A bar with a ball at its end."""
        r, neck, long = BALL * self.s, 0.03 * self.s, 0.22 * self.s
        start = math.asin(neck / r)
        arc = [(a, long + z) for a, z in sphere_arc(r, start, math.pi)]
        shape = lathe("stud", [(0.0, 0.0), (neck, 0.0), *arc])
        return replace(shape, spheres=(SphereFeature((0.0, 0.0, long), r, False, 4 * math.pi * r * r * 0.9),))

    def socket(self) -> Shape:
        """What holds the ball, along x from its mouth; the ball's middle is its origin."""
        r, outer = BALL * self.s + self.clearance, 0.125 * self.s
        mouth = -0.04 * self.s
        start = math.acos(-mouth / r)
        arc = sphere_arc(r, start, math.pi)
        shape = lathe("socket", [*reversed(arc), arc[0], (outer, mouth), (outer, 0.14 * self.s + self.e),
                                 (0.0, 0.14 * self.s + self.e)])  # fmt: skip
        return replace(shape, spheres=(SphereFeature((0.0, 0.0, 0.0), r, True, 2.6 * math.pi * r * r),))

    def blade_on_ball(
        self, ball: tuple[float, float], rods: dict[str, Array], feet: dict[str, Array], tilt_foot: Array
    ) -> None:
        s, e, body, f, m = self.s, self.e / self.s, "blade", self.front, self.m
        back = f + 0.64
        m.add("socket", body, body, self.socket(), place(self.spot(*ball[:1], 0, ball[1]), X))
        eyes = {}
        self.mouldboard(back)
        for side, letter in SIDES:
            at = (back - 0.09, side * (self.hull + 0.25))
            self.shelves("angle rod lug", body, 0.54, at, (back + e, at[1] - 0.08), (back + e, at[1] + 0.08))
            self.upright_pin(f"angle_piston_rod_{letter}_pin", body, at, 0.54)
            eyes[letter] = self.world(*at, 0.54)
        tilt = (back - 0.14, 0.95)
        self.shelves("tilt rod lug", body, 0.96, tilt, (back + e, 0.86), (back + e, 1.04))
        self.upright_pin("tilt_piston_rod_pin", body, tilt, 0.96)
        self.shelves("link rod lug", body, 1.15, (ball[0], 0.0), (back + e, -0.07), (back + e, 0.07))
        self.upright_pin("pitch_link_blade_pin", body, (ball[0], 0.0), 1.15)
        up = m.pose[:3, :3] @ Z
        rod = self.world(*tilt, 0.96)
        self.cylinder("tilt", "tilt_cylinder_barrel", "tilt_piston_rod", tilt_foot, rod, up, 0.05 * s)
        for side, letter in SIDES:
            halves = (f"angle_cylinder_barrel_{letter}", f"angle_piston_rod_{letter}")
            self.cylinder(f"angle {letter}", *halves, feet[letter], eyes[letter], up, 0.04 * s)
            m.pose = np.eye(4)
            self.lift(letter, side, self.lift_y, rods[letter])

    def mouldboard(self, back: float) -> None:
        """A curved face of four plates, a back plate, ribs between, edge and end bits; wings where it has some."""
        s, e, body, half, tall, m = self.s, self.e / self.s, "blade", self.half_blade, self.tall, self.m
        face = [(back + 0.24, 0.14), (back + 0.14, 0.36 * tall), (back + 0.11, 0.58 * tall), (back + 0.14, 0.8 * tall),
                (back + 0.24, tall)]  # fmt: skip

        def across(name: str, role: str, corners: list[tuple[float, float]], low: float, high: float) -> None:
            outline = around(*((s * x, s * z, 0.0) for x, z in corners))
            shape = plate(f"{name}_{low:.2f}_{high:.2f}_{corners[0][1]:.2f}", outline, (high - low) * s)
            m.add(name, role, body, shape, place((0, 0.5 * (low + high) * s, 0), XZ, X))

        for (x, z), (p, q) in itertools.pairwise(face):
            across("mouldboard", body, [(x, z), (p, q), (p - 0.045, q), (x - 0.045, z)], -half, half)
        across("back plate", body, [(back, 0.2), (back + 0.03, 0.2), (back + 0.03, tall - 0.05), (back, tall - 0.05)],
               0.12 - half, half - 0.12)  # fmt: skip
        for y in np.linspace(0.13 - half, half - 0.13, 6):
            corners = [(back + 0.03 - e, 0.3), (back + 0.03 - e, tall - 0.12), (face[2][0] - 0.045, 0.58 * tall),
                       (face[1][0] - 0.045, 0.36 * tall), (face[3][0] - 0.045, 0.8 * tall)]  # fmt: skip
            across("rib", body, corners, float(y) - 0.012, float(y) + 0.012)
        edge = [(back + 0.3, 0.0), (back + 0.24, 0.14 + e), (back + 0.2, 0.14 + e), (back + 0.26, 0.0)]
        across("cutting edge", "cutting_edge", edge, 0.28 - half, half - 0.28)
        for side, letter in SIDES:
            low, high = sorted((side * (half - 0.28), side * half))
            across("end bit", f"end_bit_{letter}", edge, low, high)
            if self.wings:
                low, high = sorted((side * (half - e), side * (half + 0.05)))
                wing = [(back + 0.06, 0.16), (back + 0.5, 0.1), (back + 0.5, 0.75 * tall), (back + 0.12, tall)]
                across("wing", body, wing, low, high)

    # ---- push arms ----
    def push_arms(self) -> None:
        s, e, f, m, main = self.s, self.e / self.s, self.front, self.m, self.carrier
        t, gap = self.t / s, self.gap / s
        outer = self.gauge / 2 / s + 0.275
        ya, z, pivot = outer + 0.09 + t / 2, self.axle_z / s, 0.1
        wall = abs(self.inside(self.gauge / 2)) / s + self.frame_thick / 2
        y_lift = 0.42 + self.lug_y
        self.lift_foot(y_lift, 1.34, 0.3 - e)
        tag = (f - 0.06, -0.25)
        self.shelves("tag lug", main, 0.55, tag, (f - 0.12 - e, tag[1] - 0.09), (f - 0.12 - e, tag[1] + 0.09))
        self.upright_pin("tag_link_pin", main, tag, 0.55)
        tag_at = self.world(*tag, 0.55)
        for side, letter in SIDES:
            ring = tube("trunnion boss", 2.2 * self.pin_r, self.bore_r, 0.03 * s)
            frame = self.bearer(f"idler_{letter}")
            m.add("trunnion boss", frame, frame, ring, place(self.spot(pivot, side * (wall - e), z), side * Y))
            low, high = sorted((side * wall, side * (ya + 0.8 * t)))
            self.pin(f"push_arm_{letter}_pin", frame, self.spot(pivot, low, z), self.spot(pivot, high, z))
        m.pose = raised(self.up, self.spot(pivot, 0, z))
        fork, king, foot, back = (f + 0.4, 0.45), f + 0.53, (f - 0.5, 0.72), f + 0.64
        ends = {}
        for side, letter in SIDES:
            body, yoke = f"push_arm_{letter}", f"push_arm_yoke_{letter}"
            arm = [(pivot, z, 1.5 * self.wide), (*fork, 1.2 * self.wide), (f - 0.7, 0.58, 0), (f - 0.3, 0.58, 0)]
            self.wall("push arm", body, side * ya, arm, (pivot, z), fork)
            span = self._sorted((foot[0] - 0.12, side * ya - self.lug_y - t / 2, 0.58 - e),
                                (foot[0] + 0.12, side * ya + self.lug_y + t / 2, 0.62))  # fmt: skip
            self.block("brace foot", body, *span)
            self.lugs("brace lug", body, side * ya, foot, (foot[0] - 0.1, 0.62 - e), (foot[0] + 0.1, 0.62 - e))
            tilts = side > 0 or self.dual
            lower = f"arm_tilt_cylinder_barrel_{letter}_pin" if tilts else "tilt_brace_pin"
            self.level_pin(lower, body, foot, side * ya)
            self.yoke(yoke, side * ya, fork, king, t + gap)
            self.level_pin(f"{body}_yoke_pin", body, fork, side * ya, 1.6 * t + gap)
            ends[letter] = (self.world(foot[0], side * ya, foot[1]), tilts)
        body = "blade"
        self.mouldboard(back)
        top = (back - 0.09, 0.93)
        rods = {}
        for side, letter in SIDES:
            self.shelves(
                "yoke lug", body, fork[1], (king, side * ya), (back + e, side * ya - 0.08), (back + e, side * ya + 0.08)
            )
            self.upright_pin(f"push_arm_yoke_{letter}_blade_pin", body, (king, side * ya), fork[1])
            self.lugs("brace rod lug", body, side * ya, top, (back + e, top[1] - 0.08), (back + e, top[1] + 0.08))
            start, tilts = ends[letter]
            upper = f"arm_tilt_piston_rod_{letter}_pin" if tilts else "tilt_brace_blade_pin"
            self.level_pin(upper, body, top, side * ya)
            eye = (back - 0.09, 0.72)
            self.lugs("lift rod lug", body, side * y_lift, eye, (back + e, eye[1] - 0.08), (back + e, eye[1] + 0.08))
            self.level_pin(f"lift_piston_rod_{letter}_blade_pin", body, eye, side * y_lift)
            rods[letter] = (
                start,
                self.world(top[0], side * ya, top[1]),
                tilts,
                self.world(eye[0], side * y_lift, eye[1]),
            )
            if not tilts:
                kept, shift = m.pose, np.eye(4)
                shift[1, 3] = side * ya * s
                m.pose = kept @ shift
                self.bar("tilt_brace", foot, top, level=False)
                m.pose = kept
        far = (back - 0.09, 0.55)
        self.shelves("tag rod lug", body, 0.55, far, (back + e, far[1] - 0.08), (back + e, far[1] + 0.08))
        self.upright_pin("tag_link_blade_pin", body, far, 0.55)
        end, up = self.world(*far, 0.55), m.pose[:3, :3] @ Z
        m.pose = np.eye(4)
        self.tag_link(tag_at, end, up)
        for side, letter in SIDES:
            start, stop, tilts, eye_at = rods[letter]
            if tilts:
                halves = (f"arm_tilt_cylinder_barrel_{letter}", f"arm_tilt_piston_rod_{letter}")
                self.cylinder(f"tilt {letter}", *halves, start, stop, Y, 0.05 * s)
            self.lift(letter, side, y_lift, eye_at)

    def tag_link(self, start: Array, end: Array, up: Array) -> None:
        """A bar with an eye at either end, each about its own pin: they hang on balls in truth."""
        way = end - start
        long, r = float(np.linalg.norm(way)), self.wide * self.s
        eye = plate("tag_eye", around((0, 0, r)), self.eye_w, [(0, 0, self.bore_r)])
        bar = tube("tag_bar", 0.4 * self.eye_w, 0.0, long - 1.8 * r)
        pieces = (
            (eye, place(start, Z, way)), (eye, place(end, up, way)), (bar, place(start + 0.9 * r * way / long, way)),
        )  # fmt: skip
        self.m.add("tag link", "tag_link", "tag_link", merged("tag_link", *pieces), np.eye(4))

    def yoke(self, body: str, y: float, fork: tuple[float, float], king: float, out: float) -> None:
        """Two cheeks beside the arm's end, and a lug with an upright bore before it, in one."""
        s, t, (x, z) = self.s, self.t, fork
        wide = 1.2 * self.wide
        cheek = around((0, 0, wide * s), ((king - 0.04 - x) * s, 0.03 * s, 0), ((king - 0.04 - x) * s, -0.03 * s, 0))
        cheeks = [
            (plate(f"cheek_{k}", cheek, t, [(0, 0, self.bore_r)]), place((0, k * out * s, 0), XZ, X)) for k in (1, -1)
        ]
        half, ahead = out * s + t / 2, (king - x) * s
        near = (wide + 0.012) * s
        tongue = around((near, half, 0), (near, -half, 0), (ahead, 0, self.wide * s))
        lug = plate("tongue", tongue, self.eye_w, [(ahead, 0, self.bore_r)]), place((0, 0, 0), Z, X)
        at = np.eye(4)
        at[:3, 3] = self.spot(x, y, z)
        self.m.add("yoke", body, body, merged(f"{body}_{y:.3f}", *cheeks, lug), at)

    # ---- ripper ----
    def radial_ripper(self) -> None:
        s, e, main, body, m = self.s, self.e / self.s, self.carrier, "ripper_beam", self.m
        t, gap = self.t / s, self.gap / s
        y, foot, eye, pivot = 0.26, (-1.62, 1.15), (-2.05, 0.72), (-1.62, 0.5)
        y_arm = y + 2 * self.lug_y + gap
        self.block("ripper plate", main, (-1.56, -0.6, 0.4), (-1.5 + e, 0.6, 1.3))
        for side, letter in SIDES:
            self.lugs("ripper lug", main, side * y, foot, (-1.56 + e, 1.06), (-1.56 + e, 1.24))
            self.level_pin(f"ripper_lift_cylinder_barrel_{letter}_pin", main, foot, side * y)
            self.lugs("ripper rod lug", body, side * y, eye, (-2.15, 0.6 - e), (-1.95, 0.6 - e))
            self.level_pin(f"ripper_lift_piston_rod_{letter}_beam_pin", body, eye, side * y)
            hinge = [(*pivot, self.wide), (-1.56 + e, 0.42, 0), (-1.56 + e, 0.6, 0)]
            self.wall("ripper hinge", main, side * y_arm, hinge, pivot)
            arm = [(*pivot, self.wide), (-2.0 - e, 0.45, 0), (-2.0 - e, 0.6, 0)]
            self.wall("ripper arm", body, side * (y_arm + t + gap), arm, pivot)
            self.level_pin("ripper_beam_frame_pin", main, pivot, side * (y_arm + 0.5 * (t + gap)), 1.2 * t)
            at = (self.spot(p[0], side * y, p[1]) for p in (foot, eye))
            halves = (f"ripper_lift_cylinder_barrel_{letter}", f"ripper_lift_piston_rod_{letter}")
            self.cylinder(f"ripper {letter}", *halves, *at, Y, 0.045 * s)
        self.block("ripper beam", body, (-2.25, -y_arm - 0.3, 0.42), (-2.0, y_arm + 0.3, 0.6))
        for k in range(int(self.rng.integers(1, 4))):
            across = (0.0, 0.5, -0.5)[k]
            self.block("ripper shank", body, (-2.38, across - 0.04, 0.12), (-2.25 + e, across + 0.04, 0.95))
        m.pose = np.eye(4)

    def parallel_ripper(self) -> None:
        """A link under the tip cylinders, which are the parallelogram's upper side, or under a second link, where it is
        a fixed one; the lift cylinders are between."""
        s, e, main, body, link, m = self.s, self.e / self.s, self.carrier, "ripper_beam", "ripper_link", self.m
        t, gap = self.t / s, self.gap / s
        y_lift, y_tip = 0.16, 0.16 + 2 * self.lug_y + 0.075
        y_arm = y_tip + self.lug_y + gap + t
        at = RIPPER
        self.block("ripper plate", main, (-1.56, -0.66, 0.4), (-1.5 + e, 0.66, 1.65))
        for side, letter in SIDES:
            hung = [("lift", y_lift, at["foot"], 0.09), ("tip", y_tip, at["top"], 0.07)]
            for name, y, pin, span in hung[: 1 if self.ripper == "fixed_parallel" else 2]:
                feet = ((-1.56 + e, pin[1] - span), (-1.56 + e, pin[1] + span))
                self.lugs(f"ripper {name} lug", main, side * y, pin, *feet)
                self.level_pin(f"ripper_{name}_cylinder_barrel_{letter}_pin", main, pin, side * y)
            hinge = [(*at["pivot"], self.wide), (-1.56 + e, at["pivot"][1] - 0.09, 0),
                     (-1.56 + e, at["pivot"][1] + 0.09, 0)]  # fmt: skip
            self.wall("ripper hinge", main, side * y_arm, hinge, at["pivot"])
            bar = [(*at["pivot"], self.wide), (*at["beam"], self.wide)]
            self.wall("ripper link arm", link, side * (y_arm + t + gap), bar, at["pivot"], at["beam"])
            for role, carrier, pin in (("ripper_link_pin", main, "pivot"), ("ripper_beam_pin", body, "beam")):
                self.level_pin(role, carrier, at[pin], side * (y_arm + 0.5 * (t + gap)), 1.2 * t)
            eye = at["eye"]
            self.lugs("ripper lift rod lug", link, side * y_lift, eye, (eye[0] - 0.08, eye[1] - 0.1),
                      (eye[0] + 0.08, eye[1] - 0.1))  # fmt: skip
            self.level_pin(f"ripper_lift_piston_rod_{letter}_link_pin", link, eye, side * y_lift)
            end = at["end"]
            self.wall("ripper carrier", body, side * y_arm, [(*at["beam"], self.wide), (end[0] - 0.1, end[1], 0),
                      (end[0] - 0.1, at["beam"][1] - 0.1, 0)], at["beam"])  # fmt: skip
            if self.ripper == "fixed_parallel":
                self.upper_link(side, y_tip)
                halves = ("ripper_lift_cylinder_barrel_" + letter, "ripper_lift_piston_rod_" + letter)
                pins = (self.spot(at[pin][0], side * y_lift, at[pin][1]) for pin in ("foot", "eye"))
                self.cylinder(f"ripper lift {letter}", *halves, *pins, Y, 0.04 * s)
                continue
            self.lugs("ripper tip rod lug", body, side * y_tip, end, (end[0] - 0.1, end[1] - 0.07),
                      (end[0] - 0.1, end[1] + 0.07))  # fmt: skip
            self.level_pin(f"ripper_tip_piston_rod_{letter}_pin", body, end, side * y_tip)
            for name, y, one, other in (("lift", y_lift, "foot", "eye"), ("tip", y_tip, "top", "end")):
                halves = (f"ripper_{name}_cylinder_barrel_{letter}", f"ripper_{name}_piston_rod_{letter}")
                pins = (self.spot(at[pin][0], side * y, at[pin][1]) for pin in (one, other))
                self.cylinder(f"ripper {name} {letter}", *halves, *pins, Y, 0.04 * s)
        eye, wide = at["eye"], y_arm + 0.5 * t + gap + e
        self.block(
            "ripper link tube", link, (eye[0] - 0.1, -wide, eye[1] - 0.22), (eye[0] + 0.1, wide, eye[1] - 0.1 + e)
        )
        end, low = at["end"], at["beam"][1] - 0.1
        wide = y_arm + 0.5 * t
        self.block("ripper carrier box", body, (end[0] - 0.2, -wide, low), (end[0] - 0.1 + e, wide, end[1] + 0.09))
        for k in range(int(self.rng.integers(1, 4))):
            across = (0.0, 0.4, -0.4)[k]
            top = 1.6 if self.ripper == "fixed_parallel" else 1.2  # as a deep ripper's, far above its carrier
            self.block("ripper shank", body, (end[0] - 0.34, across - 0.04, 0.1),
                       (end[0] - 0.2 + e, across + 0.04, top))  # fmt: skip
        m.pose = np.eye(4)

    def upper_link(self, side: int, y: float) -> None:
        """A bar beside a plate of the frame and one of the carrier, on a pin through each."""
        e, t, gap, at, body = self.e / self.s, self.t / self.s, self.gap / self.s, RIPPER, "ripper_upper_link"
        top, end = at["top"], at["end"]
        for carrier, pin, back in (("main_frame", "top", -1.56 + e), ("ripper_beam", "end", end[0] - 0.1)):
            outline = [(*at[pin], self.wide), (back, at[pin][1] - 0.07, 0), (back, at[pin][1] + 0.07, 0)]
            self.wall("ripper upper hinge", carrier, side * y, outline, at[pin])
            role = "ripper_upper_link_pin" if pin == "top" else "ripper_upper_link_beam_pin"
            self.level_pin(role, carrier, at[pin], side * (y + 0.5 * (t + gap)), 1.2 * t)
        bar = [(*top, self.wide), (*end, self.wide)]
        self.wall("ripper upper link arm", body, side * (y + t + gap), bar, top, end)


def _ripper(said: bool | str) -> str:
    return said if isinstance(said, str) else "radial" if said else ""


def dozer(
    seed: int, blade: str | None = None, *, dual: bool | None = None, wings: bool | None = None,
    high: bool | None = None, ripper: bool | str | None = None, embedded: bool = False,
) -> Machine:  # fmt: skip
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's. `blade`:
    `pat` (on a C-frame) or `push_arms`; `ripper`: `radial` (what a seed draws, and `True`), `parallel`,
    `fixed_parallel` or none."""
    drawn = np.random.default_rng([seed, 61]).random(5)
    arms = bool(drawn[0] < 0.5) if blade is None else blade == "push_arms"
    return Dozer(
        seed, arms=arms, dual=bool(drawn[1] < 0.4) if dual is None else dual,
        wings=bool(drawn[2] < 0.5) and arms if wings is None else wings,
        high=bool(drawn[3] < 0.4) if high is None else high,
        ripper=_ripper(bool(drawn[4] < 0.3) if ripper is None else ripper), embedded=embedded,
    ).draw()  # fmt: skip
