"""Forces and speeds each way, in engines whose drives know one limit for both (PhysX, and with it Isaac Sim and Isaac
Lab; Newton).

    each_way = EachWay.of(read_mechanism("out/excavator/excavator.usda"), coordinates)
    forces = each_way.forces_now(targets, positions, velocities)    # before every step: the drives' largest forces …
    speeds = each_way.speeds_now(targets, positions)                # … and in PhysX their largest speeds

A hydraulic cylinder pushes with its bore's area and pulls with its ring's; as much oil moves it faster the other way. A
file can tell such engines one number of both. numpy and a machine's mechanism are all that it needs. SI.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.support.record import CATCHING_UP


@dataclass(frozen=True, eq=False)
class EachWay:
    """Of an engine's coordinates, in its order: their drives' `forces` (n, 2), N or N·m, and `speeds` (n, 2), m/s or
    rad/s, in their negative and positive direction, infinite where nothing drives or limits, and their gains,
    `stiffness` and `damping` (n,)."""

    forces: Floats
    speeds: Floats
    stiffness: Floats
    damping: Floats

    @classmethod
    def of(cls, mechanism: Mechanism, coordinates: Sequence[str]) -> EachWay:
        """Of coordinates by their joints' names, or by names that end in them, as Newton's and MuJoCo's do."""
        drives = {j.name: None if j.cut else j.drive for j in mechanism.joints}
        longest = sorted(drives, key=len, reverse=True)
        found = [drives.get(next((name for name in longest if each.endswith(name)), "")) for each in coordinates]
        unlimited = (np.inf, np.inf)
        forces = [d.forces if d is not None else unlimited for d in found]
        speeds = [d.speeds if d is not None and d.slowest > 0.0 else unlimited for d in found]
        return cls(
            np.array(forces, dtype=np.float64).reshape(-1, 2),
            np.array(speeds, dtype=np.float64).reshape(-1, 2),
            np.array([d.stiffness if d is not None and d.kind == "position" else 0.0 for d in found]),
            np.array([d.damping if d is not None else 0.0 for d in found]),
        )

    @property
    def ranges(self) -> Floats:
        """(n, 2): least and most force, as MuJoCo's `jnt_actfrcrange` has them."""
        return self.forces * (-1.0, 1.0)

    def forces_now(self, targets: ArrayLike, positions: ArrayLike, velocities: ArrayLike) -> Floats:
        """(…, n) the largest force of each drive the way that it pushes now, of any number of machines: `targets` are
        positions (m, rad) of position drives, and velocities of the others. Where the force turns, what is told is a
        step late; drives are far from their limits there."""
        wanted, at, moving = (np.asarray(v, dtype=np.float64) for v in (targets, positions, velocities))
        force = np.where(self._holds, self.stiffness * (wanted - at) - self.damping * moving, wanted - moving)
        return np.asarray(np.where(force < 0.0, self.forces[:, 0], self.forces[:, 1]))

    def speeds_now(self, targets: ArrayLike, positions: ArrayLike) -> Floats:
        """(…, n) the largest speed of each drive towards its target, m/s or rad/s; of position drives a little more, to
        catch up by, as files have it."""
        wanted, at = (np.asarray(v, dtype=np.float64) for v in (targets, positions))
        backwards = np.where(self._holds, wanted - at, wanted) < 0.0
        spare = np.where(self._holds, CATCHING_UP, 1.0)
        return np.asarray(spare * np.where(backwards, self.speeds[:, 0], self.speeds[:, 1]))

    @property
    def _holds(self) -> np.ndarray:
        """Which are position drives."""
        return self.stiffness > 0.0
