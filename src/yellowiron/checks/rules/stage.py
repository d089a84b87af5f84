"""The stage: units, axes, size, gravity, numbers that are none."""

from __future__ import annotations

import math

from yellowiron.checks.rule import Remarks, rule
from yellowiron.checks.values import extent, union
from yellowiron.checks.view import View

_SIZES = (0.01, 500.0)
"""Machines are between a centimetre and half a kilometre."""
_GRAVITY = (1.0, 30.0)
"""m/s²: from less than the Moon's to more than Jupiter's; 0 is meant."""
_AT_LEAST = "physxScene:minPositionIterationCount"
"""0 is what PhysX has where nobody gives it."""
_STEPS = ("physxScene:timeStepsPerSecond", "newton:timeStepsPerSecond", "mjc:option:timestep")


@rule(
    "CHK001",
    "error",
    "Set metersPerUnit and kilogramsPerUnit above 0, and upAxis to Y or Z.",
)
def unusable_units(view: View) -> Remarks:
    """The stage's units are no units."""
    for name, value in (("metersPerUnit", view.units.meters), ("kilogramsPerUnit", view.units.kilograms)):
        if value is not None and not (math.isfinite(value) and value > 0.0):
            yield view.name, f"{name} is {value:g}."
    if view.units.up_axis not in (None, "Y", "Z"):
        yield view.name, f"upAxis is {view.units.up_axis}."


@rule(
    "CHK002",
    "warning",
    "Write metersPerUnit in the root layer.",
)
def no_meters_per_unit(view: View) -> Remarks:
    """The stage does not say how long its unit is."""
    if view.units.meters is None:
        yield view.name, "metersPerUnit is not written, so the stage is read in centimetres."


@rule(
    "CHK003",
    "warning",
    "Write upAxis in the root layer.",
)
def no_up_axis(view: View) -> Remarks:
    """The stage does not say which axis is up."""
    if view.units.up_axis is None:
        yield view.name, "upAxis is not written, so Y is taken for it."


@rule(
    "CHK004",
    "error",
    "Find what computed it; an engine stops or explodes at the first step.",
)
def not_a_number(view: View) -> Remarks:
    """A value is not a number."""
    for path, attribute in view.not_numbers:
        yield path, f"{attribute} is not a finite number."


@rule(
    "CHK005",
    "warning",
    "Look for a file drawn in millimetres and read in metres, or the reverse.",
)
def implausible_size(view: View) -> Remarks:
    """The machine's size is implausible."""
    for island in view.islands:
        size = extent(union([b.bounds for b in island.bodies if b.bounds is not None]))
        if size > 0.0 and not _SIZES[0] <= size <= _SIZES[1]:
            yield island.where, f"It is {size:.3g} m across."


@rule(
    "CHK006",
    "info",
    "Open it in a scene that has one (of a build: scene.usda), or add a PhysicsScene.",
)
def no_scene(view: View) -> Remarks:
    """There is no physics scene."""
    if view.bodies and not view.scenes:
        yield view.name, "The file has rigid bodies and no PhysicsScene; engines then take defaults."


@rule(
    "CHK007",
    "warning",
    "gravityMagnitude is in stage units: 981 in centimetres, 9.81 in metres.",
)
def strange_gravity(view: View) -> Remarks:
    """Gravity is that of no planet."""
    for path, gravity in view.scenes:
        if gravity and not _GRAVITY[0] <= gravity <= _GRAVITY[1]:
            yield path, f"Gravity is {gravity:.3g} m/s²."


@rule(
    "CHK008",
    "warning",
    "USD does not rescale a reference: write every layer in the root layer's units, or scale the prim that "
    "refers to it.",
)
def layers_differ(view: View) -> Remarks:
    """Layers differ in units or axes."""
    units = view.units
    for name, meters, up in view.layer_units:
        if meters is not None and not math.isclose(meters, units.meters_per_unit, rel_tol=1e-6):
            yield name, f"Its unit is {meters:g} m, the root layer's {units.meters_per_unit:g} m."
        if up is not None and units.up_axis in ("Y", "Z") and up != units.up_axis:
            yield name, f"Its up axis is {up}, the root layer's {units.up_axis}."


@rule(
    "CHK009",
    "info",
    "Write kilogramsPerUnit in the root layer.",
)
def no_kilograms_per_unit(view: View) -> Remarks:
    """The stage does not say how heavy its unit is."""
    if view.bodies and view.units.kilograms is None:
        yield view.name, "kilogramsPerUnit is not written, so masses are read in kilograms."


@rule(
    "CHK130",
    "warning",
    "Leave gravityMagnitude out for the Earth's, or set it; drives that never carried a weight prove nothing.",
)
def no_gravity(view: View) -> Remarks:
    """There is no gravity."""
    for path, gravity in view.scenes:
        if gravity == 0.0 and view.bodies:
            yield path, "Gravity is 0 or off, so nothing here weighs anything."


@rule(
    "CHK131",
    "error",
    "Leave it out, or give 1 or more: with none no joint, contact or drive is solved.",
)
def no_iterations(view: View) -> Remarks:
    """A solver has no iterations."""
    for path, name, value in view.solver:
        if value == 0.0 and name not in (_AT_LEAST, *_STEPS):
            yield path, f"{name} is 0."
