"""Parts that are each other's mirror image about the machine's middle plane."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.spatial import KDTree

from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats

_NEAR, _ALIKE = 0.01, 0.05
"""Of the machine's size, how far a twin may be from its mirrored place; by what share its box may differ."""


def twins_of(assembly: Assembly, frame: Floats) -> dict[str, str]:
    """Part → its twin on the other side, for parts that have one; `frame` (4, 4) takes the CAD file's frame to the
    machine's, in which y is across. A part in the middle is its own and is left out."""
    ids, middles, sizes = [], [], []
    for part in assembly.parts:
        points = assembly.shape_of(part).mesh.points
        if len(points):
            place = np.asarray(frame) @ part.transform
            placed = points @ place[:3, :3].T + place[:3, 3]
            ids.append(part.id)
            middles.append(0.5 * (placed.min(axis=0) + placed.max(axis=0)))
            sizes.append(np.ptp(placed, axis=0))
    if not ids:
        return {}
    at, extent = np.array(middles), np.array(sizes)
    reach = _NEAR * float(np.linalg.norm(np.ptp(at, axis=0)) or 1.0)
    around: Any = KDTree(at).query_ball_point(at * (1.0, -1.0, 1.0), reach)
    found = {}
    for k, near in enumerate(around):
        alike = [
            n for n in near
            if n != k and np.abs(extent[n] - extent[k]).max() <= _ALIKE * max(float(extent[k].max()), 1e-9)
        ]  # fmt: skip
        if alike:
            mirror = at[k] * (1.0, -1.0, 1.0)
            found[ids[k]] = ids[min(alike, key=lambda n: (float(np.linalg.norm(at[n] - mirror)), ids[n]))]
    return found
