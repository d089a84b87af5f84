"""Speeds and forces each way in Newton, whose MuJoCo solver knows no speed limit: two actuators of MuJoCo's a drive.

A servo, whose force range is what the damper takes at rated speed, and that damper: however far the target, the joint
goes no faster than rated, each way its own (`Drive.rated`, and MJCF's actuators, which say the same). Newton joins both
with the joint's `PhysicsDriveAPI` and its `joint_target_q`; where MuJoCo's attributes are not registered with its
builder, that drive alone is left, which overshoots rated speed. PhysX knows nothing of them.
"""

from __future__ import annotations

from pxr import Sdf, Vt

from yellowiron.model.mechanism import Drive
from yellowiron.usd.authoring.metadata import set_custom
from yellowiron.usd.authoring.stage import Types, define, set_attribute, set_targets
from yellowiron.usd.planning.plan import ACTUATORS, Plan

SERVO, DAMPER = "servo", "damper"
"""The kinds of these prims in their records."""
_TERMS = 10
"""Numbers that MuJoCo takes of a gain and of a bias."""


def write_servos(layer: Sdf.Layer, plan: Plan) -> None:
    """A servo and a damper for every drive whose speed can be limited so."""
    home = f"{plan.root}/{ACTUATORS}"
    for joint in plan.mechanism.joints:
        drive = joint.drive
        if drive is None or joint.cut or not drive.rated:
            continue
        if layer.GetPrimAtPath(home) is None:
            define(layer, home, "Scope")
        target = plan.joint_paths[joint.name]
        name = target.rsplit("/", 1)[-1]
        servo = _actuator(layer, f"{home}/{name}", target, (drive.stiffness, -drive.stiffness, 0.0))
        _limit(servo, drive)
        damper = _actuator(layer, f"{home}/{name}_damping", target, (drive.damping, 0.0, -drive.damping))
        for spec, kind in ((servo, SERVO), (damper, DAMPER)):
            set_custom(spec, {"kind": kind, "name": joint.name})


def _actuator(layer: Sdf.Layer, path: str, target: str, terms: tuple[float, float, float]) -> Sdf.PrimSpec:
    """An actuator of gain and affine bias (by position, by speed): N/m and N·s/m, or per radian."""
    gain, by_position, by_speed = terms
    spec = define(layer, path, "MjcActuator")
    set_targets(spec, "mjc:target", target)
    set_attribute(spec, "mjc:biasType", Types.Token, "affine", uniform=True)
    for name, values in (("gainPrm", (gain,)), ("biasPrm", (0.0, by_position, by_speed))):
        padded = Vt.DoubleArray([*values, *[0.0] * (_TERMS - len(values))])
        set_attribute(spec, f"mjc:{name}", Types.DoubleArray, padded, uniform=True)
    return spec


def _limit(spec: Sdf.PrimSpec, drive: Drive) -> None:
    for end, value in (("min", -drive.damping * drive.speeds[0]), ("max", drive.damping * drive.speeds[1])):
        set_attribute(spec, f"mjc:forceRange:{end}", Types.Double, float(value), uniform=True)
