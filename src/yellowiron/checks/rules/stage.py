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
_MOST = "physxScene:maxPositionIterationCount"
_SECONDS = "mjc:option:timestep"
_RATES = {"physxScene:timeStepsPerSecond": 60.0, "newton:timeStepsPerSecond": 240.0, _SECONDS: 240.0}
"""Attribute → steps a second with which pins stay within a millimetre."""
_ENOUGH, _FILE, _USUAL = 32.0, 255.0, 60.0
"""Iterations that hold loops, those that a build writes, and steps a second that PhysX takes where nobody says."""


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
        if value == 0.0 and name not in (_AT_LEAST, *_RATES):
            yield path, f"{name} is 0."


@rule(
    "CHK132",
    "warning",
    "Leave the count to the machine's file, or give 32 or more; physxScene:minPositionIterationCount of the scene "
    "overrules whoever sets fewer.",
)
def few_iterations(view: View) -> Remarks:
    """Loops have too few solver iterations."""
    floor = max((value for _, name, value in view.solver if name == _AT_LEAST), default=0.0)
    looped = [i for i in view.islands if i.roots and any(j.cut for j in i.joints)]
    for path, name, value in view.solver:
        own = name == _MOST or any(path in i.roots for i in looped)
        counts = name in (_MOST, "physxArticulation:solverPositionIterationCount")
        if looped and own and counts and 0.0 < max(value, floor) < _ENOUGH:
            low, high = physx_gap(_USUAL, max(value, floor))
            yield (
                path,
                f"{name} is {value:g}, and cut joints close loops here: expect pins {low:.2g} to {high:.2g} mm apart "
                f"at {_USUAL:g} Hz.",
            )


@rule(
    "CHK133",
    "warning",
    "Take shorter steps, or substeps: 60 Hz in PhysX, 240 Hz in Newton and MuJoCo hold pins within a millimetre.",
)
def long_steps(view: View) -> Remarks:
    """A scene's steps are too long for loops."""
    looped = [i for i in view.islands if i.roots and any(j.cut for j in i.joints)]
    for path, name, value in view.solver if looped else ():
        rate = 1.0 / value if name == _SECONDS and value > 0.0 else value
        if name not in _RATES or not 0.0 < rate < _RATES[name]:
            continue
        low, high = physx_gap(rate, _FILE) if name.startswith("physx") else newton_gap(rate)
        yield (
            path,
            f"Steps of {1e3 / rate:.3g} ms, and cut joints close loops here: expect pins {low:.2g} to {high:.2g} mm "
            "apart.",
        )


def physx_gap(hz: float, iterations: float) -> tuple[float, float]:
    """How far (mm) pins of a loader and of excavators came apart in slow full strokes in PhysX, as
    `benchmarks/bench_defaults.py` measures it, carried on to other rates and counts by the slopes found there."""
    fewer, longer = (4.0 / iterations) ** 1.5, (60.0 / hz) ** 2
    return 4.3 * fewer * longer, 9.1 * fewer * longer


def newton_gap(hz: float) -> tuple[float, float]:
    """The same in Newton with its own integrator."""
    longer = (60.0 / hz) ** 2
    return 6.3 * longer, 21.0 * longer
