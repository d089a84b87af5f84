"""Parametric rollers straight as `Assembly` objects, with the truth: one drum ahead of driven wheels, or two drums,
on journals in their frames' plates; a shell with heads, or one can; two steering cylinders, or one.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are. The
steering stands at an angle, the front frame is rolled.
"""

from __future__ import annotations

import numpy as np

from kit.machines.articulated_trucks import SIDES, ArticulatedTruck, beside
from kit.machines.crawler import merged
from kit.machines.solids import around, box, lathe, place, plate, tube
from kit.machines.synthetic import Machine, X, Y, Z, turn_about_x, turn_z

STEERING = ((-0.78, 0.34), (0.14, 0.27))
"""Barrel's pin on the rear frame, rod's on the hitch, from above, in a machine of size 1."""


class Roller(ArticulatedTruck):
    """One machine from one generator of random numbers."""

    def __init__(self, seed: int, *, tandem: bool, twin: bool, embedded: bool) -> None:
        self.tandem = tandem
        self.steered: tuple[tuple[int, str], ...] = tuple((side, f"_{letter}") for side, letter in SIDES)
        self.steered = self.steered if twin else ((-1, ""),)
        super().__init__(seed, beams=False, race=False, embedded=embedded)
        u, s = self.rng.uniform, self.s
        self.m.title = "ROLLER"
        self.can = bool(u() < 0.5)
        self.drum_r, self.half = 0.7 * s * u(0.88, 1.08), 1.0 * s * u(0.88, 1.06)
        self.tyre_r, self.tyre_w, self.tread = 0.76 * s * u(0.96, 1.04), 0.5 * s * u(0.9, 1.08), 1.7 * s
        self.front_x, self.rear_x = 1.72 * s * u(0.98, 1.1), -1.72 * s * u(0.98, 1.1)
        self.steer, self.rolled = float(u(-0.4, 0.4)), float(u(-0.12, 0.12))
        # Clear of the steering cylinders.
        self.rear_x = min(self.rear_x, -self.drum_r - 1.1 * s)
        self.z = self.drum_r + 0.3 * s
        self.roll_r, self.y_rail = s * float(u(0.15, 0.19)), 0.46 * s
        self.low, self.high = self.z - 0.34 * s, self.z + 0.34 * s

    def link_pins(self) -> None:
        self.P = {}
        self.SP = [self.s * np.array([*v, 0.0]) * self.rng.uniform(0.98, 1.02, 3) for v in STEERING]  # type: ignore[assignment]

    def draw(self) -> Machine:
        self.SP = [np.array([*p[:2], self.z]) for p in self.SP]  # type: ignore[assignment]
        self.rear_end()
        self.m.pose = self.bent = turn_z(self.steer)
        self.hitch()
        self.m.pose = self.bent @ turn_about_x(np.array([0.0, 0.0, self.z]), self.rolled)
        self.front_end()
        self.m.pose = np.eye(4)
        for side, suffix in self.steered:
            p, q = (at * np.array([1, side, 1]) for at in self.SP)
            names = (f"steering_cylinder_barrel{suffix}", f"steering_piston_rod{suffix}")
            self.cylinder(f"steer{suffix}", *names, p, (self.bent @ np.append(q, 1.0))[:3], Z, 0.035 * self.s)
        return self.m

    # ---- behind ----
    def rear_end(self) -> None:
        s, t, e, y, body = self.s, self.t, self.e, self.y_rail, "rear_frame"
        wall, half, inner = -0.42, (y + t / 2) / s, y - t / 2
        x = self.rear_x / s
        end = x + self.drum_r / s + 0.12 if self.tandem else x - 0.7
        low, high = self.low / s, self.high / s
        foremost = end if self.tandem else -0.98
        for side, _ in SIDES:
            self.block("rail", body, *beside(side, (foremost, wall), inner / s, half, (low, high)))
            if end < foremost - 0.01:
                self.block("long rail", body, *beside(side, (end, foremost), inner / s, half, (low + 0.36, high)))
        for side, suffix in self.steered:
            p = self.SP[0] * np.array([1, side, 1])
            lug = around((p[0], p[1], 1.7 * self.pin_r), (p[0] + 0.12 * s, side * (inner + e), 0),
                         (p[0] - 0.1 * s, side * (inner + e), 0))  # fmt: skip
            self.upright_lugs("steering lug", body, p, lug)
            self.upright(f"steering_cylinder_barrel{suffix}_pin", body, p, self.eye_w / 2 + self.gap + 0.6 * t)
        # Above and below the steering cylinders, which go through between.
        gap, between = (0.5 * self.eye_w + t) / s, (inner + e) / s
        z = self.z / s
        self.block("bulkhead low", body, (wall - 0.04, -between, low), (wall, between, z - gap))
        self.block("bulkhead high", body, (wall - 0.04, -between, z + gap), (wall, between, high))
        self.forks_behind(body, wall * s)
        if self.tandem:
            self.frame_about(body, "rear_drum", self.rear_x)
            top = 2 * self.drum_r / s + 0.1
            self.block("post", body, (end - 0.1, -0.5, high), (end, 0.5, max(top, high + 0.1)))
            self.block(
                "engine bed", body, (x - 0.8, -0.6, max(top, high + 0.1)), (end, 0.6, max(top, high + 0.1) + 0.05)
            )
            self.block("engine", body, (x - 0.6, -0.4, max(top, high + 0.1) + 0.05), (x + 0.4, 0.4, top + 0.75))
        else:
            a = self.tyre_r / s
            self.block("axle case", body, (x - 0.2, -0.3, a - 0.17), (x + 0.2, 0.3, low + 0.3))
            self.block("axle pad", body, (x - 0.2, -half, low + 0.3), (x + 0.2, half, low + 0.36))
            for side, letter in SIDES:
                self.stub(f"rear_wheel_{letter}", body, side, self.rear_x, 0.3 * s, 0.8)
            self.block("engine bed", body, (end, -half, high), (x + 0.4, half, high + 0.04))
            self.block("hood", body, (end, -half, high + 0.04), (x + 0.4, half, high + 0.7))
        self.block("platform", body, (end + (0 if self.tandem else 0.9), -0.5, high + 0.04), (-0.1, 0.5, high + 0.08))
        self.block("platform foot", body, (wall - 0.04, -half, high), (wall, half, high + 0.04))
        roof = high + float(self.rng.uniform(1.4, 1.7))
        for side, _ in SIDES:
            self.block("post", body, *beside(side, (wall - 0.1, wall), 0.4, 0.46, (high + 0.08, roof)))
        self.block("roof", body, (wall - 0.7, -0.7, roof), (wall + 0.2, 0.7, roof + 0.05))

    def forks_behind(self, body: str, wall: float) -> None:
        """Two plates about each of the hitch's, with a pin."""
        s, t = self.s, self.t
        self.art_r = 1.1 * self.pin_r
        self.z_plates = (self.z - 0.26 * s, self.z + 0.26 * s)
        outline = around((0, 0, 2 * self.art_r), (wall - self.e, 0.26 * s, 0), (wall - self.e, -0.26 * s, 0))
        shape = plate("fork", outline, t, [(0, 0, self.art_r)])
        for z in self.z_plates:
            for d in (1, -1):
                self.m.add("fork", body, body, shape, place((0, 0, z + d * (1.25 * t + self.gap)), Z, X))
            h = 1.8 * t + self.gap
            self.pin("articulation_pin", body, np.array([0, 0, z - h]), np.array([0, 0, z + h]), radius=self.art_r)

    # ---- the hitch ----
    def hitch(self) -> None:
        s, t, e, m, body = self.s, self.t, self.e, self.m, "hitch"
        wall, hole = 0.34 * s, self.art_r * (1.2 if self.bushes else 1.0)
        outline = around((0, 0, 2 * self.art_r), (wall + e, 0.26 * s, 0), (wall + e, -0.26 * s, 0))
        for z in self.z_plates:
            shape = plate("hitch_plate", outline, 1.5 * t, [(0, 0, hole)])
            m.add("hitch plate", body, body, shape, place((0, 0, z), Z, X))
            if self.bushes:
                m.add("bush", body, body, tube("hitch_bush", hole, self.art_r, 1.5 * t), place((0, 0, z - 0.75 * t), Z))
        z = self.z / s
        self.block("hitch wall", body, (0.34, -0.36, z - 0.34), (0.4, 0.36, z + 0.34))
        ring = tube("hitch_ring", 1.35 * self.roll_r, self.roll_r + self.clearance, 0.24 * s)
        m.add("hitch ring", body, body, ring, place((0.4 * s - e, 0, self.z), X))
        for side, suffix in self.steered:
            q = self.SP[1] * np.array([1, side, 1])
            lug = around((q[0], q[1], 1.7 * self.pin_r), (wall + e, q[1] + 0.04 * s, 0), (wall + e, q[1] - 0.1 * s, 0))
            self.upright_lugs("hitch lug", body, q, lug)
            self.upright(f"steering_piston_rod{suffix}_pin", body, q, self.eye_w / 2 + self.gap + 0.6 * t)

    # ---- ahead ----
    def front_end(self) -> None:
        s, body, x = self.s, "front_frame", self.front_x / self.s
        self.frame_about(body, "front_drum", self.front_x)
        r = self.drum_r / s
        top = 2 * r + 0.08
        for start in (x + r + 0.06, x - r - 0.14):
            self.block(
                "tank post", body, (start, -0.5, self.high / s), (start + 0.08, 0.5, max(top, self.high / s + 0.1))
            )
        base = max(top, self.high / s + 0.1)
        self.block("tank", body, (x - r - 0.14, -0.8, base), (x + r + 0.14, 0.8, base + 0.3))

    def frame_about(self, body: str, drum: str, x: float) -> None:
        """A drum in its frame: side plates and two cross beams, ahead the one with the tube that rolls."""
        s, t, e, m, r = self.s, self.t, self.e, self.m, self.drum_r
        near, far = r + 0.06 * s, r + 0.14 * s
        shaft = 0.09 * s
        y = self.half + 0.02 * s + t / 2
        wide = 2.0 * shaft
        low, high = self.z - 0.1 * s, self.high
        hole = shaft + self.clearance
        outline = around((x, r, wide), (x + far, low, 0), (x + far, high, 0), (x - far, high, 0), (x - far, low, 0))
        for side, _ in SIDES:
            self.side_plate("drum side", body, side * y, outline, "", [(x, r, hole)])
        inner = (y - t / 2 + e) / s
        z0, z1 = low / s, high / s
        self.block("cross beam", body, ((x + near) / s, -inner, z0), ((x + far) / s, inner, z1))
        beam = box(f"beam_{body}", far - near, 2 * inner * s, high - low)
        at = place((x - 0.5 * (near + far), 0, 0.5 * (low + high)), Z, X)
        if body == "front_frame":
            start = 0.44 * s
            bar = tube("roll_tube", self.roll_r, 0.8 * self.roll_r, x - far + 0.01 * s - start)
            m.add("head beam", body, body, merged("head", (beam, at), (bar, place((start, 0, self.z), X))), np.eye(4))
        else:
            m.add("cross beam", body, body, beam, at)
        self.drum(drum, x, y + t / 2, shaft)

    def drum(self, drum: str, x: float, out: float, shaft: float) -> None:
        """The drum, with journals as far `out` as the plates' outer faces."""
        s, m, r, h = self.s, self.m, self.drum_r, self.half
        wall, centre, head = 0.025 * s, np.array([x, 0.0, self.drum_r]), 0.84 * self.half
        bore = shaft
        if self.can:
            k = head + wall
            i = r - wall
            profile = [(bore, -k), (i, -k), (i, -h), (r, -h), (r, h), (i, h), (i, k), (bore, k)]
            profile += [(bore, head), (i, head), (i, -head), (bore, -head)]
            m.add("drum", drum, drum, lathe(f"can_{drum}", profile), place(centre, Y))
        else:
            m.add("shell", drum, drum, tube(f"shell_{drum}", r, r - wall, 2 * h), place(centre - h * Y, Y))
            for side in (1, -1):
                disc = tube(f"head_{drum}", r - wall, bore, wall)
                m.add("head", drum, drum, disc, place(centre + side * head * Y, side * Y))
        start = head - 0.02 * s
        for side in (1, -1):
            bar = tube(f"shaft_{drum}", shaft, 0.0, out - start)
            m.add("shaft", drum, drum, bar, place(centre + side * start * Y, side * Y))


def roller(seed: int, *, tandem: bool | None = None, twin: bool | None = None, embedded: bool = False) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's. `twin`:
    whether two cylinders steer it, or the right one alone."""
    drawn = np.random.default_rng([seed, 47]).random(2)
    tandem = bool(drawn[0] < 0.5) if tandem is None else tandem
    twin = bool(drawn[1] < 0.75) if twin is None else twin
    return Roller(seed, tandem=tandem, twin=twin, embedded=embedded).draw()
