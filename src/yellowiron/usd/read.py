"""Reads a machine back: the `Mechanism` that its USD file was written from, or that a person has edited since.

Numbers are kept twice: in the schemas' attributes, mostly single precision, and exactly in `customData`. The exact one
is used where it rounds to what the attribute says; elsewhere someone edited the attribute, and the attribute wins.
"""

from __future__ import annotations

import typing
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdPhysics, UsdUtils

from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, BodyPart, BodyShape, Drive, Joint, Mechanism, Site, Spring
from yellowiron.model.template import Follows, JointType, by_first_leader
from yellowiron.support.record import ENDLESS, RECORD
from yellowiron.support.vectors import triple
from yellowiron.usd.authoring.metadata import DOCUMENTS, FORMAT, from_json
from yellowiron.usd.authoring.rotation import axis_of, principal_axes
from yellowiron.usd.layers.drives import INSTANCES, per_usd_unit, to_usd_unit
from yellowiron.usd.layers.mujoco import MIMIC, MIMIC_NAMES
from yellowiron.usd.layers.sensors import read_sensors
from yellowiron.usd.planning.pin_links import KIND as PIN_LINK
from yellowiron.usd.planning.plan import HULL, HULL_SCALE, JOINTS, VISUALS

_SUFFIXES = {".usd", ".usda", ".usdc", ".usdz"}
_BUILD_HINT = "Give the machine file or the scene.usda that `yellowiron build` wrote."
_SINGLE = 2.0**-22
"""Relative distance within which a double and a single-precision attribute say the same."""


def read_mechanism(path: str | Path) -> Mechanism:
    """The mechanism in a machine file, or in a scene that holds one. SI, machine frame, drawn pose.

    `YellowironError` where the file is no USD, references that it needs are missing, or there is no machine of ours.
    """
    stage = open_stage(path)
    prim = find_machine(stage, str(path))
    with _quiet(), Usd.EditContext(stage, stage.GetSessionLayer()):
        for name, choice in (("Physics", "on"), ("Base", "floating")):
            if prim.GetVariantSets().HasVariantSet(name):
                prim.GetVariantSet(name).SetVariantSelection(choice)
    _check_composition(stage, str(path))
    try:
        return _Reader(stage, prim).read()
    except (AttributeError, KeyError, TypeError, ValueError, Tf.ErrorException) as error:
        # What a prim of ours holds is not there, or not of its type: someone removed it, or the file is damaged.
        raise YellowironError(
            "The machine's data is damaged", where=str(path), hint=f"Build the machine again. USD says: {_short(error)}"
        ) from error


def open_stage(path: str | Path) -> Usd.Stage:
    """The composed stage of a USD file; `YellowironError` where it is none or does not compose."""
    file = Path(path)
    if not file.is_file():
        words = "This is a folder, not a file" if file.is_dir() else "There is no such file"
        raise YellowironError(words, where=str(path), hint=_BUILD_HINT)
    if file.suffix.lower() not in _SUFFIXES:
        raise YellowironError(
            "This is not a USD file", where=str(path), hint="USD files end in .usd, .usda, .usdc, .usdz."
        )
    try:
        with _quiet():
            stage = Usd.Stage.Open(str(file))
    except Tf.ErrorException as error:
        raise YellowironError(
            "The file cannot be read as USD", where=str(path), hint="It is damaged or is not USD; write it again."
        ) from error
    _check_composition(stage, str(path))
    return stage


@contextmanager
def _quiet() -> Iterator[None]:
    """Keeps USD from printing a line for each reference that leads nowhere: the error that is raised names one."""
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    try:
        yield
    finally:
        del delegate


def _check_composition(stage: Usd.Stage, where: str) -> None:
    try:
        words = [_short(error) for error in stage.GetCompositionErrors()]
    except UnicodeDecodeError as error:
        # A damaged layer is quoted with the bytes that are no text.
        words = [_short(error.object.decode("utf-8", errors="replace"))]
    if words:
        raise YellowironError(
            "The file refers to something that is not there, or is damaged",
            where=where,
            hint=f"Keep it together with its payloads folder. USD says: {words[0]}",
        )


def _short(words: object) -> str:
    """The first words of what USD says, on one line."""
    return " ".join(str(words).split())[:300]


def find_machine(stage: Usd.Stage, where: str) -> Usd.Prim:
    """The prim of our machine on a stage; `YellowironError`, which says `where`, if there is none of this form."""
    candidates: Iterable[Usd.Prim] = stage.Traverse()
    default = stage.GetDefaultPrim()
    if default:
        candidates = (default, *default.GetChildren(), *candidates)
    for prim in candidates:
        data = prim.GetCustomDataByKey(RECORD)
        if data and "equipmentType" in data:
            if data.get("format") != FORMAT:
                raise YellowironError(
                    f"The machine is written in form {data.get('format')}, and this version reads form {FORMAT}",
                    where=where,
                    hint="Build the machine again, or use the version that wrote it.",
                )
            return prim
    raise YellowironError("There is no yellowiron machine in the file", where=where, hint=_BUILD_HINT)


class _Reader:
    """One machine prim on its stage. Positions are read relative to the machine's prim, wherever it stands."""

    def __init__(self, stage: Usd.Stage, prim: Usd.Prim) -> None:
        self._stage = stage
        self._prim = prim
        self._cache = UsdGeom.XformCache()
        self._names: dict[Sdf.Path, str] = {}
        self._built_follows: dict[str, Follows] = {}

    def read(self) -> Mechanism:
        data = self._prim.GetCustomDataByKey(RECORD)
        body_prims = [p for p in self._prim.GetChildren() if _kind(p) == "body"]
        self._names = {p.GetPath(): str(_data(p)["name"]) for p in body_prims}
        self._names |= {p.GetPath(): str(_data(p)["name"]) for p in self._prim.GetChildren() if _kind(p) == PIN_LINK}
        bodies = tuple(self._body(p) for p in body_prims)
        scope = self._prim.GetChild(JOINTS)
        joint_prims = [p for p in scope.GetChildren() if _kind(p) == "joint"] if scope else []
        records = [_data(p) for p in joint_prims]
        self._built_follows = {str(r["name"]): from_json(Follows, r["follows"]) for r in records if "follows" in r}
        hints = typing.get_type_hints(Mechanism)
        return Mechanism(
            name=str(data["name"]),
            equipment_type=str(data["equipmentType"]),
            root=str(data["root"]),
            bodies=bodies,
            joints=tuple(self._joint(p) for p in joint_prims),
            sites=tuple(s for p in body_prims for s in self._sites(p)),
            sensors=read_sensors(self._prim, self._cache),
            **{name: from_json(hints[name], data[name]) for name in DOCUMENTS if name in data},
        )

    def _body(self, prim: Usd.Prim) -> Body:
        data = _data(prim)
        mass = UsdPhysics.MassAPI(prim)
        origin = self._origin(prim)
        recorded = np.array(data["centerOfMass"])
        center = _exact(_array(mass.GetCenterOfMassAttr()) + origin, recorded, scale=np.abs(recorded - origin))
        inertia = np.array(data["inertia"], dtype=np.float64)
        moments, axes = principal_axes(inertia)
        written = _array(mass.GetDiagonalInertiaAttr())
        rotation = mass.GetPrincipalAxesAttr().Get()
        turned = Gf.Matrix3d(Gf.Rotation(Gf.Quatd(rotation)))
        if not (_same(written, np.array(moments)) and _same_rotation(Gf.Quatd(rotation), Gf.Quatd(*axes))):
            columns = np.array(turned).T
            inertia = columns @ np.diag(written) @ columns.T
        return Body(
            name=str(data["name"]),
            origin=triple(origin),
            mass=_number(mass.GetMassAttr(), data["mass"]),
            center_of_mass=triple(center),
            inertia=inertia,
            parts=tuple(self._parts(prim)),
            hull=self._hull(prim, origin),
            source=str(data.get("source", "")),
            shapes=from_json(tuple[BodyShape, ...], data["shapes"]) if "shapes" in data else (),
            pads=from_json(tuple[BodyShape, ...], data["pads"]) if "pads" in data else (),
        )

    def _origin(self, prim: Usd.Prim) -> Floats:
        matrix, _ = self._cache.ComputeRelativeTransform(prim, self._prim)
        return np.array(matrix.ExtractTranslation())

    def _parts(self, body: Usd.Prim) -> Iterator[BodyPart]:
        scope = body.GetChild(VISUALS)
        for prim in scope.GetChildren() if scope else ():
            if _kind(prim) == "part":
                data = _data(prim)
                yield BodyPart(
                    part=str(data["part"]),
                    role=data.get("role"),
                    material=str(data.get("material", "")),
                    collision=str(data.get("collision", "")),
                    mass=float(data["mass"]),
                    source=str(data.get("source", "")),
                    pooled=bool(data.get("pooled", False)),
                )

    def _hull(self, body: Usd.Prim, origin: Floats) -> Floats:
        points = body.GetChild(HULL).GetAttribute("yellowiron:points") if body.GetChild(HULL) else None
        stored = points.Get() if points else None
        if stored is None:
            return np.zeros((0, 3))
        scale = body.GetChild(HULL).GetAttribute(HULL_SCALE)
        factors = np.array(scale.Get(), dtype=np.float64) if scale and scale.HasAuthoredValue() else np.ones(3)
        return np.array(stored, dtype=np.float64).reshape(-1, 3) * factors + origin

    def _sites(self, body: Usd.Prim) -> Iterator[Site]:
        for prim in body.GetChildren():
            if _kind(prim) == "site":
                data = _data(prim)
                matrix, _ = self._cache.ComputeRelativeTransform(prim, self._prim)
                x, z = (matrix.TransformDir(axis).GetNormalized() for axis in (Gf.Vec3d.XAxis(), Gf.Vec3d.ZAxis()))
                yield Site(
                    name=str(data["name"]),
                    body=self._names[body.GetPath()],
                    position=triple(_exact(np.array(matrix.ExtractTranslation()), np.array(data["position"]))),
                    x_axis=triple(_exact(np.array(x), np.array(data["xAxis"]), scale=1.0)),
                    z_axis=triple(_exact(np.array(z), np.array(data["zAxis"]), scale=1.0)),
                    source=str(data.get("source", "")),
                )

    def _joint(self, prim: Usd.Prim) -> Joint:
        data = _data(prim)
        kind: JointType = data["type"]
        joint = UsdPhysics.Joint(prim)
        names = [self._joined(rel, prim) for rel in (joint.GetBody0Rel(), joint.GetBody1Rel())]
        origin = self._origin(self._stage.GetPrimAtPath(joint.GetBody0Rel().GetTargets()[0]))
        recorded = np.array(data["anchor"])
        anchor = _array(joint.GetLocalPos0Attr()) + origin
        rotation = Gf.Quatd(joint.GetLocalRot0Attr().Get())
        imaginary = rotation.GetImaginary()
        axis = np.array(axis_of((rotation.GetReal(), imaginary[0], imaginary[1], imaginary[2])))
        lower, upper = self._limits(prim, kind, data)
        drive = data.get("drive")
        return Joint(
            name=str(data["name"]),
            type=kind,
            body0=names[0],
            body1=names[1],
            anchor=triple(_exact(anchor, recorded, scale=np.abs(recorded - origin))),
            axis=triple(_exact(axis, np.array(data["axis"]), scale=1.0)),
            lower=lower,
            upper=upper,
            cut=bool(joint.GetExcludeFromArticulationAttr().Get())
            and (not data.get("floating") or bool(data.get("cut"))),
            free=bool(data.get("free", False)),
            drive=None if drive is None else _drive(prim, kind, from_json(Drive, drive)),
            source=from_json(dict, data["evidence"]) if "evidence" in data else {},
            follows=self._follows(prim, kind, data),
            spring=_spring(prim, kind, data),
            armature=float(data.get("armature", 0.0)),
        )

    def _follows(self, prim: Usd.Prim, kind: str, data: Any) -> Follows | None:
        """What the joint follows: as recorded, unless its attributes, which name the chain's first leader, were
        edited."""
        # Unregistered schemas, as Newton's mostly are, are in the metadata only.
        applied = prim.GetMetadata("apiSchemas")
        if applied is None or MIMIC not in applied.GetAppliedItems() or _said(prim, "Enabled", True) is False:
            return None
        relation = prim.GetRelationship(f"{MIMIC_NAMES}Joint")
        targets = [self._stage.GetPrimAtPath(path) for path in (relation.GetTargets() if relation else [])]
        if len(targets) != 1 or not targets[0] or _kind(targets[0]) != "joint":
            raise YellowironError(
                "A joint that follows has no leader among the machine's joints",
                where=str(prim.GetPath()),
                hint=f"{MIMIC_NAMES}Joint names the one joint that it follows; without {MIMIC} it follows none.",
            )
        leader, factor = str(_data(targets[0])["name"]), to_usd_unit(kind)
        ratio, offset = float(_said(prim, "Coef1", 1.0)), float(_said(prim, "Coef0", 0.0)) / factor
        name, built = str(data["name"]), self._built_follows
        if name not in built:
            return Follows(leader, ratio, offset)
        told = by_first_leader(name, built)
        unedited = told.joint == leader and _same(ratio, told.ratio) and _same(offset, told.offset)
        return built[name] if unedited else Follows(leader, ratio, offset, told.kind)

    def _joined(self, relationship: Usd.Relationship, joint: Usd.Prim) -> str:
        targets = relationship.GetTargets()
        if len(targets) != 1 or targets[0] not in self._names:
            raise YellowironError(
                "A joint does not join two bodies of the machine",
                where=str(joint.GetPath()),
                hint=f"Its {relationship.GetName()} has the targets {[str(t) for t in targets]}.",
            )
        return self._names[targets[0]]

    def _limits(self, prim: Usd.Prim, kind: str, data: Any) -> tuple[float | None, float | None]:
        """What the attributes say, exactly where they are unedited; from the record where this type has none."""
        lower, upper = data.get("lower"), data.get("upper")
        names = {
            "PhysicsRevoluteJoint": ("physics:lowerLimit", "physics:upperLimit"),
            "PhysicsPrismaticJoint": ("physics:lowerLimit", "physics:upperLimit"),
            "PhysicsDistanceJoint": ("physics:minDistance", "physics:maxDistance"),
        }.get(prim.GetTypeName())
        if names is None:
            return lower, upper
        factor = to_usd_unit(kind)
        return _limit(prim, names[0], lower, factor), _limit(prim, names[1], upper, factor)


def _said(prim: Usd.Prim, name: str, default: Any) -> Any:
    """An attribute of a joint that follows; the schema's default where it is not authored."""
    attribute = prim.GetAttribute(f"{MIMIC_NAMES}{name}")
    return attribute.Get() if attribute and attribute.HasAuthoredValue() else default


def _limit(prim: Usd.Prim, name: str, recorded: float | None, factor: float) -> float | None:
    attribute = prim.GetAttribute(name)
    if not attribute.HasAuthoredValue():
        return None
    value = float(attribute.Get())
    if recorded is not None and _same(value, recorded * factor):
        return recorded
    return value / factor if abs(value) < ENDLESS else None


def _drive(prim: Usd.Prim, kind: str, recorded: Drive) -> Drive:
    """The recorded drive, with what was edited in its attributes."""
    if kind not in INSTANCES:
        return recorded
    api = UsdPhysics.DriveAPI(prim, INSTANCES[kind])
    if not api or not prim.HasAPI(UsdPhysics.DriveAPI, INSTANCES[kind]):
        return recorded
    factor = per_usd_unit(kind)
    stiffness = recorded.stiffness
    if recorded.kind == "position":
        stiffness = _number(api.GetStiffnessAttr(), recorded.stiffness, factor)
    damping = _number(api.GetDampingAttr(), recorded.damping, factor)
    drive = replace(recorded, stiffness=stiffness, damping=damping)
    strongest = _number(api.GetMaxForceAttr(), recorded.strongest)
    if strongest != recorded.strongest:  # edited: the attribute limits both ways
        drive = replace(drive, max_force=strongest, reverse_force=None)
    return drive


def _spring(prim: Usd.Prim, kind: str, data: Any) -> Spring | None:
    """The recorded spring, with the gains that were edited in its attributes; None where it was taken off."""
    if "spring" not in data or kind not in INSTANCES or not prim.HasAPI(UsdPhysics.DriveAPI, INSTANCES[kind]):
        return None
    recorded = from_json(Spring, data["spring"])
    api, factor = UsdPhysics.DriveAPI(prim, INSTANCES[kind]), per_usd_unit(kind)
    stiffness = _number(api.GetStiffnessAttr(), recorded.stiffness, factor)
    damping = _number(api.GetDampingAttr(), recorded.damping, factor)
    return replace(recorded, stiffness=stiffness, damping=damping)


def _kind(prim: Usd.Prim) -> str:
    data = prim.GetCustomDataByKey(RECORD)
    return str(data.get("kind", "")) if data else ""


def _data(prim: Usd.Prim) -> Any:
    return prim.GetCustomDataByKey(RECORD)


def _array(attribute: Usd.Attribute) -> Floats:
    return np.array(attribute.Get(), dtype=np.float64)


def _same(written: Floats | float, recorded: Floats | float, scale: Floats | float | None = None) -> bool:
    """Whether a recorded double rounds to the single-precision value of an attribute."""
    size = np.abs(recorded) if scale is None else scale
    with np.errstate(invalid="ignore"):
        close = np.abs(np.asarray(written) - recorded) <= _SINGLE * np.asarray(size) + 1e-30
    return bool(np.all(close | (np.asarray(written) == np.asarray(recorded))))


def _exact(written: Floats, recorded: Floats, scale: Floats | float | None = None) -> Floats:
    """The recorded value unless the attribute was edited; `scale` is the size of what was rounded."""
    allowed = np.max(np.abs(recorded) if scale is None else scale)
    return recorded if _same(written, recorded, float(allowed)) else written


def _number(attribute: Usd.Attribute, recorded: float, factor: float = 1.0) -> float:
    """A recorded number unless its attribute (= number x factor) was edited."""
    value = float(attribute.Get())
    return float(recorded) if _same(value, recorded * factor) else value / factor


def _same_rotation(first: Gf.Quatd, second: Gf.Quatd) -> bool:
    return bool(abs(abs(Gf.Dot(first, second)) - 1.0) < 1e-6)
