"""What touches what: shafts in bores, the axes they share, and flat faces that lie on each other.

Facets of cylindrical faces never count as flat contact (a bore would look like a weld): only the planes that the CAD
reader found do, and only over the area that both really cover.
"""

from __future__ import annotations

import functools
import weakref
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from yellowiron.alignment.features.solids import Cyl, Patch, Solid, flat_faces, parallel, patch, size_of
from yellowiron.alignment.tolerances import FACING, PARALLEL, ROUND_ARC
from yellowiron.model.geometry import Floats
from yellowiron.support.vectors import distance_from_line

BESIDE = 1.5
"""Two bores that a pin is missing in are this many radii apart at most (or half as far as the longer one is long)."""
LOOSEST = 0.84
"""Shaft radius over bore radius: a clearance hole of a small bolt."""
SLACK = (0.8, 1.2)
"""The same for pins that were drawn apart from their bores, thinner or thicker by as much as 15 %, with some play."""
THROUGH = (1.0, 2.2)
"""The same for what is drawn right through an empty bore that is too narrow for it: nothing else is there on its very
axis over all its length."""

PARTLY, WHOLLY = 0.25, 0.95
"""Shares of an empty bore's length that a shaft of the one and of the other kind covers at least."""

ROUNDING = 1e-7
"""Metres by which a sample may be off a triangle's box and still be in it."""

AT_ONCE = 1_000_000
"""So many samples of triangles are looked at in one step."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A shaft of solid `inner` in a bore of solid `outer`, coaxial within `gap` metres, over `overlap` metres."""

    inner: int
    outer: int
    shaft: Cyl
    bore: Cyl
    overlap: float
    gap: float


@dataclass(frozen=True, eq=False)
class SharedAxis:
    """An axis that fits share: `fits` are indices into the list of fits."""

    origin: Floats
    direction: Floats
    radius: float
    fits: tuple[int, ...]

    def off(self, point: Floats) -> float:
        """Distance of a point from the axis, metres."""
        return distance_from_line(point, self.origin, self.direction)


@dataclass(frozen=True, eq=False)
class Flat:
    """Flat faces of solids `a` < `b` lying on each other: unit normal out of `a`, centre, area (m²) and width of the
    overlap."""

    a: int
    b: int
    normal: Floats
    center: Floats
    area: float
    width: float


def neighbours(solids: tuple[Solid, ...], slack: float) -> list[tuple[int, int]]:
    """Index pairs (a < b) whose boxes come within `slack` metres, by a sweep along the longest side."""
    if not solids:
        return []
    low = np.array([s.low for s in solids]) - 0.5 * slack
    high = np.array([s.high for s in solids]) + 0.5 * slack
    along = int(np.argmax(np.ptp(np.concatenate([low, high]), axis=0)))
    order = np.lexsort((np.arange(len(solids)), low[:, along]))
    starts = low[order, along]
    pairs = []
    for k, a in enumerate(order):
        last = int(np.searchsorted(starts, high[a, along], side="right"))
        others = order[k + 1 : last]
        touching = others[(low[others] <= high[a]).all(axis=1) & (high[others] >= low[a]).all(axis=1)]
        pairs += [(int(min(a, b)), int(max(a, b))) for b in touching]
    return sorted(pairs)


def fits_of(solids: tuple[Solid, ...], tolerance: float) -> list[Fit]:
    """Every shaft in a bore of another part: parallel, concentric, of like radius, overlapping along the axis; and the
    bars in bores that are empty then, whose radius is less like theirs (`SLACK`)."""
    shafts = [(s.index, c) for s in solids for c in s.cylinders if c.full and not c.inner]
    bores = [(s.index, c) for s in solids for c in s.cylinders if c.inner and c.arc > ROUND_ARC]
    if not shafts or not bores:
        return []
    size = size_of(solids)
    origin = np.mean([s.center for s in solids], axis=0)
    tree = cKDTree(_coordinates([c for _, c in bores], origin, size))
    ahead = _coordinates([c for _, c in shafts], origin, size)
    behind = ahead * np.array([-1, -1, -1, 1, 1, 1])
    near = 0.008 * size
    fits = []
    for k, (inner, shaft) in enumerate(shafts):
        found = set(tree.query_ball_point(ahead[k], near)) | set(tree.query_ball_point(behind[k], near))
        for j in sorted(found):
            outer, bore = bores[j]
            if outer != inner and (fit := _fit(inner, shaft, outer, bore, tolerance)) is not None:
                fits.append(fit)
    # A bar of its own may be thicker than its bore; what else is too thick must be drawn right through it.
    for alone, slack, share in ((True, SLACK, PARTLY), (False, THROUGH, WHOLLY)):
        filled = {id(f.bore) for f in fits}
        for k, (inner, shaft) in enumerate(shafts):
            if (shaft is solids[inner].shaft) is not alone:
                continue
            for j in sorted(set(tree.query_ball_point(ahead[k], near)) | set(tree.query_ball_point(behind[k], near))):
                outer, bore = bores[j]
                if outer == inner or id(bore) in filled or not bore.full:
                    continue
                fit = _fit(inner, shaft, outer, bore, tolerance, slack)
                if fit is not None and fit.overlap > share * 2 * bore.half:
                    fits.append(fit)
    return _strongest(fits)


def bare_fits_of(solids: tuple[Solid, ...], fits: list[Fit], tolerance: float) -> list[Fit]:
    """Bores of two parts side by side on one axis, of one size and with nothing in them: where a pin is not drawn.

    `inner` and `shaft` are one of the two, `outer` and `bore` the other.
    """
    filled = {id(f.bore) for f in fits}
    bores = [(s.index, c) for s in solids for c in s.cylinders if c.inner and c.full and id(c) not in filled]
    if len(bores) < 2:
        return []
    centres = np.array([c.center for _, c in bores])
    tree = cKDTree(centres)
    longest = max(c.half for _, c in bores)
    found = []
    for k, (a, one) in enumerate(bores):
        room = max(one.half, BESIDE * one.radius)
        for j in sorted(tree.query_ball_point(centres[k], one.half + room + longest + tolerance)):
            b, other = bores[j]
            if a == b or (other.half, j) < (one.half, k) or not parallel(one, other, PARALLEL):
                continue
            error = one.error + other.error
            alike = abs(one.radius - other.radius) < max(tolerance, 0.03 * one.radius) + error
            near = other.interval(one.center, one.direction)
            apart = max(near[0] - one.half, -one.half - near[1])
            gap = other.off(one.center)
            if alike and -0.1 * one.half < apart < room + tolerance and gap < max(tolerance, 0.02 * one.radius) + error:
                found.append(Fit(a, b, one, other, 0.0, gap))
    return found


def _coordinates(cylinders: list[Cyl], origin: Floats, size: float) -> Floats:
    """(n, 6) per axis: direction times size, and the foot of the perpendicular from the origin."""
    d = np.array([c.direction for c in cylinders])
    p = np.array([c.center for c in cylinders]) - origin
    foot = p - np.einsum("ij,ij->i", p, d)[:, None] * d
    return np.concatenate([d * size, foot], axis=1)


def _fit(
    inner: int, shaft: Cyl, outer: int, bore: Cyl, tolerance: float, ratios: tuple[float, float] = (LOOSEST, 1.004)
) -> Fit | None:
    """The fit of a shaft in a bore whose radii have a ratio within `ratios`; None where it does not fit."""
    error = shaft.error + bore.error
    slack = max(tolerance, 0.02 * shaft.radius) + error
    least, most = ratios
    if not least * bore.radius - error <= shaft.radius <= most * bore.radius + 0.2 * tolerance + error:
        return None
    if not parallel(shaft, bore, PARALLEL):
        return None
    gap = bore.off(
        shaft.center
        + np.clip((bore.center - shaft.center) @ shaft.direction, -shaft.half, shaft.half) * shaft.direction
    )
    if gap > slack:
        return None
    a, b = bore.interval(shaft.center, shaft.direction)
    overlap = min(b, shaft.half) - max(a, -shaft.half)
    if overlap <= max(tolerance, 0.05 * min(2 * bore.half, 2 * shaft.half)):
        return None
    return Fit(inner, outer, shaft, bore, overlap, gap)


def _strongest(fits: list[Fit]) -> list[Fit]:
    """One fit for each pair of parts and axis: the longest."""
    kept: list[Fit] = []
    by_pair: dict[tuple[int, int], list[Fit]] = {}
    for fit in sorted(fits, key=lambda f: (f.inner, f.outer, -round(f.overlap, 7), round(f.gap, 7))):
        rivals = by_pair.setdefault((fit.inner, fit.outer), [])
        if all(r.shaft.off(fit.shaft.center) > 0.5 * r.shaft.radius or _skew(r.shaft, fit.shaft) for r in rivals):
            rivals.append(fit)
            kept.append(fit)
    return kept


def _skew(a: Cyl, b: Cyl) -> bool:
    return abs(float(a.direction @ b.direction)) < PARALLEL


def shared_axes_of(fits: list[Fit], tolerance: float) -> list[SharedAxis]:
    """The distinct axes of fits: parallel and within a few per cent of a radius of each other."""
    origins: list[Floats] = []
    directions: list[Floats] = []
    radii: list[float] = []
    members: list[list[int]] = []
    for k in sorted(range(len(fits)), key=lambda k: (-fits[k].shaft.half, k)):
        shaft = fits[k].shaft
        found = -1
        if origins:
            d = np.array(directions)
            delta = shaft.center - np.array(origins)
            across = delta - np.einsum("ij,ij->i", delta, d)[:, None] * d
            off = np.linalg.norm(across, axis=1)
            good = (np.abs(d @ shaft.direction) > PARALLEL) & (
                off < np.maximum(tolerance, 0.04 * shaft.radius) + shaft.error
            )
            if good.any():
                found = int(np.argmin(np.where(good, off, np.inf)))
        if found < 0:
            origins.append(shaft.center)
            directions.append(shaft.direction)
            radii.append(shaft.radius)
            members.append([k])
        else:
            members[found].append(k)
            radii[found] = max(radii[found], shaft.radius)
    return [
        SharedAxis(o, d, r, tuple(sorted(m))) for o, d, r, m in zip(origins, directions, radii, members, strict=True)
    ]


class Patches:
    """Triangles on the planes of solids, found once for each: `world(solid, plane)`."""

    def __init__(self, tolerance: float) -> None:
        self.tolerance = tolerance
        self._of = functools.cache(self._find)
        self.world = functools.cache(self._world)

    def _find(self, solid: Solid, plane: int) -> Patch:
        if not solid.shape.planes:
            return patch(solid.shape, flat_faces(solid.shape)[plane], self.tolerance)
        return patch(solid.shape, solid.shape.planes[plane], self.tolerance)

    def _world(self, solid: Solid, plane: int) -> Floats:
        """(m, 3, 3) corners in the CAD frame."""
        corners = self._of(solid, plane).corners
        moved = corners.reshape(-1, 3) @ solid.part.transform[:3, :3].T + solid.part.transform[:3, 3]
        return np.asarray(moved.reshape(-1, 3, 3), dtype=np.float64)


def flats_of(solids: tuple[Solid, ...], pairs: list[tuple[int, int]], tolerance: float) -> list[Flat]:
    """Where flat faces of two parts lie on each other."""
    patches = Patches(0.5 * tolerance)
    flats = []
    for a, b in pairs:
        sa, sb = solids[a], solids[b]
        if not len(sa.plane_points) or not len(sb.plane_points):
            continue
        low = np.maximum(sa.low, sb.low) - tolerance
        high = np.minimum(sa.high, sb.high) + tolerance
        ka = _crossing(sa, low, high)
        kb = _crossing(sb, low, high)
        if not len(ka) or not len(kb):
            continue
        opposed = sa.plane_normals[ka] @ sb.plane_normals[kb].T < -FACING
        apart = np.abs(
            np.einsum("ij,ij->i", sa.plane_normals[ka], sa.plane_points[ka])[:, None]
            - sa.plane_normals[ka] @ sb.plane_points[kb].T
        )
        best: Flat | None = None
        for i, j in np.argwhere(opposed & (apart < tolerance)):
            flat = _overlap_of(sa, sb, int(ka[i]), int(kb[j]), patches)
            if flat is not None:
                flats.append(flat)
                best = flat if best is None or flat.area > best.area else best
    return flats


def _crossing(solid: Solid, low: Floats, high: Floats) -> NDArray[np.intp]:
    """Indices of planes that pass through a box."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    reach = np.abs(solid.plane_normals) @ np.maximum(half, 0)
    off = np.abs(np.einsum("ij,ij->i", solid.plane_normals, middle - solid.plane_points))
    return np.flatnonzero(off <= reach + 1e-9)


_overlaps: weakref.WeakKeyDictionary[
    Solid, weakref.WeakKeyDictionary[Solid, dict[tuple[int, int, int, int], Flat | None]]
] = weakref.WeakKeyDictionary()
"""Of solids that are still in use: planes, and how many triangles of each → what they cover of each other."""


def _overlap_of(sa: Solid, sb: Solid, i: int, j: int, patches: Patches) -> Flat | None:
    """Where two planes lie on each other; most tolerances take the same triangles for them."""
    ta, tb = patches.world(sa, i), patches.world(sb, j)
    if not len(ta) or not len(tb):
        return None
    known = _overlaps.setdefault(sa, weakref.WeakKeyDictionary()).setdefault(sb, {})
    key = (i, j, len(ta), len(tb))
    if key not in known:
        known[key] = _overlap(sa, sb, i, ta, tb)
    return known[key]


CELLS = 24
"""Cells of a grid that what two faces both cover is counted on, along either side."""
THIN, FINER = 0.2, 3
"""What covers less than this share of them is counted again, so many times finer: a strip across the grid may be two
cells wide."""


def _overlap(sa: Solid, sb: Solid, i: int, ta: Floats, tb: Floats) -> Flat | None:
    normal = sa.plane_normals[i]
    basis = np.linalg.svd(normal[None, :])[2][1:]
    fa, fb = ta @ basis.T, tb @ basis.T
    (la, ha), (lb, hb) = _ends(fa), _ends(fb)
    low, high = np.maximum(la.min(axis=0), lb.min(axis=0)), np.minimum(ha.max(axis=0), hb.max(axis=0))
    if (high <= low).any():
        return None
    area, middle, width = covered(fa, fb, low, high)
    if area <= 0:
        return None
    height = float(normal @ sa.plane_points[i])
    return Flat(sa.index, sb.index, normal, middle @ basis + height * normal, area, width)


def covered(fa: Floats, fb: Floats, low: Floats, high: Floats, count: int = CELLS) -> tuple[float, Floats, float]:
    """Area, centre and extent of what two sets of triangles (m, 3, 2) both cover, on a grid over [low, high], and on a
    finer one where that is `THIN`."""
    steps = (np.arange(count) + 0.5) / count
    xs, ys = low[0] + steps * (high[0] - low[0]), low[1] + steps * (high[1] - low[1])
    there = np.ones((count, count), dtype=np.bool_)
    for triangles in sorted((fa, fb), key=len):
        there = _on_grid(xs, ys, there, triangles)
    row, column = np.nonzero(there.T)
    if not len(row):
        return 0.0, low, 0.0
    if count == CELLS and len(row) < THIN * count**2:
        return covered(fa, fb, low, high, FINER * count)
    chosen = np.c_[xs[column], ys[row]]
    area = float(len(chosen) / count**2 * np.prod(high - low))
    return area, chosen.mean(axis=0), float(np.linalg.norm(np.ptp(chosen, axis=0)))


Cells = np.ndarray[tuple[int, int], np.dtype[np.bool_]]


def inside(samples: Floats, triangles: Floats) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Which samples (n, 2) lie in any of the triangles (m, 3, 2)."""
    (xs, column), (ys, row) = (np.unique(samples[:, k], return_inverse=True) for k in range(2))
    there = np.zeros((len(xs), len(ys)), dtype=np.bool_)
    there[column, row] = True
    return np.asarray(_on_grid(xs, ys, there, triangles)[column, row], dtype=np.bool_)


def _on_grid(xs: Floats, ys: Floats, there: Cells, triangles: Floats) -> Cells:
    """Which of the cells of a grid, (len(xs), len(ys)), that are `there` lie in any of the triangles (m, 3, 2): each
    triangle is asked of the cells of its box alone."""
    hit = np.zeros_like(there)
    lowest, highest = _ends(triangles)
    left, right = np.searchsorted(xs, lowest[:, 0] - ROUNDING), np.searchsorted(xs, highest[:, 0] + ROUNDING)
    bottom, top = np.searchsorted(ys, lowest[:, 1] - ROUNDING), np.searchsorted(ys, highest[:, 1] + ROUNDING)
    numbers = np.flatnonzero((right > left) & (top > bottom))
    if not len(numbers) or not there.any():
        return hit
    left, bottom, tall = left[numbers], bottom[numbers], (top - bottom)[numbers]
    cells = (right[numbers] - left) * tall
    ends = np.cumsum(cells)
    for part in np.split(np.arange(len(numbers)), np.flatnonzero(np.diff(ends // AT_ONCE)) + 1):
        which = np.repeat(part, cells[part])
        cell = np.arange(len(which)) - np.repeat(
            ends[part] - cells[part] - (ends[part[0]] - cells[part[0]]), cells[part]
        )
        i, j = left[which] + cell // tall[which], bottom[which] + cell % tall[which]
        some = there[i, j] & ~hit[i, j]
        i, j, which = i[some], j[some], which[some]
        within = _within(xs[i], ys[j], triangles[numbers[which]])
        hit[i[within], j[within]] = True
    return hit


def _within(x: Floats, y: Floats, tri: Floats) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Whether points (n,) lie each in its triangle (n, 3, 2)."""
    edge, other = tri[:, 1] - tri[:, 0], tri[:, 2] - tri[:, 0]
    sign = np.where(edge[:, 0] * other[:, 1] - edge[:, 1] * other[:, 0] >= 0, 1.0, -1.0)
    found = np.ones(len(x), dtype=np.bool_)
    for k in range(3):
        p = tri[:, k]
        e = tri[:, (k + 1) % 3] - p
        found &= (e[:, 0] * (y - p[:, 1]) - e[:, 1] * (x - p[:, 0])) * sign >= -1e-12
    return found


def _ends(triangles: Floats) -> tuple[Floats, Floats]:
    """(m, k) lower and upper corners of the boxes of triangles (m, 3, k)."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
