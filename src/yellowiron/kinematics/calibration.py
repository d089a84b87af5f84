"""Calibration: where nothing says how far a drawn cylinder is out, the published ranges do."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares

from yellowiron.kinematics.bench import Bench
from yellowiron.kinematics.chain import ClosedChain
from yellowiron.kinematics.measurement import CALIBRATED, specified
from yellowiron.kinematics.quantities import Unmeasurable
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Cylinder, Joint, Mechanism
from yellowiron.model.template import MeasurementTemplate

UNKNOWN = "unknown"
"""How a cylinder's `sources["closed_length"]` begins where nothing says it."""
_SCALE = {"m": 1e-3, "rad": 1e-3}
_LOST = 1e3
_COARSE = 9
_GOOD = 0.5


@dataclass(frozen=True)
class _Unknown:
    """One closed length to find: the driven cylinder of an actuator and the others that share it."""

    actuator: str
    driven: Cylinder
    others: tuple[Cylinder, ...]


def calibrate(mechanism: Mechanism) -> Mechanism:
    """The mechanism with every unknown closed length placed where the specifications that depend on it come out best.

    Only cylinders whose `sources["closed_length"]` begins with "unknown" are touched; the cylinders of one actuator
    share one closed length. Weighs published and example values alike, a millimetre as much as a milliradian. The
    slides' limits become −extension … stroke − extension; the source then begins with `CALIBRATED` and names
    the specifications, so that their measurements are reported as `calibrated` and never as accuracy.

    Findings: KIN010 (info) what was placed on what and how well, KIN011 (warning) nothing to place it on.
    """
    unknown = _unknown(mechanism)
    if not unknown:
        return mechanism
    chain = ClosedChain(mechanism)
    findings: list[Finding] = []
    usable = [t for t in mechanism.measurements if specified(mechanism, t.specification)[0] is not None and t.steps]
    middle = np.array([0.5 * u.driven.stroke for u in unknown])
    depends = {
        u.actuator: _dependent(mechanism, chain, unknown, number, usable, middle) for number, u in enumerate(unknown)
    }
    for u in unknown:
        if not depends[u.actuator]:
            findings.append(
                Finding(
                    "KIN011",
                    "warning",
                    u.driven.slide,
                    "its closed length is unknown and no measured specification depends on it",
                    f"Give the closed length of the {u.actuator} cylinder, or a value such as a height at full stroke.",
                )
            )
    solvable = [u for u in unknown if depends[u.actuator]]
    if solvable:
        names = {t.name for u in solvable for t in depends[u.actuator]}
        templates = [t for t in usable if t.name in names]
        found = _solve(mechanism, chain, solvable, templates)
        mechanism = _placed(mechanism, solvable, found, depends, findings)
        residuals = _residuals(mechanism, chain, templates, {})
        for u, extension in zip(solvable, found, strict=True):
            findings.append(_report(u, float(extension), depends[u.actuator], templates, residuals))
    return replace(mechanism, findings=(*mechanism.findings, *findings))


def _unknown(mechanism: Mechanism) -> list[_Unknown]:
    cylinders = {cylinder.name: cylinder for cylinder in mechanism.cylinders}
    found = []
    for actuator in mechanism.actuators:
        own = [cylinders[name] for name in actuator.cylinders if name in cylinders]
        driven = next((c for c in own if actuator.joints and c.slide == actuator.joints[0].joint), None)
        if driven is not None and driven.sources.get("closed_length", "").startswith(UNKNOWN):
            same = tuple(c for c in own if c is not driven and c.sources.get("closed_length", "").startswith(UNKNOWN))
            found.append(_Unknown(actuator.name, driven, same))
    return found


def _ranges(unknown: Sequence[_Unknown], extensions: np.ndarray) -> dict[str, tuple[float, float]]:
    """Slide → limits when the driven cylinders are out by `extensions` in the drawn pose."""
    return {u.driven.slide: (-float(e), u.driven.stroke - float(e)) for u, e in zip(unknown, extensions, strict=True)}


def _residuals(
    mechanism: Mechanism,
    chain: ClosedChain,
    templates: Sequence[MeasurementTemplate],
    ranges: Mapping[str, tuple[float, float]],
) -> np.ndarray:
    """Model less specification of each template, in millimetres or milliradians; a large number where there is none."""
    bench = Bench(mechanism, chain=chain, ranges=ranges)
    values = []
    for template in templates:
        spec = specified(mechanism, template.specification)[0] or 0.0
        try:
            model = bench.value(template.quantity, bench.pose(template.steps))
            values.append((model - spec) / _SCALE.get(template.unit, 1e-3))
        except Unmeasurable:
            values.append(_LOST)
    return np.array(values)


def _dependent(
    mechanism: Mechanism,
    chain: ClosedChain,
    unknown: Sequence[_Unknown],
    number: int,
    templates: Sequence[MeasurementTemplate],
    middle: np.ndarray,
) -> tuple[MeasurementTemplate, ...]:
    """Templates whose value changes with one unknown extension."""
    tables = []
    for share in (0.25, 0.45, 0.5, 0.55, 0.75):
        at = middle.copy()
        at[number] = share * unknown[number].driven.stroke
        tables.append(_residuals(mechanism, chain, templates, _ranges(unknown, at)))
    table = np.array(tables)
    moved = np.ptp(np.where(table >= _LOST, np.nan, table), axis=0)
    return tuple(t for t, change in zip(templates, np.nan_to_num(moved), strict=True) if change > 1e-3)


def _solve(
    mechanism: Mechanism, chain: ClosedChain, unknown: Sequence[_Unknown], templates: Sequence[MeasurementTemplate]
) -> np.ndarray:
    strokes = np.array([u.driven.stroke for u in unknown])

    def residual(shares: np.ndarray) -> np.ndarray:
        return np.clip(_residuals(mechanism, chain, templates, _ranges(unknown, shares * strokes)), -_LOST, _LOST)

    # One after the other over a coarse row, twice; then all together.
    best = np.full(len(unknown), 0.5)
    for _ in range(2 if len(unknown) > 1 else 1):
        for k in range(len(unknown)):
            tried = []
            for share in np.linspace(0.0, 1.0, _COARSE):
                at = best.copy()
                at[k] = share
                tried.append((float(np.sum(residual(at) ** 2)), float(share)))
            best[k] = min(tried)[1]
    start = np.clip(best, 1e-6, 1.0 - 1e-6)
    solved = least_squares(
        residual, start, bounds=(0.0, 1.0), diff_step=[1e-5] * len(start), xtol=1e-12, ftol=1e-12, gtol=1e-12
    )
    return np.asarray(solved.x * strokes)


def _placed(
    mechanism: Mechanism,
    unknown: Sequence[_Unknown],
    extensions: np.ndarray,
    depends: Mapping[str, Sequence[MeasurementTemplate]],
    findings: list[Finding],
) -> Mechanism:
    cylinders = {cylinder.name: cylinder for cylinder in mechanism.cylinders}
    joints = {joint.name: joint for joint in mechanism.joints}
    for u, extension in zip(unknown, extensions, strict=True):
        closed = u.driven.drawn_length - float(extension)
        source = CALIBRATED + "; ".join(dict.fromkeys(t.specification for t in depends[u.actuator]))
        for cylinder in (u.driven, *u.others):
            sources = {**cylinder.sources, "closed_length": source}
            placed = replace(cylinder, closed_length=closed, sources=sources)
            cylinders[cylinder.name] = placed
            joints[cylinder.slide] = _limited(joints[cylinder.slide], placed, source)
    return replace(
        mechanism,
        cylinders=tuple(cylinders[cylinder.name] for cylinder in mechanism.cylinders),
        joints=tuple(joints[joint.name] for joint in mechanism.joints),
    )


def _limited(joint: Joint, cylinder: Cylinder, source: str) -> Joint:
    if joint.lower is None and joint.upper is None and cylinder.passive:
        return joint  # its limits follow from the loop
    text = f"closed length {source}"
    return replace(
        joint,
        lower=-cylinder.extension,
        upper=cylinder.stroke - cylinder.extension,
        source={**joint.source, "limits": text},
    )


def _report(
    u: _Unknown,
    extension: float,
    depends: Sequence[MeasurementTemplate],
    templates: Sequence[MeasurementTemplate],
    residuals: np.ndarray,
) -> Finding:
    own = [float(r) for t, r in zip(templates, residuals, strict=True) if t in depends]
    worst = max(map(abs, own))
    names = "; ".join(dict.fromkeys(t.specification for t in depends))
    return Finding(
        "KIN010",
        "info" if worst <= _GOOD * 20.0 else "warning",
        u.driven.slide,
        f"its closed length is {1e3 * (u.driven.drawn_length - extension):.1f} mm, {1e3 * extension:.1f} mm less than "
        f"drawn, calibrated on {names}: within {worst:.2g} mm or mrad",
        "These values place the cylinder, so they prove nothing; the closed length from the sheet would be better.",
    )
