"""Joints as robot descriptions declare them."""

from __future__ import annotations

from typing import Any

import numpy as np

from yellowiron.model.assembly import DeclaredJoint
from yellowiron.support.vectors import triple


def declared_joint(
    name: str,
    kind: str,
    bodies: tuple[str, str],
    anchor: Any,
    axis: Any,
    limits: tuple[float | None, float | None] = (None, None),
) -> DeclaredJoint:
    """The joint with its axis at length 1; an axis without a direction is +X, as both formats have it."""
    direction = np.asarray(axis, dtype=np.float64)
    size = float(np.linalg.norm(direction))
    unit = direction / size if size > 0.0 else np.array([1.0, 0.0, 0.0])
    return DeclaredJoint(name, kind, bodies, triple(anchor), triple(unit), *limits)
