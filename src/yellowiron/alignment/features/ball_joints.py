"""Balls in their sockets, as what a pin in its bore is: a fit, about the axis of the ball's stud."""

from __future__ import annotations

import math

import numpy as np

from yellowiron.alignment.features.contacts import Fit
from yellowiron.alignment.features.solids import Ball, Cyl, Solid
from yellowiron.model.geometry import Floats
from yellowiron.support.vectors import unit

_LOOSEST, _TIGHTEST = 0.93, 1.01
"""Radius of a ball over that of its socket."""
_HALF = 0.7
"""Half length of the fit, in radii."""


def ball_fits_of(solids: tuple[Solid, ...], tolerance: float) -> list[Fit]:
    """Every ball in a socket of another part, concentric with it."""
    balls = [(s, b) for s in solids for b in s.balls if not b.inner]
    sockets = [(s, b) for s in solids for b in s.balls if b.inner]
    found = []
    for solid, ball in balls:
        axis = _axis(solid, ball)
        for other, socket in sockets:
            gap = float(np.linalg.norm(ball.center - socket.center))
            alike = _LOOSEST * socket.radius <= ball.radius <= _TIGHTEST * socket.radius
            if other.index != solid.index and alike and gap < max(tolerance, 0.02 * ball.radius):
                shaft, bore = (_round(b, axis) for b in (ball, socket))
                found.append(Fit(solid.index, other.index, shaft, bore, ball.radius, gap))
    return found


def _round(ball: Ball, axis: Floats) -> Cyl:
    return Cyl(ball.center, axis, ball.radius, _HALF * ball.radius, 2.0 * math.pi, ball.inner)


def _axis(solid: Solid, ball: Ball) -> Floats:
    """The axis of the part that the ball is of, where it is turned about one through the ball; else from the ball to
    the part's middle."""
    line = solid.line
    if line is not None and line.off(ball.center) < 0.02 * ball.radius:
        return line.direction
    away = solid.center - ball.center
    return unit(away) if float(np.linalg.norm(away)) > 0.01 * ball.radius else np.array([0.0, 0.0, 1.0])
