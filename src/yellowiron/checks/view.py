"""What the rules read: a stage's physics as values, with what its joints hold together."""

from __future__ import annotations

import posixpath
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from yellowiron.checks.islands import Island
from yellowiron.checks.values import StageBody, StageCollider, StageJoint, StageMaterial, Units
from yellowiron.model.geometry import Floats


@dataclass(frozen=True, eq=False)
class View:
    """A stage, read once. `roots` are prims with `PhysicsArticulationRootAPI`; `self_collision` maps those that say so
    to whether their links may collide; `solver` has (prim, attribute, value) of iterations and steps as authored,
    `lost_filters` (prim, path) of filtered pairs with nothing, `groundless` groups of colliders that meet nothing that
    stands still; `islands` are what joints hold together; `record` is what a yellowiron build
    wrote on the machine's prim, `machine` that prim's path and `frame` (4, 4) its place."""

    name: str
    units: Units
    layer_units: tuple[tuple[str, float | None, str | None], ...]
    bodies: Mapping[str, StageBody]
    joints: tuple[StageJoint, ...]
    colliders: tuple[StageCollider, ...]
    materials: tuple[StageMaterial, ...]
    roots: tuple[str, ...]
    self_collision: Mapping[str, bool]
    scenes: tuple[tuple[str, float | None], ...]
    solver: tuple[tuple[str, str, float], ...]
    lost_filters: tuple[tuple[str, str], ...]
    groundless: tuple[str, ...]
    not_numbers: tuple[tuple[str, str], ...]
    broken: tuple[tuple[str, str], ...]
    missing_assets: tuple[str, ...]
    absolute_paths: tuple[tuple[str, str], ...]
    stray_physics: tuple[str, ...]
    islands: tuple[Island, ...]
    machine: str = ""
    frame: Floats = field(default_factory=lambda: np.eye(4))
    record: Mapping[str, Any] = field(default_factory=dict)

    def scope(self, root: str) -> str:
        """The prim of an articulation: its root; of a root that is a link or a joint, the prim with all its links."""
        island = next((i for i in self.islands if root in i.roots), None)
        if island is None or not (root in self.bodies or any(j.path == root for j in island.joints)):
            return root
        common = posixpath.commonpath([b.path for b in island.bodies])
        return root if common == "/" else common

    def under_root(self, path: str) -> str:
        """The articulation (`scope`) at or above a prim, or ""."""
        return next((s for s in map(self.scope, self.roots) if path == s or path.startswith(f"{s}/")), "")
