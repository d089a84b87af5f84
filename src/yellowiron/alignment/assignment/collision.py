"""Collision meshes: what game engines let a machine bump with, drawn over its parts and none of them itself.

The words are those by which engines' importers know them: Unreal's UCX, UBX, USP and UCP before a mesh's name, Godot's
`-col`, `-colonly`, `-convcol` and `-convcolonly` behind it; the words themselves; and volumes that trigger something.
"""

from __future__ import annotations

from collections.abc import Sequence

from yellowiron.alignment.assignment.names import tokens
from yellowiron.model.assembly import Part

WORDS = frozenset(
    ("ucx", "ubx", "usp", "ucp", "col", "colonly", "convcol", "convcolonly", "collider", "colliders", "collision",
     "collisions", "hitbox", "hitboxes", "trigger", "triggers", "vol", "volume", "bbox", "occluder")
)  # fmt: skip
"""A name that begins or ends with one of these is a collision mesh's."""
_IDLE = frozenset(("mesh", "node", "geometry", "object"))
MOST = 0.75
"""Where more than this share of the parts are named so, the names mean something else."""


def collision_parts(parts: Sequence[Part]) -> frozenset[str]:
    """The ids of the parts whose own names, or those of the assemblies right above them, are collision meshes'."""
    found = {p.id for p in parts if _bumps(p.name) or (p.path and _bumps(p.path[-1]))}
    return frozenset(found) if len(found) <= MOST * len(parts) else frozenset()


def _bumps(name: str) -> bool:
    said = [t for t in tokens(name) if t not in _IDLE]
    return bool(said) and (said[0] in WORDS or said[-1] in WORDS)
