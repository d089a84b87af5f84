"""Closed-chain kinematics: the loops solved, limits and gains that follow from them, and the machine measured.

MuJoCo is imported with the first function that is asked for.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from yellowiron.kinematics.branches import branch_pivots, branch_sine
    from yellowiron.kinematics.calibration import calibrate
    from yellowiron.kinematics.chain import ClosedChain, KinematicsError, State
    from yellowiron.kinematics.completion import complete
    from yellowiron.kinematics.levers import lever_table
    from yellowiron.kinematics.measurement import key_poses, measure

_HOME = {
    "ClosedChain": "chain",
    "KinematicsError": "chain",
    "State": "chain",
    "branch_pivots": "branches",
    "branch_sine": "branches",
    "calibrate": "calibration",
    "complete": "completion",
    "key_poses": "measurement",
    "lever_table": "levers",
    "measure": "measurement",
}

__all__ = [
    "ClosedChain",
    "KinematicsError",
    "State",
    "branch_pivots",
    "branch_sine",
    "calibrate",
    "complete",
    "key_poses",
    "lever_table",
    "measure",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_HOME[name]}"), name)
