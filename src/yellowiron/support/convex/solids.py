"""Convex solids by their planes: what lies inside them, how far what they do not cover stands out, fewer of them."""

from __future__ import annotations

import functools
import heapq
import itertools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.geometry import Floats, Mesh
from yellowiron.support.convex.pieces import hull

CORNERS = 64
"""Of a hull: PhysX cooks no more for a GPU."""
THINNEST = 5e-3
"""Metres: a hull that is thinner is given this thickness; thinner ones are flat to some engines."""
OBLONG = 90.0
"""Times the radius of the ball in a hull: half as long may the box in it be. PhysX cooks none for a GPU with 100
(`checkExtentRadiusRatio` of its cooking)."""
_SPACING = 2.0
"""Points by which a surface is judged are this many tolerances apart at most …"""
_FINEST = 0.02
"""… and no less than this, metres."""
_SLIVER = 1e-9
"""Metres: what is no higher than this has no direction."""
_ROUGH = 1.0
"""Metres apart: no more than a triangle's middle, but where it is large."""
_MOST = 12
"""Points along a triangle's edge."""


@dataclass(frozen=True, eq=False)
class Convex:
    """A convex solid, metres: its `corners` (n, 3), `triangles` (m, 3) outwards, and `planes` (k, 4): a point x is
    inside where planes[:, :3] @ x + planes[:, 3] ≤ 0. `low` and `high` are the corners of its box."""

    corners: Floats
    triangles: NDArray[np.int32]
    planes: Floats
    volume: float

    @functools.cached_property
    def low(self) -> Floats:
        """(3,) metres."""
        return np.asarray(self.corners.min(axis=0))

    @functools.cached_property
    def high(self) -> Floats:
        """(3,) metres."""
        return np.asarray(self.corners.max(axis=0))

    @property
    def mesh(self) -> Mesh:
        """Its surface."""
        return Mesh(self.corners, self.triangles)

    def beyond(self, points: Floats) -> Floats:
        """(n,) metres by which points (n, 3) are outside its farthest plane, negative inside: over a face that is the
        distance, over an edge or a corner less."""
        # A row a plane: of rows a point, each as short as there are planes, the largest takes ten times as long.
        return np.asarray((self.planes[:, :3] @ points.T + self.planes[:, 3:]).max(axis=0), dtype=np.float64)

    def shifted(self, by: Floats) -> Convex:
        """The solid moved by (3,) metres."""
        planes = self.planes.copy()
        planes[:, 3] -= planes[:, :3] @ by
        return Convex(self.corners + by, self.triangles, planes, self.volume)

    def surface(self, spacing: float) -> Floats:
        """(n, 3) points on its surface, corners among them, `spacing` metres apart at most (large faces: coarser)."""
        return _surface(self.mesh, spacing)


def convex(points: Floats) -> Convex:
    """The hull of points (n, 3), which is no thinner than `THINNEST`, nor more `OBLONG`."""
    return _thick(_solid(points))


def _thick(solid: Convex) -> Convex:
    """It with as much more thickness as engines ask for, half on either side: of a rail in two directions."""
    for _ in range(3):
        breadths = np.ptp(solid.corners @ solid.planes[:, :3].T, axis=0)
        thinnest = int(np.argmin(breadths))
        radius, half = _ball_and_box(solid)
        lift = max(0.5 * (THINNEST - float(breadths[thinnest])), half / OBLONG - radius)
        if lift <= 1e-9:
            break
        by = lift * solid.planes[thinnest, :3]
        solid = _solid(np.concatenate([solid.corners + by, solid.corners - by]))
    return solid


def _ball_and_box(solid: Convex) -> tuple[float, float]:
    """Of a solid as PhysX measures it when it cooks it: the radius of the ball about its centre of mass that is in it,
    and half the length of the box in it that reaches farthest along the longest edge of its own box, as broad as the
    ball's cube. Metres."""
    a, b, c = (solid.corners[solid.triangles[:, k]] - solid.corners[0] for k in range(3))
    shares = np.einsum("ij,ij->i", np.cross(a, b), c)
    total = float(shares.sum())
    middle = solid.corners[0] + (shares @ (a + b + c) / (4.0 * total) if total > 0.0 else a.mean(axis=0))
    inside = np.maximum(-(solid.planes[:, :3] @ middle + solid.planes[:, 3]), 0.0)
    radius = float(inside.min())
    longest = int(np.argmax(solid.high - solid.low))
    normals = np.abs(solid.planes[:, :3])
    room = inside - radius / np.sqrt(3.0) * (normals.sum(axis=1) - normals[:, longest])
    along = normals[:, longest] > 1e-9
    # It is no longer than the solid, even where no face looks that way.
    most = 0.5 * float(solid.high[longest] - solid.low[longest])
    return radius, float((room[along] / normals[along, longest]).min(initial=most))


def _surface(solid: Mesh, spacing: float) -> Floats:
    """`Convex.surface` of one that is a mesh yet."""
    a, b, c = (solid.points[solid.triangles[:, k]] for k in range(3))
    longest = np.max([np.linalg.norm(p - q, axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    parts = np.clip(np.ceil(longest / spacing).astype(int), 1, _MOST)
    found = [solid.points]
    for n in np.unique(parts).tolist():
        rows = [(i, j, n - i - j) for i in range(n + 1) for j in range(n + 1 - i)] if n > 1 else [(1, 1, 1)]
        weights = np.array(rows) / sum(rows[0])
        found.append(np.einsum("wk,mkd->mwd", weights, np.stack([a, b, c], axis=1)[parts == n]).reshape(-1, 3))
    return np.concatenate(found)


def _solid(points: Floats) -> Convex:
    return _of_hull(hull(points))


def _of_hull(mesh: Mesh) -> Convex:
    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    normals = _cross(b - a, c - a)
    length = np.linalg.norm(normals, axis=1)
    # How high each triangle is over its longest edge: a sliver's normal is that of its rounding, and what is beside it
    # bounds the solid as well.
    edges = np.max([np.linalg.norm(p - q, axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    height = length / np.maximum(edges, 1e-300)
    sound = height > min(_SLIVER, 1e-3 * float(height.max(initial=0.0)))
    normals = normals[sound] / length[sound, None]
    offsets = -np.einsum("ij,ij->i", normals, a[sound])
    planes = np.unique(np.column_stack([normals, offsets]).round(9), axis=0)
    middle = mesh.points.mean(axis=0)
    volume = float(np.einsum("ij,ij->", _cross(a - middle, b - middle), c - middle)) / 6.0
    return Convex(mesh.points, mesh.triangles, planes, volume)


def _cross(one: Floats, other: Floats) -> Floats:
    """`numpy.cross` of rows (n, 3), without what it takes to look at them."""
    a, b, c = one.T
    x, y, z = other.T
    return np.stack([b * z - c * y, c * x - a * z, a * y - b * x], axis=1)


def outermost(points: Floats) -> NDArray[np.intp]:
    """The indices of the points (n, 3) that are corners of their hull; of a flat cloud all."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        return np.asarray(np.sort(ConvexHull(points).vertices), dtype=np.intp)
    except QhullError:
        return np.arange(len(points))


def with_few_corners(solid: Convex, most: int = CORNERS) -> Convex:
    """The hull of at most so many of its corners: the outermost along the axes, then always the one that stands out
    most of the hull of those taken."""
    if len(solid.corners) <= most:
        return solid
    points = solid.corners
    taken = sorted({int(i) for i in (*points.argmin(axis=0), *points.argmax(axis=0))})
    while len(taken) < 4 or np.linalg.matrix_rank(points[taken] - points[taken[0]], tol=1e-9) < 3:
        taken.append(_farthest(points, taken))
    made = _solid(points[taken])
    while len(taken) < most:
        beyond = made.beyond(points)
        # A few at a time: each is the farthest out of what another of them does not bring in.
        fresh = [i for i in np.argsort(-beyond, kind="stable").tolist() if beyond[i] > 1e-6][: max(1, most // 8)]
        apart = [i for n, i in enumerate(fresh) if n == 0 or _apart(points, i, fresh[:n], beyond)]
        if not apart:
            break
        taken += apart[: most - len(taken)]
        made = _solid(points[taken])
    return _thick(made)


def _farthest(points: Floats, taken: Sequence[int]) -> int:
    basis = points[list(taken)]
    offset = points - basis[0]
    _, sizes, axes = np.linalg.svd(basis - basis[0], full_matrices=False)
    kept = axes[sizes > 1e-9]
    away = np.linalg.norm(offset - offset @ kept.T @ kept, axis=1)
    return int(np.argmax(away))


def _apart(points: Floats, one: int, others: Sequence[int], beyond: Floats) -> bool:
    return bool(np.linalg.norm(points[list(others)] - points[one], axis=1).min() > 4.0 * float(beyond[one]))


def uncovered(points: Floats, solids: Iterable[Convex], within: float) -> NDArray[np.bool_]:
    """Which of the points (n, 3) are in none of the solids, nor as near as `within` (metres) to one."""
    open_ = np.ones(len(points), dtype=bool)
    for solid in solids:
        rows = np.flatnonzero(open_)
        if not len(rows):
            break
        left = points[rows]
        inside = (left > solid.low - within) & (left < solid.high + within)
        near = np.flatnonzero(inside[:, 0] & inside[:, 1] & inside[:, 2])
        open_[rows[near[solid.beyond(left[near]) <= within]]] = False
    return open_


def spacing_of(within: float) -> float:
    """How far apart the points are by which a tolerance is judged, metres."""
    return max(_SPACING * within, _FINEST)


def touch(one: Convex, other: Convex, within: float) -> bool:
    """Whether their boxes come as near to each other as `within`, metres."""
    return bool((one.low <= other.high + within).all() and (other.low <= one.high + within).all())


class Boxes:
    """The boxes of numbered solids, to ask for those near one of them. There is room for `most`."""

    def __init__(self, solids: Iterable[Convex], *, most: int) -> None:
        self._low, self._high = np.full((most, 3), np.inf), np.full((most, 3), -np.inf)
        for number, solid in enumerate(solids):
            self.put(number, solid)

    def put(self, number: int, solid: Convex) -> None:
        """Counts a solid in."""
        self._low[number], self._high[number] = solid.low, solid.high

    def drop(self, number: int) -> None:
        """Leaves it out from now on."""
        self._low[number], self._high[number] = np.inf, -np.inf

    def near(self, solid: Convex, within: float) -> list[int]:
        """Numbers of those whose boxes come as near to a solid's as `within` metres, in order."""
        close = (self._low <= solid.high + within) & (self._high >= solid.low - within)
        return [int(number) for number in np.flatnonzero(close.all(axis=1))]


def interpenetrate(one: Convex, other: Convex, depth: float) -> bool:
    """Whether a ball of that radius (metres) has room in both: by a linear program over their planes."""
    from scipy.optimize import linprog

    if not touch(one, other, -2.0 * depth):
        return False
    planes = np.concatenate([one.planes, other.planes])
    rows = np.column_stack([planes[:, :3], np.ones(len(planes))])
    made = linprog((0.0, 0.0, 0.0, -1.0), A_ub=rows, b_ub=-planes[:, 3], bounds=[(None, None)] * 3 + [(None, None)])
    return made.status == 0 and made.x is not None and float(made.x[3]) > depth


def _away(union: Mesh, first: Convex, second: Convex, spacing: float) -> float:
    """How far points of a hull's surface are from the nearer of the two that it is of, at most, metres."""
    points = _surface(union, spacing)
    return float(np.minimum(first.beyond(points), second.beyond(points)).max())


Unions = dict[tuple[Convex, Convex], tuple[Mesh, float]]
"""Two solids → their hull and, by few points, how far its surface is from them: whoever merges the same ones within
several tolerances finds them once."""


def merged(
    solids: Sequence[Convex], within: float, unions: Unions | None = None
) -> list[tuple[Convex, frozenset[int]]]:
    """Fewer solids, each with the indices of those it stands for: two become their hull where no point of its surface
    is farther than `within` (metres) from one of them, the pair with the least such distance first. `unions`: what is
    known of pairs of them, and becomes so."""
    known: Unions = {} if unions is None else unions
    members = {number: (solid, frozenset([number])) for number, solid in enumerate(solids)}
    boxes = Boxes(solids, most=2 * len(solids))
    queue: list[tuple[float, int, int, int, Mesh]] = []
    tie = itertools.count()

    def price(one: int) -> None:
        """Of one with all that come before it."""
        first = members[one][0]
        for other in boxes.near(first, 2.0 * within):
            if other >= one:
                break
            second = members[other][0]
            if (second, first) in known:
                union, away = known[second, first]
            else:
                union = hull(np.concatenate([second.corners, first.corners]))
                away = _away(union, second, first, _ROUGH)  # most are found out by few points
                if one < len(solids):
                    known[second, first] = union, away
            if away <= within:
                away = _away(union, second, first, spacing_of(within))
            if away <= within:
                heapq.heappush(queue, (round(away, 9), other, one, next(tie), union))

    for number in range(len(solids)):
        price(number)
    made = len(solids)
    while queue:
        _, one, other, _, hull_of_both = heapq.heappop(queue)
        if one in members and other in members:
            union = _of_hull(hull_of_both)
            stood_for = members.pop(one)[1] | members.pop(other)[1]
            boxes.drop(one)
            boxes.drop(other)
            members[made] = (union, stood_for)
            boxes.put(made, union)
            price(made)
            made += 1
    return [members[name] for name in sorted(members)]
