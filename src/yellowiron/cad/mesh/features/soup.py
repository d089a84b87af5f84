"""A triangle mesh with what stands beside what: welded corners, normals, and the edges between two triangles."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from yellowiron.cad.mesh import measures
from yellowiron.cad.mesh.components import linked
from yellowiron.cad.mesh.features.tolerances import SLIGHTEST, WIDEST
from yellowiron.model.geometry import Floats, Mesh

Indices = NDArray[np.int64]
Flags = NDArray[np.bool_]

_LEVEL = math.radians(0.05)
"""Triangles side by side are one strip within this angle, radians."""
_CROWD = 40
"""A flat facet with more folds than this around it is no strip."""
_FEW = 30
"""Of corners so many times fewer than a mesh has points those that are there are sorted, not looked for among all."""


@dataclass(frozen=True, eq=False)
class Soup:
    """Triangles `corners` (m, 3) of `points`, their unit `normals` and `areas`; and the `edges` (k, 2) of exactly two
    triangles each that face the same way: the `pair` (k, 2) of triangles, their corners `opposite` (k, 2) the edge, the
    `angle` (k,) between their normals in radians, and whether the fold is `concave`. Metres.

    `rounding`: what the coordinates may be off by; `size`: the diagonal.
    """

    points: Floats
    corners: Indices
    normals: Floats
    areas: Floats
    middles: Floats
    edges: Indices
    pair: Indices
    opposite: Indices
    angle: Floats
    concave: Flags
    size: float
    rounding: float

    @property
    def resolution(self) -> float:
        """Metres: what is smaller cannot be told from the rounding of the coordinates."""
        return 4.0 * self.rounding

    @functools.cached_property
    def tree(self) -> cKDTree:
        """The triangles' middles, to look things up by place."""
        return cKDTree(self.middles)

    @functools.cached_property
    def bent(self) -> Flags:
        """(k,) whether the edges fold as two strips of one cylinder do."""
        return np.asarray((self.angle > SLIGHTEST) & (self.angle < WIDEST))

    @functools.cached_property
    def beside(self) -> Indices:
        """`beside` of all edges that are bent."""
        return beside(self, np.flatnonzero(self.bent))

    def corners_of(self, triangles: Indices) -> Floats:
        """The points (n, 3) that some triangles have for corners, each once, in their order."""
        corners = self.corners[triangles]
        if len(self.points) > _FEW * corners.size:
            return self.points[np.unique(corners)]
        used = np.zeros(len(self.points), dtype=bool)
        used[corners] = True
        return self.points[used]

    @functools.cached_property
    def facets(self) -> Indices:
        """(m,) numbers of the flat facets that triangles make up with those beside them."""
        return flat_facets(self, _LEVEL)


def beside(soup: Soup, chosen: Indices) -> Indices:
    """(k, 2) pairs of rows of `chosen` whose folds bound one triangle, one flat facet or two adjacent triangles."""
    row = np.full(len(soup.edges), -1, dtype=np.int64)
    row[chosen] = np.arange(len(chosen))
    of_triangle = np.full((len(soup.corners), 3), -1, dtype=np.int64)
    for side in (0, 1):
        faces = soup.pair[:, side]
        local = np.argmax(soup.corners[faces] == soup.opposite[:, side][:, None], axis=1)
        of_triangle[faces, local] = row

    def joined(one: Indices, other: Indices) -> Indices:
        """A number for each two rows that are there and two: all pairs as they are would be most of a reader's
        memory."""
        low, high = np.minimum(one, other), np.maximum(one, other)
        good = (low >= 0) & (low != high)
        return np.asarray(low[good] * len(chosen) + high[good])

    found = [joined(of_triangle[:, i], of_triangle[:, j]) for i, j in ((0, 1), (1, 2), (0, 2))]
    left, right = of_triangle[soup.pair[:, 0]], of_triangle[soup.pair[:, 1]]
    found += [joined(left[:, i], right[:, j]) for i in range(3) for j in range(3)]
    facet = soup.facets
    faces = np.concatenate([soup.pair[chosen, 0], soup.pair[chosen, 1]])
    rows = np.tile(np.arange(len(chosen)), 2)
    order = np.argsort(facet[faces], kind="stable")
    label, rows = facet[faces][order], rows[order]
    sizes = np.bincount(label)
    for step in range(1, 6):
        near = label[step:] == label[:-step]
        near &= sizes[label[step:]] <= _CROWD
        found.append(joined(rows[:-step][near], rows[step:][near]))
    keys = np.unique(np.concatenate(found))
    return np.stack([keys // len(chosen), keys % len(chosen)], axis=1)


def flat_facets(soup: Soup, angle: float) -> Indices:
    """(m,) numbers of the flat facets that triangles make up with those beside them within an angle, radians."""
    return linked(soup.pair[soup.angle <= angle], len(soup.corners))


def soup_of(mesh: Mesh, number: Indices | None = None) -> Soup:
    """The triangles of a mesh, its coincident points made one; those that lose their area by it, and those that are
    there twice, are left out. `number` is `welded(mesh)`, where that is known."""
    number = measures.welded(mesh) if number is None else number
    points = np.zeros((int(number.max()) + 1, 3))
    points[number[::-1]] = mesh.points[::-1]
    corners = number[mesh.triangles]
    cross = measures.cross(points[corners[:, 1]] - points[corners[:, 0]], points[corners[:, 2]] - points[corners[:, 0]])
    twice = np.linalg.norm(cross, axis=1)
    low, high = measures.bounds(mesh)
    size = float(np.linalg.norm(high - low))
    good = twice > 1e-14 * size**2
    # Shells that are drawn from both sides count once.
    first = measures.distinct_triangles(corners)[0]
    once = np.zeros(len(corners), dtype=bool)
    once[first] = True
    good &= once
    corners, cross, twice = corners[good], cross[good], twice[good]
    normals = cross / twice[:, None]
    edges, pair, opposite = _edges(corners)
    dot = np.clip(np.einsum("ij,ij->i", normals[pair[:, 0]], normals[pair[:, 1]]), -1.0, 1.0)
    over = points[opposite[:, 1]] - points[edges[:, 0]]
    largest = float(np.abs(mesh.points).max()) if len(mesh.points) else 0.0
    return Soup(
        points=points,
        corners=corners,
        normals=normals,
        areas=0.5 * twice,
        middles=points[corners].mean(axis=1),
        edges=edges,
        pair=pair,
        opposite=opposite,
        angle=np.arccos(dot),
        concave=np.einsum("ij,ij->i", over, normals[pair[:, 0]]) > 0.0,
        size=size,
        rounding=2.0 * float(np.finfo(np.float32).eps) * largest,
    )


def _edges(corners: Indices) -> tuple[Indices, Indices, Indices]:
    """(edges, pair, opposite) of the edges that two triangles run through in opposite directions, and no third."""
    count = len(corners)
    start = np.concatenate([corners[:, 0], corners[:, 1], corners[:, 2]])
    end = np.concatenate([corners[:, 1], corners[:, 2], corners[:, 0]])
    far = np.concatenate([corners[:, 2], corners[:, 0], corners[:, 1]])
    face = np.tile(np.arange(count), 3)
    low, high = np.minimum(start, end), np.maximum(start, end)
    order = np.lexsort((face, start != low, high, low))
    low, high, start, face, far = low[order], high[order], start[order], face[order], far[order]
    same = np.zeros(len(low) + 1, dtype=bool)
    same[1:-1] = (low[1:] == low[:-1]) & (high[1:] == high[:-1])
    first = np.flatnonzero(~same[:-1] & same[1:])
    first = first[~same[np.minimum(first + 2, len(same) - 1)]]
    first = first[start[first] != start[first + 1]]
    return (
        np.stack([low[first], high[first]], axis=1),
        np.stack([face[first], face[first + 1]], axis=1),
        np.stack([far[first], far[first + 1]], axis=1),
    )
