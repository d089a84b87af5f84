"""A B-rep solid or open shell to a `Shape`: exact mass properties, features, content key, mesh."""

from __future__ import annotations

import functools
import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from OCP.Bnd import Bnd_Box
from OCP.BRep import BRep_Tool
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps
from OCP.Standard import Standard_Failure
from OCP.TopAbs import TopAbs_FACE, TopAbs_SHELL, TopAbs_SOLID
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS

from yellowiron.cad.brep import features
from yellowiron.cad.brep.tessellate import MILLIMETRE, mesh_of
from yellowiron.cad.mesh import measures
from yellowiron.cad.mesh.features import facets
from yellowiron.cad.tolerances import LARGEST
from yellowiron.model.geometry import Color, Floats, Shape


@dataclass(eq=False)
class MeasuredSolid:
    """One distinct solid or open shell, measured but not yet meshed. Lengths in mm, as Open CASCADE keeps them.

    The first 32 characters of `key` are a hash of the geometry alone; coloured solids have 9 more, so that one key
    is one look too. `tessellated`: the file has triangles and no surfaces.
    """

    name: str
    shape: Any
    faces: list[Any]
    survey: list[features.Face]
    closed: bool
    volume: float
    area: float
    centroid: Floats
    inertia: Floats
    box: Floats
    color: Color | None
    face_colors: list[Color | None] | None
    tessellated: bool = False

    @functools.cached_property
    def key(self) -> str:
        """Hash of the content."""
        return _painted(measures.content_key(mesh_of(self.faces)[0]) if self.tessellated else _key(self), self)

    @property
    def diagonal(self) -> float:
        """Of the bounding box, mm."""
        return float(np.linalg.norm(self.box[1] - self.box[0]))


def measure(
    name: str, shape: Any, *, color: Color | None = None, face_colors: Sequence[Color | None] | None = None
) -> MeasuredSolid:
    """The measures of a solid, compsolid, shell or compound of faces in its own frame.

    A closed shell counts as the solid it bounds; a solid turned inside out is turned back. `ValueError`, its text a
    predicate ("its geometry is broken"), if the shape cannot be a part.
    """
    try:
        solid = _measure(name, shape, color, face_colors)
    except Standard_Failure as error:
        raise ValueError("its geometry is broken") from error
    numbers = (solid.box, solid.volume, solid.area, solid.centroid, solid.inertia)
    if not all(bool(np.isfinite(value).all()) for value in numbers):
        raise ValueError("its measures are not finite numbers")
    return solid


def _measure(name: str, shape: Any, color: Color | None, face_colors: Sequence[Color | None] | None) -> MeasuredSolid:
    shape, closed = _close(shape)
    _check_size(shape)
    box = _box(shape, optimal=True)
    faces = subshapes(shape, TopAbs_FACE)
    surveyed, volume = features.survey(faces, box)
    colors = None if face_colors is None else list(face_colors)
    if colors is not None and len(set(colors)) == 1:
        color, colors = colors[0] or color, None
    if not surveyed:
        return _tessellated(name, shape, faces, color, colors)
    if closed:
        properties = volume if len(surveyed) == len(faces) else _integrate(shape)
        if properties.Mass() < 0.0:
            return _measure(name, shape.Reversed(), color, face_colors)
    area = sum(face.area for face in surveyed)
    if closed:
        centroid = np.array(properties.CentreOfMass().Coord())
        matrix = properties.MatrixOfInertia()
        inertia = np.array([[matrix.Value(i, j) for j in (1, 2, 3)] for i in (1, 2, 3)])
    else:
        # The centre of an open shell is that of its area; what it weighs is not in the file.
        weights = np.array([face.area for face in surveyed])
        centers = np.array([face.center for face in surveyed]).reshape(-1, 3)
        centroid = weights @ centers / weights.sum() if weights.sum() > 0.0 else box.mean(axis=0)
        inertia = np.zeros((3, 3))
    return MeasuredSolid(
        name=name,
        shape=shape,
        faces=faces,
        survey=surveyed,
        closed=closed,
        volume=properties.Mass() if closed else 0.0,
        area=area,
        centroid=centroid,
        inertia=inertia,
        box=box,
        color=color,
        face_colors=colors,
    )


def _tessellated(
    name: str, shape: Any, faces: list[Any], color: Color | None, face_colors: list[Color | None] | None
) -> MeasuredSolid:
    """A solid whose faces are triangles and have no surface (AP242 tessellated solids)."""
    mesh, _ = mesh_of(faces)
    if not len(mesh.triangles):
        raise ValueError("it has neither surfaces nor triangles")
    closed = measures.is_closed(mesh)
    area, centroid = measures.area_properties(mesh)
    volume, inertia = 0.0, np.zeros((3, 3))
    if closed:
        volume, centroid, inertia = measures.volume_properties(mesh)
    return MeasuredSolid(
        name=name,
        shape=shape,
        faces=faces,
        survey=[],
        closed=closed,
        volume=volume / MILLIMETRE**3,
        area=area / MILLIMETRE**2,
        centroid=centroid / MILLIMETRE,
        inertia=inertia / MILLIMETRE**5,
        box=measures.bounds(mesh) / MILLIMETRE,
        color=color,
        face_colors=face_colors,
        tessellated=True,
    )


def _integrate(shape: Any) -> Any:
    """Volume properties of a shape that has triangles for some of its faces."""
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties, features.INTEGRATION, False, False)
    return properties


def subshapes(shape: Any, kind: Any) -> list[Any]:
    """The sub-shapes of a kind in exploration order, cast to their type."""
    cast = {TopAbs_FACE: TopoDS.Face, TopAbs_SHELL: TopoDS.Shell, TopAbs_SOLID: TopoDS.Solid}[kind]
    explorer, found = TopExp_Explorer(shape, kind), []
    while explorer.More():
        found.append(cast(explorer.Current()))
        explorer.Next()
    return found


def is_open_shell(shape: Any) -> bool:
    """True for a face and an open shell."""
    return shape.ShapeType() == TopAbs_FACE or (shape.ShapeType() == TopAbs_SHELL and not BRep_Tool.IsClosed_s(shape))


def _close(shape: Any) -> tuple[Any, bool]:
    shells = subshapes(shape, TopAbs_SHELL)
    closed = bool(shells) and all(BRep_Tool.IsClosed_s(shell) for shell in shells)
    if shape.ShapeType() == TopAbs_SHELL and closed:
        return BRepBuilderAPI_MakeSolid(shells[0]).Solid(), True
    return shape, closed and bool(subshapes(shape, TopAbs_SOLID))


def _check_size(shape: Any) -> None:
    """`ValueError` where a shape is not of this world: integrals over it would overflow, or never end."""
    size = float(np.linalg.norm(np.ptp(_box(shape, optimal=False), axis=0)))
    if not math.isfinite(size):
        raise ValueError("its coordinates are not finite numbers")
    if size * MILLIMETRE > LARGEST:
        raise ValueError(f"it would be {size * MILLIMETRE:.3g} m large")


def _box(shape: Any, *, optimal: bool) -> Floats:
    """(2, 3) bounds, mm: exact ones, or loose ones in a fraction of the time. Infinite or NaN where there are none."""
    box = Bnd_Box()
    if optimal:
        BRepBndLib.AddOptimal_s(shape, box, False, False)
    else:
        BRepBndLib.Add_s(shape, box, True)
    if box.IsVoid() or box.IsOpen():
        return np.full((2, 3), np.nan)
    low, high = box.CornerMin(), box.CornerMax()
    return np.array([low.Coord(), high.Coord()])


def _key(solid: MeasuredSolid) -> str:
    """A hash of what the solid is: its faces' kinds, areas and centres, its volume and inertia.

    Lengths are taken to 1e-4 mm or a millionth of the size, whichever is more, so that the last digits of another
    export or unit do not matter.
    """
    size = solid.diagonal
    step = max(1e-4, 1e-6 * size)
    # The size itself goes in too: measured in steps of itself, a shape twice as large is the same.
    rows = sorted(
        (face.kind, round(face.area / (step * size)), *(round(c / step) for c in face.center)) for face in solid.survey
    )
    whole = [
        round(math.log10(size) * 1e5),
        round(solid.volume / (step * size**2)),
        *(round(c / step) for c in solid.centroid),
    ]
    whole += [round(float(value) / (step * size**4)) for value in solid.inertia.ravel()]
    return hashlib.sha256(repr((rows, whole, solid.closed)).encode()).hexdigest()[:32]


def _painted(geometry: str, solid: MeasuredSolid) -> str:
    """A key with the solid's colours, if it has any."""
    if solid.color is None and solid.face_colors is None:
        return geometry
    paint = repr((_rounded(solid.color), [_rounded(color) for color in solid.face_colors or ()]))
    return f"{geometry}-{hashlib.sha256(paint.encode()).hexdigest()[:8]}"


def _rounded(color: Color | None) -> tuple[float, ...] | None:
    return None if color is None else tuple(round(channel, 4) for channel in color)


def finish(solid: MeasuredSolid) -> tuple[Shape, int]:
    """The shape of a meshed solid, in metres; and how many of its faces could not be meshed."""
    colors = solid.face_colors
    if colors is not None:
        colors = [color or solid.color for color in colors]
    mesh, missing = mesh_of(solid.faces, colors)
    volume, centroid = solid.volume, solid.centroid * MILLIMETRE
    inertia, exact = solid.inertia * MILLIMETRE**5, not solid.tessellated
    volume *= MILLIMETRE**3
    if exact and solid.closed and not 0.0 < solid.volume <= float(np.prod(solid.box[1] - solid.box[0])) * (1.0 + 1e-6):
        volume, centroid, inertia = measures.volume_properties(mesh)
        exact = False
    found = facets.find(mesh) if solid.tessellated and len(mesh.triangles) else None
    shape = Shape(
        key=solid.key,
        name=solid.name,
        mesh=mesh,
        volume=volume,
        area=solid.area * MILLIMETRE**2,
        centroid=centroid,
        inertia=inertia,
        closed=solid.closed,
        exact=exact,
        color=solid.color,
        cylinders=features.cylinders(solid.survey) if found is None else found.cylinders,
        planes=features.planes(solid.survey) if found is None else found.planes,
        bounds=solid.box * MILLIMETRE,
        knuckles=() if found is None else found.knuckles,
        spheres=features.spheres(solid.survey) if found is None else found.spheres,
    )
    return shape, missing
