"""What a drawn grader's blade hangs on: saddle, drawbar, circle, carrier and moldboard, with the cylinders on balls
that move them. Lengths are in machine sizes, but those that pieces are made of.

The drawbar and what it carries are told as they stand straight and level with the edge on the ground.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from kit.machines import solids
from kit.machines.crawler import merged
from kit.machines.dozers import raised, sphere_arc, yawed
from kit.machines.solids import Array, around, box, lathe, place, plate, tube
from kit.machines.steered_chassis import SIDES, SteeredChassis
from kit.machines.synthetic import XZ, X, Y, Z, turn_about_x
from yellowiron.model.geometry import Shape, SphereFeature

WAYS = {"x": (X, X, Y), "y": (Y, XZ, X), "z": (Z, Z, X)}
"""Of a plate: the line it is square to, its normal, its own x."""
TUBE = 0.065
"""A lift cylinder's outer radius."""


def balled(shape: Shape, at: float, radius: float, *, concave: bool) -> Shape:
    """The shape with a ball, or what holds one, so high on its axis."""
    if concave and not solids.HOLLOW:
        return shape
    sphere = SphereFeature((0.0, 0.0, at), radius, concave, 2.6 * math.pi * radius**2)
    return replace(shape, spheres=(*shape.spheres, sphere))


class GraderBlade(SteeredChassis):
    """One machine from one generator of random numbers."""

    nose: Array
    circle_x: float
    saddle_z: float
    gimbals: bool
    beamed: bool

    # ---- pieces ----
    def spot(self, x: float, y: float, z: float) -> Array:
        return self.s * np.array([x, y, z])

    def world(self, x: float, y: float, z: float) -> Array:
        """Where a point of what is drawn now is."""
        return np.asarray((self.m.pose @ np.append(self.spot(x, y, z), 1.0))[:3])

    def turned(self, way: Array) -> Array:
        """A direction of what is drawn now."""
        return np.asarray(self.m.pose[:3, :3] @ way)

    @property
    def lug(self) -> float:
        return self.lug_y / self.s

    def slab(
        self, name: str, body: str, way: str, at: float, circles: list[tuple[float, ...]], *holes: tuple[float, ...],
        thick: float = 0.0, role: str = "",
    ) -> None:  # fmt: skip
        """A plate square to x, y or z, `at` its middle; its outline is around circles (two coordinates, radius or 0),
        its holes are (two coordinates, radius or that of a pin)."""
        shape, matrix = self.slabbed(name, way, at, circles, *holes, thick=thick)
        self.m.add(name, role or body, body, shape, matrix)

    def slabbed(
        self, name: str, way: str, at: float, circles: list[tuple[float, ...]], *holes: tuple[float, ...],
        thick: float = 0.0,
    ) -> tuple[Shape, Array]:  # fmt: skip
        s, (line, normal, own) = self.s, WAYS[way]
        outline = around(*((s * c[0], s * c[1], s * (c[2] if len(c) > 2 else 0.0)) for c in circles))
        bores = [(s * h[0], s * h[1], s * h[2] if len(h) > 2 else self.bore_r) for h in holes]
        return plate(name, outline, s * thick or self.t, bores), place(s * at * line, normal, own)

    def ears(
        self, name: str, body: str, way: str, at: float, eye: tuple[float, float], *feet: tuple[float, float]
    ) -> None:
        """Two plates beside a cylinder's eye."""
        for d in (1, -1):
            circles: list[tuple[float, ...]] = [(*eye, 1.6 * self.pin_r / self.s), *feet]
            self.slab(name, body, way, at + d * self.lug, circles, eye)

    def pinned(self, role: str, body: str, way: str, eye: tuple[float, float], low: float, high: float) -> None:
        """A pin along x, y or z through (the two other coordinates), from one place to another."""
        before = "xyz".index(way)
        ends = [self.s * np.insert(np.array(eye), before, end) for end in (low, high)]
        self.pin(role, body, *ends)

    def eared(self, role: str, body: str, way: str, at: float, eye: tuple[float, float]) -> None:
        """The pin of two ears."""
        half = self.lug + 0.6 * self.t / self.s
        self.pinned(role, body, way, eye, at - half, at + half)

    def stud(self, role: str, body: str, ball: Array, way: Array, radius: float, long: float) -> None:
        """A ball at a point, and a shank so long against a direction."""
        neck = 0.45 * radius
        arc = [(r, long + z) for r, z in sphere_arc(radius, math.asin(neck / radius), math.pi)]
        shape = lathe(f"stud_{radius:.3f}_{long:.3f}", [(0.0, 0.0), (neck, 0.0), *arc])
        self.m.add("stud", role, body, balled(shape, long, radius, concave=False), place(ball - long * way, way))

    def ring(self, radius: float, outer: float, half: float) -> Shape:
        """A ring with a hollow for a ball, about z."""
        r = radius + self.clearance
        start = math.acos(half / r)
        arc = [*reversed(sphere_arc(r, start, math.pi - start))]
        shape = lathe(f"ring_{r:.4f}_{outer:.3f}", [(outer, -half), (outer, half), *arc])
        return balled(shape, 0.0, r, concave=True)

    def ball_eye(self, name: str, radius: float, neck: float) -> tuple[Shape, float]:
        """What holds a ball, about z, with a foot towards x; how far from the ball's middle that ends."""
        outer, half = 1.55 * radius, 0.6 * radius
        end = outer + 0.4 * neck
        foot = box(f"{name}_foot", 0.7 * neck, 1.2 * neck, 1.4 * half)
        eye = merged(f"{name}_eye", (self.ring(radius, outer, half), np.eye(4)),
                     (foot, place((end - 0.35 * neck, 0, 0), Z, X)))  # fmt: skip
        return replace(eye, spheres=self.ring(radius, outer, half).spheres), end

    def ram(
        self, name: str, halves: tuple[str, str], ends: tuple[Array, Array], axes: tuple[Array, Array], bore: float, *,
        balls: tuple[float, float] = (0.0, 0.0), collar: float = 0.0, above: float = 0.0,
    ) -> None:  # fmt: skip
        """A cylinder between two points, its eyes about an axis each: about pins, or about `balls` of such radii; or in
        a `collar` about its barrel, of which so much is `above` that (metres)."""
        m, (P, Q), rng = self.m, ends, self.rng.uniform
        kept, m.pose = m.pose, np.eye(4)
        long = float(np.linalg.norm(Q - P))
        d = (Q - P) / long
        rod_r, outer, cap = 0.55 * bore, 1.2 * bore, 0.3 * bore
        eyes = []
        for k, (axis, radius) in enumerate(zip(axes, balls, strict=True)):
            if radius:
                square = axis - d * (axis @ d)
                shape, reach = self.ball_eye(f"{name}_{k}", radius, 2 * (outer, rod_r)[k])
                eyes.append((shape, square, reach))
            else:
                round_r, reach = 1.8 * self.pin_r, 2.2 * self.pin_r
                flat = around((0, 0, round_r), (reach, 0.8 * round_r, 0), (reach, -0.8 * round_r, 0))
                eyes.append((plate(f"{name}_eye", flat, self.eye_w, [(0, 0, self.bore_r)]), axis, reach))
        first = -above if collar else eyes[0][2]
        last = eyes[1][2]
        mouth = 0.16 * self.s if collar else first + (long - first - last) * float(rng(0.52, 0.72))
        side = [(outer, 0.0)]
        if collar:
            start = math.asin(outer / collar)
            side += [(r, above + z) for r, z in sphere_arc(collar, start, math.pi - start)]
        n = mouth - first
        can = lathe(f"{name}_can", [(0, 0), *side, (outer, n), (bore, n), (bore, cap), (0, cap)])
        can = balled(can, above, collar, concave=False) if collar else can
        m.add(f"{name} barrel", halves[0], halves[0], can, place(P + d * first, d))
        if not collar:
            m.add(f"{name} rear eye", halves[0], halves[0], eyes[0][0], place(P, eyes[0][1], d))
        gland = lathe(f"{name}_gland", [(rod_r, -bore), (bore, -bore), (bore, 0), (outer, 0), (outer, 0.3 * bore),
                                        (rod_r, 0.3 * bore)])  # fmt: skip
        m.add(f"{name} gland", halves[0], halves[0], gland, place(P + d * mouth, d))
        inside = first + cap + (n - 2.5 * bore - cap) * float(rng(0.3, 0.8))
        bar = tube(f"{name}_rod", rod_r, 0.0, long - last - inside)
        m.add(f"{name} rod", halves[1], halves[1], bar, place(P + d * inside, d))
        m.add(f"{name} rod eye", halves[1], halves[1], eyes[1][0], place(Q, eyes[1][1], -d))
        if rng() < 0.5:
            piston, foot = tube(f"{name}_piston", bore, rod_r, 0.8 * bore), inside
        else:
            piston, foot = tube(f"{name}_piston", bore, 0.0, 0.6 * bore), inside - 0.6 * bore
        m.add(f"{name} piston", halves[1], halves[1], piston, place(P + d * foot, d))
        m.pose = kept

    # ---- what the blade hangs on ----
    def blade_group(self) -> None:
        """Saddle, drawbar and all that they carry."""
        m, (nx, _, nz) = self.m, self.nose
        feet = self.saddle()
        nose = self.spot(nx, 0.0, nz)
        m.pose = yawed(self.aside, nose) @ raised(-self.lifted, nose) @ turn_about_x(nose, self.sloped)
        eyes = self.drawbar()
        drawbar = m.pose
        for letter in "lr":
            halves = (f"blade_lift_cylinder_barrel_{letter}", f"blade_lift_piston_rod_{letter}")
            (P, above), (Q, below) = feet[letter], eyes[letter]
            if self.gimbals:
                self.ram(f"lift {letter}", halves, (P, Q), (above, below), 0.054 * self.s, balls=(0.1, self.ball_r),
                         collar=0.105 * self.s, above=self.above * self.s)  # fmt: skip
            else:
                self.ram(f"lift {letter}", halves, (P, Q), (above, below), 0.05 * self.s, balls=(self.ball_r,) * 2)
        halves = ("centre_shift_cylinder_barrel", "centre_shift_piston_rod")
        (P, one), (Q, other) = feet["centre"], eyes["centre"]
        self.ram("centre shift", halves, (P, Q), (one, other), 0.045 * self.s, balls=(self.ball_r,) * 2)
        m.pose = drawbar @ yawed(self.turn, self.spot(self.circle_x, 0, 0))
        foot, across = self.circle()
        px, pz = self.pivot
        m.pose = m.pose @ raised(-self.tip, self.spot(px, 0, pz))
        eye = self.blade_carrier()
        halves = ("blade_tip_cylinder_barrel", "blade_tip_piston_rod")
        self.ram("tip", halves, (foot, eye), (across, across), 0.035 * self.s)
        self.moldboard()
        m.pose = np.eye(4)

    def saddle(self) -> dict[str, tuple[Array, Array]]:
        """A plate on its pin over the frame's beam, at its ends what the lift cylinders hang in, an arm for the centre
        shift's; where the cylinders are held, and the lines of what holds them."""
        s, e, m, body, x, z = self.s, self.e / self.s, self.m, "saddle", self.saddle_x, self.saddle_z
        m.pose = turn_about_x(self.spot(0, 0, z), self.hole)
        y, high = self.foot_y, z + 0.06
        inner = y - 0.16
        reach = inner - (0.01 if self.gimbals else 0.12)
        pieces = [self.slabbed("saddle_arms", "x", x, [(0, z, 0.085), (reach, high, 0.06), (-reach, high, 0.06)],
                               (0, z), thick=0.12)]  # fmt: skip
        found, way, shank = {}, self.turned(Z), 0.45 * self.ball_r / s
        for side, letter in SIDES:
            at = self.spot(x, side * y, high)
            role = f"blade_lift_cylinder_barrel_{letter}_pin"
            if self.gimbals:
                pieces.append((self.ring(0.105 * s, 0.16 * s, 0.06 * s), place(at, Z)))
            else:
                corners: list[tuple[float, ...]] = [(x + a, high + b) for a in (0.06, -0.06) for b in (0.06, -0.06)]
                pieces.append(self.slabbed("pad", "y", side * inner, corners, (x, high, shank), thick=0.12))
                self.stud(role, body, at, side * Y, self.ball_r, (y - inner + 0.06) * s)
            found[letter] = (self.world(x, side * y, high), way if self.gimbals else self.turned(Y))
        casting = merged("saddle_casting", *pieces)
        if self.gimbals and solids.HOLLOW:
            spheres = tuple(
                SphereFeature((x * s, side * y * s, high * s), 0.105 * s + self.clearance, True, 0.06 * s * s)
                for side, _ in SIDES
            )
            casting = replace(casting, spheres=spheres)
        m.add("saddle casting", body, body, casting, np.eye(4))
        ahead = self.centre_x - 0.1
        low, high_x = x + 0.06 - e, ahead - 0.5 * self.t / s + e
        self.block("arm spacer", body, (low, -0.38, z - 0.02), (high_x, -0.26, z + 0.08))
        cy, cz = self.centre_foot
        self.slab("centre shift arm", body, "x", ahead, [(-0.3, z + 0.03, 0.05), (cy, cz, 0.05)], (cy, cz, shank))
        self.stud("centre_shift_cylinder_barrel_pin", body, self.spot(self.centre_x, cy, cz), X, self.ball_r,
                  0.1 * s + 0.5 * self.t)  # fmt: skip
        found["centre"] = (self.world(self.centre_x, cy, cz), self.turned(X))
        m.pose = np.eye(4)
        return found

    def drawbar(self) -> dict[str, tuple[Array, Array]]:
        """Nose, arms, the table over the circle, what guides that, the cylinders' studs; these' balls and lines."""
        s, e, m, body, c = self.s, self.e / self.s, self.m, "drawbar", self.circle_x
        (nx, _, nz), radius = self.nose, 0.07 * s
        outer, mouth = 0.11 * s, -0.035 * s
        arc = sphere_arc(radius + self.clearance, math.acos(-mouth / (radius + self.clearance)), math.pi)
        socket = lathe("nose", [*reversed(arc), arc[0], (outer, mouth), (outer, 0.12 * s), (0.0, 0.12 * s)])
        socket = balled(socket, 0.0, radius + self.clearance, concave=True)
        m.add("nose", body, body, socket, place(self.spot(*self.nose), -X))
        top, low, tail = self.table_z, self.table_z - 0.055, nx - 0.12
        self.block("nose block", body, (tail - 0.16, -0.13, nz - 0.1), (tail + e, 0.13, nz + 0.1))
        front, half = c + 0.72, 0.58
        if self.beamed:
            self.slab("drawbar beam", body, "y", 0.0, [(tail - 0.16 + e, top), (tail - 0.16 + e, nz + 0.09),
                      (front - 0.25, top), (front - 0.25, top + 0.08)], thick=0.22)  # fmt: skip
        else:
            for side, _ in SIDES:
                self.slab("drawbar arm", body, "z", top + 0.05, [
                    (tail - 0.16 + e, side * 0.02), (tail - 0.16 + e, side * 0.12), (front - 0.09, side * 0.5),
                    (front - 0.09, side * 0.36)], thick=0.1)  # fmt: skip
        inner = self.ring_r - 0.13
        self.slab("table", body, "z", 0.5 * (top + low), [(c - 0.62, half), (c - 0.62, -half), (front, half),
                  (front, -half)], (c, 0.0, 0.3), thick=top - low)  # fmt: skip
        under = low - 0.125
        guide = tube("guide", inner * s - self.clearance, (inner - 0.07) * s, (low - under) * s)
        m.add("guide", "circle_bearing", body, guide, place(self.spot(c, 0, under), Z))
        m.add("retainer", body, body, tube("retainer", (inner + 0.015) * s, (inner - 0.07) * s, 0.02 * s),
              place(self.spot(c, 0, under - 0.02), Z))  # fmt: skip
        motor = tube("circle_motor", 0.09 * s, 0.0, 0.2 * s)
        m.add("circle motor", body, body, motor, place(self.spot(c - 0.5, 0.3, top), Z))
        found, r, z, x = {}, self.ball_r, top + 0.075, c + self.lift_x
        shank = 0.45 * r / s
        for side, letter in SIDES:
            corners: list[tuple[float, ...]] = [(x + d, up) for d in (0.06, -0.06) for up in (top - e, top + 0.14)]
            self.slab("lift bracket", body, "y", side * (half - 0.04), corners, (x, z, shank), thick=0.12)
            y = half + 0.02 + 0.14
            self.stud(f"blade_lift_piston_rod_{letter}_pin", body, self.spot(x, side * y, z), side * Y, r, 0.26 * s)
            found[letter] = (self.world(x, side * y, z), self.turned(Y))
        at, (y, up) = self.centre_x - 0.1, (0.45, top + 0.13)
        self.slab("centre shift lug", body, "x", at, [(y, up, 0.05), (y - 0.1, top - e), (y + 0.1, top - e)],
                  (y, up, shank))  # fmt: skip
        self.stud("centre_shift_piston_rod_pin", body, self.spot(self.centre_x, y, up), X, r, 0.1 * s + 0.5 * self.t)
        found["centre"] = (self.world(self.centre_x, y, up), self.turned(X))
        return found

    def circle(self) -> tuple[Array, Array]:
        """The ring, two arms down to the carrier, the tip cylinder's lugs; its foot, and the line of that."""
        s, e, m, body, c = self.s, self.e / self.s, self.m, "circle", self.circle_x
        low, t = self.table_z - 0.165, self.t / s
        (px, pz), eye = self.pivot, (c - 0.9 * self.ring_r - 0.06, self.table_z - 0.28)
        m.add("ring", body, body, tube("circle_ring", self.ring_r * s, (self.ring_r - 0.13) * s, 0.08 * s),
              place(self.spot(c, 0, low), Z))  # fmt: skip
        y, back = self.arm_y, c - math.sqrt((self.ring_r - 0.03) ** 2 - self.arm_y**2)
        for side, _ in SIDES:
            feet = ((back - 0.03, low + e), (back + 0.05, low + e))
            self.slab("circle arm", body, "y", side * y, [(px, pz, 0.075), *feet], (px, pz))
            ends = sorted((side * (y - 1.6 * t - self.gap / s), side * (y + 0.6 * t)))
            self.pinned("blade_carrier_pin", body, "y", (px, pz), *ends)
        self.ears("tip lug", body, "y", 0.0, eye, (eye[0] - 0.05, low + e), (eye[0] + 0.05, low + e))
        self.eared("blade_tip_cylinder_barrel_pin", body, "y", 0.0, eye)
        return self.world(eye[0], 0, eye[1]), self.turned(Y)

    def blade_carrier(self) -> Array:
        """Two cheeks with the shoes of the moldboard's rails, a tube with the tip rod's lugs, the side shift's barrel;
        the rod's eye."""
        s, e, m, body, (px, pz), t = self.s, self.e / self.s, self.m, "blade_carrier", self.pivot, self.t / self.s
        y, (bx, bz), slack = self.arm_y - t - self.gap / s, (px + 0.08, pz + 0.12), self.slack
        for side, _ in SIDES:
            x, (low, high) = self.back - 0.0125 - slack, self.rail_z
            outline: list[tuple[float, ...]] = [(px, pz, 0.075), (x, low - 0.07), (x, high + 0.07)]
            self.slab("cheek", body, "y", side * y, outline, (px, pz), (bx, bz, 0.055))
            for z in self.rail_z:
                for d in (1, -1):
                    a, b = sorted((z + d * (0.03 + slack), z + d * 0.065))
                    self.block("shoe", body, (x, side * y - t / 2, a), (x + 0.02, side * y + t / 2, b))
        inner = y - t / 2
        self.block("carrier tube", body, (px - 0.04, -inner, pz - 0.04), (px + 0.03, inner, pz + 0.04))
        eye = (px - 0.07, pz + 0.27)
        self.ears("tip rod lug", body, "y", 0.0, eye, (px - 0.04, pz + 0.04 - e), (px + 0.01, pz + 0.04 - e))
        self.eared("blade_tip_piston_rod_pin", body, "y", 0.0, eye)
        start, end = -0.7, 0.56
        flange = -y + t / 2 + 0.025 - start
        n, r = end - start, 0.045
        corners = [(0.0, 0.0), (r, 0.0), (r, flange - 0.025), (0.085, flange - 0.025), (0.085, flange), (r, flange),
                   (r, n), (0.022, n), (0.022, n - 0.04), (0.035, n - 0.04), (0.035, 0.03), (0.0, 0.03)]  # fmt: skip
        can = lathe("shift_can", [(a * s, b * s) for a, b in corners])
        m.add("shift barrel", "side_shift_cylinder_barrel", body, can, place(self.spot(bx, start, bz), Y))
        return self.world(eye[0], 0, eye[1])

    def moldboard(self) -> None:
        """A face of four plates, rails on gussets behind it, edge and end bits, and what its cylinder pushes."""
        s, e, body, half, tall, m = self.s, self.e / self.s, "moldboard", self.half_blade, self.tall, self.m
        (px, pz), back, shifted = self.pivot, self.back, self.shifted
        m.pose = m.pose @ place(self.spot(0, shifted, 0), Z, X)
        face = [(back + x, z) for x, z in ((0.2, 0.13), (0.11, 0.36 * tall), (0.08, 0.58 * tall), (0.11, 0.8 * tall),
                                           (0.2, tall))]  # fmt: skip
        behind = [(x - 0.03, z) for x, z in face]

        def across(name: str, corners: list[tuple[float, ...]], low: float, high: float, role: str = "") -> None:
            self.slab(name, body, "y", 0.5 * (low + high), corners, thick=high - low, role=role)

        side = half - 0.025
        for k in range(4):
            across("moldboard", [face[k], face[k + 1], behind[k + 1], behind[k]], -side, side)
        rails = [(back, z) for z in self.rail_z]
        for x, z in rails:
            self.block("rail", body, (x - 0.0125, -side, z - 0.03), (x + 0.0125, side, z + 0.03))
        web: list[tuple[float, ...]] = [behind[1], behind[2], *((x + 0.0125, z) for x, z in rails)]
        ends: list[tuple[float, ...]] = [face[0], face[4], *((*r, 0.05) for r in rails)]
        for sign, letter in SIDES:
            for y in (0.66 * half, 0.93 * half):
                a, b = sorted((sign * y, sign * (y + 0.03)))
                across("gusset", web, a, b)
            a, b = sorted((sign * (side - e), sign * half))
            across("end plate", ends, a, b)
            edge: list[tuple[float, ...]] = [(back + 0.25, 0.0), (back + 0.2, 0.13 + e), (back + 0.17, 0.13 + e),
                                             (back + 0.22, 0.0)]  # fmt: skip
            a, b = sorted((sign * (side - 0.17), sign * side))
            across("end bit", edge, a, b, role=f"end_bit_{letter}")
        across("cutting edge", edge, 0.17 - side, side - 0.17, role="cutting_edge")
        (bx, bz), y = (px + 0.08, pz + 0.12), 0.62 * half
        across("shift lug", [(bx, bz, 0.05), behind[1], behind[2]], y, y + 0.035)
        inside = float(self.rng.uniform(-0.55, -0.2)) - shifted
        shapes = (tube("shift_rod", 0.022 * s, 0.0, (y - inside) * s), tube("shift_piston", 0.035 * s, 0.0, 0.04 * s))
        at = place(self.spot(bx, inside, bz), Y)
        m.add("shift rod", "side_shift_piston_rod", body, merged("shift_rod_piston", *((x, at) for x in shapes)),
              np.eye(4))  # fmt: skip
