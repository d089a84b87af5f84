"""What is in doubt of an alignment: not part by part, the most consequential first, with what else it could be."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template
from yellowiron.support.graphs import components

BESIDE = 0.01
"""Boxes no farther from each other than this share of the machine's size lie together."""


@dataclass(frozen=True)
class Doubt:
    """`parts` in doubt that were given one `body` (None: no part of the machine). `others`: bodies that they could be
    instead, the likeliest first; `weight` says how much hangs on it, `reason` why they were given theirs."""

    body: str | None
    runner_up: str | None
    parts: tuple[str, ...]
    others: tuple[str, ...]
    weight: float
    reason: str


def doubts_of(alignment: Alignment, template: Template, boxes: Mapping[str, Floats]) -> list[Doubt]:
    """Parts to review together where they were given the same body and could be the same other one; `template` has its
    variants decided. `boxes`: part → its (2, 3) box in the CAD file's frame, metres, by which what is near could be it
    first."""
    doubted = set(alignment.to_review)
    together: dict[tuple[str, str], list[PartAssignment]] = {}
    for part in alignment.parts:
        if part.part in doubted:
            together.setdefault((part.body or "", part.runner_up or ""), []).append(part)
    joints = Counter(body for joint in template.joints for body in template.bodies_of(joint))
    whole = sum(spread(box) for box in boxes.values()) or 1.0
    found = []
    for (body, other), parts in sorted(together.items()):
        doubt = 1.0 - float(np.mean([p.confidence for p in parts]))
        share = sum(spread(boxes[p.part]) for p in parts if p.part in boxes) / whole
        least = min(parts, key=lambda p: (p.confidence, p.part))
        near = _nearest([p.part for p in parts], alignment, boxes)
        listed = dict.fromkeys([*([other] if other and template.knows(other) else []), *near])
        found.append(
            Doubt(
                body or None,
                other or None,
                tuple(sorted(p.part for p in parts)),
                tuple(role for role in listed if role != body),
                doubt * (1.0 + joints[body]) + share,
                least.reason,
            )
        )
    return found


def apart(doubts: Sequence[Doubt], boxes: Mapping[str, Floats]) -> list[Doubt]:
    """The doubts taken apart into what lies together, the weightiest first; what has no box is left out. Each has that
    share of the weight which it is of the machine: a beam comes before its bolts."""
    whole = sum(spread(box) for box in boxes.values()) or 1.0
    found = []
    for doubt in doubts:
        for piece in _lying_together([part for part in doubt.parts if part in boxes], boxes):
            share = sum(spread(boxes[part]) for part in piece) / whole
            found.append(replace(doubt, parts=piece, weight=doubt.weight * share))
    return sorted(found, key=lambda doubt: (-doubt.weight, doubt.parts))


def boxes_of(assembly: Assembly) -> dict[str, Floats]:
    """Part → its (2, 3) box in the CAD file's frame; parts without a mesh have none."""
    own = {
        key: np.array([shape.mesh.points.min(axis=0), shape.mesh.points.max(axis=0)])
        for key, shape in assembly.shapes.items()
        if len(shape.mesh.triangles)
    }
    corners = np.array([[(k >> axis) & 1 for axis in range(3)] for k in range(8)])
    found = {}
    for part in assembly.parts:
        if part.shape in own:
            points = np.take_along_axis(own[part.shape], corners, axis=0)
            placed = points @ part.transform[:3, :3].T + part.transform[:3, 3]
            found[part.id] = np.array([placed.min(axis=0), placed.max(axis=0)])
    return found


def size_of(boxes: Mapping[str, Floats]) -> float:
    """Metres across all boxes."""
    if not boxes:
        return 1.0
    corners = np.array(list(boxes.values())).reshape(-1, 3)
    return float(np.linalg.norm(np.ptp(corners, axis=0))) or 1.0


def spread(box: Floats) -> float:
    """The surface of a box, m²: how much of the machine a part is."""
    a, b, c = box[1] - box[0]
    return float(2.0 * (a * b + b * c + c * a))


def _lying_together(parts: Sequence[str], boxes: Mapping[str, Floats]) -> list[tuple[str, ...]]:
    """Parts in groups whose boxes touch, or nearly."""
    reach = BESIDE * size_of(boxes)
    low, high = (np.array([boxes[part][end] for part in parts]).reshape(-1, 3) for end in (0, 1))
    touching = (
        (parts[k], parts[k + 1 + int(other)])
        for k in range(len(parts))
        for other in np.flatnonzero(_gaps(low[k + 1 :], high[k + 1 :], low[k], high[k]) <= reach)
    )
    return components(parts, touching)


def _nearest(parts: Sequence[str], alignment: Alignment, boxes: Mapping[str, Floats]) -> list[str]:
    """Bodies by their distance from some parts, the nearest first."""
    mine = [boxes[p] for p in parts if p in boxes]
    if not mine:
        return []
    low, high = np.min([b[0] for b in mine], axis=0), np.max([b[1] for b in mine], axis=0)
    own = set(parts)
    gaps: dict[str, float] = {}
    for part in alignment.parts:
        if part.body is not None and part.part not in own and part.part in boxes:
            box = boxes[part.part]
            gap = float(_gaps(box[0], box[1], low, high))
            gap += 1e-3 * float(np.linalg.norm(box.mean(axis=0) - 0.5 * (low + high)))
            gaps[part.body] = min(gap, gaps.get(part.body, np.inf))
    return sorted(gaps, key=lambda body: (gaps[body], body))


def _gaps(low: Floats, high: Floats, other_low: Floats, other_high: Floats) -> Floats:
    """How far boxes (…, 3) are from another one, metres."""
    return np.asarray(np.linalg.norm(np.maximum(0.0, np.maximum(low - other_high, other_low - high)), axis=-1))
