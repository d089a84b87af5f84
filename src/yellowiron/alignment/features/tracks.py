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
from scipy.spatial import ConvexHull, cKDTree

from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.features.track_wheels import TrackWheel, track_wheels_of
from yellowiron.alignment.tolerances import PARALLEL_TWINS
from yellowiron.model.geometry import Floats

LEAST = 20
"""Fewer equal parts in a row are no track."""
EQUAL = (2e-3, 0.07)
"""Equal parts differ by no more than this share of their volume and area (a mirror image is equal); the second where
that gives no track, as of parts that were scaled one by one (a per cent makes three of the volume)."""
NEXT = 1.35
"""A neighbour in the row is nearer than this many times the usual distance."""
FLAT = 0.03
"""How far a row may be from a plane, as a share of its length."""
BESIDE = 0.1
"""What is within this share of a loop's height of its lowest or highest line lies along that."""
POINTED = 0.5
"""A loop runs to a point where less than this share of its longest side's length lies opposite that side."""
PLACE = 0.3
"""Two parts sit at the same place of their shoes if their places differ by less than this many pitches."""


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

    @property
    def above(self) -> Floats | None:
        """The unit direction from the ground up, of a loop that runs to a point above it (a high sprocket's); None of
        one that is as long above as below."""
        plane = np.linalg.svd(self.centers - self.centers.mean(axis=0))[2][:2]
        flat = self.centers @ plane.T
        corners = flat[ConvexHull(flat).vertices]
        best, found = 0.0, None
        for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            way = (end - start) / np.linalg.norm(end - start)
            heights = (flat - start) @ np.array([-way[1], way[0]])
            high = float(np.ptp(heights))
            low, top = (
                float(np.ptp(flat[on] @ way)) for on in (heights < BESIDE * high, heights > (1 - BESIDE) * high)
            )
            if low > best:
                best, found = low, np.array([-way[1], way[0]]) @ plane if top < POINTED * low else None
        return found


def tracks_of(solids: Sequence[Solid]) -> list[Track]:
    """The machine's tracks: of all classes of equal parts the one whose closed rows are the bulkiest; two of them that
    are equal, or one."""
    classes: list[list[int]] = []
    best: list[list[int]] = []
    for equal in EQUAL:
        classes = classes if best else _classes(solids, equal)
        best = best or _bulkiest(classes, solids)
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
        wheels = track_wheels_of(row, axis, solids, taken)
        points = tuple(np.concatenate([solids[i].points for i in shoe]) for shoe in shoes)
        tracks.append(Track(tuple(shoes), centers, axis, tuple(wheels), points))
    return tracks


# ---- rows ----
def _bulkiest(classes: list[list[int]], solids: Sequence[Solid]) -> list[list[int]]:
    """The closed rows of the class whose rows are the bulkiest; none where none has any."""
    best: list[list[int]] = []
    bulk = 0.0
    for members in classes:
        rows = _rows(members, solids)
        size = solids[members[0]].size * sum(map(len, rows))
        if rows and size > bulk:
            best, bulk = rows, size
    return best


def _classes(solids: Sequence[Solid], equal: float) -> list[list[int]]:
    """Solids by volume and area, those that are `equal` (or mirror images) together, in the order of the first."""
    order = sorted(range(len(solids)), key=lambda i: (solids[i].volume, solids[i].surface, i))
    classes: list[list[int]] = []
    # Those to which one more may belong: of a volume not too small.
    near: list[list[int]] = []
    for i in order:
        near = [c for c in near if solids[c[0]].volume >= (1.0 - equal) * solids[i].volume]
        same = next((c for c in near if _equal(solids[c[0]], solids[i], equal)), None)
        if same is None:
            near.append([i])
            classes.append(near[-1])
        else:
            same.append(i)
    return sorted((sorted(c) for c in classes), key=lambda c: c[0])


def _equal(a: Solid, b: Solid, share: float) -> bool:
    alike = abs(a.volume - b.volume) <= share * max(a.volume, b.volume)
    return alike and abs(a.surface - b.surface) <= share * max(a.surface, b.surface)


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
        row = _walk(min(left), neighbours, left)
        left -= set(row)
        closed = len(row) >= LEAST and row[0] in neighbours[row[-1]]
        if closed and _in_plane(points[row]):
            rows.append([members[i] for i in row])
    return rows


def _walk(start: int, neighbours: list[list[int]], left: set[int]) -> list[int]:
    """The parts from one neighbour to the next, until there is none or the first one comes again."""
    row, before, here = [start], -1, start
    while True:
        onward = [j for j in neighbours[here] if j != before and j in left]
        if not onward or (onward[0] == start and len(row) > 2):
            return row
        before, here = here, min(onward) if before < 0 else onward[0]
        if here in row:
            return row
        row.append(here)


def _in_plane(points: Floats) -> bool:
    spread = np.linalg.svd(points - points.mean(axis=0), compute_uv=False) / np.sqrt(len(points))
    return bool(spread[2] < FLAT * spread[0] and spread[1] > 2 * spread[2])


# ---- what goes with a shoe ----
@dataclass(frozen=True, eq=False)
class _Row:
    """The shoes of a row: places (n, 3) of their main parts, axes (n, 3, 3; rows: along the row, outwards, across) and
    extents along them (3,), the pitch, and what finds the nearest. Metres."""

    centers: Floats
    axes: Floats
    extents: Floats
    pitch: float
    tree: cKDTree


def _row(row: list[int], solids: Sequence[Solid]) -> _Row:
    centers = np.array([solids[i].center for i in row])
    along = np.roll(centers, -1, axis=0) - np.roll(centers, 1, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    across = np.linalg.svd(centers - centers.mean(axis=0))[2][2]
    outwards = np.cross(across, along)
    # Of a loop walked the other way they point inwards.
    if float(np.einsum("ij,ij->i", outwards, centers - centers.mean(axis=0)).sum()) < 0:
        outwards = -outwards
    pitch = float(np.median(np.linalg.norm(np.roll(centers, -1, axis=0) - centers, axis=1)))
    axes = np.stack([along, outwards, np.broadcast_to(across, along.shape)], axis=1)
    few = [np.ptp((solids[i].points - centers[k]) @ axes[k].T, axis=0) for k, i in enumerate(row[:3])]
    return _Row(centers, axes, np.max(few, axis=0), pitch, cKDTree(centers))


def _companions(
    row: list[int], solids: Sequence[Solid], classes: list[list[int]], taken: set[int]
) -> list[tuple[int, ...]]:
    """For every shoe of a row its solids, main one first: of each class of which there are as many near the row as
    shoes, or twice, three times as many, the part that sits at the same place of each."""
    along = _row(row, solids)
    shoes: list[list[int]] = [[i] for i in row]
    for members in classes:
        near = [i for i in members if i not in taken and i not in row and _beside(solids[i], along)]
        if not near or len(near) % len(row):
            continue
        for slot in _slots(near, along, solids, shoes):
            for k, i in slot.items():
                shoes[k].append(i)
    return [tuple(shoe) for shoe in shoes]


def _beside(solid: Solid, row: _Row) -> bool:
    """Whether a solid is within the shoes' width and about a pitch of their middle."""
    middle = solid.center
    _, k = row.tree.query(middle)
    local = row.axes[k] @ (middle - row.tree.data[k])
    small = solid.size < 1.5 * float(np.linalg.norm(row.extents)) + row.pitch
    near = abs(local[0]) < 0.8 * row.pitch and abs(local[1]) < row.pitch
    return bool(small and abs(local[2]) <= 0.55 * row.extents[2] and near)


def _slots(near: list[int], row: _Row, solids: Sequence[Solid], shoes: list[list[int]]) -> list[dict[int, int]]:
    """Places of a shoe at which every shoe has one of these parts: shoe → part, a place each, all parts used once.

    A part between two shoes is at a place of either: that of the shoe with the tighter fit is taken.
    """
    whole = []
    for local, members in _places(near, row, solids):
        by_shoe = {k: i for i, k in reversed(members)}
        if len(by_shoe) == len(shoes) and len(set(by_shoe.values())) == len(shoes):
            loose = _looseness(next(iter(by_shoe.items())), solids, shoes)
            away = round(float(np.linalg.norm(local)) / row.pitch, 2)
            whole.append((round(loose, 6), away, float(local[0]), by_shoe))
    chosen: list[dict[int, int]] = []
    used: set[int] = set()
    for *_, by_shoe in sorted(whole, key=lambda w: w[:3]):
        if not used & set(by_shoe.values()):
            chosen.append(by_shoe)
            used |= set(by_shoe.values())
    return chosen


def _places(near: list[int], row: _Row, solids: Sequence[Solid]) -> list[tuple[Floats, list[tuple[int, int]]]]:
    """Places (3,) in a shoe's axes, each with the (part, shoe) that are there; a part may be at places of several."""
    places: list[tuple[Floats, list[tuple[int, int]]]] = []
    for i in near:
        _, nearest = row.tree.query(solids[i].center, k=3)
        for k in np.atleast_1d(nearest):
            local = row.axes[k] @ (solids[i].center - row.centers[k])
            if abs(local[0]) >= 0.8 * row.pitch:
                continue
            found = [p for p in places if float(np.linalg.norm(p[0] - local)) < PLACE * row.pitch * 0.5]
            if found:
                found[0][1].append((i, int(k)))
            else:
                places.append((local, [(i, int(k))]))
    return places


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
