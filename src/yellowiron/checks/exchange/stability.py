"""Whether a MuJoCo model's drives are stable at its own time step, by MuJoCo's own derivative of a step.

A step takes small deviations (positions, speeds, activations) by a matrix (`mjd_transitionFD`, which differentiates
the whole step, constraints and integrator with it). One that is too long for a spring or a damper has an eigenvalue
beyond −1: what it throws to one side comes back farther from the other. What falls over as real things do grows by an
eigenvalue beyond +1, and counts for nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from yellowiron.model.finding import Finding

MARGIN = 3.0
"""Longest stable step by the file's: what a load, another pose or a user's coarser step may take of it."""
_FACTORS = (1.0, 1.5, 2.0, 2.5, MARGIN)
_BEYOND = -1.001
"""What differentiating by differences leaves of an eigenvalue of −1 is less."""
_LARGEST = 300
"""Degrees of freedom: a matrix of more takes longer than it tells."""
_KEYS = 4
_SHORTER = "Give a shorter timestep, softer drives with less damping, or armature to their joints."


def step_findings(model: Any, name: str) -> Iterator[Finding]:
    """What is to be said of the drives of a `mujoco.MjModel`, in its initial pose and its first keyframes. Contacts
    and limits, which have no derivative where they begin, are off."""
    if not model.nu or model.nv > _LARGEST:
        return
    factor = min(longest_step(model, key) for key in range(-1, min(model.nkey, _KEYS)))
    step = 1e3 * float(model.opt.timestep)
    if factor < 1.0:
        words = f"At its own step of {step:g} ms small deviations grow: its drives are unstable."
        yield Finding(code="MJC001", severity="error", where=name, message=words, hint=_SHORTER)
    elif factor < MARGIN:
        words = f"Its drives are stable up to steps of {factor * step:.3g} ms, {factor:g} times its own."
        yield Finding(code="MJC002", severity="warning", where=name, message=words, hint=_SHORTER)


def longest_step(model: Any, key: int = -1) -> float:
    """The longest stable step in units of the model's own: the last of 1, 1.5, 2, 2.5 and 3 that is stable, 0 where
    none is. `key`: a keyframe's number, or −1 for the initial pose. The model is left as it was."""
    import mujoco

    step, flags = float(model.opt.timestep), int(model.opt.disableflags)
    found = 0.0
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_LIMIT)
    try:
        for factor in _FACTORS:
            model.opt.timestep = factor * step
            if _least(model, key) < _BEYOND:
                break
            found = factor
    finally:
        model.opt.timestep, model.opt.disableflags = step, flags
    return found


def _least(model: Any, key: int) -> float:
    """The least real part of a step's eigenvalues."""
    import mujoco

    data = mujoco.MjData(model)
    if key >= 0:
        mujoco.mj_resetDataKeyframe(model, data, key)
    size = 2 * model.nv + model.na
    matrix = np.zeros((size, size))
    mujoco.mj_forward(model, data)
    mujoco.mjd_transitionFD(model, data, 1e-6, True, matrix, None, None, None)
    return float(np.linalg.eigvals(matrix).real.min()) if np.isfinite(matrix).all() else -np.inf
