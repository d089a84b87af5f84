"""`materials.json`, the conference paper's JSON-1: one entry of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from yellowiron.library.notation.quantities import in_unit
from yellowiron.library.notation.validated_json import Document
from yellowiron.model.errors import TemplateError
from yellowiron.model.geometry import Color, linear
from yellowiron.model.template import Material

_MATERIAL_UNITS: Mapping[str, str] = {"density": "kg/m^3", "elasticity": "Pa"}
"""What a material states in units, and the SI ones."""


def read_material(document: Document, key: str, entry: Mapping[str, Any]) -> Material:
    """One entry of JSON-1. `TemplateError` for a texture that is not there, frictions in the wrong order, and a density
    or elasticity that is none."""
    static, dynamic = entry.get("static friction"), entry.get("dynamic friction")
    if static is not None and dynamic is not None and dynamic > static:
        raise TemplateError(
            f"The dynamic friction of '{key}' is above its static friction",
            where=document.at(key, "dynamic friction"),
            hint="What slides rubs no more than what stands.",
        )
    texture = entry.get("texture")
    if texture is not None and not (document.path.parent / texture).is_file():
        raise TemplateError(
            f"The texture '{texture}' is not there",
            where=document.at(key, "texture"),
            hint="Its path is relative to this document.",
        )
    numbers = {k: float(entry[k]) for k in ("restitution", "roughness", "metalness") if k in entry}
    for k, unit in _MATERIAL_UNITS.items():
        if k in entry:
            numbers[k] = in_unit(entry[k], unit, where=document.at(key, k))
    return Material(
        name=entry.get("name", key),
        density=numbers.get("density"),
        elasticity=numbers.get("elasticity"),
        static_friction=None if static is None else float(static),
        dynamic_friction=None if dynamic is None else float(dynamic),
        restitution=numbers.get("restitution"),
        color=_color(entry.get("color")),
        texture=texture,
        roughness=numbers.get("roughness"),
        metalness=numbers.get("metalness"),
        friction_combine=entry.get("friction combine"),
    )


def _color(value: str | list[float] | None) -> Color | None:
    """Linear RGB of `#RRGGBB` (sRGB: IEC 61966-2-1) or of three linear numbers."""
    if value is None:
        return None
    if isinstance(value, str):
        coded = [int(value[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]
        value = list(linear(coded))
    return (float(value[0]), float(value[1]), float(value[2]))
