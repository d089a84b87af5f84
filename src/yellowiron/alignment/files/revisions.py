"""Parts of an earlier revision of a CAD model in a later one: by shape and place, not by name or number.

A part's print is its shape's measures, which no motion changes, and its place. The later model may be moved as a whole
(the motion is found from shapes that are there once), its parts renamed, reordered, added, removed, slightly changed.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats, Mesh

SAME = 2e-3
"""Shapes whose measures all differ by less than this share are the same."""
ALIKE = 0.25
"""… and by less than this, alike: a part that was changed."""
THERE = 2e-3
"""A part within this share of the machine's size of where it was is in its place …"""
NEAR = 0.03
"""… and within this, near it."""
ANCHORS = 14
"""So many parts, the largest that are there once, are tried for the motion, three at a time."""
NEAREST = 12
DIGITS = 6


@dataclass(frozen=True)
class Print:
    """What a part is known by: `shape`, lengths in metres (root of the area, cube root of the volume, three radii of
    gyration of the surface), and `place`, the surface's centre of area in the CAD file's frame, metres."""

    shape: tuple[float, ...]
    place: tuple[float, float, float]


def prints_of(assembly: Assembly) -> dict[str, Print]:
    """Part id → its print, for the parts with a mesh."""
    known = {key: _moments(s.mesh) for key, s in assembly.shapes.items() if len(s.mesh.triangles)}
    found = {}
    for part in assembly.parts:
        if part.shape not in known:
            continue
        centre, radii = known[part.shape]
        shape = assembly.shapes[part.shape]
        matrix = part.transform[:3, :3]
        scale = abs(float(np.linalg.det(matrix))) ** (1 / 3)
        lengths = (np.sqrt(shape.area), np.cbrt(abs(shape.volume)), *radii)
        x, y, z = (round(float(v), DIGITS) + 0.0 for v in matrix @ centre + part.transform[:3, 3])
        found[part.id] = Print(tuple(float(f"{scale * v:.{DIGITS}g}") for v in lengths), (x, y, z))
    return found


def _moments(mesh: Mesh) -> tuple[Floats, Floats]:
    """Centre of area (3,) and principal radii of gyration (3,) of a mesh's surface, metres."""
    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    total = float(area.sum()) or 1.0
    middle = (a + b + c) / 3
    centre = np.asarray(area @ middle / total)
    spread = np.zeros((3, 3))
    for corner in (a, b, c):  # ∫xxᵀ over a triangle: area / 12 · (Σ corners' xxᵀ + 9 · middle's)
        spread += np.einsum("i,ij,ik->jk", area / 12, corner - centre, corner - centre)
    spread += np.einsum("i,ij,ik->jk", 0.75 * area, middle - centre, middle - centre)
    return centre, np.sqrt(np.maximum(np.linalg.eigvalsh(spread / total), 0.0))


def match_parts(earlier: Mapping[str, Print], later: Mapping[str, Print]) -> dict[str, str]:
    """Earlier part id → later part id, one to one, for the parts that are found again. Surest first: the same shape in
    its place; the same id with the same shape; a shape that is there once; then changed parts near their place."""
    if not earlier or not later:
        return {}
    old, new = sorted(earlier), sorted(later)
    shapes = [_logs([earlier[i].shape for i in old]), _logs([later[i].shape for i in new])]
    places = [np.array([earlier[i].place for i in old]), np.array([later[i].place for i in new])]
    size = max(float(np.linalg.norm(np.ptp(places[1], axis=0))), 1e-9)
    turn, shift = _motion(shapes, places, THERE * size)
    went = places[0] @ turn.T + shift
    found: dict[int, int] = {}

    def take(pairs: Sequence[tuple[float, int, int]]) -> None:
        taken = set(found.values())
        for _, i, j in sorted(pairs):
            if i not in found and j not in taken:
                found[i] = j
                taken.add(j)

    def pairs(limit: float, alike: float) -> list[tuple[float, int, int]]:
        """Candidates (cost, old, new) near each other; a shared id halves the cost."""
        taken = set(found.values())
        free = [j for j in range(len(new)) if j not in taken]
        open_ = [i for i in range(len(old)) if i not in found]
        if not free or not open_:
            return []
        # Most alignments are read of the model they were written of: they need none of it.
        from scipy.spatial import cKDTree

        # Places in sizes and shapes in shares of what is allowed: one ball holds both.
        scale = np.concatenate([np.full(3, 1 / (limit * size)), np.full(shapes[0].shape[1], 1 / alike)])
        tree = cKDTree(np.hstack([places[1][free], shapes[1][free]]) * scale)
        asked = np.hstack([went[open_], shapes[0][open_]]) * scale
        nearest = list(range(1, min(NEAREST, len(free)) + 1))
        away, at = (np.asarray(r) for r in tree.query(asked, k=nearest, p=np.inf, distance_upper_bound=1.0))
        return [
            (float(d) * (0.5 if old[open_[i]] == new[free[j]] else 1.0), open_[i], free[j])
            for i, (ds, js) in enumerate(zip(away, at, strict=True))
            for d, j in zip(ds, js, strict=True)
            if np.isfinite(d)
        ]

    take(pairs(THERE, SAME))
    number = {part: j for j, part in enumerate(new)}
    named = [(i, number[part]) for i, part in enumerate(old) if part in number]
    take([(0.0, i, j) for i, j in named if np.abs(shapes[0][i] - shapes[1][j]).max() < SAME])
    take([(0.0, i, j) for i, j in _once(shapes)])
    take(pairs(NEAR, ALIKE))
    take([(0.0, i, j) for i, j in named if np.abs(shapes[0][i] - shapes[1][j]).max() < ALIKE])
    return {old[i]: new[j] for i, j in sorted(found.items())}


def _logs(shapes: Sequence[tuple[float, ...]]) -> Floats:
    """(n, 5): differences are shares. Nothing is less than a thousandth of the part: flat parts have no thickness."""
    values = np.array(shapes, dtype=np.float64)
    return np.asarray(np.log(np.maximum(values, 1e-3 * values.max(axis=1, keepdims=True) + 1e-12)))


def _once(shapes: Sequence[Floats]) -> list[tuple[int, int]]:
    """Pairs of the same shape that each model has once."""
    from scipy.spatial import cKDTree

    trees = [cKDTree(s) for s in shapes]
    alone = [
        {i for i, n in enumerate(np.atleast_1d(t.query_ball_point(s, SAME, p=np.inf, return_length=True))) if n == 1}
        for t, s in zip(trees, shapes, strict=True)
    ]
    away, at = (np.asarray(r) for r in trees[1].query(shapes[0], p=np.inf))
    return [(i, int(at[i])) for i in sorted(alone[0]) if away[i] < SAME and int(at[i]) in alone[1]]


def _motion(shapes: Sequence[Floats], places: Sequence[Floats], there: float) -> tuple[Floats, Floats]:
    """The rigid motion (3, 3), (3,) of the machine as a whole between two revisions; none if it stayed, or if the
    parts do not tell."""
    stayed = (np.eye(3), np.zeros(3))
    pairs = _once(shapes)
    if len(pairs) < 3:
        return stayed
    i, j = (np.array(k) for k in zip(*pairs, strict=True))
    a, b = places[0][i], places[1][j]

    def held(motion: tuple[Floats, Floats]) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        return np.asarray(np.linalg.norm(a @ motion[0].T + motion[1] - b, axis=1) < there)

    best, most = stayed, held(stayed)
    if most.mean() > 0.5:
        return stayed
    largest = np.argsort(-shapes[0][i][:, 0], kind="stable")[:ANCHORS]
    for three in itertools.combinations(largest.tolist(), 3):
        motion = _fitted(a[list(three)], b[list(three)])
        holds = held(motion)
        if holds[list(three)].all() and holds.sum() > most.sum():
            best, most = motion, holds
    return _fitted(a[most], b[most]) if most.sum() > 3 else best


def _fitted(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """The rotation and shift that take points `a` nearest to `b` (Kabsch's method)."""
    middle, target = a.mean(axis=0), b.mean(axis=0)
    u, _, vt = np.linalg.svd((a - middle).T @ (b - target))
    turn = vt.T @ np.diag([1.0, 1.0, float(np.sign(np.linalg.det(vt.T @ u.T)))]) @ u.T
    return turn, target - turn @ middle
