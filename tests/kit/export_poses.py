"""An exported machine put in poses over its full strokes, held against the kinematics."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import numpy as np

from kit.exported import off, read_urdf, urdf_poses
from yellowiron.kinematics import stroke_poses
from yellowiron.model.mechanism import Mechanism

BAR = 1e-6
"""Metres: the bar of the exports' poses, and of their cut pins."""


def helper(script: Path) -> ModuleType:
    """The script beside an export, as somebody without the package loads it."""
    spec = importlib.util.spec_from_file_location("exported_joint_states", script)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def worst_of_strokes(urdf: Path, mechanism: Mechanism, *, steps: int = 3) -> tuple[float, float, int]:
    """The largest error of a body's pose and of a cut pin, metres, over a lattice of all strokes, end to end; and of
    how many poses. Strokes that the kinematics cannot take together are left out."""
    folder = urdf.parent.parent / "scripts"
    states = helper(folder / "joint_states.py").JointStates(folder / "joints.json")
    joints = read_urdf(urdf)
    drawn = urdf_poses(joints, dict.fromkeys(states.names, 0.0))
    worst = gap = 0.0
    count = 0
    cuts = [(cut.body0, cut.body1, cut.anchor) for cut in mechanism.joints if cut.cut and cut.type != "distance"]
    for strokes, moved in stroke_poses(mechanism, steps=steps):
        poses = urdf_poses(joints, states.positions({name: strokes.get(name, 0.0) for name in states.given}))
        worst = max(worst, off(moved, poses, drawn))
        for one, other, anchor in cuts:
            ends = [(poses[b] @ np.linalg.inv(drawn[b]) @ np.append(anchor, 1.0))[:3] for b in (one, other)]
            gap = max(gap, float(np.linalg.norm(ends[0] - ends[1])))
        count += 1
    return worst, gap, count
