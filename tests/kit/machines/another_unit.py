"""Models of which some parts are written in another unit than the rest."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace

from yellowiron.alignment.assignment.unit_scale import farther, larger
from yellowiron.model.assembly import Assembly


def in_another_unit(assembly: Assembly, parts: Collection[str], ratio: float) -> Assembly:
    """The model with some parts, by id, so many times as large about the file's origin."""
    shapes, changed = dict(assembly.shapes), []
    for part in assembly.parts:
        if part.id in parts:
            key = f"{part.shape}*{ratio:.9g}"
            shapes[key] = larger(assembly.shape_of(part), ratio, key)
            part = replace(part, shape=key, transform=farther(part.transform, ratio))
        changed.append(part)
    return replace(assembly, parts=tuple(changed), shapes=shapes)
