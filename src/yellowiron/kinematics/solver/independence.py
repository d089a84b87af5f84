"""Which coordinates of a mechanism are given, which follow, and which closure equations determine those.

`Mechanism` → names of joints; the closure Jacobian of the drawn pose → the rows and columns of a square system.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from yellowiron.kinematics.tolerances import RANK
from yellowiron.model.errors import MechanismError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism


def suspects(mechanism: Mechanism, among: Sequence[str] | None = None) -> str:
    """A hint at the joints that a user's document added or changed, the likely cause where loops lock; "" without any.
    `among`: joints that alone come into question."""
    stated = [
        f"'{joint.name}' of {joint.source['document']}"
        for joint in mechanism.joints
        if "document" in joint.source and (among is None or joint.name in among)
    ]
    return f"The likely cause is the joint {'; '.join(stated)}: remove or correct it." if stated else ""


def locked_error(mechanism: Mechanism, cuts: Sequence[str]) -> MechanismError:
    """The error for cuts whose bodies cannot move against each other, with the joints that hold them."""
    types = {joint.name: joint.type for joint in mechanism.joints}
    rigid = {
        loop.cut: [name for name in loop.joints if name != loop.cut]
        for loop in mechanism.loops
        if all(types[name] == "fixed" for name in loop.joints if name != loop.cut)
    }
    holding = list(dict.fromkeys(name for names in rigid.values() for name in names)) or list(cuts)
    hint = suspects(mechanism, holding)
    if not hint:
        hint = "Their loop has no moving joint: remove one of its joints, or add the missing pivots."
    return MechanismError(
        "a joint joins two bodies that cannot move against each other",
        where=", ".join(rigid or cuts),
        hint=f"{hint} They are held by {', '.join(holding)}." if rigid else hint,
    )


def square_system(
    jacobian: Floats, loose: np.ndarray, cuts: Collection[Sequence[int]], coupled: int = 0
) -> tuple[np.ndarray, np.ndarray] | None:
    """The rows of the closure Jacobian (3 a connection point, then one each of the `coupled` joints; all tree
    coordinates) that are independent, and as many of its `loose` columns, the coordinates they determine; None at a
    dead point of a loop.

    `cuts` gives the connection points of each cut: first ones come before further ones, across the axis before along.
    """
    jacobian = jacobian[:, loose]
    first = [point for points in cuts for point in points[:1]]
    further = [point for points in cuts for point in points[1:]]
    tiers = [np.array([3 * p + row for p in points for row in (1, 2, 0)], dtype=int) for points in (first, further)]
    tiers.insert(0, np.arange(len(jacobian) - coupled, len(jacobian)))
    rows = _independent_rows(jacobian, tiers)
    chosen = _independent_rows(jacobian[rows].T, [np.arange(len(loose))])
    if len(chosen) < len(rows):  # a drawn pose next to a dead point
        rows = rows[_independent_rows(jacobian[np.ix_(rows, chosen)], [np.arange(len(rows))])]
    return (rows, loose[chosen]) if len(chosen) == len(rows) else None


def _independent_rows(matrix: Floats, tiers: Sequence[np.ndarray]) -> np.ndarray:
    """Indices of independent rows, earlier tiers first, the largest remaining row first (pivoted Gram-Schmidt)."""
    scale = max(1.0, float(np.linalg.norm(matrix, axis=1).max(initial=0.0)))
    rest = matrix.copy()
    picked: list[int] = []
    for tier in tiers:
        while len(tier):
            norms = np.linalg.norm(rest[tier], axis=1)
            best = int(np.argmax(norms))
            if norms[best] <= RANK * scale:
                break
            row = int(tier[best])
            picked.append(row)
            unit = rest[row] / norms[best]
            rest -= np.outer(rest @ unit, unit)
            rest[row] = 0.0
    return np.array(sorted(picked), dtype=int)
