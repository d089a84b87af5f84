"""Convex pieces for engines that collide convex shapes only. What is hollow stays hollow.

Most parts of a machine are plates, flat or rolled: a profile drawn along a direction. Such a part is cut in its profile
(exact up to `EXCESS`) and each piece drawn along. Any other part becomes a shell: each flat facet is cut likewise and
given half the wall's thickness inwards, so that nothing outside the material is filled.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from yellowiron.model.geometry import Floats, Mesh

EXCESS = 0.03
"""Two pieces of a profile become one if their hull is larger than they are by this share at most."""
SMALL = 0.12
"""Metres: a part that fits in a ball of this diameter (a bolt, a grease fitting) is its hull."""
FILL = 0.9
"""A solid that fills this share of its hull is its hull."""
_FLAT = 1e-3
_SKIN = 1e-3
_PARALLEL = 1e-3
_OPEN_WALL = 5e-3


def hull(points: Floats) -> Mesh:
    """The convex hull of points (n, 3), triangles outwards; a flat cloud gets a millimetre of thickness on both
    sides."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        made = ConvexHull(points)
    except QhullError:
        points = _thickened(points)
        made = ConvexHull(points)
    used = np.unique(made.simplices)
    triangles = np.searchsorted(used, made.simplices).astype(np.int32)
    corners = points[used]
    inside = corners.mean(axis=0)
    a, b, c = (corners[triangles[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a - inside) < 0.0
    triangles[inward] = triangles[inward][:, ::-1]
    return Mesh(corners, triangles)


def _thickened(points: Floats) -> Floats:
    middle = points.mean(axis=0)
    _, sizes, axes = np.linalg.svd(points - middle, full_matrices=False)
    thin = axes[sizes <= max(1e-6 * float(sizes.max(initial=0.0)), 1e-9)]
    for axis in thin if len(thin) else axes[-1:]:
        points = np.concatenate([points + _SKIN * axis, points - _SKIN * axis])
    return points


def convex_pieces(mesh: Mesh) -> tuple[Mesh, ...]:
    """Convex meshes that together are as good as the given one. The same pieces for the same mesh."""
    points, triangles = mesh.points, mesh.triangles
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    whole = hull(points)
    if size <= SMALL or len(triangles) < 8 or _volume(mesh) >= FILL * _volume(whole):
        return (whole,)
    facets = _facets(points, triangles)
    direction = _extrusion(points, triangles, facets)
    if direction is not None:
        return tuple(hull(piece) for piece in _drawn(points, triangles, facets, direction))
    area = 0.5 * float(np.linalg.norm(_doubled_areas(points, triangles), axis=1).sum())
    wall = abs(_volume(mesh)) / area
    return tuple(hull(piece) for piece in _shell(points, triangles, facets, wall if wall > 1e-4 * size else _OPEN_WALL))


def _doubled_areas(points: Floats, triangles: np.ndarray) -> Floats:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def _volume(mesh: Mesh) -> float:
    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", np.cross(a, b), c)) / 6.0


def _facets(points: Floats, triangles: np.ndarray) -> list[np.ndarray]:
    """Connected triangles in one plane, as arrays of indices."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    crossed = _doubled_areas(points, triangles)
    length = np.linalg.norm(crossed, axis=1)
    normal = crossed / np.where(length > 0.0, length, 1.0)[:, None]
    edges: dict[tuple[int, int], list[int]] = {}
    for number, corners in enumerate(triangles.tolist()):
        for i, j in ((0, 1), (1, 2), (2, 0)):
            key = (min(corners[i], corners[j]), max(corners[i], corners[j]))
            edges.setdefault(key, []).append(number)
    pairs = [
        p for found in edges.values() if len(found) == 2 for p in [found] if normal[p[0]] @ normal[p[1]] > 1 - 1e-6
    ]
    rows = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    graph = coo_array((np.ones(len(rows)), (rows[:, 0], rows[:, 1])), shape=(len(triangles), len(triangles)))
    count, label = connected_components(graph, directed=False)
    order = np.argsort(label, kind="stable")
    bounds = np.searchsorted(label[order], np.arange(count + 1))
    facets = [order[a:b] for a, b in zip(bounds[:-1].tolist(), bounds[1:].tolist(), strict=True)]
    return [facet for facet in facets if length[facet].sum() > 1e-12]


def _facet_normals(points: Floats, triangles: np.ndarray, facets: Sequence[np.ndarray]) -> Floats:
    crossed = _doubled_areas(points, triangles)
    total = np.array([crossed[facet].sum(axis=0) for facet in facets])
    return np.asarray(total / np.linalg.norm(total, axis=1, keepdims=True), dtype=np.float64)


def _extrusion(points: Floats, triangles: np.ndarray, facets: Sequence[np.ndarray]) -> Floats | None:
    """The direction along which a closed part is drawn: every facet lies along it or is one of its two flat ends."""
    normals = _facet_normals(points, triangles, facets)
    areas = np.linalg.norm(_doubled_areas(points, triangles), axis=1)
    sizes = np.array([areas[facet].sum() for facet in facets])
    for direction in _directions(normals[np.argsort(-sizes, kind="stable")[:8]]):
        along = np.abs(normals @ direction)
        ends = along > 1.0 - _PARALLEL
        if not bool((ends | (along < _PARALLEL)).all()):
            continue
        height = points @ direction
        low, high = float(height.min()), float(height.max())
        levels = {
            (abs(level - low) < _FLAT, abs(level - high) < _FLAT)
            for facet in np.flatnonzero(ends).tolist()
            for level in [float(height[triangles[facets[facet]].ravel()].mean())]
        }
        if levels == {(True, False), (False, True)} and high - low > _FLAT:
            return np.asarray(direction, dtype=np.float64)
    return None


def _directions(normals: Floats) -> list[Floats]:
    """Directions along which a part may be drawn: its large facets' normals, and what is square to two of them."""
    square = [np.cross(normals[0], other) for other in normals[1:]]
    return [*normals, *(cross / np.linalg.norm(cross) for cross in square if np.linalg.norm(cross) > 0.1)]


def _drawn(points: Floats, triangles: np.ndarray, facets: Sequence[np.ndarray], direction: Floats) -> list[Floats]:
    """The profile's pieces (at the end that faces `direction`), drawn to the other end."""
    normals = _facet_normals(points, triangles, facets)
    height = points @ direction
    length = float(np.ptp(height))
    return [
        np.concatenate([piece, piece - length * direction])
        for facet, normal in zip(facets, normals, strict=True)
        if normal @ direction > 1.0 - _PARALLEL
        for piece in _patches(points, triangles[facet], direction)
    ]


def _shell(points: Floats, triangles: np.ndarray, facets: Sequence[np.ndarray], depth: float) -> list[Floats]:
    normals = _facet_normals(points, triangles, facets)
    return [
        np.concatenate([piece, piece - depth * normal])
        for facet, normal in zip(facets, normals, strict=True)
        for piece in _patches(points, triangles[facet], normal)
    ]


def _patches(points: Floats, triangles: np.ndarray, normal: Floats) -> list[Floats]:
    """A flat triangulation as few convex patches: neighbours are merged, the pair with the least excess first."""
    helper = np.eye(3)[int(np.argmin(np.abs(normal)))]
    x = np.cross(normal, helper)
    x /= np.linalg.norm(x)
    flat = np.column_stack([points @ x, points @ np.cross(normal, x)])
    members = {number: frozenset(corners) for number, corners in enumerate(triangles.tolist())}
    area = {number: _hull_area(flat, corners) for number, corners in members.items()}
    own = dict(area)
    by_edge: dict[tuple[int, int], list[int]] = {}
    for number, (a, b, c) in enumerate(triangles.tolist()):
        for edge in ((a, b), (b, c), (c, a)):
            by_edge.setdefault((min(edge), max(edge)), []).append(number)
    beside: dict[int, set[int]] = {number: set() for number in members}
    for found in by_edge.values():
        for one in found:
            beside[one].update(other for other in found if other != one)
    cost: dict[tuple[int, int], float] = {}

    def price(one: int, other: int) -> None:
        union = _hull_area(flat, members[one] | members[other])
        cost[min(one, other), max(one, other)] = union / max(own[one] + own[other], 1e-12) - 1.0

    for one in sorted(beside):
        for other in sorted(beside[one]):
            if one < other:
                price(one, other)
    while cost:
        pair = min(cost, key=lambda p: (cost[p], p))
        if cost[pair] > EXCESS:
            break
        keep, gone = pair
        members[keep] |= members.pop(gone)
        own[keep] += own.pop(gone)
        neighbours = (beside[keep] | beside.pop(gone)) - {keep, gone}
        beside[keep] = neighbours
        for old in [p for p in cost if gone in p or keep in p]:
            del cost[old]
        for other in sorted(neighbours):
            beside[other].discard(gone)
            beside[other].add(keep)
            price(keep, other)
    return [points[sorted(corners)] for _, corners in sorted(members.items())]


def _hull_area(flat: Floats, corners: frozenset[int]) -> float:
    """Area of the convex hull of points in the plane (Andrew's monotone chain)."""
    rows = sorted(map(tuple, flat[list(corners)].tolist()))

    def chain(ordered: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
        kept: list[tuple[float, ...]] = []
        for p in ordered:
            while len(kept) >= 2 and _turn(kept[-2], kept[-1], p) <= 0.0:
                kept.pop()
            kept.append(p)
        return kept

    ring = chain(rows)[:-1] + chain(rows[::-1])[:-1]
    return 0.5 * abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:] + ring[:1], strict=True)))


def _turn(a: tuple[float, ...], b: tuple[float, ...], c: tuple[float, ...]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
