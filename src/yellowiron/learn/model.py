"""The machine in MuJoCo by its own MJCF, with the colliders that a task needs: the ground's and the tool's."""

from __future__ import annotations

import functools
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import mujoco
import numpy as np

from yellowiron.exporters import BodyGeometry, Geometry, actuator_names, export_mjcf, read_geometry
from yellowiron.hydraulics import Hydraulics
from yellowiron.kinematics import ClosedChain
from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Mechanism, Site
from yellowiron.simulation.ground import standing_bodies
from yellowiron.simulation.payload import load_site, tool
from yellowiron.usd import read_mechanism

Base = Literal["fixed", "floating"]
TIMESTEP = 0.002
"""Seconds. Pins hold within some hundredths of a millimetre up to twice that."""
BOULDER = "boulder"
"""The name of a body that a task may load."""
ROCK = 2600.0
"""kg/m³."""
_RUBS = (0.7, 0.005)
"""Its friction, sliding and turning on the spot."""
_ROLLS = 0.3
"""Of its radius: how far the ground's push stands ahead of its middle as it rolls. A rock has flat sides."""
_SHARE = 0.2
"""A boulder's radius, of the tool's shortest extent."""
_SIZES = (0.12, 0.5)
"""Metres: a boulder's least and greatest radius."""
_MOVED = 1e-6
"""A lever moves a body that its cylinder, a tenth of the stroke on, displaces by more than this, metres."""


@dataclass(frozen=True, eq=False)
class Lever:
    """What one action is: an actuator with its `controls` in the model. A motor's `speed` is that of its full lever,
    rad/s; a cylinder's is None: its oil is the hydraulics'."""

    name: str
    controls: tuple[int, ...]
    joints: tuple[str, ...]
    speed: float | None = None


@dataclass(frozen=True, eq=False)
class MachineModel:
    """A machine to be stepped: `model` is shared by all environments, each has an `MjData` of its own. `tip` is the
    site of the tool that is farthest from its joint, `middle` that of its load. `digging` and `driving` are the levers
    that move the tool and the machine."""

    mechanism: Mechanism
    model: Any
    levers: Mapping[str, Lever]
    tip: Site
    middle: Site
    digging: tuple[str, ...]
    driving: tuple[str, ...]
    boulder: float = 0.0

    def oil(self) -> Hydraulics | None:
        """A new pump with its valves; None for a machine that has motors alone."""
        try:
            return Hydraulics(self.mechanism)
        except YellowironError:
            return None


def load_machine(
    machine: str | Path, *, base: Base = "floating", boulder: bool = False, timestep: float = TIMESTEP
) -> MachineModel:
    """A machine's USD file as a model. What stands on the ground touches it; the tool's colliders are there with a
    `boulder`, a ball of rock a fifth of the tool's size. Kept for the process while the file stays as it is.

    `YellowironError` for a file without a machine, or one without a tool.
    """
    file = Path(machine)
    stamp = file.stat().st_mtime_ns if file.exists() else 0
    return _load(file.resolve(), stamp, base, boulder, timestep)


@functools.lru_cache(maxsize=8)
def _load(file: Path, _: int, base: Base, boulder: bool, timestep: float) -> MachineModel:
    mechanism = read_mechanism(file)
    own = tool(mechanism)
    standing = standing_bodies(mechanism) if base == "floating" else ()
    touching = {*standing, *([own.name] if boulder else [])}
    whole = read_geometry(file) if touching else Geometry()
    shapes = Geometry({n: BodyGeometry((), g.colliders) for n, g in whole.bodies.items() if n in touching})
    radius = _radius(np.asarray(own.hull)) if boulder else 0.0
    with tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
        written = export_mjcf(mechanism, shapes, Path(folder), base=base, timestep=timestep)
        spec = mujoco.MjSpec.from_file(str(written if base == "fixed" else written.with_name("scene.xml")))
        if boulder:
            # The keyframe is of the machine alone: it is given again by the environment.
            body = spec.worldbody.add_body(name=BOULDER)
            body.add_freejoint(name=BOULDER)
            mass = ROCK * 4.0 / 3.0 * np.pi * radius**3
            body.add_geom(
                name=BOULDER,
                type=mujoco.mjtGeom.mjGEOM_SPHERE,
                size=[radius, 0.0, 0.0],
                mass=mass,
                condim=6,
                friction=[*_RUBS, _ROLLS * radius],
            )
        for key in list(spec.keys):
            spec.delete(key)
        model = spec.compile()
    chain = ClosedChain(mechanism)
    levers = _levers(mechanism, model)
    middle = load_site(mechanism)
    tip = max(
        (site for site in mechanism.sites if site.body == own.name and site is not middle),
        key=lambda site: float(np.linalg.norm(np.subtract(site.position, own.origin))),
        default=middle,
    )
    if tip is None:
        raise YellowironError(
            "The machine has no site on its tool", where=str(file), hint="Give the tool a site in the template."
        )
    on_ground = standing_bodies(mechanism)
    digging = tuple(name for name, lever in levers.items() if _moves(chain, mechanism, lever, (own.name,)))
    driving = tuple(name for name, lever in levers.items() if _drives(chain, mechanism, lever, on_ground))
    return MachineModel(mechanism, model, levers, tip, middle or tip, digging, driving, radius)


def _radius(hull: Any) -> float:
    extents = np.ptp(hull, axis=0) if len(hull) else np.ones(3)
    return float(np.clip(_SHARE * extents.min(), *_SIZES))


def _levers(mechanism: Mechanism, model: Any) -> dict[str, Lever]:
    """What can be commanded: cylinders with a rated speed, and motors."""
    try:
        circuits = Hydraulics(mechanism).circuits
    except YellowironError:
        circuits = {}
    levers = {}
    for actuator in mechanism.actuators:
        controls = actuator_names(mechanism)[actuator.name]
        numbers = tuple(int(model.actuator(name).id) for name in controls)
        if actuator.name in circuits:
            levers[actuator.name] = Lever(actuator.name, numbers, tuple(controls.values()))
        elif actuator.kind == "motor" and numbers:
            ranges = np.abs(model.actuator_ctrlrange[list(numbers)])
            speed = float(ranges.min()) if (ranges > 0.0).all() else 1.0
            levers[actuator.name] = Lever(actuator.name, numbers, tuple(controls.values()), speed)
    return levers


def _moves(chain: ClosedChain, mechanism: Mechanism, lever: Lever, bodies: tuple[str, ...]) -> bool:
    """Whether a lever displaces any of some bodies against the machine's root, from the drawn pose."""
    for name in lever.joints:
        joint = mechanism.joint(name)
        if name not in chain.independent:
            continue
        ends = [e for e in (joint.lower, joint.upper) if e is not None]
        way = 0.1 * max(ends, key=abs) if ends else 0.1
        state, _ = chain.reach({name: way})
        for body in bodies:
            moved = chain.displacement(state, body)
            corners = np.asarray(mechanism.body(body).hull).reshape(-1, 3)
            points = np.vstack([corners, [mechanism.body(body).origin]])
            if float(np.abs(points @ moved[:3, :3].T + moved[:3, 3] - points).max()) > _MOVED:
                return True
    return False


def _drives(chain: ClosedChain, mechanism: Mechanism, lever: Lever, standing: tuple[str, ...]) -> bool:
    """Whether a lever turns what stands on the ground, or hidden wheels in it: by a motor, or as steering does."""
    turned = {mechanism.joint(name).body1 for name in lever.joints}
    if lever.speed is not None:
        return bool(turned & set(standing))
    wheels = tuple(
        joint.body1
        for joint in mechanism.joints
        if joint.body1 in standing and joint.drive is not None and joint.drive.kind == "velocity"
    )
    return bool(wheels) and _moves(chain, mechanism, lever, wheels)
