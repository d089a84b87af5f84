"""Planar linkages by circles, as complex numbers: a solution that shares nothing with the solver's."""

from __future__ import annotations

import math

import numpy as np

from yellowiron.model.mechanism import Mechanism


def meet(one: complex, r: float, other: complex, s: float, near: complex) -> complex:
    """Where the circles of radius r about one point and s about another meet, on the side of `near`; metres."""
    apart = abs(other - one)
    along = (r * r - s * s + apart * apart) / (2.0 * apart)
    way = (other - one) / apart
    aside = 1j * way * math.sqrt(r * r - along * along)
    return min((one + along * way + aside, one + along * way - aside), key=lambda p: abs(p - near))


def strokes(mechanism: Mechanism, joint: str, count: int) -> list[float]:
    """So many coordinates of a joint, evenly from one of its limits to the other, metres or radians."""
    found = mechanism.joint(joint)
    assert found.lower is not None and found.upper is not None
    return [float(v) for v in np.linspace(found.lower, found.upper, count)]
