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
_MIDST = 1.5
"""A ball is a collar where its part reaches farther than so many radii to both sides."""


def ball_fits_of(solids: tuple[Solid, ...], tolerance: float) -> list[Fit]:
    """Every ball in a socket of another part, concentric with it."""
    balls = [(s, b) for s in solids for b in s.balls if not b.inner]
    sockets = [(s, b) for s in solids for b in s.balls if b.inner]
    found = []
    for solid, ball in balls:
        for other, socket in sockets:
            gap = float(np.linalg.norm(ball.center - socket.center))
            alike = _LOOSEST * socket.radius <= ball.radius <= _TIGHTEST * socket.radius
            if other.index != solid.index and alike and gap < max(tolerance, 0.02 * ball.radius):
                axis = _axis(solid, ball, other)
                shaft, bore = (_round(b, axis) for b in (ball, socket))
                found.append(Fit(solid.index, other.index, shaft, bore, ball.radius, gap))
    return found


def is_ball(fit: Fit, inner: Solid) -> bool:
    """Whether what sits in a fit's bore is a ball of its part (`inner`)."""
    return any(
        not ball.inner and ball.radius == fit.shaft.radius and np.array_equal(ball.center, fit.shaft.center)
        for ball in inner.balls
    )


def _round(ball: Ball, axis: Floats) -> Cyl:
    return Cyl(ball.center, axis, ball.radius, _HALF * ball.radius, 2.0 * math.pi, ball.inner)


def _axis(solid: Solid, ball: Ball, other: Solid) -> Floats:
    """The axis of the part that the ball is of, where it is turned about one through the ball; across that where the
    ball is a collar in its midst, as on a cylinder's barrel, as the pins of a gimbal lie; else from the ball to the
    part's middle."""
    tube = _through(solid, ball)
    if tube is not None:
        return _across(tube.direction, other.center - ball.center)
    line = solid.line
    if line is not None and line.off(ball.center) < 0.02 * ball.radius:
        return line.direction
    away = solid.center - ball.center
    return unit(away) if float(np.linalg.norm(away)) > 0.01 * ball.radius else np.array([0.0, 0.0, 1.0])


def _through(solid: Solid, ball: Ball) -> Cyl | None:
    """The longest round face of a part about a line through its ball, to both sides of that; None for a ball at an
    end."""
    found = []
    for face in solid.cylinders if not ball.inner else ():
        low, high = face.interval(ball.center, face.direction)
        if face.full and face.off(ball.center) < 0.02 * ball.radius and min(-low, high) > _MIDST * ball.radius:
            found.append(face)
    return max(found, key=lambda face: face.half, default=None)


def _across(line: Floats, towards: Floats) -> Floats:
    """Across a line, and across the way to what holds the ball."""
    found = np.cross(line, towards)
    if float(np.linalg.norm(found)) < 1e-6:
        found = np.cross(line, np.eye(3)[int(np.argmin(np.abs(line)))])
    return unit(found)
