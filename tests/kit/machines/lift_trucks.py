"""Parametric counterbalance forklifts straight as `Assembly` objects, with the truth: masts of two and three stages.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are. x = 0
at the front axle.
"""

from __future__ import annotations

import numpy as np

from kit.machines.crawler import merged
from kit.machines.solids import Array, around, box, lathe, place, plate, tube
from kit.machines.synthetic import Drawer, Machine, X, Y, Z
from yellowiron.model.geometry import Shape

SIDES = ((1, "l"), (-1, "r"))
STAGES = {"simplex": 2, "duplex": 2, "triplex": 3}
BODIES = {2: ("inner_mast", "outer_mast"), 3: ("inner_mast", "middle_mast", "outer_mast")}
"""Sections by how many there are, from the innermost."""


class LiftTruck(Drawer):
    """One machine from one generator of random numbers."""

    def __init__(self, seed: int, mast: str, *, embedded: bool) -> None:
        super().__init__(seed, twin=True, steered=False, embedded=embedded, stop=False, hoses=0)
        u, s = self.rng.uniform, self.s
        self.m.title, self.mast = "FORKLIFT", mast
        self.t, self.e = 0.02 * s, 0.003 * s if embedded else 0.0
        self.pin_r, self.eye_w = 0.02 * s * u(0.85, 1.15), 0.05 * s
        self.wheelbase = 1.62 * s * u(0.93, 1.12)
        self.front = (0.34 * s * u(0.93, 1.08), 0.22 * s * u(0.85, 1.15), 1.08 * s * u(0.98, 1.05))  # type: ignore[assignment]
        self.rear = (0.27 * s * u(0.95, 1.08), 0.17 * s * u(0.85, 1.15), 1.06 * s * u(0.99, 1.05))
        self.gap = float(self.rng.choice([0.0, 0.001, 0.002])) * s
        self.y_rail, self.play = 0.32 * s, 0.006 * s
        self.height = 1.95 * s * u(0.9, 1.2)
        self.lift, self.free = (float(u(0.05, 0.3)) * s, float(u(0.0, 0.15)) * s)
        self.P = {"M": s * np.array([0.15, 0.3]), "T": s * np.array([-0.36 * u(0.9, 1.2), 0.56])}
        self.y_eye = self.y_rail - self.t / 2 - 0.03 * s - self.eye_w / 2
        self.P["Q"] = s * np.array([0.38 - 0.19, 0.6 * u(0.95, 1.15)])

    def link_pins(self) -> None:
        self.P: dict[str, Array] = {}

    def draw(self) -> Machine:
        self.m.pose = np.eye(4)
        self.chassis()
        self.steer_axle()
        for section, body in enumerate(BODIES[STAGES[self.mast]]):
            self.section(section, body)
        self.pivots()
        self.rams()
        self.carriage()
        return self.m

    def rolls(self, tyre: tuple[float, float, float]) -> None:
        """The wheels that are drawn from now on: radius, width, tread."""
        self.tyre_r, self.tyre_w, self.tread = tyre

    # ---- chassis ----
    def chassis(self) -> None:
        s, t, body, y, w = self.s, self.t, "chassis", self.y_rail, self.wheelbase / self.s
        u = self.rng.uniform
        corners = [(x * s, z * s, 0) for x in (-w + 0.35, 0.2) for z in (0.24, 0.62)]
        for side, letter in SIDES:
            self.side_plate("rail", body, side * y, around(*corners), "MT")
            self.across("mast_pin", body, self.P["M"], side, y - 2.4 * t - self.gap, y + t)
            near = self.y_eye - self.eye_w / 2 - self.gap - t / 2
            lug = around(
                (*self.P["T"], 2 * self.pin_r), *(((self.P["T"][0] + d * s), 0.62 * s, 0) for d in (-0.08, 0.08))
            )
            self.side_plate("tilt lug", body, side * near, lug, "T")
            self.across(f"tilt_cylinder_barrel_{letter}_pin", body, self.P["T"], side, near - t, y + t)
        inner = (y - t / 2 + self.e) / s
        wide = float(u(0.48, 0.54))
        self.block("rear frame", body, (-w - 0.3, -0.3, 0.47), (-w + 0.35, 0.3, 0.62))
        self.block("engine", body, (-w + 0.4, -inner, 0.3), (-0.62, inner, 0.6))
        self.block("counterweight", body, (-w - 0.55, -wide, 0.35), (-w - 0.3, wide, 1.0))
        self.block("counterweight top", body, (-w - 0.3, -wide, 0.62), (-w + 0.1, wide, 1.0))
        self.block("hood", body, (-w + 0.1, -0.38, 0.62), (-0.45, 0.38, float(u(0.85, 1.0))))
        self.block("floor", body, (-0.45, -0.42, 0.62), (0.12, 0.42, 0.64))
        self.block("dashboard", body, (0.02, -0.34, 0.64), (0.12, 0.34, 1.02))
        self.block("tie", body, (0.08, -inner, 0.45), (0.12, inner, 0.6))
        top = float(u(1.95, 2.2))
        for side in (1, -1):
            near, far = sorted((side * 0.37, side * 0.41))
            self.block("front post", body, (0.06, near, 0.64), (0.11, far, top))
            self.block("rear post", body, (-w, near, 1.0), (-w + 0.05, far, top))
        self.block("overhead guard", body, (-w, -0.41, top), (0.11, 0.41, top + 0.03))
        self.rolls(self.front)  # type: ignore[arg-type]
        for side, letter in SIDES:
            self.stub(f"front_wheel_{letter}", body, side, 0.0, y + t / 2 - self.e, 0.6)

    def steer_axle(self) -> None:
        """A beam that rolls on its pin, knuckles, and a cylinder with a rod at both ends behind it."""
        s, t, m, x, body = self.s, self.t, self.m, -self.wheelbase, "steer_axle"
        self.rolls(self.rear)
        z, r = self.tyre_r + 0.03 * s, 1.1 * self.pin_r
        roof = 0.47 * s
        for d in (1, -1):
            hanger = around((0, z, 2 * r), (0.12 * s, roof + self.e, 0), (-0.12 * s, roof + self.e, 0))
            at = x + d * (0.06 * s + self.gap + t / 2)
            m.add("hanger", "chassis", "chassis", plate("hanger", hanger, t, [(0, z, r)]), place((at, 0, 0), X, Y))
            cheek = around((0, 0, 2 * r), *((y * s, h * s, 0) for y in (-0.055, 0.055) for h in (-0.045, 0.045)))
            shape = plate("axle_cheek", cheek, t, [(0, 0, r)])
            m.add("axle cheek", body, body, shape, place((x + d * (0.06 * s - t / 2), 0, z), X, Y))
            ends = sorted((x + d * (0.06 * s - t), x + d * (0.06 * s + self.gap + 1.8 * t)))
            self.pin("steer_axle_pin", "chassis", *(np.array([end, 0, z]) for end in ends), radius=r)
        half = 0.22 * s
        beam = box("beam", 0.12 * s - 2 * t, 2 * half, 0.09 * s)
        m.add("axle beam", body, body, beam, place((x, 0, z), Z, X))
        king, arm, end = (np.array([x, 0.0]) + s * np.array(p) for p in ((0.0, 0.33), (-0.11, 0.31), (-0.17, 0.21)))
        self.z_low = z - 0.045 * s - self.gap - t / 2
        for side, letter in SIDES:
            self.knuckle(side, letter, king, arm, z)
        z_tie = self.z_low - t / 2 - self.gap - 0.01 * s
        z_rod = z_tie + 0.01 * s + self.gap + 0.015 * s
        self.steering(end, z_rod, z)
        eye = 1.7 * self.pin_r
        for side, letter in SIDES:
            (ax, ay), (ex, ey) = arm * np.array([1, side]), end * np.array([1, side])
            holes = [(ax, ay, self.bore_r), (ex, ey, self.bore_r)]
            tie = plate(f"tie{side}", around((ax, ay, eye), (ex, ey, eye)), 0.02 * s, holes)
            m.add("tie rod", f"tie_rod_{letter}", f"tie_rod_{letter}", tie, place((0, 0, z_tie), Z, X))
            low = z_tie - 0.014 * s
            self.pin(
                f"tie_rod_{letter}_pin",
                f"knuckle_{letter}",
                np.array([ax, ay, low]),
                np.array([ax, ay, self.z_low + t]),
            )
            top = np.array([ex, ey, z_rod + 0.02 * s])
            self.pin(f"steering_piston_rod_{letter}_pin", "steering_piston_rod", np.array([ex, ey, low]), top)

    def knuckle(self, side: int, letter: str, king: Array, arm: Array, z: float) -> None:
        s, t, body, mirror = self.s, self.t, f"knuckle_{letter}", np.array([1, side])
        (kx, ky), (ax, ay) = king * mirror, arm * mirror
        hole = (float(kx), float(ky), self.bore_r)
        foot = side * (0.22 * s - self.e)
        eye = around((kx, ky, 0.045 * s), (kx - 0.04 * s, foot, 0), (kx + 0.04 * s, foot, 0))
        thick = 0.09 * s
        self.m.add(
            "axle eye", "steer_axle", "steer_axle", plate(f"axle_eye{side}", eye, thick, [hole]), place((0, 0, z), Z, X)
        )
        web = abs(ky) + 0.06 * s
        fork = around((kx, ky, 0.045 * s), (kx - 0.04 * s, side * web, 0), (kx + 0.04 * s, side * web, 0))
        lever = around((kx, ky, 0.04 * s), (ax, ay, 1.7 * self.pin_r))
        high, reach = 2 * z - self.z_low, self.tread / 2 - 0.105 * s
        end = web + 0.02 * s
        shapes = [
            (
                plate(f"lever{side}", lever, t, [hole, (float(ax), float(ay), self.pin_r)]),
                place((0, 0, self.z_low), Z, X),
            ),
            (plate(f"fork_low{side}", fork, t, [hole]), place((0, 0, self.z_low), Z, X)),
            (plate(f"fork_top{side}", fork, t, [hole]), place((0, 0, high), Z, X)),
            (box("web", 0.1 * s, 0.02 * s, high - self.z_low + t), place((kx, side * (web + 0.01 * s), z), Z, X)),
            (tube("spindle", 0.03 * s, 0.0, reach - end), place((kx, side * end, self.tyre_r), side * Y)),
        ]
        self.m.add("knuckle", body, body, merged(body, *shapes), np.eye(4))
        centre = np.array([kx, side * self.tread / 2, self.tyre_r])
        self.wheel(f"rear_wheel_{letter}", body, side, centre, reach)
        low = np.array([kx, ky, self.z_low - t])
        self.pin(f"knuckle_{letter}_pin", "steer_axle", low, np.array([kx, ky, high + t]))

    def steering(self, end: Array, z: float, beam: float) -> None:
        s, m, (x, y) = self.s, self.m, end
        bore, rod_r, half = 0.028 * s, 0.014 * s, 0.09 * s
        outer, eye = 1.25 * bore, 1.7 * self.pin_r
        shape = lathe(
            "steer_tube",
            [(rod_r, 0), (outer, 0), (outer, 2 * half), (rod_r, 2 * half), (rod_r, 1.85 * half), (bore, 1.85 * half),
             (bore, 0.15 * half), (rod_r, 0.15 * half)],
        )  # fmt: skip
        face, top = -self.wheelbase - 0.06 * s + self.t, beam + 0.03 * s
        low = (x + 0.8 * outer, z - 0.02 * s)
        feet = [self.bar("steer_foot", (low[0], a * s, low[1]), (face, (a + 0.025) * s, top)) for a in (-0.085, 0.06)]
        barrel = merged("steer_barrel", (shape, place((x, -half, z), Y)), *feet)
        m.add("steering barrel", "steering_cylinder_barrel", "steer_axle", barrel, np.eye(4))
        body = "steering_piston_rod"
        m.add("steering rod", body, body, tube("steer_rod", rod_r, 0, 2 * (y - eye)), place((x, -y + eye, z), Y))
        m.add(
            "steering piston", body, body, tube("steer_piston", bore, rod_r, 0.3 * half), place((x, -0.15 * half, z), Y)
        )
        for side in (1, -1):
            outline = around((0, 0, eye), (eye, eye, 0), (eye, -eye, 0))
            shape = plate("steer_eye", outline, 0.03 * s, [(0, 0, self.bore_r)])
            m.add("steering rod end", body, body, shape, place((x, side * y, z), Z, -side * Y))

    # ---- mast ----
    @property
    def middle(self) -> float:
        """x of the middle of the channels."""
        return 0.38 * self.s

    def half(self, section: int) -> float:
        """Half of a channel's depth."""
        return 0.062 * self.s + section * (self.t + self.play)

    def outside(self, section: int) -> float:
        """y of a channel's web."""
        return 0.21 * self.s + section * (self.t + self.play)

    def rise(self, section: int) -> float:
        """How far a section is up; -1: the carriage."""
        last = STAGES[self.mast] - 1
        if section >= 0:
            return (last - section) * self.lift
        return last * self.lift + (2 * self.free if self.mast in ("duplex", "triplex") else self.lift)

    def ends(self, section: int) -> tuple[float, float]:
        """Between which heights a section's channels are."""
        s, last = self.s, STAGES[self.mast] - 1
        up = self.rise(section)
        return 0.12 * s + (0.0 if section == last else 0.02 * s) + up, self.height + 0.07 * s * (last - section) + up

    def bar(self, name: str, low: Array | tuple[float, ...], high: Array | tuple[float, ...]) -> tuple[Shape, Array]:
        """A block between two corners, metres, and where it is."""
        a, b = np.array(low), np.array(high)
        x, y, z = b - a
        return box(f"{name}_{x:.5f}_{y:.5f}_{z:.5f}", x, y, z), place(0.5 * (a + b), Z, X)

    def section(self, section: int, body: str) -> None:
        """Two channels and what ties them: one weldment."""
        s, t, x, h, y = self.s, self.t, self.middle, self.half(section), self.outside(section)
        (low, high), flange = self.ends(section), y - 0.07 * s
        pieces = []
        for side in (1, -1):
            (web, outer), (inner, joint) = (sorted((side * a, side * b)) for a, b in ((y - t, y), (flange, y - t)))
            pieces += [
                self.bar("web", (x - h, web, low), (x + h, outer, high)),
                self.bar("flange", (x - h, inner, low), (x - h + t, joint, high)),
                self.bar("flange", (x + h - t, inner, low), (x + h, joint, high)),
            ]
        if section == STAGES[self.mast] - 1:
            pieces.append(self.bar("tie", (x - h - 0.015 * s, -y, high - 0.1 * s), (x - h, y, high - 0.02 * s)))
            pieces.append(self.bar("foot", (x - h - 0.1 * s, -y, low), (x - h, y, low + 0.05 * s)))
        else:
            pieces.append(self.bar("tie", (x - h - 0.1 * s, -y, high - 0.05 * s), (x - h, y, high)))
            pieces.append(self.bar("low_tie", (x - h, -flange, low + 0.06 * s), (x - h + t, flange, low + 0.16 * s)))
        self.m.add("mast section", body, body, merged(f"{body}_section", *pieces), np.eye(4))

    def pivots(self) -> None:
        """Lugs on the outer channels: of the mast's pins, and of the tilt cylinders'."""
        s, t, body, outer = self.s, self.t, "outer_mast", STAGES[self.mast] - 1
        back, y = self.middle - self.half(outer), self.outside(outer)
        y_eye = self.y_eye
        for side, letter in SIDES:
            y_lug = self.y_rail - t - self.gap - 0.004 * s
            for name, pin, ways in (("pivot", "M", (y_lug,)), ("tilt", "Q", tuple(
                y_eye + d * (self.eye_w / 2 + self.gap + t / 2) for d in (1, -1)
            ))):  # fmt: skip
                z = self.P[pin][1]
                a, b = sorted((side * (y - 0.04 * s), side * (max(ways) + t / 2)))
                shape, at = self.bar("mount", (back - 0.02 * s, a, z - 0.06 * s), (back, b, z + 0.06 * s))
                self.m.add(f"{name} mount", body, body, shape, at)
                face = back - 0.02 * s + self.e
                lug = around((*self.P[pin], 2 * self.pin_r), (face, z - 0.06 * s, 0), (face, z + 0.06 * s, 0))
                for way in ways:
                    self.side_plate(f"{name} lug", body, side * way, lug, pin)
            reach = self.eye_w / 2 + self.gap + 1.6 * t
            self.across(f"tilt_piston_rod_{letter}_pin", body, self.P["Q"], side, y_eye - reach, y_eye + reach)
            ends = (self.at("T", side * y_eye), self.at("Q", side * y_eye))
            names = (f"tilt_cylinder_barrel_{letter}", f"tilt_piston_rod_{letter}")
            self.cylinder(f"tilt {letter}", *names, *ends, Y, 0.026 * s)

    def ram(
        self, name: str, halves: tuple[str, str], bodies: tuple[str, str], foot: Array, top: float, out: float
    ) -> None:
        """A ram without pins: its barrel stands on a foot, its rod, `out` of it, ends at a height."""
        s, m, (barrel, rod) = self.s, self.m, halves
        bore, rod_r, wall, cap = 0.024 * s, 0.017 * s, 0.006 * s, 0.02 * s
        n = top - out - foot[2] - 0.03 * s
        r = bore + wall
        can = lathe(f"{name}_can_{n:.4f}", [(0, 0), (r, 0), (r, n), (bore, n), (bore, cap), (0, cap)])
        m.add(f"{name} barrel", barrel, bodies[0], can, place(foot, Z))
        gland = lathe(
            f"{name}_gland", [(rod_r, -cap), (bore, -cap), (bore, 0), (r, 0), (r, 0.01 * s), (rod_r, 0.01 * s)]
        )
        m.add(f"{name} gland", barrel, bodies[0], gland, place(foot + n * Z, Z))
        start = foot[2] + cap + out + 0.01 * s
        bar = tube(f"{name}_rod_{top - start:.4f}", rod_r, 0.0, top - start)
        m.add(f"{name} rod", rod, bodies[1], bar, place((foot[0], foot[1], start), Z))
        m.add(
            f"{name} piston",
            rod,
            bodies[1],
            tube(f"{name}_piston", bore, rod_r, 0.02 * s),
            place((foot[0], foot[1], start), Z),
        )

    def rams(self) -> None:
        s, stages, m = self.s, STAGES[self.mast], self.m
        names = BODIES[stages]
        outer = stages - 1
        x = self.middle - self.half(outer) - 0.058 * s
        top = self.ends(outer - 1)[1] - 0.05 * s
        words = "second_lift" if self.mast == "triplex" else "lift"
        for side, letter in SIDES:
            foot = np.array([x, side * 0.13 * s, self.ends(outer)[0] + 0.05 * s])
            halves = (f"{words}_cylinder_barrel_{letter}", f"{words}_piston_rod_{letter}")
            self.ram(f"lift {letter}", halves, (names[outer], names[outer - 1]), foot, top, self.lift)
        if self.mast not in ("duplex", "triplex"):
            return
        low, high = self.ends(0)
        h, t, mid = self.half(0), self.t, self.middle
        shape, at = self.bar(
            "step", (mid - h + t, -0.04 * s, low + 0.06 * s), (mid + 0.035 * s, 0.04 * s, low + 0.16 * s)
        )
        m.add("free lift step", "inner_mast", "inner_mast", shape, at)
        foot = np.array([mid, 0.0, low + 0.16 * s])
        end = foot[2] + 0.45 * (high - low) + self.free
        body = "free_lift_crosshead"
        halves = ("free_lift_cylinder_barrel", "free_lift_piston_rod")
        self.ram("free lift", halves, ("inner_mast", body), foot, end, self.free)
        shape, at = self.bar("crosshead", (mid - 0.03 * s, -0.07 * s, end), (mid + 0.03 * s, 0.07 * s, end + 0.04 * s))
        m.add("crosshead", body, body, shape, at)
        for side in (1, -1):
            wheel = tube("chain_wheel", 0.035 * s, 0.0, 0.02 * s)
            m.add("chain wheel", body, body, wheel, place((mid, side * 0.09 * s - 0.01 * s, end + 0.02 * s), Y))

    @property
    def zero(self) -> float:
        """Under what is lowest of the carriage, lowered."""
        return 0.06 * self.s

    def carriage(self) -> None:
        s, body, x, h, y = self.s, "carriage", self.middle, self.half(0), self.outside(0)
        z, t = self.zero + self.rise(-1) + 0.06 * s, self.t
        edge, front = y - 0.07 * s - 0.012 * s, x + self.half(STAGES[self.mast] - 1) + 0.012 * s
        high = z + 0.45 * s
        for side in (1, -1):
            a, b = sorted((side * edge, side * (y - t - self.play)))
            c, d = sorted((side * (edge - 0.06 * s), side * edge))
            inside = h - t - self.play
            for name, low, top in (
                ("carriage runner", (x - inside, a, z), (x + inside, b, high)),
                ("carriage bracket", (x - inside, c, z), (front, d, high)),
            ):
                self.m.add(name, body, body, *self.bar(name, low, top))
        wide, thick = float(self.rng.uniform(0.42, 0.56)) * s, 0.03 * s
        for name, low in (("low bar", z + 0.02 * s), ("top bar", z + 0.35 * s)):
            shape, at = self.bar(name, (front - self.e, -wide, low), (front + thick, wide, low + 0.08 * s))
            self.m.add(name, body, body, shape, at)
        if self.rng.random() < 0.6:
            shape, at = self.bar("backrest", (front, -wide, high), (front + 0.02 * s, wide, z + 0.43 * s + 0.6 * s))
            self.m.add("backrest", body, body, shape, at)
        face, long = front + thick - self.e, float(self.rng.uniform(0.9, 1.2)) * s
        at_y, broad = float(self.rng.uniform(0.16, 0.32)) * s, 0.06 * s
        for side in (1, -1):
            a, b = side * at_y - broad, side * at_y + broad
            fork = merged(
                f"fork{side}",
                self.bar("shank", (face, a, z - 0.06 * s), (face + 0.035 * s, b, z + 0.44 * s)),
                self.bar("blade", (face + 0.035 * s, a, z - 0.06 * s), (face + 0.035 * s + long, b, z - 0.025 * s)),
            )
            self.m.add("fork", "forks", body, fork, np.eye(4))


def lift_truck(seed: int, mast: str | None = None, *, embedded: bool = False) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names; a mast not stated is the seed's."""
    rng = np.random.default_rng([seed, 67])
    return LiftTruck(seed, mast or str(rng.choice(["simplex", "duplex", "triplex"])), embedded=embedded).draw()
