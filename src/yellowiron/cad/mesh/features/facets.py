"""Cylinders and planes on triangles, for meshes that come without surfaces: `find`.

Guesses (`strips`) are fitted and grown (`roundness`), then judged here: a cylinder has enough strips over enough of a
turn, and is no band of a ball or of a bent pipe. A corner of a mesh lies on the surface it was made from, so the radius
is that of the corners.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.cad.mesh.features.balls import balls
from yellowiron.cad.mesh.features.ovals import knuckles, ovals
from yellowiron.cad.mesh.features.rings import rings, untold
from yellowiron.cad.mesh.features.roundness import Round, fit, grown, least, median, trimmed, widths
from yellowiron.cad.mesh.features.soup import Flags, Indices, Soup, flat_facets, soup_of
from yellowiron.cad.mesh.features.strips import by_folds, by_normals
from yellowiron.cad.mesh.features.tolerances import FEWEST, ROUGH
from yellowiron.cad.tolerances import PARALLEL
from yellowiron.model.geometry import CylinderFeature, Floats, Mesh, PlaneFeature, SphereFeature

ENOUGH = ((5, 1.4), (4, 2.2))
"""(strips, radians around): a patch with as many of both as one of these is round, and not merely bent."""
ABUT = 0.05
"""Patches on one cylinder are one feature if the gap between them along the axis is no more than this share of the
radius."""
FLAT = math.radians(0.3)
"""Triangles side by side are one plane within this angle, radians …"""
_OFF = 2e-4
"""… and no corner further from it than this share of the mesh."""
_ONE_WAY = math.cos(FLAT)
_LITTLE = 3e-4
"""A plane below this share of the mesh's area is not worth its place."""
_TINY = 1e-3
"""What is below this share of a mesh's size is not looked at: the screw holes of a machine in one piece."""
_BAND = 1.6
"""A ring that is no longer than this many of its strips are wide, and goes on smoothly, is a band of a ball."""
_PATCH = 6.0
"""As `_BAND`, for patches that go less than half-way around and go on smoothly at both ends."""
_ROUND = 0.996
"""What has less than this between its two radii is oval."""
_SLENDER = 4.0
"""What is left of a patch that was no cylinder is one only if it is this many radii long."""
_PIECE = 0.9 * math.tau
"""What goes less far around, radians, may be a piece of a ring."""
_TRIES = 1
"""What has been part of so many patches that were not round is bent in two directions, and not tried again."""


@dataclass(frozen=True)
class MeshFeatures:
    """What a mesh has of cylinders, planes, knuckles and spheres."""

    cylinders: tuple[CylinderFeature, ...]
    planes: tuple[PlaneFeature, ...]
    knuckles: tuple[CylinderFeature, ...] = ()
    spheres: tuple[SphereFeature, ...] = ()


def find(mesh: Mesh, number: Indices | None = None) -> MeshFeatures:
    """The cylinders and planes of a mesh, metres, in its frame; cylinders in the order of their first triangles, planes
    by area. `mesh` has no triangle without an area, and outward is where its triangles face; `number` says which of its
    points are one (`measures.welded`), where that is known."""
    if len(mesh.triangles) < FEWEST:
        return MeshFeatures((), ())
    soup = soup_of(mesh, number)
    free = np.ones(len(soup.corners), dtype=bool)
    rounds: list[Round] = []
    refused = np.zeros(len(soup.corners), dtype=np.int64)
    # Whole ovals first: a piece of one is nearly a piece of a circle.
    found = _ovals(soup, free, whole=True)
    for guesses in (by_folds(soup), by_normals(soup, free)):
        for guess, seeds in guesses:
            seeds = seeds[free[seeds]]
            if len(seeds) < FEWEST or guess.radius < _TINY * soup.size or median(refused[seeds]) >= _TRIES:
                continue
            cylinder = grown(soup, guess, seeds, free)
            if cylinder is not None and not _is_round(soup, cylinder):
                refused[cylinder.triangles] += 1
                cylinder = _straight(soup, cylinder)
            if cylinder is not None:
                rounds.append(cylinder)
                free[cylinder.triangles] = False
    rounds = _united(soup, rounds)
    found += [(r, _arc(soup, r)) for r in rounds] + _ovals(soup, free, whole=False)
    errors = _ringed(soup, found, free)
    found.sort(key=lambda pair: int(pair[0].triangles.min()))
    return MeshFeatures(
        tuple(_feature(soup, r, arc, errors.get(id(r)) or untold(soup, r)) for r, arc in found),
        _planes(soup, free),
        tuple(_feature(soup, k.round, k.arc) for k in knuckles(soup, free)),
        balls(soup),
    )


def _ringed(soup: Soup, found: list[tuple[Round, float]], free: Flags) -> dict[int, float]:
    """Adds the rings to what was found, no longer free, in place of the pieces of them that were; the errors of the
    rounds, metres, by their `id`."""
    partial = [pair for pair in found if pair[1] < _PIECE]
    open_ = free.copy()
    for piece, _ in partial:
        open_[piece.triangles] = True
    errors = {}
    for ring in rings(soup, open_, _TINY * soup.size):
        arc = _arc(soup, ring.round)
        if arc < _PIECE or _smooth_ends(soup, ring.round, arc):
            continue
        inside = np.zeros(len(soup.corners), dtype=bool)
        inside[ring.round.triangles] = True
        found[:] = [pair for pair in found if not inside[pair[0].triangles].any()]
        found.append((ring.round, arc))
        free[ring.round.triangles] = False
        errors[id(ring.round)] = ring.error
    return errors


# ---- what is round ----
def _ovals(soup: Soup, free: Flags, *, whole: bool) -> list[tuple[Round, float]]:
    """Ovals with their arcs, no longer free; only those that go all the way round, or any."""
    found = []
    for oval in ovals(soup, free, _ROUND if whole else 1.0):
        wanted = not whole or (oval.arc > 0.99 * math.tau and oval.ratio < _ROUND)
        if wanted and _smooth_ends(soup, oval.round, _arc(soup, oval.round)) == 0 and free[oval.round.triangles].all():
            found.append((oval.round, oval.arc))
            free[oval.round.triangles] = False
    return found


def _is_round(soup: Soup, cylinder: Round) -> bool:
    triangles = cylinder.triangles
    count, arc = _strips(soup, cylinder), _arc(soup, cylinder)
    if not any(count >= least and arc >= around for least, around in ENOUGH):
        return False
    corners = soup.corners_of(triangles)
    off = cylinder.distances(corners) - cylinder.radius
    if float(np.sqrt(np.mean(off**2))) > 0.5 * cylinder.slack:
        return False
    length = float(np.ptp(cylinder.along(corners)))
    width = median(widths(soup, cylinder, triangles)) * cylinder.radius
    ends = _smooth_ends(soup, cylinder, arc)
    if ends and length < _BAND * width:
        return False
    if ends < 2:
        return True
    if length < _PATCH * width and arc < ENOUGH[1][1]:
        return False
    close = max(0.25 * ROUGH * cylinder.radius, 0.5 * cylinder.least, soup.resolution)
    return float(np.abs(off).max()) <= close and not _is_oval(soup, cylinder, corners, off)


def _straight(soup: Soup, cylinder: Round) -> Round | None:
    """The straight of a patch that is no cylinder as a whole, round and much longer than it is wide; None without."""
    if _length(soup, cylinder) <= _SLENDER * cylinder.radius:
        return None
    rest = trimmed(soup, cylinder)
    good = rest is not None and _length(soup, rest) > _SLENDER * rest.radius and _is_round(soup, rest)
    return rest if good else None


def _length(soup: Soup, cylinder: Round) -> float:
    return float(np.ptp(cylinder.along(soup.points[soup.corners[cylinder.triangles]].reshape(-1, 3))))


def _is_oval(soup: Soup, cylinder: Round, corners: Floats, off: Floats) -> bool:
    """Whether corners stray from a cylinder as an ellipse does: a bent pipe is cut into rings that are a little
    oval."""
    twice = 2.0 * cylinder.angles(corners)
    waves = np.stack([np.cos(twice), np.sin(twice), np.ones(len(off))], axis=1)
    found = np.linalg.lstsq(waves, off, rcond=None)[0]
    rest = float(np.sqrt(np.mean((off - waves @ found) ** 2)))
    return math.hypot(found[0], found[1]) > max(3.0 * rest, 2.0 * soup.rounding)


def _strips(soup: Soup, cylinder: Round) -> int:
    """How many strips a patch has: directions in which its triangles face."""
    rows = cylinder.triangles
    u, v = cylinder.frame
    facing = np.sort(np.arctan2(soup.normals[rows] @ v, soup.normals[rows] @ u))
    gaps = np.append(np.diff(facing), facing[0] + math.tau - facing[-1])
    return int((gaps > math.radians(1.0)).sum())


def _arc(soup: Soup, cylinder: Round) -> float:
    """Radians around the axis that the triangles cover."""
    angles = cylinder.angles(soup.points[soup.corners[cylinder.triangles]])
    turned = angles[:, :1] + (angles - angles[:, :1] + math.pi) % math.tau - math.pi
    low, high = turned.min(axis=1), turned.max(axis=1)
    start = low % math.tau
    spans = np.concatenate(
        [
            np.stack([start, np.minimum(start + high - low, math.tau)], axis=1),
            np.stack([np.zeros(len(low)), np.maximum(start + high - low - math.tau, 0.0)], axis=1),
        ]
    )
    spans = spans[np.argsort(spans[:, 0], kind="stable")]
    reach = np.maximum.accumulate(np.concatenate([[0.0], spans[:, 1]]))
    gaps = np.maximum(spans[:, 0] - reach[:-1], 0.0)
    open_ = float(gaps[gaps > 1e-5].sum()) + max(0.0, math.tau - float(reach[-1]))
    return math.tau if open_ < 1e-4 else math.tau - open_


def _smooth_ends(soup: Soup, cylinder: Round, arc: float) -> int:
    """How many of the two ends of a ring, which goes `arc` radians around, go on without an edge over half of their
    length or more."""
    inside = np.zeros(len(soup.corners), dtype=bool)
    inside[cylinder.triangles] = True
    border = inside[soup.pair[:, 0]] != inside[soup.pair[:, 1]]
    edge = soup.points[soup.edges[border]]
    across = edge[:, 1] - edge[:, 0]
    length = np.linalg.norm(across, axis=1)
    ringwise = np.abs(across @ cylinder.direction) < 0.5 * length
    height = cylinder.along(edge.mean(axis=1))
    angle = soup.angle[border]
    corners = cylinder.along(soup.points[soup.corners[cylinder.triangles]].reshape(-1, 3))
    middle = 0.5 * (corners.min() + corners.max())
    count = 0
    around = cylinder.radius * arc
    for side in (height < middle, height >= middle):
        smooth = side & ringwise & (angle < math.radians(35.0))
        count += float(length[smooth].sum()) > 0.5 * around
    return count


def _united(soup: Soup, rounds: list[Round]) -> list[Round]:
    """Patches on one cylinder that overlap or abut along its axis as one; and apart where there is a gap."""
    groups: list[list[Round]] = []
    for one in sorted(rounds, key=lambda r: (-float(soup.areas[r.triangles].sum()), int(r.triangles.min()))):
        for group in groups:
            if _same(soup, group[0], one):
                group.append(one)
                break
        else:
            groups.append([one])
    result = []
    for group in groups:
        rows = np.unique(np.concatenate([r.triangles for r in group]))
        for run in _runs(soup, group[0], rows):
            start = replace(group[0], triangles=run)
            better = fit(start, soup.corners_of(run)) if len(group) > 1 else None
            result.append(better or start)
    return result


def _same(soup: Soup, one: Round, other: Round) -> bool:
    if one.inner != other.inner or abs(one.radius - other.radius) > max(2.0 * ROUGH * one.radius, one.least):
        return False
    if abs(float(one.direction @ other.direction)) < PARALLEL:
        return False
    along = other.along(soup.points[soup.corners[other.triangles]].reshape(-1, 3))
    ends = other.point + np.outer((along.min(), along.max()), other.direction)
    return bool((one.distances(ends) < max(5.0 * ROUGH * one.radius, one.least)).all())


def _runs(soup: Soup, cylinder: Round, rows: Indices) -> list[Indices]:
    """The triangles of a cylinder in runs along its axis, without gaps."""
    along = cylinder.along(soup.points[soup.corners[rows]])
    low, high = along.min(axis=1), along.max(axis=1)
    order = np.argsort(low, kind="stable")
    reach = np.maximum.accumulate(high[order])
    cut = np.flatnonzero(low[order][1:] > reach[:-1] + max(ABUT * cylinder.radius, 1e-4)) + 1
    return [np.sort(rows[part]) for part in np.split(order, cut)]


def _feature(soup: Soup, cylinder: Round, arc: float, error: float = 0.0) -> CylinderFeature:
    along = cylinder.along(soup.points[soup.corners[cylinder.triangles]].reshape(-1, 3))
    low, high = float(along.min()), float(along.max())
    direction = _canonical(cylinder.direction)
    middle = cylinder.point + 0.5 * (low + high) * cylinder.direction
    half = 0.5 * (high - low)
    return CylinderFeature(
        point=_triple(middle),
        direction=_triple(direction),
        radius=cylinder.radius,
        lower=-half,
        upper=half,
        arc=arc,
        inner=cylinder.inner,
        exact=False,
        area=float(soup.areas[cylinder.triangles].sum()),
        error=error,
    )


def _canonical(axis: Floats) -> Floats:
    """The axis or its opposite: the one whose first component that is not nearly zero is positive."""
    for component in axis:
        if abs(component) > 1e-3:
            return axis if component > 0 else -axis
    return axis


# ---- what is flat ----
def _planes(soup: Soup, free: Flags) -> tuple[PlaneFeature, ...]:
    """The flat facets of free triangles, those in one plane as one, the largest first."""
    label = flat_facets(soup, FLAT)
    label = np.where(free, label, -1)
    total = float(soup.areas.sum())
    area = np.bincount(label[label >= 0], weights=soup.areas[label >= 0])
    order = np.argsort(label, kind="stable")
    ends = np.searchsorted(label[order], np.arange(len(area) + 1))
    chosen = sorted(np.flatnonzero(area > _LITTLE * total).tolist(), key=lambda k: (-area[k], k))
    areas, facing, middles = soup.areas[order], soup.normals[order], soup.middles[order]
    corners = soup.points[soup.corners[order]]
    flat, level = max(_OFF * soup.size, least(soup)), max(0.5 * _OFF * soup.size, least(soup))
    points, normals, sizes = np.zeros((len(chosen), 3)), np.zeros((len(chosen), 3)), np.zeros(len(chosen))
    count = 0
    for k in chosen:
        rows = slice(ends[k], ends[k + 1])
        weight = areas[rows] / area[k]
        normal = weight @ facing[rows]
        normal /= max(math.sqrt(normal.dot(normal)), 1e-12)
        point = weight @ middles[rows]
        if float(np.abs((corners[rows].reshape(-1, 3) - point) @ normal).max()) > flat:
            continue
        alike = normals[:count] @ normal > _ONE_WAY
        if alike.any():
            alike &= np.abs(np.einsum("ij,ij->i", point - points[:count], normals[:count])) < level
        if alike.any():
            i = int(np.argmax(alike))
            both = sizes[i] + area[k]
            points[i] = (sizes[i] * points[i] + area[k] * point) / both
            sizes[i] = both
        else:
            points[count], normals[count], sizes[count] = point, normal, area[k]
            count += 1
    found = zip(points[:count], normals[:count], sizes[:count].tolist(), strict=True)
    return tuple(PlaneFeature(_triple(point), _triple(normal), size) for point, normal, size in found)


def _triple(values: Floats) -> tuple[float, float, float]:
    x, y, z = values.tolist()
    return (0.0 if abs(x) < 1e-14 else x, 0.0 if abs(y) < 1e-14 else y, 0.0 if abs(z) < 1e-14 else z)
