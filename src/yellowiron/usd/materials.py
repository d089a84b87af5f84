"""Materials (the conference paper's JSON-1): looks inside the prototypes, physical properties beside the bodies."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from pxr import Gf, Sdf

from yellowiron.model.errors import OutputError
from yellowiron.model.geometry import Color, Shape
from yellowiron.model.template import Material
from yellowiron.usd.stage import (
    WRITE_HINT,
    Types,
    apply_schemas,
    connect,
    define,
    identifier,
    over,
    set_attribute,
    set_display_name,
    set_targets,
)

ELASTICITY = "yellowiron:elasticity"
"""Young's modulus on a physics material, Pa: UsdPhysics has no attribute for it, and rigid bodies do not use it."""

_NEUTRAL: Color = (0.5, 0.5, 0.5)
_PREVIEW_DEFAULTS = {"roughness": 0.5, "metallic": 0.0}


@dataclass(frozen=True)
class Look:
    """What a surface looks like: `name` of its material; linear RGB colour, or None where the mesh's own triangle
    colours show; roughness and metalness or None (UsdPreviewSurface's 0.5 and 0); texture as its document writes it."""

    name: str
    color: Color | None
    roughness: float | None = None
    metalness: float | None = None
    texture: str | None = None


def look_of(part_color: Color | None, shape: Shape, material: Material | None) -> Look:
    """The look of a part: the CAD file's colours (its own, its triangles', its shape's) where it has any and the
    material does not repaint it; else the material's texture or colour; else a neutral grey."""
    own = part_color or (None if shape.mesh.triangle_colors is not None else shape.color)
    coloured = own is not None or shape.mesh.triangle_colors is not None
    if material is None:
        return Look("cad", _plain(own if coloured else _NEUTRAL))
    painted = material.color is not None or material.texture is not None
    texture = None
    if painted and (material.repaint or not coloured):
        own, texture = material.color, material.texture
    elif not coloured:
        own = _NEUTRAL
    return Look(material.name or "material", _plain(own), material.roughness, material.metalness, texture)


def _plain(color: Color | None) -> Color | None:
    return None if color is None else (float(color[0]), float(color[1]), float(color[2]))


def write_look(layer: Sdf.Layer, prototype: str, look: Look, textures: Mapping[str, str]) -> None:
    """A UsdPreviewSurface material under `prototype`/Looks, bound to the prototype.

    It lives inside the prototype: a binding that leaves it is silently dropped for every instance. `textures` maps a
    texture as written in its document to its path relative to this layer.
    """
    scope = f"{prototype}/Looks"
    path = f"{scope}/{identifier(look.name)}"
    define(layer, scope, "Scope")
    material = define(layer, path, "Material")
    set_display_name(material, look.name)
    connect(material, "outputs:surface", Types.Token, f"{path}/surface.outputs:surface")
    shader = define(layer, f"{path}/surface", "Shader")
    set_attribute(shader, "info:id", Types.Token, "UsdPreviewSurface", uniform=True)
    set_attribute(shader, "outputs:surface", Types.Token, None)
    if look.texture is not None:
        connect(shader, "inputs:diffuseColor", Types.Color3f, f"{path}/texture.outputs:rgb")
        _write_texture(layer, path, textures[look.texture])
    elif look.color is not None:
        set_attribute(shader, "inputs:diffuseColor", Types.Color3f, Gf.Vec3f(*look.color))
    else:
        connect(shader, "inputs:diffuseColor", Types.Color3f, f"{path}/color.outputs:result")
        _write_reader(layer, f"{path}/color", "UsdPrimvarReader_float3", "displayColor", Types.Float3)
    for name, value in (("roughness", look.roughness), ("metallic", look.metalness)):
        if value is not None and value != _PREVIEW_DEFAULTS[name]:
            set_attribute(shader, f"inputs:{name}", Types.Float, float(value))
    prim = over(layer, prototype)
    apply_schemas(prim, "MaterialBindingAPI")
    set_targets(prim, "material:binding", path)


def _write_texture(layer: Sdf.Layer, material: str, file: str) -> None:
    texture = define(layer, f"{material}/texture", "Shader")
    set_attribute(texture, "info:id", Types.Token, "UsdUVTexture", uniform=True)
    set_attribute(texture, "inputs:file", Types.Asset, Sdf.AssetPath(file))
    set_attribute(texture, "inputs:sourceColorSpace", Types.Token, "sRGB")
    connect(texture, "inputs:st", Types.Float2, f"{material}/st.outputs:result")
    for axis in ("wrapS", "wrapT"):
        set_attribute(texture, f"inputs:{axis}", Types.Token, "repeat")
    set_attribute(texture, "outputs:rgb", Types.Float3, None)
    _write_reader(layer, f"{material}/st", "UsdPrimvarReader_float2", "st", Types.Float2)


def _write_reader(layer: Sdf.Layer, path: str, kind: str, primvar: str, result: Sdf.ValueTypeName) -> None:
    reader = define(layer, path, "Shader")
    set_attribute(reader, "info:id", Types.Token, kind, uniform=True)
    set_attribute(reader, "inputs:varname", Types.String, primvar)
    set_attribute(reader, "outputs:result", result, None)


def copy_textures(
    textures: Sequence[str], folder: Path, *, search: Sequence[Path], relative: str
) -> tuple[dict[str, str], list[Path]]:
    """Copies texture files into `folder`; returns their paths as a layer should write them (`relative`/file name), by
    the text that named them, and the files written.

    A relative text is looked up in the `search` folders in order. Two files of one name and different content are
    told apart by a part of their hash. `OutputError` where a texture is not found.
    """
    written: dict[str, bytes] = {}
    names: dict[str, str] = {}
    for text in dict.fromkeys(textures):
        content = _find_texture(text, search).read_bytes()
        name = Path(text).name
        if written.setdefault(name, content) != content:
            name = f"{Path(text).stem}_{hashlib.sha256(content).hexdigest()[:8]}{Path(text).suffix}"
            written[name] = content
        names[text] = f"{relative}/{name}"
    files = []
    for name, content in written.items():
        files.append(folder / name)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            files[-1].write_bytes(content)
        except OSError as error:
            raise OutputError("A texture cannot be written", where=str(files[-1]), hint=WRITE_HINT) from error
    return names, files


def _find_texture(text: str, search: Sequence[Path]) -> Path:
    absolute = [Path(text)] if Path(text).is_absolute() else []
    for candidate in (*absolute, *(folder / text for folder in search)):
        if candidate.is_file():
            return candidate
    raise OutputError(
        "A material's texture file is not there", where=text, hint="Give its path relative to the materials document."
    )


def write_physics_material(layer: Sdf.Layer, path: str, material: Material) -> None:
    """Density, friction and restitution, and Young's modulus as `yellowiron:elasticity` (Pa), where stated."""
    spec = define(layer, path, "Material")
    set_display_name(spec, material.name)
    apply_schemas(spec, "PhysicsMaterialAPI")
    values = {
        "physics:density": material.density,
        "physics:dynamicFriction": material.dynamic_friction,
        "physics:restitution": material.restitution,
        "physics:staticFriction": material.static_friction,
    }
    for name, value in values.items():
        if value:
            set_attribute(spec, name, Types.Float, float(value))
    if material.elasticity is not None:
        set_attribute(spec, ELASTICITY, Types.Float, float(material.elasticity), custom=True)
