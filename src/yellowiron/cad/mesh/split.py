"""Merged meshes taken apart: a machine that was exported as one mesh, or a mesh for every colour; hydraulic cylinders
to the left and to the right that are one mesh, and such wheels; those that are drawn into other meshes; and one whose
barrel and rod are one solid, cut where the rod comes out."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from yellowiron.cad.mesh import copies, measures, shells
from yellowiron.cad.mesh.assembly import pieces, shape_of
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, CylinderFeature, Finish, Floats, Mesh, Shape
from yellowiron.support.caching.remembered import remembered

ROUND = 1.2 * np.pi
"""Radians around: a bar goes further."""
SLENDER, SHORT = 2.0, 0.5
"""A barrel is longer than this many of its radii, what is seen of a rod than this many of its own."""
EYE = 0.6 * np.pi
"""Radians around: an eye goes further …"""
WIDE = 6.0
"""… and is no further to one side than this many radii of the barrel."""
ASIDE, COLLAR = 0.15, 3.0
"""In radii of the barrel: a rod is no further beside its axis, and comes out no further from its end, where the wiper
may have a collar."""
PLAIN = 5.0
"""What is nothing but a barrel and a rod is so many radii long, each of them."""
FLUSH = 1.5
"""… and nothing of it is further from its axis than so many radii of the barrel."""
FITTED = 0.1
"""The ends of a fitted bar are in its solid's box but for this share of its radius."""
Eyes = tuple[Floats, Floats]
"""Centres and unit directions, (n, 3) each."""
ALIKE = 0.02
"""Mirror images differ by less than this share of their size."""
LONG = 0.35
"""The bar of a hydraulic cylinder is more than this share of its length, with its eye."""
MOST_BARS = 40
"""A mesh of more bars than these is more than two halves of hydraulic cylinders."""
IN_LINE = 0.999
"""Barrel and rod are parallel to 2.6°, by its cosine."""
ROUNDED = 12
"""A wheel has so many triangles at least."""
SQUARE, OFF, FLAT = 0.05, 0.58, 0.8
"""A wheel is as high as it is long but for this share, nothing of it is further from its axis than so many times that
(a square's corner is 0.71), and it is no wider than this share of it."""
THIN, THICK = 0.2, 0.95
"""A rod's radius over its barrel's, least and most."""


def taken_apart(assembly: Assembly) -> Assembly:
    """The assembly with a part for every solid of its meshes, where surfaces do not say what is one part, and with
    hydraulic cylinders that are one solid cut into barrel and rod. A part of one solid stays as it is; of others the
    pieces have the part's name, and its id with a number."""
    first = {part.shape: part for part in reversed(assembly.parts)}
    eyes = _eyes(assembly)
    found = {key: _solids(assembly.shapes[key], _moved(eyes, part.transform)) for key, part in sorted(first.items())}
    words = "hold several solids each, or a barrel with its rod: taken apart"
    return _divided(assembly, {key: meshes for key, meshes in found.items() if len(meshes) > 1}, words)


def twins_apart(assembly: Assembly) -> Assembly:
    """The assembly with a part for each of two barrels of hydraulic cylinders that are one mesh, the left and the right
    one, that nothing joins; and for each of their rods, which are another one. The rest stays as it is, and all of a
    model whose file says what moves on what."""
    if assembly.joints:
        return assembly
    first = {part.shape: part for part in reversed(assembly.parts)}
    twins = {key: found for key in sorted(first) if (found := _twins(assembly.shapes[key])) is not None}
    lines = {key: _lines(bars, first[key].transform) for key, (bars, _) in twins.items()}
    paired = {key: meshes for key, (_, meshes) in twins.items() if any(
        other != key and _in_line(lines[key], lines[other]) for other in twins
    )}  # fmt: skip
    return _divided(assembly, paired, "hold the left and the right half of hydraulic cylinders: taken apart")


def wheels_apart(assembly: Assembly) -> Assembly:
    """The assembly with a part for each of two wheels on one axle that are one mesh, the left and the right one, that
    nothing joins. The same object if there are none, or the file says what moves on what."""
    if assembly.joints:
        return assembly
    used = sorted({part.shape for part in assembly.parts})
    found = {key: meshes for key in used if (meshes := _wheels(assembly.shapes[key])) is not None}
    return _divided(assembly, found, "hold the left and the right wheel of an axle: taken apart")


def _lines(bars: Sequence[CylinderFeature], transform: Floats) -> Floats:
    """(n, 2, 3) centre and unit direction of bars, CAD frame."""
    centers = np.array([c.center for c in bars]) @ transform[:3, :3].T + transform[:3, 3]
    directions = np.array([c.direction for c in bars]) @ transform[:3, :3].T
    return np.stack([centers, directions / np.linalg.norm(directions, axis=1)[:, None]], axis=1)


def _in_line(some: Floats, others: Floats) -> bool:
    """Whether each of some lines (n, 2, 3) is one of the others, as far as barrels and rods are drawn in line."""
    delta = others[None, :, 0] - some[:, None, 0]
    away = delta - np.einsum("ijk,ik->ij", delta, some[:, 1])[..., None] * some[:, None, 1]
    between = float(np.linalg.norm(some[0, 0] - some[-1, 0]))
    near = np.linalg.norm(away, axis=2) < ALIKE * between
    return bool((near & (np.abs(some[:, 1] @ others[:, 1].T) > IN_LINE)).any(axis=1).all())


def rams_apart(assembly: Assembly) -> Assembly:
    """The assembly with a part for each barrel and each rod of the hydraulic cylinders that are drawn into other
    meshes, as a boom's are into the boom; what is left of such a mesh is one part if it is most of it. The same object
    if there are none, or the file says what moves on what."""
    if assembly.joints:
        return assembly
    first = {part.shape: part for part in reversed(assembly.parts)}
    eyes = _eyes(assembly)
    found = {
        key: meshes
        for key, part in sorted(first.items())
        if (meshes := _rams(assembly.shapes[key], _moved(eyes, part.transform)))
    }
    return _divided(assembly, found, "hold hydraulic cylinders beside other things: these taken out")


def _rams(shape: Shape, eyes: Callable[[], Eyes]) -> list[Mesh]:
    """What is left of a mesh without its hydraulic cylinders, and their barrels and rods; none where it has none."""
    bars = [c for c in shape.cylinders if not c.inner and c.arc > ROUND and c.length > SHORT * c.radius]
    if shape.exact or not 1 < len(bars) <= MOST_BARS:
        return []
    solids = _solids_in(shape.mesh)
    own = _bars_of(solids, bars)
    halves = {n: cut for n, mine in own.items() if len(cut := _cut(solids[n], tuple(mine), eyes, exact=False)) == 2}
    sole = {n: bar for n, mine in own.items() if n not in halves and (bar := _sole(solids[n], mine)) is not None}
    for a, b in itertools.permutations(sole, 2):
        if a not in halves and b not in halves and _comes_out(sole[a], sole[b]):
            halves |= {a: [solids[a]], b: [solids[b]]}
    if not halves:
        return []
    found = list(itertools.chain(*halves.values()))
    area = measures.area_properties
    if sum(area(solids[n])[0] for n in halves) > 0.5 * area(shape.mesh)[0]:
        return [*(solid for n, solid in enumerate(solids) if n not in halves), *found]
    rest = ~np.isin(shells.solids(shape.mesh), sorted(halves))
    return [measures.chosen(shape.mesh, np.flatnonzero(rest)), *found]


def _bars_of(solids: Sequence[Mesh], bars: Sequence[CylinderFeature]) -> dict[int, list[CylinderFeature]]:
    """Solid → its bars: a bar is of the smallest solid that reaches from one of its ends to the other."""
    size = [float(np.linalg.norm(np.ptp(mesh.points, axis=0))) for mesh in solids]
    ends, by = _ends(bars), FITTED * np.array([bar.radius for bar in bars])
    held = np.array([_inside(ends, mesh, by) for mesh in solids]).reshape(len(solids), len(bars))
    own: dict[int, list[CylinderFeature]] = {}
    for bar, by_solid in zip(bars, held.T, strict=True):
        around = np.flatnonzero(by_solid).tolist()
        if around:
            own.setdefault(min(around, key=lambda n: (size[n], n)), []).append(bar)
    return dict(sorted(own.items()))


def _sole(mesh: Mesh, bars: Sequence[CylinderFeature]) -> CylinderFeature | None:
    """The longest bar of a solid, if it is what the solid mainly is."""
    bar = max(bars, key=lambda c: c.length)
    along, aside = _about(bar, mesh)
    long = bar.length > max(PLAIN * bar.radius, LONG * float(np.ptp(along)))
    return bar if long and float(aside.max()) < COLLAR * bar.radius else None


def _about(bar: CylinderFeature, mesh: Mesh) -> tuple[Floats, Floats]:
    """(n,) where a mesh's points are along a bar's axis, from its middle, and how far from it, in the mesh's unit."""
    offset = mesh.points - np.array(bar.center)
    along = offset @ np.array(bar.direction)
    return along, np.linalg.norm(offset - along[:, None] * np.array(bar.direction), axis=1)


def _comes_out(thick: CylinderFeature, thin: CylinderFeature) -> bool:
    """Whether a rod comes out of a barrel, each a solid: in line, thinner, its root in the barrel or at its end."""
    ahead = _ahead(thick, thin, cosine=IN_LINE, aside=2.0 * ASIDE)
    if ahead is None:
        return False
    end, root = 0.5 * thick.length, ahead[1]
    return root < end + COLLAR * thick.radius and root + thin.length > end + thick.radius


def _divided(assembly: Assembly, found: Mapping[str, list[Mesh]], words: str) -> Assembly:
    """The assembly with the parts of some shapes replaced by these meshes; `words` say why. The same object if there
    are none."""
    if not found:
        return assembly
    order = [(key, mesh) for key, meshes in found.items() for mesh in meshes]
    same = copies.originals([mesh for _, mesh in order])
    own: dict[int, Shape] = {}
    places: dict[str, list[tuple[str, Floats]]] = {}
    for (key, mesh), (original, moved) in zip(order, same, strict=True):
        if original not in own:
            whole = assembly.shapes[key]
            own[original] = _shape_of(mesh, whole.name, whole.color, whole.finishes)
        places.setdefault(key, []).append((own[original].key, np.eye(4) if moved is None else moved))
    shapes = {key: shape for key, shape in assembly.shapes.items() if key not in found}
    shapes |= {shape.key: shape for shape in own.values()}
    parts: list[Part] = []
    for part in assembly.parts:
        if part.shape not in found:
            parts.append(part)
            continue
        for number, (key, moved) in enumerate(places[part.shape], start=1):
            id, path = f"{part.id}/{number}", (*part.path, part.name)
            parts.append(replace(part, id=id, path=path, shape=key, transform=part.transform @ moved))
    count = sum(part.shape in found for part in assembly.parts)
    finding = Finding(
        "CAD013",
        "info",
        assembly.name,
        f"{count} parts {words}, the model has {len(parts)}",
        "Export every part as an object of its own.",
    )
    return replace(assembly, parts=tuple(parts), shapes=shapes, findings=(*assembly.findings, finding))


@remembered
def _solids_in(mesh: Mesh) -> tuple[Mesh, ...]:
    """`pieces` of a mesh, the same objects each time: what is taken apart in one way is taken apart in another."""
    return tuple(pieces(mesh))


@remembered
def _shape_of(mesh: Mesh, name: str, color: Color | None, finishes: tuple[Finish, ...]) -> Shape:
    """`shape_of`, made once of the same object."""
    return shape_of(mesh, name, color, finishes)


def _twins(shape: Shape) -> tuple[tuple[CylinderFeature, ...], list[Mesh]] | None:
    """The two bars of a shape that is a bar and its mirror image, and the meshes of what belongs to each; None
    otherwise."""
    bars = [c for c in shape.cylinders if c.arc > ROUND and c.length > SLENDER * c.radius]
    if shape.exact or len(bars) > MOST_BARS:
        return None
    pairs = [pair for pair in itertools.combinations(bars, 2) if _side_by_side(*pair)]
    if not pairs:
        return None
    number = shells.solids(shape.mesh)
    for one, other in pairs:
        middle = 0.5 * (np.array(one.center) + np.array(other.center))
        beyond = _mirrored(shape.mesh, number, middle, np.array(other.center) - middle)
        if beyond is None:
            continue
        length = float(np.ptp(_corners(shape.mesh, ~beyond) @ np.array(one.direction)))
        if one.length > LONG * length:
            return (one, other), [measures.chosen(shape.mesh, np.flatnonzero(rows)) for rows in (~beyond, beyond)]
    return None


def _corners(mesh: Mesh, chosen: NDArray[np.bool_]) -> Floats:
    """(3 m, 3) the corners of some of a mesh's triangles."""
    return np.asarray(mesh.points[mesh.triangles[chosen].ravel()])


def _mirrored(mesh: Mesh, number: NDArray[np.int64], middle: Floats, across: Floats) -> NDArray[np.bool_] | None:
    """Which triangles (n,) of a mesh are beyond a plane through `middle`, square to `across`, if those before it are as
    large and no solid (`number`, by triangle) is on both sides; None otherwise."""
    normal = across / np.linalg.norm(across)
    a, b, c = ((mesh.points - middle) @ normal)[mesh.triangles].T
    low, high = (np.full(int(number.max()) + 1, sign * np.inf) for sign in (1.0, -1.0))
    np.minimum.at(low, number, np.minimum(np.minimum(a, b), c))
    np.maximum.at(high, number, np.maximum(np.maximum(a, b), c))
    beyond: NDArray[np.bool_] = a + b + c > 0.0
    if ((low < 0.0) & (high > 0.0)).any() or beyond.all() or not beyond.any():
        return None
    near, far = _corners(mesh, ~beyond), _corners(mesh, beyond)
    size = float(
        np.linalg.norm(np.maximum(near.max(axis=0), far.max(axis=0)) - np.minimum(near.min(axis=0), far.min(axis=0)))
    )
    far = far - 2.0 * np.outer((far - middle) @ normal, normal)
    ends = [np.abs(end(near, axis=0) - end(far, axis=0)).max() for end in (np.min, np.max)]
    return beyond if max(ends) < ALIKE * size else None


def _wheels(shape: Shape) -> list[Mesh] | None:
    """The two meshes of a shape that is a wheel and its mirror image on one axis; None for any other."""
    if shape.exact or len(shape.mesh.triangles) < 2 * ROUNDED:
        return None
    points = shape.mesh.points[shape.mesh.triangles.ravel()]
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    # A wheel is as high as it is long: its axis is the direction that the box is square to.
    for k in range(3):
        square = np.ptp(points, axis=0)[[(k + 1) % 3, (k + 2) % 3]]
        if max(square) > (1.0 + SQUARE) * min(square):
            continue
        rim = np.linalg.norm((points - middle)[:, [(k + 1) % 3, (k + 2) % 3]], axis=1)
        if rim.max() > OFF * max(square):
            continue
        beyond = _mirrored(shape.mesh, shells.solids(shape.mesh), middle, np.eye(3)[k])
        if beyond is not None and np.ptp(_corners(shape.mesh, beyond)[:, k]) < FLAT * max(square):
            return [measures.chosen(shape.mesh, np.flatnonzero(rows)) for rows in (~beyond, beyond)]
    return None


def _side_by_side(one: CylinderFeature, other: CylinderFeature) -> bool:
    """Whether two cylinders are equal, parallel, beside each other and not one in the other."""
    apart = np.array(other.center) - np.array(one.center)
    along = abs(float(apart @ np.array(one.direction)))
    return (
        abs(one.radius - other.radius) < ALIKE * one.radius
        and abs(one.length - other.length) < ALIKE * one.length
        and abs(float(np.dot(one.direction, other.direction))) > 0.9999
        and along < ALIKE * one.length
        and float(np.linalg.norm(apart)) > one.radius + other.radius
    )


def _eyes(assembly: Assembly) -> Eyes:
    """The round things of a model that a hydraulic cylinder may hang on, CAD frame."""
    centers, directions = [np.zeros((0, 3))], [np.zeros((0, 3))]
    for part in assembly.parts:
        bores = [c for c in assembly.shape_of(part).cylinders if c.arc > EYE]
        if bores:
            centers.append(np.array([c.center for c in bores]) @ part.transform[:3, :3].T + part.transform[:3, 3])
            directions.append(np.array([c.direction for c in bores]) @ part.transform[:3, :3].T)
    whole = np.concatenate(directions)
    return np.concatenate(centers), whole / np.maximum(np.linalg.norm(whole, axis=1), 1e-300)[:, None]


def _moved(eyes: Eyes, transform: Floats) -> Callable[[], Eyes]:
    """The eyes in the frame of a part, when they are asked for."""

    def moved() -> Eyes:
        back = np.linalg.inv(transform)
        directions = eyes[1] @ back[:3, :3].T
        return eyes[0] @ back[:3, :3].T + back[:3, 3], directions / np.linalg.norm(directions, axis=1)[:, None]

    return functools.cache(moved)


def _solids(shape: Shape, eyes: Callable[[], Eyes]) -> list[Mesh]:
    """The meshes of a shape's solids, barrels and rods apart; where surfaces say what is one part, only these."""
    found = [shape.mesh] if shape.exact else _solids_in(shape.mesh)
    ends = _ends(shape.cylinders)
    cut = []
    for mesh in found:
        bars = shape.cylinders
        if len(found) > 1:
            bars = tuple(itertools.compress(shape.cylinders, _inside(ends, mesh, np.zeros(len(ends)))))
        cut += _cut(mesh, bars, eyes, exact=shape.exact)
    return cut


def _ends(cylinders: Sequence[CylinderFeature]) -> Floats:
    """(n, 2, 3) where cylinders end."""
    ends = [np.array(one.point) + np.outer((one.lower, one.upper), one.direction) for one in cylinders]
    return np.array(ends).reshape(-1, 2, 3)


def _inside(ends: Floats, mesh: Mesh, by: Floats) -> NDArray[np.bool_]:
    """(n,) whether both `ends` (n, 2, 3) are in a mesh's box, or no further from it than `by` (n,)."""
    low, high = measures.bounds(mesh)
    slack = (by + 1e-3 * float(np.linalg.norm(high - low)))[:, None, None]
    return np.asarray(((ends > low - slack) & (ends < high + slack)).all(axis=(1, 2)))


def _cut(mesh: Mesh, bars: tuple[CylinderFeature, ...], eyes: Callable[[], Eyes], *, exact: bool) -> list[Mesh]:
    """A mesh, or two where it is a barrel with its rod: cut at the step between two bars in line that have an eye
    beyond each of them, or are long and all that the mesh of an artist is, and closed with flat ends."""
    for thick, thin in ((a, b) for a in bars for b in bars):
        place = _step(thick, thin)
        if place is None or not ((not exact and _is_plain(mesh, thick, thin)) or _hangs(thick, thin, *place, eyes())):
            continue
        point, direction = place
        beyond = ((mesh.points - point) @ direction)[mesh.triangles].mean(axis=1) > 0.0
        if 4 <= int(beyond.sum()) <= len(beyond) - 4:
            return [_closed(mesh, ~beyond), _closed(mesh, beyond)]
    return [mesh]


def _step(thick: CylinderFeature, thin: CylinderFeature) -> tuple[Floats, Floats] | None:
    """Where a rod comes out of its barrel, and the direction in which it does; None where two cylinders are no ram."""
    if thick.inner or thin.inner:
        return None
    if min(thick.arc, thin.arc) < ROUND or thick.length < SLENDER * thick.radius or thin.length < SHORT * thin.radius:
        return None
    ahead = _ahead(thick, thin, cosine=0.9999, aside=ASIDE)
    if ahead is None or not -0.1 * thick.radius < ahead[1] - 0.5 * thick.length < COLLAR * thick.radius:
        return None
    axis, root = ahead
    return np.array(thick.center) + (root + 1e-6 * thick.radius) * axis, axis


def _ahead(
    thick: CylinderFeature, thin: CylinderFeature, *, cosine: float, aside: float
) -> tuple[Floats, float] | None:
    """The direction in which a rod comes out of its barrel, and how far its root is from the barrel's middle, in the
    features' unit; None for two whose radii are no barrel's and rod's, whose axes differ by more than an angle of this
    `cosine`, or where the rod is further beside the barrel's axis than so many of its radii."""
    axis, across = np.array(thick.direction), np.array(thin.center) - np.array(thick.center)
    ahead = float(across @ axis)
    if not THIN * thick.radius < thin.radius < THICK * thick.radius or abs(float(axis @ thin.direction)) < cosine:
        return None
    if float(np.linalg.norm(across - ahead * axis)) > aside * thick.radius:
        return None
    return (axis if ahead > 0.0 else -axis), abs(ahead) - 0.5 * thin.length


def _is_plain(mesh: Mesh, thick: CylinderFeature, thin: CylinderFeature) -> bool:
    """Whether a mesh is a barrel with its rod and nothing else: both long, no third bar beyond either end. Pins and
    shafts with a step are shorter, or have steps at both ends."""
    if thick.length < PLAIN * thick.radius or thin.length < PLAIN * thin.radius:
        return False
    along, aside = _about(thick, mesh)
    most = thick.length + thin.length + 2.0 * COLLAR * thick.radius
    return bool(np.ptp(along) < most and aside.max() < FLUSH * thick.radius)


def _hangs(thick: CylinderFeature, thin: CylinderFeature, step: Floats, axis: Floats, eyes: Eyes) -> bool:
    """Whether there is an eye across the axis at each end of a barrel and a rod, which comes out at `step`."""
    start = np.array(thick.center)
    root = float((step - start) @ axis)
    end = root + thin.length
    centers, directions = eyes
    across_it = np.abs(directions @ axis) < 0.02
    offset = centers[across_it] - start
    offset -= np.einsum("ij,ij->i", offset, directions[across_it])[:, None] * directions[across_it]
    along = offset @ axis
    aside = np.linalg.norm(centers[across_it] - start - along[:, None] * axis, axis=1)
    off = np.linalg.norm(offset - along[:, None] * axis, axis=1)
    crossing = along[(off < thick.radius) & (aside < WIDE * thick.radius)]
    reach = 6.0 * thick.radius
    behind = any(-0.5 * thick.length - reach < a < 0.0 for a in crossing)
    return behind and any(end - reach < a < end + reach and a > root for a in crossing)


def _closed(mesh: Mesh, rows: np.ndarray[tuple[int], np.dtype[np.bool_]]) -> Mesh:
    """Some triangles of a closed mesh, the hole that is left filled from its middle."""
    number = measures.welded(mesh)
    chosen = number[mesh.triangles[rows]]
    points = np.zeros((int(number.max()) + 1, 3))
    points[number[::-1]] = mesh.points[::-1]
    edges = np.concatenate([chosen[:, [0, 1]], chosen[:, [1, 2]], chosen[:, [2, 0]]])
    edges = edges[edges[:, 0] != edges[:, 1]]
    there = {(int(a), int(b)) for a, b in edges}
    rim = np.array(sorted((b, a) for a, b in there if (b, a) not in there), dtype=np.int64).reshape(-1, 2)
    if not len(rim):
        return Mesh(points, chosen.astype(np.int32))
    middle = points[rim[:, 0]].mean(axis=0)
    triangles = np.concatenate([chosen, np.column_stack([rim, np.full(len(rim), len(points))])])
    colors = mesh.triangle_colors
    if colors is not None:
        colors = np.concatenate([colors[rows], np.repeat(colors[rows][:1], len(rim), axis=0)])
    whole = Mesh(np.concatenate([points, middle[None]]), triangles.astype(np.int32), None, colors)
    return measures.compacted(whole)
