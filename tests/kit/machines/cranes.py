"""Parametric mobile cranes straight as `Assembly` objects, with the truth: a boom of two to four sections (to six,
where they are pinned) that slews, one luffing cylinder or two, a hook on two to eight falls or none, four outriggers
drawn out by any share.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are.
"""

from __future__ import annotations

import math

import numpy as np

from kit.machines.crawler import merged
from kit.machines.solids import Array, around, box, lathe, place, plate, tube
from kit.machines.steered_chassis import SIDES, SteeredChassis
from kit.machines.synthetic import Machine, X, Y, Z, polar
from kit.machines.telescope import rectangular_tube

HALF, HIGH, WALL, LOOSE = 0.14, 0.19, 0.012, 0.005
"""Of the outermost section: half width and height; of every one its wall and the room about it."""
BODIES = {
    2: ["boom", "inner_boom"], 3: ["boom", "middle_boom", "inner_boom"],
    4: ["boom", "middle_boom", "second_middle_boom", "inner_boom"],
    5: ["boom", "middle_boom", "second_middle_boom", "third_middle_boom", "inner_boom"],
    6: ["boom", "middle_boom", "second_middle_boom", "third_middle_boom", "fourth_middle_boom", "inner_boom"],
}  # fmt: skip
JIB = 1.6
"""How far a jib reaches beyond the pin of the head's sheaves."""
BEAM, BOX_WALL = (0.075, 0.09, 0.01), 0.012
"""Half width, half height and wall of an outrigger's beam; the wall of its box."""


class Crane(SteeredChassis):
    """One machine from one generator of random numbers."""

    carrier = "carrier"

    def __init__(
        self, seed: int, *, sections: int, twin: bool, hook: bool, pinned: bool, jib: str, embedded: bool
    ) -> None:
        self.sections, self.twin, self.hook, self.pinned, self.jib = sections, twin, hook, pinned, jib
        super().__init__(seed, twin=True, steered=False, embedded=embedded, stop=False, hoses=0)
        u, s = self.rng.uniform, self.s
        self.m.title, self.t, self.e = "CRANE", 0.026 * s, 0.003 * s if embedded else 0.0
        self.pin_r, self.eye_w = 0.03 * s * u(0.9, 1.12), 0.062 * s
        self.clearance = float(self.rng.choice([0.0, 0.0001, 0.0003])) * s
        self.gap = float(self.rng.choice([0.0, 0.001, 0.002])) * s
        self.tyre_r, self.tyre_w, self.tread = 0.6 * s * u(0.95, 1.05), 0.4 * s * u(0.92, 1.05), 1.9 * s * u(0.98, 1.03)
        self.axle_x, self.axle_z = 1.6 * s * u(0.95, 1.1), 0.54 * s
        self.y_tail = HALF * s + self.t / 2 - self.e
        self.y_cheek = self.y_tail + self.t + self.gap + self.e

    def link_pins(self) -> None:
        u, s = self.rng.uniform, self.s
        self.boom, self.out = float(u(0.05, 1.15)), float(u(0.1, 0.9))
        if self.pinned:
            self.out = 0.0
        self.pivot, self.axis = np.array([-1.5, 1.75]) * u(0.97, 1.03, 2), 0.36
        self.end = 4.4 * u(0.96, 1.04)
        self.long = self.end + 0.75 + (self.sections - 1) * (self.out + 0.12)
        self.falls = int(self.rng.integers(1, 5))
        self.rope = float(u(0.6, 1.4))
        self.beam_out, self.jack_out = u(0.0, 0.62, 4), u(0.02, 0.24, 4)
        top = self.axis + HIGH + 0.1
        self.P = {"P": self.on(0.0, 0.0), "N": self.on(self.long, 0.0)}
        self.P["D"] = self.on(1.7 * u(0.95, 1.05), self.axis - HIGH - 0.1)
        self.P["C"] = s * np.array([-0.75, 1.25]) * u(0.98, 1.02, 2)
        self.P["V"], self.P["W"] = self.on(0.5, top), self.on(self.end + 0.05 + self.out, top)

    def on(self, x: float, z: float) -> Array:
        """A point of the boom's frame, in machine sizes."""
        c, n = math.cos(self.boom), math.sin(self.boom)
        return self.s * (self.pivot + np.array([c * x - n * z, n * x + c * z]))

    @property
    def luffing_y(self) -> tuple[tuple[float, str], ...]:
        """Where the luffing cylinders are, and the ends of their names."""
        half = 0.078 * self.s
        return ((half, "_l"), (-half, "_r")) if self.twin else ((0.0, ""),)

    def draw(self) -> Machine:
        for group in (self.frame, self.axles, self.outriggers, self.upper, self.sections_out, self.rams):
            group()
        if self.hook:
            self.hoist("N", "hoist_rope", "hook_block", falls=self.falls, drop=self.rope)
        if self.jib:
            self.draw_jib()
        if self.jib == "hook":
            self.hoist("E", "jib_hoist_rope", "jib_hook_block", falls=1, drop=0.6 * self.rope)
        return self.m

    def lugs(self, name: str, body: str, y: float, pin: str, *feet: Array) -> None:
        """Two plates beside a cylinder's eye."""
        outline = around((*self.P[pin], 1.6 * self.pin_r), *((*foot, 0.0) for foot in feet))
        for d in (1, -1):
            self.side_plate(name, body, y + d * self.lug_y, outline, pin)

    def pin_across(self, role: str, body: str, pin: str, y: float = 0.0, half: float = 0.0) -> None:
        half = half or self.lug_y + 0.6 * self.t
        self.across(role, body, self.P[pin], 1, y - half, y + half)

    # ---- carrier ----
    def frame(self) -> None:
        s, e, body = self.s, self.e, "carrier"
        far = self.axle_x / s + 1.0
        for side, _ in SIDES:
            low, high = sorted((side * 0.2, side * 0.37))
            self.block("rail", body, (-far, low, 0.58), (far, high, 0.76))
            low, high = sorted((side * (0.37 - e / s), side * 0.85))
            self.block("tank", body, (-0.55, low, 0.45), (0.55, high, 0.7))
        for x in (-0.9, 0.8):
            self.block("cross member", body, (x, -0.2 - e / s, 0.6), (x + 0.06, 0.2 + e / s, 0.74))
        self.block("pedestal", body, (-0.45, -0.37, 0.76 - e / s), (0.45, 0.37, 0.9))
        self.block("engine", body, (-far + 0.35, -0.2 - e / s, 0.6), (-far + 0.85, 0.2 + e / s, 0.95))

    def axles(self) -> None:
        for end, x in (("rear", -self.axle_x), ("front", self.axle_x)):
            self.steered_axle(end, x, self.tyre_r, self.tyre_w, prefix=f"{end}_", fast=True)

    def outriggers(self) -> None:
        s, aside = self.s, 0.105
        near = (self.tyre_r / s) + 0.25
        count = 0
        for end, way in (("front", 1.0), ("rear", -1.0)):
            for side, letter in SIDES:
                x = way * (self.axle_x / s + near) + side * aside
                self.outrigger(f"{end}_outrigger", x, side, letter, count)
                count += 1

    def outrigger(self, name: str, x: float, side: int, letter: str, number: int) -> None:
        """A beam in its box under the rails, and the jack at its end."""
        s, m, (half, high, wall), out = self.s, self.m, BEAM, float(self.beam_out[number])
        beam, foot = f"{name}_beam_{letter}", f"{name}_jack_{letter}"
        z = 0.58 - high - LOOSE - BOX_WALL + self.e / s
        wide, tall = half + LOOSE + BOX_WALL, high + LOOSE + BOX_WALL

        def along(shape: str, body: str, sizes: tuple[float, float, float], start: float, long: float) -> None:
            tube_ = rectangular_tube(f"{shape}_{body}", long * s, 2 * sizes[1] * s, 2 * sizes[0] * s, sizes[2] * s)
            m.add(shape, body, body, tube_, place((x * s, side * start * s, z * s), Z, side * Y))

        along("outrigger box", "carrier", (wide, tall, BOX_WALL), -0.8, 1.6)
        along("outrigger beam", beam, (half, high, wall), -0.85 + out, 1.72)
        y = 0.96 + out
        low, top = sorted((side * (0.87 + out - self.e / s), side * (y - 0.06)))
        self.block("jack mount", beam, (x - 0.05, low, z - 0.08), (x + 0.05, top, z + 0.08))
        bore, rod, long = 0.034, 0.022, 0.5
        can = [(0.0, 0.0), (0.047, 0.0), (0.047, long), (rod, long), (rod, long - 0.05), (bore, long - 0.05),
               (bore, 0.04), (0.0, 0.04)]  # fmt: skip
        can = [(r * s, h * s) for r, h in can]
        head = np.array([x * s, side * y * s, (z + 0.25) * s])
        lug = np.array([x, side * (y - 0.05 - self.e / s), z]) * s
        barrel = merged(
            f"{name}_{letter}_jack_barrel",
            (lathe("jack_can", can), place(head, -Z)),
            (box("jack_lug", 0.1 * s, 0.02 * s, 0.14 * s), place(lug, Z, X)),
        )
        m.add("jack barrel", f"{name}_jack_barrel_{letter}", beam, barrel, np.eye(4))
        down = float(self.jack_out[number])
        bar = merged(
            "jack_rod",
            (tube("jack_bar", rod * s, 0.0, (long - 0.05) * s), np.eye(4)),
            (tube("jack_piston", bore * s, rod * s, 0.05 * s), np.eye(4)),
        )
        m.add("jack rod", f"{name}_jack_rod_{letter}", foot, bar, place(head - (0.05 + down) * s * Z, -Z))
        low_end = head - (0.05 + down + long - 0.05) * s * Z
        m.add("float", foot, foot, tube("float", 0.13 * s, 0.0, 0.03 * s), place(low_end + self.e * Z, -Z))
        # Its own cylinder, in the beam: fixed to a plate behind the box, and to the beam's end.
        back = -0.87
        bore, rod, long = 0.022, 0.013, 0.85
        can = [(0.0, 0.0), (0.03, 0.0), (0.03, long), (rod, long), (rod, long - 0.05), (bore, long - 0.05),
               (bore, 0.03), (0.0, 0.03)]  # fmt: skip
        can = [(r * s, h * s) for r, h in can]
        foot_at = np.array([x * s, side * back * s, z * s])
        m.add(
            "beam barrel", f"{name}_beam_barrel_{letter}", "carrier", lathe("beam_can", can), place(foot_at, side * Y)
        )
        end_y = 0.87 + out - back
        start = 0.05 + out
        bar = tube(f"beam_rod_{out:.4f}", rod * s, 0.0, (end_y - start) * s)
        m.add("beam rod", f"{name}_beam_rod_{letter}", beam, bar, place(foot_at + side * start * s * Y, side * Y))
        low, top = sorted((side * (back - 0.02), side * (back + self.e / s)))
        self.block("beam foot", "carrier", (x - 0.03, low, z - 0.03), (x + 0.03, top, z + tall + 0.02))
        low, top = sorted((side * back, side * -0.6))
        stay = z + tall - self.e / s
        self.block("beam stay", "carrier", (x - 0.03, low, stay), (x + 0.03, top, z + tall + 0.02))
        low, top = sorted((side * (0.86 + out), side * (0.87 + out)))
        self.block("beam end", beam, (x - half + wall - self.e / s, low, z - high + wall - self.e / s),
                   (x + half - wall + self.e / s, top, z + high - wall + self.e / s))  # fmt: skip

    # ---- superstructure ----
    def upper(self) -> None:
        s, t, e, m, body, wide = self.s, self.t, self.e, self.m, "superstructure", 2.3 * self.pin_r
        r, low, h = 0.36 * s, 0.9 * s, 0.12 * s
        race = lathe("inner_race", [(0.8 * r, 0), (r, 0), (r, 0.85 * h), (0.8 * r, 0.85 * h)])
        m.add("inner race", "slewing_bearing", "carrier", race, place((0, 0, low - e), Z))
        clear = self.clearance + 1e-4 * s
        race = lathe("outer_race", [(r + clear, 0), (1.22 * r, 0), (1.22 * r, 0.85 * h), (r + clear, 0.85 * h)])
        m.add("outer race", body, body, race, place((0, 0, low + 0.15 * h + e), Z))
        floor = (low + h) / s
        self.block("base plate", body, (-1.55, -0.42, floor), (0.95, 0.42, floor + 0.05))
        p, top = self.P["P"], (floor + 0.05) * s - e
        cheek = around((-1.5 * s, top, 0), (-0.85 * s, top, 0), (*p, wide))
        for side in (1, -1):
            self.side_plate("cheek", body, side * self.y_cheek, cheek, "P")
        self.pin_across("boom_pin", body, "P", half=self.y_cheek + t)
        c = self.P["C"]
        for y, letter in self.luffing_y:
            self.lugs("luffing lug", body, y, "C", np.array([c[0] - 0.07 * s, top]), np.array([c[0] + 0.07 * s, top]))
            self.pin_across(f"luffing_cylinder_barrel{letter}_pin", body, "C", y)
        ballast = float(self.rng.uniform(0.25, 0.45))
        self.block("counterweight", body, (-1.95, -0.42, floor), (-1.55 + e / s, 0.42, floor + ballast))
        cab = float(self.rng.uniform(0.85, 1.0))
        self.block("cab", body, (0.15, 0.27, floor + 0.05 - e / s), (0.95, 0.85, floor + 0.05 + cab))
        self.block("cooler", body, (-0.4, -0.8, floor + 0.05 - e / s), (0.8, -0.27, floor + 0.35))

    # ---- boom ----
    def sections_out(self) -> None:
        s, t, e, wide, names = self.s, self.t, self.e, 2.2 * self.pin_r, BODIES[self.sections]
        half = HALF
        for number, body in enumerate(names):
            less = number * (WALL + LOOSE)
            half, high = HALF - less, HIGH - less
            start = 0.1 + 0.1 * number + number * self.out
            end = self.long - 0.3 if body == "inner_boom" else self.end + 0.12 * number + number * self.out
            shape = rectangular_tube(f"section_{body}", (end - start) * s, 2 * high * s, 2 * half * s, WALL * s)
            along, up = polar(1.0, self.boom), polar(1.0, self.boom + math.pi / 2)
            at = self.on(start, self.axis)
            matrix = place((at[0], 0, at[1]), (up[0], 0, up[1]), (along[0], 0, along[1]))
            self.m.add("section", body, body, shape, matrix)
        low, top = self.axis - HIGH, self.axis + HIGH
        tail = around((*self.P["P"], wide), *((*self.on(x, z), 0.0) for x, z in (
            (0.7, low + 0.02), (0.7, top - 0.02), (0.15, top - 0.05),
        )))  # fmt: skip
        for side in (1, -1):
            self.side_plate("tail", "boom", side * self.y_tail, tail, "P")
        along_d = float((self.P["D"] / s - self.pivot) @ polar(1.0, self.boom))
        for y, letter in self.luffing_y:
            self.lugs("luffing rod lug", "boom", y, "D", *(self.on(along_d + d, low + e / s) for d in (-0.1, 0.1)))
            self.pin_across(f"luffing_piston_rod{letter}_pin", "boom", "D", y)
        if self.pinned:
            self.pinned_cylinder()
        else:
            self.coupled_feet(names[1], top)
        if not self.hook:
            return
        y, back = half * s + t / 2 - e, self.long - 0.5
        head = around((*self.P["N"], wide), *((*self.on(x, self.axis + z), 0.0) for x, z in (
            (back, 0.1), (back, -0.1), (self.long - 0.05, 0.1),
        )))  # fmt: skip
        for side in (1, -1):
            self.side_plate("head", "inner_boom", side * y, head, "N")
        self.pin_across("hoist_rope_pin", "inner_boom", "N", half=y + t)

    def pinned_cylinder(self) -> None:
        """Inside: the barrel is fast on a block at the boom's foot, and the rod has been fetched back into it."""
        s, e, m = self.s, self.e, self.m
        inside, low, high = HALF - WALL + e / s, self.axis - HIGH + WALL - e / s, self.axis + HIGH - WALL + e / s
        along, up = polar(1.0, self.boom), polar(1.0, self.boom + math.pi / 2)
        way = np.array([along[0], 0.0, along[1]])
        block = box("telescope_foot", 0.05 * s, 2 * inside * s, (high - low) * s)
        at = self.on(0.14, low)
        m.add("telescope foot", "boom", "boom", block, place((at[0], 0, at[1]), (up[0], 0, up[1]), way))
        start, bore, rod, long = self.on(0.165, self.axis), 0.034 * s, 0.02 * s, 0.6 * self.end * s
        can = [(0.0, 0.0), (1.2 * bore, 0.0), (1.2 * bore, long), (rod, long), (rod, long - 0.05 * s),
               (bore, long - 0.05 * s), (bore, 0.04 * s), (0.0, 0.04 * s)]  # fmt: skip
        foot = np.array([start[0], 0.0, start[1]])
        m.add("telescope barrel", "telescope_cylinder", "boom", lathe("telescope_can", can),
              place(foot - e * way, way))  # fmt: skip
        bar = merged(
            "telescope_rod",
            (tube("telescope_bar", rod, 0.0, long), place(0.05 * s * Z, Z)),
            (tube("telescope_piston", bore, rod, 0.05 * s), place(0.05 * s * Z, Z)),
        )
        m.add("telescope rod", "telescope_cylinder", "boom", bar, place(foot, way))

    def coupled_feet(self, body: str, top: float) -> None:
        """Lugs of the telescoping cylinder, on the outermost section and on the next."""
        e = self.e / self.s
        self.lugs("telescope lug", "boom", 0.0, "V", self.on(0.45, top - e), self.on(0.55, top - e))
        self.pin_across("telescope_cylinder_barrel_pin", "boom", "V")
        x = self.end + self.out
        over = top - WALL - LOOSE - e
        self.lugs("telescope rod lug", body, 0.0, "W", self.on(x + 0.01, over), self.on(x + 0.09, over))
        role = "telescope_piston_rod_pin" if self.sections == 2 else "middle_telescope_piston_rod_pin"
        self.pin_across(role, body, "W")

    def hoist(self, pin: str, name: str, body: str, *, falls: int, drop: float) -> None:
        """Rope and sheaves in one, and the hook block that it runs into."""
        s, e, m = self.s, self.e, self.m
        n, r, rope = self.P[pin], 0.075 * s, 0.006 * s
        pitch, drop = 0.024 * s, drop * s
        rows = (np.arange(falls) - 0.5 * (falls - 1)) * pitch
        sheave = 0.5 * falls * pitch + 0.006 * s
        shapes = [(tube("head_sheave", r, self.bore_r, 2 * sheave), place((0, -sheave, 0), Y))]
        spots = [(side * (r - 0.5 * rope), float(y)) for y in rows for side in (1.0, -1.0)]
        below = 0.12 * s
        shapes += [(tube("fall", rope, 0.0, drop - below), place((x, y, -drop), Z)) for x, y in spots]
        # Between the sheave and the fall's upper end the rope is one with both.
        shapes += [(tube("fall_top", rope, 0.0, below), place((x, y, -below), Z)) for x, y in spots]
        at = np.eye(4)
        at[:3, 3] = (n[0], 0.0, n[1])
        m.add("rope", name, name, merged(f"rope_{falls}_{drop:.4f}", *shapes), at)
        wide = sheave + 0.012 * s
        holes = [(x, y, 1.7 * rope) for x, y in spots]
        guard = box("guard", 2 * r + 0.05 * s, 2 * wide, 0.06 * s, holes)
        top = n[1] - drop + 0.12 * s
        m.add("rope guard", body, body, guard, place((n[0], 0, top), Z, X))
        outline = around((0.0, -0.16 * s, 0.06 * s), (r + 0.025 * s, 0.15 * s, 0.0), (-r - 0.025 * s, 0.15 * s, 0.0))
        for side in (1, -1):
            cheek = plate("block_cheek", outline, 0.02 * s)
            at_y = side * (wide + 0.01 * s - e)
            m.add("block cheek", body, body, cheek, place((n[0], at_y, n[1] - drop), -Y, X))
        self.block("hook trunnion", body, (n[0] / s - 0.04, -wide / s, (n[1] - drop) / s - 0.2),
                   (n[0] / s + 0.04, wide / s, (n[1] - drop) / s - 0.13))  # fmt: skip
        shank = tube("hook", 0.03 * s, 0.0, 0.2 * s)
        m.add("hook", body, body, shank, place((n[0], 0, n[1] - drop - 0.4 * s + e), Z))

    def draw_jib(self) -> None:
        """Two long plates about brackets beside the boom's head, in line with it, with ties between them."""
        s, t, e, m, half = self.s, self.t, self.e, self.m, HALF - (self.sections - 1) * (WALL + LOOSE)
        self.P["J"], end = self.on(self.long - 0.1, self.axis + 0.3), self.on(self.long + JIB, self.axis + 0.3)
        wide, y = 2.0 * self.pin_r, half * s + t / 2 - e + t
        bracket = around((*self.P["J"], wide), *((*self.on(x, self.axis + z), 0.0) for x, z in (
            (self.long - 0.5, 0.08), (self.long - 0.38, -0.04),
        )))  # fmt: skip
        arm, pins = around((*self.P["J"], wide), (*end, 0.5 * wide)), "J"
        if self.jib == "hook":
            self.P["E"] = self.on(self.long + JIB + 0.14, self.axis + 0.3)
            arm, pins = around((*self.P["J"], wide), (*self.P["E"], wide)), "JE"
            self.pin_across("jib_hoist_rope_pin", "jib", "E", half=y + 1.6 * t + self.gap)
        for side in (1, -1):
            self.side_plate("jib bracket", "inner_boom", side * (y - e), bracket, "J")
            self.side_plate("jib arm", "jib", side * (y + t + self.gap), arm, pins)
        self.pin_across("jib_pin", "inner_boom", "J", half=y + 2.0 * t + self.gap)
        along, up = polar(1.0, self.boom), polar(1.0, self.boom + math.pi / 2)
        tie = box("jib_tie", 0.05 * s, 2.0 * (y + 0.5 * t + self.gap + e), 0.05 * s)
        for x in (0.35, 0.7 * JIB, JIB - 0.03):
            at = self.on(self.long + x, self.axis + 0.275)
            m.add("jib tie", "jib", "jib", tie, place((at[0], 0, at[1]), (up[0], 0, up[1]), (along[0], 0, along[1])))

    def rams(self) -> None:
        s = self.s

        def flat(pin: str, y: float = 0.0) -> Array:
            return np.array([self.P[pin][0], y, self.P[pin][1]])

        bore = 0.032 if self.twin else 0.05
        for y, letter in self.luffing_y:
            halves = f"luffing_cylinder_barrel{letter}", f"luffing_piston_rod{letter}"
            self.cylinder(f"luffing{letter}", *halves, flat("C", y), flat("D", y), Y, bore * s)
        if not self.pinned:
            halves = "telescope_cylinder_barrel", "telescope_piston_rod"
            self.cylinder("telescope", *halves, flat("V"), flat("W"), Y, 0.034 * s)


def crane(
    seed: int, *, sections: int | None = None, twin: bool | None = None, hook: bool | None = None,
    pinned: bool = False, jib: bool | str = False, embedded: bool = False,
) -> Machine:  # fmt: skip
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's.
    `pinned`: all sections in, as one that a single cylinder inside draws out and pins is on the road; `jib`: one in
    line with the boom, beside a head with a hook, or with a `hook` of its own."""
    drawn = np.random.default_rng([seed, 59]).random(3)
    return Crane(
        seed, sections=int(2 + drawn[0] * 3) if sections is None else sections,
        twin=bool(drawn[1] < 0.4) if twin is None else twin, hook=bool(drawn[2] < 0.75) if hook is None else hook,
        pinned=pinned, jib=jib if isinstance(jib, str) else "jib" if jib else "", embedded=embedded,
    ).draw()  # fmt: skip
