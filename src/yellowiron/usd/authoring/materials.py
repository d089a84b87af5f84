"""Materials (the conference paper's JSON-1): looks inside the prototypes, physical properties beside the bodies."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from pxr import Gf, Sdf

from yellowiron.model.errors import OutputError
from yellowiron.model.geometry import Color, Finish, Mesh, Shape, Texture
from yellowiron.model.template import Material
from yellowiron.usd.authoring.stage import (
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

PICTURES = "./textures"
"""Where a layer finds the CAD file's pictures."""
_NEUTRAL: Color = (0.5, 0.5, 0.5)
_PREVIEW_DEFAULTS = {"roughness": 0.5, "metallic": 0.0}


@dataclass(frozen=True)
class Look:
    """What a surface looks like: `name` of its material; linear RGB colour, or None where the mesh's own triangle
    colours show; roughness and metalness or None (UsdPreviewSurface's 0.5 and 0); texture as its document writes it;
    `picture`, the CAD file's own, which the mesh has coordinates for. `faces`: the looks that the mesh's triangles
    number, where they have several."""

    name: str
    color: Color | None
    roughness: float | None = None
    metalness: float | None = None
    texture: str | None = None
    picture: Texture | None = None
    faces: tuple[Look, ...] = ()


def look_of(part_color: Color | None, shape: Shape, material: Material | None) -> Look:
    """The look of a part: the CAD file's colours, textures, metalness and roughness (its own, its triangles', its
    shape's) where it has any and the material does not repaint it; else the material's; else a neutral grey."""
    own = part_color or (None if shape.mesh.triangle_colors is not None else shape.color)
    coloured = own is not None or shape.mesh.triangle_colors is not None
    if material is None:
        return _finished(Look("cad", _plain(own if coloured else _NEUTRAL)), shape)
    painted = material.color is not None or material.texture is not None
    texture = None
    repainted = painted and (material.repaint or not (coloured or shape.finishes))
    if repainted:
        own, texture = material.color, material.texture
    elif not coloured:
        own = _NEUTRAL
    look = Look(material.name or "material", _plain(own), material.roughness, material.metalness, texture)
    return look if repainted else _finished(look, shape)


def _plain(color: Color | None) -> Color | None:
    return None if color is None else (float(color[0]), float(color[1]), float(color[2]))


def _finished(look: Look, shape: Shape) -> Look:
    """A look with what the CAD file says of the shape's surface."""
    mesh = shape.mesh
    if len(shape.finishes) > 1 and mesh.triangle_finishes is not None:
        faces = tuple(_with(replace(look, name=f"{look.name}_{n}"), f, mesh) for n, f in enumerate(shape.finishes, 1))
        return replace(look, faces=faces)
    return _with(look, shape.finishes[0], mesh) if len(shape.finishes) == 1 else look


def _with(look: Look, finish: Finish, mesh: Mesh) -> Look:
    return replace(
        look,
        roughness=look.roughness if finish.roughness is None else finish.roughness,
        metalness=look.metalness if finish.metallic is None else finish.metallic,
        picture=None if mesh.uvs is None else finish.texture,
    )


def write_look(layer: Sdf.Layer, prototype: str, look: Look, textures: Mapping[str, str]) -> None:
    """UsdPreviewSurface materials under `prototype`/Looks: one, bound to the prototype; or as many as its triangles
    number, each bound to a subset of the mesh by who writes that.

    They live inside the prototype: a binding that leaves it is silently dropped for every instance. `textures` maps a
    texture as written in its document to its path relative to this layer.
    """
    scope = f"{prototype}/Looks"
    define(layer, scope, "Scope")
    if look.faces:
        for face in look.faces:
            _write_material(layer, look_path(prototype, face), face, textures)
    else:
        path = look_path(prototype, look)
        _write_material(layer, path, look, textures)
        bind(over(layer, prototype), path)


def look_path(prototype: str, look: Look) -> str:
    """Where a look's material is."""
    return f"{prototype}/Looks/{identifier(look.name)}"


def bind(spec: Sdf.PrimSpec, material: str) -> None:
    """Binds a material to a prim."""
    apply_schemas(spec, "MaterialBindingAPI")
    set_targets(spec, "material:binding", material)


def _write_material(layer: Sdf.Layer, path: str, look: Look, textures: Mapping[str, str]) -> None:
    material = define(layer, path, "Material")
    set_display_name(material, look.name)
    connect(material, "outputs:surface", Types.Token, f"{path}/surface.outputs:surface")
    shader = define(layer, f"{path}/surface", "Shader")
    set_attribute(shader, "info:id", Types.Token, "UsdPreviewSurface", uniform=True)
    set_attribute(shader, "outputs:surface", Types.Token, None)
    if look.texture is not None or look.picture is not None:
        connect(shader, "inputs:diffuseColor", Types.Color3f, f"{path}/texture.outputs:rgb")
        if look.texture is not None:
            _write_texture(layer, path, textures[look.texture])
        elif look.picture is not None:
            _write_texture(layer, path, f"{PICTURES}/{look.picture.file}", look.picture.factor)
            if look.color is not None:
                # For those that show no pictures.
                shader.attributes["inputs:diffuseColor"].default = Gf.Vec3f(*look.color)
    elif look.color is not None:
        set_attribute(shader, "inputs:diffuseColor", Types.Color3f, Gf.Vec3f(*look.color))
    else:
        connect(shader, "inputs:diffuseColor", Types.Color3f, f"{path}/color.outputs:result")
        _write_reader(layer, f"{path}/color", "UsdPrimvarReader_float3", "displayColor", Types.Float3)
    for name, value in (("roughness", look.roughness), ("metallic", look.metalness)):
        if value is not None and value != _PREVIEW_DEFAULTS[name]:
            set_attribute(shader, f"inputs:{name}", Types.Float, float(value))


def _write_texture(layer: Sdf.Layer, material: str, file: str, factor: Color = (1.0, 1.0, 1.0)) -> None:
    texture = define(layer, f"{material}/texture", "Shader")
    set_attribute(texture, "info:id", Types.Token, "UsdUVTexture", uniform=True)
    set_attribute(texture, "inputs:file", Types.Asset, Sdf.AssetPath(file))
    set_attribute(texture, "inputs:sourceColorSpace", Types.Token, "sRGB")
    connect(texture, "inputs:st", Types.Float2, f"{material}/st.outputs:result")
    if factor != (1.0, 1.0, 1.0):
        set_attribute(texture, "inputs:scale", Types.Float4, Gf.Vec4f(*factor, 1.0))
    for axis in ("wrapS", "wrapT"):
        set_attribute(texture, f"inputs:{axis}", Types.Token, "repeat")
    set_attribute(texture, "outputs:rgb", Types.Float3, None)
    _write_reader(layer, f"{material}/st", "UsdPrimvarReader_float2", "st", Types.Float2)


def _write_reader(layer: Sdf.Layer, path: str, kind: str, primvar: str, result: Sdf.ValueTypeName) -> None:
    reader = define(layer, path, "Shader")
    set_attribute(reader, "info:id", Types.Token, kind, uniform=True)
    set_attribute(reader, "inputs:varname", Types.String, primvar)
    set_attribute(reader, "outputs:result", result, None)


def write_pictures(looks: Iterable[Look], folder: Path) -> list[Path]:
    """Writes the CAD file's own pictures that looks show into `folder`/textures and returns their paths."""
    found = {p.file: p.data for look in looks for one in (look, *look.faces) if (p := one.picture) is not None}
    files = [folder / PICTURES / name for name in found]
    for file, data in zip(files, found.values(), strict=True):
        try:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(data)
        except OSError as error:
            raise OutputError("A texture cannot be written", where=str(file), hint=WRITE_HINT) from error
    return files


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
