"""Machines of which one half is drawn, cut at their middle plane or never mirrored: completed by their mirror image."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from yellowiron.cad.mesh import measures
from yellowiron.cad.mesh.assembly import shape_of
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import CadError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Mesh, Shape
from yellowiron.support.caching.remembered import remembered

ON = 5e-4
"""What is nearer to a plane than this share of the model's size lies in it."""
FEWEST = 4
"""So many parts are cut by one plane …"""
SHARE = 0.3
"""… that have this share of the surface that is not drawn on both sides of it, …"""
SOME = 0.1
"""… and this share of all, …"""
BEYOND = 0.05
"""… and no more than this share of it is beyond, but for parts that stand evenly on both sides."""
EVEN = 0.05
"""A part stands evenly where its sides are as far from the plane as the other, by this share of its width."""
FLAT = 0.02
"""A part is cut where at least this share of the circumference of its box in the plane is the edge of an open mesh, or
where at least this share of that box is faces in the plane."""
WHOLE = 0.8
"""What is like its mirror image across any axis, in this share of its surface, is whole: it stands on the plane, or
ends in it."""
LIKE = 0.02
"""A part has a mirror image where a part's box is its own's, mirrored, within this share of the model's size."""
IMAGE = " (mirror image)"
"""Ends the ids of mirror images."""
_ASYMMETRIC = "What is on one side only (a cab, an exhaust) is now on both: give its image no role if it matters."


@dataclass(frozen=True)
class Half:
    """A machine of which one half is drawn: on the `side` (1 or -1) of `axis` (0 to 2) of the file's frame that is
    beyond the coordinate `at`, metres; what is within `on` of that lies in the plane. `cut`: the parts that go on
    beyond the plane. `across`: those that are drawn on both sides."""

    axis: int
    side: int
    at: float
    on: float
    cut: frozenset[str]
    across: frozenset[str]

    def mirror(self) -> Floats:
        """(4, 4) the reflection in the plane, file's frame."""
        matrix = np.eye(4)
        matrix[self.axis, self.axis] = -1.0
        matrix[self.axis, 3] = 2.0 * self.at
        return matrix


@remembered
def half_of(assembly: Assembly) -> Half | None:
    """Where a model is cut in half, or None: a plane across an axis of the file's frame in which many parts end, open
    or with a flat face, all on the same side of it, while what is drawn is like its mirror image across no axis: a
    whole machine may stand on flat parts, or be flush. Of several the one that cuts the most parts."""
    parts = [p for p in assembly.parts if len(assembly.shape_of(p).mesh.triangles)]
    if len(parts) < FEWEST or assembly.joints:
        return None
    points = [assembly.points_of(p) for p in parts]
    meshes = [replace(assembly.shape_of(p).mesh, points=q, normals=None) for p, q in zip(parts, points, strict=True)]
    low, high = (np.array([end(q, axis=0) for q in points]) for end in (np.min, np.max))
    size = float(np.linalg.norm(high.max(axis=0) - low.min(axis=0)))
    on = ON * size
    area = np.array([measures.area_properties(mesh)[0] for mesh in meshes])
    if any(_alike(low, high, area, axis, LIKE * size) > WHOLE for axis in range(3)):
        return None
    halves = []
    for axis in range(3):
        for side, ends, others in ((1, low[:, axis], high[:, axis]), (-1, -high[:, axis], -low[:, axis])):
            for at, voters in _planes(ends, area, on):
                over, drawn = at - ends, others - at
                even = (over > on) & (np.abs(drawn - over) <= EVEN * (drawn + over))
                least = SHARE * area[~even].sum()
                if area[(over > on) & ~even].sum() > BEYOND * area.sum() or area[voters].sum() < least:
                    continue
                cut = [k for k in voters if _is_cut(meshes[k], axis, side * at, on)]
                if len(cut) >= FEWEST and area[cut].sum() >= least:
                    ids = (frozenset(parts[k].id for k in some) for some in (cut, np.flatnonzero(even).tolist()))
                    halves.append(Half(axis, side, side * at, on, *ids))
    return max(halves, key=lambda h: len(h.cut), default=None)


def _alike(low: Floats, high: Floats, area: Floats, axis: int, near: float) -> float:
    """The share of the surface that is of parts whose boxes (n, 3) have a mirror image among the boxes, within `near`
    metres, across an axis in the middle of all."""
    boxes = np.concatenate([low, high], axis=1)
    mirrored = boxes.copy()
    twice = low[:, axis].min() + high[:, axis].max()
    mirrored[:, axis], mirrored[:, axis + 3] = twice - boxes[:, axis + 3], twice - boxes[:, axis]
    off, _ = cKDTree(boxes).query(mirrored, p=np.inf)
    return float(area[off < near].sum() / max(float(area.sum()), 1e-12))


def _planes(ends: Floats, area: Floats, on: float) -> Iterator[tuple[float, list[int]]]:
    """The coordinates at which enough parts of enough surface end, and which parts do."""
    order = np.argsort(ends, kind="stable")
    first, after = np.arange(len(ends)), np.searchsorted(ends[order], ends[order] + on, side="right")
    sums = np.concatenate([[0.0], np.cumsum(area[order])])
    wide = (after - first >= FEWEST) & (sums[after] - sums[first] >= SOME * area.sum())
    # Of windows that end with the same part the widest comes first.
    for start, end in {int(after[k]): (int(k), int(after[k])) for k in np.flatnonzero(wide)[::-1]}.values():
        chosen = order[start:end]
        yield float(np.median(ends[chosen])), sorted(int(k) for k in chosen)


def _is_cut(mesh: Mesh, axis: int, at: float, on: float) -> bool:
    """Whether a part ends in the plane with an open edge or a flat face."""
    inside = np.abs(mesh.points[:, axis] - at) <= on
    if inside.sum() < 3:
        return False
    box = np.ptp(np.delete(mesh.points[inside], axis, axis=1), axis=0)
    flat = np.asarray(inside[mesh.triangles].all(axis=1))
    if flat.any():
        faces, _ = measures.area_properties(measures.chosen(mesh, flat))
        if faces >= FLAT * float(box[0] * box[1]):
            return True
    length = float(np.linalg.norm(_open_edges(mesh, inside), axis=1).sum())
    return length >= FLAT * 2.0 * float(box.sum())


def _open_edges(mesh: Mesh, inside: NDArray[np.bool_]) -> Floats:
    """(n, 3) the edges in the plane that only one triangle has, as vectors."""
    number = measures.welded(mesh)
    corners = mesh.triangles
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    edges = edges[inside[edges].all(axis=1)]
    pairs = np.sort(number[edges], axis=1)
    _, first, count = np.unique(pairs, axis=0, return_index=True, return_counts=True)
    lone = edges[first[count == 1]]
    return np.asarray(mesh.points[lone[:, 1]] - mesh.points[lone[:, 0]])


def mirrored(assembly: Assembly) -> Assembly:
    """The whole machine of a model of which one half is drawn, as a person asks for it. `CadError` where no half is
    found."""
    half = half_of(assembly)
    if half is None:
        raise CadError(
            "No half of a machine is drawn in this model: no plane is found in which its parts end",
            where=assembly.name,
            hint="Leave --mirror out; or mirror it where it was drawn.",
        )
    return completed(assembly, half)


@remembered
def completed(assembly: Assembly, half: Half) -> Assembly:
    """The model with its other half: what is cut goes on beyond the plane; of what stands beside it there is a mirror
    image, a part of its own; what is drawn on both sides stays as it is."""
    mirror = half.mirror()
    shapes, parts, images = dict(assembly.shapes), list[Part](), list[Part]()
    for part in assembly.parts:
        if part.id in half.cut:
            shape = _joined(assembly, part, half)
            shapes[shape.key] = shape
            parts.append(replace(part, shape=shape.key))
        else:
            parts.append(part)
            if part.id not in half.across:
                image = replace(part, id=part.id + IMAGE, transform=mirror @ part.transform, node=None)
                images.append(image)
    used = {part.shape for part in (*parts, *images)}
    words = (
        f"One half is drawn; the other is its mirror image: {len(images)} parts are images, "
        f"{len(half.cut)} were joined with theirs"
    )
    return replace(
        assembly,
        parts=(*parts, *images),
        shapes={key: shape for key, shape in shapes.items() if key in used},
        findings=(*assembly.findings, Finding("CAD015", "info", assembly.name, words, _ASYMMETRIC)),
    )


def _joined(assembly: Assembly, part: Part, half: Half) -> Shape:
    """The shape of a cut part with its mirror image, in its own frame, without the faces between the two."""
    shape, place, back = assembly.shape_of(part), part.transform, np.linalg.inv(part.transform)
    points = assembly.points_of(part)
    inside = np.abs(points[:, half.axis] - half.at) <= half.on
    points[inside, half.axis] = half.at
    own = replace(shape.mesh, points=points @ back[:3, :3].T + back[:3, 3])
    own = measures.chosen(own, np.flatnonzero(~inside[own.triangles].all(axis=1)))
    both = _together(own, _turned(own, back @ half.mirror() @ place))
    return shape_of(measures.compacted(both), shape.name, shape.color, shape.finishes)


def _turned(mesh: Mesh, mirror: Floats) -> Mesh:
    """A mesh in a mirror (4, 4)."""
    return replace(
        mesh,
        points=mesh.points @ mirror[:3, :3].T + mirror[:3, 3],
        triangles=mesh.triangles[:, ::-1].copy(),
        normals=None if mesh.normals is None else mesh.normals @ mirror[:3, :3].T,
        uvs=None if mesh.uvs is None else mesh.uvs[:, ::-1].copy(),
    )


def _together(one: Mesh, other: Mesh) -> Mesh:
    """Two meshes that have the same things to say of their points and triangles as one."""

    def both(a: NDArray[Any] | None, b: NDArray[Any] | None) -> NDArray[Any] | None:
        return None if a is None or b is None else np.concatenate([a, b])

    count = np.int32(len(one.points))
    return Mesh(
        np.concatenate([one.points, other.points]),
        np.concatenate([one.triangles, other.triangles + count]),
        both(one.normals, other.normals),
        both(one.triangle_colors, other.triangle_colors),
        both(one.uvs, other.uvs),
        both(one.triangle_finishes, other.triangle_finishes),
    )
