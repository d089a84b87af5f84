"""Parallel axes made exactly parallel: in a planar loop a thousandth of a degree between two pins locks the linkage."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from yellowiron.mechanism.joints.axes import machine_sense
from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.mechanism.tolerances import PARALLEL
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats

_ACCURACY = {True: math.radians(0.01), False: math.radians(0.05)}
"""Axes that differ by less than this are made parallel and nothing is said; exact ones, and fitted ones. Up to
`PARALLEL` they are, with a finding."""
_IN_A_PLANE = math.radians(2.0)
"""Up to here axes that are fitted to facets are made parallel, and the pivots of an open arm to its first: coarse
meshes show them no better, and a loop whose pins are half a degree askew jams in every engine."""


def make_parallel(
    frames: Mapping[str, JointFrame], groups: Sequence[frozenset[str]]
) -> tuple[dict[str, JointFrame], list[Finding]]:
    """Frames in which the nearly parallel pivots of each closed group share one direction, and its slides lie across
    it.

    `groups` are the joint names of closed mechanisms (`tree.loop_groups`), whose loops are planar. A moved joint's
    `source` says by how much (`planarity_deg`); anchors stay.
    """
    result = dict(frames)
    findings: list[Finding] = []
    for group in groups:
        names = [name for name in frames if name in group]
        normals = []
        for family in _families({n: frames[n] for n in names if frames[n].joint.type == "revolute"}):
            if len(family) < 2:
                continue
            normal = _mean(family)
            normals.append(normal)
            for frame in family:
                _turn(result, frame, normal, findings)
        for name in names:
            if frames[name].joint.type == "prismatic":
                _flatten(result, frames[name], normals, findings)
    return result, findings


def follow_first(frames: Mapping[str, JointFrame], names: Sequence[str]) -> tuple[dict[str, JointFrame], list[Finding]]:
    """Frames in which the pivots of an open arm, named from the root outwards, are parallel to the first of them as far
    as they nearly are: no loop says that they must be, but an arm is drawn in a plane."""
    result = dict(frames)
    findings: list[Finding] = []
    for name in names[1:]:
        first, own = result[names[0]].axis, result[name].axis
        if float(np.linalg.norm(np.cross(first, own))) < math.sin(_IN_A_PLANE):
            _turn(result, frames[name], first if float(first @ own) > 0.0 else -first, findings)
    return result, findings


def _families(pivots: Mapping[str, JointFrame]) -> list[list[JointFrame]]:
    """Pivots by direction, the best known first."""
    left = sorted(pivots.values(), key=lambda f: -f.weight)
    families = []
    while left:
        near = [f for f in left if np.linalg.norm(np.cross(left[0].axis, f.axis)) < _askew(left[0], f)]
        families.append(near)
        left = [f for f in left if all(f is not n for n in near)]
    return families


def _askew(*frames: JointFrame) -> float:
    """The sine of the angle up to which axes were meant to be parallel."""
    return math.sin(PARALLEL if all(f.exact for f in frames) else _IN_A_PLANE)


def _mean(family: Sequence[JointFrame]) -> Floats:
    weights = np.array([f.weight for f in family])
    weights = weights if weights.sum() > 0.0 else np.ones(len(family))
    axes = np.array([f.axis if f.axis @ family[0].axis > 0.0 else -f.axis for f in family])
    return machine_sense(weights @ axes / weights.sum())


def _flatten(
    result: dict[str, JointFrame], slide: JointFrame, normals: Sequence[Floats], findings: list[Finding]
) -> None:
    for normal in normals:
        lean = float(slide.axis @ normal)
        if abs(lean) < _askew(slide):
            flat = slide.axis - lean * normal
            _turn(result, slide, flat / np.linalg.norm(flat), findings)


def _turn(result: dict[str, JointFrame], frame: JointFrame, axis: Floats, findings: list[Finding]) -> None:
    moved = math.asin(min(1.0, float(np.linalg.norm(np.cross(frame.axis, axis)))))
    source = {**frame.source, "planarity_deg": round(math.degrees(moved), 9)}
    result[frame.joint.name] = replace(frame, axis=axis, source=source)
    if moved > _ACCURACY[frame.exact]:
        words = (
            f"Its axis is {math.degrees(moved):.3f}° off the others that move with it, and was made parallel to them."
        )
        findings.append(Finding("MEC010", "warning", frame.joint.name, words, "Check its pin in the CAD model."))
