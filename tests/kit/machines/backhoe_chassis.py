"""The carrier of the drawn backhoe loaders: their pins, chassis, swing post."""

from __future__ import annotations

import math

import numpy as np

from kit.machines.solids import Array, around
from kit.machines.steered_chassis import SIDES, SteeredChassis
from kit.machines.synthetic import X, meet, polar

SWING = -1.36
"""The swing pivot, from the rear axle."""


class BackhoeChassis(SteeredChassis):
    """One machine from one generator of random numbers; the backhoe's pins are in its own plane, backward from the
    swing pivot."""

    def __init__(self, seed: int, *, parallel: bool, extending: bool, embedded: bool, all_steer: bool = False) -> None:
        self.parallel, self.extending, self.all_steer = parallel, extending, all_steer
        super().__init__(seed, twin=True, steered=False, embedded=embedded, stop=False, hoses=0)
        u, s = self.rng.uniform, self.s
        self.m.title, self.t, self.e = "BACKHOE LOADER", 0.026 * s, 0.003 * s if embedded else 0.0
        self.pin_r, self.eye_w = 0.03 * s * u(0.9, 1.12), 0.062 * s
        self.clearance = float(self.rng.choice([0.0, 0.0001, 0.0003])) * s
        self.gap = float(self.rng.choice([0.0, 0.001, 0.002])) * s
        self.tyre_r, self.tyre_w, self.tread = 0.715 * s, 0.42 * s * u(0.92, 1.05), 1.8 * s * u(0.99, 1.03)
        self.front_x, self.y_arm, self.y_lift = 2.17 * s * u(0.98, 1.04), 0.44 * s, 0.3 * s
        self.axle_z, self.front_r = 0.54 * s, 0.47 * s * u(0.97, 1.03)
        self.back = np.diag([-1.0, -1.0, 1.0, 1.0])
        self.back[0, 3] = SWING * s

    def link_pins(self) -> None:
        s, k = self.s, self.rng.uniform
        for _ in range(4000):
            try:
                loader, hoe = self.loader_pins(), self.hoe_pins()
            except ValueError:
                continue
            self.P = {name: s * np.asarray(at) for name, at in {**loader, **hoe}.items()}
            self.leg, self.extended = float(k(-0.3, 0.8)), 0.0
            return
        raise RuntimeError("no linkage for this seed")

    def about(self, *at: float) -> Array:
        return np.array(at) * self.rng.uniform(0.98, 1.02, len(at))

    def loader_pins(self) -> dict[str, Array]:
        u, beta = self.rng.uniform, float(self.rng.uniform(-0.45, 0.1))
        a = self.about(1.02, 1.56)
        b, d = a + polar(2.6 * u(0.98, 1.02), beta), a + polar(1.48, beta - 0.02)
        if self.parallel:
            e, g = self.about(0.98, 1.95), a + polar(1.72, beta + 0.06)
            f = g + polar(0.52, float(u(1.3, 1.8)))
            h = g + polar(0.5, math.atan2(*(f - g)[::-1]) - 0.45)
            link, r = 0.86, 0.34
        else:
            e, g = self.about(1.44, 1.48), a + polar(1.575, beta + 0.168)
            angle = float(u(1.0, 1.6))
            f, h, link, r = g + polar(0.775, angle), g + polar(0.372, angle + 2.89), 0.942, 0.23
        j = meet(h, link, b, r, 1.0)
        tilt = float(np.hypot(*(f - e)))
        turned = math.atan2(*(j - b)[::-1]) - 1.76
        if not (0.9 if not self.parallel else 1.35) < tilt < 2.0 or not -0.7 < turned < 0.8 or j[1] < b[1] + 0.1 * r:
            raise ValueError("the bucket stands badly")
        self.shovel = turned
        c = self.about(1.21, 0.99)
        return dict(zip("ABCDEFGHJ", (a, b, c, d, e, f, g, h, j), strict=True))

    def hoe_pins(self) -> dict[str, Array]:
        u, a = self.rng.uniform, np.array([0.125, 1.0])
        boom = float(u(0.95, 1.25))
        arm = boom - float(u(1.0, 1.9))
        b = a + polar(2.75 * u(0.97, 1.03), boom)
        far = 2.1 + float(u(0.15, 0.8)) if self.extending else 2.5 * float(u(0.95, 1.05))
        k, p = b + polar(far, arm), b + polar(0.475, arm + 2.745)
        across = polar(1.0, arm + math.pi / 2)
        e, g = k - polar(1.29, arm) + 0.25 * across, k - polar(0.196, arm) + 0.018 * across
        h = g + polar(0.315, arm + float(u(0.9, 1.9)))
        j = meet(h, 0.29, k, 0.234, 1.0)
        d, m = a + polar(1.26, boom - 0.01), a + polar(1.51, boom + 0.366)
        c = np.array([0.18, 0.645])
        spans = [(d - c, 0.95, 1.55), (p - m, 1.15, 1.83), (h - e, 0.88, 1.4)]
        if k[1] < 1.0:
            raise ValueError("the bucket is in the ground")
        if any(not low < float(np.hypot(*v)) < high for v, low, high in spans):
            raise ValueError("a cylinder does not reach")
        self.boom_angle, self.arm_angle, self.arm_long = boom, arm, far
        return dict(zip("abcdmpkeghj", (a, b, c, d, m, p, k, e, g, h, j), strict=True))

    # ---- chassis ----
    def chassis(self) -> None:
        s, t, e, body, wide = self.s, self.t, self.e, "chassis", 2.2 * self.pin_r
        (ax, az), (cx, cz), (ex, ez) = (self.P[k] for k in "ACE")
        y_in, y_out = self.y_arm - t - self.gap, self.y_arm + t + self.gap
        for side, _ in SIDES:
            low, high = sorted((side * 0.2, side * 0.29))
            self.block("rail", body, (-1.0, low, 0.58), (2.4, high, 0.76))
            low, high = sorted((side * (0.29 - e / s), side * (y_in - t / 2 + e) / s))
            self.block("tower foot", body, (0.92, low, 0.6), (1.3, high, 0.74))
            low, high = sorted((side * (y_in + t / 2 - e) / s, side * (y_out - t / 2 + e) / s))
            self.block("tower spacer", body, (0.94, low, 0.62), (1.08, high, 0.72))
            low, high = sorted((side * (0.29 - e / s), side * 0.56))
            self.block("tank", body, (-0.2, low, 0.7), (0.7, high, 1.08))
            self.block("rear foot", body, ((-1.05 * s + t / 2 - e) / s, low, 0.62), (-0.85, high, 0.74))
        inner = around(
            (0.9 * s, 0.6 * s, 0), (1.33 * s, 0.6 * s, 0), (cx, cz, wide), (1.3 * s, 1.5 * s, 0), (ax, az, wide)
        )
        outer = around((0.9 * s, 0.6 * s, 0), (1.1 * s, 0.6 * s, 0), (ax, az, wide))
        self.plates("tower", body, y_in, inner, "AC")
        self.plates("tower outside", body, y_out, outer, "A")
        y = self.y_lift - self.lug_y
        foot = around((cx - 0.08 * s, 0.76 * s - e, 0), (cx + 0.08 * s, 0.76 * s - e, 0), (cx, cz, wide))
        self.plates("lift lug", body, y, foot, "C")
        half = (y_in - t / 2 + e) / s
        self.block("tower beam", body, (1.18, -half, 1.38), (1.3, half, 1.5))
        if self.parallel:
            for side, letter in SIDES:
                y = side * self.y_tilt
                post = around((ex, ez, wide), (ex - 0.1 * s, 1.5 * s, 0), (ex + 0.12 * s, 1.5 * s, 0), (ax, az, wide))
                for d in (1, -1):
                    self.side_plate("tilt lug", body, y + d * self.lug_y, post, "E")
                a, b = (ax / s - 0.03, az / s + 0.02)
                near, far = self.y_tilt - self.lug_y - t / 2, self.y_tilt + self.lug_y - t / 2
                for start, end in ((y_out + t / 2, near), (near + t, far)):
                    low, high = sorted((side * (start - e) / s, side * (end + e) / s))
                    self.block("tilt foot", body, (a, low, b), (a + 0.1, high, b + 0.1))
                reach = self.lug_y + 0.6 * t
                role = f"loader_bucket_cylinder_barrel_{letter}_pin"
                self.across(role, body, self.P["E"], side, self.y_tilt - reach, self.y_tilt + reach)
        else:
            lug = around((ex, ez, wide), (1.3 * s - e, 1.49 * s, 0), (1.3 * s - e, 1.39 * s, 0))
            self.plates("tilt lug", body, self.lug_y, lug, "E")
            self.through("loader_bucket_cylinder_barrel_pin", body, "E", self.lug_y + 0.6 * t)
        for side, letter in SIDES:
            self.across("loader_arm_pin", body, self.P["A"], side, y_in - t, y_out + t)
            start = self.y_lift - self.lug_y - 0.6 * t
            self.across(f"loader_lift_cylinder_barrel_{letter}_pin", body, self.P["C"], side, start, y_in + 0.5 * t)
            if not self.all_steer:
                self.stub(f"rear_wheel_{letter}", body, side, 0.0, 0.29 * s)
        self.block("hood", body, (1.4, -0.25, 0.76), (2.2, 0.25, 1.3))
        self.block("cab", body, (-0.8, -0.58, 1.08), (0.8, 0.58, float(self.rng.uniform(2.8, 3.1))))
        for x in (0.2, 1.9):
            self.block("cross member", body, (x, -0.2 - e / s, 0.62), (x + 0.05, 0.2 + e / s, 0.74))

    def rear(self) -> None:
        s, t, e, body, r = self.s, self.t, self.e, "chassis", 2.2 * self.pin_r
        y, z, x1, x2 = 0.81 * s, 0.5 * s, -1.05 * s, -1.17 * s
        self.leg_pin, self.leg_top = np.array([y, z]), np.array([0.58 * s, 1.13 * s])
        for side, letter in SIDES:
            pin, top = self.leg_pin * [side, 1], self.leg_top * [side, 1]
            half = around((side * 0.38 * s, 0.56 * s, 0), (*pin, r), (side * 1.15 * s, 0.62 * s, 0),
                          (side * 1.15 * s, 0.9 * s, 0),
                          (side * 0.62 * s, 1.22 * s, 0), (side * 0.38 * s, 1.22 * s, 0))  # fmt: skip
            for x in (x1, x2):
                self.steep("rear plate", body, x, half, tuple(pin), tuple(top))
            low, long = x2 - t, x1 - x2 + 2 * t
            for role, at in ((f"stabilizer_{letter}_pin", pin), (f"stabilizer_cylinder_barrel_{letter}_pin", top)):
                start = np.array([low, *at])
                self.pin(role, body, start, start + long * X)
            self.stabilizer(side, letter, 0.5 * (x1 + x2))
        half = 0.38 + e / s
        for low, high in ((0.5, 0.63), (0.82, 1.22)):
            self.block("rear beam", body, ((x2 - t / 2) / s, -half, low), ((x1 + t / 2) / s, half, high))
        post, wall = np.array([SWING * s, 0.0]), x2 - t / 2 + e
        self.post_z = (0.6 * s, 0.85 * s)
        for level in self.post_z:
            self.level(
                "swing lug", body, level, around((*post, r), (wall, -0.06 * s, 0), (wall, 0.06 * s, 0)), tuple(post)
            )
            self.upright("swing_post_pin", body, np.array([*post, level]), 1.8 * t + self.gap)
        self.swing_z = 0.725 * s
        self.block("swing beam", body, (-0.42, -0.2 - e / s, 0.63), (-0.36, 0.2 + e / s, 0.82))
        self.SB = np.array([-0.47 * s, 0.133 * s])
        self.SR = np.array([SWING * s - 0.026 * s, 0.215 * s])
        for side, letter in SIDES:
            p = self.SB * [1, side]
            lug = around(
                (*p, 1.5 * self.pin_r), (-0.42 * s + e, p[1] - 0.05 * s, 0), (-0.42 * s + e, p[1] + 0.05 * s, 0)
            )
            for d in (1, -1):
                self.level("swing cylinder lug", body, self.swing_z + d * self.lug_y, lug, tuple(p))
            self.upright(
                f"swing_cylinder_barrel_{letter}_pin", body, np.array([*p, self.swing_z]), self.lug_y + 0.6 * t
            )

    def axle(self) -> None:
        width = 0.7 * self.tyre_w
        self.steered_axle("front", self.front_x, self.front_r, width)
        if self.all_steer:
            # Wheels of one size all round, as machines with all-wheel steering have.
            self.steered_axle("rear", 0.0, self.front_r, width, prefix="rear_", fast=True)
