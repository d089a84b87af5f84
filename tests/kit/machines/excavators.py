"""Parametric crawler excavators straight as `Assembly` objects, with the truth: what a maker may build otherwise.

Proportions come from a seed, features from `Features`: one boom cylinder or two (each a part, or both drawn as one
mesh), one-piece or two-piece boom, or one that swings on a bracket, a blade with one cylinder or two, a quick coupler,
four ways to draw the slewing bearing, a tipping link of loose plates or welded. Metres, machine frame; the planar pins
are letters of `Drawer.P`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from kit.machines.crawler import merged
from kit.machines.solids import Array, around, bolt, box, lathe, place, plate, tube
from kit.machines.synthetic import XZ, Drawer, Machine, X, Y, Z, away, meet, polar
from yellowiron.model.geometry import Shape

BEARINGS = ("races", "spigot", "boss", "flat")
"""Two rings one in the other; a ring and the turntable's spigot; no ring, the frame's boss in the turntable; nothing
but round faces on each other."""


@dataclass(frozen=True)
class Features:
    """What one maker builds so and another otherwise."""

    boom_cylinders: str = "twin"
    """`twin`, `single`, or `merged`: two drawn as one mesh."""
    two_piece: bool = False
    blade: int = 0
    """Cylinders of the blade; 0: no blade."""
    coupler: bool = False
    bearing: str = "races"
    tipping: str = "plates"
    """`plates`: two loose ones; `welded`: an H."""
    through: bool = False
    """One pin through both rods of the boom cylinders."""
    bolts: bool = True
    hoses: int = 0
    track_pins: bool = False
    swing: bool = False
    """The boom on a bracket that a cylinder swings; with one boom cylinder."""

    def choices(self) -> dict[str, str]:
        """The template's variants that this is."""
        return {
            "boom_cylinders": "twin" if self.boom_cylinders == "twin" else "single",
            "boom_type": "two_piece" if self.two_piece else "swing" if self.swing else "mono",
            "blade": ("none", "fitted", "twin")[self.blade],
        }


def any_features(seed: int) -> Features:
    """Features drawn from a seed."""
    rng = np.random.default_rng([seed, 11])
    drawn: dict[str, Any] = {
        "boom_cylinders": str(rng.choice(["twin", "twin", "single"])),
        "two_piece": bool(rng.random() < 0.3),
        "blade": int(rng.choice([0, 0, 1, 2])),
        "coupler": bool(rng.random() < 0.3),
        "bearing": str(rng.choice(BEARINGS)),
        "tipping": str(rng.choice(["plates", "welded"])),
        "through": bool(rng.random() < 0.4),
        "bolts": bool(rng.random() < 0.6),
        "hoses": int(rng.choice([0, 0, 3])),
        "track_pins": bool(rng.random() < 0.2),
        "swing": False,
    }
    assert set(drawn) == {f.name for f in fields(Features)}
    return Features(**drawn)


def rot(angle: float, p: Array) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * p[0] - s * p[1], s * p[0] + c * p[1]])


def direction(p: Array) -> float:
    return math.atan2(p[1], p[0])


def between(a: Array, b: Array, c: Array, d: Array) -> float:
    """Distance of two segments that do not cross."""
    return min(away(a, c, d), away(b, c, d), away(c, a, b), away(d, a, b))


class Digger(Drawer):
    """One excavator. Plates lie in levels beside the cylinders' eyes: the arm's in level 0, then outwards."""

    carrier = "undercarriage"
    upper_body, ring = "upperstructure", "swing_bearing"
    """What turns on the undercarriage, and the role of what it turns on."""

    def __init__(self, seed: int, features: Features, *, embedded: bool = False) -> None:
        self.rng = np.random.default_rng(seed)
        self.f = features
        self.m = Machine(features.boom_cylinders == "twin", title="EXCAVATOR")
        u = self.rng.uniform
        self.s = s = float(u(0.4, 1.1))
        self.t = 0.045 * s * float(u(0.85, 1.2))
        self.pin_r = 0.045 * s * float(u(0.85, 1.15))
        self.clearance = float(self.rng.choice([0.0, 0.0002, 0.0008])) * s
        self.gap = float(self.rng.choice([0.0, 0.001, 0.004])) * s
        self.eye_w = 0.22 * s * float(u(0.9, 1.2))
        self.e = 0.004 * s if embedded else 0.0
        self.hoses = features.hoses
        self.teeth = int(self.rng.choice([8, 10]))
        self.pitch = 0.3 * s * (8 / self.teeth) * float(u(0.9, 1.1))
        self.straight = int(self.rng.integers(9, 12)) + (self.teeth - 8)
        self.gauge = 2.3 * s * float(u(0.9, 1.1))
        self.pitch_r = self.pitch / (2 * math.sin(math.pi / self.teeth))
        self.plate_out = 0.3 * self.pitch
        self.shoe_t = 0.12 * self.pitch
        self.axle_z = self.pitch_r + self.plate_out + self.shoe_t / 2
        self.frame_top = self.axle_z + 0.25 * s
        self.deck_low = self.frame_top + 0.14 * s
        self.deck_top = self.deck_low + 0.1 * s
        self.boom_level = 2 if features.two_piece else 1
        self.link_pins()

    def level(self, k: int) -> float:
        """y of the plates of a level."""
        return self.eye_w / 2 + self.gap + self.t / 2 + k * (self.t + self.gap)

    # ---- planar linkage ----
    def link_pins(self) -> None:
        u, s = self.rng.uniform, self.s

        def near(x: float, z: float) -> Array:
            return np.array([x, z]) * s * u(0.95, 1.05)

        for _ in range(4000):
            ahead = 1.72 if self.f.swing else 0.08
            A = np.array([ahead * s, self.deck_top + 0.7 * s * u(0.9, 1.1)])
            C = A + near(0.55, -0.5)
            beta, arm_turn, swung = float(u(-0.2, 0.7)), float(u(-2.0, -0.7)), float(u(0.6, 2.1))
            boom, arm = near(5.2, 0.0), near(2.8, 0.0)
            if self.f.two_piece:
                Q, psi = near(2.4, 0.5), float(u(-0.35, 0.25))
                D, M, R = near(1.9, 0.35), near(3.3, 0.85), near(0.9, 0.5)
                S = near(3.5, 0.55)
                R, S = near(1.0, 0.75), near(3.2, 1.0)
                M = near(3.9, 0.7)
            else:
                Q, psi, R, S = boom, 0.0, boom, boom
                D, M = near(2.3, 0.5), near(2.6, 0.85)
                if self.f.boom_cylinders == "single":
                    D = near(2.2, 0.1)

            def on_boom(p: Array, a: Array = A, b: float = beta) -> Array:
                return np.asarray(a + rot(b, p))

            def beyond(p: Array, a: Array = A, b: float = beta, q: Array = Q, f: float = psi) -> Array:
                return np.asarray(a + rot(b, q + rot(f, p - q)))

            B = beyond(boom)
            alpha = beta + psi + arm_turn
            P, E, G, K = (B + rot(alpha, p) for p in (near(-0.7, 0.4), near(0.33, 0.55), near(2.4, 0.05), arm))
            H = G + rot(alpha, polar(0.58 * s * u(0.95, 1.05), swung))
            try:
                J = meet(H, 0.55 * s * u(0.95, 1.05), K, 0.44 * s, 1.0)
            except ValueError:
                continue
            self.P = {
                "A": A, "B": B, "C": C, "D": on_boom(D), "M": beyond(M), "P": P, "E": E, "G": G, "H": H, "J": J, "K": K,
                "Q": on_boom(Q), "R": on_boom(R), "S": beyond(S),
            }  # fmt: skip
            self.bucket_angle = direction(J - K) - math.radians(95)
            self.tubes = {
                "boom": on_boom(near(1.25, 0.32) if self.f.two_piece else near(1.3, 0.4)),
                "adjust_boom": beyond(near(4.4, 0.3)),
                "arm": B + rot(alpha, near(1.3, 0.1)),
            }
            if not self.clashes():
                return
        raise RuntimeError("no linkage for this seed")

    def rams(self) -> list[tuple[str, str]]:
        """Pins of the cylinders' two ends."""
        return [("C", "D"), ("M", "P"), ("E", "H")] + ([("R", "S")] if self.f.two_piece else [])

    def clashes(self) -> bool:
        s, P, room = self.s, self.P, 4.4 * self.pin_r
        for a, b in self.rams():
            length = float(np.hypot(*(P[b] - P[a])))
            if not 1.1 * s < length < 3.6 * s:
                return True
            if min(away(t, P[a], P[b]) for t in self.tubes.values()) < 0.2 * s and (a, b) != ("C", "D"):
                return True
        single = self.f.boom_cylinders == "single"
        if single and away(self.tubes["boom"], P["C"], P["D"]) < 0.2 * s:
            return True
        links = [between(P["H"], P["J"], P["G"], P["K"]), between(P["G"], P["H"], P["K"], P["J"])]
        sines = [self.sine(*(P[k] for k in pins)) for pins in ("ACD", "BMP", "EHG", "GHJ", "HJK")]
        if self.f.two_piece:
            sines.append(self.sine(P["Q"], P["R"], P["S"]))
        ahead = [rot(-self.bucket_angle, P[k] - P["K"])[0] for k in "GHE"]
        low = P["K"][1] < 0.4 * s
        return min(links) < room or min(sines) < 0.3 or max(ahead) > 0.42 * s - room / 2 or low

    @staticmethod
    def sine(a: Array, b: Array, c: Array) -> float:
        """Sine of the angle at `b`."""
        p, q = a - b, c - b
        return abs(float(p[0] * q[1] - p[1] * q[0])) / float(np.hypot(*p) * np.hypot(*q))

    # ---- groups ----
    def draw(self) -> Machine:
        self.tracks()
        self.undercarriage()
        self.bearing()
        self.upper()
        self.boom()
        self.arm()
        self.bucket_links()
        self.bucket()
        self.hydraulics()
        if self.f.blade:
            self.blade()
        self.lay_hoses()
        return self.m

    def pair(self, name: str, body: str, level: int, outline: Array, pins: str, **more: Any) -> None:
        for side in (1, -1):
            self.side_plate(name, body, side * self.level(level), outline, pins, **more)

    def across(self, role: str, body: str, at: str, level: int) -> None:
        """A pin from side to side, through the plates of a level."""
        half = self.level(level) + self.t
        self.pin(role, body, self.at(at, -half), self.at(at, half))

    def stay(self, name: str, body: str, level: int, point: Array, radius: float) -> None:
        """A tube between the two plates of a level."""
        half = self.level(level) - self.t / 2 + self.e
        shape = tube(name, radius, 0.75 * radius, 2 * half)
        self.m.add(name, body, body, shape, place((point[0], -half, point[1]), Y))

    def boss(self, *pins: str) -> Array:
        return around(*((float(self.P[p][0]), float(self.P[p][1]), 2 * self.pin_r) for p in pins))

    def loop(self) -> tuple[list[tuple[float, float]], list[tuple[str, float, float]]]:
        """The pins of a chain, x and height above the axles, forward on the ground; the wheels that it runs about."""
        p, r, half = self.pitch, self.pitch_r, 0.5 * self.straight * self.pitch
        points = [(-half + k * p, -r) for k in range(self.straight)]
        turn = [-math.pi / 2 + k * 2 * math.pi / self.teeth for k in range(self.teeth // 2)]
        points += [(half + r * math.cos(a), r * math.sin(a)) for a in turn]
        points += [(half - k * p, r) for k in range(self.straight)]
        points += [(-half - r * math.cos(a), -r * math.sin(a)) for a in turn]
        return points, [("sprocket", -half, 0.0), ("idler", half, 0.0)]

    def tracks(self) -> None:
        m, s = self.m, self.s
        p, r, z0 = self.pitch, self.pitch_r, self.axle_z
        half = 0.5 * self.straight * p
        lug = 0.24 * p
        eye = around(
            (0, 0, lug), (0, self.plate_out - self.shoe_t / 2, 0), (p / 2, self.plate_out - self.shoe_t / 2, 0)
        )
        rear, front = (plate("eye", eye, 0.03 * s, [(0, 0, q)]) for q in (0.1 * p, 0.102 * p))
        eyes = [
            (shape, place((x, side * y * s, 0), (0, -sense, 0), (sense, 0, 0)))
            for shape, y, x, sense in ((front, 0.075, p / 2, -1), (rear, 0.107, -p / 2, 1))
            for side in (1, -1)
        ]
        top = (box("shoe_plate", 0.92 * p, 0.55 * s, self.shoe_t), place((0, 0, self.plate_out), Z, X))
        shoe = merged("shoe", top, *eyes)
        outer = r - lug

        def wheel(name: str, bore: float, rim: float, width: float) -> Shape:
            b, w = bore * s, width * s
            return lathe(name, [(b, -w), (rim, -w), (rim, w), (b, w)])

        teeth = []
        for k in range(self.teeth):
            out = np.array([*polar(1.0, 2 * math.pi * (k + 0.5) / self.teeth), 0.0])
            teeth.append((box("tooth", 0.06 * s, 0.04 * s, 0.09 * s), place((outer - 0.01 * s) * out, Z, out)))
        sprocket = merged("sprocket", (wheel("disc", 0.06, outer - 0.03 * s, 0.05), np.eye(4)), *teeth)

        idler = wheel("idler", 0.05, outer, 0.05)
        roller, carrier = wheel("roller", 0.03, 0.08 * s, 0.12), wheel("carrier", 0.025, 0.06 * s, 0.1)
        points, big = self.loop()
        n = len(points)
        rollers, carriers = int(self.rng.integers(3, 6)), int(self.rng.integers(1, 3))
        pin = tube("track_pin", 0.1 * p, 0.0, 0.25 * s)
        self.half = half
        for side, y in (("l", self.gauge / 2), ("r", -self.gauge / 2)):
            pins = np.array([(x, y, z0 + z) for x, z in points])
            for k in range(n):
                a, b = pins[k], pins[(k + 1) % n]
                along = (b - a) / p
                role = f"track_shoe_{side}_{k + 1}"
                m.add("shoe", role, self.bearer(role), shoe, place(0.5 * (a + b), np.cross(Y, along), along))
                if self.f.track_pins:
                    m.add("track_pin", role, self.bearer(role), pin, place(a - 0.125 * s * Y, Y))
            low, high = z0 - r + lug + 0.08 * s, z0 + r - lug - 0.06 * s
            shapes = {"sprocket": (sprocket, 0.06), "idler": (idler, 0.05)}
            wheels = [(f"{name}_{side}", shapes[name][0], x, z0 + z, shapes[name][1]) for name, x, z in big]
            for k, x in enumerate(np.linspace(half - 0.5 * s, -half + 0.5 * s, rollers)):
                wheels.append((f"track_roller_{side}_{k + 1}", roller, float(x), low, 0.03))
            above = np.linspace(0.35 * half, -0.35 * half, carriers) if carriers > 1 else (0.0,)
            for k, x in enumerate(above if len(big) == 2 else ()):
                wheels.append((f"carrier_roller_{side}_{k + 1}", carrier, float(x), high, 0.025))
            for role, shape, x, z, bore in wheels:
                body = self.bearer(role)
                m.add(role.rstrip("_0123456789"), role, body, shape, place((x, y, z), Y, X))
                axle = tube(f"axle_{bore}", 0.999 * bore * s, 0.0, 0.42 * s)
                m.add("axle", body, body, axle, place((x, y - 0.21 * s, z), Y))
            self.track_frame(y, 0.9 * (high - low))

    def bearer(self, role: str) -> str:
        """The body that a part of a track moves with."""
        return self.carrier

    def track_frame(self, y: float, height: float) -> None:
        """What carries a track's wheels."""
        frame = box("track_frame", 2 * self.half + 0.2 * self.s, 0.04 * self.s, height)
        at = place((0, self.inside(y), self.axle_z), Z, X)
        self.m.add("track_frame", self.carrier, self.carrier, frame, at)

    def inside(self, y: float) -> float:
        """y of a track's frame."""
        return y - math.copysign(0.15 * self.s, y)

    def undercarriage(self) -> None:
        m, s = self.m, self.s
        width = 2 * (self.inside(self.gauge / 2) - 0.02 * s)
        low = self.axle_z - 0.15 * s
        body = box("centre_frame", 1.3 * s, width, self.frame_top - low)
        m.add("centre frame", "undercarriage", "undercarriage", body, place((0, 0, (self.frame_top + low) / 2), Z, X))
        if self.f.bolts:
            for side in (1, -1):
                m.add(
                    "travel motor", "undercarriage", "undercarriage",
                    box("motor", 0.3 * s, 0.12 * s, 0.3 * s),
                    place((-self.half, side * (abs(self.inside(self.gauge / 2)) - 0.08 * s), self.axle_z), Z, X),
                )  # fmt: skip

    def bearing(self) -> None:
        m, s, kind, upper, ring = self.m, self.s, self.f.bearing, self.upper_body, self.ring
        z0, z1 = self.frame_top, self.deck_low
        h = z1 - z0
        r = 0.5 * s

        def add(name: str, role: str, body: str, profile: list[tuple[float, float]]) -> None:
            m.add(name, role, body, lathe(name, profile), place((0, 0, z0), Z, X))

        if kind == "races":
            add("inner ring", ring, "undercarriage", [(0.8 * r, 0), (r, 0), (r, 0.8 * h), (0.8 * r, 0.8 * h)])
            add("outer ring", upper, upper, [(r, 0.2 * h), (1.2 * r, 0.2 * h), (1.2 * r, h), (r, h)])
        elif kind == "spigot":
            add("ring", ring, "undercarriage", [(0.85 * r, 0), (r, 0), (r, 0.7 * h), (0.85 * r, 0.7 * h)])
            q = 0.849 * r
            add("turntable", upper, upper,
                [(0, 0.1 * h), (q, 0.1 * h), (q, 0.7 * h), (1.3 * r, 0.7 * h), (1.3 * r, h), (0, h)])  # fmt: skip
        elif kind == "boss":
            add("tower", ring, "undercarriage", [(0, 0), (0.8 * r, 0), (0.8 * r, 0.9 * h), (0, 0.9 * h)])
            q = 0.801 * r
            block = box("turn_block", 2.6 * r, 2.4 * r, 0.6 * h, [(0, 0, q)])
            m.add("turn block", upper, upper, block, place((0, 0, z1 - 0.3 * h), Z, X))
        else:
            add("tower", ring, "undercarriage", [(0, 0), (r, 0), (r, 0.5 * h), (0, 0.5 * h)])
            add("turntable", upper, upper,
                [(0, 0.5 * h), (1.2 * r, 0.5 * h), (1.2 * r, h), (0, h)])  # fmt: skip

    def upper(self) -> None:
        m, s, e, body = self.m, self.s, self.e, "upperstructure"
        low, top = self.deck_low, self.deck_top
        front, back = 1.15 * s, -1.9 * s

        def block(name: str, size: tuple[float, float, float], at: tuple[float, float, float]) -> None:
            m.add(name, body, body, box(name, *(v * s for v in size)), place(at, Z, X))

        deck = box("deck", front - back, 2.3 * s, top - low)
        m.add("deck", body, body, deck, place(((front + back) / 2, 0, (low + top) / 2), Z, X))
        block("counterweight", (0.5, 2.2, 0.9), (back - 0.25 * s, 0, low + 0.45 * s))
        block("engine", (0.8, 1.2, 0.7), (back + 0.5 * s, 0, top + 0.35 * s))
        block("hood", (1.0, 1.8, 0.08), (back + 0.5 * s, 0, top + 0.74 * s))
        block("cab", (1.4, 0.5, 1.5), (0.3 * s, 0.88 * s, top + 0.75 * s))
        block("glass", (0.02, 0.4, 0.8), (1.013 * s, 0.88 * s, top + 0.9 * s))
        block("tank", (0.9, 0.45, 0.6), (0.3 * s, -0.9 * s, top + 0.3 * s))
        if self.f.bolts:
            for side in (1, -1):
                for k in range(2):
                    at = (back + 0.02 * s + 0.1 * s, side * (0.5 + 0.3 * k) * s, top)
                    m.add("M24", body, body, bolt("deck_bolt", 0.014 * s, 0.06 * s), place(at, Z))
        if self.f.swing:
            self.bracket()
            return
        level = self.boom_level + 1
        A, C = self.P["A"], self.P["C"]
        base = [(-0.5 * s, top - e, 0.0), (float(C[0]) + 0.25 * s, top - e, 0.0)]
        circles = [(*map(float, A), 2 * self.pin_r)]
        if self.f.boom_cylinders != "single":
            circles.append((*map(float, C), 2 * self.pin_r))
        self.pair("tower", body, level, around(*circles, *base), "A" if self.f.boom_cylinders == "single" else "AC")
        self.across("boom_pin", body, "A", level)
        foot = [(float(C[0]) - 0.2 * s, top - e, 0.0), (float(C[0]) + 0.2 * s, top - e, 0.0)]
        lug = around((*map(float, C), 2 * self.pin_r), *foot)
        if self.f.boom_cylinders == "single":
            self.pair("cylinder lug", body, 0, lug, "C")
            self.across("boom_cylinder_barrel_pin", body, "C", 0)
            return
        self.y_lift = self.level(level) + self.t / 2 + self.gap + self.eye_w / 2
        out = self.y_lift + self.eye_w / 2 + self.gap + self.t / 2
        for side, tail in self.sides():
            self.side_plate("cylinder lug", body, side * out, lug, "C")
            ends = [self.at("C", side * (self.level(level) - self.t / 2)), self.at("C", side * (out + self.t))]
            self.pin(f"boom_cylinder_barrel{tail}_pin", body, *ends)

    def bracket(self) -> None:
        """A nose on the deck, the bracket on its upright pin, and the cylinder that swings it, on the right."""
        m, s, t, r = self.m, self.s, self.t, 2 * self.pin_r
        level, middle = self.boom_level + 1, self.deck_top + 0.3 * s
        hub, ear = np.array([1.45 * s, 0.0]), np.array([0.1 * s, -0.45 * s])
        arm = hub + polar(0.42 * s * float(self.rng.uniform(0.95, 1.05)), math.radians(-70))
        inner, outer = self.level(0), self.level(1)
        half = self.level(level) - t / 2

        def lugs(name: str, body: str, apart: float, outline: Array, *holes: Array) -> None:
            bores = [(*map(float, p), self.bore_r) for p in holes]
            for side in (1, -1):
                shape = plate(f"{name}_{side}", outline, t, bores)
                m.add(name, body, body, shape, place((0, 0, middle + side * apart), Z, X))

        def upright(role: str, body: str, at: Array, apart: float) -> None:
            ends = [np.array([*at, middle + side * (apart + t)]) for side in (-1, 1)]
            self.pin(role, body, *ends)

        def circle(p: Array) -> tuple[float, float, float]:
            return (float(p[0]), float(p[1]), r)

        body = "upperstructure"
        height = 0.3 * s + outer + t / 2
        web = box("nose_web", 0.1 * s, 0.6 * s, height)
        m.add("nose web", body, body, web, place((0.8 * s, 0, self.deck_top + height / 2), Z, X))
        lugs("nose lug", body, outer, around(circle(hub), (0.85 * s, 0.2 * s, 0), (0.85 * s, -0.2 * s, 0)), hub)
        upright("swing_bracket_pin", body, hub, outer)
        post = box("swing_post", 0.1 * s, 0.3 * s, height)
        m.add("post", body, body, post, place((-0.2 * s, -0.45 * s, self.deck_top + height / 2), Z, X))
        back = [(-0.15 * s, -0.55 * s, 0.0), (-0.15 * s, -0.35 * s, 0.0)]
        lugs("swing cylinder lug", body, inner, around(circle(ear), *back), ear)
        upright("swing_cylinder_barrel_pin", body, ear, inner)
        body = "swing_bracket"
        front = [(1.7 * s, half + self.e, 0.0), (1.7 * s, -half - self.e, 0.0)]
        lugs("bracket lug", body, inner, around(circle(hub), circle(arm), *front), hub, arm)
        upright("swing_piston_rod_pin", body, arm, inner)
        A, C = ((float(self.P[p][0]), float(self.P[p][1]), r) for p in "AC")
        rear = [(1.56 * s, middle + 0.2 * s, 0.0), (1.56 * s, middle - 0.2 * s, 0.0)]
        self.pair("bracket side", body, level, around(A, C, *rear), "AC")
        self.across("swing_bracket_boom_pin", body, "A", level)
        self.across("swing_bracket_boom_cylinder_barrel_pin", body, "C", level)
        ends = [np.array([*p, middle]) for p in (ear, arm)]
        self.cylinder("swing", "swing_cylinder_barrel", "swing_piston_rod", *ends, Z, 0.055 * s)

    def sides(self) -> tuple[tuple[int, str], ...]:
        tails = ("_l", "_r") if self.f.boom_cylinders == "twin" else ("", "")
        return ((1, tails[0]), (-1, tails[1]))

    def boom(self) -> None:
        level, s = self.boom_level, self.s
        carrier = "adjust_boom" if self.f.two_piece else "boom"
        far = "adjust_boom_arm" if self.f.two_piece else "arm"
        if self.f.two_piece:
            self.pair("boom plate", "boom", 2, self.boss("A", "D", "Q", "R"), "ADQR")
            self.pair("boom plate", "adjust_boom", 1, self.boss("Q", "B", "M", "S"), "QBMS")
            self.stay("adjust stay", "adjust_boom", 1, self.tubes["adjust_boom"], 0.09 * s)
            self.across("adjust_boom_pin", "boom", "Q", 2)
            self.across("adjust_cylinder_barrel_pin", "boom", "R", 2)
            self.across("adjust_piston_rod_pin", "adjust_boom", "S", 1)
        else:
            self.pair("boom plate", "boom", 1, self.boss("A", "B", "D", "M"), "ABDM")
        self.stay("boom stay", "boom", level, self.tubes["boom"], 0.1 * s)
        self.across(f"{far}_pin", carrier, "B", 1)
        self.across(f"{far}_cylinder_barrel_pin", carrier, "M", 1)
        if self.f.boom_cylinders == "single":
            self.across("boom_piston_rod_pin", "boom", "D", level)
            return
        out = self.y_lift + self.eye_w / 2 + 0.4 * self.t
        if self.f.through:
            role = "boom_piston_rod_l_pin" if self.f.boom_cylinders == "twin" else "boom_piston_rod_pin"
            self.pin(role, "boom", self.at("D", -out), self.at("D", out))
            return
        for side, tail in self.sides():
            inner = self.at("D", side * (self.level(level) - 0.6 * self.t))
            self.pin(f"boom_piston_rod{tail}_pin", "boom", inner, self.at("D", side * out))

    def arm(self) -> None:
        self.pair("arm plate", "arm", 0, self.boss("B", "P", "E", "G", "K"), "BPEGK")
        self.stay("arm stay", "arm", 0, self.tubes["arm"], 0.08 * self.s)
        for role, at in (("arm_piston_rod_pin", "P"), ("bucket_cylinder_barrel_pin", "E")):
            self.across(role, "arm", at, 0)
        for role, at in (("tipping_link_pin", "G"), ("bucket_pin", "K")):
            self.across(role, "arm", at, 1)

    def bucket_links(self) -> None:
        self.pair("tipping plate", "tipping_link", 1, self.boss("G", "H"), "GH")
        if self.f.tipping == "welded":
            middle = 0.55 * self.P["G"] + 0.45 * self.P["H"]
            self.stay("tipping stay", "tipping_link", 1, middle, 0.9 * self.pin_r)
        self.pair("link plate", "bucket_link", 0, self.boss("H", "J"), "HJ")
        self.stay("link stay", "bucket_link", 0, 0.4 * self.P["H"] + 0.6 * self.P["J"], 0.9 * self.pin_r)
        self.across("bucket_piston_rod_pin", "bucket_piston_rod", "H", 1)
        self.across("bucket_link_pin", "bucket", "J", 1)

    def bucket(self) -> None:
        m, s, t, e, body = self.m, self.s, self.t, self.e, "bucket"
        K, J = self.P["K"], self.P["J"]
        c, n = math.cos(self.bucket_angle), math.sin(self.bucket_angle)
        local = np.eye(4)
        local[[0, 0, 2, 2], [0, 2, 0, 2]] = [c, -n, n, c]
        local[0, 3], local[2, 3] = K
        width = float(self.rng.uniform(0.8, 1.2)) * s

        def put(name: str, shape: Any, matrix: Array, role: str = body) -> None:
            m.add(name, role, body, shape, local @ matrix)

        def ears(name: str, role: str, level: int, outline: Array, holes: list[tuple[float, float, float]]) -> None:
            for side in (1, -1):
                put(name, plate(name, outline, t, holes), place((0, side * self.level(level), 0), XZ, X), role)

        j = rot(-self.bucket_angle, J - K)
        r, hole = 2 * self.pin_r, self.bore_r
        back = 0.42 * s
        if self.f.coupler:
            # The coupler's plates end in two bores for the bucket's own pins.
            grips = [(0.42 * s, -0.02 * s), (0.38 * s, 0.42 * s)]
            back = 0.8 * s
            outline = around((0, 0, r), (*map(float, j), r), *((x, z, r) for x, z in grips))
            ears("coupler plate", "quick_coupler", 1, outline,
                 [(0.0, 0.0, hole), (*map(float, j), hole), *((x, z, hole) for x, z in grips)])  # fmt: skip
            lock = box("lock", 0.12 * s, 2 * (self.level(1) - t / 2), 0.1 * s)
            put("coupler block", lock, place((0.2 * s, 0, 0.2 * s), Z, X), "quick_coupler")
            outline = around(*((x, z, r) for x, z in grips), (back + e, -0.1 * s, 0), (back + e, 0.5 * s, 0))
            ears("ear", body, 2, outline, [(x, z, hole) for x, z in grips])
            half = self.level(2) + t
            for x, z in grips:
                put("bucket bar", tube(f"grip{x:.4f}", self.pin_r, 0.0, 2 * half), place((x, -half, z), Y))
        else:
            outline = around((0, 0, r), (*map(float, j), r), (back + e, -0.12 * s, 0), (back + e, 0.52 * s, 0))
            ears("ear", body, 1, outline, [(0.0, 0.0, hole), (*map(float, j), hole)])
        put("back", box("bucket_back", t, width, 1.25 * s), place((back + t / 2, 0, -0.1 * s), Z, X))
        put("floor", box("bucket_floor", 0.9 * s, width, t), place((back + t + 0.45 * s, 0, 0), Z, X))
        wall = np.array([[back + t - e, -t / 2 + e], [back + t + 0.88 * s, -t / 2 + e], [back + t - e, -0.7 * s]])
        for side in (1, -1):
            put("wall", plate("bucket_wall", wall, t), place((0, side * (width - t) / 2, 0), XZ, X))
        tip = back + t + 0.9 * s
        put("edge", box("edge", 0.15 * s, width, 0.8 * t), place((tip + 0.075 * s, 0, 0), Z, X), "cutting_edge")
        for k in range(4):
            y = (k - 1.5) * 0.3 * width
            put("tooth", box("tooth_of_bucket", 0.15 * s, 0.06 * s, 0.04 * s), place((tip + 0.225 * s, y, 0), Z, X))

    def hydraulics(self) -> None:
        s = self.s

        def ram(
            name: str, barrel: str, rod: str, ends: str, y: float, bore: float, longest: float | None = None
        ) -> None:
            self.cylinder(name, barrel, rod, self.at(ends[0], y), self.at(ends[1], y), Y, bore * s, longest=longest)

        ram("arm", "arm_cylinder_barrel", "arm_piston_rod", "MP", 0.0, 0.065)
        ram("bucket", "bucket_cylinder_barrel", "bucket_piston_rod", "EH", 0.0, 0.055)
        if self.f.two_piece:
            # It ends before both of its pins and the boom's are in line.
            dead = sum(float(np.hypot(*(self.P[k] - self.P["Q"]))) for k in "RS")
            ram("adjust", "adjust_cylinder_barrel", "adjust_piston_rod", "RS", 0.0, 0.07, 0.94 * dead)
        if self.f.boom_cylinders == "single":
            ram("boom", "boom_cylinder_barrel", "boom_piston_rod", "CD", 0.0, 0.07)
        elif self.f.boom_cylinders == "twin":
            for side, tail in self.sides():
                ram(
                    f"boom{tail}",
                    f"boom_cylinder_barrel{tail}",
                    f"boom_piston_rod{tail}",
                    "CD",
                    side * self.y_lift,
                    0.06,
                )
        else:
            self.one_mesh()

    def one_mesh(self) -> None:
        """Both boom cylinders in two parts: all barrels, all rods."""
        apart = Machine(True)
        kept, self.m = self.m, apart
        state = self.rng.bit_generator.state
        for side in (1, -1):
            self.rng.bit_generator.state = state
            ends = [self.at(k, side * self.y_lift) for k in "CD"]
            self.cylinder("boom", "boom_cylinder_barrel", "boom_piston_rod", *ends, Y, 0.06 * self.s)
        self.m = kept
        for body in ("boom_cylinder_barrel", "boom_piston_rod"):
            placed = [(apart.shapes[p.shape], p.transform) for p in apart.parts if apart.truth[p.id][1] == body]
            self.m.add(body, body, body, merged(body, *placed), np.eye(4))

    def blade_places(self) -> tuple[float, float, float]:
        """x of the face that holds the blade, and of the blade; its width."""
        return 0.65 * self.s, self.half + self.pitch_r + 0.35 * self.s, self.gauge + 0.4 * self.s

    def blade(self) -> None:
        m, s, t, e = self.m, self.s, self.t, self.e
        front, ahead, wide_plate = self.blade_places()
        z = self.axle_z
        self.P["U"] = np.array([front + 0.18 * s, z - 0.12 * s])
        self.P["V"] = np.array([front + 0.2 * s, z + 0.18 * s])
        turned = float(self.rng.uniform(-0.1, 0.12))
        self.P["W"] = np.array([ahead - 0.15 * s, z + 0.05 * s]) + turned * np.array([0.0, ahead - front])
        wide = self.level(0) if self.f.blade == 1 else 0.42 * s
        apart = [0.0] if self.f.blade == 1 else [wide, -wide]
        face = [(front - e, z - 0.12 * s, 0.0), (front - e, z + 0.2 * s, 0.0)]
        down = float(self.P["W"][1]) - z
        end = [(ahead + e, z - 0.2 * s + down, 0.0), (ahead + e, z + 0.1 * s + down, 0.0)]
        inner, outer = self.eye_w / 2 + self.gap + t / 2, self.eye_w / 2 + self.gap + 1.5 * t + self.gap

        def plates(name: str, body: str, at: float, circles: Array, pins: str) -> None:
            self.side_plate(name, body, at, circles, pins)

        def boss(pin: str) -> tuple[float, float, float]:
            return (float(self.P[pin][0]), float(self.P[pin][1]), 2 * self.pin_r)

        arms = 0.42 * s + outer + 0.1 * s
        for side in (1, -1):
            for d in (0, 1):
                y = side * (arms + (2 * d - 1) * (t + self.gap))
                plates("blade lug", "undercarriage", y, around(boss("U"), *face), "U")
            plates("blade arm", "blade", side * arms, around(boss("U"), *end), "U")
            reach = 1.6 * t + self.gap
            self.pin(
                "blade_pin", "undercarriage", self.at("U", side * (arms - reach)), self.at("U", side * (arms + reach))
            )
        for y in apart:
            for side in (1, -1):
                plates("cylinder lug", "undercarriage", y + side * inner, around(boss("V"), *face), "V")
                plates("cylinder lug", "blade", y + side * inner, around(boss("W"), *end), "W")
            tail = "" if self.f.blade == 1 else ("_l" if y > 0 else "_r")
            barrel, rod = f"blade_cylinder_barrel{tail}", f"blade_piston_rod{tail}"
            for role, body, at in ((barrel, "undercarriage", "V"), (rod, "blade", "W")):
                self.pin(f"{role}_pin", body, self.at(at, y - inner - t), self.at(at, y + inner + t))
            self.cylinder(f"blade{tail}", barrel, rod, self.at("V", y), self.at("W", y), Y, 0.04 * s)
        height = 0.5 * s
        plate_ = box("blade_plate", 0.08 * s, wide_plate, height)
        m.add("blade plate", "blade", "blade", plate_, place((ahead + 0.04 * s, 0, z - 0.05 * s + down), Z, X))


def excavator(seed: int, features: Features | None = None, *, embedded: bool = False, **more: Any) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names; `features` (default: drawn from the seed)
    with `more` of them fixed. `embedded`: plates are drawn into each other along their welds. Under the default choice
    of tracks, their parts are of the undercarriage. Hoses have no truth."""
    chosen = replace(features if features is not None else any_features(seed), **more)
    return Digger(seed, chosen, embedded=embedded).draw()
