"""The page's sensors: where they sit on the machine, where they look, what they see, and a table of them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.model.sensor import FRAME_TYPES, PARAMETERS
from yellowiron.report.html.marks import Mark
from yellowiron.report.html.pictures import Camera
from yellowiron.report.words import MINUS, shown, spoken

REACH = 0.28
"""How far a field of view is drawn, as a share of the machine's size."""
_AROUND = 48
_FULL = 6.2
_SHORT = {"imu": "IMU", "gnss": "GNSS"}


def sensor_rows(document: Mapping[str, Any]) -> list[dict[str, Any]]:
    """One entry a sensor, numbered from 1 as the marks are."""
    return [_row(number, sensor) for number, sensor in enumerate(document["sensors"], start=1)]


def sensor_marks(document: Mapping[str, Any]) -> list[Mark]:
    """A mark at every sensor's place: hollow where it reads a joint or cylinder, blue where it looks."""
    anchors = {joint["name"]: joint["anchor"] for joint in document["joints"]}
    marks = []
    for number, sensor in enumerate(document["sensors"], start=1):
        if sensor["type"] in FRAME_TYPES:
            at, kind = sensor["position"], "looks" if sensor["type"] in ("camera", "lidar") else ""
        elif sensor["joint"] in anchors:
            at, kind = anchors[sensor["joint"]], "hollow"
        else:
            continue
        title = f"{number} {spoken(sensor['name'])} ({spoken(sensor['type'])})"
        marks.append(Mark(str(number), title, np.array([at], dtype=np.float64), kind))
    return marks


def views(sensors: Sequence[Mapping[str, Any]], size: float) -> list[tuple[str, Floats]]:
    """What looking sensors see, as closed outlines (n, 3) to draw, each with its kind.

    A camera's is its pyramid: four sides and the far frame. A lidar's are the rings of its lowest and highest beam
    and the wall between them.
    """
    return [outline for sensor in sensors for outline in _view(sensor, REACH * size)]


def view_svg(outlines: Sequence[tuple[str, Floats]], camera: Camera) -> str:
    """The outlines as SVG in the picture's pixels."""
    pieces = []
    for kind, outline in outlines:
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in camera.project(outline))
        pieces.append(f'<polygon class="view {kind}" points="{points}"/>')
    return "".join(pieces)


def field_of_view(sensor: Mapping[str, Any]) -> tuple[float, float] | None:
    """Half the angles of a camera's view, across and upright, radians; None for what is no camera."""
    if sensor["type"] != "camera":
        return None
    half = 0.5 * _value(sensor, "horizontal_fov")
    return half, math.atan(math.tan(half) * _value(sensor, "height") / _value(sensor, "width"))


def _view(sensor: Mapping[str, Any], reach: float) -> list[tuple[str, Floats]]:
    at, x, z = (np.asarray(sensor[key], dtype=np.float64) for key in ("position", "x_axis", "z_axis"))
    y = np.cross(z, x)
    if sensor["type"] == "camera":
        across, upright = (math.tan(half) for half in field_of_view(sensor) or (0.0, 0.0))
        corners = [x + sy * across * y + sz * upright * z for sy, sz in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        far = [at + reach * corner / float(np.linalg.norm(corner)) for corner in corners]
        sides = [("side", np.array([at, far[i], far[(i + 1) % 4]])) for i in range(4)]
        return [*sides, ("frame", np.array(far))]
    if sensor["type"] == "lidar":
        sweep = _value(sensor, "horizontal_fov")
        turn = np.linspace(-0.5 * sweep, 0.5 * sweep, _AROUND + 1)
        level = np.outer(np.cos(turn), x) + np.outer(np.sin(turn), y)
        low, high = (
            at + 0.8 * reach * (math.cos(up) * level + math.sin(up) * z)
            for up in (_value(sensor, "lowest"), _value(sensor, "highest"))
        )
        walls = [("wall", np.concatenate([low[i : i + 5], high[i : i + 5][::-1]])) for i in range(0, _AROUND, 4)]
        closed = sweep > _FULL
        return [*walls, *(("ring", ring if closed else np.vstack([at[None], ring])) for ring in (low, high))]
    return []


def _value(sensor: Mapping[str, Any], name: str) -> float:
    return float(sensor["parameters"].get(name, PARAMETERS[sensor["type"]][name].default))


def _row(number: int, sensor: Mapping[str, Any]) -> dict[str, Any]:
    framed = sensor["type"] in FRAME_TYPES
    x, y, z = (f"{value:.2f}".replace("-", MINUS) for value in sensor["position"])
    mount = spoken(sensor["body"] if framed else sensor["cylinder"]) or sensor["joint"]
    return {
        "number": number,
        "name": spoken(sensor["name"]),
        "type": _SHORT.get(sensor["type"], spoken(sensor["type"])),
        "mount": mount,
        "place": f"{x}, {y}, {z}" if framed else "",
        "looks": _direction(sensor["x_axis"]) if sensor["type"] in ("camera", "lidar") else "",
        "parameters": _parameters(sensor),
        "source": sensor["source"],
    }


def _direction(axis: Sequence[float]) -> str:
    """A unit vector in words: `forward, 25° down`."""
    azimuth = math.degrees(math.atan2(axis[1], axis[0]))
    up = math.degrees(math.asin(max(-1.0, min(1.0, axis[2]))))
    quarter = round(azimuth / 90.0) % 4
    off = azimuth - 90.0 * round(azimuth / 90.0)
    words = [("forward", "left", "backward", "right")[quarter]]
    if abs(off) >= 0.5:
        sides = ("left", "rear", "right", "front") if off > 0.0 else ("right", "front", "left", "rear")
        words.append(f"{abs(off):.0f}° to the {sides[quarter]}")
    if abs(up) >= 0.5:
        words.append(f"{abs(up):.0f}° {'up' if up > 0 else 'down'}")
    return ", ".join(words) if abs(up) < 80.0 else ("up" if up > 0 else "down")


def _parameters(sensor: Mapping[str, Any]) -> str:
    """The parameters that say most, in words."""
    kind = sensor["type"]
    rate = f"{_value(sensor, 'rate'):g} Hz" if "rate" in PARAMETERS.get(kind, {}) else ""
    words: list[str] = []
    if kind == "camera":
        across, upright = (2.0 * math.degrees(half) for half in field_of_view(sensor) or (0.0, 0.0))
        words = [
            f"{_value(sensor, 'width'):.0f} × {_value(sensor, 'height'):.0f} px",
            f"{across:.0f}° × {upright:.0f}°",
        ]
    elif kind == "lidar":
        low, high = (math.degrees(_value(sensor, key)) for key in ("lowest", "highest"))
        words = [
            f"{_value(sensor, 'channels'):.0f} beams",
            f"{math.degrees(_value(sensor, 'horizontal_fov')):.0f}° around",
            f"{low:.0f}° … {high:.0f}° high".replace("-", MINUS),
            f"to {_value(sensor, 'far'):g} m",
        ]
    elif kind == "cylinder_pressure":
        words = [f"to {shown(_value(sensor, 'maximum'), 'Pa')}"]
    elif kind == "contact":
        words = [f"to {shown(_value(sensor, 'maximum'), 'N')}"]
    noise = sensor["parameters"].get("noise", 0.0)
    if noise and PARAMETERS[kind]["noise"].dimension == "length":
        words.append(f"noise {shown(noise, 'm')}")
    return ", ".join([*words, rate]) if rate else ", ".join(words)
