"""The sensors layer: cameras, Isaac Sim's sensor prims, and what encoders and pressure sensors read.

A sensor with a pose is a prim under its body: a `Camera`, else an `Xform` that looks along +X with +Z up. Under that
Xform stands the prim that Isaac Sim knows, by its type's name, so that no file needs Kit to open: `IsaacImuSensor` and
`IsaacContactSensor` (Isaac Sim's sensor schema, `isaacsim.robot.schema`), `OmniLidar` with
`OmniSensorGenericLidarCoreAPI` (`omni.usd.schema.omni_sensors`). Encoders and pressure sensors are `customData` on the
joint they read. docs/sensors.md has the sources.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom

from yellowiron.model.geometry import Floats
from yellowiron.model.sensor import Sensor
from yellowiron.support.record import RECORD
from yellowiron.support.vectors import triple
from yellowiron.usd.authoring.metadata import describe_sensor, from_json, set_custom, to_json
from yellowiron.usd.authoring.rotation import Quaternion, quaternion_of
from yellowiron.usd.authoring.stage import (
    Types,
    apply_schemas,
    define,
    identifier,
    over,
    set_attribute,
    set_display_name,
    set_placement,
)
from yellowiron.usd.planning.plan import Plan

FILE = "sensors.usda"
DEVICE = "device"
"""The prim of Isaac Sim's under a sensor's Xform."""
TENTHS = 10.0
"""UsdGeomCamera counts lens and sensor in tenths of the stage's unit, which is the metre."""

_CAMERA_AXES = np.array([[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""Columns: a USD camera's axes (right, up, backwards) in the frame of a sensor, which looks along +X with +Z up."""
_EXACT = 1e-6


def write_sensors(layer: Sdf.Layer, plan: Plan) -> None:
    """Every sensor of the mechanism, in its order."""
    mechanism = plan.mechanism
    origins = {body.name: np.asarray(body.origin) for body in mechanism.bodies}
    reading: dict[str, dict[str, Any]] = {}
    for sensor in mechanism.sensors:
        if sensor.name in plan.sensor_paths:
            _write_framed(layer, plan.sensor_paths[sensor.name], sensor, origins[sensor.body])
        else:
            record = {"type": sensor.type, "cylinder": sensor.cylinder, "parameters": dict(sensor.parameters)}
            found = reading.setdefault(sensor.joint, {})
            found[identifier(sensor.name)] = {k: v for k, v in record.items() if v}
    # Every joint is named where one is: the first layer that names prims gives them their order.
    for joint in mechanism.joints if reading else ():
        spec = over(layer, plan.joint_paths[joint.name])
        if joint.name in reading:
            set_custom(spec, {"sensors": reading[joint.name]})
    set_custom(over(layer, plan.root), {"sensors": to_json(mechanism.sensors)})


def write_contact_reports(layer: Sdf.Layer, plan: Plan) -> None:
    """PhysX reports the contacts of bodies with a contact sensor; a physics opinion, so in a physics layer."""
    for sensor in plan.mechanism.sensors:
        if sensor.type == "contact":
            spec = over(layer, plan.body_paths[sensor.body])
            apply_schemas(spec, "PhysxContactReportAPI")
            set_attribute(spec, "physxContactReport:threshold", Types.Float, sensor.parameters["minimum"])


def _write_framed(layer: Sdf.Layer, path: str, sensor: Sensor, origin: Floats) -> None:
    camera = sensor.type == "camera"
    spec = define(layer, path, "Camera" if camera else "Xform")
    set_display_name(spec, sensor.name)
    set_placement(spec, np.asarray(sensor.position) - origin, sensor_quaternion(sensor))
    set_custom(spec, describe_sensor(sensor))
    parameters = sensor.parameters
    if camera:
        _write_optics(spec, parameters)
    elif sensor.type == "lidar":
        device = define(layer, f"{path}/{DEVICE}", "OmniLidar")
        apply_schemas(device, "OmniSensorGenericLidarCoreAPI")
        # Scans are whole only where both rates are the same.
        set_attribute(device, "omni:sensor:tickRate", Types.Float, parameters["rate"])
        set_attribute(device, "omni:sensor:Core:scanRateBaseHz", Types.UInt, max(1, round(parameters["rate"])))
        set_attribute(device, "omni:sensor:Core:nearRangeM", Types.Float, parameters["near"])
        set_attribute(device, "omni:sensor:Core:farRangeM", Types.Float, parameters["far"])
    elif sensor.type == "imu":
        device = define(layer, f"{path}/{DEVICE}", "IsaacImuSensor")
        set_attribute(device, "enabled", Types.Bool, True)
        for name in ("linearAcceleration", "angularVelocity", "orientation"):
            set_attribute(device, f"{name}FilterWidth", Types.Int, round(parameters["filter_width"]))
    elif sensor.type == "contact":
        device = define(layer, f"{path}/{DEVICE}", "IsaacContactSensor")
        set_attribute(device, "enabled", Types.Bool, True)
        threshold = Gf.Vec2f(parameters["minimum"], parameters["maximum"])
        set_attribute(device, "threshold", Types.Float2, threshold)
        set_attribute(device, "radius", Types.Float, -1.0)


def sensor_quaternion(sensor: Sensor) -> Quaternion:
    """The rotation of a sensor's prim: a camera looks along its −Z, everything else along +X."""
    axes = _axes(sensor)
    return quaternion_of(axes @ _CAMERA_AXES if sensor.type == "camera" else axes)


def _write_optics(spec: Sdf.PrimSpec, parameters: Mapping[str, float]) -> None:
    """Lens and sensor of a pinhole camera with square pixels: aperture = 2·f·tan(angle/2)."""
    focal = parameters["focal_length"] * TENTHS
    width = 2.0 * focal * math.tan(0.5 * parameters["horizontal_fov"])
    set_attribute(spec, "focalLength", Types.Float, focal)
    set_attribute(spec, "horizontalAperture", Types.Float, width)
    set_attribute(spec, "verticalAperture", Types.Float, width * parameters["height"] / parameters["width"])
    set_attribute(spec, "clippingRange", Types.Float2, Gf.Vec2f(parameters["near"], parameters["far"]))


def _axes(sensor: Sensor) -> Floats:
    x, z = np.asarray(sensor.x_axis), np.asarray(sensor.z_axis)
    return np.column_stack([x, np.cross(z, x), z])


def read_sensors(machine: Usd.Prim, cache: UsdGeom.XformCache) -> tuple[Sensor, ...]:
    """The sensors of a machine's prim, as they were written or have been edited since: a prim that was moved, a lens
    that was changed; a prim that was removed takes its sensor with it."""
    text = machine.GetCustomDataByKey(f"{RECORD}:sensors")
    if not text:
        return ()
    prims = {}
    for body in machine.GetChildren():
        for prim in body.GetChildren():
            data = prim.GetCustomDataByKey(RECORD)
            if data and data.get("kind") == "sensor":
                prims[str(data["name"])] = prim
    recorded: tuple[Sensor, ...] = from_json(tuple[Sensor, ...], text)
    return tuple(
        _edited(sensor, prims[sensor.name], machine, cache) if sensor.body else sensor
        for sensor in recorded
        if not sensor.body or sensor.name in prims
    )


def _edited(sensor: Sensor, prim: Usd.Prim, machine: Usd.Prim, cache: UsdGeom.XformCache) -> Sensor:
    matrix, _ = cache.ComputeRelativeTransform(prim, machine)
    position = np.array(matrix.ExtractTranslation())
    axes = np.array(matrix.ExtractRotationMatrix().GetOrthonormalized()).T
    if prim.IsA(UsdGeom.Camera):
        axes = axes @ _CAMERA_AXES.T
        sensor = replace(sensor, parameters=_optics(sensor, UsdGeom.Camera(prim)))
    if np.abs(position - sensor.position).max() > _EXACT:
        sensor = replace(sensor, position=triple(position))
    if np.abs(axes - _axes(sensor)).max() > _EXACT:
        sensor = replace(sensor, x_axis=triple(axes[:, 0]), z_axis=triple(axes[:, 2]))
    return sensor


def _optics(sensor: Sensor, camera: UsdGeom.Camera) -> Mapping[str, float]:
    focal, width = camera.GetFocalLengthAttr().Get(), camera.GetHorizontalApertureAttr().Get()
    near, far = camera.GetClippingRangeAttr().Get()
    found = {
        "focal_length": focal / TENTHS,
        "horizontal_fov": 2.0 * math.atan2(0.5 * width, focal),
        "near": float(near),
        "far": float(far),
    }
    changed = {k: v for k, v in found.items() if abs(v - sensor.parameters[k]) > _EXACT * abs(sensor.parameters[k])}
    return {**sensor.parameters, **changed}
