"""Parametric crawler cranes straight as `Assembly` objects, with the truth: two tracks, a superstructure that slews, a
lattice boom that ropes and pendants hold from a gantry, a hook on two to eight falls or none.

Every dimension is drawn from a seed, by none of the example's code; simplified as the synthetic loaders are.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np

from kit.machines.crawler import merged
from kit.machines.excavators import Digger, any_features
from kit.machines.solids import Array, around, box, place, plate, tube
from kit.machines.synthetic import Machine, X, Y, Z, polar
from yellowiron.model.geometry import Shape

ROPE = 0.007
"""Radius, in machine sizes."""


class CrawlerCrane(Digger):
    """One machine from one generator of random numbers."""

    upper_body, ring = "superstructure", "slewing_bearing"

    def __init__(self, seed: int, *, sections: int, hook: bool, embedded: bool) -> None:
        self.sections, self.hook = sections, hook
        bearing = "races" if any_features(seed).bearing == "plain" else any_features(seed).bearing
        super().__init__(seed, replace(any_features(seed), bearing=bearing, hoses=0), embedded=embedded)
        self.m.title = "CRAWLER CRANE"

    def link_pins(self) -> None:
        u, s = self.rng.uniform, self.s
        self.t, self.pin_r = 0.035 * s * u(0.9, 1.15), 0.035 * s * u(0.9, 1.15)
        self.gauge = 2.75 * s * u(0.95, 1.1)
        self.boom, self.long = float(u(math.radians(25), math.radians(75))), 6.6 * u(0.9, 1.4)
        self.deep, self.chord = 0.34 * u(0.9, 1.1), 0.08 * u(0.9, 1.1)
        self.foot_at = np.array([0.75, self.deck_top / s + 0.3]) * u(0.97, 1.05, 2)
        self.start, self.end = 0.5 * u(0.9, 1.1), self.long - 0.55 * u(0.9, 1.1)
        top = self.deck_top / s
        self.P = {"P": self.on(0.0, 0.0), "N": self.on(self.long, 0.0)}
        self.P["D"] = self.on(self.long - 0.12, self.deep + 0.12 * u(0.8, 1.2))
        self.P["G"] = s * np.array([-1.45 * u(0.95, 1.1), top + 1.5 * u(0.85, 1.15)])
        self.ropes = float(u(0.9, 1.7))
        self.falls, self.hauls = (int(n) for n in self.rng.integers(1, 5, 2))
        self.drop = float(u(0.9, 1.0 + 0.5 * self.long * math.sin(self.boom)))

    def on(self, x: float, z: float) -> Array:
        """A point of the boom's frame, in machine sizes."""
        return self.s * (self.foot_at + x * polar(1.0, self.boom) + z * polar(1.0, self.boom + math.pi / 2))

    def draw(self) -> Machine:
        for group in (self.tracks, self.undercarriage, self.bearing, self.upper, self.gantry, self.lattice, self.held):
            group()
        if self.hook:
            self.hoist()
        return self.m

    # ---- superstructure ----
    def upper(self) -> None:
        s, e, body, u = self.s, self.e / self.s, self.upper_body, self.rng.uniform
        low, top = self.deck_low / s, self.deck_top / s
        self.block("deck", body, (-2.0, -0.95, low), (1.0, 0.95, top))
        self.block("counterweight", body, (-2.5, -1.2, low - 0.05), (-2.0 + e, 1.2, top + 0.5 * u(0.7, 1.3)))
        self.block("cab", body, (0.1, 0.52, top - e), (1.0, 1.05, top + 1.1 * u(0.9, 1.1)))
        self.block("engine house", body, (-1.9, -1.05, top - e), (-0.4, -0.52, top + 0.7 * u(0.8, 1.2)))
        self.block("machinery house", body, (-1.9, 0.52, top - e), (-0.2, 1.05, top + 0.7 * u(0.8, 1.2)))
        for x in (-0.75, -0.2):
            drum = tube("winch drum", 0.14 * s, 0.0, 0.5 * s)
            self.m.add("winch drum", body, body, drum, place((x * s, -0.25 * s, self.deck_top + 0.14 * s - self.e), Y))
        self.foot_y = (self.deep - self.chord) * s
        cheek_y = self.foot_y + self.t + self.gap
        p = self.P["P"]
        base = [(float(p[0]) + d * s, self.deck_top - self.e, 0.0) for d in (-0.3, 0.22)]
        for side in (1, -1):
            self.side_plate("boom foot bracket", body, side * cheek_y, around((*p, 2.3 * self.pin_r), *base), "P")
        self.y_pin("boom_pin", body, "P", cheek_y + self.t)

    def y_pin(self, role: str, body: str, pin: str, half: float) -> None:
        self.pin(role, body, self.at(pin, -half), self.at(pin, half))

    def gantry(self) -> None:
        s, body, g = self.s, self.upper_body, self.P["G"]
        self.near = (0.5 * max(self.falls, self.hauls) * 0.026 + 0.03) * s
        y, low = self.near + 0.035 * s, self.deck_top - self.e
        feet = [[(g[0] - 0.35 * s, low, 0.0), (g[0] - 0.15 * s, low, 0.0)], [(g[0] + 0.9 * s, low, 0.0)]]
        for side in (1, -1):
            for name, foot in zip(("gantry leg", "gantry strut"), feet, strict=True):
                thick = self.t if name == "gantry leg" else 0.8 * self.t
                at = side * (y if name == "gantry leg" else y + 0.9 * self.t - self.e)
                ends = around((*map(float, g), 2.0 * self.pin_r), *foot)
                if name == "gantry strut":
                    ends = around((*map(float, g), 2.0 * self.pin_r), *foot, (foot[0][0] + 0.15 * s, low, 0.0))
                self.side_plate(name, body, at, ends, "G", thickness=thick)
        self.y_pin("boom_hoist_rope_pin", body, "G", y + 1.5 * self.t)

    # ---- boom ----
    def lattice(self) -> None:
        s, e, body = self.s, self.e / self.s, "boom"
        along, up = polar(1.0, self.boom), polar(1.0, self.boom + math.pi / 2)

        def frame(x: float) -> Array:
            at = self.on(x, 0.0)
            return place((at[0], 0.0, at[1]), (up[0], 0.0, up[1]), (along[0], 0.0, along[1]))

        edges = np.linspace(self.start, self.end, self.sections + 1)
        for number, (low, high) in enumerate(itertools.pairwise(edges)):
            shape = self._section(float(high - low) + (e if number else 0.0))
            self.m.add("boom section", body, body, shape, frame(0.5 * float(low + high) - 0.5 * e * (number > 0)))
        for name, x in (("foot frame", self.start), ("head frame", self.end)):
            ahead = -1.0 if x == self.start else 1.0
            wide = box(name, 0.07 * s, 2.0 * self.deep * s, 2.0 * self.deep * s)
            self.m.add(name, body, body, wide, frame(x + ahead * (0.035 - e)))
        wide = 2.2 * self.pin_r
        foot = around((*self.P["P"], wide), *((*self.on(self.start - 0.07 + e, z), 0.0) for z in (-0.2, 0.2)))
        for side in (1, -1):
            self.side_plate("boom foot", body, side * self.foot_y, foot, "P")
        # The plates of the head stand beside the hook's sheaves, within the pendants' eyes.
        self.head_y = self.near + 0.02 * s + self.t / 2
        circles = [(*self.P["N"], wide), (*self.P["D"], 1.8 * self.pin_r)]
        head = around(*circles, *((*self.on(self.end + 0.07 - e, z), 0.0) for z in (-0.25, 0.3)))
        for side in (1, -1):
            self.side_plate("boom head", body, side * self.head_y, head, "ND" if self.hook else "D")
        self.eye_y = self.head_y + self.t + self.gap
        self.y_pin("boom_pendant_pin", body, "D", self.eye_y + 0.7 * self.t)
        if self.hook:
            self.y_pin("hoist_rope_pin", body, "N", self.head_y + self.t)

    def _section(self, long: float) -> Shape:
        """Four chords and the lacing between them, along x about the origin."""
        s, c, h = self.s, self.chord, self.deep - 0.5 * self.chord
        chord = box("chord", long * s, c * s, c * s)
        shapes = [(chord, place((0, y * h * s, z * h * s), Z, X)) for y in (1, -1) for z in (1, -1)]
        bays = max(2, round(long / (2.0 * h)))
        step = long / bays
        lace = box("lace", math.hypot(step, 2.0 * h) * s, 0.5 * c * s, 0.5 * c * s)
        for bay in range(bays):
            x, sense = (-0.5 * long + (bay + 0.5) * step) * s, (-1.0) ** bay
            for side in (1, -1):
                shapes.append((lace, place((x, side * h * s, 0), Y, (step, 0, sense * 2.0 * h))))
                shapes.append((lace, place((x, 0, side * h * s), Z, (step, sense * 2.0 * h, 0))))
        return merged(f"section_{long:.5f}", *shapes)

    # ---- ropes ----
    def tackle(
        self, rope: str, block: str, pin: str, ahead: Array, drop: float, falls: int, half: float, *, plates: float
    ) -> Array:
        """Sheaves on a pin and the falls from them, so far to a block in that direction of the plane; the block's
        frame, z back to the pin. `half`: of the sheaves' width; the block's plates stand beyond it, `plates` thick."""
        s, e, r, wire = self.s, self.e, 0.085 * self.s, ROPE * self.s
        back = (-ahead[0], 0.0, -ahead[1])
        across = np.cross(Y, back)
        matrix = place(self.at(pin, 0.0), back, across)
        rows = (np.arange(falls) - 0.5 * (falls - 1)) * 0.026 * s
        spots = [(side * (r - wire), float(y)) for y in rows for side in (1.0, -1.0)]
        sheave = 0.5 * falls * 0.026 * s + 0.004 * s
        shapes = [(tube(f"sheave_{falls}", r, self.bore_r, 2 * sheave), place((0, -sheave, 0), Y))]
        shapes += [(tube("fall", wire, 0.0, drop), place((x, y, -drop), Z)) for x, y in spots]
        self.m.add(rope, rope, rope, merged(f"{rope}_{drop:.4f}", *shapes), matrix)
        frame = matrix.copy()
        frame[:3, 3] += drop * np.array([ahead[0], 0.0, ahead[1]])
        holes = [(x, y, 1.8 * wire) for x, y in spots]
        guard = box(f"{block}_guard", 2 * r + 0.06 * s, 2 * half, 0.07 * s, holes)
        self.m.add("rope guard", block, block, guard, frame @ place((0, 0, 0.14 * s), Z, X))
        edge = 0.175 * s
        outline = around((0.0, -0.2 * s, 0.06 * s), (r + 0.03 * s, edge, 0.0), (-r - 0.03 * s, edge, 0.0))
        for side in (1, -1):
            at = place((0, side * (half + 0.5 * plates - e), 0), -Y, X)
            self.m.add("block cheek", block, block, plate(f"{block}_cheek", outline, plates), frame @ at)
        lower = tube(f"{block}_sheaves", r - 2.5 * wire, 0.0, 2 * half + 2 * e)
        self.m.add("block sheaves", block, block, lower, frame @ place((0, -half - e, -0.06 * s), Y))
        return frame

    def held(self) -> None:
        """The ropes from the gantry's head to a bail, and the pendants from there to the boom's."""
        s, e, body = self.s, self.e, "boom_pendant"
        line = self.P["D"] - self.P["G"]
        span = float(np.hypot(*line))
        rope, half = self.ropes * s, self.eye_y - 0.5 * self.t - 0.025 * s
        frame = self.tackle(
            "boom_hoist_rope", body, "G", line / span, rope, self.hauls, half, plates=0.025 * s + 2 * e
        )  # fmt: skip
        reach = span - rope
        bar = around((0.0, 0.0, 1.9 * self.pin_r), (0.0, -reach, 1.9 * self.pin_r))
        for side in (1, -1):
            shape = plate("pendant", bar, self.t, [(0.0, -reach, self.bore_r)])
            self.m.add("pendant", body, body, shape, frame @ place((0, side * self.eye_y, 0), -Y, X))

    def hoist(self) -> None:
        s, e, body = self.s, self.e, "hook_block"
        frame = self.tackle(
            "hoist_rope", body, "N", np.array([0.0, -1.0]), self.drop * s, self.falls, self.near, plates=0.03 * s
        )  # fmt: skip
        trunnion = box("hook_trunnion", 0.1 * s, 2 * self.near + 2 * e, 0.08 * s)
        self.m.add("hook trunnion", body, body, trunnion, frame @ place((0, 0, -0.2 * s), Z, X))
        shank = tube("hook", 0.035 * s, 0.0, 0.3 * s)
        self.m.add("hook", body, body, shank, frame @ place((0, 0, -0.54 * s + e), Z))


def crawler_crane(
    seed: int, *, sections: int | None = None, hook: bool | None = None, embedded: bool = False
) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's."""
    drawn = np.random.default_rng([seed, 61]).random(2)
    return CrawlerCrane(
        seed,
        sections=int(1 + drawn[0] * 4) if sections is None else sections,
        hook=bool(drawn[1] < 0.75) if hook is None else hook,
        embedded=embedded,
    ).draw()
