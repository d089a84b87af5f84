"""Drives: on a coordinate that the joint has, with gains and forces that a machine can have."""

from __future__ import annotations

import math

from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.values import ANGULAR, LINEAR, StageJoint, extent
from yellowiron.checks.view import View
from yellowiron.support.text import with_article

_KNOWN = ("linear", "angular", *LINEAR, *ANGULAR)
_STIFFEST = 200.0
"""Hz, of the whole machine's mass on the drive's spring: no hydraulics comes near, and no step of a simulation."""

_SHARPEST = (2.0 * math.pi * _STIFFEST) ** 2
"""1/s²: of an acceleration drive, whose gains are those for a mass of 1, the stiffness of that frequency."""
_FASTEST = {"linear": 20.0, "angular": 100.0}
"""m/s of a slide, and of the rim of what a hinge turns: no cylinder and no wheel comes near."""
_BEYOND = 10.0
"""Times a joint's own largest velocity: a target so far above it is a mistake."""


def _fits(joint: StageJoint, instance: str) -> bool:
    if joint.type == "revolute":
        return instance in ("angular", *joint.freedoms)
    if joint.type == "prismatic":
        return instance in ("linear", *joint.freedoms)
    if joint.type == "spherical":
        return instance in ("angular", *ANGULAR)
    return joint.type in ("generic", "distance", "other")


@rule(
    "CHK070",
    "error",
    "UsdPhysics knows linear, angular, transX … rotZ: 'linear' on a slide, 'angular' on a hinge.",
)
def unknown_instance(view: View) -> Remarks:
    """A drive's instance is not a coordinate."""
    for joint in view.joints:
        for drive in joint.drives:
            if drive.instance not in _KNOWN and joint.type != "other":
                yield joint.path, f"Its drive is called '{drive.instance}', so no engine applies it."


@rule(
    "CHK071",
    "error",
    "Use 'linear' on a slide and 'angular' on a hinge.",
)
def misfit(view: View) -> Remarks:
    """A drive does not fit its joint."""
    for joint in view.joints:
        for drive in joint.drives:
            if drive.instance in _KNOWN and not _fits(joint, drive.instance):
                drive_kind, kind = with_article(drive.instance).capitalize(), with_article(joint.type)
                yield joint.path, f"{drive_kind} drive does nothing on {kind} joint."


@rule(
    "CHK072",
    "error",
    "Give maxForce above 0, or leave it out for an unlimited one.",
)
def no_force(view: View) -> Remarks:
    """A drive has no force."""
    for joint in view.joints:
        for drive in joint.drives:
            if drive.acts and drive.max_force <= 0.0:
                yield joint.path, f"Its maxForce is {drive.max_force:g}, so it never moves."


@rule(
    "CHK073",
    "error",
    "Give stiffness and damping of 0 or more: it pushes away from its target.",
)
def negative_gain(view: View) -> Remarks:
    """A drive's gain is negative."""
    for joint in view.joints:
        for drive in joint.drives:
            for name, value in (("stiffness", drive.stiffness), ("damping", drive.damping)):
                if value < 0.0:
                    yield joint.path, f"Its {name} is {value:g}."


@rule(
    "CHK074",
    "warning",
    "Take stiffness from the mass it moves: m·(2πf)² with f of 2 to 8 Hz; damping 2k/(2πf).",
)
def too_stiff(view: View) -> Remarks:
    """A drive is stiffer than any machine."""
    for island in view.islands:
        for joint in island.joints:
            for drive in joint.drives:
                if (
                    drive.acceleration
                    or joint.cut
                    or drive.instance not in _KNOWN
                    or island.mass <= 0.0
                    or island.size <= 0.0
                ):
                    continue
                load = island.mass * (1.0 if drive.instance in ("linear", *LINEAR) else island.size**2)
                if math.isinf(drive.stiffness) or drive.stiffness > load * (2.0 * math.pi * _STIFFEST) ** 2:
                    yield (
                        joint.path,
                        f"Its stiffness is {drive.stiffness:.3g} in SI, on a machine of {island.mass:.4g} kg.",
                    )


@rule(
    "CHK075",
    "warning",
    "Set it within: Newton replaces it by the middle of the limits, without a word.",
)
def target_outside(view: View) -> Remarks:
    """A drive's target is outside the joint's limits."""
    for joint in view.joints:
        for drive in joint.drives:
            if drive.stiffness <= 0.0 or not _fits(joint, drive.instance):
                continue
            lower = -math.inf if joint.lower is None else joint.lower
            upper = math.inf if joint.upper is None else joint.upper
            slack = 1e-6 * max(1.0, abs(drive.target_position))
            if lower <= upper and not lower - slack <= drive.target_position <= upper + slack:
                yield (
                    joint.path,
                    f"Its target is {drive.target_position:.4g}, its limits {lower:.4g} and {upper:.4g} (SI).",
                )


@rule(
    "CHK076",
    "error",
    "Give it above 0, or leave it out.",
)
def no_velocity(view: View) -> Remarks:
    """A joint's largest velocity is not above 0."""
    for joint in view.joints:
        for name, value in joint.velocity_limits.items():
            if value <= 0.0:
                yield joint.path, f"{name} is {value:g}."


@rule(
    "CHK077",
    "warning",
    "Give damping, about 2k/(2πf): it swings about its target.",
)
def no_damping(view: View) -> Remarks:
    """A position drive has no damping."""
    for joint in view.joints:
        for drive in joint.drives:
            if drive.stiffness > 0.0 and drive.damping == 0.0 and not joint.held and not joint.damped:
                yield joint.path, "It has stiffness and no damping."


@rule(
    "CHK078",
    "warning",
    "Keep driven joints in the tree and cut a structural pin of the loop: there the drive carries the load.",
)
def driven_cut(view: View) -> Remarks:
    """A driven joint is cut from the articulation."""
    for joint in view.joints:
        if joint.cut and joint.driven:
            yield joint.path, "It has a drive and excludeFromArticulation."


@rule(
    "CHK079",
    "info",
    "Give stiffness or damping; without them it only takes forces that a controller computes.",
)
def no_gain(view: View) -> Remarks:
    """A drive has no gain."""
    for joint in view.joints:
        for drive in joint.drives:
            if not drive.acts:
                yield joint.path, f"Its {drive.instance} drive has neither stiffness nor damping."


@rule(
    "CHK140",
    "warning",
    "Set the drive's type to force, or divide its gains by the mass it moves.",
)
def gains_of_force(view: View) -> Remarks:
    """An acceleration drive has the gains of a force drive."""
    for joint in view.joints:
        for drive in joint.drives:
            hard = drive.stiffness > _SHARPEST or drive.damping > 2.0 * math.sqrt(_SHARPEST)
            if drive.acceleration and hard:
                yield (
                    joint.path,
                    f"Its stiffness is {drive.stiffness:.3g} 1/s² and its damping {drive.damping:.3g} 1/s, whatever it "
                    "moves.",
                )


@rule(
    "CHK141",
    "warning",
    "Give targetVelocity in stage units or degrees a second; 0 holds still.",
)
def absurd_speed(view: View) -> Remarks:
    """A drive's target is faster than any machine."""
    for joint in view.joints:
        for drive in joint.drives:
            speed = abs(drive.target_velocity)
            if speed == 0.0 or not _fits(joint, drive.instance):
                continue
            linear = drive.instance in ("linear", *LINEAR)
            reach = 1.0 if linear else _radius(view, joint)
            own = min(joint.velocity_limits.values(), default=math.inf)
            limit = own * (view.units.meters_per_unit if linear else math.radians(1.0))
            if speed * reach > _FASTEST["linear" if linear else "angular"] or 0.0 < _BEYOND * limit < speed:
                yield joint.path, f"Its target is {speed:.4g} {'m' if linear else 'rad'}/s."


def _radius(view: View, joint: StageJoint) -> float:
    """Half of the size of the smaller body that a hinge turns, metres; 1 where neither has one."""
    sizes = [extent(body.bounds) for path in joint.bodies if (body := view.bodies.get(path)) is not None]
    return 0.5 * min((size for size in sizes if size > 0.0), default=2.0)
