"""Where a joint is, as a person says it: a point and a direction, a line through two points, the middle of a circle."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from yellowiron.library.notation.validated_json import Document
from yellowiron.model.alignment import Vector
from yellowiron.model.errors import TemplateError
from yellowiron.model.geometry import Floats
from yellowiron.support.vectors import line_through, triple

_SHORT = 1e-9
"""Metres, or a direction's length: less is nothing."""
_BALL: Vector = (0.0, 0.0, 1.0)


def read_axis(document: Document, name: str, entry: Mapping[str, Any], kind: str) -> tuple[Vector, Vector] | None:
    """A point (metres) and a unit vector, CAD frame, of an entry with `anchor` and `axis`, or with `through`: two
    points of the axis, or three of a circle about it. None for an entry with none of them. `TemplateError` for half of
    them, for both, and for points that give no line."""
    stated = [key for key in ("anchor", "axis", "through") if key in entry]
    if not stated:
        return None
    if "through" in entry:
        if len(stated) > 1:
            raise _error(document, name, "has anchor or axis beside through", "Keep one of both.")
        return _through(document, name, np.array(entry["through"], dtype=np.float64))
    if "anchor" not in entry:
        raise _error(document, name, "has an axis and no anchor", "Add a point on it, in metres: anchor.")
    x, y, z = (float(v) for v in entry["anchor"])
    if "axis" not in entry and kind != "spherical":
        raise _error(document, name, "has an anchor and no axis", "Add its direction: axis.")
    direction = np.array(entry.get("axis", _BALL), dtype=np.float64)
    return (x, y, z), triple(_unit(document, name, direction))


def _through(document: Document, name: str, points: Floats) -> tuple[Vector, Vector]:
    line = line_through(points)
    if line is None:
        words = (
            "has an axis of no length"
            if len(points) == 2
            else "goes through three points in one line, or twice the same"
        )
        raise _error(document, name, words, "Pick others.")
    return triple(line[0]), triple(line[1])


def _unit(document: Document, name: str, direction: Floats) -> Floats:
    length = float(np.linalg.norm(direction))
    if not np.isfinite(length) or length < _SHORT:
        raise _error(document, name, "has an axis of no length", "Give a direction such as [0, 1, 0].")
    return np.asarray(direction / length)


def _error(document: Document, name: str, words: str, hint: str) -> TemplateError:
    return TemplateError(f"The joint '{name}' {words}", where=document.at(name), hint=hint)
