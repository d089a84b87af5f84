"""The machine's own USD in a world of its own: for engines that read USD.

The user's file is referenced, never written; base, payload, ground and blocks are opinions of an anonymous layer.
Colliders that can touch nothing (all but those of the bodies that stand on the ground) are switched off: the machine
does not collide with itself, its masses are explicit, and an engine need not cook them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from pxr import Gf, Sdf, Usd, UsdPhysics, Vt
from scipy.spatial import ConvexHull

from yellowiron.model.mechanism import GRAVITY, Joint
from yellowiron.simulation.engine import Setup
from yellowiron.simulation.ground import GROUND_FRICTION, Block
from yellowiron.support.record import RECORD
from yellowiron.usd.authoring.stage import (
    Types,
    add_reference,
    apply_schemas,
    create_layer,
    define,
    over,
    set_attribute,
    set_targets,
)
from yellowiron.usd.layers.drives import speed_limits, speed_names, write_drive
from yellowiron.usd.layers.physics import write_mass
from yellowiron.usd.layers.physx import ITERATIONS, LOOPS_LAST, iterations, loops_last
from yellowiron.usd.layers.servos import DAMPER, SERVO
from yellowiron.usd.planning.plan import COLLIDERS
from yellowiron.usd.read import find_machine, open_stage

MACHINE = "/World/machine"
_GROUND, _SOIL = "/World/ground", "/World/soil"
_UNLIMITED = 1e6
"""Metres or degrees a second: PhysX's own word for a joint without a limit."""


@dataclass(frozen=True, eq=False)
class World:
    """A composed `layer`, its default prim `/World`; paths of the machine's bodies and joints by name, and of the prim
    that is the articulation's `root`."""

    layer: Sdf.Layer
    bodies: Mapping[str, str]
    joints: Mapping[str, str]
    root: str


def compose(setup: Setup) -> World:
    """The setup as one layer: the machine with its base and payload, a physics scene, the ground where it floats.

    `YellowironError` where the file holds no machine.
    """
    stage = open_stage(setup.usd_path)
    machine = find_machine(stage, str(setup.usd_path))
    layer = create_layer("World")
    define(layer, "/World", "Xform")
    spec = define(layer, MACHINE, "Xform")
    add_reference(spec, str(setup.usd_path.resolve()), str(machine.GetPath()))
    spec.variantSelections.update({"Base": setup.base, "Physics": "on"})
    # The world is the machine's own frame, wherever the user's scene has put it.
    set_attribute(spec, "xformOpOrder", Types.TokenArray, [], uniform=True)
    _write_scene(layer, setup)
    composed = Usd.Stage.Open(layer)
    names = dict(_names(composed))
    bodies = {name: path for (kind, name), path in names.items() if kind == "body"}
    joints = {name: path for (kind, name), path in names.items() if kind == "joint"}
    # What the mechanism leaves out of the file (rings of track shoes) is not simulated.
    left_out = False
    for found, kept in ((joints, setup.mechanism.joints), (bodies, setup.mechanism.bodies)):
        for name in sorted(set(found) - {each.name for each in kept}):
            over(layer, found.pop(name)).SetInfo("active", False)
            left_out = True
    for body in setup.heavier:
        write_mass(over(layer, bodies[body.name]), body)
    for joint in setup.driven:
        _write_drive(over(layer, joints[joint.name]), joint)
        for kind in (SERVO, DAMPER):
            if (path := names.get((kind, joint.name))) is not None:
                over(layer, path).SetInfo("active", False)
    standing = setup.standing if setup.base == "floating" else ()
    for name, path in bodies.items():
        if name not in standing:
            over(layer, f"{path}/{COLLIDERS}").SetInfo("active", False)
    rooted = (p for p in composed.Traverse() if p.HasAPI(UsdPhysics.ArticulationRootAPI))
    root = next((str(prim.GetPath()) for prim in rooted), MACHINE)
    if left_out:
        set_attribute(over(layer, root), ITERATIONS, Types.Int, iterations(setup.mechanism))
    return World(layer, bodies, joints, root)


def save(world: World, folder: Path) -> Path:
    """The layer as a file in a folder, for engines that open files themselves."""
    path = folder / "world.usda"
    world.layer.Export(str(path))
    return path


def _names(stage: Usd.Stage) -> Iterator[tuple[tuple[str, str], str]]:
    """(kind, name) and path of everything of ours in the machine."""
    for prim in Usd.PrimRange(stage.GetPrimAtPath(MACHINE)):
        data = prim.GetCustomDataByKey(RECORD)
        if data and "kind" in data and "name" in data:
            yield (str(data["kind"]), str(data["name"])), str(prim.GetPath())


def _write_scene(layer: Sdf.Layer, setup: Setup) -> None:
    scene = define(layer, "/World/physics", "PhysicsScene")
    set_attribute(scene, "physics:gravityDirection", Types.Vector3f, Gf.Vec3f(0.0, 0.0, -1.0))
    set_attribute(scene, "physics:gravityMagnitude", Types.Float, GRAVITY)
    apply_schemas(scene, "PhysxSceneAPI", "NewtonSceneAPI")
    set_attribute(scene, "physxScene:timeStepsPerSecond", Types.UInt, max(1, round(1.0 / setup.timestep)))
    if setup.settings == "file":
        set_attribute(scene, "physxScene:solverType", Types.Token, "TGS", uniform=True)
        if loops_last(setup.mechanism):
            set_attribute(scene, LOOPS_LAST, Types.Bool, True)
    if setup.base == "fixed":
        return
    soil = define(layer, _SOIL, "Material")
    apply_schemas(soil, "PhysicsMaterialAPI")
    for name in ("staticFriction", "dynamicFriction"):
        set_attribute(soil, f"physics:{name}", Types.Float, GROUND_FRICTION)
    plane = define(layer, _GROUND, "Plane")
    set_attribute(plane, "axis", Types.Token, "Z", uniform=True)
    _make_collider(plane)
    for number, block in enumerate(setup.blocks):
        mesh = define(layer, f"/World/block_{number}", "Mesh")
        _write_hull(mesh, block)
        _make_collider(mesh)


def _write_hull(mesh: Sdf.PrimSpec, block: Block) -> None:
    """The block as a closed mesh that is its own convex hull."""
    hull = ConvexHull(block.corners)
    faces = hull.simplices.copy()
    points = block.corners[faces]
    inward = np.einsum(
        "ij,ij->i", np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), hull.equations[:, :3]
    )
    faces[inward < 0.0] = faces[inward < 0.0, ::-1]
    set_attribute(mesh, "points", Types.Point3fArray, Vt.Vec3fArray([Gf.Vec3f(*p) for p in block.corners.tolist()]))
    set_attribute(mesh, "faceVertexCounts", Types.IntArray, Vt.IntArray([3] * len(faces)))
    set_attribute(mesh, "faceVertexIndices", Types.IntArray, Vt.IntArray(faces.ravel().tolist()))
    apply_schemas(mesh, "PhysicsMeshCollisionAPI")
    set_attribute(mesh, "physics:approximation", Types.Token, "convexHull", uniform=True)


def _write_drive(spec: Sdf.PrimSpec, joint: Joint) -> None:
    """Another drive than the file's: gains, force and, in the engines' own words, speed."""
    if joint.drive is None:
        return
    write_drive(spec, joint, joint.drive)
    for name in speed_names(joint):
        set_attribute(spec, name, Types.Float, min(*speed_limits(joint), _UNLIMITED))


def _make_collider(spec: Sdf.PrimSpec) -> None:
    apply_schemas(spec, "PhysicsCollisionAPI", "MaterialBindingAPI")
    set_targets(spec, "material:binding:physics", _SOIL)
