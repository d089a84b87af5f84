"""An exported machine put in poses over its full strokes, held against the kinematics."""

from __future__ import annotations

import importlib.util
import itertools
from pathlib import Path
from types import ModuleType

import numpy as np

from kit.exported import off, read_urdf, urdf_poses
from yellowiron.kinematics import ClosedChain, KinematicsError
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
    joints, chain = read_urdf(urdf), ClosedChain(mechanism)
    limits = {joint.name: joint.limits for joint in joints}
    drawn = urdf_poses(joints, dict.fromkeys(states.names, 0.0))
    reach = {name: limits[name] or (-2.0, 2.0) for name in states.given}
    together = [name for name in reach if limits[name] is not None]
    apart = [name for name in reach if limits[name] is None]
    axes = [np.linspace(*reach[name], steps) for name in together]
    rows = list(itertools.product(*axes)) if steps ** len(axes) <= 100 else _random(axes, 100)
    worst = gap = 0.0
    count = 0
    cuts = [(cut.body0, cut.body1, cut.anchor) for cut in mechanism.joints if cut.cut and cut.type != "distance"]
    for number, row in enumerate(rows):
        strokes = dict(zip(together, map(float, row), strict=True)) | dict.fromkeys(apart, 0.1 * number)
        try:
            state = chain.solve(strokes)
        except KinematicsError:
            continue
        positions = states.positions(strokes)
        poses = urdf_poses(joints, positions)
        worst = max(worst, off(chain, state, poses, drawn))
        for one, other, anchor in cuts:
            ends = [(poses[b] @ np.linalg.inv(drawn[b]) @ np.append(anchor, 1.0))[:3] for b in (one, other)]
            gap = max(gap, float(np.linalg.norm(ends[0] - ends[1])))
        count += 1
    return worst, gap, count


def _random(axes: list[np.ndarray], count: int) -> list[list[float]]:
    """Ends and places between, the first two the lower and upper ends of all."""
    chosen = np.random.default_rng(22)
    between = [[float(chosen.choice(axis)) for axis in axes] for _ in range(count - 2)]
    return [[float(axis[0]) for axis in axes], [float(axis[-1]) for axis in axes], *between]
