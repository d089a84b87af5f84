"""Where a machine turns about, and whether it turns at all."""

from __future__ import annotations

import itertools

import numpy as np

from yellowiron.model.geometry import Floats

_PARALLEL = 1e-3
"""Axes whose sine is less do not meet."""


_SAME = 0.5
"""Wheels are turned one way if each is by this share of what the most turned one is."""


def crabs(headings: Floats) -> bool:
    """Whether wheels that are turned to the left by `headings` (n,) are all turned one way, so that the machine goes
    that way and does not turn."""
    most = float(headings[np.argmax(np.abs(headings))])
    return most != 0.0 and float((headings / most).min()) > _SAME


def turning_centre(places: Floats, axes: Floats) -> Floats:
    """The middle (2,) of the turn, seen from above, of wheels at `places` (n, 2) whose unit `axes` (n, 2) are steered.

    Where all axes meet there. Where they do not, as those of two axles behind each other, wheels slide sideways by
    their axis's distance from the middle, and dry friction resists alike whatever the speed: equally loaded, they turn
    about the meeting point of two axes at which all of them slide least for the way they roll. That is on the last
    axle of a bogie. Without such a point: where the axes come nearest (least squares).
    """
    normals = np.column_stack([-axes[:, 1], axes[:, 0]])
    offsets = np.sum(normals * places, axis=1)
    best: tuple[float, Floats] | None = None
    for a, b in itertools.combinations(range(len(axes)), 2):
        pair = normals[[a, b]]
        if abs(float(np.linalg.det(pair))) < _PARALLEL:
            continue
        middle = np.linalg.solve(pair, offsets[[a, b]])
        slide = float(np.abs(normals @ middle - offsets).sum() / np.linalg.norm(places - middle, axis=1).sum())
        if best is None or slide < best[0]:
            best = slide, middle
    if best is not None:
        return np.asarray(best[1], dtype=np.float64)
    return np.asarray(np.linalg.lstsq(normals, offsets, rcond=None)[0], dtype=np.float64)
