"""Convex pieces for engines that collide convex shapes only. What is hollow stays hollow.

Most parts of a machine are plates, flat or rolled: a profile drawn along a direction. Such a part is cut in its profile
(exact up to `EXCESS`) and each piece drawn along. Any other part becomes a shell: each flat facet is cut likewise and
given half the wall's thickness inwards, so that nothing outside the material is filled; where that gives too many
pieces, facets that are nearly flat together count as one.

Pieces are kept on disk by the mesh's content (`yellowiron.support.caching.disk`).
"""

from __future__ import annotations

import functools
import hashlib
import heapq
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.geometry import Floats, Mesh
from yellowiron.support.caching.disk import remember

EXCESS = 0.03
"""Two pieces of a profile become one if their hull is larger than they are by this share at most."""
SMALL = 0.12
"""Metres: a part that fits in a ball of this diameter (a bolt, a grease fitting) is its hull."""
FILL = 0.9
"""A solid that fills this share of its hull is its hull."""
MOST = 128
"""Pieces of a part: more are a burden to every engine, and coarser ones are tried."""
COARSER = ((0.08, EXCESS), (10.0, 0.1), (20.0, math.inf))
"""Degrees by which a facet's triangles may differ from its largest one, and the excess of its pieces, finest first."""
_FLAT = 1e-3
_SKIN = 1e-3
_PARALLEL = 1e-3
_OPEN_WALL = 5e-3


def hull(points: Floats) -> Mesh:
    """The convex hull of points (n, 3), triangles outwards; a flat cloud, a line or a point gets a millimetre of
    thickness on both sides, whichever way it has none."""
    from scipy.spatial import ConvexHull, QhullError

    thin, axes = _thin_ways(points)
    # Of points that rounding has put out of their plane the library makes a hull with two sides and no rim.
    points = _thickened(points, thin)
    try:
        made = ConvexHull(points)
    except QhullError:
        points = _thickened(points, axes[-1:])
        made = ConvexHull(points)
    used = np.zeros(len(points), dtype=bool)
    used[made.simplices] = True
    triangles = (np.cumsum(used) - 1)[made.simplices].astype(np.int32)
    corners = points[used]
    inside = corners.mean(axis=0)
    a, b, c = (corners[triangles[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a - inside) < 0.0
    triangles[inward] = triangles[inward][:, ::-1]
    return Mesh(corners, triangles)


def _thin_ways(points: Floats) -> tuple[Floats, Floats]:
    """The directions (k, 3) in which points (n, 3) have no extent, and all three, the longest first."""
    # With three rows of zeros a cloud of one or two points has three directions, too.
    cloud = np.concatenate([points - points.mean(axis=0), np.zeros((3, 3))])
    _, sizes, axes = np.linalg.svd(cloud, full_matrices=False)
    return axes[sizes <= max(1e-6 * float(sizes.max(initial=0.0)), 1e-9)], axes


def _thickened(points: Floats, ways: Floats) -> Floats:
    for way in ways:
        points = np.concatenate([points + _SKIN * way, points - _SKIN * way])
    return points


def convex_pieces(mesh: Mesh) -> tuple[Mesh, ...]:
    """Convex meshes that together are as good as the given one, whose triangles share their corners. The same pieces
    for the same mesh."""
    points, triangles, ends = remember("convex", _key(mesh), lambda: _pack(_cut(mesh)))
    starts = np.concatenate([[(0, 0)], ends[:-1]]).tolist()
    return tuple(Mesh(points[p:q], triangles[t:u]) for (p, t), (q, u) in zip(starts, ends.tolist(), strict=True))


def _key(mesh: Mesh) -> str:
    """Stands for the mesh, for this module with its settings, and for the libraries that it cuts with."""
    digest = hashlib.sha256(_method())
    for array in (mesh.points, mesh.triangles):
        digest.update(f"{array.dtype.str}{array.shape}".encode())
        digest.update(np.ascontiguousarray(array).tobytes())
    return digest.hexdigest()


@functools.cache
def _method() -> bytes:
    import scipy

    return Path(__file__).read_bytes() + f"{np.__version__} {scipy.__version__}".encode()


def _pack(pieces: Sequence[Mesh]) -> tuple[NDArray[Any], ...]:
    """Points, triangles, and where each piece ends in both."""
    ends = np.cumsum([(len(piece.points), len(piece.triangles)) for piece in pieces], axis=0)
    return np.concatenate([p.points for p in pieces]), np.concatenate([p.triangles for p in pieces]), ends


def _cut(mesh: Mesh) -> tuple[Mesh, ...]:
    points, triangles = mesh.points, mesh.triangles
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    whole = hull(points)
    if size <= SMALL or len(triangles) < 8 or _volume(mesh) >= FILL * _volume(whole):
        return (whole,)
    area = 0.5 * float(np.linalg.norm(_doubled_areas(points, triangles), axis=1).sum())
    wall = abs(_volume(mesh)) / area
    depth = wall if wall > 1e-4 * size else _OPEN_WALL
    facets = _facets(points, triangles, math.radians(COARSER[0][0]))
    direction = _extrusion(points, triangles, facets)
    pieces: list[Floats] = []
    for angle, excess in COARSER:
        if direction is not None:
            pieces = _drawn(points, triangles, facets, direction, excess)
        else:
            if angle > COARSER[0][0]:
                facets = _facets(points, triangles, math.radians(angle), least=area / MOST)
            if len(facets) <= MOST or math.isinf(excess):
                pieces = _shell(points, triangles, facets, depth, excess)
        if 0 < len(pieces) <= MOST:
            break
    return tuple(hull(piece) for piece in pieces)


def _doubled_areas(points: Floats, triangles: np.ndarray) -> Floats:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def _volume(mesh: Mesh) -> float:
    """m³, about the points' mean: then a mesh with cracks or a hole errs by what is missing, wherever it lies."""
    points = mesh.points - mesh.points.mean(axis=0)
    a, b, c = (points[mesh.triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->", np.cross(a, b), c)) / 6.0


def _facets(points: Floats, triangles: np.ndarray, angle: float, *, least: float = 0.0) -> list[np.ndarray]:
    """Connected triangles as arrays of indices: grown from the largest triangle on, over neighbours that are turned
    from it by no more than the angle. Those under the `least` area go to the neighbour with the longest common edge."""
    crossed = _doubled_areas(points, triangles)
    length = np.linalg.norm(crossed, axis=1)
    normal = crossed / np.where(length > 0.0, length, 1.0)[:, None]
    edges: dict[tuple[int, int], list[int]] = {}
    for number, corners in enumerate(triangles.tolist()):
        for i, j in ((0, 1), (1, 2), (2, 0)):
            key = (min(corners[i], corners[j]), max(corners[i], corners[j]))
            edges.setdefault(key, []).append(number)
    shared = {edge: found for edge, found in edges.items() if len(found) == 2}
    beside: list[list[int]] = [[] for _ in range(len(triangles))]
    for one, other in shared.values():
        beside[one].append(other)
        beside[other].append(one)
    taken = length <= 1e-12
    facets: list[list[int]] = []
    for seed in np.argsort(-length, kind="stable").tolist():
        if taken[seed]:
            continue
        near = normal @ normal[seed] >= math.cos(angle)
        taken[seed] = True
        facet = [seed]
        for number in facet:  # it grows on the way
            for other in beside[number]:
                if not taken[other] and near[other]:
                    taken[other] = True
                    facet.append(other)
        facets.append(facet)
    if least > 0.0:
        facets = _absorbed(facets, points, shared, 0.5 * length, least)
    return [np.array(sorted(facet), dtype=np.int64) for facet in facets]


def _absorbed(
    facets: list[list[int]], points: Floats, shared: dict[tuple[int, int], list[int]], area: Floats, least: float
) -> list[list[int]]:
    """Without facets under an area, as far as they have neighbours: the smallest is absorbed first."""
    owner = {number: index for index, facet in enumerate(facets) for number in facet}
    common: list[dict[int, float]] = [{} for _ in facets]
    for (i, j), (one, other) in shared.items():
        a, b = owner.get(one, -1), owner.get(other, -1)
        if a != b and min(a, b) >= 0:
            for here, there in ((a, b), (b, a)):
                common[here][there] = common[here].get(there, 0.0) + math.dist(points[i], points[j])
    sizes = [float(area[facet].sum()) for facet in facets]
    queue = [(size, index) for index, size in enumerate(sizes) if size < least]
    heapq.heapify(queue)
    while queue:
        size, small = heapq.heappop(queue)
        if size != sizes[small] or not common[small]:
            continue
        host = max(common[small], key=lambda other: (common[small][other], -other))
        facets[host] += facets[small]
        sizes[host] += size
        sizes[small] = -1.0
        for other, edge in common[small].items():
            del common[other][small]
            if other != host:
                common[host][other] = common[other][host] = common[host].get(other, 0.0) + edge
        if sizes[host] < least:
            heapq.heappush(queue, (sizes[host], host))
    return [facet for facet, size in zip(facets, sizes, strict=True) if size >= 0.0]


def _facet_normals(points: Floats, triangles: np.ndarray, facets: Sequence[np.ndarray]) -> Floats:
    crossed = _doubled_areas(points, triangles)
    total = np.array([crossed[facet].sum(axis=0) for facet in facets])
    for row in np.flatnonzero(np.linalg.norm(total, axis=1) <= 1e-12).tolist():
        # Sheets drawn from both sides, one facet since they share an edge, cancel out.
        facet = facets[row]
        total[row] = crossed[facet[int(np.argmax(np.linalg.norm(crossed[facet], axis=1)))]]
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
        solid = 0.5 * sizes[ends & (normals @ direction > 0.0)].sum() * (high - low)
        whole = abs(_volume(Mesh(points, triangles))) > 0.99 * solid  # a box of sheets without a lid has less
        if levels == {(True, False), (False, True)} and high - low > _FLAT and whole:
            return np.asarray(direction, dtype=np.float64)
    return None


def _directions(normals: Floats) -> list[Floats]:
    """Directions along which a part may be drawn: its large facets' normals, and what is square to two of them."""
    square = [np.cross(normals[0], other) for other in normals[1:]]
    return [*normals, *(cross / np.linalg.norm(cross) for cross in square if np.linalg.norm(cross) > 0.1)]


def _drawn(
    points: Floats, triangles: np.ndarray, facets: Sequence[np.ndarray], direction: Floats, excess: float
) -> list[Floats]:
    """The profile's pieces (at the end that faces `direction`), drawn to the other end."""
    normals = _facet_normals(points, triangles, facets)
    height = points @ direction
    length = float(np.ptp(height))
    return [
        np.concatenate([piece, piece - length * direction])
        for facet, normal in zip(facets, normals, strict=True)
        if normal @ direction > 1.0 - _PARALLEL
        for piece in _patches(points, triangles[facet], direction, excess)
    ]


def _shell(
    points: Floats, triangles: np.ndarray, facets: Sequence[np.ndarray], depth: float, excess: float
) -> list[Floats]:
    normals = _facet_normals(points, triangles, facets)
    return [
        np.concatenate([piece, piece - depth * normal])
        for facet, normal in zip(facets, normals, strict=True)
        for piece in _patches(points, triangles[facet], normal, excess)
    ]


def _patches(points: Floats, triangles: np.ndarray, normal: Floats, excess: float) -> list[Floats]:
    """A flat triangulation as few convex patches: neighbours are merged, the pair with the least excess first."""
    if math.isinf(excess):
        return [points[np.unique(triangles)]]
    helper = np.eye(3)[int(np.argmin(np.abs(normal)))]
    x = np.cross(normal, helper)
    x /= np.linalg.norm(x)
    flat = np.column_stack([points @ x, points @ np.cross(normal, x)]).tolist()
    members = {number: _ring(flat, corners) for number, corners in enumerate(triangles.tolist())}
    own = {number: _area(flat, ring) for number, ring in members.items()}
    by_edge: dict[tuple[int, int], list[int]] = {}
    for number, (a, b, c) in enumerate(triangles.tolist()):
        for edge in ((a, b), (b, c), (c, a)):
            by_edge.setdefault((min(edge), max(edge)), []).append(number)
    beside: dict[int, set[int]] = {number: set() for number in members}
    for found in by_edge.values():
        for one in found:
            beside[one].update(other for other in found if other != one)
    queue: list[tuple[float, int, int, list[int]]] = []
    age = dict.fromkeys(members, 0)

    def price(one: int, other: int) -> None:
        first, second = min(one, other), max(one, other)
        union = _ring(flat, members[first] + members[second])
        cost = _area(flat, union) / max(own[first] + own[second], 1e-12) - 1.0
        if cost <= excess:
            heapq.heappush(queue, (cost, first, second, [age[first], age[second], *union]))

    for one in sorted(beside):
        for other in sorted(beside[one]):
            if one < other:
                price(one, other)
    while queue:
        _, keep, gone, (kept, left, *union) = heapq.heappop(queue)
        if gone not in members or keep not in members or (age[keep], age[gone]) != (kept, left):
            continue
        members[keep] = union
        del members[gone]
        age[keep] += 1
        own[keep] += own.pop(gone)
        beside[keep] = (beside[keep] | beside.pop(gone)) - {keep, gone}
        for other in sorted(beside[keep]):
            beside[other].discard(gone)
            beside[other].add(keep)
            price(keep, other)
    return [points[sorted(ring)] for _, ring in sorted(members.items())]


def _ring(flat: list[list[float]], corners: Sequence[int]) -> list[int]:
    """The corners of the convex hull of points in the plane, around (Andrew's monotone chain)."""
    order = sorted(set(corners), key=lambda corner: flat[corner])

    def chain(ordered: list[int]) -> list[int]:
        kept: list[int] = []
        for corner in ordered:
            while len(kept) >= 2 and _turn(flat[kept[-2]], flat[kept[-1]], flat[corner]) <= 0.0:
                kept.pop()
            kept.append(corner)
        return kept

    return chain(order)[:-1] + chain(order[::-1])[:-1]


def _area(flat: list[list[float]], ring: Sequence[int]) -> float:
    """m² inside a ring of corners."""
    rows = [flat[corner] for corner in ring]
    return 0.5 * abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(rows, rows[1:] + rows[:1], strict=True)))


def _turn(a: Sequence[float], b: Sequence[float], c: Sequence[float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
