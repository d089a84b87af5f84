"""Parametric backhoe loaders straight as `Assembly` objects, with the truth: a loader with a Z-bar, or with levers and
cylinders on either side; a dipper that extends or not; hinged stabilizers; a steered front axle.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are.
"""

from __future__ import annotations

import math

import numpy as np

from kit.machines.crawler import merged
from kit.machines.solids import Array, around, box, lathe, place, plate, tube
from kit.machines.synthetic import XZ, Drawer, Machine, X, Y, Z, meet, polar

SIDES = ((1, "l"), (-1, "r"))
SWING = -1.36
"""The swing pivot, from the rear axle."""


class Backhoe(Drawer):
    """One machine from one generator of random numbers; the backhoe's pins are in its own plane, backward from the
    swing pivot."""

    def __init__(self, seed: int, *, parallel: bool, extending: bool, embedded: bool) -> None:
        self.parallel, self.extending = parallel, extending
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

    def draw(self) -> Machine:
        for group in (self.chassis, self.rear, self.axle, self.arms, self.shovel_parts):
            self.m.pose = np.eye(4)
            group()
        for part in (self.post, self.boom, self.dipper, self.linkage):
            self.m.pose = self.back
            part()
        self.m.pose = np.eye(4)
        self.rams()
        return self.m

    # ---- small things ----
    def plates(self, name: str, body: str, y: float, outline: Array, pins: str, *, both: bool = True) -> None:
        for side in (1, -1) if both else (1,):
            self.side_plate(name, body, side * y, outline, pins)

    def through(self, role: str, body: str, pin: str, half: float) -> None:
        self.across(role, body, self.P[pin], 1, -half, half)

    def upright(self, role: str, body: str, at: Array, half: float) -> None:
        self.pin(role, body, at - half * Z, at + half * Z)

    def level(self, name: str, body: str, z: float, outline: Array, *holes: tuple[float, float]) -> None:
        bores = [(float(x), float(y), self.bore_r) for x, y in holes]
        shape = plate(f"{name}_{z:.4f}_{outline[0, 1]:.4f}", outline, self.t, bores)
        self.m.add(name, body, body, shape, place((0, 0, z), Z, X))

    def steep(self, name: str, body: str, x: float, outline: Array, *holes: tuple[float, float], thick: float = 0.0) -> None:
        """A plate across the machine; its outline and holes are (y, z)."""
        bores = [(float(y), float(z), self.bore_r) for y, z in holes]
        shape = plate(f"{name}_{x:.4f}_{outline[0, 0]:.4f}", outline, thick or self.t, bores)
        self.m.add(name, body, body, shape, place((x, 0, 0), X, Y))

    @property
    def lug_y(self) -> float:
        """Middle of the plates beside a cylinder's eye."""
        return self.eye_w / 2 + self.gap + self.t / 2

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
        inner = around((0.9 * s, 0.6 * s, 0), (1.33 * s, 0.6 * s, 0), (cx, cz, wide), (1.3 * s, 1.5 * s, 0), (ax, az, wide))
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
            half = around((side * 0.38 * s, 0.56 * s, 0), (*pin, r), (side * 1.15 * s, 0.62 * s, 0), (side * 1.15 * s, 0.9 * s, 0),
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
            self.level("swing lug", body, level, around((*post, r), (wall, -0.06 * s, 0), (wall, 0.06 * s, 0)), tuple(post))
            self.upright("swing_post_pin", body, np.array([*post, level]), 1.8 * t + self.gap)
        self.swing_z = 0.725 * s
        self.block("swing beam", body, (-0.42, -0.2 - e / s, 0.63), (-0.36, 0.2 + e / s, 0.82))
        self.SB = np.array([-0.47 * s, 0.133 * s])
        self.SR = np.array([SWING * s - 0.026 * s, 0.215 * s])
        for side, letter in SIDES:
            p = self.SB * [1, side]
            lug = around((*p, 1.5 * self.pin_r), (-0.42 * s + e, p[1] - 0.05 * s, 0), (-0.42 * s + e, p[1] + 0.05 * s, 0))
            for d in (1, -1):
                self.level("swing cylinder lug", body, self.swing_z + d * self.lug_y, lug, tuple(p))
            self.upright(f"swing_cylinder_barrel_{letter}_pin", body, np.array([*p, self.swing_z]), self.lug_y + 0.6 * t)

    def stabilizer(self, side: int, letter: str, x: float) -> None:
        """A leg as two plates with a foot between them."""
        s, t, body, mirror = self.s, self.t, f"stabilizer_{letter}", np.array([side, 1])
        wide = 2.2 * self.pin_r
        foot = self.leg_pin + polar(0.62 * s, self.leg)
        self.leg_rod = self.leg_pin + polar(0.2 * s, self.leg + 0.53)
        pin, end, rod = (p * mirror for p in (self.leg_pin, foot, self.leg_rod))
        outline = around((*pin, wide), (*end, 0.06 * s), (*rod, 1.6 * self.pin_r))
        half = 0.06 * s - t / 2 - self.gap - t / 2
        for d in (1, -1):
            self.steep("leg", body, x + d * half, outline, tuple(pin), tuple(rod))
        inner = half - t / 2 + self.e
        tip = plate("foot", around((*end, 0.058 * s)), 2 * inner)
        self.m.add("foot", body, body, tip, place((x, 0, 0), X, Y))
        start = np.array([x - half - 0.6 * t, *rod])
        self.pin(f"stabilizer_piston_rod_{letter}_pin", body, start, start + 2 * (half + 0.6 * t) * X)

    # ---- the front axle ----
    def axle(self) -> None:
        s, t, e, m, body, x, z = self.s, self.t, self.e, self.m, "front_axle", self.front_x, self.axle_z
        r, king, a = 2.2 * self.pin_r, 0.69 * s, x / s
        self.block("axle beam", body, (a - 0.06, -0.6, z / s - 0.05), (a + 0.06, 0.6, z / s + 0.05))
        rail = 0.2 + e / s
        near, far = 0.16 * s, 0.06 * s + t / 2 - e
        self.block("hanger beam", "chassis", (a - (near - t / 2 + e) / s, -rail, 0.63), (a + (near - t / 2 + e) / s, rail, 0.74))
        for d in (1, -1):
            hanger = around((0, z, r), (0.16 * s, 0.74 * s, 0), (-0.16 * s, 0.74 * s, 0))
            self.steep("hanger", "chassis", x + d * near, hanger, (0.0, z))
            trunnion = around((0, z, r), (0.14 * s, z - 0.04 * s, 0), (0.14 * s, z + 0.04 * s, 0), (-0.14 * s, z + 0.04 * s, 0),
                              (-0.14 * s, z - 0.04 * s, 0))  # fmt: skip
            self.steep("trunnion", body, x + d * far, trunnion, (0.0, z))
            middle = x + d * 0.5 * (near + far)
            span = 0.5 * (near - far) + t
            start = np.array([middle - span, 0.0, z])
            self.pin("front_axle_pin", "chassis", start, start + 2 * span * X)
        arm_x, end_x = x - 0.187 * s, x - 0.212 * s
        ram_z = z - 0.1 * s
        low = ram_z - 0.045 * s
        bore, rod, half = 0.035 * s, 0.02 * s, 0.17 * s
        can = [(rod, -half), (0.05 * s, -half), (0.05 * s, half), (rod, half), (rod, half - 0.03 * s), (bore, half - 0.03 * s),
               (bore, 0.03 * s - half), (rod, 0.03 * s - half)]  # fmt: skip
        shapes = [(lathe("steer_can", can), place((end_x, 0, ram_z), Y))]
        long = x - 0.06 * s + e - end_x - 0.04 * s
        for y in (0.1, -0.1):
            at = (end_x + 0.04 * s + long / 2, y * s, ram_z + 0.04 * s)
            shapes.append((box("ram_foot", long, 0.04 * s, 0.1 * s), place(at, Z, X)))
        m.add("steering barrel", "steering_cylinder_barrel", body, merged("steer_barrel", *shapes), np.eye(4))
        piston = tube("steer_piston", bore, rod, 0.04 * s)
        m.add("steering piston", "steering_piston_rod", "steering_piston_rod", piston, place((end_x, -0.02 * s, ram_z), Y))
        ends = [(tube("steer_rod", rod, 0.0, 0.62 * s), place((end_x, -0.31 * s, ram_z), Y))]
        for side, letter in SIDES:
            k, arm, end = np.array([x, side * king]), np.array([arm_x, side * (king - 0.03 * s)]), np.array([end_x, side * 0.34 * s])
            wall = side * (0.6 * s - e)
            eye = around((*k, r), (x - 0.06 * s, wall, 0), (x + 0.06 * s, wall, 0))
            shape = plate(f"king_eye{side}", eye, 0.09 * s, [(float(k[0]), float(k[1]), self.bore_r)])
            m.add("king eye", body, body, shape, place((0, 0, z), Z, X))
            self.upright(f"knuckle_{letter}_pin", body, np.array([*k, z]), 0.09 * s)
            eye = plate(f"rod_end{side}", around((*end, 1.5 * self.pin_r)), 0.04 * s, [(float(end[0]), float(end[1]), self.pin_r)])
            ends.append((eye, place((0, 0, ram_z), Z, X)))
            tie = around((*arm, 1.6 * self.pin_r), (*end, 1.6 * self.pin_r))
            holes = [(float(q[0]), float(q[1]), self.bore_r) for q in (arm, end)]
            m.add("tie rod", f"tie_rod_{letter}", f"tie_rod_{letter}", plate(f"tie{side}", tie, 0.035 * s, holes),
                  place((0, 0, low), Z, X))  # fmt: skip
            for role, at, owner, top in (
                (f"tie_rod_{letter}_pin", arm, f"knuckle_{letter}", z - 0.044 * s),
                (f"steering_piston_rod_{letter}_pin", end, "steering_piston_rod", ram_z + 0.022 * s),
            ):
                foot = np.array([*at, low - 0.02 * s])
                self.pin(role, owner, foot, foot + (top - foot[2]) * Z)
            self.knuckle(side, letter, k, arm)
        shape = merged("steer_rod_with_ends", *ends)
        m.add("steering rod", "steering_piston_rod", "steering_piston_rod", shape, np.eye(4))

    def knuckle(self, side: int, letter: str, king: Array, arm: Array) -> None:
        """Two plates about the king eye, a web with the spindle, the arm: one casting."""
        s, t, body, x, z = self.s, self.t, f"knuckle_{letter}", self.front_x, self.axle_z
        web, r = side * 0.77 * s, 2.2 * self.pin_r
        fork = around((*king, r), (x - 0.07 * s, web, 0), (x + 0.07 * s, web, 0))
        hole = (float(king[0]), float(king[1]), self.bore_r)
        off = 0.045 * s + t / 2 + max(self.gap, 0.002 * s)
        reach, start = self.tread / 2 - 0.1 * s, 0.79 * s
        low = plate(f"arm{side}", around((*king, r), (*arm, 1.6 * self.pin_r)), t, [hole, (float(arm[0]), float(arm[1]), self.pin_r)])
        shapes = [
            (plate(f"top{side}", fork, t, [hole]), place((0, 0, z + off), Z, X)),
            (plate(f"low{side}", fork, t, [hole]), place((0, 0, z - off), Z, X)),
            (low, place((0, 0, z - off), Z, X)),
            (box("web", 0.14 * s, 0.03 * s, 2 * off + t), place((x, web, z), Z, X)),
            (tube("spindle", 0.05 * s, 0.0, reach - start), place((x, side * start, self.front_r), side * Y)),
        ]
        self.m.add("knuckle", body, body, merged(f"{body}_casting", *shapes), np.eye(4))
        kept = self.tyre_r, self.tyre_w
        self.tyre_r, self.tyre_w = self.front_r, 0.7 * self.tyre_w
        self.wheel(f"front_wheel_{letter}", body, side, np.array([x, side * self.tread / 2, self.front_r]), reach)
        self.tyre_r, self.tyre_w = kept

    # ---- the loader ----
    @property
    def y_tilt(self) -> float:
        """Of the cylinders on either side."""
        return self.y_arm + self.t + 2 * self.gap + 0.5 * self.t + 0.01 * self.s + self.t + self.eye_w / 2 + self.gap

    def arms(self) -> None:
        s, t, body, wide = self.s, self.t, "loader_arm", 2.3 * self.pin_r
        a, b, d, g = (self.P[k] for k in "ABDG")
        along = (b - a) / np.hypot(*(b - a))
        up = np.array([-along[1], along[0]])
        tube_at = a + 1.95 * s * along + 0.2 * s * up if not self.parallel else a + 2.15 * s * along + 0.04 * s * up
        r = 0.05 * s
        outline = around((*a, wide), (*d, wide), (*b, wide), (*tube_at, 2 * r), (*(a + 1.3 * s * along + 0.12 * s * up), 0.08 * s),
                         *(((*g, wide),) if self.parallel else ()))  # fmt: skip
        pins = "ABDG" if self.parallel else "ABD"
        self.plates("arm", body, self.y_arm, outline, pins)
        half = self.y_arm - t / 2 + self.e
        shape = tube("arm_tube", r, 0.8 * r, 2 * half)
        self.m.add("cross tube", body, body, shape, place((tube_at[0], -half, tube_at[1]), Y))
        for side, letter in SIDES:
            self.across(f"loader_lift_piston_rod_{letter}_pin", body, d, side, self.y_lift - self.eye_w / 2, self.y_arm + t)
        if self.parallel:
            for side, _ in SIDES:
                self.across("loader_lever_pin", body, g, side, self.y_arm - t, self.y_tilt + self.lug_y + t)
        else:
            y = self.lug_y + self.t + self.gap
            bracket = around((*g, wide), (*tube_at, 1.6 * r))
            flat = plate("bracket", bracket, t, [(*map(float, g), self.bore_r), (*map(float, tube_at), r)])
            for d_ in (1, -1):
                self.m.add("rocker bracket", body, body, flat, place((0, d_ * y, 0), XZ, X))
            self.through("loader_lever_pin", body, "G", y + t)
        self.lever()

    def lever(self) -> None:
        """The lever's two plates beside cylinder and link, and the link; on either side where the cylinders are twins."""
        s, t, wide = self.s, self.t, 2.0 * self.pin_r
        f, g, h, j = (self.P[k] for k in "FGHJ")
        outline = around((*g, 1.2 * wide), (*f, wide), (*h, wide))
        half, length = self.lug_y + 0.6 * t, float(np.hypot(*(j - h)))
        bar = around((0, 0, wide), (length, 0, wide))
        link = plate("loader_link", bar, self.eye_w, [(0, 0, self.bore_r), (length, 0, self.bore_r)])
        direction = np.array([j[0] - h[0], 0.0, j[1] - h[1]]) / length
        for y, letter in ((self.y_tilt, "_l"), (-self.y_tilt, "_r")) if self.parallel else ((0.0, ""),):
            for d in (1, -1):
                self.side_plate("lever", "loader_lever", y + d * self.lug_y, outline, "FGH")
            hub = tube("lever_hub", 1.5 * self.pin_r, self.bore_r, self.eye_w + 2 * self.gap + 2 * self.e)
            self.m.add("lever hub", "loader_lever", "loader_lever", hub, place((g[0], y - self.eye_w / 2 - self.gap - self.e, g[1]), Y))
            for pin, role in ((f, f"loader_bucket_piston_rod{letter}_pin"), (h, "loader_link_pin")):
                self.across(role, "loader_lever", pin, 1, y - half, y + half)
            self.m.add("loader link", "loader_link", "loader_link", link, place((h[0], y, h[1]), XZ, direction))
            self.across("loader_link_bucket_pin", "loader_bucket", j, 1, y - half, y + half)

    def shovel_parts(self) -> None:
        """The loader bucket, drawn level about its hinge."""
        s, t, m, body, wide = self.s, self.t, self.m, "loader_bucket", 2.2 * self.pin_r
        b, j = self.P["B"], self.P["J"] - self.P["B"]
        c, n = math.cos(self.shovel), math.sin(self.shovel)
        local = np.array([[c, n], [-n, c]]) @ j
        turned = np.eye(4)
        turned[[0, 0, 2, 2], [0, 2, 0, 2]] = c, -n, n, c
        turned[:3, 3] = (b[0], 0.0, b[1])
        m.pose = turned
        back, depth, reach, high, half = 0.13 * s, 0.2 * s, 0.9 * s, 0.6 * s, 1.15 * s
        wall = box("bucket_back", t, 2 * half, high + depth)
        m.add("bucket back", body, body, wall, place((back + t / 2, 0, 0.5 * (high - depth)), Z, X))
        start, long = back + t, reach - back - t - 0.14 * s
        m.add("bucket floor", body, body, box("bucket_floor", long, 2 * half, t), place((start + long / 2, 0, -depth + t / 2), Z, X))
        edge = box("bucket_edge", 0.14 * s, 2 * half, 0.7 * t)
        m.add("bucket edge", "loader_cutting_edge", body, edge, place((reach - 0.07 * s, 0, 0.35 * t - depth), Z, X))
        cheek = around((start, t - depth, 0), (start, high, 0), (start + 0.12 * s, high, 0), (reach - 0.2 * s, t - depth, 0))
        for side, _ in SIDES:
            m.add("cheek", body, body, plate("shovel_cheek", cheek, t), place((0, side * (half - t / 2), 0), XZ, X))
        flush = back + self.e
        ear = around((0, 0, wide), (flush, -0.12 * s, 0), (flush, 0.14 * s, 0))
        shape = plate("shovel_ear", ear, t, [(0, 0, self.bore_r)])
        for side, _ in SIDES:
            for d in (1, -1):
                m.add("ear", body, body, shape, place((0, side * self.y_arm + d * (t + self.gap), 0), XZ, X))
            self.across("loader_bucket_pin", body, np.zeros(2), side, self.y_arm - 2 * t - self.gap, self.y_arm + 2 * t + self.gap)
        lug = around((*local, wide), (flush, local[1] - 0.12 * s, 0), (flush, local[1] + 0.12 * s, 0))
        shape = plate("shovel_lug", lug, t, [(*map(float, local), self.bore_r)])
        for y in (self.y_tilt, -self.y_tilt) if self.parallel else (0.0,):
            for d in (1, -1):
                m.add("link lug", body, body, shape, place((0, y + d * self.lug_y, 0), XZ, X))
        m.pose = np.eye(4)

    # ---- the backhoe ----
    def post(self) -> None:
        s, t, e, body, r = self.s, self.t, self.e, "swing_post", 2.2 * self.pin_r
        a, c, low = self.P["a"], self.P["c"], 0.53 * s
        self.y_post = 0.11 * s + t / 2 + self.gap + t / 2
        inner = self.y_post - t / 2 + e
        for z, d in ((self.post_z[0], -1), (self.post_z[1], 1)):
            corners = [(0.045 * s, -inner, 0), (0.085 * s, -inner, 0), (0.085 * s, inner, 0), (0.045 * s, inner, 0)]
            self.level("post lug", body, z + d * (t + self.gap), around((0, 0, r), *corners), (0.0, 0.0))
        side = around((0.045 * s, low, 0), (0.12 * s, low, 0), (*c, r), (*a, r), (0.045 * s, 0.95 * s, 0))
        self.plates("post side", body, self.y_post, side, "ac")
        self.plates("boom cylinder lug", body, self.lug_y, around((*c, r), (0.05 * s, low + 0.04 * s - e, 0), (0.12 * s, low + 0.04 * s - e, 0)), "c")
        self.block("post floor", body, (0.05, -inner / s, low / s), (0.12, inner / s, low / s + 0.04))
        rod = np.array([0.026 * s, 0.215 * s])
        flush = self.y_post + t / 2 - e
        for sign in (1, -1):
            q = rod * [1, sign]
            ear = around((*q, 1.5 * self.pin_r), (0.05 * s, sign * flush, 0), (0.15 * s, sign * flush, 0))
            for d in (1, -1):
                self.level("swing ear", body, self.swing_z + d * self.lug_y, ear, tuple(q))
            letter = "r" if sign > 0 else "l"  # seen from the machine
            self.upright(f"swing_piston_rod_{letter}_pin", body, np.array([*q, self.swing_z]), self.lug_y + 0.6 * t)
        self.through("boom_pin", body, "a", self.y_post + t)
        self.through("boom_cylinder_barrel_pin", body, "c", self.y_post + t)

    def boom(self) -> None:
        s, t, body, r = self.s, self.t, "boom", 2.2 * self.pin_r
        a, b, d, m = (self.P[k] for k in "abdm")
        y, up = 0.11 * s, polar(1.0, self.boom_angle + math.pi / 2)
        along = polar(1.0, self.boom_angle)
        crown = a + 1.3 * s * along + 0.3 * s * up
        web = around((*a, r), (*(a + 0.4 * s * along + 0.02 * s * up), 0.05 * s), (*b, r), (*crown, 0.1 * s))
        self.plates("boom web", body, y, web, "ab")
        half = y - t / 2 + self.e
        for lug, name, span in (("d", "boom lug", 0.16), ("m", "dipper lug", -0.3)):
            p = self.P[lug]
            foot = p + span * s * up
            outline = around((*p, r), (*(foot + 0.07 * s * along), 0), (*(foot - 0.07 * s * along), 0))
            self.plates(name, body, self.lug_y, outline, lug)
            inner = self.lug_y + t / 2 - self.e
            at = p + 0.9 * span * s * up
            for side in (1, -1):
                shape = box(f"{name}_block", 0.1 * s, half - inner, 0.05 * s)
                x = np.array([along[0], 0.0, along[1]])
                z = np.array([up[0], 0.0, up[1]])
                self.m.add(f"{name} block", body, body, shape, place((at[0], side * 0.5 * (half + inner), at[1]), z, x))
        for share in (0.25, 0.75):
            at = a + share * (b - a) + (0.17 if share < 0.5 else 0.14) * s * up
            shape = box("boom_tie", 0.06 * s, 2 * half, 0.05 * s)
            self.m.add("boom tie", body, body, shape, place((at[0], 0, at[1]), Z, X))
        for pin, role, wide in (("d", "boom_piston_rod_pin", self.lug_y), ("m", "dipper_cylinder_barrel_pin", self.lug_y), ("b", "dipper_pin", y)):
            self.through(role, body, pin, wide + 0.8 * t)

    def dipper(self) -> None:
        s, t, m, r = self.s, self.t, self.m, 2.2 * self.pin_r
        b, k, p, e, g = (self.P[n] for n in "bkpeg")
        along, up = polar(1.0, self.arm_angle), polar(1.0, self.arm_angle + math.pi / 2)
        x, z = np.array([along[0], 0.0, along[1]]), np.array([up[0], 0.0, up[1]])
        half, high, far = 0.062 * s, 0.09 * s, self.arm_long * s
        self.y_ear = half + 0.03 * s
        head = b + 0.25 * s * along
        tail = around((*p, r), (*b, 1.2 * r), (*(head - high * up), 0), (*(head + high * up), 0))
        y = half + t / 2 - self.e
        self.plates("dipper tail", "dipper", y, tail, "bp")
        self.through("dipper_piston_rod_pin", "dipper", "p", y + t)
        end = 1.63 * s if self.extending else far - 0.1 * s
        body = "dipper_extension" if self.extending else "dipper"
        beam = self.hollow("dipper_beam", end - 0.12 * s, half, high, 0.01 * s)
        m.add("dipper beam", "dipper", "dipper", beam, place((*self.on(b, along, 0.12 * s),), x, Y))
        out_y, out_h = half, high
        if self.extending:
            start, gap = far - 1.83 * s, 0.003 * s
            out_y, out_h = half + gap + 0.01 * s, high + gap + 0.01 * s
            box_ = self.hollow("extension_box", far - 0.1 * s - start, out_y, out_h, 0.01 * s)
            m.add("extension", body, body, box_, place((*self.on(b, along, start),), x, Y))
            self.y_ear = out_y + 0.03 * s
        pre = "extension_" if self.extending else ""
        nose_y = out_y + t / 2 - self.e
        foot = k - 0.35 * s * along
        nose = around((*k, r), (*(foot + 0.8 * out_h * up), 0), (*(foot - 0.8 * out_h * up), 0), (*g, r))
        self.plates("nose", body, nose_y, nose, "kg")
        lug = around((*e, r), (*(e - 0.12 * s * along - (0.25 * s - out_h) * up), 0), (*(e + 0.1 * s * along - (0.25 * s - out_h) * up), 0))
        self.plates("bucket cylinder lug", body, self.lug_y, lug, "e")
        self.y_link = nose_y + t + self.gap
        for pin, role, wide in (
            ("k", "backhoe_bucket_pin", self.y_link), ("g", "tipping_link_pin", self.y_link),
            ("e", "backhoe_bucket_cylinder_barrel_pin", self.lug_y),
        ):  # fmt: skip
            self.through(f"{pre}{role}", body, pin, wide + t)
        if self.extending:
            self.P["q"], self.P["w"] = b + 0.34 * s * along, k - 0.38 * s * along
            for pin, role, owner, wide in (("q", "extension_cylinder_barrel_pin", "dipper", half), ("w", "extension_piston_rod_pin", body, out_y)):
                for side in (1, -1):
                    boss = plate(f"boss_{pin}", around((0, 0, r)), t / 2, [(0, 0, self.bore_r)])
                    at = self.P[pin]
                    y = side * (self.eye_w / 2 + self.gap + t / 4)
                    m.add("boss", owner, owner, boss, place((at[0], y, at[1]), XZ, X))
                    inside = wide - 0.01 * s + self.e
                    spacer = tube(f"spacer_{pin}", 0.9 * r, self.bore_r, inside - abs(y) - t / 4 + self.e)
                    m.add("spacer", owner, owner, spacer, place((at[0], side * (abs(y) + t / 4 - self.e), at[1]), side * Y))
                self.through(role, owner, pin, wide - 0.012 * s)

    def on(self, b: Array, along: Array, far: float) -> Array:
        """A point of the dipper's line."""
        p = b + far * along
        return np.array([p[0], 0.0, p[1]])

    def hollow(self, name: str, long: float, half: float, high: float, wall: float) -> object:
        """A box section along its own z, from 0, its width along x; open at both ends."""
        parts = []
        for sign in (1, -1):
            parts.append((box(f"{name}_side", wall, 2 * high, long), place((sign * (half - wall / 2), 0, long / 2), Z, X)))
            parts.append((box(f"{name}_top", 2 * (half - wall), wall, long), place((0, sign * (high - wall / 2), long / 2), Z, X)))
        return merged(name, *parts)

    def linkage(self) -> None:
        s, t, m, r = self.s, self.t, self.m, 2.0 * self.pin_r
        g, h, j, k = (self.P[n] for n in "ghjk")
        self.plates("tipping link", "tipping_link", self.y_link, around((*g, r), (*h, r)), "gh")
        y = self.lug_y
        self.plates("bucket link", "bucket_link", y, around((*h, r), (*j, r)), "hj")
        half = y - t / 2 + self.e
        middle = 0.5 * (h + j)
        m.add("link web", "bucket_link", "bucket_link", box("link_web", 0.03 * s, 2 * half, 0.03 * s), place((middle[0], 0, middle[1]), Z, X))
        self.through("backhoe_bucket_piston_rod_pin", "backhoe_bucket_piston_rod", "h", self.y_link + t)
        turn = math.atan2(*(j - k)[::-1]) - 1.75
        c, n = math.cos(turn), math.sin(turn)
        local = np.array([[c, n], [-n, c]]) @ (j - k)
        at = np.eye(4)
        at[[0, 0, 2, 2], [0, 2, 0, 2]] = c, -n, n, c
        at[:3, 3] = (k[0], 0.0, k[1])
        m.pose = self.back @ at
        body, wide = "backhoe_bucket", 0.3 * s
        ear = around((0, 0, r), (0.13 * s + self.e, 0.05 * s, 0), (0.13 * s + self.e, 0.28 * s, 0), (*local, r))
        shape = plate("hoe_ear", ear, t, [(0, 0, self.bore_r), (*map(float, local), self.bore_r)])
        for side in (1, -1):
            m.add("ear", body, body, shape, place((0, side * self.y_link, 0), XZ, X))
        self.across("bucket_link_pin", body, local, 1, -self.y_link - t, self.y_link + t)
        back = box("hoe_back", t, 2 * wide, 0.36 * s)
        m.add("hoe back", body, body, back, place((0.13 * s + t / 2, 0, 0.18 * s), Z, X))
        low, deep = 0.13 * s + t, 0.5 * s
        m.add("hoe floor", body, body, box("hoe_floor", deep, 2 * wide, t), place((low + deep / 2, 0, 0.36 * s - t / 2), Z, X))
        cheek = around((low, 0.02 * s, 0), (low + 0.12 * s, 0.02 * s, 0), (low + deep, 0.36 * s - t, 0), (low, 0.36 * s - t, 0))
        for side in (1, -1):
            m.add("hoe cheek", body, body, plate("hoe_cheek", cheek, t), place((0, side * (wide - t / 2), 0), XZ, X))
        edge = box("hoe_edge", 0.12 * s, 2 * wide, 0.8 * t)
        m.add("hoe edge", "backhoe_cutting_edge", body, edge, place((low + deep + 0.06 * s, 0, 0.36 * s - 0.4 * t), Z, X))
        m.pose = self.back

    # ---- hydraulic cylinders ----
    def rams(self) -> None:
        s, f = self.s, self.P

        def high(p: Array, y: float) -> Array:
            return np.array([p[0], y, p[1]])

        def behind(p: Array) -> Array:
            return np.array([SWING * s - p[0], 0.0, p[1]])

        for side, letter in SIDES:
            ends = [high(f[k], side * self.y_lift) for k in "CD"]
            self.cylinder(f"lift {letter}", f"loader_lift_cylinder_barrel_{letter}", f"loader_lift_piston_rod_{letter}", *ends, Y, 0.036 * s)
            p, q = (np.array([at[0], side * at[1], self.swing_z]) for at in (self.SB, self.SR))
            self.cylinder(f"swing {letter}", f"swing_cylinder_barrel_{letter}", f"swing_piston_rod_{letter}", p, q, Z, 0.034 * s)
            x = -1.11 * s
            p, q = (np.array([x, side * at[0], at[1]]) for at in (self.leg_top, self.leg_rod))
            names = (f"stabilizer_cylinder_barrel_{letter}", f"stabilizer_piston_rod_{letter}")
            kept, self.eye_w = self.eye_w, 0.04 * s
            self.cylinder(f"stabilizer {letter}", *names, p, q, X, 0.03 * s)
            self.eye_w = kept
        tilts = (("_l", self.y_tilt), ("_r", -self.y_tilt)) if self.parallel else (("", 0.0),)
        for letter, y in tilts:
            names = (f"loader_bucket_cylinder_barrel{letter}", f"loader_bucket_piston_rod{letter}")
            self.cylinder(f"tilt{letter}", *names, high(f["E"], y), high(f["F"], y), Y, 0.034 * s)
        hoe = [("boom", "c", "d", 0.045), ("dipper", "m", "p", 0.04), ("backhoe_bucket", "e", "h", 0.036)]
        hoe += [("extension", "q", "w", 0.028)] if self.extending else []
        for name, p_, q_, bore in hoe:
            names = (f"{name}_cylinder_barrel", f"{name}_piston_rod")
            self.cylinder(name, *names, behind(f[p_]), behind(f[q_]), Y, bore * s)


def backhoe(seed: int, *, parallel: bool | None = None, extending: bool | None = None, embedded: bool = False) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's."""
    rng = np.random.default_rng([seed, 43])
    levers = bool(rng.random() < 0.5) if parallel is None else parallel
    longer = bool(rng.random() < 0.5) if extending is None else extending
    return Backhoe(seed, parallel=levers, extending=longer, embedded=embedded).draw()
