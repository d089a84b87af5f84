"""How a machine stands, before any body is known: which way is up, across and ahead.

Machines are alike to the left and to the right, they stand on something wide and long, and their arms reach out to the
front of what they stand on. Each is read off the surface as it is, whatever it is made of.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import ConvexHull, cKDTree

from yellowiron.alignment.facing import UNTOLD, Facing
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.features.wheels import Wheel
from yellowiron.alignment.tolerances import SAME_DIRECTION
from yellowiron.model.geometry import Floats
from yellowiron.support.vectors import unit

SEVERAL = 4
HINGED = 0.6
"""So much less unlike its mirror image a machine may be along the direction of at least `SEVERAL` hinges."""
POINTS = 2500
"""The surface is looked at by so many points."""
SOLE = 0.012
"""Points this near to the lowest, in machine sizes, stand on the ground."""
USUAL = 1.5
"""How much more the file's own axes are believed to be up or across than other directions that are as good."""
UNLIKE = 0.05
"""What has no twin within this share of the machine's size has none."""
ROUNDS = 8
"""So often a guess of the plane of symmetry is mended."""
CELL = 0.02
"""The ground is divided into cells of this share of the machine's size."""
OUTER = 0.6
"""What a machine stands on is farther than this share of its stand's half width from the middle."""
STEADY = 0.6
"""A stand is usually at least so many times as long as it is wide."""
WHEELS, BASE = 4, 0.1
"""So many wheels tell where a machine stands, if they are so far from each other, along and across, in sizes."""
UPRIGHT = 2.0
"""How much more the file's z or y is believed to be up than another direction that is as good a stand."""
LEVELS = (0.0, 0.03, 0.06, 0.09, 0.12, 0.15, 0.18)
"""How far, in sizes, a bucket may reach below the ground where the file's own axes say what is up."""
HALF = 0.4
"""The ground is the lowest level that gives this share of the best stand."""
LYING = 0.05
"""The file's own upright counts where it is this nearly across the axes of the hinges (cosine)."""


@dataclass(frozen=True, eq=False)
class Stance:
    """`rotation` (3, 3): rows forward, left, up, in the CAD frame; `origin` (3,) on the ground, in the middle of what
    the machine stands on; `size` metres; `likeness` 0 to 1, how alike left and right are; `wheeled`: whether it stands
    on wheels that were found. Where only a part of a machine is `drawn`, `absent` bodies are not in it, and its size is
    `larger` times what the surface tells by itself. `told`: a person said where its front is. `other` (3,): where the
    origin could be as well; none where what it stands on tells that."""

    rotation: Floats
    origin: Floats
    size: float
    likeness: float
    drawn: float = 1.0
    wheeled: bool = False
    absent: frozenset[str] = frozenset()
    told: bool = False
    larger: float = 1.0
    other: Floats | None = None

    @property
    def left(self) -> Floats:
        """The direction that hinges of a planar linkage have."""
        return np.asarray(self.rotation[1])

    def turned(self) -> Stance:
        """The same with its front behind."""
        return replace(self, rotation=self.rotation * np.array([[-1.0], [-1.0], [1.0]]))

    def elsewhere(self) -> list[Stance]:
        """The same with its origin where that could be as well."""
        return [] if self.other is None else [replace(self, origin=self.other, other=None)]

    def as_part(self, points: Floats, low: Floats, high: Floats, drawn: float, absent: Collection[str]) -> Stance:
        """The same if what is drawn (`points` (n, 3) all over it) is the part of a machine that is usually between
        `low` and `high` (3,), in machine sizes, has so much of its surface, and is without the `absent` bodies."""
        own = points @ self.rotation.T
        ends = np.array([own.min(axis=0), own.max(axis=0)])
        size = float(np.linalg.norm(ends[1] - ends[0]) / np.linalg.norm(high - low))
        middle = self.rotation.T @ (ends.mean(axis=0) - 0.5 * (low + high) * size)
        larger = size / self.size * self.larger
        lost = frozenset(absent)
        return replace(self, origin=middle, other=None, size=size, drawn=drawn, absent=lost, larger=larger)

    def matrix(self) -> Floats:
        """(4, 4) from CAD metres to the machine's frame."""
        found = np.eye(4)
        found[:3, :3] = self.rotation
        found[:3, 3] = -self.rotation @ self.origin
        return found

    def place(self, point: Floats) -> Floats:
        """A point (…, 3) in the machine's frame, in machine sizes."""
        return np.asarray((point - self.origin) @ self.rotation.T / self.size)


def stance_of(solids: Sequence[Solid], size: float, hinges: Sequence[Floats] = (), facing: Facing = UNTOLD) -> Stance:
    """How the machine stands. `hinges`: directions of axes that were found, of which most lie across the machine;
    `size`: the machine's diagonal, metres; `facing`: what a person said of it."""
    points = surface_points(solids)
    left, likeness = _across(points, size, _commonest(hinges))
    up = _up(points, left, size)
    forward = np.cross(left, up)
    reach = points @ forward
    if reach.max() + reach.min() < 2 * reach.mean():
        forward, left = -forward, -left
    forward, left, up = facing.obeyed(np.array([forward, left, up]))
    stands = [_stand(points, left, up, size, h) for h in LEVELS]
    level = next(h for h, stand in zip(LEVELS, stands, strict=True) if stand >= HALF * max(stands))
    standing = points[np.abs(points @ up - (points @ up).min() - level * size) < SOLE * size]
    # A bucket may be as low: tracks are farther out than it is.
    aside = np.abs(standing @ left - 0.5 * ((standing @ left).min() + (standing @ left).max()))
    outer = standing[aside >= OUTER * aside.max()]  # all of it, where it has no width
    middle, inner = (0.5 * (some.min(axis=0) + some.max(axis=0)) for some in (outer, standing))
    found = Stance(np.array([forward, left, up]), middle, size, likeness, told=facing.forward is not None)
    # Nothing stands on two wheels: the third is in the middle. But a stand may be wider than it is long.
    steady = np.ptp(outer @ forward) >= STEADY * np.ptp(outer @ left)
    return found if steady else replace(found, origin=inner, other=middle)


def on_wheels(stance: Stance, wheels: Sequence[Wheel]) -> Stance:
    """The same with its origin in the middle of four wheels or more, on the ground that they stand on: a bucket on the
    ground stands there too, but not always. As it was where fewer were found, or they do not stand on one plane."""
    if len(wheels) < WHEELS or min(abs(float(w.direction @ stance.left)) for w in wheels) < SAME_DIRECTION:
        return stance
    forward, left, up = stance.rotation
    radii = np.array([w.radius for w in wheels])
    soles = np.array([w.center for w in wheels]) - radii[:, None] * up
    run, across, heights = soles @ forward, soles @ left, soles @ up
    base = min(float(np.ptp(run)), float(np.ptp(across)))
    if np.ptp(heights) > 2.0 * SOLE * stance.size or base < BASE * stance.size:
        return stance
    ahead = 0.5 * ((run - radii).min() + (run + radii).max())
    middle = ahead * forward + 0.5 * (across.min() + across.max()) * left + float(heights.mean()) * up
    return replace(stance, origin=middle, other=None, wheeled=True)


def surface_points(solids: Sequence[Solid], count: int = POINTS) -> Floats:
    """(n, 3) points all over the surface, more where there is more of it; the same every time."""
    return spread_over(np.concatenate([s.points[s.shape.mesh.triangles] for s in solids]), count)


def spread_over(corners: Floats, count: int = POINTS) -> Floats:
    """(n, 3) points all over triangles with these corners (m, 3, 3)."""
    double = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    total = np.cumsum(double)
    rng = np.random.default_rng(0)
    chosen = np.searchsorted(total, (np.arange(count) + 0.5) / count * total[-1])
    u, v = np.sort(rng.random((2, count)), axis=0)
    weights = np.stack([u, v - u, 1 - v], axis=1)
    return np.asarray(np.einsum("ij,ijk->ik", weights, corners[chosen]))


def _commonest(hinges: Sequence[Floats]) -> list[Floats]:
    """The direction that at least half of several axes have, if there is one."""
    if len(hinges) < SEVERAL:
        return []
    every = np.array(hinges)
    alike = np.abs(every @ every.T) > SAME_DIRECTION
    first = int(np.argmax(alike.sum(axis=1)))
    if alike[first].sum() < 0.5 * len(hinges):
        return []
    turned = every[alike[first]]
    return [unit((turned * np.sign(turned @ every[first])[:, None]).sum(axis=0))]


def _across(points: Floats, size: float, hinges: Sequence[Floats]) -> tuple[Floats, float]:
    """The direction along which the surface is most like its mirror image; that of the hinges before others: half a
    machine is like nothing."""
    principal = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2]
    tree, limit = cKDTree(points), UNLIKE * size
    best = (np.inf, np.array([0.0, 1.0, 0.0]))
    for number, start in enumerate([*np.eye(3), *hinges, *principal]):
        along = points @ start
        for middle in (np.median(along), 0.5 * (along.min() + along.max()), along.mean()):
            own = number < 3 + len(hinges)
            direction, off = mirrored(points, tree, start, middle, limit, rounds=1 if own else ROUNDS)
            off *= (1.0 if number < 3 else HINGED) if own else USUAL
            if off < best[0] - 1e-12:
                best = (off, direction)
    return unit(best[1]), 1.0 - best[0] / limit


def mirrored(
    points: Floats, tree: cKDTree, direction: Floats, middle: float, limit: float, *, rounds: int
) -> tuple[Floats, float]:
    """The direction, turned in further `rounds` so that the mirrored surface lies on the surface, and how far off it
    is then, metres: the mean of what has a twin within `limit`, and of `limit` for what has none. The boom or the cab
    may be to one side."""
    for _ in range(rounds):
        image = points - 2.0 * (points @ direction - middle)[:, None] * direction
        gaps, nearest = tree.query(image, distance_upper_bound=limit)  # infinite beyond
        off = float(np.mean(np.minimum(gaps, limit)))
        if rounds > 1:
            good = gaps < limit
            matched = np.asarray(nearest)[good]
            one, other = points[good], points[matched]
            one, other = one - one.mean(axis=0), other - other.mean(axis=0)
            # min over n of |q - p + 2 n (n.p)|^2 = const + 4 (n.p)(n.q)
            _, vectors = np.linalg.eigh(one.T @ other + other.T @ one)
            direction = vectors[:, 0]
            middle = 0.5 * float((points[good].mean(axis=0) + points[matched].mean(axis=0)) @ direction)
    return direction, off


def _up(points: Floats, left: Floats, size: float) -> Floats:
    """Across `left`: away from where the surface ends in something that is wide and long. The ground touches the
    outline in two places, so it is an edge of its hull."""
    first = unit(np.cross(left, np.eye(3)[int(np.argmin(np.abs(left)))]))
    second = np.cross(left, first)
    flat = np.stack([points @ first, points @ second], axis=1)
    hull = ConvexHull(flat)
    edges = -(hull.equations[:, :1] * first + hull.equations[:, 1:2] * second)
    best = (-1.0, first)
    for number, up in enumerate([*np.eye(3)[1:], *edges]):
        if abs(float(up @ left)) > LYING:
            continue
        score = max(_stand(points, left, up, size, level) for level in (LEVELS if number < 2 else LEVELS[:1]))
        score *= UPRIGHT if number < 2 else 1.0
        if score > best[0] * (1 + 1e-9):
            best = (score, np.asarray(up))
    return unit(best[1] - (best[1] @ left) * left)


def _stand(points: Floats, left: Floats, up: Floats, size: float, level: float) -> float:
    """How wide, long and full a stand the surface has `level` (in sizes) above its lowest point; 0 where the machine
    would fall over on it."""
    ahead = np.cross(left, up)
    heights = points @ up - float((points @ up).min()) - level * size
    standing = points[np.abs(heights) < SOLE * size]
    if len(standing) < 3:
        return 0.0
    run = standing @ ahead
    if not run.min() < float(points.mean(axis=0) @ ahead) < run.max():
        return 0.0
    return float(np.std(standing @ left) * np.std(run) * np.sqrt(_cells(standing, left, up, size)))


def _cells(points: Floats, left: Floats, up: Floats, size: float) -> int:
    """How many cells of the ground points are over."""
    flat = np.stack([points @ left, points @ np.cross(left, up)], axis=1)
    return len(np.unique(np.floor(flat / (CELL * size)), axis=0))
