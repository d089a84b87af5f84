"""Shaded pictures on a bare machine: rays by embreex, shading by numpy. No display, no GPU, the same bytes every time.

Machine frame: metres, Z up, the ground at z = 0.
"""

from __future__ import annotations

import base64
import colorsys
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.report.rows import in_rows

_SUN = np.array([0.35, -0.70, 1.0]) / math.sqrt(0.35**2 + 0.70**2 + 1.0)
_SKY = np.array([0.85, 0.89, 0.93])
_GROUND = np.array([0.78, 0.77, 0.74])
YELLOW = (0.87, 0.47, 0.01)


@dataclass(frozen=True, eq=False)
class Soup:
    """Triangles to draw: corners (m, 3, 3) in metres, corner normals (m, 3, 3), colours (m, 3), part numbers (m,).
    `spans`: body → its first triangle and the one after its last."""

    corners: Floats
    normals: Floats
    colors: Floats
    parts: NDArray[np.int64]
    spans: Mapping[str, tuple[int, int]] = field(default_factory=dict)


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


def machine_soup(
    mechanism: Mechanism,
    assembly: Assembly,
    frame: Floats,
    *,
    poses: Mapping[str, Floats] | None = None,
    by_body: bool = False,
) -> Soup:
    """All parts of a mechanism's bodies.

    `frame` (4, 4): CAD → machine; `poses`: body → (4, 4) displacement from the drawn pose, machine frame; `by_body`
    colours every body (a counted row of them alike) by itself instead of by its parts' CAD colours.
    """
    parts = {p.id: p for p in assembly.parts}
    corners: list[Floats] = []
    normals: list[Floats] = []
    colors: list[Floats] = []
    numbers: list[NDArray[np.int64]] = []
    spans: dict[str, tuple[int, int]] = {}
    count = 0
    own = body_colors(mechanism)
    for body in mechanism.bodies:
        first = count
        displacement = poses.get(body.name, np.eye(4)) if poses else np.eye(4)
        for body_part in body.parts:
            part = parts[body_part.part]
            shape = assembly.shape_of(part)
            place = displacement @ frame @ part.transform
            triangles = shape.mesh.triangles
            if np.linalg.det(place[:3, :3]) < 0:
                triangles = triangles[:, ::-1]
            points = shape.mesh.points @ place[:3, :3].T + place[:3, 3]
            soup = points[triangles]
            facet = np.cross(soup[:, 1] - soup[:, 0], soup[:, 2] - soup[:, 0])
            facet /= np.maximum(np.linalg.norm(facet, axis=1, keepdims=True), 1e-30)
            if shape.mesh.normals is None:
                corner_normals = np.repeat(facet[:, None, :], 3, axis=1)
            else:
                turned = shape.mesh.normals @ np.linalg.inv(place[:3, :3])
                turned /= np.maximum(np.linalg.norm(turned, axis=1, keepdims=True), 1e-30)
                corner_normals = turned[triangles]
            color = own[body.name] if by_body else (part.color or shape.color or YELLOW)
            corners.append(soup)
            normals.append(corner_normals)
            colors.append(np.broadcast_to(np.asarray(color, dtype=np.float64), (len(soup), 3)))
            numbers.append(np.full(len(soup), len(numbers), dtype=np.int64))
            count += len(soup)
        spans[body.name] = (first, count)
    if not corners:
        nothing = np.zeros((0, 3, 3))
        return Soup(nothing, nothing, np.zeros((0, 3)), np.zeros(0, dtype=np.int64))
    return Soup(
        np.concatenate(corners), np.concatenate(normals), np.concatenate(colors), np.concatenate(numbers), spans
    )


def posed(soup: Soup, poses: Mapping[str, Floats]) -> Soup:
    """A machine's triangles with its bodies moved: body → (4, 4) displacement."""
    corners, normals = soup.corners.copy(), soup.normals.copy()
    for name, (first, last) in soup.spans.items():
        if name in poses:
            turn, way = poses[name][:3, :3], poses[name][:3, 3]
            corners[first:last] = corners[first:last] @ turn.T + way
            normals[first:last] = normals[first:last] @ turn.T
    return replace(soup, corners=corners, normals=normals)


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


def render(soup: Soup, camera: Camera, *, supersample: int = 2) -> Image.Image:
    """The picture: sun with shadow, sky light, a ground plane, and lines where parts or creases meet."""
    from embreex import rtcore_scene
    from embreex.mesh_construction import TriangleMesh

    width, height = camera.width * supersample, camera.height * supersample
    scale = np.float32(camera.scale * supersample)
    eye, sun_direction = camera.eye.astype(np.float32), _SUN.astype(np.float32)
    columns, rows = np.meshgrid(np.arange(width, dtype=np.float32) + 0.5, np.arange(height, dtype=np.float32) + 0.5)
    directions = (
        camera.forward.astype(np.float32)
        + ((columns - width / 2) / scale)[..., None] * camera.right.astype(np.float32)
        - ((rows - height / 2) / scale)[..., None] * camera.up.astype(np.float32)
    ).reshape(-1, 3)
    directions /= np.sqrt(np.einsum("ij,ij->i", directions, directions))[:, None]
    scene = rtcore_scene.EmbreeScene()
    TriangleMesh(scene, soup.corners.astype(np.float32))
    hit = scene.run(np.broadcast_to(eye, directions.shape).copy(), directions, output=True)
    face = hit["primID"].astype(np.int64)
    seen = face >= 0

    # What each ray meets: a part, else the ground, else the sky.
    color = np.tile(_SKY.astype(np.float32), (len(directions), 1))
    normals = np.zeros_like(directions)
    ground = ~seen & (directions[:, 2] < 0)
    u, v = hit["u"][seen, None], hit["v"][seen, None]
    corner = soup.normals.astype(np.float32)[face[seen]]
    normal = (1 - u - v) * corner[:, 0] + u * corner[:, 1] + v * corner[:, 2]
    normal /= np.maximum(np.sqrt(np.einsum("ij,ij->i", normal, normal)), 1e-12)[:, None]
    normal *= np.where(np.einsum("ij,ij->i", normal, directions[seen]) > 0, -1.0, 1.0)[:, None]
    normals[seen] = normal
    normals[ground] = (0.0, 0.0, 1.0)

    def shade(rays: NDArray[np.bool_], distance: NDArray[np.float32], albedo: Floats | NDArray[np.float32]) -> None:
        points = eye + directions[rays] * distance[:, None]
        facing = normals[rays]
        start = points + facing * np.float32(2e-3)
        blocked = scene.run(start, np.broadcast_to(sun_direction, start.shape).copy(), query="OCCLUDED") >= 0
        sun = np.where(blocked, 0.0, np.clip(facing @ sun_direction, 0.0, 1.0))
        light = 0.22 + 0.24 * (0.5 + 0.5 * facing[:, 2]) + 0.62 * sun
        color[rays] = albedo * light[:, None]

    if seen.any():
        shade(seen, hit["tfar"][seen], soup.colors.astype(np.float32)[face[seen]])
    if ground.any():
        to_ground = -eye[2] / directions[ground, 2]
        shade(ground, to_ground, _GROUND.astype(np.float32))
        # The ground fades into the sky, so that it has no edge.
        middle, reach = _extent(soup)
        spread = np.linalg.norm((eye + directions[ground] * to_ground[:, None])[:, :2] - middle, axis=1)
        fade = np.clip(spread / reach, 0.0, 1.0)[:, None] ** 2
        color[ground] = color[ground] * (1 - fade) + _SKY.astype(np.float32) * fade

    label = np.where(seen, soup.parts[np.maximum(face, 0)] if len(soup.parts) else -1, -1)
    edges = _edges(label.reshape(height, width), normals.reshape(height, width, 3), seen.reshape(height, width))
    image = color.reshape(height, width, 3)
    image[edges] *= 0.2
    pixels = (_display(np.clip(image, 0.0, 1.0)) * 255.0 + 0.5).astype(np.uint8)
    return Image.fromarray(pixels).resize((camera.width, camera.height), Image.Resampling.BOX)


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


def _extent(soup: Soup) -> tuple[NDArray[np.float32], np.float32]:
    """The middle on the ground, and how far from it the ground is seen: a little more than the machine's size."""
    if not len(soup.corners):
        return np.zeros(2, dtype=np.float32), np.float32(1.0)
    corners = soup.corners.reshape(-1, 3)
    low, high = corners.min(axis=0), corners.max(axis=0)
    return (0.5 * (low + high))[:2].astype(np.float32), np.float32(1.4 * np.linalg.norm(high - low))


def _display(linear: Floats) -> Floats:
    """Linear to sRGB (IEC 61966-2-1, as a power of 2.2)."""
    return np.asarray(linear ** (1.0 / 2.2), dtype=np.float64)


def _edges(label: NDArray[np.int64], normals: Floats, seen: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pixels where two parts, or two faces at more than about 35°, meet."""
    edges = np.zeros(label.shape, dtype=bool)
    for axis in (0, 1):
        here = (slice(None, -1), slice(None)) if axis == 0 else (slice(None), slice(None, -1))
        there = (slice(1, None), slice(None)) if axis == 0 else (slice(None), slice(1, None))
        crease = np.einsum("ijk,ijk->ij", normals[here], normals[there]) < 0.82
        edges[here] |= (label[here] != label[there]) | (crease & seen[here] & seen[there])
    return edges
