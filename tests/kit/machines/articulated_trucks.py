"""Parametric articulated dump trucks straight as `Assembly` objects, with the truth: a bogie of beams, or axles fast on
the rear frame; the hitch's ring about a tube of its own, or about one that is one piece with the rear frame's head.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are. The
steering stands at an angle, the body is raised.
"""

from __future__ import annotations

import math

import numpy as np

from kit.machines.crawler import merged
from kit.machines.solids import Array, around, box, place, plate, tube
from kit.machines.synthetic import XZ, Drawer, Machine, X, Y, Z, turn_z

PLACES = {"H": (-4.85, 1.52), "C": (-1.75, 1.0), "D": (-3.62, 1.86)}
"""Body's hinge, hoist cylinder on the frame and on the lowered body, in a machine of size 1."""
STEERING = ((1.05, 0.44), (-0.17, 0.37))
"""Barrel's pin on the tractor, rod's on the hitch, from above."""
SIDES = ((1, "l"), (-1, "r"))


class ArticulatedTruck(Drawer):
    """One machine from one generator of random numbers."""

    def __init__(self, seed: int, *, beams: bool, race: bool, embedded: bool) -> None:
        self.beams, self.race = beams, race
        super().__init__(seed, twin=True, steered=True, embedded=embedded, stop=False, hoses=0)
        u, s = self.rng.uniform, self.s
        self.m.title = "DUMPER"
        self.t, self.pin_r, self.eye_w = 0.04 * s, 0.05 * s * u(0.9, 1.15), 0.12 * s
        self.front_x, self.spacing = 1.05 * s * u(0.95, 1.08), 1.95 * s * u(0.98, 1.08)
        self.bogie_x, self.tyre_r = -3.1 * s * u(0.98, 1.03), 0.9 * s * u(0.95, 1.03)
        self.tread, self.tyre_w = 2.62 * s * u(0.98, 1.05), 0.68 * s * u(0.9, 1.04)
        self.steer, self.raised = float(u(-0.3, 0.3)), float(u(0.05, 0.7))
        self.P["G"] = np.array([self.bogie_x, self.tyre_r])
        self.low, self.high, self.z_steer = 1.1 * s, 1.42 * s, 1.25 * s
        self.y_rail, self.y_front, self.y_hoist, self.y_beam = 0.44 * s, 0.57 * s, 0.63 * s, 0.84 * s

    def link_pins(self) -> None:
        u = self.rng.uniform
        self.P = {k: self.s * np.array(v) * u(0.98, 1.02, 2) for k, v in PLACES.items()}
        self.SP = [self.s * np.array([*v, 1.25]) * u(0.98, 1.02, 3) for v in STEERING]  # type: ignore[assignment]

    def draw(self) -> Machine:
        self.SP = [np.array([*p[:2], self.z_steer]) for p in self.SP]  # type: ignore[assignment]
        hinge = np.array([self.P["H"][0], 0.0, self.P["H"][1]])
        self.rear = turn_z(self.steer)
        self.body = self.rear @ self.raising(hinge)
        self.tractor()
        self.m.pose = self.rear
        self.hitch()
        self.rear_frame()
        self.bogie()
        self.m.pose = self.body
        self.dump_body()
        self.m.pose = np.eye(4)
        self.cylinders()
        return self.m

    def raising(self, hinge: Array) -> Array:
        """(4, 4) that raises the lowered body."""
        c, n = math.cos(self.raised), math.sin(self.raised)
        up = np.eye(4)
        up[[0, 0, 2, 2], [0, 2, 0, 2]] = c, -n, n, c
        up[:3, 3] = hinge - up[:3, :3] @ hinge
        return up

    # ---- the tractor ----
    def tractor(self) -> None:
        s, t, e, body, y = self.s, self.t, self.e, "front_frame", self.y_front
        x0, x1, inner = 0.43 * s, 3.9 * s, y - t / 2
        low, high = 1.0 * s, 1.5 * s
        for side, letter in SIDES:
            rail = np.array([[x0, low], [x1, low], [x1, high], [x0, high]])
            self.side_plate("front rail", body, side * y, rail, "")
            p = self.SP[0] * np.array([1, side, 1])
            lug = around((p[0], p[1], 1.7 * self.pin_r), (p[0] - 0.02 * s, side * (inner + e), 0),
                         (p[0] + 0.16 * s, side * (inner + e), 0))  # fmt: skip
            self.upright_lugs("steering lug", body, p, lug)
            self.upright(f"steering_cylinder_barrel_{letter}_pin", body, p, self.eye_w / 2 + self.gap + 0.6 * t)
            self.block("fuel tank", body, *beside(side, (2.0, 2.9), (y + t / 2) / s, 0.86, (0.9, 1.4)))
            self.block("engine mount", body, *beside(side, (2.5, 2.7), 0.42, inner / s, (1.25, 1.35)))
            self.stub(f"front_wheel_{letter}", body, side, self.front_x, 0.66 * s, 1.2)
        half = (inner + e) / s
        self.block("bulkhead low", body, (0.43, -half, 0.86), (0.47, half, 1.12))
        self.block("bulkhead high", body, (0.43, -half, 1.38), (0.47, half, 1.64))
        self.block("front cross", body, (3.8, -half, 1.05), (3.85, half, 1.45))
        a, top = self.front_x / s, low / s
        self.block("axle housing", body, (a - 0.2, -0.66, self.tyre_r / s - 0.14), (a + 0.2, 0.66, top))
        self.block("engine", body, (2.3, -0.42, 1.1), (3.7, 0.42, 1.8))
        self.block("deck", body, (0.5, -0.84, 1.5), (3.9, 0.84, 1.54))
        roof = float(self.rng.uniform(3.3, 3.7))
        self.block("cab", body, (0.7, -0.8, 1.54), (2.2, 0.8, roof))
        self.block("hood", body, (2.25, -0.7, 1.54), (3.95, 0.7, 2.5))
        self.block("bumper", body, (3.9, -1.2, 1.05), (4.05, 1.2, 1.5))
        self.forks(body, x0, half)

    def forks(self, body: str, x0: float, half: float) -> None:
        """Two plates about each of the hitch's, with a pin."""
        s, t = self.s, self.t
        self.art_r = 1.2 * self.pin_r
        self.z_plates = (1.0 * s, 1.5 * s)
        shape = plate("fork", around((0, 0, 2 * self.art_r), (x0 + self.e, 0.3 * s, 0), (x0 + self.e, -0.3 * s, 0)), t,
                      [(0, 0, self.art_r)])  # fmt: skip
        for z in self.z_plates:
            for d in (1, -1):
                self.m.add("fork", body, body, shape, place((0, 0, z + d * (1.25 * t + self.gap)), Z, X))
            h = 1.8 * t + self.gap
            self.pin("articulation_pin", body, np.array([0, 0, z - h]), np.array([0, 0, z + h]), radius=self.art_r)

    # ---- hitch and rear frame ----
    def hitch(self) -> None:
        s, t, e, m, body = self.s, self.t, self.e, self.m, "hitch"
        wall, hole = -0.34 * s, self.art_r * (1.2 if self.bushes else 1.0)
        outline = around((0, 0, 2 * self.art_r), (wall - e, 0.28 * s, 0), (wall - e, -0.28 * s, 0))
        for z in self.z_plates:
            shape = plate("hitch_plate", outline, 1.5 * t, [(0, 0, hole)])
            m.add("hitch plate", body, body, shape, place((0, 0, z), Z, X))
            if self.bushes:
                m.add("bush", body, body, tube("hitch_bush", hole, self.art_r, 1.5 * t), place((0, 0, z - 0.75 * t), Z))
        self.block("hitch wall", body, (-0.34 - 0.05, -0.45, 0.9), (-0.34, 0.45, 1.6))
        self.roll_r = s * float(self.rng.uniform(0.28, 0.31) if self.race else self.rng.uniform(0.17, 0.21))
        ring = tube("hitch_ring", 1.35 * self.roll_r, self.roll_r + self.clearance, 0.32 * s)
        self.roll_z = 1.25 * s
        m.add("hitch ring", body, body, ring, place((-0.39 * s + e, 0, self.roll_z), -X))
        for side, letter in SIDES:
            q = self.SP[1] * np.array([1, side, 1])
            lug = around((q[0], q[1], 1.7 * self.pin_r), (wall - e, q[1] + 0.06 * s, 0), (wall - e, q[1] - 0.1 * s, 0))
            self.upright_lugs("hitch lug", body, q, lug)
            self.upright(f"steering_piston_rod_{letter}_pin", body, q, self.eye_w / 2 + self.gap + 0.6 * t)

    def rear_frame(self) -> None:
        s, t, e, m, body, y = self.s, self.t, self.e, self.m, "rear_frame", self.y_rail
        low, high, (hx, hz) = self.low, self.high, self.P["H"]
        wide, half, inner = 2.2 * self.pin_r, (y + t / 2) / s, (y - t / 2 + e) / s
        head = box("head", 0.05 * s, 2 * half * s, 0.7 * s)
        bar = tube("roll_tube", self.roll_r, 0.8 * self.roll_r, 0.47 * s)
        at = (place((-0.925 * s, 0, self.roll_z), Z, X), place((-0.9 * s, 0, self.roll_z), X))
        if self.race:
            m.add("head", body, body, head, at[0])
            m.add("roll tube", body, body, bar, at[1])
        else:
            m.add("head", body, body, merged("frame_head", (head, at[0]), (bar, at[1])), np.eye(4))
        rail = around((-0.95 * s + e, low, 0), (-0.95 * s + e, high, 0), (hx, hz, wide), (hx, low, 0))
        for side, _ in SIDES:
            self.side_plate("rear rail", body, side * y, rail, "H")
            self.across("dump_body_pin", body, self.P["H"], side, y - 2.6 * t - self.gap, y + 2.6 * t + self.gap)
        self.hoist_brackets(body)
        for x in (-1.3, -2.4, hx / s + 0.2):
            self.block("cross member", body, (x, -inner, 1.15), (x + 0.05, inner, 1.38))

    def hoist_brackets(self, body: str) -> None:
        """Ears of the hoist cylinders beside the rails, with their pins."""
        s, t, e, (cx, cz), wide = self.s, self.t, self.e, self.P["C"], 2.2 * self.pin_r
        half = (self.y_rail + t / 2) / s
        for side, letter in SIDES:
            self.block("hoist bracket", body, *beside(side, (cx / s + 0.17, cx / s + 0.22), half, 0.8, (0.88, 1.3)))
            x = cx + 0.17 * s + e
            ear = around((cx, cz, wide), (x, 0.9 * s, 0), (x, 1.15 * s, 0))
            d = self.eye_w / 2 + self.gap + t / 2
            for yy in (self.y_hoist - d, self.y_hoist + d):
                self.side_plate("hoist ear", body, side * yy, ear, "C")
            role = f"hoist_cylinder_barrel_{letter}_pin"
            self.across(role, body, self.P["C"], side, self.y_hoist - d - t, self.y_hoist + d + t)

    def bogie(self) -> None:
        s, t, e, y, r = self.s, self.t, self.e, self.y_rail, 1.5 * self.pin_r
        ends = {"middle": self.bogie_x + self.spacing / 2, "rear": self.bogie_x - self.spacing / 2}
        for x in ends.values():
            a, wide, low = x / s, 0.45 if self.beams else 0.66, self.tyre_r / s - 0.15
            self.block("axle case", "rear_frame", (a - 0.2, -wide, low), (a + 0.2, wide, 1.1))
        gx, gz = self.P["G"]
        for side, letter in SIDES:
            if not self.beams:
                for end, x in ends.items():
                    self.stub(f"{end}_wheel_{letter}", "rear_frame", side, x, 0.66 * s, 1.2)
                continue
            hanger = around((gx, gz, 2 * r), (gx + 0.35 * s, 1.35 * s, 0), (gx - 0.35 * s, 1.35 * s, 0))
            y_hanger, body, hole = y + t - e, f"bogie_beam_{letter}", [(float(gx), float(gz), r + self.clearance)]
            self.side_plate("bogie hanger", "rear_frame", side * y_hanger, hanger, "", [(float(gx), float(gz), r)])
            beam = around(*((x, gz, 0.16 * s) for x in ends.values()), (gx, gz + 0.04 * s, 0.2 * s))
            shapes = [(plate("beam", beam, 2 * t, hole), place((0, side * self.y_beam, 0), XZ, X))]
            reach, face = self.tread / 2 - 0.25 * s, self.y_beam + t
            spindle = tube("beam_spindle", 0.1 * s, 0.0, reach - face)
            shapes += [(spindle, place((x, side * face, gz), side * Y)) for x in ends.values()]
            self.m.add("beam", body, body, merged(body, *shapes), np.eye(4))
            start, end_y = sorted((side * (y - t), side * (self.y_beam + 1.2 * t)))
            self.pin(f"{body}_pin", "rear_frame", np.array([gx, start, gz]), np.array([gx, end_y, gz]), radius=r)
            for end, x in ends.items():
                centre = np.array([x, side * self.tread / 2, self.tyre_r])
                self.wheel(f"{end}_wheel_{letter}", body, side, centre, reach)

    # ---- the body ----
    def dump_body(self) -> None:
        s, t, e, body, y = self.s, self.t, self.e, "dump_body", self.y_rail
        (hx, hz), (dx, dz), wide = self.P["H"], self.P["D"], 2.2 * self.pin_r
        floor, top = 2.0 * s, float(self.rng.uniform(2.9, 3.3))
        half = 1.5 * float(self.rng.uniform(0.97, 1.05))
        tail = -5.8 * float(self.rng.uniform(0.98, 1.02))
        self.block("floor", body, (tail, -half, 2.0), (-0.45, half, 2.0 + t / s))
        self.block("headboard", body, (-0.5, -half, 2.0 + t / s), (-0.45, half, top + 0.25))
        d = self.eye_w / 2 + self.gap + t / 2
        for side, letter in SIDES:
            self.block("side", body, *beside(side, (tail, -0.45), half, half + 0.03, (2.0, top)))
            self.block("sill", body, *beside(side, (-4.2, -0.7), y / s - 0.04, y / s + 0.04, (1.7, 2.0)))
            ear = around((hx, hz, wide), (hx + 0.35 * s, floor + e, 0), (hx - 0.25 * s, floor + e, 0))
            for yy in (y - t - self.gap, y + t + self.gap):
                self.side_plate("hinge ear", body, side * yy, ear, "H")
            lug = around((dx, dz, 1.7 * self.pin_r), (dx + 0.15 * s, floor + e, 0), (dx - 0.15 * s, floor + e, 0))
            for yy in (self.y_hoist - d, self.y_hoist + d):
                self.side_plate("hoist lug", body, side * yy, lug, "D")
            role = f"hoist_piston_rod_{letter}_pin"
            self.across(role, body, self.P["D"], side, self.y_hoist - d - t, self.y_hoist + d + t)
            for k in range(4):
                x = -0.9 - 1.1 * k
                self.block("rib", body, *beside(side, (x - 0.08, x), half + 0.03, half + 0.08, (2.05, top - 0.1)))

    # ---- pieces ----
    def upright(self, role: str, body: str, at: Array, half: float) -> None:
        """An upright pin about a point."""
        self.pin(role, body, at - half * Z, at + half * Z)

    def upright_lugs(self, name: str, body: str, at: Array, outline: Array) -> None:
        """Two level plates about a cylinder's eye."""
        key = f"{name}_{at[1] > 0}"
        shape = plate(key, outline, self.t / 2, [(float(at[0]), float(at[1]), self.bore_r)])
        for d in (1, -1):
            z = at[2] + d * (self.eye_w / 2 + self.gap + self.t / 4)
            self.m.add(name, body, body, shape, place((0, 0, z), Z, X))

    def cylinders(self) -> None:
        def moved(pose: Array, p: Array) -> Array:
            return np.asarray((pose @ np.append(p, 1.0))[:3])

        for side, letter in SIDES:
            p, q = (at * np.array([1, side, 1]) for at in self.SP)
            names = (f"steering_cylinder_barrel_{letter}", f"steering_piston_rod_{letter}")
            self.cylinder(f"steer {letter}", *names, p, moved(self.rear, q), Z, 0.045 * self.s)
            c, d = (self.at(k, side * self.y_hoist) for k in "CD")
            names = (f"hoist_cylinder_barrel_{letter}", f"hoist_piston_rod_{letter}")
            across = self.rear[:3, 1]
            self.cylinder(f"hoist {letter}", *names, moved(self.rear, c), moved(self.body, d), across, 0.075 * self.s)


def beside(
    side: int, x: tuple[float, float], inner: float, outer: float, z: tuple[float, float]
) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Low and high corner of a block on a side."""
    low, high = sorted((side * inner, side * outer))
    return (x[0], low, z[0]), (x[1], high, z[1])


def articulated_truck(
    seed: int, *, beams: bool | None = None, race: bool | None = None, embedded: bool = False
) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's."""
    rng = np.random.default_rng([seed, 43])
    drawn = rng.random(2)
    beams = bool(drawn[0] < 0.7) if beams is None else beams
    race = bool(drawn[1] < 0.5) if race is None else race
    return ArticulatedTruck(seed, beams=beams, race=race, embedded=embedded).draw()
