"""What USD has no word for: written as `customData` under `yellowiron`, so that a machine's file alone gives its
mechanism back."""

from __future__ import annotations

import collections.abc
import functools
import json
import types
import typing
from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Vt

from yellowiron.model.errors import YellowironError
from yellowiron.model.machine_tests import SPARSE
from yellowiron.model.mechanism import Body, BodyPart, Joint, Mechanism, Site
from yellowiron.model.sensor import Sensor
from yellowiron.model.template import UNDECIDED
from yellowiron.support.record import RECORD

FORMAT = 1
"""The version of the form that `describe_machine` writes and `read` understands."""

DOCUMENTS = (
    "cylinders",
    "actuators",
    "loops",
    "materials",
    "measurements",
    "payload",
    "tests",
    "specifications",
    "mobility",
    "floating",
    "findings",
)
"""Fields of the mechanism that travel as JSON texts on the machine's prim."""


def set_custom(spec: Sdf.PrimSpec, values: Mapping[str, Any]) -> None:
    """Writes `customData = {dictionary yellowiron = values}`; None values are left out."""
    spec.SetInfo("customData", {RECORD: {k: v for k, v in values.items() if v is not None and v != ""}})


def describe_machine(mechanism: Mechanism) -> dict[str, Any]:
    """The machine's customData: names, and the fields in `DOCUMENTS` as JSON texts."""
    return {
        "format": FORMAT,
        "name": mechanism.name,
        "equipmentType": mechanism.equipment_type,
        "root": mechanism.root,
        **{name: to_json(getattr(mechanism, name)) for name in DOCUMENTS},
    }


def describe_body(body: Body) -> dict[str, Any]:
    """A body's customData: mass properties at full precision, in the machine's axes."""
    return {
        "kind": "body",
        "name": body.name,
        "mass": float(body.mass),
        "centerOfMass": Gf.Vec3d(*map(float, body.center_of_mass)),
        "inertia": Gf.Matrix3d(np.asarray(body.inertia, dtype=np.float64).tolist()),
        "source": body.source,
        "shapes": to_json(body.shapes) if body.shapes else None,
        "pads": to_json(body.pads) if body.pads else None,
    }


def describe_part(part: BodyPart) -> dict[str, Any]:
    """A visual's customData: which CAD part it is, and how that part takes part in its body."""
    return {
        "kind": "part",
        "part": part.part,
        "role": part.role,
        "material": part.material,
        "collision": part.collision,
        "mass": float(part.mass),
        "source": part.source,
        "pooled": part.pooled or None,
    }


def describe_collider(parts: Sequence[str]) -> dict[str, Any]:
    """The customData of a collider that stands for several CAD parts: their ids, largest first."""
    return {"kind": "collider", "parts": Vt.StringArray(list(parts))}


def describe_joint(joint: Joint, *, floating: bool = False) -> dict[str, Any]:
    """A joint's customData: as modelled (before a cut turned it into a spherical joint), radians and metres, with its
    evidence both readable (`source`) and exact (`evidence`, JSON). `floating`: it is in the tree of a chain that no
    joint ties to the machine, which is no part of its articulation."""
    return {
        "kind": "joint",
        "name": joint.name,
        "type": joint.type,
        "body0": joint.body0,
        "body1": joint.body1,
        "anchor": Gf.Vec3d(*map(float, joint.anchor)),
        "axis": Gf.Vec3d(*map(float, joint.axis)),
        "lower": joint.lower if joint.lower is None else float(joint.lower),
        "upper": joint.upper if joint.upper is None else float(joint.upper),
        "cut": joint.cut or None,
        "free": joint.free or None,
        "floating": floating or None,
        "follows": to_json(joint.follows) if joint.follows else None,
        "drive": to_json(joint.drive) if joint.drive else None,
        "spring": to_json(joint.spring) if joint.spring else None,
        "armature": joint.armature or None,
        "source": _readable(joint.source) or None,
        "evidence": to_json(joint.source) if joint.source else None,
    }


def describe_site(site: Site) -> dict[str, Any]:
    """A site's customData: its frame in the machine's, drawn pose."""
    return {
        "kind": "site",
        "name": site.name,
        "position": Gf.Vec3d(*map(float, site.position)),
        "xAxis": Gf.Vec3d(*map(float, site.x_axis)),
        "zAxis": Gf.Vec3d(*map(float, site.z_axis)),
        "source": site.source,
    }


def describe_sensor(sensor: Sensor) -> dict[str, Any]:
    """A sensor's customData: its type and parameters, for people and scripts; `read` has the exact record."""
    return {
        "kind": "sensor",
        "name": sensor.name,
        "type": sensor.type,
        "parameters": {key: float(value) for key, value in sensor.parameters.items()},
        "source": sensor.source,
    }


def _readable(source: Mapping[str, Any]) -> dict[str, Any]:
    """Evidence as a dictionary that a person can read in any USD viewer. ':' would nest, so no key keeps it."""
    made: dict[str, Any] = {}
    for key, value in source.items():
        name = str(key).replace(":", "_") or "_"
        if isinstance(value, Mapping):
            made[name] = _readable(value)
        elif isinstance(value, str | bool | int | float):
            made[name] = value
        elif isinstance(value, list | tuple) and value and all(isinstance(v, str) for v in value):
            made[name] = Vt.StringArray(list(value))
        elif value is not None:
            made[name] = to_json(value)
    return made


def to_json(value: Any) -> str:
    """A value of the model as JSON; numbers come back to the last bit."""
    return json.dumps(_plain(value), ensure_ascii=False, separators=(", ", ": "))


def _plain(value: Any) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        # A machine's variants are decided: its file has no use for what they were decided by.
        given = ((f, getattr(value, f.name)) for f in fields(value) if not f.metadata.get(UNDECIDED))
        return {f.name: _plain(each) for f, each in given if not (f.metadata.get(SPARSE) and each == f.default)}
    if isinstance(value, Mapping):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(v) for v in value]
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    return value


def from_json(kind: Any, text: str) -> Any:
    """A value of type `kind` (a model dataclass, or a tuple or mapping of them) from its JSON. `YellowironError` where
    the text does not fit."""
    try:
        return _build(kind, json.loads(text))
    except (json.JSONDecodeError, TypeError, KeyError, AttributeError, ValueError) as error:
        raise YellowironError("The machine's stored data is damaged", where=text[:60], hint=str(error)) from error


@functools.cache
def _hints(kind: type) -> dict[str, Any]:
    return typing.get_type_hints(kind)


def _build(kind: Any, value: Any) -> Any:
    origin, arguments = typing.get_origin(kind), typing.get_args(kind)
    if value is None or kind is Any:
        return value
    if isinstance(kind, type) and is_dataclass(kind):
        hints = _hints(kind)
        known = {f.name for f in fields(kind)}
        return kind(**{k: _build(hints[k], v) for k, v in value.items() if k in known})
    if origin in (typing.Union, types.UnionType):
        inner = [a for a in arguments if a is not type(None)]
        return _build(inner[0], value) if len(inner) == 1 else value
    if origin is tuple:
        repeated = len(arguments) == 2 and arguments[1] is Ellipsis
        return tuple(_build(a, v) for a, v in _pairs(arguments, repeated, value))
    if origin is collections.abc.Mapping:
        return {k: _build(arguments[1], v) for k, v in value.items()}
    return float(value) if kind is float else value


def _pairs(arguments: tuple[Any, ...], repeated: bool, value: list[Any]) -> list[tuple[Any, Any]]:
    if repeated:
        return [(arguments[0], v) for v in value]
    return list(zip(arguments, value, strict=True))
