"""A variant of a machine: a small layer over its file, of opinions on prims that are there and of nothing else.

What differs from the base is written as `write` would have written it, in attributes and in `customData`, so that
`read_mechanism` gives the variant back and checks find nothing edited. Physics is in the variant `Physics` = `on`.
Bodies stay where they are drawn; meshes are the base's.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Drive, Joint, Mechanism
from yellowiron.model.sensor import Sensor
from yellowiron.support.record import RECORD
from yellowiron.usd.authoring.metadata import set_custom, to_json
from yellowiron.usd.authoring.rotation import principal_axes
from yellowiron.usd.authoring.stage import (
    Types,
    create_layer,
    declare_variants,
    identifier,
    over,
    set_attribute,
    set_placement,
)
from yellowiron.usd.layers.actuation import limited
from yellowiron.usd.layers.drives import INSTANCES, per_usd_unit, physx_names, speed_limits, speed_names, to_usd_unit
from yellowiron.usd.layers.joints import usd_type
from yellowiron.usd.layers.mujoco import armature
from yellowiron.usd.layers.sensors import sensor_quaternion
from yellowiron.usd.layers.servos import DAMPER, SERVO, write_gains
from yellowiron.usd.planning.pin_links import KIND as PIN_LINK
from yellowiron.usd.planning.plan import COLLIDERS, HULL, HULL_SCALE, MATERIALS, VISUALS
from yellowiron.usd.read import find_machine, open_stage
from yellowiron.usd.tools import tool_set

_TYRE = 0.98
"""A part of a wheel that reaches out to this share of its radius is its tyre."""
_ROUND_OFF = 1e-9
_SOURCE = "a variant's"


@dataclass(frozen=True)
class WheelPart:
    """A prim of a wheel that reaches its rim: with the `radius` of a round collider, else a matrix (4, 4), rows as USD
    has them, that takes its mesh to the wheel."""

    path: str
    radius: float = 0.0
    matrix: tuple[tuple[float, ...], ...] = ()


@dataclass(frozen=True)
class MachinePrims:
    """Where what a variant changes stands in a machine's file: paths by name. `links`: a cut pin's links of its own,
    as (side, body, link, weld). `servos`: joint → kind and path of the actuators that Newton drives it by. `order`:
    what the machine's own prim has for xformOps."""

    root: str
    bodies: Mapping[str, str]
    joints: Mapping[str, str]
    materials: Mapping[str, str]
    sensors: Mapping[str, str]
    cameras: frozenset[str]
    wheels: Mapping[str, tuple[WheelPart, ...]]
    links: Mapping[str, tuple[tuple[int, str, str, str], ...]] = field(default_factory=dict)
    servos: Mapping[str, tuple[tuple[str, str], ...]] = field(default_factory=dict)


def machine_prims(path: str | Path, wheels: Mapping[str, tuple[Floats, float]]) -> MachinePrims:
    """The prims of a machine's file. `wheels`: body → its axis (3,) and radius, metres. `YellowironError` as in
    `read_mechanism`."""
    stage = open_stage(path)
    prim = find_machine(stage, str(path))
    named: dict[str, dict[str, str]] = {"body": {}, "joint": {}, "sensor": {}}
    cameras, links, welds = set(), [], {}
    servos: dict[str, list[tuple[str, str]]] = {}
    for each in Usd.PrimRange(prim):
        record = each.GetCustomDataByKey(RECORD) or {}
        kind = record.get("kind")
        if kind in named:
            named[kind][str(record["name"])] = str(each.GetPath())
        if kind == "sensor" and each.IsA(UsdGeom.Camera):
            cameras.add(str(record["name"]))
        if kind in (SERVO, DAMPER):
            servos.setdefault(str(record["name"]), []).append((str(kind), str(each.GetPath())))
        if kind == PIN_LINK:
            links.append((str(each.GetPath()), str(record["name"])))
        if each.GetTypeName() == "PhysicsFixedJoint" and not record:
            targets = each.GetRelationship("physics:body1").GetTargets()
            welds.update({str(target): str(each.GetPath()) for target in targets})
    ends: dict[str, list[tuple[int, str, str, str]]] = {}
    for name, place in named["joint"].items():
        joint = stage.GetPrimAtPath(place)
        for side in (0, 1):
            targets = [str(t) for t in joint.GetRelationship(f"physics:body{side}").GetTargets()]
            ends.setdefault(name, []).extend(
                (side, body, link, welds[link]) for link, body in links if link in targets and link in welds
            )
    scope = prim.GetChild(MATERIALS)
    materials = {
        str(each.GetMetadata("displayName") or each.GetName()): str(each.GetPath())
        for each in (scope.GetChildren() if scope else ())
    }
    parts = {
        name: tuple(_wheel_parts(stage.GetPrimAtPath(named["body"][name]), axis, radius))
        for name, (axis, radius) in wheels.items()
    }
    return MachinePrims(
        str(prim.GetPath()), named["body"], named["joint"], materials, named["sensor"], frozenset(cameras), parts,
        {name: tuple(own) for name, own in ends.items() if own},
        {name: tuple(own) for name, own in servos.items()},
    )  # fmt: skip


def _wheel_parts(body: Usd.Prim, axis: Floats, radius: float) -> Any:
    """The visuals and colliders of a wheel that reach its rim."""
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["default", "render", "guide", "proxy"])
    for scope in (VISUALS, COLLIDERS):
        holder = body.GetChild(scope)
        for each in holder.GetChildren() if holder else ():
            box = cache.ComputeRelativeBound(each, body).ComputeAlignedRange()
            corners = np.array([box.GetMin(), box.GetMax()], dtype=np.float64)
            reach = float(np.delete(np.abs(corners), int(np.argmax(np.abs(axis))), axis=1).max())
            if box.IsEmpty() or reach < _TYRE * radius:
                continue
            shape = each.GetAttribute("radius")
            if shape and each.GetTypeName() in ("Cylinder", "Sphere", "Capsule"):
                yield WheelPart(str(each.GetPath()), float(shape.Get()))
            else:
                matrix = UsdGeom.Xformable(each).GetLocalTransformation()
                yield WheelPart(str(each.GetPath()), 0.0, tuple(tuple(row) for row in matrix))


def variant_layer(
    base: Mechanism,
    variant: Mechanism,
    prims: MachinePrims,
    *,
    sublayer: str,
    record: Mapping[str, Any],
    radii: Mapping[str, float],
    tools: Mapping[str, str],
) -> Sdf.Layer:
    """A layer, in memory, that makes a variant of a base machine's file, which `sublayer` names from where the layer
    will be. `record` stays on the machine's prim, as `variant`; `radii`: wheel → factor of its radius; `tools`: body →
    which of those that `add_tools` has put beside the base. Binary: of a loader in which all varies it has 15 kB, as
    text 40."""
    layer = create_layer(prims.root[1:], binary=True)
    with Sdf.ChangeBlock():
        layer.subLayerPaths.append(sublayer)
        root = over(layer, prims.root)
        declare_variants(root, "Physics", ("on", "off"))
        root.variantSelections.update({tool_set(body): identifier(word) for body, word in tools.items()})
        documents: dict[str, Any] = {"variant": to_json(dict(record))}
        for name in ("cylinders", "materials"):
            if getattr(variant, name) != getattr(base, name):
                documents[name] = to_json(_bare(getattr(variant, name)))
        noisy = [(a, b) for a, b in zip(base.sensors, variant.sensors, strict=True) if a.parameters != b.parameters]
        if noisy:
            documents["sensors"] = to_json(variant.sensors)
        set_custom(root, documents)
        for before, after in zip(base.bodies, variant.bodies, strict=True):
            _write_body(layer, prims, before, after)
        for old, new in zip(base.joints, variant.joints, strict=True):
            _write_joint(layer, old, new, base, variant, prims)
        for name, path in prims.materials.items():
            if name in variant.materials and variant.materials[name] != base.materials[name]:
                spec, material = over(layer, _on(prims, path)), variant.materials[name]
                set_attribute(spec, "physics:dynamicFriction", Types.Float, material.dynamic_friction)
                set_attribute(spec, "physics:staticFriction", Types.Float, material.static_friction)
        for one, other in zip(base.sensors, variant.sensors, strict=True):
            _write_sensor(layer, one, other, variant, prims)
        for name, factor in radii.items():
            _write_wheel(layer, name, factor, variant, prims)
        if radii:
            _raise(layer, base, prims, radii)
    return layer


def _on(prims: MachinePrims, path: str) -> str:
    """A prim's path where physics is switched on: with physics off, nothing of it is there."""
    return f"{prims.root}{{Physics=on}}{path[len(prims.root) + 1 :]}"


def _bare(value: Any) -> Any:
    """Cylinders without where their numbers come from, which the base says; anything else as it is."""
    return tuple(replace(each, sources={}) for each in value) if isinstance(value, tuple) else value


def _write_body(layer: Sdf.Layer, prims: MachinePrims, old: Body, new: Body) -> None:
    """Mass properties that are others than the base's."""
    record: dict[str, Any] = {}
    path = _on(prims, prims.bodies[new.name])
    if new.mass != old.mass:
        record["mass"] = float(new.mass)
        set_attribute(over(layer, path), "physics:mass", Types.Float, float(new.mass))
    if new.center_of_mass != old.center_of_mass:
        record["centerOfMass"] = Gf.Vec3d(*map(float, new.center_of_mass))
        center = np.asarray(new.center_of_mass) - np.asarray(new.origin)
        set_attribute(over(layer, path), "physics:centerOfMass", Types.Point3f, Gf.Vec3f(*center.tolist()))
    if not (new.inertia is old.inertia or np.array_equal(new.inertia, old.inertia)):
        record["inertia"] = Gf.Matrix3d(np.asarray(new.inertia, dtype=np.float64).tolist())
        _write_inertia(layer, path, old, new)
    if record:
        set_custom(over(layer, prims.bodies[new.name]), record)


def _write_inertia(layer: Sdf.Layer, path: str, old: Body, new: Body) -> None:
    # Of a body that is heavier all over, the principal axes are the base's.
    factor = float(np.trace(new.inertia)) / (float(np.trace(old.inertia)) or 1.0)
    alike = bool(np.allclose(new.inertia, factor * old.inertia, rtol=1e-12, atol=0.0))
    moments, axes = principal_axes(np.asarray(old.inertia if alike else new.inertia, dtype=np.float64))
    scaled = [factor * moment if alike else moment for moment in moments]
    set_attribute(over(layer, path), "physics:diagonalInertia", Types.Float3, Gf.Vec3f(*scaled))
    if not alike:
        set_attribute(over(layer, path), "physics:principalAxes", Types.Quatf, Gf.Quatf(Gf.Quatd(*axes)))


def _write_joint(
    layer: Sdf.Layer, old: Joint, new: Joint, base: Mechanism, variant: Mechanism, prims: MachinePrims
) -> None:
    values: dict[str, Any] = {}
    path = prims.joints[new.name]
    if new.anchor != old.anchor:
        values["anchor"] = Gf.Vec3d(*map(float, new.anchor))
        _write_anchor(layer, new, variant, prims)
    for end, name in (("lower", "lowerLimit"), ("upper", "upperLimit")):
        value = getattr(new, end)
        if value is None or _near(value, getattr(old, end)):
            continue
        values[end] = float(value)
        if usd_type(new) in ("revolute", "prismatic"):  # a cut pivot is written as a ball, which has no such limits
            limit = float(value) * to_usd_unit(new.type)
            set_attribute(over(layer, _on(prims, path)), f"physics:{name}", Types.Float, limit)
    if new.drive is not None and old.drive is not None and not new.cut and not _same_drive(old.drive, new.drive):
        # Where a drive's numbers come from, the base says.
        values["drive"] = to_json(replace(new.drive, source=_SOURCE))
        inertias = armature(old, base), armature(new, variant)
        _write_drive(over(layer, _on(prims, path)), new, old, new.drive, inertias)
        if not all(map(_near, speed_limits(old), speed_limits(new))):
            for spec, limit in limited(layer, _on(prims, prims.root), _on(prims, path), new):
                for name in speed_names(new):
                    set_attribute(spec, name, Types.Float, float(limit))
        for kind, place in prims.servos.get(new.name, ()):
            if new.drive.rated:
                write_gains(over(layer, _on(prims, place)), kind, new.drive)
            else:
                over(layer, _on(prims, place)).SetInfo("active", False)
    if values:
        set_custom(over(layer, path), values)


def _same_drive(one: Drive, other: Drive) -> bool:
    pairs = zip(
        (one.stiffness, one.damping, *one.forces, *one.speeds, one.armature, one.brake),
        (other.stiffness, other.damping, *other.forces, *other.speeds, other.armature, other.brake), strict=True,
    )  # fmt: skip
    return all(_near(a, b) for a, b in pairs)


def _near(one: float, other: float | None) -> bool:
    """Whether a number is another one but for round-off."""
    return other is not None and (one == other or abs(one - other) <= _ROUND_OFF * max(1.0, abs(other)))


def _write_anchor(layer: Sdf.Layer, joint: Joint, variant: Mechanism, prims: MachinePrims) -> None:
    ends = {side: (body, link, weld) for side, body, link, weld in prims.links.get(joint.name, ())}
    for side, name in enumerate((joint.body0, joint.body1)):
        offset = np.asarray(joint.anchor) - np.asarray(variant.body(name).origin)
        if side in ends:
            _, link, weld = ends[side]
            set_placement(over(layer, link), joint.anchor)
            set_attribute(over(layer, _on(prims, weld)), "physics:localPos0", Types.Point3f, Gf.Vec3f(*offset.tolist()))
        else:
            place = Gf.Vec3f(*offset.tolist())
            spec = over(layer, _on(prims, prims.joints[joint.name]))
            set_attribute(spec, f"physics:localPos{side}", Types.Point3f, place)


def _write_drive(spec: Sdf.PrimSpec, joint: Joint, old: Joint, drive: Drive, inertias: tuple[float, float]) -> None:
    """Gains, force and armature, those that are others, in all the words that the base has for them.
    `inertias`: what Newton has for the armature, before and after."""
    instance, factor = INSTANCES[joint.type], per_usd_unit(joint.type)
    before = old.drive
    assert before is not None
    gains = f"drive:{instance}:physics"
    said = [
        ((f"{gains}:damping",), before.damping * factor, drive.damping * factor),
        ((f"{gains}:stiffness",), before.stiffness * factor, drive.stiffness * factor),
        ((f"{gains}:maxForce",), before.strongest, drive.strongest),
        (physx_names(joint, "armature"), before.armature, drive.armature),
        (("newton:armature",), *inertias),
    ]
    for names, one, other in said:
        if not _near(one, other) and math.isfinite(other):
            for name in names:
                set_attribute(spec, name, Types.Float, float(other))


def _write_sensor(layer: Sdf.Layer, one: Sensor, other: Sensor, variant: Mechanism, prims: MachinePrims) -> None:
    if not other.body or other.name not in prims.sensors:
        return
    if (one.position, one.x_axis, one.z_axis) != (other.position, other.x_axis, other.z_axis):
        spec = over(layer, prims.sensors[other.name])
        origin = np.asarray(variant.body(other.body).origin)
        set_placement(spec, np.asarray(other.position) - origin, sensor_quaternion(other))


def _write_wheel(layer: Sdf.Layer, name: str, factor: float, variant: Mechanism, prims: MachinePrims) -> None:
    joint = next(j for j in variant.joints if j.body1 == name and not j.cut)
    axis = np.asarray(joint.axis)
    scale = np.eye(3) * factor + (1.0 - factor) * np.outer(axis, axis)
    for part in prims.wheels[name]:
        spec = over(layer, part.path)
        if part.radius:
            set_attribute(spec, "radius", Types.Double, part.radius * factor)
        else:
            whole = np.eye(4)
            whole[:3, :3] = scale
            matrix = np.array(part.matrix) @ whole
            set_attribute(spec, "xformOp:transform", Types.Matrix4d, Gf.Matrix4d(matrix.tolist()))
            order = Vt.TokenArray(["xformOp:transform"])
            set_attribute(spec, "xformOpOrder", Types.TokenArray, order, uniform=True)
    factors = Gf.Vec3f(*np.diag(scale).tolist())
    set_attribute(over(layer, f"{prims.bodies[name]}/{HULL}"), HULL_SCALE, Types.Float3, factors, custom=True)


def stand_height(base: Mechanism, radii: Mapping[str, float]) -> float:
    """How much higher a machine stands on larger tyres, metres: the most that one of them is larger."""
    raised = [0.0]
    for name, factor in radii.items():
        body = base.body(name)
        lowest = float(body.hull[:, 2].min()) if len(body.hull) else 0.0
        joint = next(j for j in base.joints if j.body1 == name and not j.cut)
        raised.append((joint.anchor[2] - lowest) * (factor - 1.0))
    return max(raised[1:], default=0.0)


def _raise(layer: Sdf.Layer, base: Mechanism, prims: MachinePrims, radii: Mapping[str, float]) -> None:
    set_placement(over(layer, prims.root), (0.0, 0.0, stand_height(base, radii)))
