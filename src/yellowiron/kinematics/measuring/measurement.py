"""Measurements: the template's definitions executed on the mechanism and compared with the specifications."""

from __future__ import annotations

import contextlib
from typing import Literal

import numpy as np

from yellowiron.kinematics.measuring.bench import Bench
from yellowiron.kinematics.measuring.quantities import Unmeasurable
from yellowiron.kinematics.measuring.sheet import specified
from yellowiron.kinematics.solver.chain import State
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Measurement, Mechanism
from yellowiron.model.specification import fold
from yellowiron.model.template import MeasurementTemplate

CALIBRATED = "calibrated on "
"""How a cylinder's `sources["closed_length"]`, and a joint's `source["axis"]`, begins where measurements placed it;
their specifications follow, separated by '; '."""
SIZES = ("extent", "distance", "radius", "tyre_diameter", "overhang")
"""The kinds of quantity that are lengths of what is drawn."""
_POSES = 4


def measure(mechanism: Mechanism, *, bench: Bench | None = None) -> tuple[Measurement, ...]:
    """Every measurement of the mechanism's template, in its order, beside the specification it belongs to.

    Values in SI. A measurement that cannot be made has `model` None and a `reason`; one whose specification is missing
    or not `ok` has `spec` None. Raises `MechanismError` where the joints are no tree with cuts.
    """
    if not mechanism.measurements:
        return ()
    bench = bench if bench is not None else Bench(mechanism)
    placed = calibrating(mechanism)
    return tuple(_measured(template, bench, placed) for template in mechanism.measurements)


def still_sizes(mechanism: Mechanism) -> dict[str, tuple[float, float]]:
    """Measurement → (on the machine, on the sheet), metres: of the lengths that hang on no pose, and that the sheet
    settles. Raises `MechanismError` where the joints are no tree with cuts."""
    bench, found = Bench(mechanism), {}
    for template in mechanism.measurements:
        if template.steps or template.unit != "m" or template.quantity.get("kind") not in SIZES:
            continue
        spec, example, _ = specified(mechanism, template.specification)
        if spec is None or spec <= 0.0 or example or template.unpublished:
            continue
        with contextlib.suppress(Unmeasurable):
            if (model := bench.value(template.quantity, bench.chain.drawn)) > 0.0:
                found[template.name] = (model, spec)
    return found


def calibrating(mechanism: Mechanism) -> frozenset[str]:
    """Folded names of the specifications that placed a cylinder or an axis, and so prove nothing."""
    names: set[str] = set()
    sources = [c.sources.get("closed_length", "") for c in mechanism.cylinders]
    for source in (*sources, *(str(j.source.get("axis", "")) for j in mechanism.joints)):
        if source.startswith(CALIBRATED):
            names.update(fold(name) for name in source.removeprefix(CALIBRATED).split(";"))
    return frozenset(names)


def measure_and_pose(mechanism: Mechanism) -> tuple[tuple[Measurement, ...], dict[str, dict[str, Floats]]]:
    """`measure` and `key_poses`, whose poses are the same: found once."""
    bench = Bench(mechanism)
    return measure(mechanism, bench=bench), key_poses(mechanism, bench=bench)


def key_poses(mechanism: Mechanism, *, count: int = _POSES, bench: Bench | None = None) -> dict[str, dict[str, Floats]]:
    """Caption → body → (4, 4) displacement from the drawn pose: of the poses that the measurements take, those that
    differ most; the caption is the first measurement made there."""
    bench = bench if bench is not None else Bench(mechanism)
    found: list[tuple[str, State, Floats]] = []
    for template in mechanism.measurements:
        try:
            state = bench.pose(template.steps)
        except Unmeasurable:
            continue
        if template.steps:
            found.append((template.name, state, _shares(bench, state)))
    chosen: list[tuple[str, State, Floats]] = []
    reference = [_shares(bench, bench.chain.drawn)]
    while found and len(chosen) < count:
        apart = [min(float(np.linalg.norm(each[2] - other)) for other in reference) for each in found]
        best = int(np.argmax(apart))
        if apart[best] < 0.05:
            break
        chosen.append(found[best])
        reference.append(found[best][2])
    return {name: bench.chain.pose(state) for name, state, _ in chosen}


def _shares(bench: Bench, state: State) -> Floats:
    """Where each cylinder actuator stands in its range, 0 to 1."""
    shares = []
    for actuator in bench.mechanism.actuators:
        if actuator.kind != "cylinder":
            continue
        try:
            low, high = bench.range(actuator.name)
        except Unmeasurable:
            continue
        shares.append((bench.chain.coordinate(state, actuator.joints[0].joint) - low) / ((high - low) or 1.0))
    return np.array(shares)


def _measured(template: MeasurementTemplate, bench: Bench, placed: frozenset[str]) -> Measurement:
    spec, example, reason = specified(bench.mechanism, template.specification)
    if template.unpublished:
        spec, reason = None, template.unpublished if spec is not None else ""
    model: float | None = None
    try:
        model = bench.value(template.quantity, bench.pose(template.steps))
    except Unmeasurable as why:
        reason = "; ".join(text for text in (str(why), reason) if text)
    error = 100.0 * (model - spec) / abs(spec) if model is not None and spec else None
    role: Literal["checked", "calibrated", "example"] = "example" if example else "checked"
    return Measurement(
        name=template.name,
        specification=template.specification,
        spec=spec,
        model=model,
        unit=template.unit,
        error_percent=error,
        role="calibrated" if fold(template.specification) in placed else role,
        definition=template.definition,
        reason=reason,
    )
