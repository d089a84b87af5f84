"""A machine that stands askew in its file is read as if it stood square in it.

Boxes, and with them sizes, neighbourhoods and places, are told along the axes of the frame that a model is in. What was
put into a scene at some other angle has other boxes for that, and would be another machine to whoever looks at them. So
it is turned until the frame's axes are those that its faces look along; what was found is turned back.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from yellowiron.alignment.facing import quarters
from yellowiron.alignment.fusion.stance import UNLIKE, mirrored, spread_over
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.support.caching.remembered import remembered
from yellowiron.support.vectors import triple, unit

ALONG = np.cos(np.radians(4.0))
"""Faces that look in one direction as nearly as this look along it."""
ACROSS = np.sin(np.radians(6.0))
"""Two directions are across each other as nearly as this."""
EXACTLY = np.sin(np.radians(0.6))
"""… and a direction and an axis of the file that is an axis of the machine's."""
WAYS = 8
"""So many directions are tried in which most of the surface looks."""
MORE = 1.5
"""A machine is askew in a frame if so many times as much of its surface looks along the axes of another one."""
NEARER = (4.0, 2.0, 1.0, 0.5)
"""Degrees: what is slightly bent or tapered looks along no axis."""
LARGEST = 20_000
"""So many of the largest faces are looked at: what is round has small ones."""
SAME = 0.9
"""An axis of the file is believed where it has this share of what one beside it has."""
TILTED = 3.0
"""A frame without any of the file's axes has more than so many times as much of the surface as one with one of them: of
a loader's work equipment 2.5, the boom's and the bucket's faces beside what looks across."""
LATTICE = 400
"""Directions all over half a sphere, 7° from each other."""


@remembered
def squared(assembly: Assembly) -> tuple[Assembly, Floats] | None:
    """A model that stands askew in its file, turned to stand square, with the rotation (3, 3); None for any other."""
    rotation = square_to(assembly)
    return None if rotation is None else (turned(assembly, rotation), rotation)


def square_to(assembly: Assembly) -> Floats | None:
    """The rotation (3, 3) from the file's frame to the nearest one in which the machine stands square; None where it
    does so in the file's, or nothing tells. Arms are raised or lowered about what lies across the machine: of that, no
    turn tells how it stands."""
    if not assembly.parts:
        return None
    corners = np.concatenate([assembly.points_of(p)[assembly.shape_of(p).mesh.triangles] for p in assembly.parts])
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    most = np.sort(np.argsort(-areas, kind="stable")[:LARGEST])
    most = most[areas[most] > 0.0]
    normals, areas = normals[most] / areas[most, None], areas[most]

    def along(axes: Floats) -> float:
        return float(areas[(np.abs(normals @ axes.T) > ALONG).any(axis=1)].sum())

    ways, own = _looked_in(normals, areas), along(np.eye(3))
    # One axis of the file is nearly always the machine's, or nearly so, mostly its upright.
    nearly = [way for way in ways if np.abs(way).max() > np.cos(np.arcsin(ACROSS))]
    kept, leaning, any_one = (
        max(_frames(ones, ways, across), key=along, default=np.eye(3))
        for ones, across in ((np.eye(3), EXACTLY), (nearly, EXACTLY), (ways, ACROSS))
    )
    exact = SAME * along(leaning) <= along(kept)
    best = kept if exact else leaning
    tilted = along(any_one) > TILTED * max(along(best), own)
    best = any_one if tilted else best
    if along(best) <= MORE * own:
        return None
    drawn_to = _drawn_to(best, normals, areas)
    best = next(_frames([best[0]], [drawn_to[1]], ACROSS)) if exact and not tilted else drawn_to
    if not tilted and _most_even(spread_over(corners), best) == 0:
        return None
    return np.asarray(max((q @ best for q in quarters()), key=lambda turn: round(float(np.trace(turn)), 9)))


def turned(assembly: Assembly, rotation: Floats) -> Assembly:
    """The model turned by a rotation (3, 3) about the origin of its frame, with all that it declares."""
    whole = np.eye(4)
    whole[:3, :3] = rotation
    return replace(
        assembly,
        parts=tuple(replace(p, transform=whole @ p.transform) for p in assembly.parts),
        nodes=tuple(replace(n, transform=whole @ n.transform) for n in assembly.nodes),
        joints=tuple(
            replace(j, anchor=triple(rotation @ np.array(j.anchor)), axis=triple(rotation @ np.array(j.axis)))
            for j in assembly.joints
        ),
    )


def turned_back(found: Alignment, rotation: Floats) -> Alignment:
    """What was found of a model that had been `turned` by a rotation (3, 3), in its file's frame."""
    whole = np.eye(4)
    whole[:3, :3] = rotation
    axes = {
        j: (triple(np.array(at) @ rotation), triple(np.array(way) @ rotation)) for j, (at, way) in found.axes.items()
    }
    return replace(found, frame=found.frame @ whole, axes=axes)


def _most_even(points: Floats, axes: Floats) -> int:
    """The axis of a frame (3, 3) along which the surface is most like its mirror image: that across the machine."""
    tree, limit = cKDTree(points), UNLIKE * float(np.linalg.norm(np.ptp(points @ axes.T, axis=0)))
    off = []
    for axis, along in zip(axes, (points @ axes.T).T, strict=True):
        middles = (float(np.median(along)), 0.5 * float(along.min() + along.max()))
        off.append(min(mirrored(points, tree, axis, middle, limit, rounds=1)[1] for middle in middles))
    return int(np.argmin(off))


def _looked_in(normals: Floats, areas: Floats) -> list[Floats]:
    """The directions, either way, that most of the surface looks in: (3,) each."""
    found: list[Floats] = []
    grid, left = _hemisphere(), areas.copy()
    nearest = np.abs(normals @ grid.T).argmax(axis=1)
    for _ in range(WAYS):
        cell = int(np.bincount(nearest, left, len(grid)).argmax())
        way = _mean(grid[cell], normals, left, nearest == cell)
        way = _mean(way, normals, left, np.abs(normals @ way) > ALONG)
        found.append(way)
        left = np.where(np.abs(normals @ way) > ALONG, 0.0, left)
    return found


def _mean(way: Floats, normals: Floats, areas: Floats, alike: NDArray[np.bool_]) -> Floats:
    """The direction in which those faces look, as a whole, that are `alike`, turned to look along `way`."""
    total = (np.sign(normals[alike] @ way) * areas[alike]) @ normals[alike]
    return unit(total) if np.linalg.norm(total) > 0.0 else way


def _frames(ones: Iterable[Floats], others: Sequence[Floats], across: float) -> Iterator[Floats]:
    """The frames (3, 3) that two directions give whose cosine is less, the first of them exact."""
    for one, other in itertools.product(ones, others):
        if abs(float(one @ other)) < across:
            second = unit(other - float(other @ one) * one)
            yield np.array([one, second, np.cross(one, second)])


def _drawn_to(axes: Floats, normals: Floats, areas: Floats) -> Floats:
    """A frame (3, 3) turned to the faces that look along its axes, each time to those that do so more nearly."""
    for degrees in NEARER:
        along = normals @ axes.T
        nearest = np.abs(along).argmax(axis=1)
        cosine = along[np.arange(len(along)), nearest]
        alike = np.abs(cosine) > np.cos(np.radians(degrees))
        pulls = np.zeros((3, 3))
        np.add.at(pulls, nearest[alike], (np.sign(cosine) * areas)[alike, None] * normals[alike])
        u, weights, v = np.linalg.svd(pulls)
        if weights[1] > 0.0:
            axes = u @ np.diag([1.0, 1.0, float(np.sign(np.linalg.det(u @ v)))]) @ v
    return axes


def _hemisphere() -> Floats:
    """(n, 3) directions evenly all over one half of a sphere (a Fibonacci lattice)."""
    k = np.arange(LATTICE) + 0.5
    turn, z = np.pi * (1.0 + np.sqrt(5.0)) * k, 1.0 - k / LATTICE
    flat = np.sqrt(1.0 - z * z)
    return np.stack([flat * np.cos(turn), flat * np.sin(turn), z], axis=1)
