"""Push and pull, in engines whose drives know one limit both ways (PhysX, and with it Isaac Sim and Isaac Lab; Newton).

    limits = ForceLimits.of(read_mechanism("out/excavator/excavator.usda"), coordinates)
    efforts = limits.now(targets, positions, velocities)     # before every step, as the drives' largest forces

A hydraulic cylinder pushes with its bore's area and pulls with its ring's: a boom's pulls with half of the one force
that a file can tell such engines. numpy and a machine's mechanism are all that it needs. SI.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism


@dataclass(frozen=True, eq=False)
class ForceLimits:
    """Of an engine's coordinates, in its order: the drives' `forces` (n, 2), N or N·m in their negative and positive
    direction, infinite where nothing drives or limits, and their gains, `stiffness` and `damping` (n,)."""

    forces: Floats
    stiffness: Floats
    damping: Floats

    @classmethod
    def of(cls, mechanism: Mechanism, coordinates: Sequence[str]) -> ForceLimits:
        """Of coordinates by their joints' names, or by names that end in them, as Newton's and MuJoCo's do."""
        drives = {j.name: j.drive for j in mechanism.joints if j.drive is not None and not j.cut}
        longest = sorted(drives, key=len, reverse=True)
        found = [drives.get(next((name for name in longest if each.endswith(name)), "")) for each in coordinates]
        unlimited = (np.inf, np.inf)
        return cls(
            np.array([d.forces if d is not None else unlimited for d in found], dtype=np.float64).reshape(-1, 2),
            np.array([d.stiffness if d is not None and d.kind == "position" else 0.0 for d in found]),
            np.array([d.damping if d is not None else 0.0 for d in found]),
        )

    @property
    def ranges(self) -> Floats:
        """(n, 2): least and most, as MuJoCo's `jnt_actfrcrange` has them."""
        return self.forces * (-1.0, 1.0)

    def now(self, targets: ArrayLike, positions: ArrayLike, velocities: ArrayLike) -> Floats:
        """(…, n) the largest force of each drive the way that it pushes now, of any number of machines: `targets` are
        positions (m, rad) of position drives, and velocities of the others. Where the force turns, what is told is a
        step late; drives are far from their limits there."""
        wanted, at, moving = (np.asarray(v, dtype=np.float64) for v in (targets, positions, velocities))
        holds = self.stiffness > 0.0
        force = np.where(holds, self.stiffness * (wanted - at) - self.damping * moving, wanted - moving)
        return np.asarray(np.where(force < 0.0, self.forces[:, 0], self.forces[:, 1]))
