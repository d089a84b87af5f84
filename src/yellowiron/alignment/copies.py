"""Parts that are drawn twice in one place, as exporters and artists leave them: one decides, the others follow."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from yellowiron.alignment.tolerances import CONTACT
from yellowiron.model.assembly import Assembly
from yellowiron.support.caching.remembered import remembered

CLOSE = 0.01
"""The boxes of copies differ by no more than this share of the part's size …"""
ALIKE = 0.02
"""… and their surfaces by no more than this share."""


@remembered
def copies_of(assembly: Assembly) -> dict[str, str]:
    """Part id → the id of the part that it is a copy of, in the same place; of several the first id counts, whatever
    their order. Parts without a mesh are copies of none."""
    parts = sorted((p for p in assembly.parts if len(assembly.shape_of(p).mesh.points)), key=lambda p: p.id)
    if len(parts) < 2:
        return {}
    points = [assembly.points_of(p) for p in parts]
    boxes = np.array([np.concatenate([p.min(axis=0), p.max(axis=0)]) for p in points])
    scales = [abs(float(np.linalg.det(p.transform[:3, :3]))) ** (2 / 3) for p in parts]
    areas = np.array([assembly.shape_of(p).area for p in parts]) * scales
    whole = float(np.linalg.norm(boxes[:, 3:].max(axis=0) - boxes[:, :3].min(axis=0)))
    reach = np.maximum(CLOSE * np.linalg.norm(boxes[:, 3:] - boxes[:, :3], axis=1), CONTACT[0] * whole)
    tree = cKDTree(boxes)
    found: dict[str, str] = {}
    for k, near in enumerate(tree.query_ball_point(boxes, reach, p=np.inf, return_sorted=True)):
        for other in near:
            same = other < k and abs(areas[k] - areas[other]) <= ALIKE * max(areas[k], areas[other])
            if same and parts[other].id not in found and parts[k].id not in found:
                found[parts[k].id] = parts[other].id
    return found
