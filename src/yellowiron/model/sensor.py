"""Sensors: what a template asks for (type, mount, parameters), and where the machine has them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

Vector = tuple[float, float, float]
SensorType = Literal[
    "camera",
    "lidar",
    "imu",
    "gnss",
    "contact",
    "joint_encoder",
    "cylinder_encoder",
    "cylinder_pressure",
]
FRAME_TYPES = ("camera", "lidar", "imu", "gnss", "contact")
"""Types that sit on a body, with a pose; the others read a joint or a cylinder."""


@dataclass(frozen=True)
class Parameter:
    """One parameter of a sensor type. `dimension` as in `support.units`, or `number`; bounds and default in SI."""

    dimension: str
    default: float
    minimum: float
    maximum: float
    meaning: str


_RATE = Parameter("number", 100.0, 0.01, 1e6, "readings a second")
_LENGTH_NOISE = "standard deviation of a reading, metres"

PARAMETERS: Mapping[str, Mapping[str, Parameter]] = {
    "camera": {
        "width": Parameter("number", 1280.0, 1.0, 32768.0, "pixels"),
        "height": Parameter("number", 720.0, 1.0, 32768.0, "pixels"),
        "horizontal_fov": Parameter("angle", 1.0471975511965976, 0.017, 2.967, "angle of view across the picture"),
        "focal_length": Parameter(
            "length", 0.004, 1e-4, 10.0, "of the lens; with the angle it gives the sensor's size"
        ),
        "near": Parameter("length", 0.05, 1e-4, 1e4, "nothing nearer is seen"),
        "far": Parameter("length", 200.0, 1e-3, 1e6, "nothing farther is seen"),
        "rate": Parameter("number", 30.0, 0.01, 1e5, "pictures a second"),
    },
    "lidar": {
        "channels": Parameter("number", 32.0, 1.0, 4096.0, "beams, one above the other"),
        "columns": Parameter("number", 1024.0, 1.0, 65536.0, "firings a turn"),
        "horizontal_fov": Parameter("angle", 6.283185307179586, 0.017, 6.2832, "angle swept, its middle forward"),
        "lowest": Parameter("angle", -0.4363323129985824, -1.5708, 1.5708, "elevation of the lowest beam"),
        "highest": Parameter("angle", 0.2617993877991494, -1.5708, 1.5708, "elevation of the highest beam"),
        "near": Parameter("length", 0.5, 0.0, 1e4, "shortest range"),
        "far": Parameter("length", 120.0, 1e-3, 1e5, "longest range"),
        "noise": Parameter("length", 0.0, 0.0, 10.0, _LENGTH_NOISE),
        "rate": Parameter("number", 10.0, 0.5, 1000.0, "turns a second"),
    },
    "imu": {
        "acceleration_noise": Parameter("number", 0.0, 0.0, 100.0, "noise density, m/s² over √Hz"),
        "rotation_noise": Parameter("number", 0.0, 0.0, 100.0, "noise density, rad/s over √Hz"),
        "filter_width": Parameter("number", 1.0, 1.0, 1000.0, "readings in a rolling mean"),
        "rate": _RATE,
    },
    "gnss": {
        "noise": Parameter("length", 0.0, 0.0, 1000.0, _LENGTH_NOISE),
        "rate": Parameter("number", 10.0, 0.01, 1000.0, "readings a second"),
    },
    "contact": {
        "minimum": Parameter("force", 0.0, 0.0, 1e9, "smaller forces are not reported"),
        "maximum": Parameter("force", 1e7, 1e-6, 1e12, "larger forces are reported as this one"),
        "rate": _RATE,
    },
    "joint_encoder": {
        "resolution": Parameter("number", 0.0, 0.0, 10.0, "smallest step, rad (or m on a slide); 0: none"),
        "noise": Parameter("number", 0.0, 0.0, 10.0, "standard deviation of a reading, rad (or m on a slide)"),
        "rate": _RATE,
    },
    "cylinder_encoder": {
        "resolution": Parameter("length", 0.0, 0.0, 1.0, "smallest step; 0: none"),
        "noise": Parameter("length", 0.0, 0.0, 1.0, _LENGTH_NOISE),
        "rate": _RATE,
    },
    "cylinder_pressure": {
        "maximum": Parameter("pressure", 6e7, 1.0, 1e9, "end of the range"),
        "noise": Parameter("pressure", 0.0, 0.0, 1e8, "standard deviation of a reading"),
        "rate": _RATE,
    },
}
"""Sensor type → its parameters. What is not stated has its default."""


@dataclass(frozen=True)
class SensorTemplate:
    """An entry of `sensors.json`. `mount` is one of

    - {"site": S}: on a site of the machine;
    - {"role": R} with `position` (machine frame, drawn pose, metres) or `at` (shares 0 … 1 of the extent of R's parts
      along x, y, z) and `on` (top, bottom, front, rear, left, right: out to the surface);
    - {"joint": J}, {"cylinder": slide} or {"actuator": A}: each of A's cylinders.

    The first two take an `offset` (metres) and an `orientation` (roll, pitch, yaw about the machine's x, y, z,
    radians): sensors look along their x axis, z is up. `parameters` in SI, as stated; `when` as for a role.
    """

    name: str
    type: SensorType
    mount: Mapping[str, Any]
    parameters: Mapping[str, float] = field(default_factory=dict)
    when: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    source: str = ""


@dataclass(frozen=True)
class Sensor:
    """A sensor of the machine. On a `body` with a pose in the machine frame, drawn pose (metres, unit axes; it looks
    along x, z is up), or on a `joint`, and for a cylinder's sensor on its slide, `cylinder` being its name.
    `parameters` are complete, SI (`PARAMETERS`). `source` says where it came from."""

    name: str
    type: SensorType
    body: str = ""
    position: Vector = (0.0, 0.0, 0.0)
    x_axis: Vector = (1.0, 0.0, 0.0)
    z_axis: Vector = (0.0, 0.0, 1.0)
    joint: str = ""
    cylinder: str = ""
    parameters: Mapping[str, float] = field(default_factory=dict)
    source: str = ""
