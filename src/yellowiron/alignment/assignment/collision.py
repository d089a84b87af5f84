"""Collision meshes: what game engines let a machine bump with, drawn over its parts and none of them itself. What is
called so but stands where nothing else is drawn is a part with a misleading name.

The words are those by which engines' importers know them: Unreal's UCX, UBX, USP and UCP before a mesh's name, Godot's
`-col`, `-colonly`, `-convcol` and `-convcolonly` behind it; the words themselves; and volumes that trigger something.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from yellowiron.alignment.assignment.names import tokens
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Floats

WORDS = frozenset(
    ("ucx", "ubx", "usp", "ucp", "col", "colonly", "convcol", "convcolonly", "collider", "colliders", "collision",
     "collisions", "hitbox", "hitboxes", "trigger", "triggers", "vol", "volume", "bbox", "occluder")
)  # fmt: skip
"""A name that begins or ends with one of these is a collision mesh's."""
_IDLE = frozenset(("mesh", "node", "geometry", "object"))
MOST = 0.75
"""Where more than this share of the parts are named so, the names mean something else."""


WITHIN = 0.8
"""A part that has this share of its points within the box of a collision mesh is one that it stands for (and a mesh
within a part's box stands for a piece of that) …"""
FILLED = 0.6
"""… if all of these together are this share of it in every direction."""
WIDER = 0.05
"""The box is widened by this share of its diagonal: colliders may be a little smaller than what they stand for."""


def colliders(assembly: Assembly) -> frozenset[str]:
    """The ids of the parts that are called collision meshes and stand where other parts do."""
    named = collision_parts(assembly.parts)
    drawn = [assembly.points_of(p) for p in assembly.parts if p.id not in named] if named else []
    return frozenset(p.id for p in assembly.parts if p.id in named and _stands_for(assembly.points_of(p), drawn))


def _stands_for(points: Floats, drawn: Sequence[Floats]) -> bool:
    """Whether a mesh with these points is drawn over parts of about its size, or over a piece of one."""
    if not len(points):
        return True
    more = WIDER * float(np.linalg.norm(np.ptp(points, axis=0)))
    if any(_inside(points, other, more) >= WITHIN for other in drawn):
        return True
    inside = [other for other in drawn if _inside(other, points, more) >= WITHIN]
    return bool(inside) and bool((np.ptp(np.concatenate(inside), axis=0) >= FILLED * np.ptp(points, axis=0)).all())


def _inside(points: Floats, other: Floats, more: float) -> float:
    """The share of some points that are in the box around others, widened by some metres."""
    if not len(points) or not len(other):
        return 0.0
    return float(((points > other.min(axis=0) - more) & (points < other.max(axis=0) + more)).all(axis=1).mean())


def collision_parts(parts: Sequence[Part]) -> frozenset[str]:
    """The ids of the parts whose own names, or those of the assemblies right above them, are collision meshes'."""
    found = {p.id for p in parts if _bumps(p.name) or (p.path and _bumps(p.path[-1]))}
    return frozenset(found) if len(found) <= MOST * len(parts) else frozenset()


def _bumps(name: str) -> bool:
    said = [t for t in tokens(name) if t not in _IDLE]
    return bool(said) and (said[0] in WORDS or said[-1] in WORDS)
