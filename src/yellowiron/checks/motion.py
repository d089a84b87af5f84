"""Which joint velocities the loops allow in the drawn pose: the null space of the loop closure equations.

Around a loop the joints' twists sum to nothing: Σ ±S q̇ = 0, six equations a loop, S the screw of a freedom (Davies
1981; Featherstone, Rigid Body Dynamics Algorithms, ch. 8). Lengths are in units of the island's size, so that turning
and sliding weigh alike.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.checks.loops import StageLoop
from yellowiron.checks.tolerances import CLOSED, STILL
from yellowiron.checks.values import StageJoint, direction
from yellowiron.model.geometry import Floats


@dataclass(frozen=True, eq=False)
class LoopMotion:
    """The motions of an island's loops: `space` (n, m), one orthonormal column a motion, one row a freedom; `rows` says
    which rows a joint's freedoms are. A slide's rows are in units of `size`."""

    rows: dict[str, tuple[int, ...]]
    space: Floats
    size: float

    @staticmethod
    def of(loops: Sequence[StageLoop], *, center: Floats, size: float) -> LoopMotion | None:
        """From the loops of an island; None where a frame is not a number."""
        scale = size if size > 0.0 else 1.0
        joints = {j.path: j for loop in loops for j in loop.joints}
        rows: dict[str, tuple[int, ...]] = {}
        count = 0
        for path, joint in joints.items():
            rows[path] = tuple(range(count, count + len(joint.freedoms)))
            count += len(joint.freedoms)
        closure = np.zeros((6 * len(loops), count))
        for index, loop in enumerate(loops):
            for step in loop.steps:
                block = screws(step.joint, center=center, scale=scale)
                closure[6 * index : 6 * index + 6, list(rows[step.joint.path])] += step.sign * block
        if not np.isfinite(closure).all():
            return None
        return LoopMotion(rows=rows, space=null_space(closure), size=scale)

    def moves(self, joint: StageJoint) -> bool:
        """Whether a joint of a loop can move at all."""
        return bool(np.abs(self.space[list(self.rows[joint.path])]).max(initial=0.0) > STILL)

    def part(self, joints: Iterable[StageJoint]) -> Floats:
        """The rows of some joints, (k, m)."""
        return self.space[[r for j in joints if j.path in self.rows for r in self.rows[j.path]]]

    def holding(self, joints: Iterable[StageJoint]) -> LoopMotion:
        """What is left while some joints hold still."""
        return LoopMotion(rows=self.rows, space=self.space @ null_space(self.part(joints)), size=self.size)

    def rank(self, joints: Iterable[StageJoint]) -> int:
        """In how many independent ways some joints move."""
        part = self.part(joints)
        return int(np.linalg.matrix_rank(part, tol=CLOSED)) if part.size else 0


def screws(joint: StageJoint, *, center: Floats, scale: float) -> Floats:
    """The unit twists (6, k; angular, then linear at `center`) that a joint's freedoms give its second body."""
    columns = []
    arm = (joint.sides[0].position - center) / scale
    for freedom in joint.freedoms:
        axis = direction(joint.sides[0].rotation, freedom)
        turning = freedom.startswith("rot")
        columns.append(np.concatenate([axis, np.cross(arm, axis)] if turning else [np.zeros(3), axis]))
    return np.array(columns).T if columns else np.zeros((6, 0))


def null_space(matrix: Floats) -> Floats:
    """Orthonormal columns (n, m) that a matrix (k, n) sends to nothing."""
    if matrix.shape[0] == 0 or matrix.shape[1] == 0:
        return np.eye(matrix.shape[1])
    _, values, rows = np.linalg.svd(matrix, full_matrices=True)
    return np.asarray(rows[int((values > CLOSED).sum()) :].T, dtype=np.float64)
