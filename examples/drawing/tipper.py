"""Tipping bodies: a pivot at the rear, and hoist cylinders that raise what is ahead of it. In the plane y = 0,
millimetres: x forward, z up; angles are radians, a raised body positive."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from OCP.gp import gp_Trsf
from scipy.optimize import brentq, least_squares

from .planar import Point, rot, vec
from .product import Assembly, Part
from .solids import Vector, Y, moved, turn


@dataclass(frozen=True, slots=True, eq=False)
class Tipper:
    """A body's pivot, and how far it tips."""

    hinge: Point
    dump: float

    def carry(self, raised: float, point: Point) -> Point:
        """Where a point of the lowered body is when it is raised."""
        return self.hinge + rot(raised, point - self.hinge)

    def carried(self, raised: float) -> gp_Trsf:
        """Where the lowered body goes when it is raised."""
        return turn(Y, -math.degrees(raised), (float(self.hinge[0]), 0.0, float(self.hinge[1])))

    def lowered(self, x: float, raised_z: float) -> float:
        """Height of the lowered body's point at `x` that is at a height when the body is tipped."""
        x0, z0 = (float(c) for c in self.hinge)
        return z0 + (raised_z - z0 - (x - x0) * math.sin(self.dump)) / math.cos(self.dump)

    def raise_parts(self, lowered: Assembly, raised: float) -> Assembly:
        """The body's assembly, drawn lowered, with its parts raised in their geometry."""
        tree, at = Assembly(lowered.name), self.carried(raised)
        for use in lowered.uses:
            part = use.child
            assert isinstance(part, Part)
            tree.add(Part(part.name, moved(part.shape, at), part.colour), use.body, use.role)
        return tree


@dataclass(frozen=True, slots=True, eq=False)
class Hoist:
    """A hoist cylinder's pins: C on the frame, D on the lowered body."""

    tipper: Tipper
    C: Point
    D: Point

    def length(self, raised: float) -> float:
        """Of the cylinder."""
        return float(np.hypot(*(self.tipper.carry(raised, self.D) - self.C)))

    def pins(self, raised: float, y: float) -> tuple[Vector, Vector]:
        """Where a cylinder at `y` hangs on the frame and on the raised body."""
        d = self.tipper.carry(raised, self.D)
        return (float(self.C[0]), y, float(self.C[1])), (float(d[0]), y, float(d[1]))

    def raised(self, length: float) -> float:
        """The body's angle at a length of the cylinder."""
        return float(brentq(lambda a: self.length(a) - length, -0.01, self.tipper.dump + 0.01, xtol=1e-14))


def fitted_hoist(tipper: Tipper, near: tuple[Point, Point], closed: float, stroke: float) -> Hoist:
    """Pins at the heights of those `near`, and as far ahead as makes the cylinder's stroke tip the body."""
    low, high = (float(p[1]) for p in near)

    def pins(x: Point) -> Hoist:
        return Hoist(tipper, vec(x[0], low), vec(x[1], high))

    def missed(x: Point) -> Point:
        return np.array([pins(x).length(0.0) - closed, pins(x).length(tipper.dump) - closed - stroke])

    start = [float(p[0]) for p in near]
    return pins(least_squares(missed, start, xtol=1e-15, ftol=1e-15, gtol=1e-15).x)
