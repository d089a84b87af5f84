"""A Python file with the machine's configuration for Isaac Lab: articulation, actuators, sensors, and what they are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Usd

from yellowiron.exporters.assets import plain
from yellowiron.exporters.geometry import Geometry
from yellowiron.exporters.values import axes_of, minus, quaternion
from yellowiron.model.errors import MechanismError
from yellowiron.model.mechanism import Joint, Mechanism, chained
from yellowiron.model.sensor import Sensor
from yellowiron.support.record import RECORD


def export_isaaclab(mechanism: Mechanism, usd_file: str | Path | Geometry, folder: Path) -> Path:
    """Writes `<machine>_cfg.py`, which has functions `articulation(usd_path)` and `sensors()` for Isaac Lab, and tables
    in SI of what they name; returns its path. Prims are named as the machine's USD file has them.

    Raises `MechanismError` where only the geometry of the machine is given.
    """
    if isinstance(usd_file, Geometry):
        raise MechanismError("A configuration names the prims of a USD file", where=mechanism.name, hint="Give it.")
    prims = _prims(usd_file)
    folder.mkdir(parents=True, exist_ok=True)
    name = plain(mechanism.name)
    path = folder / f"{name}_cfg.py"
    path.write_text("\n".join(_lines(mechanism, name, prims)) + "\n", encoding="utf-8")
    return path


def isaaclab_unsaid(mechanism: Mechanism) -> tuple[str, ...]:
    """What an articulation of Isaac Lab cannot say of a machine, one sentence each."""
    said = ["Isaac Lab has one force and one speed a joint: both ways' stand in RATED."]
    if any(joint.cut for joint in mechanism.joints):
        said.append("Cut pins are no joints of an articulation: they are listed in CUTS.")
    if any(joint.type == "spherical" and not joint.cut for joint in mechanism.joints):
        said.append("Balls in the tree have three coordinates that no actuator group names.")
    if mechanism.floating:
        said.append("Rings of track shoes are no part of the articulation.")
    return tuple(said)


def _prims(usd_file: str | Path) -> Mapping[str, str]:
    """Kind and name of what the machine's file records → its prim's path below the machine."""
    stage = Usd.Stage.Open(str(usd_file))
    machine = stage.GetDefaultPrim()
    found: dict[str, str] = {}
    for prim in Usd.PrimRange(machine):
        record = prim.GetCustomDataByKey(RECORD)
        if record and record.get("kind") in ("joint", "body", "sensor"):
            below = str(prim.GetPath())[len(str(machine.GetPath())) + 1 :]
            found[f"{record['kind']} {record['name']}"] = below
    return found


def _lines(mechanism: Mechanism, name: str, prims: Mapping[str, str]) -> Iterator[str]:
    loose = chained(mechanism)
    joints = {j.name: prims.get(f"joint {j.name}", j.name).rpartition("/")[2] for j in mechanism.joints}
    tree = [j for j in mechanism.joints if not j.cut and j.type in ("revolute", "prismatic") and j.body1 not in loose]
    driven = [j for j in tree if j.drive is not None]
    passive = [joints[j.name] for j in tree if j.drive is None and j.spring is None]
    springs = {joints[j.name]: float(f"{j.spring.rest:.9g}") for j in tree if j.spring is not None}
    names = {j.name for j in driven}
    groups = {a.name: [joints[e.joint] for e in a.joints if e.joint in names] for a in mechanism.actuators}
    groups = {actuator: own for actuator, own in groups.items() if own}
    limits = {joints[j.name]: [_round(j.lower), _round(j.upper)] for j in tree if j.lower is not None}
    sensors = [s for s in mechanism.sensors if s.type in _SENSORS and f"sensor {s.name}" in prims]
    kinds = sorted({_SENSORS[s.type][0] for s in sensors})

    yield f'"""{mechanism.name} in Isaac Lab, from the machine\'s USD file (metres, radians, N; 0 is the drawn pose).'
    yield ""
    yield f"    from {name}_cfg import articulation, sensors"
    yield f'    robot = articulation("/path/to/{name}.usda")'
    yield ""
    yield "Gains, forces and speeds are the file's. Reset to the drawn pose: joints of a loop depend on each other."
    yield '"""'
    yield ""
    yield "import isaaclab.sim as sim_utils"
    yield "from isaaclab.actuators import ImplicitActuatorCfg"
    yield "from isaaclab.assets import ArticulationCfg"
    if kinds:
        yield f"from isaaclab.sensors import {', '.join(kinds)}"
    yield ""
    yield f'PRIM_PATH = "{{ENV_REGEX_NS}}/{name}"'
    yield "DT = 1.0 / 120.0"
    yield '"""Seconds, for SimulationCfg(dt=DT). Leave PhysxCfg(solver_type=1), and give no articulation_props with'
    yield 'fewer solver iterations than the file has: they tear the loops."""'
    yield from _table("LEVERS", {a.name: {joints[e.joint]: e.sign for e in a.joints} for a in mechanism.actuators})
    yield '"""Lever → its joints, with the sign of each; of twins only the driven one is in ACTUATORS."""'
    yield from _table("ACTUATORS", groups)
    yield '"""Lever → the joints that it drives: position targets for cylinders, velocity targets for motors."""'
    yield from _table("PASSIVE", passive)
    yield '"""Joints that follow from the loops, or roll freely."""'
    if springs:
        yield from _table("SPRINGS", springs)
        yield '"""Joint → where its spring rests, on the ground: the position target to give it after every reset."""'
    yield from _table("CUTS", [joints[j.name] for j in mechanism.joints if j.cut])
    yield '"""Pins that close the loops: no coordinates of the articulation."""'
    yield from _table("LIMITS", limits)
    yield '"""Joint → its ends."""'
    yield from _table("RATED", {joints[j.name]: _rated(j) for j in driven})
    yield '"""Driven joint → largest forces and rated speeds, in the negative and the positive direction; gains."""'
    yield ""
    yield ""
    yield 'def articulation(usd_path: str, prim_path: str = PRIM_PATH, base: str = "floating") -> ArticulationCfg:'
    yield '    """The machine. `base`: floating, or fixed to the world."""'
    yield "    return ArticulationCfg("
    yield "        prim_path=prim_path,"
    yield "        spawn=sim_utils.UsdFileCfg("
    yield "            usd_path=usd_path,"
    yield '            variants={"Base": base, "Physics": "on"},'
    yield "            activate_contact_sensors=True,"
    yield "        ),"
    yield "        init_state=ArticulationCfg.InitialStateCfg("
    yield '            pos=(0.0, 0.0, 0.0), joint_pos={".*": 0.0}, joint_vel={".*": 0.0}'
    yield "        ),"
    yield "        soft_joint_pos_limit_factor=1.0,"
    yield "        actuators={"
    yield "            **{"
    yield "                lever: ImplicitActuatorCfg(joint_names_expr=names, stiffness=None, damping=None)"
    yield "                for lever, names in ACTUATORS.items()"
    yield "            },"
    if springs:
        gains = "stiffness=None, damping=None"
        yield f'            "springs": ImplicitActuatorCfg(joint_names_expr=list(SPRINGS), {gains}),'
    if passive:
        yield '            "passive": ImplicitActuatorCfg(joint_names_expr=PASSIVE, stiffness=0.0, damping=0.0),'
    yield "        },"
    yield "    )"
    if sensors:
        yield ""
        yield ""
        yield "def sensors(prim_path: str = PRIM_PATH) -> dict[str, object]:"
        yield '    """The sensors that the machine\'s file has and Isaac Lab knows, by name."""'
        yield "    return {"
        for sensor in sensors:
            kind, arguments = _SENSORS[sensor.type]
            yield f'        "{sensor.name}": {kind}('
            for argument in arguments(mechanism, sensor, prims):
                yield f"            {argument},"
            yield f"            update_period={1.0 / sensor.parameters['rate']:.6g},"
            yield "        ),"
        yield "    }"


def _table(name: str, value: Any) -> Iterator[str]:
    """A constant, an entry a line."""
    yield ""
    opening, closing = "{}" if isinstance(value, Mapping) else "[]"
    entries = (
        [f"{_shown(key)}: {_shown(each)}" for key, each in value.items()] if opening == "{" else map(_shown, value)
    )
    yield f"{name} = {opening}"
    yield from (f"    {entry}," for entry in entries)
    yield closing


def _shown(value: Any) -> str:
    return repr(value).replace("'", '"')


def _round(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.9g}")


def _rated(joint: Joint) -> dict[str, Any]:
    drive = joint.drive
    assert drive is not None
    return {
        "kind": drive.kind,
        "force": [float(f"{force:.6g}") if np.isfinite(force) else None for force in drive.forces],
        "speed": [float(f"{speed:.6g}") if np.isfinite(speed) else None for speed in drive.speeds],
        "stiffness": float(f"{drive.stiffness:.6g}"),
        "damping": float(f"{drive.damping:.6g}"),
        "armature": float(f"{drive.armature:.6g}"),
        "brake": float(f"{drive.brake:.6g}"),
    }


def _below(prims: Mapping[str, str], kind: str, name: str) -> str:
    return f'prim_path=f"{{prim_path}}/{prims[f"{kind} {name}"]}"'


def _camera(mechanism: Mechanism, sensor: Sensor, prims: Mapping[str, str]) -> Iterator[str]:
    yield _below(prims, "sensor", sensor.name)
    yield "spawn=None"
    yield f"width={round(sensor.parameters['width'])}"
    yield f"height={round(sensor.parameters['height'])}"
    yield 'data_types=["rgb", "distance_to_image_plane"]'


def _contact(mechanism: Mechanism, sensor: Sensor, prims: Mapping[str, str]) -> Iterator[str]:
    yield _below(prims, "body", sensor.body)


def _imu(mechanism: Mechanism, sensor: Sensor, prims: Mapping[str, str]) -> Iterator[str]:
    yield _below(prims, "body", sensor.body)
    place = minus(sensor.position, mechanism.body(sensor.body).origin)
    turned = quaternion(axes_of(sensor))
    yield f"offset=ImuCfg.OffsetCfg(pos={_numbers(place)}, rot={_numbers(turned)})"


def _numbers(values: Any) -> str:
    return "(" + ", ".join(repr(float(f"{value:.9g}") + 0.0) for value in values) + ")"


_SENSORS = {"camera": ("CameraCfg", _camera), "contact": ("ContactSensorCfg", _contact), "imu": ("ImuCfg", _imu)}
