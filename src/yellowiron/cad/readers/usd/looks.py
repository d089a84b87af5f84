"""Looks of USD prims: colours, metalness, roughness and textures of bound materials, else the prims' own colours."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Ar, Sdf, Usd, UsdGeom, UsdShade

from yellowiron.cad.appearance.looks import Dressed, Look, dress
from yellowiron.cad.appearance.textures import LARGEST, Picture, Pictures, finish
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Floats, Mesh

_COLORS = ("diffuseColor", "diffuse_color_constant", "base_color")
_PICTURES = ("diffuse_texture", "base_color_texture")
_METALLIC = ("metallic", "metallic_constant", "metalness")
_ROUGHNESS = ("roughness", "reflection_roughness_constant", "specular_roughness")
"""Inputs of UsdPreviewSurface, OmniPBR and MaterialX's standard surface that say the same."""


class Looks:
    """The materials of one stage, each read once."""

    def __init__(self, path: str) -> None:
        self._pictures = Pictures(path)
        self._root = str(Path(path).absolute().resolve())
        self._known: dict[Sdf.Path, tuple[Look, str]] = {}

    def findings(self) -> list[Finding]:
        """What is left out."""
        return self._pictures.findings()

    def dressed(
        self,
        prim: Usd.Prim,
        mesh: Mesh,
        polygon: NDArray[np.int64] | None = None,
        points: NDArray[np.int64] | None = None,
    ) -> Dressed:
        """A prim's bare triangles with its looks. `polygon` (m,) is the face that each triangle is of, `points` (m, 3)
        the face corners, counted through the prim, that its corners are; without them the prim is no mesh."""
        look, varname = self._bound(prim)
        shown = _primvar(prim, "displayColor", 3)
        count = len(mesh.triangles)
        if polygon is None or points is None:
            own = None if shown is None else _color(shown[0][0])
            return dress(mesh, [Look(look.color or own, look.finish)])
        looks, rows = [look], np.zeros(count, dtype=np.int64)
        for subset in UsdShade.MaterialBindingAPI(prim).GetMaterialBindSubsets():
            own_look, own_varname = self._bound(subset.GetPrim())
            faces = np.asarray(subset.GetIndicesAttr().Get() or [], dtype=np.int64)
            looks.append(own_look)
            rows[np.isin(polygon, faces)] = len(looks) - 1
            varname = varname or own_varname
        paint = None
        if shown is not None and all(one.color is None for one in looks):
            paint = _at_corners(shown, mesh, polygon, points)
            paint = None if paint is None else np.clip(paint, 0.0, 1.0).mean(axis=1)
        coordinates = _primvar(prim, varname, 2) if varname else None
        uvs = None if coordinates is None else _at_corners(coordinates, mesh, polygon, points)
        return dress(mesh, looks, rows, uvs=uvs, paint=paint)

    def _bound(self, prim: Usd.Prim) -> tuple[Look, str]:
        """The look of the material bound to a prim, and the primvar of its texture's coordinates."""
        material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
        if not material:
            return Look(), ""
        path = material.GetPath()
        if path not in self._known:
            self._known[path] = self._read(material)
        return self._known[path]

    def _read(self, material: UsdShade.Material) -> tuple[Look, str]:
        """What a material's surface says, under whichever names its shader has it."""
        for prim in Usd.PrimRange(material.GetPrim()):
            shader = UsdShade.Shader(prim)
            if not shader or not any(shader.GetInput(name) for name in (*_COLORS, *_PICTURES)):
                continue
            base = next((e for name in _COLORS if (e := shader.GetInput(name))), None)
            color = None if base is None else _color(base.Get())
            metallic, roughness = (_number(shader, names) for names in (_METALLIC, _ROUGHNESS))
            picture, factor, varname = self._picture(shader, base, color)
            if picture is None:
                return Look(color, finish(metallic, roughness)), ""
            texture, mean = picture.painted(factor)
            return Look(mean, finish(metallic, roughness, texture)), varname
        return Look(), ""

    def _picture(self, shader: UsdShade.Shader, base: Any, color: Color | None) -> tuple[Picture | None, Any, str]:
        """The picture of the base colour, what it is multiplied by, and the primvar of its coordinates."""
        source = base.GetConnectedSource() if base is not None and base.HasConnectedSource() else None
        reader = UsdShade.Shader(source[0].GetPrim()) if source else None
        if reader and reader.GetInput("file"):
            scale = reader.GetInput("scale")
            factor = _color(scale.Get()) if scale and scale.Get() is not None else None
            return self._asset(reader.GetInput("file").Get()), factor, _varname(reader)
        for name in _PICTURES:
            entry = shader.GetInput(name)
            value = entry.Get() if entry else None
            if isinstance(value, Sdf.AssetPath) and value.path:
                return self._asset(value), None, "st"
        return None, None, ""

    def _asset(self, asset: Any) -> Picture | None:
        """A picture of the stage's: in its package, or in its folder or below."""
        if not isinstance(asset, Sdf.AssetPath) or not asset.path:
            return None
        resolved = asset.resolvedPath
        if not Ar.IsPackageRelativePath(resolved):
            return self._pictures.beside(resolved or asset.path)
        package, name = Ar.SplitPackageRelativePathOuter(resolved)
        if str(Path(package).resolve()) != self._root:
            self._pictures.fault(name, "it is in another package")
            return None
        opened = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(resolved))
        if not opened or opened.GetSize() > LARGEST:
            self._pictures.fault(name, "it is missing, or too large")
            return None
        return self._pictures.inside(bytes(opened.GetBuffer()), name)


def _varname(reader: UsdShade.Shader) -> str:
    """The primvar that a texture's coordinates are read from."""
    entry = reader.GetInput("st")
    for _ in range(4):
        source = entry.GetConnectedSource() if entry and entry.HasConnectedSource() else None
        shader = UsdShade.Shader(source[0].GetPrim()) if source else None
        if not shader:
            break
        named = shader.GetInput("varname")
        if named:
            # It may itself be connected to an input of the material's.
            value = UsdShade.Utils.GetValueProducingAttributes(named)
            return str(value[0].Get()) if value and value[0].Get() else "st"
        entry = shader.GetInput("in")
    return "st"


def _number(shader: UsdShade.Shader, names: tuple[str, ...]) -> float | None:
    for name in names:
        entry = shader.GetInput(name)
        value = entry.Get() if entry else None
        if isinstance(value, (int, float)):
            return float(value)
    return None


def _primvar(prim: Usd.Prim, name: str, width: int) -> tuple[Floats, str] | None:
    """(n, width) numbers and the interpolation of a primvar; None where it is absent or broken."""
    found = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(name)
    values = found.ComputeFlattened() if found and found.HasAuthoredValue() else None
    if values is None:
        return None
    try:
        numbers = np.asarray(values, dtype=np.float64).reshape(-1, width)
    except (TypeError, ValueError):
        return None
    return (numbers, str(found.GetInterpolation())) if len(numbers) and np.isfinite(numbers).all() else None


def _at_corners(
    primvar: tuple[Floats, str], mesh: Mesh, polygon: NDArray[np.int64], points: NDArray[np.int64]
) -> Floats | None:
    """(m, 3, k) a primvar's numbers at the triangles' corners."""
    values, interpolation = primvar
    index: NDArray[Any] = np.zeros((len(mesh.triangles), 3), dtype=np.int64)
    if interpolation == UsdGeom.Tokens.uniform:
        index = np.repeat(polygon[:, None], 3, axis=1)
    elif interpolation == UsdGeom.Tokens.faceVarying:
        index = points
    elif interpolation != UsdGeom.Tokens.constant:
        index = mesh.triangles
    return np.asarray(values[index]) if not index.size or index.max() < len(values) else None


def _color(value: Any) -> Color | None:
    if value is None:
        return None
    rgb = np.asarray(value, dtype=np.float64).reshape(-1)[:3]
    if len(rgb) != 3 or not np.isfinite(rgb).all():
        return None
    r, g, b = (float(v) for v in np.clip(rgb, 0.0, 1.0))
    return r, g, b
