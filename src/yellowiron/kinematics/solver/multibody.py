"""Mechanism → MuJoCo model: the bodies as a tree, every cut as point connections, nothing else (no contacts, no
limits, no actuators), so that MuJoCo's constraint residual is the loop closure and nothing but it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from yellowiron.model.errors import MechanismError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Body, Joint, Mechanism

ARM = 0.5
"""Metres between a cut joint's first and further connection points: turns an angle between two axes into a gap."""
_SMALLEST_MASS = 1e-9
_UNIT = np.eye(3)
_HINT = "Build the machine again, or correct the joints of its template."
_KIND = {"revolute": "mjJNT_HINGE", "prismatic": "mjJNT_SLIDE", "spherical": "mjJNT_BALL"}


@dataclass(frozen=True, eq=False)
class Multibody:
    """A compiled model. `joints`: tree joint name → (first position index, first velocity index). `bodies`: body name →
    MuJoCo id. `cuts`: cut joint name → its connection points, rows of 3 in MuJoCo's residual, in order. `frames`
    (points, 3, 3): rows are the cut's axis and two normals to it, in the axes of `bases` (points,), the id of the
    cut's `body0`."""

    model: mujoco.MjModel
    joints: dict[str, tuple[int, int]]
    bodies: dict[str, int]
    cuts: dict[str, tuple[int, ...]]
    frames: Floats
    bases: np.ndarray


def build(mechanism: Mechanism) -> Multibody:
    """The model of a mechanism in its drawn pose. `MechanismError` where its joints are no tree from the root, or a
    joint's type has no place in one."""
    _check_joints(mechanism)
    leading = _leading_joints(mechanism)
    spec = mujoco.MjSpec()
    spec.option.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    spec.option.gravity = (0.0, 0.0, 0.0)
    spec.compiler.balanceinertia = True
    made = {mechanism.root: _add_body(spec.worldbody, mechanism.body(mechanism.root), np.zeros(3))}
    moving: list[str] = []
    for name, joint in leading.items():
        parent, body = mechanism.body(joint.body0), mechanism.body(name)
        made[name] = _add_body(made[parent.name], body, np.array(parent.origin))
        if joint.type != "fixed":
            made[name].add_joint(
                name=joint.name,
                type=getattr(mujoco.mjtJoint, _KIND[joint.type]),
                pos=np.array(joint.anchor) - np.array(body.origin),
                axis=_unit(joint),
            )
            moving.append(joint.name)
    cuts, frames, bases = _connect(spec, mechanism)
    try:
        model = spec.compile()
    except ValueError as error:
        raise MechanismError(
            f"the mechanism makes no multibody model: {str(error).splitlines()[0]}",
            where=mechanism.name,
            hint=_HINT,
        ) from error
    addresses = {n: (int(model.joint(n).qposadr[0]), int(model.joint(n).dofadr[0])) for n in moving}
    ids = {body.name: int(model.body(body.name).id) for body in mechanism.bodies}
    return Multibody(model, addresses, ids, cuts, frames, np.array([ids[name] for name in bases], dtype=np.intp))


def transverse(axis: Sequence[float]) -> Floats:
    """Rows (3, 3): the unit axis and two unit vectors that complete a right-handed frame; the same for the same
    axis."""
    a = np.array(axis, dtype=np.float64)
    a /= np.linalg.norm(a)
    helper = np.zeros(3)
    helper[int(np.argmin(np.abs(a)))] = 1.0
    b = np.cross(a, helper)
    b /= np.linalg.norm(b)
    return np.array([a, b, np.cross(a, b)])


def _check_joints(mechanism: Mechanism) -> None:
    """`MechanismError` where a joint names no body, a slide is cut or a distance joint is not."""
    known = {body.name for body in mechanism.bodies}
    if mechanism.root not in known:
        raise MechanismError(f"the root body '{mechanism.root}' does not exist", where=mechanism.name, hint=_HINT)
    for joint in mechanism.joints:
        for end in (joint.body0, joint.body1):
            if end not in known:
                raise MechanismError(
                    f"the joint names a body '{end}' that does not exist", where=joint.name, hint=_HINT
                )
        if joint.cut and joint.type == "prismatic":
            raise MechanismError(
                "a slide is cut, and cylinders must stay in the tree", where=joint.name, hint="Cut a pivot of its loop."
            )
    for joint in mechanism.joints:
        if joint.type == "distance" and not joint.cut:
            raise MechanismError(
                "a distance joint cannot hold a body in the tree", where=joint.name, hint="Mark it as a cut."
            )


def _leading_joints(mechanism: Mechanism) -> dict[str, Joint]:
    """Body → the tree joint that leads to it, parents before children. `MechanismError` where there is no such tree."""
    leading: dict[str, Joint] = {}
    for joint in (joint for joint in mechanism.joints if not joint.cut):
        if joint.body1 in leading or joint.body1 == mechanism.root:
            raise MechanismError(
                f"two tree joints lead to the body '{joint.body1}'", where=joint.name, hint="Cut one of them."
            )
        leading[joint.body1] = joint
    loose = [body.name for body in mechanism.bodies if body.name not in leading and body.name != mechanism.root]
    if loose:
        raise MechanismError(
            "no joint leads to the body from the root", where=loose[0], hint="Join it, or weld it to another body."
        )
    ordered: dict[str, Joint] = {}
    reached, waiting = {mechanism.root}, dict(leading)
    while waiting:
        ready = [name for name, joint in waiting.items() if joint.body0 in reached]
        if not ready:
            raise MechanismError(
                "the tree joints form a ring away from the root", where=next(iter(waiting)), hint=_HINT
            )
        for name in ready:
            ordered[name] = waiting.pop(name)
            reached.add(name)
    return ordered


def _add_body(parent: mujoco.MjsBody, body: Body, parent_origin: Floats) -> mujoco.MjsBody:
    origin = np.array(body.origin, dtype=np.float64)
    inertia = 0.5 * (np.asarray(body.inertia, dtype=np.float64) + np.asarray(body.inertia, dtype=np.float64).T)
    values, vectors = np.linalg.eigh(inertia)
    floor = max(_SMALLEST_MASS, 1e-9 * float(values.max()))
    if values.min() < floor:
        inertia = (vectors * np.maximum(values, floor)) @ vectors.T
    return parent.add_body(
        name=body.name,
        pos=origin - parent_origin,
        mass=max(body.mass, _SMALLEST_MASS),
        ipos=np.array(body.center_of_mass) - origin,
        fullinertia=[inertia[0, 0], inertia[1, 1], inertia[2, 2], inertia[0, 1], inertia[0, 2], inertia[1, 2]],
        explicitinertial=True,
    )


def _connect(spec: mujoco.MjSpec, mechanism: Mechanism) -> tuple[dict[str, tuple[int, ...]], Floats, list[str]]:
    """Point connections of every cut: one for a ball, two along the axis for a revolute joint, three for a weld."""
    origins = {body.name: np.array(body.origin, dtype=np.float64) for body in mechanism.bodies}
    cuts: dict[str, tuple[int, ...]] = {}
    frames: list[Floats] = []
    bases: list[str] = []
    for joint in mechanism.joints:
        if not joint.cut or joint.type == "distance":
            continue
        frame = transverse(joint.axis)
        anchor = np.array(joint.anchor, dtype=np.float64)
        points = {
            "spherical": [anchor],
            "revolute": [anchor, anchor + ARM * frame[0]],
            "fixed": [anchor, anchor + ARM * frame[0], anchor + ARM * frame[1]],
        }[joint.type]
        first = len(bases)
        for number, point in enumerate(points):
            equality = spec.add_equality(
                name=f"{joint.name}:{number}",
                type=mujoco.mjtEq.mjEQ_CONNECT,
                objtype=mujoco.mjtObj.mjOBJ_BODY,
                name1=joint.body0,
                name2=joint.body1,
            )
            data = np.zeros(len(equality.data))
            data[:3] = point - origins[joint.body0]
            equality.data = data
            frames.append(frame)
            bases.append(joint.body0)
        cuts[joint.name] = tuple(range(first, len(bases)))
    return cuts, np.array(frames).reshape(-1, 3, 3), bases


def _unit(joint: Joint) -> Floats:
    axis = np.array(joint.axis, dtype=np.float64)
    length = float(np.linalg.norm(axis))
    if not 1e-6 < length < np.inf:
        raise MechanismError("the joint has no axis", where=joint.name, hint=_HINT)
    return axis / length


def reduced_masses(model: mujoco.MjModel, data: mujoco.MjData, tangents: Floats) -> tuple[Floats, Floats]:
    """The mass matrix in the coordinates whose unit velocities are the columns of `tangents` (nv, n), with the root
    held and with the root free, `data` being at the pose with its centres of mass known.

    Free, the root moves so that all momentum is 0: of the kinetic energy, that of the whole's own motion is taken off
    (its mass at its centre of mass, its inertia about it).
    """
    mujoco.mj_makeM(model, data)
    momenta, turns = np.zeros(model.nv), tangents.T
    held = np.empty((len(turns), len(turns)))
    for column, tangent in enumerate(np.ascontiguousarray(turns)):
        mujoco.mj_mulM(model, data, momenta, tangent)
        held[:, column] = turns @ momenta
    linear, angular = np.zeros((3, model.nv)), np.zeros((3, model.nv))
    mujoco.mj_jacSubtreeCom(model, data, linear, 0)
    mujoco.mj_angmomMat(model, data, angular, 0)
    moved, turned = linear @ tangents, angular @ tangents
    arms, masses = data.xipos - data.subtree_com[0], model.body_mass
    axes = data.ximat.reshape(-1, 3, 3)
    inertia = np.einsum("bij,bj,bkj->ik", axes, model.body_inertia, axes)
    inertia += np.einsum("b,bij->ij", masses, (arms**2).sum(axis=1)[:, None, None] * _UNIT)
    inertia -= np.einsum("b,bi,bj->ij", masses, arms, arms)
    whole = float(model.body_subtreemass[0]) * moved.T @ moved + turned.T @ np.linalg.lstsq(inertia, turned)[0]
    return held, held - whole
