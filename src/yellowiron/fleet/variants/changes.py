"""A sample's values put to a mechanism: everything but what follows from its loops (`solving`)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from yellowiron.fleet.documents import UnusableError
from yellowiron.fleet.variants.parameters import DIRECTION, Parameter
from yellowiron.fleet.variants.sampling import Draw
from yellowiron.fleet.variants.tools import Tool, Tools
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Actuator, Body, Cylinder, Drive, Joint, Mechanism, Site, Vector
from yellowiron.model.sensor import Sensor
from yellowiron.model.template import Material
from yellowiron.support.vectors import triple

_NOISES = ("noise", "acceleration_noise", "rotation_noise")


@dataclass(eq=False)
class Changed:
    """A machine with a sample's values. `radii`: wheel → factor of its radius; `play`: pin → metres; `gains`: driven
    joint → factors of stiffness and damping; `flows` and `pressures`: actuator → factor; `tools`: body → its tool."""

    mechanism: Mechanism
    bodies: dict[str, Body]
    joints: dict[str, Joint]
    cylinders: dict[str, Cylinder]
    materials: dict[str, Material]
    sensors: dict[str, Sensor]
    sites: dict[str, Site]
    radii: dict[str, float] = field(default_factory=dict)
    play: dict[str, float] = field(default_factory=dict)
    gains: dict[str, tuple[float, float]] = field(default_factory=dict)
    flows: dict[str, float] = field(default_factory=dict)
    pressures: dict[str, float] = field(default_factory=dict)
    tools: dict[str, str] = field(default_factory=dict)

    def made(self) -> Mechanism:
        """The mechanism with all that was changed, in the order of the base's."""
        base = self.mechanism
        return replace(
            base,
            bodies=tuple(self.bodies[body.name] for body in base.bodies),
            joints=tuple(self.joints[joint.name] for joint in base.joints),
            cylinders=tuple(self.cylinders[cylinder.name] for cylinder in base.cylinders),
            materials={name: self.materials[name] for name in base.materials},
            sensors=tuple(self.sensors[sensor.name] for sensor in base.sensors),
            sites=tuple(self.sites[site.name] for site in base.sites),
        )


def changed(mechanism: Mechanism, draws: Sequence[Draw], values: Sequence[float], tools: Tools) -> Changed:
    """A machine with one sample's values: its tools, then in the order of the parameters; drives are given the forces
    and speeds that follow from cylinders, pressures and flows."""
    work = Changed(
        mechanism,
        {body.name: body for body in mechanism.bodies},
        {joint.name: joint for joint in mechanism.joints},
        {cylinder.name: cylinder for cylinder in mechanism.cylinders},
        dict(mechanism.materials),
        {sensor.name: sensor for sensor in mechanism.sensors},
        {site.name: site for site in mechanism.sites},
    )
    # A payload, or a factor of a mass, is of the tool that is there.
    for draw, value in sorted(zip(draws, values, strict=True), key=lambda pair: pair[0].parameter.vary != "tool"):
        parameter = draw.parameter
        for name in draw.names:
            if parameter.vary == "tool":
                _tool(work, parameter, name, int(value), tools[name])
            else:
                _CHANGES[parameter.vary](work, parameter, name, float(value))
    for cylinder in mechanism.cylinders:
        _refigure(work, cylinder)
    for actuator in mechanism.actuators:
        _redrive(work, actuator)
    return work


def _said(parameter: Parameter, before: float, value: float) -> float:
    return {"factor": before * value, "offset": before + value, "value": value}[parameter.mode]


def _mass(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    body = work.bodies[name]
    mass = max(_said(parameter, body.mass, value), 1e-3 * body.mass)
    work.bodies[name] = replace(body, mass=mass, inertia=body.inertia * (mass / body.mass if body.mass else 1.0))


def _center(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    body = work.bodies[name]
    work.bodies[name] = replace(body, center_of_mass=_moved(body.center_of_mass, parameter.axis, value))


def _moved(point: Vector, axis: int, by: float) -> Vector:
    return triple([each + (by if number == axis else 0.0) for number, each in enumerate(point)])


def _friction(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    material = work.materials[name]
    before = material.dynamic_friction or 0.0
    dynamic = max(0.0, _said(parameter, before, value))
    # What is said as a value is of what slides; what sticks keeps its share.
    static = (material.static_friction or 0.0) * (dynamic / before if before else 1.0)
    work.materials[name] = replace(material, dynamic_friction=dynamic, static_friction=max(static, dynamic))


def _gain(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    actuator = _actuator(work.mechanism, name)
    for entry in actuator.joints:
        stiffness, damping = work.gains.get(entry.joint, (1.0, 1.0))
        stiff = parameter.vary == "stiffness"
        work.gains[entry.joint] = (stiffness * value, damping) if stiff else (stiffness, damping * value)


def _pressure(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    work.pressures[name] = work.pressures.get(name, 1.0) * value
    for cylinder in _actuator(work.mechanism, name).cylinders:
        before = work.cylinders[cylinder]
        work.cylinders[cylinder] = replace(before, pressure=before.pressure * value)


def _flow(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    work.flows[name] = work.flows.get(name, 1.0) * value


def _actuator(mechanism: Mechanism, name: str) -> Actuator:
    return next(actuator for actuator in mechanism.actuators if actuator.name == name)


def _bore(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    cylinder = work.cylinders[name]
    work.cylinders[name] = replace(cylinder, bore=max(_said(parameter, cylinder.bore, value), 1e-3))


def _rod(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    cylinder = work.cylinders[name]
    rod = max(_said(parameter, cylinder.rod_diameter, value), 1e-3)
    work.cylinders[name] = replace(cylinder, rod_diameter=rod)


def _stroke(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    cylinder = work.cylinders[name]
    stroke = max(_said(parameter, cylinder.stroke, value), 1e-3)
    _set_ends(work, cylinder, replace(cylinder, stroke=stroke))


def _closed(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    cylinder = work.cylinders[name]
    _set_ends(work, cylinder, replace(cylinder, closed_length=cylinder.closed_length + value))


def _set_ends(work: Changed, before: Cylinder, after: Cylinder) -> None:
    """The ends of a driven slide move with its cylinder's; one that something else holds back stays, while the cylinder
    reaches there."""
    work.cylinders[after.name] = after
    joint = work.joints.get(after.slide)
    if joint is None or after.passive or joint.lower is None or joint.upper is None:
        return
    first, last = -before.extension, before.stroke - before.extension
    new_first, new_last = -after.extension, after.stroke - after.extension
    lower = new_first if abs(joint.lower - first) < 1e-6 else max(joint.lower, new_first)
    upper = new_last if abs(joint.upper - last) < 1e-6 else min(joint.upper, new_last)
    work.joints[after.slide] = replace(joint, lower=lower, upper=upper)


def _play(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    work.play[name] = max(0.0, value)


def _rest(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    """Puts a pivot off its place by half its play: a pin with play rests on one side of its bore, and no engine knows
    play. On both bodies, so that loops stay closed as drawn."""
    normal = np.asarray(work.joints[name].axis)
    across = np.eye(3)[int(np.argmin(np.abs(normal)))]
    first = np.cross(normal, across)
    first /= np.linalg.norm(first)
    way = math.cos(value) * first + math.sin(value) * np.cross(normal, first)
    _move_pin(work, name, 0.5 * work.play.get(name, 0.0) * way)


def _pin(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    _move_pin(work, name, np.eye(3)[parameter.axis] * value)


def _length(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    near, far = (work.joints.get(end) for end in parameter.ends)
    if near is None or far is None or not all(name in (joint.body0, joint.body1) for joint in (near, far)):
        raise UnusableError(
            f"'{name}' is no link between these two joints", where=parameter.where,
            hint=f"Joints: {', '.join(j.name for j in work.mechanism.joints if name in (j.body0, j.body1))}.",
        )  # fmt: skip
    axis = np.asarray(far.axis)
    way = np.asarray(far.anchor) - np.asarray(near.anchor)
    way = way - axis * (axis @ way)
    length = float(np.linalg.norm(way))
    _move_pin(work, far.name, way / length * (_said(parameter, length, value) - length))


def _move_pin(work: Changed, name: str, by: Floats) -> None:
    """Moves a pin as it is drawn, on both bodies that it joins, so that no body has to turn. Where it is a cylinder's,
    the cylinder is longer or shorter by what that is along it, closed as well as drawn."""
    joint = work.joints[name]
    work.joints[name] = replace(joint, anchor=triple(np.asarray(joint.anchor) + by))
    for cylinder in work.cylinders.values():
        if name in cylinder.pins and cylinder.slide in work.joints:
            along = float(np.asarray(work.joints[cylinder.slide].axis) @ by)
            along = along if name == cylinder.rod_joint else -along
            drawn, closed = cylinder.drawn_length + along, cylinder.closed_length + along
            work.cylinders[cylinder.name] = replace(cylinder, drawn_length=drawn, closed_length=closed)


def _payload(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    payload = work.mechanism.payload
    site = next((s for s in work.sites.values() if payload is not None and s.name == payload.site), None)
    if site is None:
        raise UnusableError("The machine has no place for a payload", where=parameter.where, hint="Leave it out.")
    body, load = work.bodies[site.body], max(0.0, value)
    mass = body.mass + load
    own, at = np.asarray(body.center_of_mass), np.asarray(site.position)
    center = (body.mass * own + load * at) / mass
    inertia = body.inertia + body.mass * _parallel(own - center) + load * _parallel(at - center)
    # A heap of earth, not a point: a ball of two tonnes a cubic metre.
    radius = (load / 2000.0 * 3.0 / (4.0 * math.pi)) ** (1.0 / 3.0)
    inertia = inertia + np.eye(3) * (0.4 * load * radius**2)
    work.bodies[site.body] = replace(body, mass=mass, center_of_mass=triple(center), inertia=inertia)


def _parallel(offset: Floats) -> Floats:
    return np.asarray(np.eye(3) * float(offset @ offset) - np.outer(offset, offset))


def _radius(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    body = work.bodies[name]
    joint = next(j for j in work.mechanism.joints if j.body1 == name and not j.cut)
    axis, out = np.asarray(joint.axis), body.hull - np.asarray(joint.anchor)
    radius = float(np.linalg.norm(out - np.outer(out @ axis, axis), axis=1).max(initial=0.0)) or 1.0
    work.radii[name] = work.radii.get(name, 1.0) * max(_said(parameter, radius, value), 0.5 * radius) / radius


def _mount(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    sensor = work.sensors[name]
    if not sensor.body:
        raise UnusableError(f"'{name}' has no place on a body", where=parameter.where, hint="It reads a joint.")
    if parameter.vary == "sensor_position":
        work.sensors[name] = replace(sensor, position=_moved(sensor.position, parameter.axis, value))
        return
    turn = Rotation.from_rotvec(value * np.eye(3)[parameter.axis]).as_matrix()
    x, z = (triple(turn @ np.asarray(axis)) for axis in (sensor.x_axis, sensor.z_axis))
    work.sensors[name] = replace(sensor, x_axis=x, z_axis=z)


def _noise(work: Changed, parameter: Parameter, name: str, value: float) -> None:
    sensor = work.sensors[name]
    new = {
        key: max(0.0, _said(parameter, sensor.parameters[key], value)) for key in _NOISES if key in sensor.parameters
    }
    if not new:
        raise UnusableError(f"'{name}' has no noise", where=parameter.where, hint="Name others with of: […].")
    work.sensors[name] = replace(sensor, parameters={**sensor.parameters, **new})


def _tool(work: Changed, parameter: Parameter, name: str, chosen: int, tools: Mapping[str, Tool]) -> None:
    word = parameter.spread.words[chosen]
    if word != "drawn":
        work.tools[name] = word
        work.bodies[name] = tools[word].body
        work.sites.update({site.name: site for site in tools[word].sites})


_CHANGES: Mapping[str, Any] = {
    "mass": _mass, "center_of_mass": _center, "friction": _friction, "stiffness": _gain, "damping": _gain,
    "pressure": _pressure, "flow": _flow, "bore": _bore, "rod_diameter": _rod, "stroke": _stroke,
    "closed_length": _closed, "pin_play": _play, DIRECTION: _rest, "pin": _pin, "length": _length, "payload": _payload,
    "tyre_radius": _radius, "sensor_position": _mount, "sensor_angle": _mount, "sensor_noise": _noise,
}  # fmt: skip


def _refigure(work: Changed, before: Cylinder) -> None:
    """A cylinder's forces by its areas and pressure; those that the base has keep their share of that."""
    after = work.cylinders[before.name]
    push, pull = _areas(after)[0] / _areas(before)[0], _areas(after)[1] / _areas(before)[1]
    more = after.pressure / before.pressure if before.pressure else 1.0
    if push == pull == more == 1.0:
        return
    work.cylinders[before.name] = replace(
        after, push_force=before.push_force * push * more, pull_force=before.pull_force * pull * more
    )


def _areas(cylinder: Cylinder) -> tuple[float, float]:
    """What oil pushes on, extending and retracting, m²; of a cylinder without a bore something that cancels out."""
    bore = math.pi / 4.0 * cylinder.bore**2
    ring = bore - math.pi / 4.0 * cylinder.rod_diameter**2
    return (bore, max(ring, 1e-3 * bore)) if bore > 0.0 else (1.0, 1.0)


def _redrive(work: Changed, actuator: Actuator) -> None:
    """Forces and speeds of an actuator's drives: forces as its cylinders' together, speeds as flow over their areas."""
    signs = {entry.joint: entry.sign for entry in actuator.joints}
    own = [c for c in work.mechanism.cylinders if c.name in actuator.cylinders]
    flow = work.flows.get(actuator.name, 1.0)
    for name, sign in signs.items():
        joint = work.joints[name]
        drive = joint.drive
        if drive is None:
            continue
        if not own:  # a motor
            out = back = work.pressures.get(actuator.name, 1.0)
            fast = slow = flow
        else:
            alike = [signs.get(c.slide, sign) == sign for c in own]
            out, back, wide, narrow = _ratios(work, own, alike)
            fast, slow = flow / wide, flow / narrow
        if out == back == fast == slow == 1.0:
            continue
        work.joints[name] = replace(joint, drive=_stronger(drive, (back, out), (slow, fast)))
        for cylinder in own:
            if cylinder.slide == name:
                new = work.cylinders[cylinder.name]
                work.cylinders[cylinder.name] = replace(new, speed=new.speed * fast)


def _ratios(work: Changed, own: Sequence[Cylinder], alike: Sequence[bool]) -> tuple[float, float, float, float]:
    """Force out and back, area out and back, of cylinders together, against the base's. `alike`: which of them extend
    where the first does."""

    def together(of: Any) -> list[float]:
        pairs = [of(c) for c in own]
        return [sum(p[w if same else 1 - w] for p, same in zip(pairs, alike, strict=True)) for w in (0, 1)]

    def forces(c: Cylinder) -> tuple[float, float]:
        return c.push_force or 1.0, c.pull_force or 1.0

    new = [together(lambda c, of=of: of(work.cylinders[c.name])) for of in (forces, _areas)]
    old = [together(of) for of in (forces, _areas)]
    (out, back), (wide, narrow) = ([a / b for a, b in zip(n, o, strict=True)] for n, o in zip(new, old, strict=True))
    return out, back, wide, narrow


def _stronger(drive: Drive, forces: tuple[float, float], speeds: tuple[float, float]) -> Drive:
    """A drive with forces and speeds of both ways times so much."""
    (back, out), (slow, fast) = forces, speeds
    reverse_force = drive.forces[0] * back
    reverse_speed = drive.speeds[0] * slow
    return replace(
        drive,
        max_force=drive.max_force * out,
        max_velocity=drive.max_velocity * fast,
        reverse_force=None if drive.reverse_force is None and back == out else reverse_force,
        reverse_velocity=None if drive.reverse_velocity is None and slow == fast else reverse_speed,
    )
