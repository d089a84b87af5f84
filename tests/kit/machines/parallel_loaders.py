"""Parametric wheel loaders with a parallel linkage: a levelling link from the front frame turns a rocker on the boom,
which carries the tilt cylinder (or two); its rod pushes a tipping link on the boom, and this the bucket link."""

from __future__ import annotations

import math

import numpy as np

from kit.machines.solids import Array, around, place, tube
from kit.machines.synthetic import Drawer, Machine, Y, away, meet, polar

DRAWN_AT = -0.5
"""The boom's angle at which the bucket is level, rad."""


def third(p: Array, rp: float, q: Array, rq: float, like: Array) -> Array:
    """Corner of a triangle over p and q, on the side on which `like` has it: (p, q, corner)."""
    a, b, c = like
    return meet(p, rp, q, rq, math.copysign(1.0, float(np.linalg.det([b - a, c - a]))))


def apart(p: Array, q: Array) -> float:
    return float(np.hypot(*(q - p)))


class ParallelDrawer(Drawer):
    """A loader whose tilt linkage is a parallel one; `cylinders`: one in the middle, or two; `shared`: the bucket link
    hangs on the pin of the rod, else on one of its own."""

    def __init__(self, seed: int, *, cylinders: int, shared: bool, steered: bool, embedded: bool, hoses: int) -> None:
        self.cylinders, self.shared = cylinders, shared
        super().__init__(seed, twin=True, steered=steered, embedded=embedded, stop=False, hoses=hoses, links=2)

    def link_pins(self) -> None:
        u, s = self.rng.uniform, self.s
        for _ in range(2000):
            k = lambda v: v * s * u(0.96, 1.04)  # noqa: E731
            A, C = np.array([k(0.80), k(2.118)]), np.array([k(0.665), k(1.35)])
            E = A + np.array([k(0.09), -k(0.19)])
            corners = {"G": (k(0.82), k(0.27)), "H": (k(0.95), -0.02 * s), "F": (k(0.52), k(0.61))}
            corners |= {"T": (k(2.16), k(0.065)), "K": (k(2.11), k(0.50)), "N": (k(2.13), k(0.27))}
            corners |= {"M": (1.15 * s, 0.0), "W": (1.93 * s, -0.16 * s), "B": (k(2.65), 0.0)}
            level = {name: self.on_boom(A, DRAWN_AT, *at) for name, at in corners.items()}
            level["J"] = level["B"] + np.array([k(0.14), k(0.29)])
            beta, stroke = float(u(-0.5, 0.3)), float(u(0.93, 1.07))
            now = {name: self.on_boom(A, beta, *corners[name]) for name in "GTMWB"}
            pull = "K" if self.shared else "N"
            one = level
            try:
                G, T, B = now["G"], now["T"], now["B"]
                H = third(E, apart(E, one["H"]), G, apart(one["G"], one["H"]), (E, one["G"], one["H"]))
                F = third(G, apart(one["G"], one["F"]), H, apart(one["H"], one["F"]), (one["G"], one["H"], one["F"]))
                length = stroke * apart(one["F"], one["K"])
                K = third(F, length, T, apart(one["T"], one["K"]), (one["F"], one["T"], one["K"]))
                N = third(T, apart(one["T"], one["N"]), K, apart(one["N"], one["K"]), (one["T"], one["K"], one["N"]))
                L = K if self.shared else N
                J = third(
                    L, apart(one[pull], one["J"]), B, apart(B, B + one["J"] - one["B"]), (one[pull], one["B"], one["J"])
                )
            except ValueError:
                continue
            D = A + polar(k(1.25), beta - 0.12 * u(0.8, 1.3))
            pins = (A, B, C, D, E, F, G, H, J, T, K, L)
            self.P = dict(zip("ABCDEFGHJTKL", pins, strict=True))
            self.M, self.W = now["M"], now["W"]
            turned = math.atan2(*(J - B)[::-1]) - math.atan2(*(one["J"] - one["B"])[::-1])
            self.bucket_angle = (turned + math.pi) % (2 * math.pi) - math.pi
            if abs(self.bucket_angle) < 1.0 and not self.clashes():
                return
        raise RuntimeError("no linkage for this seed")

    @staticmethod
    def on_boom(A: Array, beta: float, along: float, above: float) -> Array:
        c, n = math.cos(beta), math.sin(beta)
        return A + np.array([along * c - above * n, along * n + above * c])

    def clashes(self) -> bool:
        E, F, G, H, T, K, J, B = (self.P[k] for k in "EFGHTKJB")
        room = 0.11 * self.s + 2.2 * self.pin_r
        near_tube = min(away(self.M, *pair) for pair in ((G, H), (F, G), (E, H))) < room
        near_tube = near_tube or min(away(self.W, *pair) for pair in ((T, K), (self.P["L"], J))) < room
        c, n = math.cos(self.bucket_angle), math.sin(self.bucket_angle)
        ahead = [c * (q - B)[0] + n * (q - B)[1] for q in (T, K, self.W)]
        return near_tube or max(ahead) > 0.28 * self.s - room

    # ---- what stands where across the machine ----
    @property
    def eyes(self) -> list[tuple[float, str]]:
        """Where the tilt cylinders are, and what their names end in."""
        return [(0.0, "")] if self.cylinders == 1 else [(0.13 * self.s, "_l"), (-0.13 * self.s, "_r")]

    @property
    def tilt_w(self) -> float:
        return self.eye_w if self.cylinders == 1 else 0.12 * self.s

    @property
    def tilt_forks(self) -> list[tuple[float, float]]:
        y = self.eyes[0][0] + self.tilt_w / 2 + self.gap + self.t / 2
        between = [] if self.cylinders == 1 else [(0.0, 2 * (self.eyes[0][0] - self.tilt_w / 2 - self.gap))]
        return [(y, self.t), *between, (-y, self.t)]

    @property
    def outside(self) -> float:
        return self.tilt_forks[0][0] + self.t / 2

    @property
    def y_link_ear(self) -> float:
        return self.outside + self.gap + self.t / 2

    @property
    def y_link(self) -> float:
        return self.y_link_ear + self.gap + self.t

    # ---- pieces ----
    def boom(self) -> None:
        t, body, r = self.t, "boom", 0.11 * self.s
        A, B, D, G, T = (self.P[k] for k in "ABDGT")
        wide, half = 2.4 * self.pin_r, self.yb - self.t / 2 + self.e
        for side in (1, -1):
            outline = around((*A, wide), (*B, wide), (*self.M, 1.6 * r), (*self.W, 1.3 * r), (*D, wide))
            self.side_plate("arm plate", body, side * self.yb, outline, "ABD", thickness=t)
            for foot, name in ((self.M, "G"), (self.W, "T")):
                outline = around((*foot, 1.3 * r), (*(G if name == "G" else T), 2 * self.pin_r))
                self.side_plate("lug", body, side * self.y_link_ear, outline, name, [(*map(float, foot), r)])
        for foot in (self.M, self.W):
            pipe = tube("cross_tube", r, 0.8 * r, 2 * half)
            self.m.add("cross tube", body, body, pipe, place((foot[0], -half, foot[1]), Y))

    def rocker_and_link(self) -> None:
        r, out, w = 2 * self.pin_r, self.outside, self.tilt_w
        E, F, G, H, T, K, L, J = (self.P[k] for k in "EFGHTKLJ")
        lug = self.y_link_ear + self.t / 2
        for y, thickness in self.tilt_forks:
            self.side_plate(
                "lever", "levelling_rocker", y, around((*F, r), (*G, 1.3 * r), (*H, r)), "FGH", thickness=thickness
            )
            corners, holes = ((*T, 1.2 * r), (*K, r)), "TK" if self.shared else "TKL"
            self.side_plate("tipper", "tipping_link", y, around(*corners), holes, thickness=thickness)
        for y, tail in self.eyes:
            self.side_plate("leveller", "levelling_link", y, around((*E, r), (*H, 0.9 * r)), "EH", thickness=w)
            for body, at in (("levelling_rocker", "G"), ("tipping_link", "T")):
                hub = tube(f"hub_{w:.3f}", 1.5 * self.bore_r, self.bore_r, w + 2 * self.gap)
                self.m.add("hub", body, body, hub, place(self.at(at, y - w / 2 - self.gap), Y))
            low, high = (-out, out) if not tail else sorted((0.0, math.copysign(out, y)))
            barrel, rod = f"bucket_cylinder_barrel{tail}_rocker_pin", f"bucket_piston_rod{tail}"
            self.pin(barrel, "levelling_rocker", self.at("F", low), self.at("F", high))
            if not self.shared:
                self.pin(f"{rod}_pin", rod, self.at("K", low), self.at("K", high))
        for side in (1, -1):
            self.side_plate("link", "bucket_link", side * self.y_link, around((*L, 0.9 * r), (*J, 0.9 * r)), "LJ")
        wide = self.y_link + self.t / 2
        if self.shared:
            for _, tail in self.eyes:
                low, high = (-wide, wide) if not tail else (0.0, wide) if tail == "_l" else (-wide, 0.0)
                self.pin(
                    f"bucket_piston_rod{tail}_pin", f"bucket_piston_rod{tail}", self.at("K", low), self.at("K", high)
                )
        else:
            self.pin("bucket_link_tipping_pin", "tipping_link", self.at("L", -wide), self.at("L", wide))
        self.pin("levelling_rocker_pin", "levelling_rocker", self.at("G", -lug), self.at("G", lug))
        self.pin("tipping_link_pin", "tipping_link", self.at("T", -lug), self.at("T", lug))
        self.pin("levelling_link_rocker_pin", "levelling_rocker", self.at("H", -out), self.at("H", out))
        self.pin("levelling_link_pin", "front_frame", self.at("E", -out), self.at("E", out))

    def tilt(self) -> None:
        kept, self.eye_w = self.eye_w, self.tilt_w
        for y, tail in self.eyes:
            F, K = self.as_steered(self.at("F", y)), self.as_steered(self.at("K", y))
            bore = (0.085 if not tail else 0.045) * self.s
            barrel, rod = f"bucket_cylinder_barrel{tail}", f"bucket_piston_rod{tail}"
            reach = (0.13 * self.s, 0.18 * self.s)
            self.cylinder(f"tilt{tail}", barrel, rod, F, K, self.front[:3, 1], bore, ways=reach)
        self.eye_w = kept


def parallel_loader(
    seed: int,
    *,
    cylinders: int | None = None,
    shared: bool | None = None,
    steered: bool = True,
    embedded: bool = False,
    hoses: int = 0,
) -> Machine:
    """The loader of a seed, in its own frame, in drawing order, with names: as `synthetic.loader`, with one tilt
    cylinder or two, and the bucket link on the rod's pin (`shared`) or on one of its own."""
    chosen = np.random.default_rng([seed, 31])
    one, on_rod = bool(chosen.random() < 0.5), bool(chosen.random() < 0.5)
    return ParallelDrawer(
        seed,
        cylinders=cylinders or (1 if one else 2),
        shared=on_rod if shared is None else shared,
        steered=steered,
        embedded=embedded,
        hoses=hoses,
    ).draw()
