"""Layers, prims and attributes: the few authoring calls that every other module here is written with.

Everything is authored on `Sdf` specs in memory and exported once: no stage is composed while writing. Only what
differs from a schema's default is written, which is the caller's business.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Tf, Vt

from yellowiron.model.errors import OutputError
from yellowiron.model.geometry import Floats

Types = Sdf.ValueTypeNames
WRITE_HINT = "Check that the folder exists, may be written to, and has space."


def create_layer(default_prim: str, *, binary: bool = False) -> Sdf.Layer:
    """A new layer in memory, in metres, kilograms and Z up, with its default prim named (not yet defined)."""
    layer = Sdf.Layer.CreateAnonymous(".usdc" if binary else ".usda")
    layer.defaultPrim = default_prim
    for key, value in (("metersPerUnit", 1.0), ("kilogramsPerUnit", 1.0), ("upAxis", "Z")):
        layer.pseudoRoot.SetInfo(key, value)
    return layer


def save_layer(layer: Sdf.Layer, path: Path) -> Path:
    """Writes a layer, crate or text by the path's extension; `OutputError` where that is impossible."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        saved = layer.Export(str(path))
    except (OSError, Tf.ErrorException) as error:
        raise OutputError("The USD layer cannot be written", where=str(path), hint=WRITE_HINT) from error
    if not saved:
        raise OutputError("The USD layer cannot be written", where=str(path), hint=WRITE_HINT)
    return path


def define(layer: Sdf.Layer, path: str, type_name: str = "", *, abstract: bool = False) -> Sdf.PrimSpec:
    """Defines a prim (`def`, or `class` where `abstract`); ancestors that are missing become `over`."""
    spec = Sdf.CreatePrimInLayer(layer, path)
    spec.specifier = Sdf.SpecifierClass if abstract else Sdf.SpecifierDef
    if type_name:
        spec.typeName = type_name
    return spec


def over(layer: Sdf.Layer, path: str) -> Sdf.PrimSpec:
    """The prim's opinions in this layer: the spec that is there, else a new `over`."""
    return layer.GetPrimAtPath(path) or Sdf.CreatePrimInLayer(layer, path)


def set_attribute(
    spec: Sdf.PrimSpec,
    name: str,
    type_name: Sdf.ValueTypeName,
    value: Any,
    *,
    uniform: bool = False,
    custom: bool = False,
    interpolation: str = "",
) -> None:
    """Authors one attribute with its default value; `interpolation` is a primvar's."""
    variability = Sdf.VariabilityUniform if uniform else Sdf.VariabilityVarying
    attribute = Sdf.AttributeSpec(spec, name, type_name, variability, custom)
    attribute.default = value
    if interpolation:
        attribute.SetInfo("interpolation", interpolation)


def set_targets(spec: Sdf.PrimSpec, name: str, *targets: str) -> None:
    """Authors a relationship with its targets, in the order given."""
    relationship = Sdf.RelationshipSpec(spec, name, False)
    relationship.targetPathList.explicitItems = [Sdf.Path(target) for target in targets]


def connect(spec: Sdf.PrimSpec, name: str, type_name: Sdf.ValueTypeName, source: str) -> None:
    """Authors an attribute that is connected to another one."""
    attribute = Sdf.AttributeSpec(spec, name, type_name, Sdf.VariabilityVarying, False)
    attribute.connectionPathList.explicitItems = [Sdf.Path(source)]


def declare_variants(spec: Sdf.PrimSpec, name: str, choices: Iterable[str]) -> None:
    """A variant set with those variants, empty where they are not there yet, on a layer's machine prim. Its selection
    is the machine file's: layers below follow it."""
    if name not in spec.variantSets:
        variants = Sdf.VariantSetSpec(spec, name)
        for choice in sorted(choices):
            Sdf.VariantSpec(variants, choice)
    names = list(spec.variantSetNameList.prependedItems)
    if name not in names:
        spec.variantSetNameList.prependedItems = [*names, name]


def apply_schemas(spec: Sdf.PrimSpec, *names: str) -> None:
    """Applies API schemas by name, after those already applied here. The schemas need not be registered."""
    held = spec.GetInfo("apiSchemas")
    present = list(held.prependedItems) if held else []
    spec.SetInfo(
        "apiSchemas", Sdf.TokenListOp.Create(prependedItems=[*present, *(n for n in names if n not in present)])
    )


def add_reference(spec: Sdf.PrimSpec, asset: str, path: str = "") -> None:
    """Adds a reference; `asset` "" is the same layer."""
    spec.referenceList.Prepend(Sdf.Reference(asset, Sdf.Path(path) if path else Sdf.Path.emptyPath))


def set_display_name(spec: Sdf.PrimSpec, name: str) -> None:
    """Keeps a name that is no legal prim name as it was written."""
    if name != spec.name:
        spec.SetInfo("displayName", name)


def set_transform(spec: Sdf.PrimSpec, matrix: Floats) -> None:
    """One `xformOp:transform`: `matrix` (4, 4) takes column vectors, metres, from the prim's frame to its parent's."""
    set_attribute(spec, "xformOp:transform", Types.Matrix4d, Gf.Matrix4d(np.asarray(matrix).T.tolist()))
    _set_order(spec, "xformOp:transform")


def set_placement(
    spec: Sdf.PrimSpec,
    translation: Iterable[float],
    quaternion: tuple[float, float, float, float] | None = None,
    scale: tuple[float, float, float] | None = None,
) -> None:
    """Translate, orient (w, x, y, z) and scale operations; those that would do nothing are left out."""
    order = []
    offset = Gf.Vec3d(*(float(v) for v in translation))
    if offset != Gf.Vec3d(0.0):
        set_attribute(spec, "xformOp:translate", Types.Double3, offset)
        order.append("xformOp:translate")
    if quaternion is not None and quaternion != (1.0, 0.0, 0.0, 0.0):
        set_attribute(spec, "xformOp:orient", Types.Quatd, Gf.Quatd(*quaternion))
        order.append("xformOp:orient")
    if scale is not None and scale != (1.0, 1.0, 1.0):
        set_attribute(spec, "xformOp:scale", Types.Double3, Gf.Vec3d(*scale))
        order.append("xformOp:scale")
    if order:
        _set_order(spec, *order)


def _set_order(spec: Sdf.PrimSpec, *operations: str) -> None:
    set_attribute(spec, "xformOpOrder", Types.TokenArray, Vt.TokenArray(operations), uniform=True)


def identifier(name: str) -> str:
    """A legal prim name as close to `name` as USD allows: letters and digits of any script stay, others become '_'."""
    text = "".join(c if c == "_" or f"a{c}".isidentifier() else "_" for c in unicodedata.normalize("NFC", name))
    if not text or not Sdf.Path.IsValidIdentifier(text):
        text = f"_{text}"
    return text if Sdf.Path.IsValidIdentifier(text) else str(Tf.MakeValidIdentifier(name))


class Names:
    """Gives out prim names that are unique among siblings: `plate`, `plate_2`, `plate_3` in the order asked."""

    def __init__(self, *taken: str) -> None:
        self._taken = set(taken)
        self._last: dict[str, int] = {}

    def give(self, name: str) -> str:
        """A free identifier for `name`."""
        base = identifier(name)
        chosen, count = base, self._last.get(base, 1)
        while chosen in self._taken:
            count += 1
            chosen = f"{base}_{count}"
        self._last[base] = count
        self._taken.add(chosen)
        return chosen
