"""The two files on top: the machine with its variants, and a scene to open first."""

from __future__ import annotations

from pxr import Gf, Sdf, Vt

from yellowiron.support.record import CONE, DETAIL, DETAILS, IMPRATIO
from yellowiron.usd.authoring.metadata import describe_machine, set_custom
from yellowiron.usd.authoring.stage import (
    Names,
    Types,
    add_reference,
    apply_schemas,
    connect,
    declare_variants,
    define,
    set_attribute,
    set_display_name,
    set_targets,
)
from yellowiron.usd.layers.actuation import ACTUATIONS, has_actuations
from yellowiron.usd.layers.actuation import NAME as ACTUATION
from yellowiron.usd.layers.articulation import BASES
from yellowiron.usd.layers.brakes import BRAKES, has_brakes
from yellowiron.usd.layers.physx import LOOPS_LAST, loops_last
from yellowiron.usd.layers.sensors import FILE as SENSOR_FILE
from yellowiron.usd.planning.plan import Plan

PAYLOAD_FOLDER = "payloads"
ENGINE_LAYERS = ("physx.usda", "mujoco.usda", "physics.usda")
"""The layers of Physics=on, strongest first: an engine's opinion is stronger than the neutral one."""

STEPS_PER_SECOND = 120
"""PhysX's step in the scene: every pin of a loader stays within 0.15 mm at this rate."""

GROUND_SIZE = 100.0
_GROUND_COLOR = Gf.Vec3f(0.30, 0.26, 0.21)
_SURFACE_LIFT = -0.001


def write_machine_layer(layer: Sdf.Layer, plan: Plan) -> None:
    """The machine's own file: default prim, metadata, payload and variant sets; no ground, light or scene.

    `Base`, `Actuation` and `Brakes` are empty here: the layers of `Physics` have the same sets, and follow the
    selection made here.
    """
    spec = define(layer, plan.root, "Xform")
    set_display_name(spec, plan.mechanism.name)
    spec.SetInfo("kind", "component")
    spec.SetInfo("assetInfo", {"name": plan.root_name})
    set_custom(spec, describe_machine(plan.mechanism))
    _add_payload(spec, *([SENSOR_FILE] if plan.mechanism.sensors else []), "base.usda")
    declare_variants(spec, "Base", BASES)
    declare_variants(spec, "Physics", ("on", "off"))
    spec.variantSelections.update({"Base": BASES[0], "Physics": "on"})
    declare_variants(spec, DETAIL, DETAILS)
    spec.variantSelections.update({DETAIL: DETAILS[0]})
    if has_actuations(plan.mechanism):
        declare_variants(spec, ACTUATION, ACTUATIONS)
        spec.variantSelections.update({ACTUATION: ACTUATIONS[0]})
    if has_brakes(plan.mechanism):
        declare_variants(spec, "Brakes", BRAKES)
        spec.variantSelections.update({"Brakes": BRAKES[0]})
    _add_payload(spec.variantSets["Physics"].variants["on"].primSpec, *ENGINE_LAYERS)


def _add_payload(spec: Sdf.PrimSpec, *files: str) -> None:
    spec.payloadList.prependedItems = [Sdf.Payload(f"./{PAYLOAD_FOLDER}/{file}") for file in files]


def write_scene_layer(layer: Sdf.Layer, plan: Plan, machine_file: str) -> None:
    """The machine on a ground plane, with light and a physics scene."""
    define(layer, "/World", "Xform").SetInfo("kind", "assembly")
    names = Names("physicsScene", "ground", "light", "sun")
    add_reference(define(layer, f"/World/{names.give(plan.root_name)}"), f"./{machine_file}")
    scene = define(layer, "/World/physicsScene", "PhysicsScene")
    apply_schemas(scene, "PhysxSceneAPI", "NewtonSceneAPI", "MjcSceneAPI")
    # Newton reads MuJoCo's settings off the scene alone. Not the integrator: drives are stable to steps of 3 ms with
    # Euler's, and nobody knows here how long a user's are.
    set_attribute(scene, "mjc:option:cone", Types.Token, CONE, uniform=True)
    set_attribute(scene, "mjc:option:impratio", Types.Double, IMPRATIO, uniform=True)
    set_attribute(scene, "physxScene:solverType", Types.Token, "TGS", uniform=True)
    set_attribute(scene, "physxScene:timeStepsPerSecond", Types.UInt, STEPS_PER_SECOND)
    if loops_last(plan.mechanism):
        set_attribute(scene, LOOPS_LAST, Types.Bool, True)
    _write_ground(layer, "/World/ground")
    dome = define(layer, "/World/light", "DomeLight")
    set_attribute(dome, "inputs:intensity", Types.Float, 300.0)
    sun = define(layer, "/World/sun", "DistantLight")
    set_attribute(sun, "inputs:intensity", Types.Float, 2500.0)
    set_attribute(sun, "inputs:angle", Types.Float, 1.0)
    set_attribute(sun, "xformOp:rotateXYZ", Types.Float3, Gf.Vec3f(35.0, -30.0, 0.0))
    set_attribute(sun, "xformOpOrder", Types.TokenArray, Vt.TokenArray(["xformOp:rotateXYZ"]), uniform=True)


def _write_ground(layer: Sdf.Layer, path: str) -> None:
    """An endless plane to stand on, and a square to see. The square lies a millimetre lower, so nothing flickers."""
    define(layer, path, "Xform")
    plane = define(layer, f"{path}/plane", "Plane")
    apply_schemas(plane, "PhysicsCollisionAPI", "MaterialBindingAPI")
    set_attribute(plane, "axis", Types.Token, "Z", uniform=True)
    set_attribute(plane, "purpose", Types.Token, "guide", uniform=True)
    set_targets(plane, "material:binding:physics", f"{path}/soil")
    half = 0.5 * GROUND_SIZE
    corners = [Gf.Vec3f(x, y, _SURFACE_LIFT) for x, y in ((-half, -half), (half, -half), (half, half), (-half, half))]
    surface = define(layer, f"{path}/surface", "Mesh")
    apply_schemas(surface, "MaterialBindingAPI")
    set_attribute(surface, "points", Types.Point3fArray, Vt.Vec3fArray(corners))
    set_attribute(surface, "faceVertexCounts", Types.IntArray, Vt.IntArray([4]))
    set_attribute(surface, "faceVertexIndices", Types.IntArray, Vt.IntArray([0, 1, 2, 3]))
    set_attribute(surface, "subdivisionScheme", Types.Token, "none", uniform=True)
    set_attribute(surface, "extent", Types.Float3Array, Vt.Vec3fArray([corners[0], corners[2]]))
    normals = Vt.Vec3fArray([Gf.Vec3f(0.0, 0.0, 1.0)] * 4)
    set_attribute(surface, "normals", Types.Normal3fArray, normals, interpolation="vertex")
    set_targets(surface, "material:binding", f"{path}/soil")
    soil = define(layer, f"{path}/soil", "Material")
    apply_schemas(soil, "PhysicsMaterialAPI")
    for name, value in (("dynamicFriction", 0.7), ("staticFriction", 0.8)):
        set_attribute(soil, f"physics:{name}", Types.Float, value)
    connect(soil, "outputs:surface", Types.Token, f"{path}/soil/surface.outputs:surface")
    shader = define(layer, f"{path}/soil/surface", "Shader")
    set_attribute(shader, "info:id", Types.Token, "UsdPreviewSurface", uniform=True)
    set_attribute(shader, "inputs:diffuseColor", Types.Color3f, _GROUND_COLOR)
    set_attribute(shader, "inputs:roughness", Types.Float, 0.9)
    set_attribute(shader, "outputs:surface", Types.Token, None)
