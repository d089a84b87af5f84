"""What a stage tells engines besides its bodies and joints: iterations and steps, filtered pairs, collision groups."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from pxr import Sdf, Usd, UsdPhysics

from yellowiron.checks.reading.attributes import number
from yellowiron.checks.values import StageCollider

ITERATIONS = (
    "physxArticulation:solverPositionIterationCount",
    "physxRigidBody:solverPositionIterationCount",
    "physxScene:maxPositionIterationCount",
    "physxScene:minPositionIterationCount",
    "newton:maxSolverIterations",
    "mjc:option:iterations",
)
STEPS = ("physxScene:timeStepsPerSecond", "newton:timeStepsPerSecond", "mjc:option:timestep")
_PAIRS = "physics:filteredPairs"


def read_solver(prims: Iterable[Usd.Prim]) -> Iterator[tuple[str, str, float]]:
    """(prim, attribute, value) of every count of iterations and every step that is authored."""
    for prim in prims:
        scene = prim.IsA(UsdPhysics.Scene)
        if not scene and not prim.HasAPI(UsdPhysics.RigidBodyAPI) and not prim.HasAPI(UsdPhysics.ArticulationRootAPI):
            continue
        for name in (*ITERATIONS, *(STEPS if scene else ())):
            value = number(prim, name)
            if value is not None:
                yield str(prim.GetPath()), name, value


def lost_filters(prims: Iterable[Usd.Prim]) -> Iterator[tuple[str, str]]:
    """(prim, path) wherever filtered pairs name what is not there, or is deactivated."""
    for prim in prims:
        relation = prim.GetRelationship(_PAIRS)
        for path in relation.GetTargets() if relation else ():
            found = prim.GetStage().GetPrimAtPath(path)
            if not (found and found.IsActive()):
                yield str(prim.GetPath()), str(path)


def groundless(stage: Usd.Stage, prims: Iterable[Usd.Prim], colliders: Iterable[StageCollider]) -> Iterator[str]:
    """Groups with colliders of bodies that meet none of the colliders that stand still, where there are some."""
    groups = {p.GetPath(): UsdPhysics.CollisionGroup(p) for p in prims if p.IsA(UsdPhysics.CollisionGroup)}
    if not groups:
        return
    members = {path: g.GetCollidersCollectionAPI().ComputeMembershipQuery() for path, g in groups.items()}
    table = UsdPhysics.CollisionGroup.ComputeCollisionGroupTable(stage)
    found = [(Sdf.Path(c.path), bool(c.body)) for c in colliders]
    still = [path for path, moves in found if not moves]
    for group, own in members.items():
        if not still or not any(moves and own.IsPathIncluded(path) for path, moves in found):
            continue
        if all(_apart(path, group, members, table) for path in still):
            yield str(group)


def _apart(
    collider: Sdf.Path,
    group: Sdf.Path,
    members: dict[Sdf.Path, Usd.CollectionMembershipQuery],
    table: UsdPhysics.CollisionGroupTable,
) -> bool:
    """Whether a collider is in a group that the other does not meet."""
    return any(
        own.IsPathIncluded(collider) and not table.IsCollisionEnabled(group, other) for other, own in members.items()
    )
