"""Sensors: the template's, each where its mount is on this machine. Machine frame, metres."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import numpy as np
from scipy.spatial.transform import Rotation

from yellowiron.mechanism.placement import Placement
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Cylinder, Site
from yellowiron.model.sensor import FRAME_TYPES, PARAMETERS, Sensor, SensorTemplate
from yellowiron.model.template import ActuatorTemplate, Template
from yellowiron.support.vectors import clean_triple

_SIDES: Mapping[str, tuple[int, bool]] = {
    "top": (2, True),
    "bottom": (2, False),
    "front": (0, True),
    "rear": (0, False),
    "left": (1, True),
    "right": (1, False),
}
"""Side of a body → (axis, whether it is the greater end)."""


def sensors(
    template: Template,
    sites: Iterable[Site],
    joints: Iterable[str],
    cylinders: Iterable[Cylinder],
    placement: Placement,
    findings: list[Finding],
) -> tuple[Sensor, ...]:
    """The template's sensors whose mount the machine has; MEC060 for the others, which are left out.

    `joints` are the names of those that were built. A sensor on an actuator becomes one on each of its cylinders.
    """
    by_site = {site.name: site for site in sites}
    built = set(joints)
    by_slide = {cylinder.slide: cylinder for cylinder in cylinders}
    actuators = {actuator.name: actuator for actuator in template.actuators}
    result: list[Sensor] = []
    for entry in template.sensors:
        if entry.type in FRAME_TYPES:
            found = _framed(entry, by_site, template, placement)
            made = [found] if found is not None else []
        elif "joint" in entry.mount:
            made = [_read(entry, entry.mount["joint"])] if entry.mount["joint"] in built else []
        else:
            made = list(_on_cylinders(entry, by_slide, actuators))
        if not made:
            kind, place = next(iter(entry.mount.items()))
            words = f"The {kind} '{place}' that the {entry.type} is mounted on is not on this machine: it is left out."
            hint = "Mount it elsewhere in sensors.json, or check the alignment."
            findings.append(Finding("MEC060", "warning", entry.name, words, hint))
        result += made
    return tuple(result)


def _complete(entry: SensorTemplate) -> dict[str, float]:
    return {key: p.default for key, p in PARAMETERS[entry.type].items()} | dict(entry.parameters)


def _read(entry: SensorTemplate, joint: str, cylinder: Cylinder | None = None, *, name: str = "") -> Sensor:
    return Sensor(
        name=name or entry.name,
        type=entry.type,
        joint=joint,
        cylinder=cylinder.name if cylinder is not None else "",
        parameters=_complete(entry),
        source=entry.source,
    )


def _on_cylinders(
    entry: SensorTemplate, by_slide: Mapping[str, Cylinder], actuators: Mapping[str, ActuatorTemplate]
) -> Iterator[Sensor]:
    """One sensor a cylinder; where there are several, each has its cylinder's name in its own."""
    if "cylinder" in entry.mount:
        slides = [entry.mount["cylinder"]]
    else:
        actuator = actuators.get(entry.mount["actuator"])
        slides = [c.slide for c in actuator.cylinders] if actuator is not None else []
    found = [by_slide[slide] for slide in slides if slide in by_slide]
    for cylinder in found:
        name = f"{entry.name}_{cylinder.name}" if len(found) > 1 else entry.name
        yield _read(entry, cylinder.slide, cylinder, name=name)


def _framed(
    entry: SensorTemplate, sites: Mapping[str, Site], template: Template, placement: Placement
) -> Sensor | None:
    mount = entry.mount
    turn = Rotation.from_euler("xyz", mount.get("orientation", (0.0, 0.0, 0.0))).as_matrix()
    if "site" in mount:
        site = sites.get(mount["site"])
        if site is None:
            return None
        body, position, where = site.body, np.asarray(site.position), f"site {site.name}"
        x, z = np.asarray(site.x_axis), np.asarray(site.z_axis)
        axes = np.column_stack([x, np.cross(z, x), z])
    else:
        role: str = mount["role"]
        owner = template.body_of(role) if any(r.name == role for r in template.roles) else None
        rows = placement.rows_of_body(role) if owner == role else placement.rows_of_role(role)
        if owner is None or not rows:
            return None
        body, axes = owner, np.eye(3)
        position, where = _place(entry, rows, placement)
    # A mount is no better known than to a micrometre.
    position = np.round(position + np.asarray(mount.get("offset", (0.0, 0.0, 0.0))), 6) + 0.0
    axes = np.round(turn @ axes, 15) + 0.0
    return Sensor(
        name=entry.name,
        type=entry.type,
        body=body,
        position=clean_triple(position),
        x_axis=clean_triple(axes[:, 0]),
        z_axis=clean_triple(axes[:, 2]),
        parameters=_complete(entry),
        source="; ".join(text for text in (entry.source.rstrip("."), where) if text),
    )


def _place(entry: SensorTemplate, rows: tuple[int, ...], placement: Placement) -> tuple[Floats, str]:
    """A point of the role's parts: stated, or by shares of their extent, and from there out to their surface."""
    mount = entry.mount
    if "position" in mount:
        return np.asarray(mount["position"], dtype=np.float64), "position as stated"
    lows, highs = _boxes(rows, placement)
    low, high = lows.min(axis=0), highs.max(axis=0)
    shares = np.asarray(mount.get("at", (0.5, 0.5, 0.5)))
    point = low + shares * (high - low)
    where = f"at {', '.join(f'{s:.0%}' for s in shares)} of {mount['role']}"
    if "on" not in mount:
        return point, where
    axis, greater = _SIDES[mount["on"]]
    across = [k for k in range(3) if k != axis]
    under = np.all((lows[:, across] <= point[across]) & (point[across] <= highs[:, across]), axis=1)
    reach = highs[:, axis] if greater else lows[:, axis]
    # Where no part lies in that direction, the end of the whole body.
    reach = reach[under] if under.any() else reach
    point[axis] = reach.max() if greater else reach.min()
    return point, f"{where}, on its {mount['on']}"


def _boxes(rows: tuple[int, ...], placement: Placement) -> tuple[Floats, Floats]:
    """Least and greatest corners (n, 3) of the parts, machine frame."""
    low, high = placement.boxes
    there = [row for row in rows if np.isfinite(low[row]).all()]
    return low[there], high[there]
