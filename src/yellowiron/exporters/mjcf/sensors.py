"""Sensors in MJCF: cameras, and sites with what is sensed on them.

| sensor | MJCF |
|---|---|
| camera | `camera`, with resolution |
| imu | site; `accelerometer` `NAME.acceleration`, `gyro` `NAME.rotation`, `framequat` `NAME.attitude` |
| gnss | site; `framepos` `NAME`, `framelinvel` `NAME.velocity` |
| lidar | a level fan of `rangefinder`s, `NAME.0` forward and on to the left (a full scan is a renderer's work) |
| contact | a box site around the body; `touch` `NAME`, N |
| joint_encoder, cylinder_encoder | `jointpos` `NAME`, from the drawn pose; on a cut pivot `framequat`, body1 in body0 |
| … of a cylinder that is a tendon | `tendonpos` `NAME`, between its pins; its pressure `tendonactuatorfrc` |
| cylinder_pressure | `jointactuatorfrc` `NAME` of the driven slide, N: pressure is force by area, docs/sensors.md |

Rays against every mesh at every step are slow (a fifth of the speed), so the lidars' `sensor` section is a file apart,
which a scene may include.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from xml.etree import ElementTree as ET

import numpy as np

from yellowiron.exporters.tendons import Tendon
from yellowiron.exporters.values import axes_of, minus, quaternion, row, text
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Joint, Mechanism
from yellowiron.model.sensor import Sensor

FAN = 36
"""Beams in a lidar's fan."""
_CAMERA_AXES = np.array([[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""Columns: a camera's axes (right, up, backwards) in the frame of a sensor, which looks along +X with +Z up."""
_AROUND = 0.02
"""Metres that the zone of a touch sensor reaches beyond its body."""
_HIDDEN = "5"
"""The group of sites that are not shown unless asked for."""


def on_body(mechanism: Mechanism, body: Body) -> Iterator[ET.Element]:
    """The cameras and sites of the sensors on a body, in the body's frame."""
    for sensor in mechanism.sensors:
        if sensor.body != body.name:
            continue
        place = {"pos": row(minus(sensor.position, body.origin))}
        axes = axes_of(sensor)
        if sensor.type == "camera":
            yield _camera(sensor, place, axes)
        elif sensor.type == "lidar":
            for number, direction in enumerate(_directions(sensor)):
                values = {"name": f"{sensor.name}.{number}", **place, "zaxis": row(axes @ direction)}
                yield ET.Element("site", {**values, "group": _HIDDEN})
        elif sensor.type == "contact":
            yield ET.Element("site", {"name": _site(sensor, mechanism), **_zone(body, place), "group": _HIDDEN})
        else:
            yield ET.Element("site", {"name": _site(sensor, mechanism), **place, "quat": row(quaternion(axes))})


def section(mechanism: Mechanism, tendons: Sequence[Tendon] = (), *, lidars: bool = False) -> ET.Element:
    """The `sensor` section of the lidars, or of all others. `tendons` stand for slides that are no joints."""
    made = ET.Element("sensor")
    slides = {tendon.slide.name: tendon.slide for tendon in tendons}
    for sensor in mechanism.sensors:
        if (sensor.type == "lidar") is not lidars:
            continue
        for tag, name, values in _sensed(sensor, mechanism, slides):
            ET.SubElement(made, tag, {"name": name, **values})
    return made


def _sensed(
    sensor: Sensor, mechanism: Mechanism, slides: Mapping[str, Joint]
) -> Iterator[tuple[str, str, dict[str, str]]]:
    """(element, name, attributes) of everything that a sensor reads."""
    name = sensor.name
    site = {"site": _site(sensor, mechanism)}
    frame = {"objtype": "site", "objname": site["site"]}
    if sensor.type == "imu":
        yield "accelerometer", f"{name}.acceleration", site
        yield "gyro", f"{name}.rotation", site
        yield "framequat", f"{name}.attitude", frame
    elif sensor.type == "gnss":
        yield "framepos", name, frame
        yield "framelinvel", f"{name}.velocity", frame
    elif sensor.type == "lidar":
        for number in range(FAN):
            cutoff = text(sensor.parameters["far"])
            yield "rangefinder", f"{name}.{number}", {"site": f"{name}.{number}", "cutoff": cutoff}
    elif sensor.type == "contact":
        yield "touch", name, site
    elif sensor.type in ("joint_encoder", "cylinder_encoder") and sensor.joint in slides:
        yield "tendonpos", name, {"tendon": sensor.joint}
    elif sensor.type in ("joint_encoder", "cylinder_encoder"):
        joint = mechanism.joint(sensor.joint)
        if not joint.cut and joint.type in ("revolute", "prismatic"):
            yield "jointpos", name, {"joint": joint.name}
        else:
            bodies = {"objtype": "xbody", "objname": joint.body1, "reftype": "xbody", "refname": joint.body0}
            yield "framequat", name, bodies
    elif sensor.type == "cylinder_pressure":
        driven = _driven(mechanism, sensor.cylinder, slides)
        if driven is not None and driven.name in slides:
            yield "tendonactuatorfrc", name, {"tendon": driven.name}
        elif driven is not None:
            yield "jointactuatorfrc", name, {"joint": driven.name}


def _driven(mechanism: Mechanism, cylinder: str, slides: Mapping[str, Joint]) -> Joint | None:
    """The slide that carries the force of a cylinder: its own, or where it is passive its twin's."""
    joints = {joint.name: joint for joint in mechanism.joints} | dict(slides)
    for actuator in mechanism.actuators:
        moved = [joints[entry.joint] for entry in actuator.joints if entry.joint in joints]
        if cylinder in actuator.cylinders:
            return next((joint for joint in moved if joint.drive is not None and not joint.cut), None)
    return None


def _camera(sensor: Sensor, place: dict[str, str], axes: Floats) -> ET.Element:
    width, height = (sensor.parameters[key] for key in ("width", "height"))
    upright = 2.0 * math.atan(math.tan(0.5 * sensor.parameters["horizontal_fov"]) * height / width)
    values = {"fovy": text(math.degrees(upright)), "resolution": f"{round(width)} {round(height)}"}
    return ET.Element("camera", {"name": sensor.name, **place, "quat": row(quaternion(axes @ _CAMERA_AXES)), **values})


def _directions(sensor: Sensor) -> Iterator[Floats]:
    """Beams in the sensor's frame: level, or as level as its beams are, around in equal steps."""
    spread = sensor.parameters["horizontal_fov"]
    whole = spread >= 2.0 * math.pi - 1e-9
    elevation = min(max(0.0, sensor.parameters["lowest"]), sensor.parameters["highest"])
    for number in range(FAN):
        turn = 2.0 * math.pi * number / FAN if whole else spread * (number / (FAN - 1) - 0.5)
        flat = math.cos(elevation)
        yield np.array([flat * math.cos(turn), flat * math.sin(turn), math.sin(elevation)])


def _zone(body: Body, place: dict[str, str]) -> dict[str, str]:
    """A box around the body, in its own axes; a point where nothing is known of its shape."""
    if not len(body.hull):
        return place
    low, high = body.hull.min(axis=0), body.hull.max(axis=0)
    center = row(minus(0.5 * (low + high), body.origin))
    return {"type": "box", "pos": center, "size": row(0.5 * (high - low) + _AROUND)}


def _site(sensor: Sensor, mechanism: Mechanism) -> str:
    """The name of a sensor's site: its own, unless the machine has a site of that name."""
    taken = any(site.name == sensor.name for site in mechanism.sites)
    return f"{sensor.name}.sensor" if taken else sensor.name
