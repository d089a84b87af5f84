"""Tracks by shape: many equal parts in a closed row are its shoes, what sits at the same place of each goes with them,
and the round things inside the row are its wheels.

A row is closed where each part has two neighbours at about the same distance and all lie in one plane. Its pins are
between two shoes: they go with the shoe that holds them tightest. Which wheel is which is told in
`labelling.track_places`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from yellowiron.alignment.features.solids import Solid, coaxial
from yellowiron.alignment.tolerances import PARALLEL_TWINS
from yellowiron.model.geometry import Floats

LEAST = 20
"""Fewer equal parts in a row are no track."""
EQUAL = 2e-3
"""Equal parts differ by no more than this share of their volume and area (a mirror image is equal)."""
NEXT = 1.35
"""A neighbour in the row is nearer than this many times the usual distance."""
FLAT = 0.03
"""How far a row may be from a plane, as a share of its length."""
PLACE = 0.3
"""Two parts sit at the same place of their shoes if their places differ by less than this many pitches."""


@dataclass(frozen=True, eq=False)
class TrackWheel:
    """A wheel inside a track: its solids, a point of its axis, its radius in metres, and the radius of its rim as a
    share of it: 1 for a smooth one, less for teeth."""

    members: tuple[int, ...]
    center: Floats
    radius: float
    rim: float


@dataclass(frozen=True, eq=False)
class Track:
    """One track: the solids of each shoe in order around the loop, `centers` (n, 3) of the shoes' main parts, the unit
    `axis` across it, its `wheels`, and `points` (m, 3) of each shoe. CAD frame, metres."""

    shoes: tuple[tuple[int, ...], ...]
    centers: Floats
    axis: Floats
    wheels: tuple[TrackWheel, ...]
    points: tuple[Floats, ...]

    @property
    def center(self) -> Floats:
        """The middle of the loop."""
        return np.asarray(0.5 * (self.centers.min(axis=0) + self.centers.max(axis=0)), dtype=np.float64)

    @property
    def along(self) -> Floats:
        """The unit direction in which the loop is longest."""
        return np.asarray(np.linalg.svd(self.centers - self.centers.mean(axis=0))[2][0], dtype=np.float64)


def tracks_of(solids: Sequence[Solid]) -> list[Track]:
    """The machine's tracks: of all classes of equal parts the one whose closed rows are the bulkiest; two of them that
    are equal, or one."""
    classes = _classes(solids)
    best: list[list[int]] = []
    bulk = 0.0
    for members in classes:
        rows = _rows(members, solids)
        size = solids[members[0]].size * sum(map(len, rows))
        if rows and size > bulk:
            best, bulk = rows, size
    if not best:
        return []
    longest = max(map(len, best))
    rows = sorted((row for row in best if len(row) == longest), key=lambda row: min(row))[:2]
    taken: set[int] = set()
    found = []
    for row in rows:
        shoes = _companions(row, solids, classes, taken)
        taken |= {i for shoe in shoes for i in shoe}
        found.append((row, shoes))
    tracks = []
    for row, shoes in found:
        centers = np.array([solids[i].center for i in row])
        axis = np.linalg.svd(centers - centers.mean(axis=0))[2][2]
        wheels = _wheels(row, axis, solids, taken)
        points = tuple(np.concatenate([solids[i].points for i in shoe]) for shoe in shoes)
        tracks.append(Track(tuple(shoes), centers, axis, tuple(wheels), points))
    return tracks


# ---- rows ----
def _classes(solids: Sequence[Solid]) -> list[list[int]]:
    """Solids by volume and area, those that are equal (or mirror images) together, in the order of the first."""
    order = sorted(range(len(solids)), key=lambda i: (solids[i].volume, solids[i].surface, i))
    classes: list[list[int]] = []
    for i in order:
        first = classes[-1][0] if classes else -1
        if first >= 0 and _equal(solids[first], solids[i]):
            classes[-1].append(i)
        else:
            classes.append([i])
    return sorted((sorted(c) for c in classes), key=lambda c: c[0])


def _equal(a: Solid, b: Solid) -> bool:
    alike = abs(a.volume - b.volume) <= EQUAL * max(a.volume, b.volume)
    return alike and abs(a.surface - b.surface) <= EQUAL * max(a.surface, b.surface)


def _rows(members: list[int], solids: Sequence[Solid]) -> list[list[int]]:
    """The closed rows among equal parts, each in order around the loop."""
    if len(members) < LEAST:
        return []
    points = np.array([solids[i].center for i in members])
    tree = cKDTree(points)
    apart = np.asarray(tree.query(points, k=3)[0])
    reach = NEXT * float(np.median(apart[:, 2]))
    neighbours = [[j for j in near if j != i] for i, near in enumerate(tree.query_ball_point(points, reach))]
    left = {i for i, near in enumerate(neighbours) if len(near) == 2}
    rows = []
    while left:
        start = min(left)
        row, before, here = [start], -1, start
        while True:
            onward = [j for j in neighbours[here] if j != before and j in left]
            if not onward or (onward[0] == start and len(row) > 2):
                break
            before, here = here, min(onward) if before < 0 else onward[0]
            if here in row:
                break
            row.append(here)
        left -= set(row)
        closed = len(row) >= LEAST and row[0] in neighbours[row[-1]]
        if closed and _in_plane(points[row]):
            rows.append([members[i] for i in row])
    return rows


def _in_plane(points: Floats) -> bool:
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False) / np.sqrt(len(points))
    return bool(spread[2] < FLAT * spread[0] and spread[1] > 2 * spread[2])


# ---- what goes with a shoe ----
def _frames(row: list[int], solids: Sequence[Solid]) -> tuple[Floats, Floats, float]:
    """Places (n, 3) and axes (n, 3, 3; rows: along the row, outwards, across) of the shoes, and the pitch."""
    centers = np.array([solids[i].center for i in row])
    along = np.roll(centers, -1, axis=0) - np.roll(centers, 1, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    across = np.linalg.svd(centers - centers.mean(axis=0))[2][2]
    outwards = np.cross(across, along)
    # Of a loop walked the other way they point inwards.
    if float(np.einsum("ij,ij->i", outwards, centers - centers.mean(axis=0)).sum()) < 0:
        outwards = -outwards
    pitch = float(np.median(np.linalg.norm(np.roll(centers, -1, axis=0) - centers, axis=1)))
    return centers, np.stack([along, outwards, np.broadcast_to(across, along.shape)], axis=1), pitch


def _companions(
    row: list[int], solids: Sequence[Solid], classes: list[list[int]], taken: set[int]
) -> list[tuple[int, ...]]:
    """For every shoe of a row its solids, main one first: of each class of which there are as many near the row as
    shoes, or twice, three times as many, the part that sits at the same place of each."""
    centers, axes, pitch = _frames(row, solids)
    count = len(row)
    tree = cKDTree(centers)
    high = np.max([np.ptp((solids[i].points - centers[k]) @ axes[k].T, axis=0) for k, i in enumerate(row[:3])], axis=0)
    shoes: list[list[int]] = [[i] for i in row]
    for members in classes:
        near = [i for i in members if i not in taken and i not in row and _beside(solids[i], tree, axes, high, pitch)]
        if not near or len(near) % count:
            continue
        for slot in _slots(near, count, centers, axes, tree, pitch, solids, shoes):
            for k, i in slot.items():
                shoes[k].append(i)
    return [tuple(shoe) for shoe in shoes]


def _beside(solid: Solid, tree: cKDTree, axes: Floats, high: Floats, pitch: float) -> bool:
    """Whether a solid is within the shoes' width and about a pitch of their middle."""
    middle = solid.center
    _, k = tree.query(middle)
    local = axes[k] @ (middle - tree.data[k])
    small = solid.size < 1.5 * float(np.linalg.norm(high)) + pitch
    return bool(small and abs(local[2]) <= 0.55 * high[2] and abs(local[0]) < 0.8 * pitch and abs(local[1]) < pitch)


def _slots(
    near: list[int], count: int, centers: Floats, axes: Floats, tree: cKDTree, pitch: float,
    solids: Sequence[Solid], shoes: list[list[int]],
) -> list[dict[int, int]]:  # fmt: skip
    """Places of a shoe at which every shoe has one of these parts: shoe → part, a place each, all parts used once.

    A part between two shoes is at a place of either: that of the shoe with the tighter fit is taken.
    """
    combos = []
    for i in near:
        _, nearest = tree.query(solids[i].center, k=3)
        for k in np.atleast_1d(nearest):
            local = axes[k] @ (solids[i].center - centers[k])
            if abs(local[0]) < 0.8 * pitch:
                combos.append((i, int(k), local))
    places: list[tuple[Floats, list[tuple[int, int]]]] = []
    for i, k, local in combos:
        found = [p for p in places if float(np.linalg.norm(p[0] - local)) < PLACE * pitch * 0.5]
        if found:
            found[0][1].append((i, k))
        else:
            places.append((local, [(i, k)]))
    whole = []
    for local, members in places:
        by_shoe = {k: i for i, k in reversed(members)}
        if len(by_shoe) == count and len(set(by_shoe.values())) == count:
            loose = _looseness(next(iter(by_shoe.items())), solids, shoes)
            whole.append((round(loose, 6), round(float(np.linalg.norm(local)) / pitch, 2), float(local[0]), by_shoe))
    chosen: list[dict[int, int]] = []
    used: set[int] = set()
    for *_, by_shoe in sorted(whole, key=lambda w: w[:3]):
        if not used & set(by_shoe.values()):
            chosen.append(by_shoe)
            used |= set(by_shoe.values())
    return chosen


def _looseness(pair: tuple[int, int], solids: Sequence[Solid], shoes: list[list[int]]) -> float:
    """How loosely a part sits in the bores of a shoe, metres of radius (0: fast); 1 where it is in none."""
    k, i = pair
    least = 1.0
    for shaft in solids[i].cylinders:
        if shaft.inner or not shaft.full:
            continue
        for j in shoes[k]:
            for bore in solids[j].cylinders:
                if not bore.inner or abs(float(bore.direction @ shaft.direction)) < PARALLEL_TWINS:
                    continue
                low, high = bore.interval(shaft.center, shaft.direction)
                apart = max(low - shaft.half, -shaft.half - high)
                if apart < 0 and bore.off(shaft.center) < 0.1 * shaft.radius and bore.radius > 0.99 * shaft.radius:
                    least = min(least, bore.radius - shaft.radius)
    return max(0.0, least)


# ---- wheels ----
def _wheels(row: list[int], axis: Floats, solids: Sequence[Solid], taken: set[int]) -> list[TrackWheel]:
    """The round hollow things inside a loop that turn about lines across it, those on one line together; where nothing
    there is hollow, as in models drawn to be looked at, the widest solid one on each line."""
    centers = np.array([solids[i].center for i in row])
    middle = centers.mean(axis=0)
    plane = np.linalg.svd(axis[None, :])[2][1:]
    loop = (centers - middle) @ plane.T
    width = max(float(np.ptp(solids[i].points @ axis)) for i in row[:3])
    pitch = float(np.median(np.linalg.norm(np.roll(loop, -1, axis=0) - loop, axis=1)))
    rings: list[tuple[Floats, list[int]]] = []
    for s in solids:
        if s.index in taken or s.axis is None or abs(float(s.axis.direction @ axis)) < PARALLEL_TWINS:
            continue
        place = plane @ (s.axis.center - middle)
        low, high = s.span(middle, axis)
        across = min(high, 0.5 * width) - max(low, -0.5 * width)
        if across < 0.5 * (high - low) or not _inside(place, loop):
            continue
        for at, members in rings:
            if float(np.linalg.norm(at - place)) < 0.05 * pitch:
                members.append(s.index)
                break
        else:
            rings.append((place, [s.index]))
    hollow = [(place, [i for i in members if solids[i].hole > 0.0]) for place, members in rings]
    if any(members for _, members in hollow):
        rings = [(place, members) for place, members in hollow if members]
    else:
        rings = [(place, [max(members, key=lambda i: (round(solids[i].reach, 5), -i))]) for place, members in rings]
    wheels = []
    for place, members in rings:
        main = max(members, key=lambda i: (round(solids[i].reach, 5), -i))
        radius = solids[main].reach
        gap = float(np.linalg.norm(loop - place, axis=1).min()) - radius
        if gap < 1.2 * pitch and radius > 0.15 * pitch:
            bolts = _bolted(place, radius, middle, plane, axis, width, solids, taken | set(members))
            center = middle + place @ plane
            wheels.append(
                TrackWheel((main, *(i for i in members if i != main), *bolts), center, radius, _rim(solids[main]))
            )
    return wheels


def _inside(point: Floats, loop: Floats) -> bool:
    """Whether a point (2,) is inside a closed polygon (n, 2)."""
    a, b = loop, np.roll(loop, -1, axis=0)
    crosses = (a[:, 1] > point[1]) != (b[:, 1] > point[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        at = a[:, 0] + (point[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    return bool(np.count_nonzero(crosses & (point[0] < at)) % 2)


def _bolted(
    place: Floats, radius: float, middle: Floats, plane: Floats, axis: Floats, width: float,
    solids: Sequence[Solid], others: set[int],
) -> list[int]:  # fmt: skip
    """Bolts of a wheel: three or more equal bars along its axis, at one distance from it and within its rim."""
    circles: dict[tuple[float, float, float], list[int]] = {}
    for s in solids:
        if s.index in others or s.shaft is None or abs(float(s.shaft.direction @ axis)) < PARALLEL_TWINS:
            continue
        away = float(np.linalg.norm(plane @ (s.shaft.center - middle) - place))
        low, high = s.span(middle, axis)
        if 0.05 * radius < away < radius and abs(0.5 * (low + high)) < 0.5 * width:
            circles.setdefault((round(s.volume, 8), round(away, 3), round(s.shaft.radius, 4)), []).append(s.index)
    return [i for members in circles.values() if len(members) >= 3 for i in members]


def _rim(solid: Solid) -> float:
    """Radius of the outermost whole cylinder about its axis, as a share of its reach."""
    assert solid.axis is not None
    outer = [c.radius for c in solid.cylinders if not c.inner and c.full and coaxial(c, solid.axis, 0.05)]
    return max(outer, default=0.0) / solid.reach
