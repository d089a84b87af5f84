"""Parametric telehandlers straight as `Assembly` objects, with the truth: a boom of two to four sections, one lift
cylinder or two, with stabilizers or without, the front axle fast or levelled by a cylinder.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are.
"""

from __future__ import annotations

import math

import numpy as np

from kit.machines.solids import Array, around, box, place, plate
from kit.machines.steered_chassis import SIDES, SteeredChassis
from kit.machines.synthetic import XZ, Machine, X, Y, Z, polar
from kit.machines.telescope import rectangular_tube

HALF, HIGH, WALL, LOOSE = 0.14, 0.19, 0.012, 0.005
"""Of the outermost section: half width and height; of every one its wall and the room about it."""
SECTIONS = {2: "inner_boom", 3: "middle_boom", 4: "middle_boom"}


class Telehandler(SteeredChassis):
    """One machine from one generator of random numbers."""

    def __init__(self, seed: int, *, sections: int, twin: bool, legs: bool, levelled: bool, embedded: bool) -> None:
        self.sections, self.legs, self.levelled, self.twin = sections, legs, levelled, twin
        super().__init__(seed, twin=True, steered=False, embedded=embedded, stop=False, hoses=0)
        u, s = self.rng.uniform, self.s
        self.m.title, self.t, self.e = "TELEHANDLER", 0.026 * s, 0.003 * s if embedded else 0.0
        self.pin_r, self.eye_w = 0.03 * s * u(0.9, 1.12), 0.062 * s
        self.clearance = float(self.rng.choice([0.0, 0.0001, 0.0003])) * s
        self.gap = float(self.rng.choice([0.0, 0.001, 0.002])) * s
        self.tyre_r, self.tyre_w, self.tread = 0.6 * s * u(0.95, 1.05), 0.4 * s * u(0.92, 1.05), 1.9 * s * u(0.98, 1.03)
        self.front_x, self.axle_z = 2.55 * s * u(0.96, 1.06), 0.54 * s
        self.y_tail = HALF * s + self.t / 2 - self.e
        self.y_tower = self.y_tail + self.t + self.gap + self.e

    def link_pins(self) -> None:
        u, s = self.rng.uniform, self.s
        self.boom, self.out = float(u(-0.12, 0.6)), float(u(0.1, 0.9))
        self.tilted = float(u(-0.25, 0.3))
        self.axis = -0.12 * u(0.9, 1.1)
        self.end = 3.3 * u(0.96, 1.04)
        self.long = self.end + 0.9 + 0.09 * (self.sections - 2) + (self.sections - 1) * self.out
        self.drop = 0.8 * u(0.95, 1.03)
        self.pivot = np.array([-0.09, 1.96]) * u(0.98, 1.02, 2)
        self.low = self.axis - HIGH
        self.P = {}
        d, f = (1.75 * u(0.95, 1.05), self.low - 0.085), (0.3 * u(0.97, 1.1), self.low - 0.07)
        n, b = (self.long, -self.drop), (self.long - 0.72 * u(0.95, 1.05), -self.drop + 0.45 * u(0.97, 1.03))
        for name, at in {"P": (0.0, 0.0), "D": d, "F": f, "N": n, "B": b}.items():
            self.P[name] = self.on(*at)
        self.P["C"] = s * np.array([0.07, 0.775]) * u(0.98, 1.02, 2)
        self.P["E"] = self.P["P"] + s * np.array([-0.385, -0.35]) * u(0.98, 1.02, 2)
        self.P["T"] = self.P["N"] + s * polar(0.22 * u(0.95, 1.05), math.pi / 2 + 0.11 + self.tilted)
        if self.sections == 2:
            self.P["V"], self.P["W"] = self.on(0.17, self.axis), self.on(self.long - 0.2, self.axis)
        else:
            top = self.axis + HIGH + 0.1
            first = self.end + 0.05 + self.out
            self.P["V"], self.P["W"] = self.on(0.7, top), self.on(first, top)
        self.leg = float(u(-0.3, 0.8))

    def on(self, x: float, z: float) -> Array:
        """A point of the boom's frame, in machine sizes."""
        c, n = math.cos(self.boom), math.sin(self.boom)
        return self.s * (self.pivot + np.array([c * x - n * z, n * x + c * z]))

    @property
    def lift_y(self) -> tuple[tuple[float, str], ...]:
        """Where the lift cylinders are, and the ends of their names."""
        half = 0.078 * self.s
        return ((half, "_l"), (-half, "_r")) if self.twin else ((0.0, ""),)

    def draw(self) -> Machine:
        for group in (self.chassis, self.axles, self.outer, self.inner, self.carriage, self.rams):
            group()
        return self.m

    def lugs(self, name: str, body: str, y: float, pin: str, *feet: Array) -> None:
        """Two plates beside a cylinder's eye, and its pin."""
        outline = around((*self.P[pin], 1.6 * self.pin_r), *((*foot, 0.0) for foot in feet))
        for d in (1, -1):
            self.side_plate(name, body, y + d * self.lug_y, outline, pin)

    def pin_across(self, role: str, body: str, pin: str, y: float = 0.0, half: float = 0.0) -> None:
        half = half or self.lug_y + 0.6 * self.t
        self.across(role, body, self.P[pin], 1, y - half, y + half)

    # ---- chassis ----
    def chassis(self) -> None:
        s, t, e, body, wide = self.s, self.t, self.e, "chassis", 2.3 * self.pin_r
        p, c, back = self.P["P"], self.P["C"], self.P["E"]
        long = self.front_x / s + (0.75 if self.legs else 0.5)
        foot, inner = (self.y_tower + t / 2 - e) / s, 0.2 + e / s
        for side, _ in SIDES:
            low, high = sorted((side * 0.2, side * 0.29))
            self.block("rail", body, (-0.6, low, 0.58), (long, high, 0.76))
            low, high = sorted((side * foot, side * inner))
            self.block("tower foot", body, (-0.5, low, 0.6), (0.4, high, 0.74))
        tower = around((-0.52 * s, 0.6 * s, 0), (0.42 * s, 0.6 * s, 0), (*p, wide), (*back, wide))
        self.plates("tower", body, self.y_tower, tower, "PE")
        self.pin_across("boom_pin", body, "P", half=self.y_tower + t)
        self.pin_across("compensation_cylinder_barrel_pin", body, "E", half=self.y_tower + t)
        a = c[0] / s
        self.block("lift beam", body, (a - 0.06, -inner, 0.6), (a + 0.06, inner, 0.7))
        for y, letter in self.lift_y:
            top = 0.7 * s - e
            self.lugs("lift lug", body, y, "C", np.array([c[0] - 0.05 * s, top]), np.array([c[0] + 0.05 * s, top]))
            self.pin_across(f"lift_cylinder_barrel{letter}_pin", body, "C", y)
        for x in (-0.56, 1.2):
            self.block("cross member", body, (x, -inner, 0.6), (x + 0.05, inner, 0.74))
        self.block("counterweight", body, (-0.75, -0.6, 0.5), (-0.6, 0.6, 1.0))
        roof = float(self.rng.uniform(2.2, 2.5))
        self.block("cab", body, (0.65, 0.29, 0.7), (1.8, 0.95, roof))
        self.block("engine", body, (0.65, -0.95, 0.62), (1.85, -0.29, 1.35))
        if self.legs:
            self.front_frame(long)

    def front_frame(self, long: float) -> None:
        """Two plates across the rails' ends, between which the stabilizers swing."""
        s, t, e, body = self.s, self.t, self.e, "chassis"
        x1, x2 = (long + 0.0) * s + t / 2 - e, (long + 0.14) * s
        self.leg_pin, self.leg_top = np.array([0.72, 0.5]) * s, np.array([0.58, 1.1]) * s
        for side, letter in SIDES:
            self.leg_plates("front plate", side, letter, (x1, x2), 0.78)
            self.stabilizer(side, letter, 0.5 * (x1 + x2))
        half_y = 0.22
        self.block("front beam", body, ((x1 + t / 2 - e) / s, -half_y, 0.6), ((x2 - t / 2 + e) / s, half_y, 0.74))
        self.leg_x = 0.5 * (x1 + x2)

    def axles(self) -> None:
        s, t, e = self.s, self.t, self.e
        self.steered_axle("rear", 0.0, self.tyre_r, self.tyre_w, prefix="rear_")
        self.steered_axle("front", self.front_x, self.tyre_r, self.tyre_w, prefix="front_", fast=not self.levelled)
        if not self.levelled:
            return
        self.level = (np.array([0.4, 1.1]) * s, np.array([0.46, 0.68]) * s)
        r, (high, low) = 1.7 * self.pin_r, self.level
        for d in (1, -1):
            x = self.front_x + d * self.lug_y
            lug = around((*high, r), (0.29 * s - e, 0.75 * s, 0), (0.29 * s - e, 0.62 * s, 0))
            self.steep("levelling lug", "chassis", x, lug, tuple(high))
            lug = around((*low, r), (low[0] - 0.07 * s, 0.59 * s - e, 0), (low[0] + 0.07 * s, 0.59 * s - e, 0))
            self.steep("axle lug", "front_axle", x, lug, tuple(low))
        reach = self.lug_y + 0.6 * t
        for role, body, at in (
            ("levelling_cylinder_barrel_pin", "chassis", high), ("levelling_piston_rod_pin", "front_axle", low),
        ):  # fmt: skip
            start = np.array([self.front_x - reach, *at])
            self.pin(role, body, start, start + 2 * reach * X)

    # ---- boom ----
    def tube(self, body: str, number: int, start: float, end: float) -> tuple[float, float]:
        """A section; its half width and half height, in machine sizes."""
        s, less = self.s, number * (WALL + LOOSE)
        half, high = HALF - less, HIGH - less
        shape = rectangular_tube(f"tube_{body}", (end - start) * s, 2 * high * s, 2 * half * s, WALL * s)
        along, up = polar(1.0, self.boom), polar(1.0, self.boom + math.pi / 2)
        at = self.on(start, self.axis)
        matrix = place((at[0], 0, at[1]), (up[0], 0, up[1]), (along[0], 0, along[1]))
        self.m.add("section", body, body, shape, matrix)
        return half, high

    def outer(self) -> None:
        s, t, e, body, wide = self.s, self.t, self.e, "boom", 2.2 * self.pin_r
        self.tube(body, 0, 0.26 if self.sections == 2 else 0.15, self.end)
        tail = around((*self.P["P"], wide), *((*self.on(x, z), 0.0) for x, z in (
            (0.75, self.low + 0.02), (0.75, self.axis + HIGH - 0.02), (0.12, self.low + 0.05),
        )))  # fmt: skip
        self.plates("tail", body, self.y_tail, tail, "PV" if self.sections == 2 else "P")
        for y, letter in self.lift_y:
            x = self._along("D")
            self.lugs("lift rod lug", body, y, "D", *(self.on(x + d, self.low + e / s) for d in (-0.08, 0.08)))
            self.pin_across(f"lift_piston_rod{letter}_pin", body, "D", y)
        x = self._along("F")
        self.lugs("compensation lug", body, 0.0, "F", self.on(x - 0.02, self.low + e / s),
                  self.on(x + 0.14, self.low + e / s))  # fmt: skip
        self.pin_across("compensation_piston_rod_pin", body, "F")
        if self.sections == 2:
            self.pin_across("telescope_cylinder_barrel_pin", body, "V", half=self.y_tail + t / 2)
        else:
            top = self.axis + HIGH - e / s
            self.lugs("telescope lug", body, 0.0, "V", self.on(0.62, top), self.on(0.78, top))
            self.pin_across("telescope_cylinder_barrel_pin", body, "V")

    def _along(self, pin: str) -> float:
        """How far out along the boom a pin is, in machine sizes."""
        return float((self.P[pin] / self.s - self.pivot) @ polar(1.0, self.boom))

    def inner(self) -> None:
        s, t, e, k, out = self.s, self.t, self.e, self.sections, self.out
        names = {2: ["inner_boom"], 3: ["middle_boom", "inner_boom"],
                 4: ["middle_boom", "second_middle_boom", "inner_boom"]}[k]  # fmt: skip
        half = HALF
        for number, body in enumerate(names, start=1):
            last = body == "inner_boom"
            end = self.long - (0.28 if k == 2 else 0.18) if last else self.end + 0.09 * number + number * out
            half, _ = self.tube(body, number, 0.4 + number * out, end)
        if k > 2:
            top = self.axis + HIGH - WALL - LOOSE - e / s
            x = self.end + out
            self.lugs("telescope rod lug", "middle_boom", 0.0, "W", self.on(x + 0.01, top), self.on(x + 0.09, top))
            self.pin_across("middle_telescope_piston_rod_pin", "middle_boom", "W")
        body, n, b = "inner_boom", self.P["N"], self.P["B"]
        wide, y = 2.3 * self.pin_r, half * s + t / 2 - e
        corners = [(*self.on(self.long - d, self.axis + z), 0.0) for d, z in ((0.16, 0.1), (0.7, 0.1))]
        neck = around((*n, wide), (*b, wide), *corners)
        self.plates("neck", body, y, neck, "NBW" if k == 2 else "NB")
        for role, pin in (("carriage_pin", "N"), ("tilt_cylinder_barrel_pin", "B")):
            self.pin_across(role, body, pin, half=y + t)
        if k == 2:
            self.pin_across("telescope_piston_rod_pin", body, "W", half=y + t / 2)

    # ---- carriage ----
    def carriage(self) -> None:
        s, t, e, m, body, wide = self.s, self.t, self.e, self.m, "carriage", 2.2 * self.pin_r
        c, n = math.cos(self.tilted), math.sin(self.tilted)
        pose = np.eye(4)
        pose[[0, 0, 2, 2], [0, 2, 0, 2]] = c, -n, n, c
        pose[:3, 3] = (self.P["N"][0], 0.0, self.P["N"][1])
        m.pose = pose
        tx, tz = np.array([[c, n], [-n, c]]) @ (self.P["T"] - self.P["N"])
        back = 0.1 * s
        holes = [(0.0, 0.0, self.bore_r), (float(tx), float(tz), self.bore_r)]
        outline = around((0, 0, wide), (tx, tz, 1.7 * self.pin_r), (back + e, 0.26 * s, 0), (back + e, -0.15 * s, 0))
        for side, _ in SIDES:
            m.add("carriage lug", body, body, plate("carriage_lug", outline, t, holes),
                  place((0, side * self.lug_y, 0), XZ, X))  # fmt: skip
        frame = box("carriage_frame", 0.05 * s, 1.1 * s, 0.62 * s)
        m.add("carriage frame", body, body, frame, place((back + 0.025 * s, 0, -0.06 * s), Z, X))
        face, low = back + 0.05 * s, -0.37 * s
        long = float(self.rng.uniform(1.0, 1.25)) * s
        for side, _ in SIDES:
            y = side * 0.3 * s
            shank = box("shank", 0.05 * s, 0.12 * s, 0.5 * s)
            m.add("fork shank", "forks", body, shank, place((face + 0.025 * s, y, low + 0.25 * s), Z, X))
            blade = box("blade", long, 0.12 * s, 0.045 * s)
            at = (face + 0.05 * s - e + long / 2, y, low + 0.0225 * s)
            m.add("fork blade", "forks", body, blade, place(at, Z, X))
        m.pose = np.eye(4)
        self.pin_across("tilt_piston_rod_pin", body, "T")

    def rams(self) -> None:
        s = self.s

        def flat(pin: str, y: float = 0.0) -> Array:
            return np.array([self.P[pin][0], y, self.P[pin][1]])

        def ram(name: str, start: Array, end: Array, axis: Array, bore: float, side: str = "") -> None:
            halves = (f"{name}_cylinder_barrel{side}", f"{name}_piston_rod{side}")
            self.cylinder(f"{name}{side}", *halves, start, end, axis, bore * s)

        bore = 0.032 if self.twin else 0.05
        for y, letter in self.lift_y:
            ram("lift", flat("C", y), flat("D", y), Y, bore, letter)
        ram("compensation", flat("E"), flat("F"), Y, 0.033)
        ram("telescope", flat("V"), flat("W"), Y, 0.034)
        ram("tilt", flat("B"), flat("T"), Y, 0.042)
        if self.levelled:
            high, low = (np.array([self.front_x, *at]) for at in self.level)
            ram("levelling", high, low, X, 0.032)
        for side, letter in SIDES if self.legs else ():
            start, end = (np.array([self.leg_x, side * at[0], at[1]]) for at in (self.leg_top, self.leg_rod))
            ram("stabilizer", start, end, X, 0.034, f"_{letter}")


def telehandler(
    seed: int, *, sections: int | None = None, twin: bool | None = None, legs: bool | None = None,
    levelled: bool | None = None, embedded: bool = False,
) -> Machine:  # fmt: skip
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's."""
    drawn = np.random.default_rng([seed, 53]).random(4)
    sections = int(2 + drawn[0] * 3) if sections is None else sections
    legs = bool(drawn[2] < 0.6) if legs is None else legs
    return Telehandler(
        seed, sections=sections, twin=bool(drawn[1] < 0.4) if twin is None else twin, legs=legs and sections > 2,
        levelled=bool(drawn[3] < 0.5) if levelled is None else levelled, embedded=embedded,
    ).draw()  # fmt: skip
