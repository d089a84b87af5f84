"""Parametric wheeled excavators straight as `Assembly` objects, with the truth: the upper of the drawn crawler
excavators on a frame with a steered axle that oscillates and fast rear wheels, with stabilizers or without."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from kit.machines.excavators import Digger, Features, any_features
from kit.machines.steered_chassis import ARM, KING, SIDES, SteeredChassis
from kit.machines.synthetic import Machine, X

BODY = "undercarriage"
RAIL = (0.2, 0.29, 0.62, 0.92)
"""Inside, outside, underside, top, in machine sizes."""


class Carrier(SteeredChassis):
    """What is below the slewing bearing, drawn into another's machine."""

    carrier = BODY

    def __init__(self, digger: WheeledDigger) -> None:
        # Not another machine: the digger's, its sizes and its pins, but for those of its own plates.
        self.__dict__.update(digger.__dict__)
        s = self.s
        self.t, self.pin_r, self.eye_w = 0.026 * s, 0.03 * s, 0.062 * s
        self.gap = min(self.gap, 0.002 * s)
        self.clearance = min(self.clearance, 0.0003 * s)
        # The arms point at the middle of the rear axle, so that all wheels roll about one point (Ackermann).
        self.arm_in = ARM * KING * s / (self.front_x - self.rear_x)

    def frame(self, legs: bool) -> None:
        """Rails, what joins them, what holds the bearing, the rear wheels' box; at the ends blade and stabilizers."""
        s, e = self.s, self.e
        inside, outside, low, high = RAIL
        front, rear, near, joint = self.front_x / s, self.rear_x / s, inside + e / s, high - e / s
        self.ends = (front + 0.62, rear - 0.72)
        for side, letter in SIDES:
            a, b = sorted((side * inside, side * outside))
            self.block("rail", BODY, (self.ends[1], a, low), (self.ends[0], b, high))
            self.block("rear axle box", BODY, (rear - 0.14, a, 0.42), (rear + 0.14, b, low + e / s))
            self.stub(f"rear_wheel_{letter}", BODY, side, self.rear_x, outside * s - e)
        for x in (rear - 0.1, -0.45, 0.35):
            self.block("cross member", BODY, (x, -near, low + 0.02), (x + 0.1, near, high - 0.02))
        self.block("bearing plate", BODY, (-0.65, -0.62, joint), (0.65, 0.62, self.frame_top / s))
        self.block("front cross beam", BODY, (self.ends[0] - e / s, -0.8, 0.3), (self.ends[0] + 0.08, 0.8, high))
        self.steered_axle("front", self.front_x, self.tyre_r, self.tyre_w)
        if legs:
            self.legs()

    def legs(self) -> None:
        """Two plates across the rails' rear ends, between which the stabilizers swing, each by a cylinder."""
        s, t, e = self.s, self.t, self.e
        x2 = self.ends[1] * s - t / 2 + e
        x1, middle = x2 - 0.14 * s, x2 - 0.07 * s
        self.leg = float(self.rng.uniform(-0.3, 0.8))
        self.leg_pin, self.leg_top = np.array([0.72, 0.5]) * s, np.array([0.58, 1.1]) * s
        for side, letter in SIDES:
            self.leg_plates("rear plate", side, letter, (x1, x2), 0.85)
            self.stabilizer(side, letter, middle)
            halves = (f"stabilizer_cylinder_barrel_{letter}", f"stabilizer_piston_rod_{letter}")
            ends = (np.array([middle, side * at[0], at[1]]) for at in (self.leg_top, self.leg_rod))
            self.cylinder(f"stabilizer_{letter}", *halves, *ends, X, 0.034 * s)
        self.block("rear beam", BODY, ((x1 + t / 2 - e) / s, -0.22, 0.62), ((x2 - t / 2 + e) / s, 0.22, 0.82))


class WheeledDigger(Digger):
    """One machine from one generator of random numbers."""

    def __init__(self, seed: int, features: Features, *, legs: bool, embedded: bool) -> None:
        self.with_legs = legs
        super().__init__(seed, features, embedded=embedded)
        self.m.title = "WHEELED EXCAVATOR"

    def link_pins(self) -> None:
        u, s = self.rng.uniform, self.s
        self.tyre_r, self.tyre_w, self.tread = (
            0.58 * s * u(0.95, 1.04),
            0.4 * s * u(0.92, 1.05),
            1.9 * s * u(0.98, 1.03),
        )
        self.front_x, self.rear_x = 1.45 * s * u(0.95, 1.06), -1.15 * s * u(0.95, 1.06)
        self.axle_z, self.frame_top = 0.54 * s, 1.12 * s
        self.deck_low = self.frame_top + 0.14 * s
        self.deck_top = self.deck_low + 0.1 * s
        super().link_pins()

    def tracks(self) -> None:
        """It has none."""

    def undercarriage(self) -> None:
        Carrier(self).frame(self.with_legs)

    def blade_places(self) -> tuple[float, float, float]:
        front = self.front_x + 0.7 * self.s
        return front, front + 1.25 * self.s, 2.3 * self.s


def wheeled_excavator(
    seed: int, features: Features | None = None, *, legs: bool | None = None, embedded: bool = False
) -> Machine:
    """The machine of a seed, in its own frame, in drawing order, with names; what is not stated is the seed's."""
    drawn = np.random.default_rng([seed, 59]).random(2)
    if features is None:
        features = replace(any_features(seed), two_piece=bool(drawn[0] < 0.6), hoses=0, track_pins=False, through=False)
    legs = bool(drawn[1] < 0.6) if legs is None else legs
    return WheeledDigger(seed, features, legs=legs, embedded=embedded).draw()
