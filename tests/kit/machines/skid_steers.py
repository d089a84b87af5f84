"""Parametric skid steers straight as `Assembly` objects, with the truth: vertical or radial lift, one or two tilt
cylinders.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are.
"""

from __future__ import annotations

import math

import numpy as np

from kit.machines.solids import Array, around, bolt, box, place, plate, tube
from kit.machines.synthetic import XZ, Drawer, Machine, X, Y, Z, meet, polar

PLACES = {
    "vertical": {
        "P": (-0.97, 0.78), "Q": (-1.16, 1.6), "R": (-0.26, 0.87), "S": (-0.95, 1.25), "C": (-1.33, 0.7),
        "D": (-0.3, 1.27),
    },
    "radial": {"A": (-1.0, 1.5), "C": (-1.0, 0.58), "D": (0.1, 1.12)},
}  # fmt: skip
"""Pins, the arms lowered, of a machine of size 1; all machines have B, E and the elbow besides."""
COMMON = {"B": (1.13, 0.2), "E": (0.63, 0.8), "K": (1.1, 1.05)}


def plane(turn: float, shift: Array) -> Array:
    """(4, 4) that turns about -y (a raised arm is positive), then shifts in x and z."""
    c, s = math.cos(turn), math.sin(turn)
    matrix = np.eye(4)
    matrix[0, [0, 2]], matrix[2, [0, 2]] = (c, -s), (s, c)
    matrix[[0, 2], 3] = shift
    return matrix


def turned(angle: float, p: Array) -> Array:
    """A point of the plane turned about the origin."""
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]) @ p


class SkidSteer(Drawer):
    """One machine from one generator of random numbers."""

    def __init__(self, seed: int, path: str, *, single_tilt: bool, embedded: bool) -> None:
        self.path, self.single_tilt = path, single_tilt
        super().__init__(seed, twin=True, steered=False, embedded=embedded, stop=False, hoses=0)
        u, s = self.rng.uniform, self.s
        self.m.title = "SKID STEER"
        self.t, self.e = 0.022 * s, 0.004 * s if embedded else 0.0
        self.wheelbase, self.tyre_r = 1.2 * s * u(0.92, 1.08), 0.42 * s * u(0.93, 1.05)
        self.tyre_w, self.tread = 0.28 * s * u(0.85, 1.1), 1.5 * s * u(0.97, 1.06)
        self.pin_r, self.eye_w = 0.024 * s * u(0.85, 1.2), 0.1 * s
        self.clearance = float(self.rng.choice([0.0, 0.0001, 0.0003])) * s
        self.gap = float(self.rng.choice([0.0, 0.001, 0.002])) * s
        self.y_side, self.yb = 0.42 * s * u(0.97, 1.03), 0.64 * s * u(0.99, 1.03)

    # ---- planar linkage ----
    def link_pins(self) -> None:
        u, s = self.rng.uniform, self.s
        for _ in range(500):
            low = {k: s * np.array(v) * u(0.96, 1.04, 2) for k, v in {**PLACES[self.path], **COMMON}.items()}
            turn = float(u(0.08, 0.95))
            try:
                self.arms = plane(turn, self._shift(low, turn))
            except ValueError:
                continue
            self.low, self.turn, self.tip = low, turn, float(u(-0.9, 0.25))
            self.j = polar(0.2 * s * u(0.95, 1.05), math.radians(u(74, 88)))
            lift = np.hypot(*(self.carried("D") - low["C"]))
            tilt = np.hypot(*(low["B"] + turned(self.tip, self.j) - low["E"]))
            if 1.0 * s < lift < 1.9 * s and 0.58 * s < tilt < 0.9 * s:
                self.P = low
                return
        raise RuntimeError("no linkage for this seed")

    def _shift(self, low: dict[str, Array], turn: float) -> Array:
        if self.path == "radial":
            return low["A"] - turned(turn, low["A"])
        p, q, r, s = (low[k] for k in "PQRS")
        lengths = float(np.hypot(*(q - p))), float(np.hypot(*(s - r)))

        def joined(angle: float, side: float) -> Array:
            return meet(p, lengths[0], r - turned(angle, s - q), lengths[1], side)

        side = min((1.0, -1.0), key=lambda x: float(np.hypot(*(joined(0.0, x) - q))))
        return joined(turn, side) - turned(turn, q)

    def carried(self, pin: str) -> Array:
        """Where a pin of the lowered arms is."""
        return np.asarray((self.arms @ np.array([self.low[pin][0], 0.0, self.low[pin][1], 1.0]))[[0, 2]])

    # ---- groups ----
    def draw(self) -> Machine:
        self.y_cyl = self.y_side + self.t / 2 + 0.002 * self.s + self.eye_w / 2
        self.m.pose = np.eye(4)
        self.chassis()
        self.lift_links()
        self.lift_arms()
        self.tool()
        self.lift_cylinders()
        return self.m

    def chassis(self) -> None:
        s, body, low, L = self.s, "chassis", self.low, self.wheelbase / 2
        bottom, top = 0.2 * s, 0.93 * s
        bases = ["A"] if self.path == "radial" else ["P", "R"]
        corners = [(-1.45 * s, bottom, 0), (0.7 * s, bottom, 0), (0.7 * s, 0.8 * s, 0), (-1.45 * s, top, 0)]
        tall = [(*low[p], 2.2 * self.pin_r) for p in bases]
        for side in (1, -1):
            self.side_plate("side plate", body, side * self.y_side, around(*corners, *tall), "".join([*bases, "C"]))
            for p, role in zip(
                bases, ("boom_pin",) if len(bases) == 1 else ("rear_link_pin", "front_link_pin"), strict=True
            ):
                end = self.yb + self.t if len(bases) == 1 else self.yb - self.t / 2 - self.gap
                self.across(role, body, low[p], side, self.y_side - self.t, end)
            letter = "l" if side > 0 else "r"
            self.across(
                f"boom_cylinder_barrel_{letter}_pin",
                body,
                low["C"],
                side,
                self.y_side - self.t,
                self.y_cyl + self.eye_w / 2,
            )
        inner = (self.y_side - self.t / 2 + self.e) / s
        self.block("belly", body, (-1.4, -inner, 0.2), (0.68, inner, 0.225))
        self.block("front plate", body, (0.66, -inner, 0.225), (0.69, inner, 0.78))
        self.block("tail", body, (-1.75, -0.6, 0.4), (-1.45, 0.6, 1.2))
        self.block("engine", body, (-1.3, -0.22, 0.225), (-0.75, 0.22, 0.75))
        self.block("deck", body, (-1.4, -inner, 0.8), (0.66, inner, 0.82))
        self.block("cab", body, (-0.55, -0.4, 0.82), (0.6, 0.4, float(self.rng.uniform(1.9, 2.1))))
        self.block("hood", body, (-1.44, -0.38, 0.82), (-0.6, 0.38, 1.15))
        for side in (1, -1):
            for k in range(3):
                start = np.array([-1.75 * s, side * 0.4 * s, (0.6 + 0.2 * k) * s])
                self.m.add("M16", body, body, bolt("tail_bolt", 0.009 * s, 0.05 * s), place(start, -X))
        for end, x in (("front", L), ("rear", -L)):
            for side, letter in ((1, "l"), (-1, "r")):
                self.stub(f"{end}_wheel_{letter}", "chassis", side, x, self.y_side + self.t / 2 - self.e)

    def lift_links(self) -> None:
        if self.path == "radial":
            return
        y = self.yb - self.t - self.gap
        for role, base, end in (("rear_link", "P", "Q"), ("front_link", "R", "S")):
            p, q = self.low[base], self.carried(end)
            r = 2.2 * self.pin_r
            shape = plate(role, around((*p, r), (*q, r)), self.t, [(*p, self.bore_r), (*q, self.bore_r)])
            for side in (1, -1):
                self.m.add(role, role, role, shape, place((0, side * y, 0), XZ, X))

    def lift_arms(self) -> None:
        s, t, body, m = self.s, self.t, "boom", self.m
        ends = ["A"] if self.path == "radial" else ["Q", "S"]
        (bx, bz), (kx, kz), e = self.low["B"], self.low["K"], self.low["E"]
        wide = 2.4 * self.pin_r
        y_out, y_lug = self.yb + t, (self.y_cyl if not self.single_tilt else 0.0) + self.eye_w / 2 + self.gap + t / 2
        m.pose = self.arms
        beam = around(
            *((*self.low[p], wide) for p in ends),
            (*self.low["D"], wide),
            (kx, kz, 0.1 * s),
            (kx - 0.1 * s, kz - 0.1 * s, 0),
        )
        leg = around((bx, bz, wide), (kx, kz, 0.09 * s), (bx, bz + 0.3 * s, wide))
        for side in (1, -1):
            letter = "l" if side > 0 else "r"
            self.side_plate("arm beam", body, side * self.yb, beam, "".join([*ends, "D"]))
            self.side_plate("arm leg", body, side * (y_out - self.e), leg, "B")
            for p, role in () if len(ends) == 1 else (("Q", "rear_link_boom_pin"), ("S", "front_link_boom_pin")):
                self.across(role, body, self.low[p], side, self.yb - 1.6 * t - self.gap, self.yb + t)
            start = self.y_cyl - self.eye_w / 2
            self.across(f"boom_piston_rod_{letter}_pin", body, self.low["D"], side, start, self.yb + t)
        tube_at = np.array([bx + 0.01 * s, bz + 0.42 * s])
        half = self.yb + t / 2 + self.e
        m.add(
            "cross tube",
            body,
            body,
            tube("cross_tube", 0.05 * s, 0.04 * s, 2 * half),
            place((tube_at[0], -half, tube_at[1]), Y),
        )
        if self.single_tilt:
            high, length = kz + 0.03 * s, 2 * (self.yb - t / 2 + self.e)
            m.add("rear beam", body, body, box("rear_beam", 0.12 * s, length, 0.1 * s), place((e[0], 0, high), Z, X))
            lug = around((*e, wide), (e[0] - 0.06 * s, high - 0.05 * s, 0), (e[0] + 0.06 * s, high - 0.05 * s, 0))
            for y in (y_lug, -y_lug):
                self.side_plate("tilt lug", body, y, lug, "E")
            self.across("bucket_cylinder_barrel_pin", body, e, 1, -y_lug - t, y_lug + t)
            return
        for side, letter in ((1, "l"), (-1, "r")):
            lug = around((*e, wide), (e[0] - 0.08 * s, kz, 0), (e[0] + 0.1 * s, kz, 0))
            self.side_plate("tilt lug", body, side * y_lug, lug, "E")
            low, high = sorted((side * (y_lug + t / 2 - self.e), side * (self.yb - t / 2 + self.e)))
            shape = box("tilt_block", 0.12 * s, high - low, 0.08 * s)
            m.add("tilt block", body, body, shape, place((e[0] + 0.01 * s, 0.5 * (low + high), kz - 0.05 * s), Z, X))
            self.across(f"bucket_cylinder_barrel_{letter}_pin", body, e, side, self.y_cyl - self.eye_w / 2, y_lug + t)

    def tool(self) -> None:
        s, t, body, m = self.s, self.t, "bucket", self.m
        b = self.carried("B")
        m.pose = plane(self.turn + self.tip, b)
        wide, back = 2.2 * self.pin_r, 0.1 * s
        half, depth, reach = 0.92 * s * float(self.rng.uniform(0.95, 1.05)), 0.2 * s, 0.75 * s
        y_ear, ear = (
            self.yb - self.gap,
            around((0, 0, wide), (back + self.e, -0.09 * s, 0), (back + self.e, 0.11 * s, 0)),
        )
        lug = around((*self.j, 1.5 * self.pin_r), (back + self.e, 0.05 * s, 0), (back + self.e, 0.12 * s, 0))
        m.add(
            "carrier",
            body,
            body,
            box("carrier", 0.02 * s, 2 * (self.yb + t), 0.23 * s),
            place((back + 0.01 * s, 0, 0.01 * s), Z, X),
        )
        rods = ((0, ""),) if self.single_tilt else ((1, "_l"), (-1, "_r"))
        for side in (1, -1):
            m.add("ear", body, body, plate("ear", ear, t, [(0, 0, self.bore_r)]), place((0, side * y_ear, 0), XZ, X))
            self.across("bucket_pin", body, np.zeros(2), side, y_ear - t, self.yb + 1.7 * t)
        for side, letter in rods:
            near, far = (side * self.y_cyl - d * (self.eye_w / 2 + self.gap + t / 2) for d in (1, -1))
            for y in (near, far):
                shape = plate("rod_lug", lug, t, [(*self.j, self.bore_r)])
                m.add("rod lug", body, body, shape, place((0, y, 0), XZ, X))
            self.across(f"bucket_piston_rod{letter}_pin", body, self.j, 1, near - t, far + t)
        face = back + 0.02 * s
        high = 0.36 * s
        m.add(
            "back",
            body,
            body,
            box("bucket_back", t, 2 * half, high + depth),
            place((face + 0.06 * s, 0, 0.5 * (high - depth)), Z, X),
        )
        m.add(
            "spacer",
            body,
            body,
            box("spacer", 0.06 * s - t / 2 + self.e, 1.2 * s, 0.1 * s),
            place((face + 0.03 * s - t / 4, 0, -0.03 * s), Z, X),
        )
        floor = reach - face - 0.06 * s - t / 2 - 0.12 * s
        start = face + 0.06 * s + t / 2
        m.add(
            "floor",
            body,
            body,
            box("bucket_floor", floor, 2 * half, t),
            place((start + floor / 2, 0, -depth + t / 2), Z, X),
        )
        m.add(
            "edge",
            "cutting_edge",
            body,
            box("bucket_edge", 0.12 * s, 2 * half, 0.7 * t),
            place((reach - 0.06 * s, 0, -depth + 0.35 * t), Z, X),
        )
        cheek = around(
            (start, -depth + t, 0), (start, high, 0), (start + 0.1 * s, high, 0), (reach - 0.14 * s, -depth + t, 0)
        )
        for side in (1, -1):
            m.add("cheek", body, body, plate("cheek", cheek, t), place((0, side * (half - t / 2), 0), XZ, X))
        m.pose = np.eye(4)

    def lift_cylinders(self) -> None:
        def at(p: Array, y: float) -> Array:
            return np.array([p[0], y, p[1]])

        rod_pin = self.carried("B") + turned(self.turn + self.tip, self.j)
        for side, letter in ((1, "l"), (-1, "r")):
            y = side * self.y_cyl
            names = (f"boom_cylinder_barrel_{letter}", f"boom_piston_rod_{letter}")
            self.cylinder(f"lift {letter}", *names, at(self.low["C"], y), at(self.carried("D"), y), Y, 0.036 * self.s)
        for side, letter in ((0, ""),) if self.single_tilt else ((1, "_l"), (-1, "_r")):
            y = side * self.y_cyl
            names = (f"bucket_cylinder_barrel{letter}", f"bucket_piston_rod{letter}")
            self.cylinder(f"tilt{letter}", *names, at(self.carried("E"), y), at(rod_pin, y), Y, 0.03 * self.s)


def skid_steer(
    seed: int, path: str | None = None, *, single_tilt: bool | None = None, embedded: bool = False
) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's."""
    rng = np.random.default_rng([seed, 41])
    path = path or ("vertical", "radial")[int(rng.random() < 0.5)]
    single = bool(rng.random() < 0.3) if single_tilt is None else single_tilt
    return SkidSteer(seed, path, single_tilt=single, embedded=embedded).draw()
