"""Parametric tandem rollers whose drums steer in yokes, straight as `Assembly` objects, with the truth: a frame on two
upright pins, a cylinder beside each.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are. Both yokes
stand at an angle of their own, or straight ahead.
"""

from __future__ import annotations

import numpy as np

from kit.machines.articulated_trucks import SIDES, beside
from kit.machines.rollers import Roller
from kit.machines.solids import Array, around, place, plate, tube
from kit.machines.synthetic import XZ, Machine, X, Z, turn_z

BARREL, ROD = (0.42, 0.5), (-0.12, 0.46)
"""Where a cylinder hangs, from above, in a machine of size 1: from the frame's middle and out of its plane, and from
the yoke's pin towards the middle. On the right, between the yokes."""


LOCK = 0.6
"""How far a yoke turns to one side, radians; as far as its cylinder goes for that, it goes to the other."""


class YokeRoller(Roller):
    """One machine from one generator of random numbers."""

    def __init__(self, seed: int, *, straight: bool, embedded: bool) -> None:
        super().__init__(seed, tandem=True, twin=False, embedded=embedded)
        u, s = self.rng.uniform, self.s
        self.rolled = 0.0
        self.front_x, self.rear_x = (side * 1.85 * s * float(u(0.99, 1.08)) for side in (1, -1))
        turned = 0.0 if straight else 0.25
        self.yaws = {"front_yoke": float(u(-turned, turned)), "rear_yoke": float(u(-turned, turned))}
        self.art_r = 1.1 * self.pin_r
        self.top = 2.0 * self.drum_r + 0.12 * s
        self.z_pin = self.top + 0.24 * s
        self.barrel, self.rod = (self.s * np.array(p) * u(0.97, 1.03, 2) for p in (BARREL, ROD))

    def draw(self) -> Machine:
        self.frame()
        ends = (("front_yoke", "front_drum", self.front_x, 1), ("rear_yoke", "rear_drum", self.rear_x, -1))
        for body, drum, x, ahead in ends:
            pose = turned_at(self.yaws[body], x)
            self.m.pose = pose
            self.yoke(body, drum, x, ahead)
            self.m.pose = np.eye(4)
            name = "front_steering" if ahead > 0 else "rear_steering"
            p = np.array([ahead * self.barrel[0], -self.barrel[1], self.z_pin])
            q = np.array([x + ahead * self.rod[0], -self.rod[1], self.z_pin])
            names = (f"{name}_cylinder_barrel", f"{name}_piston_rod")
            now, low, straight, high = (
                float(np.linalg.norm((turned_at(angle, x) @ np.append(q, 1.0))[:3] - p))
                for angle in (self.yaws[body], -ahead * LOCK, 0.0, ahead * LOCK)
            )
            way = min(straight - low, high - straight)
            ways = (now - straight + way, straight + way - now)
            self.cylinder(name, *names, p, (pose @ np.append(q, 1.0))[:3], Z, 0.05 * self.s, ways=ways)
        return self.m

    # ---- the frame, from one pin to the other ----
    def frame(self) -> None:
        s, t, e, body = self.s, self.t, self.e, "rear_frame"
        z, deck = self.z_pin / s, self.z_pin / s + 0.3
        front, rear = self.front_x / s, self.rear_x / s
        self.block("deck", body, (rear - 0.3, -0.5, deck), (front + 0.3, 0.5, deck + 0.12))
        self.block("engine", body, (-0.6, -0.4, deck + 0.12), (0.3, 0.4, deck + 0.7))
        self.block("hood", body, (-0.65, -0.45, deck + 0.7), (0.35, 0.45, deck + 0.76))
        self.block("platform", body, (front - 0.9, -0.5, deck + 0.12), (front - 0.1, 0.5, deck + 0.16))
        roof = deck + float(self.rng.uniform(1.4, 1.7))
        for side, _ in SIDES:
            self.block("post", body, *beside(side, (front - 0.6, front - 0.5), 0.4, 0.46, (deck + 0.16, roof)))
        self.block("roof", body, (front - 1.2, -0.7, roof), (front, 0.7, roof + 0.05))
        self.block("tank", body, (-0.2, -0.4, 0.7), (0.2, 0.4, deck))
        for x in (front, rear):
            way = -np.sign(x)
            wall = x + way * 0.3
            low, high = sorted((wall, wall + way * 0.06))
            self.block("fork wall", body, (low, -0.24, z - 0.12), (high, 0.24, deck))
            outline = around(
                (x * s, 0, 2 * self.art_r), (wall * s + way * e, 0.2 * s, 0), (wall * s + way * e, -0.2 * s, 0)
            )
            shape = plate(f"yoke_fork_{x:.3f}", outline, t, [(x * s, 0, self.art_r)])
            for d in (1, -1):
                self.m.add("fork", body, body, shape, place((0, 0, self.z_pin + d * (1.25 * t + self.gap)), Z, X))
            role = "front_yoke_pin" if x > 0 else "rear_yoke_pin"
            h = 1.8 * t + self.gap
            at = np.array([x * s, 0, self.z_pin])
            self.pin(role, body, at - h * Z, at + h * Z, radius=self.art_r)
            # Ears of the steering cylinder on a foot under the deck.
            p = np.array([-way * self.barrel[0], -self.barrel[1], self.z_pin])
            foot = p[0] + way * 0.16 * s
            low, high = sorted((foot / s, foot / s + way * 0.08))
            self.block("steering foot", body, (low, -0.6, z - 0.16), (high, -0.4, deck))
            lug = around((p[0], p[1], 1.7 * self.pin_r), (foot + way * e, p[1] + 0.08 * s, 0),
                         (foot + way * e, p[1] - 0.08 * s, 0))  # fmt: skip
            self.upright_lugs("steering lug", body, p, lug)
            role = f"{'front' if x > 0 else 'rear'}_steering_cylinder_barrel_pin"
            self.upright(role, body, p, self.eye_w / 2 + self.gap + 0.6 * t)

    # ---- a yoke about its drum ----
    def yoke(self, body: str, drum: str, x: float, ahead: int) -> None:
        s, t, e, r, m = self.s, self.t, self.e, self.drum_r, self.m
        shaft = 0.09 * s
        y = self.half + 0.02 * s + t / 2
        inner, low = (y - t / 2 + e) / s, self.top / s
        outline = around(
            (x, r, 2.0 * shaft), (x + 0.3 * s, self.top + 0.1 * s, 0), (x - 0.3 * s, self.top + 0.1 * s, 0)
        )
        for side, _ in SIDES:
            shape = plate(f"yoke_side_{body}_{side}", outline, t, [(x, r, shaft + self.clearance)])
            m.add("yoke side", body, body, shape, place((0, side * y, 0), XZ, X))
        a = x / s
        self.block("yoke beam", body, (a - 0.28, -inner, low), (a + 0.28, inner, low + 0.08))
        # A plate between the frame's forks, on posts ahead of and behind them.
        z = self.z_pin / s
        far = 0.34
        hole = self.art_r * (1.2 if self.bushes else 1.0)
        corners = [(x + ahead * 0.26 * s, side * far * s, 0.02 * s) for side in (1, -1)]
        shape = plate(f"yoke_plate_{body}", around((x, 0, 2 * self.art_r), *corners), 1.5 * t, [(x, 0, hole)])
        m.add("yoke plate", body, body, shape, place((0, 0, self.z_pin), Z, X))
        if self.bushes:
            bush = tube("yoke_bush", hole, self.art_r, 1.5 * t)
            m.add("bush", body, body, bush, place((x, 0, self.z_pin - 0.75 * t), Z))
        start, end = sorted((a + ahead * 0.2, a + ahead * 0.28))
        thick = 0.75 * t / s
        self.block("yoke post", body, (start, -0.36, low + 0.08), (end, 0.36, z - thick + e / s))
        # Ears of the steering cylinder.
        q = np.array([x + ahead * self.rod[0], -self.rod[1], self.z_pin])
        post = -0.62
        self.block("steering post", body, (a - 0.1, post - 0.08, low + 0.08), (a + 0.1, post, z + 0.14))
        edge = post * s - e
        lug = around((q[0], q[1], 1.7 * self.pin_r), (x - 0.09 * s, edge, 0), (x + 0.09 * s, edge, 0))
        self.upright_lugs("yoke lug", body, q, lug)
        role = f"{'front' if ahead > 0 else 'rear'}_steering_piston_rod_pin"
        self.upright(role, body, q, self.eye_w / 2 + self.gap + 0.6 * t)
        self.drum(drum, x, y + t / 2, shaft)


def turned_at(angle: float, x: float) -> Array:
    """(4, 4) that turns about the upright line at `x`."""
    turn, there = turn_z(angle), np.eye(4)
    there[0, 3] = x
    return np.asarray(there @ turn @ np.linalg.inv(there))


def yoke_roller(seed: int, *, straight: bool = False, embedded: bool = False) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names; `straight`: with both drums straight
    ahead."""
    return YokeRoller(seed, straight=straight, embedded=embedded).draw()
