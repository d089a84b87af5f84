"""Shaded pictures on a bare machine: rays by embreex, shading by numpy. No display, no GPU, the same bytes every time.

Machine frame: metres, Z up, the ground at z = 0.
"""

from __future__ import annotations

import base64
import colorsys
import io
import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.report.html.rays import Piece, Pieces, Singles, blocked, dot, first, piece_of
from yellowiron.report.rows import in_rows

_SUN = (np.array([0.35, -0.70, 1.0]) / math.sqrt(0.35**2 + 0.70**2 + 1.0)).astype(np.float32)
_SKY = np.array([0.85, 0.89, 0.93], dtype=np.float32)
_GROUND = np.array([0.78, 0.77, 0.74], dtype=np.float32)
_UP = np.array([0.0, 0.0, 1.0], dtype=np.float32)
_BAND = 96
"""Rows that are done at once, and further down rays."""
_AT_ONCE = 100_000
_CREASE = 0.82
"""Cosine: faces at more than about 35° have a line between them."""
_SHADE = 0.05
"""Linear light: pixels side by side that differ by more are at an edge of a shadow."""
_THIRDS = np.full(3, 1.0 / 3.0, dtype=np.float32)
_BESIDE = (
    ((slice(None, -1), slice(None)), (slice(1, None), slice(None))),
    ((slice(None), slice(None, -1)), (slice(None), slice(1, None))),
)
YELLOW = (0.87, 0.47, 0.01)
# Linear to sRGB (IEC 61966-2-1, as a power of 2.2), by 16 bits of light.
_DISPLAY = (255.0 * np.linspace(0.0, 1.0, 65536) ** (1.0 / 2.2) + 0.5).astype(np.uint8)


@dataclass(frozen=True, eq=False)
class DrawnTriangles:
    """Triangles to draw: points (n, 3) in metres, the numbers (m, 3) of each triangle's, corner normals (m, 3, 3),
    colours (m, 3), part numbers (m,). `spans`: body → its first triangle and the one after its last. Triangles of
    several parts share no point. `placed`: the pieces of a machine in another pose (`posed`)."""

    points: Singles
    triangles: NDArray[np.int32]
    normals: Singles
    colors: Singles
    parts: NDArray[np.int32]
    spans: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    placed: Pieces = ()

    @cached_property
    def owners(self) -> NDArray[np.intp]:
        """Point (n,) → a triangle that it is a corner of."""
        owners = np.zeros(len(self.points), dtype=np.intp)
        owners[self.triangles] = np.arange(len(self.triangles))[:, None]
        return owners

    @cached_property
    def pieces(self) -> Pieces:
        """What rays meet; every picture of the same triangles asks it."""
        return self.placed or (piece_of(self.points, self.triangles),)

    @cached_property
    def bodies(self) -> dict[str, Piece]:
        """Body → what rays meet of it, wherever it is; every pose of the same triangles asks it."""
        return {
            name: piece_of(self.points, self.triangles, np.arange(start, end, dtype=np.int32))
            for name, (start, end) in self.spans.items() if start < end
        }  # fmt: skip

    @cached_property
    def box(self) -> tuple[Singles, Singles]:
        """Its two corners (3,)."""
        if not len(self.points):
            return _SKY * 0.0, _SKY * 0.0
        # Column by column: over rows of three numpy takes twenty times as long.
        low, high = np.array([(axis.min(), axis.max()) for axis in self.points.T], dtype=np.float32).T
        return low, high

    @cached_property
    def shadow(self) -> Singles:
        """From where to where (2, 2) along x and y the machine, and its shadow on the ground, may be."""
        corners = np.array(list(itertools.product(*zip(*self.box, strict=True))), dtype=np.float32)
        below = corners - corners[:, 2:] / _SUN[2] * _SUN
        both = np.concatenate([corners, below])[:, :2]
        return np.array([both.min(axis=0), both.max(axis=0)])

    def by_body(self, mechanism: Mechanism) -> Singles:
        """Colours (m, 3) that tell the bodies apart, a counted row of them alike."""
        colors = self.colors.copy()
        for name, color in body_colors(mechanism).items():
            first, last = self.spans[name]
            colors[first:last] = color
        return colors


@dataclass(frozen=True, eq=False)
class Camera:
    """A camera with a long lens: `eye`, unit `forward`, `right`, `up`; `scale` pixels per unit of slope."""

    eye: Floats
    forward: Floats
    right: Floats
    up: Floats
    scale: float
    width: int
    height: int

    def project(self, points: Floats) -> Floats:
        """Pixel coordinates (n, 2) of points (n, 3); x to the right, y down."""
        offset = points - self.eye
        depth = offset @ self.forward
        x = self.width / 2 + self.scale * (offset @ self.right) / depth
        y = self.height / 2 - self.scale * (offset @ self.up) / depth
        return np.stack([x, y], axis=1)


def machine_triangles(
    mechanism: Mechanism,
    assembly: Assembly,
    frame: Floats,
    *,
    poses: Mapping[str, Floats] | None = None,
) -> DrawnTriangles:
    """All parts of a mechanism's bodies in their CAD colours.

    `frame` (4, 4): CAD → machine; `poses`: body → (4, 4) displacement from the drawn pose, machine frame.
    """
    parts = {p.id: p for p in assembly.parts}
    bodies = {body.name: [parts[each.part] for each in body.parts] for body in mechanism.bodies}
    return part_triangles(bodies, assembly, frame, poses=poses)


def part_triangles(
    bodies: Mapping[str, Sequence[Part]],
    assembly: Assembly,
    frame: Floats,
    *,
    poses: Mapping[str, Floats] | None = None,
) -> DrawnTriangles:
    """Some parts by what they are drawn as one of, as `machine_triangles`; parts are numbered in the order given."""
    points: list[Singles] = []
    triangles: list[NDArray[np.int32]] = []
    normals: list[Singles] = []
    colors: list[Singles] = []
    numbers: list[NDArray[np.int32]] = []
    spans: dict[str, tuple[int, int]] = {}
    count = total = 0
    for name, members in bodies.items():
        first = count
        displacement = poses.get(name, np.eye(4)) if poses else np.eye(4)
        for part in members:
            shape = assembly.shape_of(part)
            place = displacement @ frame @ part.transform
            own = shape.mesh.triangles
            if np.linalg.det(place[:3, :3]) < 0:
                own = own[:, ::-1]
            placed = shape.mesh.points @ place[:3, :3].T + place[:3, 3]
            if shape.mesh.normals is None:
                a, b, c = (placed[own[:, k]] for k in range(3))
                facet = np.cross(b - a, c - a)
                facet /= np.maximum(np.linalg.norm(facet, axis=1, keepdims=True), 1e-30)
                corner_normals = np.repeat(facet[:, None, :], 3, axis=1)
            else:
                turned = shape.mesh.normals @ np.linalg.inv(place[:3, :3])
                turned /= np.maximum(np.linalg.norm(turned, axis=1, keepdims=True), 1e-30)
                corner_normals = turned[own]
            color = part.color or shape.color or YELLOW
            points.append(placed.astype(np.float32))
            triangles.append((own + total).astype(np.int32))
            normals.append(corner_normals.astype(np.float32))
            colors.append(np.broadcast_to(np.asarray(color, dtype=np.float32), (len(own), 3)))
            numbers.append(np.full(len(own), len(numbers), dtype=np.int32))
            count += len(own)
            total += len(placed)
        spans[name] = (first, count)
    if not points:
        nothing = np.zeros((0, 3, 3), dtype=np.float32)
        none = np.zeros((0, 3), dtype=np.int32)
        return DrawnTriangles(nothing[:, 0], none, nothing, nothing[:, 0], none[:, 0], spans)
    return DrawnTriangles(
        np.concatenate(points), np.concatenate(triangles), np.concatenate(normals), np.concatenate(colors),
        np.concatenate(numbers), spans,
    )  # fmt: skip


def posed(drawn: DrawnTriangles, poses: Mapping[str, Floats]) -> DrawnTriangles:
    """A machine's triangles with its bodies moved: body → (4, 4) displacement."""
    points, normals = drawn.points.copy(), drawn.normals.copy()
    for name, (start, end) in drawn.spans.items():
        if name in poses and start < end and not np.array_equal(poses[name], np.eye(4)):
            turn, way = poses[name][:3, :3].astype(np.float32), poses[name][:3, 3].astype(np.float32)
            own = (drawn.owners >= start) & (drawn.owners < end)
            points[own] = points[own] @ turn.T + way
            normals[start:end] = normals[start:end] @ turn.T
    placed = tuple(piece.at(poses.get(name)) for name, piece in drawn.bodies.items())
    return replace(drawn, points=points, normals=normals, placed=placed)


def look_at(
    points: Floats, *, azimuth: float = -0.6, elevation: float = 0.35, width: int = 1280, height: int = 720
) -> Camera:
    """A camera that sees all of `points` (n, 3). Radians: azimuth from +X towards +Y, elevation above the ground."""
    center = 0.5 * (points.min(axis=0) + points.max(axis=0))
    back = np.array(
        [math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation)]
    )
    forward = -back
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    reach = float(np.linalg.norm(points - center, axis=1).max())
    eye = center + back * 5.0 * reach
    offset = points - eye
    depth = offset @ forward
    slopes = np.stack([(offset @ right) / depth, (offset @ up) / depth], axis=1)
    low, high = slopes.min(axis=0), slopes.max(axis=0)
    # Aim at the middle of what is seen, then fill the frame with a margin.
    aim = forward + right * 0.5 * (low[0] + high[0]) + up * 0.5 * (low[1] + high[1])
    forward = aim / np.linalg.norm(aim)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    offset = points - eye
    depth = offset @ forward
    widest = max(float(np.abs(offset @ right / depth).max()), 1e-9)
    highest = max(float(np.abs(offset @ up / depth).max()), 1e-9)
    scale = 0.44 * min(width / widest, height / highest)
    return Camera(eye, forward, right, up, scale, width, height)


def outline(mechanism: Mechanism, poses: Mapping[str, Floats] | None = None) -> Floats:
    """Corners (n, 3) of the bodies' hulls, moved by body → (4, 4) displacement: enough to see all of the machine."""
    places = poses or {}
    hulls = [(np.asarray(b.hull), places.get(b.name, np.eye(4))) for b in mechanism.bodies if len(b.hull)]
    return np.concatenate([np.zeros((0, 3)), *(hull @ place[:3, :3].T + place[:3, 3] for hull, place in hulls)])


def render(
    drawn: DrawnTriangles, camera: Camera, *, colors: Singles | None = None, supersample: int = 2
) -> Image.Image:
    """The picture: sun with shadow, sky light, a ground plane, and lines where parts or creases meet. `colors` (m, 3)
    take the place of their own.

    One ray a pixel; `supersample` × `supersample` where it differs from one beside it, which is where they show.
    """
    own = drawn.colors if colors is None else colors
    width, height = camera.width, camera.height
    # Band by band, so that a band's numbers stay in the processor's cache.
    rows = [np.arange(top, min(top + _BAND, height)) for top in range(0, height, _BAND)]
    across = np.arange(width, dtype=np.float32) + np.float32(0.5)
    bands = [
        _seen(drawn, own, camera, np.tile(across, len(r)), np.repeat(r.astype(np.float32) + 0.5, width)) for r in rows
    ]
    whole = _joined(bands)
    rough = np.flatnonzero(_rough(whole, width, height))
    pixels = _displayed(whole.color)
    if len(rough):
        pixels[:, rough] = _fine(drawn, own, camera, whole, rough, max(supersample, 1))
    return Image.fromarray(np.ascontiguousarray(pixels.T).reshape(height, width, 3))


@dataclass(frozen=True, eq=False)
class _Samples:
    """What some rays meet: linear colours (3, n), normals (3, n), zero where it is the sky, and the numbers (n,) of the
    parts, -1 where it is none."""

    color: Singles
    normal: Singles
    label: NDArray[np.int32]


def _seen(drawn: DrawnTriangles, own: Singles, camera: Camera, x: Singles, y: Singles) -> _Samples:
    """What is seen at places (n,) of a picture, in pixels."""
    color, normal, face = _shade(drawn, own, camera.eye, _rays(camera, x, y))
    label = np.where(face >= 0, drawn.parts[np.maximum(face, 0)] if len(drawn.parts) else -1, -1)
    return _Samples(color, normal, label.astype(np.int32))


def _joined(samples: Sequence[_Samples]) -> _Samples:
    return _Samples(
        np.concatenate([s.color for s in samples], axis=1), np.concatenate([s.normal for s in samples], axis=1),
        np.concatenate([s.label for s in samples]),
    )  # fmt: skip


def _displayed(color: Singles) -> NDArray[np.uint8]:
    return np.asarray(_DISPLAY[(65535.0 * np.clip(color, 0.0, 1.0)).astype(np.uint16)])


def _rough(samples: _Samples, width: int, height: int) -> NDArray[np.bool_]:
    """Pixels (height × width,) that differ from one beside them: in part, in direction, or, at a shadow, in light."""
    label = samples.label.reshape(height, width)
    normal, light = samples.normal.reshape(3, height, width), dot(samples.color, _THIRDS).reshape(height, width)
    rough = np.zeros((height, width), dtype=bool)
    for here, there in _BESIDE:
        apart = label[here] != label[there]
        apart |= dot(normal[:, here[0], here[1]], normal[:, there[0], there[1]]) < _CREASE
        apart &= (label[here] >= 0) | (label[there] >= 0)
        apart |= np.abs(light[here] - light[there]) > _SHADE
        rough[here] |= apart
        rough[there] |= apart
    return rough.reshape(-1)


def _fine(
    drawn: DrawnTriangles, own: Singles, camera: Camera, whole: _Samples, rough: NDArray[np.intp], times: int
) -> NDArray[np.uint8]:
    """The `rough` pixels (n,) of a picture anew, as display values (3, n): each the middle of `times` × `times`, with
    the lines between them."""
    inside = (np.arange(times, dtype=np.float32) + np.float32(0.5)) / np.float32(times)
    down, across = (axis.reshape(-1) for axis in np.meshgrid(inside, inside, indexing="ij"))
    count = times * times
    chunks = []
    for some in np.array_split(rough, math.ceil(len(rough) * count / _AT_ONCE)):
        row, column = np.divmod(some, camera.width)
        x, y = (
            (column[:, None].astype(np.float32) + across).reshape(-1),
            (row[:, None].astype(np.float32) + down).reshape(-1),
        )
        chunks.append(_seen(drawn, own, camera, x, y))
    fine = _joined(chunks)
    # Where a sample's right and lower neighbours are: among the fine ones, else the pixel's only one behind them.
    first = np.full(camera.width * camera.height, -1)
    first[rough] = np.arange(len(rough)) * count
    row, column = (np.repeat(one, count) for one in np.divmod(rough, camera.width))
    inner_row, inner_column = (np.tile(one.reshape(-1), len(rough)) for one in np.indices((times, times)))
    label = np.concatenate([fine.label, whole.label])
    normal = np.concatenate([fine.normal, whole.normal], axis=1)
    line = np.zeros(len(fine.label), dtype=bool)
    for step_row, step_column in ((1, 0), (0, 1)):
        r, c = row * times + inner_row + step_row, column * times + inner_column + step_column
        there = (r < camera.height * times) & (c < camera.width * times)
        pixel = np.where(there, r // times * camera.width + c // times, 0)
        at = np.where(first[pixel] >= 0, first[pixel] + r % times * times + c % times, len(fine.label) + pixel)
        crease = (dot(fine.normal, normal[:, at]) < _CREASE) & (fine.label >= 0) & (label[at] >= 0)
        line |= there & ((fine.label != label[at]) | crease)
    color = fine.color * np.where(line, np.float32(0.2), np.float32(1.0))
    shown = _displayed(color).reshape(3, len(rough), count).astype(np.uint32)
    return np.asarray((shown.sum(axis=2) + count // 2) // count).astype(np.uint8)


def _rays(camera: Camera, x: Singles, y: Singles) -> Singles:
    """Unit directions (3, n) through places (n,) of a picture, in pixels."""
    scale = np.float32(camera.scale)
    across, up = (x - np.float32(camera.width / 2)) / scale, (np.float32(camera.height / 2) - y) / scale
    along, right, above = (v.astype(np.float32) for v in (camera.forward, camera.right, camera.up))
    directions = np.stack([along[k] + across * right[k] + up * above[k] for k in range(3)])
    directions /= np.sqrt(dot(directions, directions))
    return directions


def _shade(
    drawn: DrawnTriangles, own: Singles, eye: Floats, directions: Singles
) -> tuple[Singles, Singles, NDArray[np.int32]]:
    """What each ray (3, n) meets: a part, else the ground, else the sky. Linear colours (3, n), normals (3, n) and
    triangles (n,), -1 where it is none."""
    start = eye.astype(np.float32)[:, None]
    hits = first(drawn.pieces, eye, directions)
    face = hits.triangle
    color, normals = np.repeat(_SKY[:, None], len(face), axis=1), np.zeros_like(directions)
    seen = np.flatnonzero(face >= 0)
    if len(seen):
        u, v, met, rays = hits.u[seen], hits.v[seen], face[seen], directions[:, seen]
        corner, rest = drawn.normals[met], 1 - u - v
        normal = np.stack([rest * corner[:, 0, k] + u * corner[:, 1, k] + v * corner[:, 2, k] for k in range(3)])
        normal /= np.maximum(np.sqrt(dot(normal, normal)), np.float32(1e-12))
        normal *= np.where(dot(normal, rays) > 0, np.float32(-1.0), np.float32(1.0))
        normals[:, seen] = normal
        color[:, seen] = own[met].T * _light(drawn, start + rays * hits.distance[seen], normal)
    ground = np.flatnonzero((face < 0) & (directions[2] < 0))
    if len(ground):
        normals[2, ground] = 1.0
        down = directions[:, ground]
        points = start - down * (start[2] / down[2])
        # The ground fades into the sky, so that it has no edge.
        middle, reach = _extent(drawn)
        apart = np.sqrt((points[0] - middle[0]) ** 2 + (points[1] - middle[1]) ** 2)
        fade = np.clip(apart / reach, 0.0, 1.0) ** 2
        lit = _light(drawn, points, np.broadcast_to(_UP[:, None], points.shape)) * (1 - fade)
        color[:, ground] = _GROUND[:, None] * lit + _SKY[:, None] * fade
    return color, normals, face


def _light(drawn: DrawnTriangles, points: Singles, facing: Singles) -> Singles:
    """How much light (n,) there is at points (3, n) that face somewhere (3, n)."""
    (left, near), (right, far) = drawn.shadow
    sun = np.clip(dot(facing, _SUN), 0.0, 1.0)
    # What is turned away from the sun is dark without asking, and what is far from the machine is lit.
    inside = (points[0] >= left) & (points[0] <= right) & (points[1] >= near) & (points[1] <= far)
    asked = np.flatnonzero((sun > 0.0) & inside)
    if len(asked):
        dark = blocked(drawn.pieces, points[:, asked] + facing[:, asked] * np.float32(2e-3), _SUN)
        sun[asked[dark]] = 0.0
    return np.asarray(np.float32(0.34) + np.float32(0.12) * facing[2] + np.float32(0.62) * sun)


def encode(image: Image.Image, *, quality: int = 82) -> bytes:
    """The picture as WebP bytes."""
    buffer = io.BytesIO()
    image.save(buffer, "WEBP", quality=quality, method=4)
    return buffer.getvalue()


def data_uri(image: Image.Image) -> str:
    """The picture for a page that has no files beside it."""
    return "data:image/webp;base64," + base64.b64encode(encode(image)).decode("ascii")


def contact_sheet(images: Sequence[Image.Image]) -> Image.Image:
    """Pictures of one size side by side."""
    width, height = images[0].size
    sheet = Image.new("RGB", (width * len(images), height))
    for index, image in enumerate(images):
        sheet.paste(image, (index * width, 0))
    return sheet


def body_colors(mechanism: Mechanism) -> dict[str, tuple[float, float, float]]:
    """Body → linear RGB; the bodies of a counted row share theirs."""
    rows = in_rows([body.name for body in mechanism.bodies])
    return {mechanism.bodies[place].name: body_color(n) for n, places in enumerate(rows.values()) for place in places}


def body_color(index: int) -> tuple[float, float, float]:
    """Linear RGB by the golden angle of hue, so that any number of neighbours differ; every third is darker."""
    hue = (0.11 + 0.61803398875 * index) % 1.0
    value = (0.95, 0.72, 0.52)[index % 3]
    red, green, blue = colorsys.hsv_to_rgb(hue, 0.62, value)
    return (red**2.2, green**2.2, blue**2.2)


def _extent(drawn: DrawnTriangles) -> tuple[Singles, np.float32]:
    """The middle on the ground, and how far from it the ground is seen: a little more than the machine's size."""
    if not len(drawn.points):
        return np.zeros(2, dtype=np.float32), np.float32(1.0)
    low, high = drawn.box
    return (0.5 * (low + high))[:2], np.float32(max(float(1.4 * np.linalg.norm(high - low)), 1e-6))
