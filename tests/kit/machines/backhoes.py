"""Parametric backhoe loaders straight as `Assembly` objects, with the truth: a loader with a Z-bar, or with levers and
cylinders on either side; a dipper that extends or not; hinged stabilizers; a steered front axle.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are.
"""

from __future__ import annotations

import math

import numpy as np

from kit.machines.backhoe_chassis import SIDES, SWING, BackhoeChassis
from kit.machines.crawler import merged
from kit.machines.solids import Array, around, box, place, plate, tube
from kit.machines.synthetic import XZ, Machine, X, Y, Z, polar


class Backhoe(BackhoeChassis):
    """One machine from one generator of random numbers."""

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
        outline = around((*a, wide), (*d, wide), (*b, wide), (*tube_at, 2 * r),
                         (*(a + 1.3 * s * along + 0.12 * s * up), 0.08 * s),
                         *(((*g, wide),) if self.parallel else ()))  # fmt: skip
        pins = "ABDG" if self.parallel else "ABD"
        self.plates("arm", body, self.y_arm, outline, pins)
        half = self.y_arm - t / 2 + self.e
        shape = tube("arm_tube", r, 0.8 * r, 2 * half)
        self.m.add("cross tube", body, body, shape, place((tube_at[0], -half, tube_at[1]), Y))
        for side, letter in SIDES:
            self.across(
                f"loader_lift_piston_rod_{letter}_pin", body, d, side, self.y_lift - self.eye_w / 2, self.y_arm + t
            )
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
        """The lever's two plates beside cylinder and link, and the link; on either side where cylinders are twins."""
        t, wide = self.t, 2.0 * self.pin_r
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
            self.m.add(
                "lever hub",
                "loader_lever",
                "loader_lever",
                hub,
                place((g[0], y - self.eye_w / 2 - self.gap - self.e, g[1]), Y),
            )
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
        m.add(
            "bucket floor",
            body,
            body,
            box("bucket_floor", long, 2 * half, t),
            place((start + long / 2, 0, -depth + t / 2), Z, X),
        )
        edge = box("bucket_edge", 0.14 * s, 2 * half, 0.7 * t)
        m.add("bucket edge", "loader_cutting_edge", body, edge, place((reach - 0.07 * s, 0, 0.35 * t - depth), Z, X))
        cheek = around(
            (start, t - depth, 0), (start, high, 0), (start + 0.12 * s, high, 0), (reach - 0.2 * s, t - depth, 0)
        )
        for side, _ in SIDES:
            m.add("cheek", body, body, plate("shovel_cheek", cheek, t), place((0, side * (half - t / 2), 0), XZ, X))
        flush = back + self.e
        ear = around((0, 0, wide), (flush, -0.12 * s, 0), (flush, 0.14 * s, 0))
        shape = plate("shovel_ear", ear, t, [(0, 0, self.bore_r)])
        for side, _ in SIDES:
            for d in (1, -1):
                m.add("ear", body, body, shape, place((0, side * self.y_arm + d * (t + self.gap), 0), XZ, X))
            self.across(
                "loader_bucket_pin",
                body,
                np.zeros(2),
                side,
                self.y_arm - 2 * t - self.gap,
                self.y_arm + 2 * t + self.gap,
            )
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
        self.plates(
            "boom cylinder lug",
            body,
            self.lug_y,
            around((*c, r), (0.05 * s, low + 0.04 * s - e, 0), (0.12 * s, low + 0.04 * s - e, 0)),
            "c",
        )
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
        a, b = (self.P[k] for k in "ab")
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
        for pin, role, wide in (
            ("d", "boom_piston_rod_pin", self.lug_y),
            ("m", "dipper_cylinder_barrel_pin", self.lug_y),
            ("b", "dipper_pin", y),
        ):
            self.through(role, body, pin, wide + 0.8 * t)

    def dipper(self) -> None:
        s, t, m, r = self.s, self.t, self.m, 2.2 * self.pin_r
        b, k, p, e, g = (self.P[n] for n in "bkpeg")
        along, up = polar(1.0, self.arm_angle), polar(1.0, self.arm_angle + math.pi / 2)
        x = np.array([along[0], 0.0, along[1]])
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
        lug = around(
            (*e, r),
            (*(e - 0.12 * s * along - (0.25 * s - out_h) * up), 0),
            (*(e + 0.1 * s * along - (0.25 * s - out_h) * up), 0),
        )
        self.plates("bucket cylinder lug", body, self.lug_y, lug, "e")
        self.y_link = nose_y + t + self.gap
        for pin, role, wide in (
            ("k", "backhoe_bucket_pin", self.y_link), ("g", "tipping_link_pin", self.y_link),
            ("e", "backhoe_bucket_cylinder_barrel_pin", self.lug_y),
        ):  # fmt: skip
            self.through(f"{pre}{role}", body, pin, wide + t)
        if self.extending:
            self.P["q"], self.P["w"] = b + 0.34 * s * along, k - 0.38 * s * along
            for pin, role, owner, wide in (
                ("q", "extension_cylinder_barrel_pin", "dipper", half),
                ("w", "extension_piston_rod_pin", body, out_y),
            ):
                for side in (1, -1):
                    boss = plate(f"boss_{pin}", around((0, 0, r)), t / 2, [(0, 0, self.bore_r)])
                    at = self.P[pin]
                    y = side * (self.eye_w / 2 + self.gap + t / 4)
                    m.add("boss", owner, owner, boss, place((at[0], y, at[1]), XZ, X))
                    inside = wide - 0.01 * s + self.e
                    spacer = tube(f"spacer_{pin}", 0.9 * r, self.bore_r, inside - abs(y) - t / 4 + self.e)
                    m.add(
                        "spacer",
                        owner,
                        owner,
                        spacer,
                        place((at[0], side * (abs(y) + t / 4 - self.e), at[1]), side * Y),
                    )
                self.through(role, owner, pin, wide - 0.012 * s)

    def on(self, b: Array, along: Array, far: float) -> Array:
        """A point of the dipper's line."""
        p = b + far * along
        return np.array([p[0], 0.0, p[1]])

    def hollow(self, name: str, long: float, half: float, high: float, wall: float) -> object:
        """A box section along its own z, from 0, its width along x; open at both ends."""
        parts = []
        for sign in (1, -1):
            parts.append(
                (box(f"{name}_side", wall, 2 * high, long), place((sign * (half - wall / 2), 0, long / 2), Z, X))
            )
            parts.append(
                (
                    box(f"{name}_top", 2 * (half - wall), wall, long),
                    place((0, sign * (high - wall / 2), long / 2), Z, X),
                )
            )
        return merged(name, *parts)

    def linkage(self) -> None:
        s, t, m, r = self.s, self.t, self.m, 2.0 * self.pin_r
        g, h, j, k = (self.P[n] for n in "ghjk")
        self.plates("tipping link", "tipping_link", self.y_link, around((*g, r), (*h, r)), "gh")
        y = self.lug_y
        self.plates("bucket link", "bucket_link", y, around((*h, r), (*j, r)), "hj")
        half = y - t / 2 + self.e
        middle = 0.5 * (h + j)
        m.add(
            "link web",
            "bucket_link",
            "bucket_link",
            box("link_web", 0.03 * s, 2 * half, 0.03 * s),
            place((middle[0], 0, middle[1]), Z, X),
        )
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
        m.add(
            "hoe floor",
            body,
            body,
            box("hoe_floor", deep, 2 * wide, t),
            place((low + deep / 2, 0, 0.36 * s - t / 2), Z, X),
        )
        cheek = around(
            (low, 0.02 * s, 0), (low + 0.12 * s, 0.02 * s, 0), (low + deep, 0.36 * s - t, 0), (low, 0.36 * s - t, 0)
        )
        for side in (1, -1):
            m.add("hoe cheek", body, body, plate("hoe_cheek", cheek, t), place((0, side * (wide - t / 2), 0), XZ, X))
        edge = box("hoe_edge", 0.12 * s, 2 * wide, 0.8 * t)
        m.add(
            "hoe edge", "backhoe_cutting_edge", body, edge, place((low + deep + 0.06 * s, 0, 0.36 * s - 0.4 * t), Z, X)
        )
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
            self.cylinder(
                f"lift {letter}",
                f"loader_lift_cylinder_barrel_{letter}",
                f"loader_lift_piston_rod_{letter}",
                *ends,
                Y,
                0.036 * s,
            )
            p, q = (np.array([at[0], side * at[1], self.swing_z]) for at in (self.SB, self.SR))
            self.cylinder(
                f"swing {letter}", f"swing_cylinder_barrel_{letter}", f"swing_piston_rod_{letter}", p, q, Z, 0.034 * s
            )
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


def backhoe(
    seed: int,
    *,
    parallel: bool | None = None,
    extending: bool | None = None,
    embedded: bool = False,
    all_steer: bool = False,
) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's.
    `all_steer`: with a steered rear axle, too."""
    rng = np.random.default_rng([seed, 43])
    levers = bool(rng.random() < 0.5) if parallel is None else parallel
    longer = bool(rng.random() < 0.5) if extending is None else extending
    return Backhoe(seed, parallel=levers, extending=longer, embedded=embedded, all_steer=all_steer).draw()
