"""Who leads the cylinders, in a variant set of the machine: targets as anyone gives them, or levers through the oil.

PhysX and Newton know one largest speed of a joint; oil gives a cylinder two. `position` keeps to the slower way's,
whatever the target. In `hydraulic` it is the faster way's: `yellowiron.hydraulics` moves targets no faster than rated
either way, and no farther ahead than the force that way reaches, so that a file needs to say neither.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from pxr import Sdf

from yellowiron.model.mechanism import Joint, Mechanism
from yellowiron.usd.authoring.stage import declare_variants, over
from yellowiron.usd.layers.drives import speed_limits

NAME = "Actuation"
ACTUATIONS = ("position", "hydraulic")
"""Variants of the set, the first of them the one that a machine file selects."""


def has_actuations(mechanism: Mechanism) -> bool:
    """Whether a drive of the machine goes faster one way than the other."""
    return any(len(set(speed_limits(joint))) > 1 for joint in mechanism.joints)


def limited(layer: Sdf.Layer, root: str, path: str, joint: Joint) -> Iterator[tuple[Sdf.PrimSpec, float]]:
    """Where a layer says a joint's largest speed, and what it says, metres or degrees a second: at the joint's `path`,
    or in each variant of the machine at `root` (which may be a variant itself); nowhere for a joint without."""
    slower, faster = speed_limits(joint)
    if slower == faster:
        if math.isfinite(slower):
            yield over(layer, path), slower
        return
    declare_variants(over(layer, root), NAME, ACTUATIONS)
    for choice, limit in zip(ACTUATIONS, (slower, faster), strict=True):
        yield over(layer, f"{root}{{{NAME}={choice}}}{path.removeprefix(root).lstrip('/')}"), limit
