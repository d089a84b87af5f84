"""Parametric motor graders straight as `Assembly` objects, with the truth: the cab before or behind the articulation,
the lift cylinders in gimbals or on studs, a drawbar of two arms or one beam, a ripper or none.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are. The frames
stand at an angle, the front wheels lean and are steered, the blade is angled, tipped, shifted and sloped.
"""

from __future__ import annotations

import itertools
import math

import numpy as np
from scipy.optimize import brentq

from kit.machines.crawler import merged
from kit.machines.dozers import raised, yawed
from kit.machines.grader_blades import GraderBlade
from kit.machines.solids import Array, around, bolt, box, place, plate, tube
from kit.machines.steered_chassis import SIDES
from kit.machines.synthetic import Machine, X, Y, Z, turn_about_x

HUB = 0.05
"""Half of a lean yoke's hub, lengthwise."""
POST = 0.04
"""Half of its post."""


def about(point: Array, axis: Array, angle: float) -> Array:
    """(4, 4) that turns about a line through a point."""
    x, y, z = axis / np.linalg.norm(axis)
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] += math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew
    matrix[:3, 3] = point - matrix[:3, :3] @ point
    return matrix


class Grader(GraderBlade):
    """One machine from one generator of random numbers."""

    def __init__(
        self, seed: int, *, cab_behind: bool, gimbals: bool, beamed: bool, ripper: bool, embedded: bool,
    ) -> None:  # fmt: skip
        self.cab_behind, self.gimbals, self.beamed = cab_behind, gimbals, beamed
        self.ripper = ripper
        super().__init__(seed, twin=True, steered=True, embedded=embedded, stop=False, hoses=0)
        self.m.title = "GRADER"

    def link_pins(self) -> None:
        u, s = self.rng.uniform, self.s
        self.t, self.pin_r, self.eye_w = 0.04 * s * u(0.9, 1.1), 0.026 * s * u(0.9, 1.15), 0.045 * s
        self.clearance = float(self.rng.choice([0.0, 0.0001, 0.0003])) * s
        self.gap = float(self.rng.choice([0.0, 0.001, 0.002])) * s
        self.P = {}
        # Wheels
        self.front = (4.65 if self.cab_behind else 5.25) * u(0.96, 1.05)
        self.tandem = -(1.65 if self.cab_behind else 0.88) * u(0.97, 1.06)
        self.high = 0.66 * u(0.94, 1.06)
        self.tyre_r, self.tyre_w, self.tread = self.high * s, 0.4 * s * u(0.88, 1.12), 2.08 * s * u(0.96, 1.06)
        self.spacing = max(1.5 * u(0.97, 1.06), 2.07 * self.high)
        self.king = 0.5 * self.tread / s - 0.37 * u(0.98, 1.04)
        self.lean_y = self.king - 0.13
        # Frames
        self.beam, self.low = 0.14 * u(0.9, 1.15), self.high + 0.36
        self.arch = 1.52 * u(0.98, 1.05)
        # Blade
        self.nose = np.array([self.front - 0.45, 0.0, self.high + 0.2])
        self.circle_x = self.front - 2.58 * u(0.97, 1.03)
        self.ring_r, self.table_z = 0.74 * u(0.95, 1.06), 0.86 * u(0.99, 1.02)
        self.saddle_x, self.saddle_z = self.circle_x + 0.25 * u(0.8, 1.2), self.arch + 0.45
        self.foot_y, self.lift_x = 0.62 * u(0.95, 1.08), 0.2 * u(0.6, 1.2)
        self.centre_x, self.centre_foot = self.saddle_x + 0.27, (-0.68 * u(0.95, 1.05), 1.32 * u(0.97, 1.04))
        self.ball_r, self.above = 0.048 * s * u(0.9, 1.1), 0.72 * u(0.9, 1.1)
        self.arm_y = 0.52 * u(0.95, 1.04)
        self.pivot = (self.circle_x - 0.2, 0.2)
        self.back, self.rail_z = self.circle_x + 0.01, (0.14, 0.44)
        self.slack = float(self.rng.choice([0.008, 0.012]))
        self.half_blade, self.tall = 1.83 * u(0.95, 1.1), 0.62 * u(0.95, 1.04)
        # The drawn pose
        some = self.rng.random(9) < 0.6
        drawn = [u(-0.3, 0.3), u(-0.35, 0.35), u(-0.22, 0.22), u(-0.06, 0.06), u(-0.06, 0.06), u(-0.06, 0.06),
                 u(-0.6, 0.6), u(-0.4, 0.4), u(-0.15, 0.15)]  # fmt: skip
        (self.bend, self.steered, self.lean, self.rolled, self.aside, self.sloped, self.turn, self.shifted,
         self.hole) = (float(d) if use else 0.0 for d, use in zip(drawn, some, strict=True))  # fmt: skip
        # A wheel that leans tilts its steering cylinder's pin: there it hangs on balls.
        self.balls = self.lean != 0.0 or bool(u() < 0.3)
        self.steer_ball, self.ball_rise = 0.032 * s, 0.06
        self.lifted, self.tip = float(u(0.03, 0.12)), float(u(-0.05, 0.35))
        self.pitch = {letter: float(u(-0.07, 0.07)) for letter in "lr"}

    def draw(self) -> Machine:
        m, axle = self.m, self.spot(0, 0, self.high + 0.12)
        self.front_frame()
        self.blade_group()
        m.pose = turn_about_x(axle, self.rolled)
        self.axle_group()
        m.pose = self.rear_pose = yawed(self.bend, np.zeros(3))
        self.rear_frame()
        for side, letter in SIDES:
            self.bogie(side, letter)
        if self.ripper:
            self.ripper_group()
        m.pose = np.eye(4)
        self.bends()
        return m

    # ---- frames ----
    def front_frame(self) -> None:
        s, e, body, f, b = self.s, self.e / self.s, "front_frame", self.front, self.beam
        t, gap, low, arch = self.t / s, self.gap / s, 0.96, self.arch
        rise = 0.92 if self.cab_behind else 1.62
        tops = [(0.2, low, low + 0.38), (rise, low, low + 0.38), (rise + 0.52, arch, arch + 0.34),
                (f - 1.05, arch, arch + 0.34), (f - 0.5, self.low, self.low + 0.3),
                (f + 0.4, self.low, self.low + 0.3)]  # fmt: skip
        for k, ((x, a, c), (p, q, r)) in enumerate(itertools.pairwise(tops)):
            self.slab(f"beam {k}", body, "y", 0.0, [(x, a), (x, c), (p, r), (p, q)], thick=2 * b)
        self.block("push plate", body, (f + 0.4 - e, -0.7, self.low - 0.35), (f + 0.5, 0.7, self.low + 0.3))
        self.block("hitch wall", body, (0.15, -0.3, 0.8), (0.2 + e, 0.3, 1.42))
        for z in self.hitch_z:
            for d in (1, -1):
                self.slab("hitch fork", body, "z", z + d * (t + gap), [(0, 0, 0.11), (0.15 + e, 0.25),
                          (0.15 + e, -0.25)], (0, 0, 0.05))  # fmt: skip
            half = 1.6 * t + gap
            self.pin("articulation_pin", body, self.spot(0, 0, z - half), self.spot(0, 0, z + half), radius=0.05 * s)
        px, py = self.bend_foot
        for side, letter in SIDES:
            feet = ((px - 0.12, side * (b - e)), (px + 0.08, side * (b - e)))
            self.ears("bend lug", body, "z", self.bend_z, (px, side * py), *feet)
            self.eared(f"articulation_cylinder_barrel_{letter}_pin", body, "z", self.bend_z, (px, side * py))
        # The saddle's lugs, the axle's, the drawbar's ball.
        x, z, top, off = self.saddle_x, self.saddle_z, arch + 0.34 - e, 0.06 + gap + t / 2
        for d in (1, -1):
            self.slab("saddle lug", body, "x", x + d * off, [(0, z, 0.07), (0.13, top), (-0.13, top)], (0, z))
        self.pinned("saddle_pin", body, "x", (0, z), x - off - 0.7 * t, x + off + 0.7 * t)
        z, off = self.high + 0.12, self.post_x + gap + t / 2
        for d in (1, -1):
            lug: list[tuple[float, ...]] = [(0, z, 0.07), (0.13, self.low + e), (-0.13, self.low + e)]
            self.slab("axle lug", body, "x", f + d * off, lug, (0, z))
        self.pinned("front_axle_pin", body, "x", (0, z), f - off - 0.7 * t, f + off + 0.7 * t)
        x = self.nose[0] + 0.15
        corners: list[tuple[float, ...]] = [(y, z) for y in (0.12, -0.12) for z in (self.nose[2] - 0.1, self.low + e)]
        self.slab("nose bracket", body, "x", x + 0.03, corners, (0.0, self.nose[2], 0.45 * 0.07), thick=0.06)
        self.stud("drawbar_ball_pin", body, self.spot(*self.nose), -X, 0.07 * s, 0.21 * s)
        if not self.cab_behind:
            self.cab(body, 0.22, low + 0.38)

    def cab(self, body: str, x: float, floor: float) -> None:
        """On a beam or a deck of that height, its rear at x."""
        s, e, top = self.s, self.e / self.s, float(self.rng.uniform(3.0, 3.4))
        self.block("cab floor", body, (x, -0.66, floor - e), (x + 1.35, 0.66, floor + 0.05))
        self.block("cab back", body, (x, -0.62, floor + 0.05), (x + 0.06, 0.62, top))
        self.block("cab roof", body, (x - 0.05, -0.7, top), (x + 1.45, 0.7, top + 0.1))
        for side, _ in SIDES:
            y = side * 0.6
            corners: list[tuple[float, ...]] = [(x + 0.06 - e, floor + 0.05), (x + 0.06 - e, top), (x + 1.2, top),
                                                (x + 1.34, floor + 0.05)]  # fmt: skip
            self.slab("cab side", body, "y", y, corners)
            glass = box("glass", 0.8 * s, 0.9 * s, 0.006 * s)
            self.m.add("glass", body, body, glass, place(self.spot(x + 0.6, side * 0.625, 2.3), Y, X))
        self.block("seat", body, (x + 0.3, -0.25, floor + 0.05), (x + 0.8, 0.25, floor + 0.5))
        self.block("console", body, (x + 1.0, -0.2, floor + 0.05), (x + 1.2, 0.2, floor + 0.75))

    def rear_frame(self) -> None:
        s, e, body, x = self.s, self.e / self.s, "rear_frame", self.tandem
        end = self.tandem - 1.85
        self.end = end
        for z in self.hitch_z:
            tongue = [(0, 0, 0.1), (-0.25 - e, 0.26), (-0.25 - e, -0.26)]
            self.slab("tongue", body, "z", z, tongue, (0, 0, 0.05))
        self.block("head", body, (-0.31, -0.42, 0.84), (-0.25, 0.42, 1.38))
        qx, qy = self.bend_eye
        for side, letter in SIDES:
            a, b = sorted((side * 0.34, side * 0.42))
            self.block("rail", body, (end, a, 0.9), (-0.31 + e, b, 1.16))
            feet = ((qx - 0.1, side * (0.42 - e)), (qx + 0.0, side * (0.42 - e)))
            self.ears("bend rod lug", body, "z", self.bend_z, (qx, side * qy), *feet)
            self.eared(f"articulation_piston_rod_{letter}_pin", body, "z", self.bend_z, (qx, side * qy))
            self.block("fender", body, (x - 0.9, *sorted((side * 0.48, side * 1.2))[:1], 1.5),
                       (x + 0.9, sorted((side * 0.48, side * 1.2))[1], 1.52))  # fmt: skip
        for k, at in enumerate((x + 0.35, end + 0.4)):
            self.block(f"cross member {k}", body, (at, -0.34 - e, 0.93), (at + 0.05, 0.34 + e, 1.12))
        reach, r = self.case_y - self.case_t / 2 - self.gap / s, self.high
        housing = tube("axle_housing", 0.15 * s, 0.075 * s, 2 * reach * s)
        tall = 0.9 - r - 0.1
        pad = box("axle_pad", 0.28 * s, 0.08 * s, tall * s)
        shapes = [(pad, place(self.spot(x, side * 0.38, 0.9 - tall / 2), Z, X)) for side, _ in SIDES]
        casting = merged("axle_casting", (housing, place(self.spot(x, -reach, r), Y)), *shapes)
        self.m.add("axle housing", body, body, casting, np.eye(4))
        middle = -1.8 if self.cab_behind else -0.9
        hood = float(self.rng.uniform(2.0, 2.25))
        self.block("engine", body, (end + 0.5, -0.34 - e, 1.0), (middle - 0.2, 0.34 + e, 1.6))
        for side, _ in SIDES:
            a, b = sorted((side * 0.42, side * 0.48))
            self.block("hood side", body, (end + 0.1, a, 1.1), (middle, b, hood))
        self.block("hood top", body, (end + 0.1, -0.48, hood), (middle, 0.48, hood + 0.03))
        self.block("radiator", body, (end + 0.1, -0.42 - e, 1.16), (end + 0.22, 0.42 + e, hood - 0.05))
        self.block("rear wall", body, (end - 0.06, -0.5, 0.75), (end + e, 0.5, 1.5))
        stack = tube("exhaust", 0.06 * s, 0.05 * s, 0.6 * s)
        self.m.add("exhaust", body, body, stack, place(self.spot(end + 1.0, 0.15, hood + 0.03 - e), Z))
        if self.cab_behind:
            self.block("deck", body, (-1.74, -0.6, 1.16 - e), (-0.34, 0.6, 1.38))
            self.cab(body, -1.72, 1.38)
        else:
            self.block("tank", body, (-0.85, -0.45, 1.16 - e), (-0.4, 0.45, float(self.rng.uniform(1.6, 1.9))))
        for k in range(6):
            at = self.spot(end - 0.06, (0.42, -0.42)[k % 2], 0.85 + 0.2 * (k // 2))
            self.m.add("M20", body, body, bolt("wall_bolt", 0.012 * s, 0.06 * s), place(at, -X))

    hitch_z = (0.9, 1.32)
    bend_z, bend_foot, bend_eye = 1.1, (0.8, 0.36), (-0.36, 0.54)
    case_y, case_t = 0.63, 0.13

    def bends(self) -> None:
        """The articulation's cylinders."""
        for side, letter in SIDES:
            (px, py), (qx, qy) = self.bend_foot, self.bend_eye
            P = self.spot(px, side * py, self.bend_z)
            Q = (self.rear_pose @ np.append(self.spot(qx, side * qy, self.bend_z), 1.0))[:3]
            halves = (f"articulation_cylinder_barrel_{letter}", f"articulation_piston_rod_{letter}")
            self.ram(f"bend {letter}", halves, (P, Q), (Z, Z), 0.042 * self.s)

    def bogie(self, side: int, letter: str) -> None:
        s, m, x, r, body = self.s, self.m, self.tandem, self.high, f"bogie_beam_{letter}"
        y, t = self.case_y, self.case_t
        m.pose = self.rear_pose
        out = y + t / 2 + 0.02
        ends = sorted((side * (y - t / 2 - 0.12), side * out))
        self.pin(f"{body}_pin", "rear_frame", self.spot(x, ends[0], r), self.spot(x, ends[1], r), radius=0.075 * s)
        m.pose = self.rear_pose @ raised(self.pitch[letter], self.spot(x, 0, r))
        wheels = {"middle": x + self.spacing / 2, "rear": x - self.spacing / 2}
        case = self.slabbed("case", "y", side * y, [*((w, r, 0.16) for w in wheels.values()), (x, r + 0.02, 0.22)],
                            (x, r, 0.075 + self.clearance / s), thick=t)  # fmt: skip
        face, reach = (y + t / 2) * s, self.tread / 2 - 0.22 * s
        spindle = tube("spindle", 0.09 * s, 0.0, reach - face)
        shapes = [case, *((spindle, place((w * s, side * face, r * s), side * Y)) for w in wheels.values())]
        m.add("tandem case", body, body, merged(body, *shapes), np.eye(4))
        for end, w in wheels.items():
            centre = np.array([w * s, side * self.tread / 2, self.tyre_r])
            self.wheel(f"{end}_wheel_{letter}", body, side, centre, reach)

    # ---- front axle ----
    @property
    def beam_x(self) -> float:
        """Half of the axle's beam, lengthwise: it takes the forks about the yokes' hubs."""
        return HUB + (self.gap + self.t) / self.s

    @property
    def post_x(self) -> float:
        """Half of the axle's post, lengthwise: the bar between the yokes passes before it."""
        return self.beam_x + 0.04

    def axle_group(self) -> None:
        s, e, m, f, r, body = self.s, self.e / self.s, self.m, self.front, self.high, "front_axle"
        bx, ly, t, gap = self.beam_x, self.lean_y, self.t / s, self.gap / s
        low, high, pin_z, axle = r - 0.2, r - 0.04, r + 0.12, m.pose
        wall = ly - 0.14
        self.block("axle beam", body, (f - bx, -wall, low), (f + bx, wall, high))
        post: list[tuple[float, ...]] = [(0, pin_z, 0.08), (0.09, high - e), (-0.09, high - e)]
        self.slab("axle post", body, "x", f, post, (0, pin_z), thick=2 * self.post_x)
        for side, letter in SIDES:
            for d in (1, -1):
                fork: list[tuple[float, ...]] = [(side * ly, r, 0.06), (side * (wall - e), low),
                                                 (side * (wall - e), high)]  # fmt: skip
                self.slab("axle fork", body, "x", f + d * (HUB + gap + t / 2), fork, (side * ly, r))
            reach = bx + 0.3 * t
            self.pinned(f"lean_yoke_{letter}_pin", body, "x", (side * ly, r), f - reach, f + reach)
            z = self.steer_z
            a, b = sorted((side * 0.03, side * 0.12))
            self.block("steering foot", body, (f - bx - 0.03, a, low + 0.02), (f - bx + e, b, z + 0.07))
            feet, role = ((f - bx - 0.03 + e, a), (f - bx - 0.03 + e, b)), f"steering_cylinder_barrel_{letter}_pin"
            at = (self.steer_x, side * 0.09)
            if self.balls:
                shelf, shank = z - self.ball_rise, 0.45 * self.steer_ball / s
                self.slab("steering lug", body, "z", shelf, [(*at, 0.04), *feet], (*at, shank), thick=0.035)
                long = self.ball_rise * s + 0.0175 * s
                self.stud(role, body, self.spot(*at, z), Z, self.steer_ball, long)
            else:
                self.ears("steering lug", body, "z", z, at, *feet)
                self.eared(role, body, "z", z, at)
        lean_x, (fy, fz) = f - POST - gap - 0.5 * self.eye_w / s, (0.185, r + 0.06)
        width = self.lug + t
        self.block("lean foot", body, (lean_x - width, fy - 0.05, high - e), (lean_x + width, fy + 0.05, high + 0.02))
        self.ears("lean lug", body, "x", lean_x, (fy, fz), (fy - 0.05, high + 0.02 - e), (fy + 0.05, high + 0.02 - e))
        self.eared("wheel_lean_cylinder_barrel_pin", body, "x", lean_x, (fy, fz))
        foot = self.world(lean_x, fy, fz)
        yokes = {letter: axle @ turn_about_x(self.spot(0, side * ly, r), self.lean) for side, letter in SIDES}
        for side, letter in SIDES:
            m.pose = yokes[letter]
            self.yoke(side, letter, lean_x)
        m.pose = yokes["l"]
        eye, along = self.world(lean_x, ly, r + 0.17), self.turned(X)
        halves = ("wheel_lean_cylinder_barrel", "wheel_lean_piston_rod")
        self.ram("lean", halves, (foot, eye), (along, along), 0.024 * s)
        # The bar between the yokes stays level.
        shifted = np.eye(4)
        shifted[:3, 3] = (turn_about_x(self.spot(0, ly, r), self.lean) @ np.append(self.spot(f, ly, r + 0.28), 1.0))[
            :3
        ] - self.spot(f, ly, r + 0.28)
        m.pose = axle @ shifted
        bar = [(ly, r + 0.28, 1.6 * self.pin_r / s), (-ly, r + 0.28, 1.6 * self.pin_r / s)]
        self.slab("leaning bar", "leaning_bar", "x", f + POST + gap + 0.02, bar, (ly, r + 0.28), (-ly, r + 0.28),
                  thick=0.04)  # fmt: skip
        self.knuckles(axle, yokes)

    @property
    def arm_z(self) -> float:
        return self.high - 0.04

    @property
    def steer_z(self) -> float:
        """Height of the steering cylinders' eyes, above the knuckles' arms."""
        return self.arm_z + (self.ball_rise if self.balls else 0.0215 + (self.gap + 0.5 * self.eye_w) / self.s)

    @property
    def steer_x(self) -> float:
        """Where the steering cylinders' feet are."""
        return self.front - self.beam_x - 0.115

    @property
    def tie_z(self) -> float:
        return self.arm_z - 0.0215 - self.gap / self.s - 0.02

    def yoke(self, side: int, letter: str, lean_x: float) -> None:
        """A hub on its pin, a post up to the bar, two plates about the knuckle: one casting."""
        s, f, r, body = self.s, self.front, self.high, f"lean_yoke_{letter}"
        y, k, gap = side * self.lean_y, side * self.king, self.gap / s
        hub = plate("yoke_hub", around((0, 0, 0.055 * s)), 2 * HUB * s, [(0, 0, self.bore_r)])
        holes = [(y, r + 0.28), (y, r + 0.17)] if letter == "l" else [(y, r + 0.28)]
        post = self.slabbed("post", "x", f, [(y, r + 0.1, 0.05), (y, r + 0.28, 0.042)], *holes, thick=2 * POST)
        neck = self.slabbed("neck", "x", f, [(y + side * 0.04, r - 0.1), (y + side * 0.07, r - 0.1),
                            (y + side * 0.04, r + 0.1), (y + side * 0.07, r + 0.1)], thick=2 * POST)  # fmt: skip
        plates = [
            self.slabbed(f"king_{d}", "z", r + d * 0.085, [(f, k, 0.055), (f - 0.045, y + side * 0.04),
                         (f + 0.045, y + side * 0.04)], (f, k), thick=0.035)
            for d in (1, -1)
        ]  # fmt: skip
        shape = merged(f"{body}_casting", (hub, place(self.spot(f, y, r), X, Y)), post, neck, *plates)
        self.m.add("lean yoke", body, body, shape, np.eye(4))
        self.pinned(f"knuckle_{letter}_pin", body, "z", (f, k), r - 0.12, r + 0.12)
        front = f + POST + gap + 0.05
        self.pinned(f"leaning_bar_{letter}_pin", body, "x", (y, r + 0.28), f - POST - 0.01, front)
        if letter == "l":
            back = lean_x - 0.5 * self.eye_w / s - 0.01
            self.pinned("wheel_lean_piston_rod_pin", body, "x", (y, r + 0.17), back, f + POST)

    def knuckles(self, axle: Array, yokes: dict[str, Array]) -> None:
        """Both knuckles with their wheels, steering cylinders, and the tie rod between: it keeps its length."""
        s, m, f, r = self.s, self.m, self.front, self.high
        tie, eye = (f - 0.31, self.king - 0.04), (f - 0.2, self.king - 0.02)

        def pose(side: int, letter: str, angle: float) -> Array:
            return yokes[letter] @ about(self.spot(f, side * self.king, r), Z, angle)

        def end(side: int, letter: str, angle: float) -> Array:
            at = self.spot(tie[0], side * tie[1], self.tie_z)
            return np.asarray((pose(side, letter, angle) @ np.append(at, 1.0))[:3])

        length = 2 * tie[1] * s
        left = end(1, "l", self.steered)
        right = brentq(
            lambda a: float(np.linalg.norm(end(-1, "r", a) - left)) - length, self.steered - 0.25, self.steered + 0.25
        )
        shapes = []
        ends = {"l": left, "r": end(-1, "r", right)}
        way = ends["r"] - ends["l"]
        for (side, letter), angle in zip(SIDES, (self.steered, right), strict=True):
            m.pose = pose(side, letter, angle)
            self.knuckle(side, letter, tie, eye)  # type: ignore[arg-type, call-arg]
            up, q = self.turned(Z), self.world(eye[0], side * eye[1], self.steer_z)
            ring = plate(f"tie_eye{side}", around((0, 0, 1.6 * self.pin_r)), 0.04 * s, [(0, 0, self.bore_r)])
            shapes.append((ring, place(ends[letter], up, way)))
            foot = np.append(self.spot(self.steer_x, side * 0.09, self.steer_z), 1.0)
            halves = (f"steering_cylinder_barrel_{letter}", f"steering_piston_rod_{letter}")
            radii = (self.steer_ball if self.balls else 0.0,) * 2
            self.ram(f"steer {letter}", halves, ((axle @ foot)[:3], q), (axle[:3, 2], up), 0.028 * s, balls=radii)
        m.pose = np.eye(4)
        full, off = float(np.linalg.norm(way)), 1.2 * self.pin_r
        bar = tube("tie_bar", 0.019 * s, 0.0, full - 2 * off)
        shapes.append((bar, place(ends["l"] + off * way / full, way)))
        m.add("tie rod", "tie_rod", "tie_rod", merged("tie_rod", *shapes), np.eye(4))

    def knuckle(  # type: ignore[override]
        self, side: int, letter: str, tie: tuple[float, float], eye: tuple[float, float]
    ) -> None:
        """A hub between the yoke's plates, a spindle, an arm to the rear: one casting, with the wheel."""
        s, f, r, body, k = self.s, self.front, self.high, f"knuckle_{letter}", side * self.king
        half = 0.0675 - self.gap / s
        hub = plate("knuckle_hub", around((0, 0, 0.058 * s)), 2 * half * s, [(0, 0, self.bore_r)])
        (tx, ty), (ex, ey) = (tie[0], side * tie[1]), (eye[0], side * eye[1])
        pin = self.pin_r / s
        shank = 0.45 * self.steer_ball / s if self.balls else pin
        arm = self.slabbed(f"arm{side}", "z", self.arm_z, [(f, k, 0.055), (tx, ty, 1.7 * pin), (ex, ey, 1.7 * pin)],
                           (f, k), (tx, ty, pin), (ex, ey, shank), thick=0.035)  # fmt: skip
        reach, start = self.tread / 2 - 0.22 * s, (self.king + 0.045) * s
        spindle = tube("front_spindle", 0.055 * s, 0.0, reach - start)
        shape = merged(f"{body}_casting", (hub, place(self.spot(f, k, r), Z, X)), arm,
                       (spindle, place((f * s, side * start, r * s), side * Y)))  # fmt: skip
        self.m.add("knuckle", body, body, shape, np.eye(4))
        self.wheel(f"front_wheel_{letter}", body, side, np.array([f * s, side * self.tread / 2, self.tyre_r]), reach)
        self.pinned(f"tie_rod_{letter}_pin", body, "z", (tx, ty), self.tie_z - 0.03, self.arm_z + 0.0175)
        role = f"steering_piston_rod_{letter}_pin"
        if self.balls:
            long = self.ball_rise * s + 0.0175 * s
            self.stud(role, body, self.spot(ex, ey, self.steer_z), Z, self.steer_ball, long)
        else:
            self.pinned(role, body, "z", (ex, ey), self.arm_z - 0.0175, self.steer_z + 0.03)

    # ---- ripper ----
    def ripper_group(self) -> None:
        s, e, m, body, x = self.s, self.e / self.s, self.m, "ripper_beam", self.end - 0.06
        t, gap, y = self.t / s, self.gap / s, 0.22
        pivot, foot, eye, up = (x - 0.09, 0.66), (x - 0.1, 1.38), (x - 0.48, 0.82), float(self.rng.uniform(0.0, 0.2))
        outer, rear = y + 2 * self.lug + t, self.rear_pose
        lifted = rear @ raised(-up, self.spot(pivot[0], 0, pivot[1]))
        for side, letter in SIDES:
            m.pose = rear
            self.ears("ripper lug", "rear_frame", "y", side * y, foot, (x + e, 1.28), (x + e, 1.48))
            self.eared(f"ripper_lift_cylinder_barrel_{letter}_pin", "rear_frame", "y", side * y, foot)
            hinge: list[tuple[float, ...]] = [(*pivot, 0.07), (x + e, 0.78), (x + e, 0.95)]
            self.slab("ripper hinge", "rear_frame", "y", side * outer, hinge, pivot)
            ends = sorted((side * (outer - 0.7 * t), side * (outer + 1.7 * t + gap)))
            self.pinned("ripper_beam_pin", "rear_frame", "y", pivot, *ends)
            start = self.world(foot[0], side * y, foot[1])
            m.pose = lifted
            arm: list[tuple[float, ...]] = [(*pivot, 0.07), (x - 0.4 - e, 0.52), (x - 0.4 - e, 0.66)]
            self.slab("ripper arm", body, "y", side * (outer + t + gap), arm, pivot)
            self.ears("ripper rod lug", body, "y", side * y, eye, (x - 0.56, 0.68 - e), (x - 0.42, 0.68 - e))
            self.eared(f"ripper_lift_piston_rod_{letter}_pin", body, "y", side * y, eye)
            halves = (f"ripper_lift_cylinder_barrel_{letter}", f"ripper_lift_piston_rod_{letter}")
            across = self.turned(Y)
            self.ram(f"ripper {letter}", halves, (start, self.world(eye[0], side * y, eye[1])), (across, across),
                     0.042 * s)  # fmt: skip
        half = float(self.rng.uniform(0.85, 1.0))
        self.block("ripper beam", body, (x - 0.6, -half, 0.5), (x - 0.4, half, 0.68))
        count = int(self.rng.choice([3, 5]))
        for k, at in enumerate(np.linspace(0.08 - half, half - 0.08, count)):
            shank: list[tuple[float, ...]] = [(x - 0.6 + e, 0.78), (x - 0.6 + e, 0.5), (x - 0.66, 0.78),
                                              (x - 0.78, 0.1), (x - 0.72, 0.1)]  # fmt: skip
            self.slab("ripper shank", body, "y", float(at), shank, thick=0.05, role=f"ripper_shank_{k + 1}")
        m.pose = rear


def grader(
    seed: int, *, cab_behind: bool | None = None, gimbals: bool | None = None, ripper: bool | None = None,
    embedded: bool = False,
) -> Machine:  # fmt: skip
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's."""
    drawn = np.random.default_rng([seed, 67]).random(4)
    return Grader(
        seed, cab_behind=bool(drawn[0] < 0.4) if cab_behind is None else cab_behind,
        gimbals=bool(drawn[1] < 0.6) if gimbals is None else gimbals,
        ripper=bool(drawn[2] < 0.5) if ripper is None else ripper,
        beamed=bool(drawn[3] < 0.4), embedded=embedded,
    ).draw()  # fmt: skip
