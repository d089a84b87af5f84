"""Shapes: meshes and the features that were fitted to them. Metres, in the shape's own frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Color = tuple[float, float, float]

DIRECTIONS: Mapping[str, Floats] = {
    "lengthwise": np.array([1.0, 0.0, 0.0]),
    "lateral": np.array([0.0, 1.0, 0.0]),
    "vertical": np.array([0.0, 0.0, 1.0]),
}
"""What templates call a joint's direction (`JointTemplate.direction`), in the machine's frame."""


def linear(srgb: Sequence[float]) -> Color:
    """A colour as files write it, sRGB in [0, 1], as linear RGB (IEC 61966-2-1)."""
    r, g, b = linear_values(np.asarray(srgb, dtype=np.float64)).tolist()
    return r, g, b


def linear_values(srgb: Floats) -> Floats:
    """Numbers of sRGB colours in [0, 1], of any shape, as linear ones (IEC 61966-2-1), to 12 decimals: a power's last
    digits are the processor's."""
    return np.asarray(np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4).round(12))


@dataclass(frozen=True)
class Texture:
    """A picture on a surface. `file` is its name without a folder, unique by its content, ending in .png or .jpg;
    `data` that file's bytes; `factor` (linear RGB) multiplies it."""

    file: str
    data: bytes = field(compare=False, repr=False)
    factor: Color = (1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Finish:
    """What a surface is like besides its colour, as far as a file says so: metalness and roughness in [0, 1], and the
    texture that is seen instead of the plain colour, which is then its mean."""

    metallic: float | None = None
    roughness: float | None = None
    texture: Texture | None = None


@dataclass(frozen=True, eq=False)
class Mesh:
    """A triangle mesh.

    `points` (n, 3) float64 in metres, `triangles` (m, 3) int32 indices, counter-clockwise seen from outside,
    `normals` (n, 3) unit vertex normals or None, `triangle_colors` (m, 3) linear RGB or None; `uvs` (m, 3, 2) texture
    coordinates of the triangles' corners, the picture's lower left being (0, 0), or None; `triangle_finishes` (m,) the
    number of each triangle's finish among its shape's, where it has several.
    """

    points: Floats
    triangles: Ints
    normals: Floats | None = None
    triangle_colors: Floats | None = None
    uvs: Floats | None = None
    triangle_finishes: Ints | None = None


@dataclass(frozen=True)
class CylinderFeature:
    """One cylindrical face set: all faces of one shape that lie on the same cylinder.

    The axis passes through `point` along the unit vector `direction`; the faces span [`lower`, `upper`]
    (metres along `direction`, measured from `point`) and `arc` radians around it (2π: a full cylinder).
    `inner` is true for a bore (material outside), false for a shaft. `exact` is true where it came from a
    B-rep surface, false where it was fitted to triangles. `area` in m². `error`: metres by which the radius and the
    axis may be off, where the triangles are too coarse, too noisy or too few to tell them.
    """

    point: tuple[float, float, float]
    direction: tuple[float, float, float]
    radius: float
    lower: float
    upper: float
    arc: float
    inner: bool
    exact: bool = True
    area: float = 0.0
    error: float = 0.0

    @property
    def length(self) -> float:
        """Metres along the axis."""
        return self.upper - self.lower

    @property
    def center(self) -> tuple[float, float, float]:
        """The axis point midway between the two ends."""
        middle = 0.5 * (self.lower + self.upper)
        x, y, z = self.point
        dx, dy, dz = self.direction
        return (x + middle * dx, y + middle * dy, z + middle * dz)


@dataclass(frozen=True)
class PlaneFeature:
    """One planar face: `point` at its centre of area, outward unit `normal`, `area` in m²."""

    point: tuple[float, float, float]
    normal: tuple[float, float, float]
    area: float


@dataclass(frozen=True)
class SphereFeature:
    """One spherical face set: `center`, `radius`, `area` (m²); `inner` is true for a socket (material outside)."""

    center: tuple[float, float, float]
    radius: float
    inner: bool
    area: float


@dataclass(frozen=True, eq=False)
class Shape:
    """One distinct solid (or sheet) of a CAD file, shared by all its occurrences. Own frame, metres.

    `key` is a hash of the content: equal shapes of two files have equal keys. `volume` (m³), `centroid` (3,)
    and `inertia` (3, 3) (m⁵: for density 1, about the centroid) are exact where `exact` is true (B-rep), else
    those of the mesh. `closed` is false for sheets and open meshes, whose volume means little. `knuckles` are rounded
    bosses and eyes of a mesh that are no cylinders, each with the cylinder that is nearest to it. `finishes`: one for
    all of it, or those that the mesh's triangles number; none where the file states none.
    """

    key: str
    name: str
    mesh: Mesh
    volume: float
    area: float
    centroid: Floats
    inertia: Floats
    closed: bool = True
    exact: bool = True
    color: Color | None = None
    cylinders: tuple[CylinderFeature, ...] = ()
    planes: tuple[PlaneFeature, ...] = ()
    bounds: Floats = field(default_factory=lambda: np.zeros((2, 3)))
    knuckles: tuple[CylinderFeature, ...] = ()
    finishes: tuple[Finish, ...] = ()
    spheres: tuple[SphereFeature, ...] = ()
