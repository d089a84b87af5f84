"""What the drawn backhoe loaders and telehandlers share: small things, steered axles, stabilizers."""

from __future__ import annotations

import numpy as np

from kit.machines.crawler import merged
from kit.machines.solids import Array, around, box, lathe, place, plate, tube
from kit.machines.synthetic import Drawer, X, Y, Z, polar

SIDES = ((1, "l"), (-1, "r"))
KING, ARM = 0.69, 0.187
"""Of a steered axle, in machine sizes: its knuckles' pins from the middle, and how far behind them their arms end."""


class SteeredChassis(Drawer):
    """One machine from one generator of random numbers."""

    axle_z: float
    carrier = "chassis"
    """The body that carries the axles."""
    arm_in = 0.03
    """How far the knuckles' arms reach in, in machine sizes."""
    leg: float
    leg_pin: Array
    leg_rod: Array
    leg_top: Array

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

    def steep(
        self, name: str, body: str, x: float, outline: Array, *holes: tuple[float, float], thick: float = 0.0
    ) -> None:
        """A plate across the machine; its outline and holes are (y, z)."""
        bores = [(float(y), float(z), self.bore_r) for y, z in holes]
        shape = plate(f"{name}_{x:.4f}_{outline[0, 0]:.4f}", outline, thick or self.t, bores)
        self.m.add(name, body, body, shape, place((x, 0, 0), X, Y))

    @property
    def lug_y(self) -> float:
        """Middle of the plates beside a cylinder's eye."""
        return self.eye_w / 2 + self.gap + self.t / 2

    def leg_plates(self, name: str, side: int, letter: str, ends: tuple[float, float], shoulder: float) -> None:
        """Two plates across the carrier at x `ends`, which hold a leg, and at `leg_top` its cylinder."""
        s, t, r, body = self.s, self.t, 2.2 * self.pin_r, self.carrier
        pin, high = self.leg_pin * [side, 1], self.leg_top * [side, 1]
        half = around((side * 0.2 * s, 0.56 * s, 0), (*pin, r), (*high, r), (side * 0.2 * s, shoulder * s, 0))
        for x in ends:
            self.steep(name, body, x, half, tuple(pin), tuple(high))
        for role, at in ((f"stabilizer_{letter}_pin", pin), (f"stabilizer_cylinder_barrel_{letter}_pin", high)):
            start = np.array([ends[0] - t, *at])
            self.pin(role, body, start, start + (ends[1] - ends[0] + 2 * t) * X)

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

    # ---- steered axles ----
    def steered_axle(
        self, end: str, x: float, radius: float, width: float, *, prefix: str = "", fast: bool = False
    ) -> None:
        """A beam on its pin, or `fast` on the chassis; on it cylinder, ties, knuckles with wheels. `prefix`: of the
        bodies' names, where a machine has two."""
        s, t, e, m, z = self.s, self.t, self.e, self.m, self.axle_z
        body = self.carrier if fast else f"{end}_axle"
        rod_body = f"{prefix}steering_piston_rod"
        r, king, a = 2.2 * self.pin_r, KING * s, x / s
        self.block("axle beam", body, (a - 0.06, -0.6, z / s - 0.05), (a + 0.06, 0.6, z / s + 0.05))
        if fast:
            for side, _ in SIDES:
                low, high = sorted((side * 0.1, side * (0.2 + e / s)))
                self.block("axle mount", body, (a - 0.05, low, (z + 0.05 * s - e) / s), (a + 0.05, high, 0.72))
        else:
            rail = 0.2 + e / s
            near, far = 0.16 * s, 0.06 * s + t / 2 - e
            self.block(
                "hanger beam",
                self.carrier,
                (a - (near - t / 2 + e) / s, -rail, 0.63),
                (a + (near - t / 2 + e) / s, rail, 0.74),
            )
            for d in (1, -1):
                hanger = around((0, z, r), (0.16 * s, 0.74 * s, 0), (-0.16 * s, 0.74 * s, 0))
                self.steep("hanger", self.carrier, x + d * near, hanger, (0.0, z))
                trunnion = around((0, z, r), (0.14 * s, z - 0.04 * s, 0), (0.14 * s, z + 0.04 * s, 0),
                                  (-0.14 * s, z + 0.04 * s, 0),
                                  (-0.14 * s, z - 0.04 * s, 0))  # fmt: skip
                self.steep("trunnion", body, x + d * far, trunnion, (0.0, z))
                middle = x + d * 0.5 * (near + far)
                span = 0.5 * (near - far) + t
                start = np.array([middle - span, 0.0, z])
                self.pin(f"{end}_axle_pin", self.carrier, start, start + 2 * span * X)
        arm_x, end_x = x - ARM * s, x - 0.212 * s
        ram_z = z - 0.1 * s
        low = ram_z - 0.045 * s
        bore, rod, half = 0.035 * s, 0.02 * s, 0.17 * s
        can = [(rod, -half), (0.05 * s, -half), (0.05 * s, half), (rod, half), (rod, half - 0.03 * s),
               (bore, half - 0.03 * s),
               (bore, 0.03 * s - half), (rod, 0.03 * s - half)]  # fmt: skip
        shapes = [(lathe("steer_can", can), place((end_x, 0, ram_z), Y))]
        long = x - 0.06 * s + e - end_x - 0.04 * s
        for y in (0.1, -0.1):
            at = (end_x + 0.04 * s + long / 2, y * s, ram_z + 0.04 * s)
            shapes.append((box("ram_foot", long, 0.04 * s, 0.1 * s), place(at, Z, X)))
        m.add(
            "steering barrel",
            f"{prefix}steering_cylinder_barrel",
            body,
            merged(f"{prefix}steer_barrel", *shapes),
            np.eye(4),
        )
        piston = tube("steer_piston", bore, rod, 0.04 * s)
        m.add("steering piston", rod_body, rod_body, piston, place((end_x, -0.02 * s, ram_z), Y))
        ends = [(tube("steer_rod", rod, 0.0, 0.62 * s), place((end_x, -0.31 * s, ram_z), Y))]
        for side, letter in SIDES:
            k, arm, tip = (
                np.array([x, side * king]),
                np.array([arm_x, side * (king - self.arm_in * s)]),
                np.array([end_x, side * 0.34 * s]),
            )
            wall = side * (0.6 * s - e)
            eye = around((*k, r), (x - 0.06 * s, wall, 0), (x + 0.06 * s, wall, 0))
            shape = plate(f"{prefix}king_eye{side}", eye, 0.09 * s, [(float(k[0]), float(k[1]), self.bore_r)])
            m.add("king eye", body, body, shape, place((0, 0, z), Z, X))
            self.upright(f"{prefix}knuckle_{letter}_pin", body, np.array([*k, z]), 0.09 * s)
            eye = plate(
                f"rod_end{side}",
                around((*tip, 1.5 * self.pin_r)),
                0.04 * s,
                [(float(tip[0]), float(tip[1]), self.pin_r)],
            )
            ends.append((eye, place((0, 0, ram_z), Z, X)))
            tie = around((*arm, 1.6 * self.pin_r), (*tip, 1.6 * self.pin_r))
            holes = [(float(q[0]), float(q[1]), self.bore_r) for q in (arm, tip)]
            name = f"{prefix}tie_rod_{letter}"
            shape = plate(f"{prefix}tie{side}", tie, 0.035 * s, holes)
            m.add("tie rod", name, name, shape, place((0, 0, low), Z, X))
            for role, at, owner, top in (
                (f"{prefix}tie_rod_{letter}_pin", arm, f"{prefix}knuckle_{letter}", z - 0.044 * s),
                (f"{rod_body}_{letter}_pin", tip, rod_body, ram_z + 0.022 * s),
            ):
                foot = np.array([*at, low - 0.02 * s])
                self.pin(role, owner, foot, foot + (top - foot[2]) * Z)
            self.knuckle(side, k, arm, (f"{prefix}knuckle_{letter}", f"{end}_wheel_{letter}"), radius, width)
        shape = merged(f"{prefix}steer_rod_with_ends", *ends)
        m.add("steering rod", rod_body, rod_body, shape, np.eye(4))

    def knuckle(self, side: int, king: Array, arm: Array, bodies: tuple[str, str], radius: float, width: float) -> None:
        """Two plates about the king eye, a web with the spindle, the arm: one casting; `bodies`: its own and
        the wheel's."""
        s, t, (body, wheel), x, z = self.s, self.t, bodies, float(king[0]), self.axle_z
        web, r = side * 0.77 * s, 2.2 * self.pin_r
        fork = around((*king, r), (x - 0.07 * s, web, 0), (x + 0.07 * s, web, 0))
        hole = (float(king[0]), float(king[1]), self.bore_r)
        off = 0.045 * s + t / 2 + max(self.gap, 0.002 * s)
        reach, start = self.tread / 2 - 0.1 * s, 0.79 * s
        low = plate(
            f"arm{side}",
            around((*king, r), (*arm, 1.6 * self.pin_r)),
            t,
            [hole, (float(arm[0]), float(arm[1]), self.pin_r)],
        )
        shapes = [
            (plate(f"top{side}", fork, t, [hole]), place((0, 0, z + off), Z, X)),
            (plate(f"low{side}", fork, t, [hole]), place((0, 0, z - off), Z, X)),
            (low, place((0, 0, z - off), Z, X)),
            (box("web", 0.14 * s, 0.03 * s, 2 * off + t), place((x, web, z), Z, X)),
            (tube("spindle", 0.05 * s, 0.0, reach - start), place((x, side * start, radius), side * Y)),
        ]
        self.m.add("knuckle", body, body, merged(f"{body}_casting", *shapes), np.eye(4))
        kept = self.tyre_r, self.tyre_w
        self.tyre_r, self.tyre_w = radius, width
        self.wheel(wheel, body, side, np.array([x, side * self.tread / 2, radius]), reach)
        self.tyre_r, self.tyre_w = kept
