"""Parametric rigid dump trucks straight as `Assembly` objects, with the truth: steered front wheels on knuckles with a
tie rod, twin rear tyres, and the tipping body of the articulated ones.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are.
"""

from __future__ import annotations

import numpy as np

from kit.machines.articulated_trucks import SIDES, ArticulatedTruck
from kit.machines.crawler import merged
from kit.machines.solids import around, box, lathe, place, plate, tube
from kit.machines.synthetic import Machine, X, Y, Z


class RigidTruck(ArticulatedTruck):
    """One machine from one generator of random numbers."""

    def __init__(self, seed: int, *, embedded: bool) -> None:
        super().__init__(seed, beams=False, race=False, embedded=embedded)
        u, s = self.rng.uniform, self.s
        self.m.title, self.steer = "RIGID TRUCK", 0.0
        self.tyre_w, self.tread = 0.5 * s * u(0.95, 1.04), 2.62 * s * u(0.99, 1.03)
        self.apart = self.tyre_w * u(1.12, 1.22)
        self.rear_x, self.front_x = -3.7 * s * u(0.98, 1.02), 0.7 * s * u(0.95, 1.1)
        self.king = np.array([self.front_x, 0.96 * s * u(0.98, 1.02)])
        self.tie = self.king - s * np.array([0.42 * u(0.95, 1.08), 0.11 * u(0.9, 1.2)])
        self.z_arm = self.tyre_r - 0.13 * s
        self.SP = [self.king - s * np.array([0.36, 0.74]), self.king + 0.55 * (self.tie - self.king)]  # type: ignore[assignment]

    def draw(self) -> Machine:
        self.rear, hinge = np.eye(4), np.array([self.P["H"][0], 0.0, self.P["H"][1]])
        self.body = self.raising(hinge)
        z = self.z_arm + self.t / 2 + self.gap + self.eye_w / 2
        self.SP = [np.array([*p, z]) for p in self.SP]  # type: ignore[assignment]
        self.chassis()
        for side, letter in SIDES:
            self.knuckle(side, letter)
        self.tie_rod()
        self.m.pose = self.body
        self.dump_body()
        self.m.pose = np.eye(4)
        self.cylinders()
        return self.m

    def chassis(self) -> None:
        s, t, e, y, body = self.s, self.t, self.e, self.y_rail, "chassis"
        low, high, (hx, hz), wide = self.low, self.high, self.P["H"], 2.2 * self.pin_r
        half, inner, front = (y + t / 2) / s, (y - t / 2 + e) / s, 2.4
        rail = around((front * s, low, 0), (front * s, high, 0), (hx, hz, wide), (hx, low, 0))
        for side, _ in SIDES:
            self.side_plate("rail", body, side * y, rail, "H")
            self.across("dump_body_pin", body, self.P["H"], side, y - 2.6 * t - self.gap, y + 2.6 * t + self.gap)
        self.hoist_brackets(body)
        for x in (-3.0, -1.2, 1.6, 2.3):
            self.block("cross member", body, (x, -inner, 1.15), (x + 0.05, inner, 1.38))
        self.block("bumper", body, (front, -1.3, 0.9), (front + 0.12, 1.3, 1.45))
        self.block("engine", body, (0.9, -inner, 1.16), (1.55, inner, 1.7))
        for x in (0.1, 2.0):
            self.block("deck post", body, (x, -half, 1.42), (x + 0.08, half, 1.95))
        self.block("deck", body, (-0.2, -1.4, 1.95), (front, 1.4, 1.99))
        self.block("cab", body, (0.2, 0.1, 1.99), (1.3, 1.2, float(self.rng.uniform(2.9, 3.2))))
        self.block("air cleaner", body, (0.4, -1.0, 1.99), (1.0, -0.4, 2.6))
        a, b = self.front_x / s, self.rear_x / s
        self.block("front beam", body, (a - 0.16, -0.76, self.tyre_r / s - 0.07), (a + 0.16, 0.76, low / s))
        self.rear_axle_case(b * s, low)
        for side, letter in SIDES:
            kx, ky = self.king * np.array([1, side])
            foot = side * (0.76 * s - e)
            eye = around((kx, ky, 0.11 * s), (kx - 0.12 * s, foot, 0), (kx + 0.12 * s, foot, 0))
            shape = plate(f"eye{side}", eye, 0.14 * s, [(float(kx), float(ky), self.bore_r)])
            self.m.add("axle eye", body, body, shape, place((0, 0, self.tyre_r), Z, X))
            self.upright(f"knuckle_{letter}_pin", body, np.array([kx, ky, self.tyre_r]), 0.18 * s)
            p = self.SP[0] * np.array([1, side, 1])
            x = p[0] - 0.12 * s - e
            lug = around((p[0], p[1], 1.7 * self.pin_r), (x, p[1] + 0.08 * s, 0), (x, p[1] - 0.08 * s, 0))
            self.upright_lugs("steering lug", body, p, lug)
            self.upright(f"steering_cylinder_barrel_{letter}_pin", body, p, self.eye_w / 2 + self.gap + 0.6 * t)
            self.rear_wheel(f"rear_wheel_{letter}", side)
        x, z = self.SP[0][0] / s - 0.12, self.SP[0][2] / s
        self.block("steering beam", body, (x - 0.06, -half, z - 0.14), (x, half, low / s))

    @property
    def reach(self) -> float:
        """From the middle to the ends of the rear axle."""
        return self.tread / 2 - self.apart / 2 - self.tyre_w / 2 - 0.02 * self.s

    def rear_axle_case(self, x: float, top: float) -> None:
        """A block under the rails with a tube on either side: one casting."""
        s, low = self.s, self.tyre_r - 0.15 * self.s
        shapes = [(box("case", 0.44 * s, 1.24 * s, top - low), place((x, 0, 0.5 * (low + top)), Z, X))]
        bar = tube("case_tube", 0.1 * s, 0.03 * s, self.reach - 0.62 * s)
        shapes += [(bar, place((x, side * 0.62 * s, self.tyre_r), side * Y)) for side in (1, -1)]
        self.m.add("rear axle case", "chassis", "chassis", merged("rear_case", *shapes), np.eye(4))

    def rear_wheel(self, wheel: str, side: int) -> None:
        """A wheel, and a second tyre on a drum inside of it."""
        m, out, r, w = self.m, side * Y, self.tyre_r, self.tyre_w
        inside, reach = self.tread / 2 - self.apart / 2, self.reach
        centre = np.array([self.rear_x, 0.0, r])
        kept, self.tread = self.tread, self.tread + self.apart
        self.wheel(wheel, "chassis", side, centre + self.tread / 2 * out, reach)
        self.tread = kept
        tyre = lathe("inner_tyre", [(0.5 * r, -w / 2), (r, -w / 2), (r, w / 2), (0.5 * r, w / 2)])
        m.add("tyre", wheel.replace("wheel", "tyre"), wheel, tyre, place(centre + inside * out, out))
        drum = tube("drum", 0.5 * r, 0.42 * r, self.apart)
        m.add("drum", wheel, wheel, drum, place(centre + (inside - w / 2) * out, out))

    def knuckle(self, side: int, letter: str) -> None:
        """Two plates about the axle's eye, a web with the spindle, the arm: one casting."""
        s, t, body, mirror = self.s, self.t, f"knuckle_{letter}", np.array([1, side])
        (kx, ky), (tx, ty), (qx, qy) = self.king * mirror, self.tie * mirror, self.SP[1][:2] * mirror
        web = abs(ky) + 0.13 * s
        fork = around((kx, ky, 0.11 * s), (kx - 0.1 * s, side * web, 0), (kx + 0.1 * s, side * web, 0))
        hole = (float(kx), float(ky), self.bore_r)
        pins = [hole, (float(tx), float(ty), self.pin_r), (float(qx), float(qy), self.pin_r)]
        arm = around((kx, ky, 0.1 * s), (tx, ty, 1.7 * self.pin_r))
        reach, centre = self.tread / 2 - 0.1 * s, np.array([self.front_x, side * self.tread / 2, self.tyre_r])
        end = web + 0.04 * s
        shapes = [
            (plate(f"arm{side}", arm, t, pins), place((0, 0, self.z_arm), Z, X)),
            (plate(f"low{side}", fork, t, [hole]), place((0, 0, self.z_arm), Z, X)),
            (plate(f"top{side}", fork, t, [hole]), place((0, 0, 2 * self.tyre_r - self.z_arm), Z, X)),
            (box("web", 0.2 * s, 0.04 * s, 0.36 * s), place((kx, side * (web + 0.02 * s), self.tyre_r), Z, X)),
            (tube("spindle", 0.08 * s, 0.0, reach - end), place((kx, side * end, self.tyre_r), side * Y)),
        ]
        self.m.add("knuckle", body, body, merged(body, *shapes), np.eye(4))
        self.wheel(f"front_wheel_{letter}", body, side, centre, reach)
        low = self.z_arm - t / 2 - self.gap - 0.07 * s
        self.pin(f"tie_rod_{letter}_pin", body, np.array([tx, ty, low]), np.array([tx, ty, self.z_arm + 0.6 * t]))
        start = np.array([qx, qy, self.z_arm - 0.6 * t])
        self.pin(f"steering_piston_rod_{letter}_pin", body, start, np.array([qx, qy, self.SP[1][2] + self.eye_w / 2]))

    def tie_rod(self) -> None:
        s, (tx, ty) = self.s, self.tie
        z = self.z_arm - self.t / 2 - self.gap - 0.035 * s
        r = 1.7 * self.pin_r
        shapes = [(tube("tie_bar", 0.03 * s, 0.0, 2 * (ty - 0.9 * r)), place((tx, -ty + 0.9 * r, z), Y))]
        for side in (1, -1):
            eye = plate(f"tie_eye{side}", around((0, 0, r)), 0.07 * s, [(0, 0, self.bore_r)])
            shapes.append((eye, place((tx, side * ty, z), Z, X)))
        self.m.add("tie rod", "tie_rod", "tie_rod", merged("tie_rod", *shapes), np.eye(4))


def rigid_truck(seed: int, *, embedded: bool = False) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names."""
    return RigidTruck(seed, embedded=embedded).draw()
