"""Calibration: where nothing says how far a drawn cylinder is out, the published ranges do."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares

from yellowiron.kinematics.measuring.bench import Bench
from yellowiron.kinematics.measuring.measurement import CALIBRATED
from yellowiron.kinematics.measuring.quantities import Unmeasurable
from yellowiron.kinematics.measuring.sheet import specified
from yellowiron.kinematics.solver.chain import ClosedChain
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import UNKNOWN, Cylinder, Joint, Mechanism
from yellowiron.model.template import MeasurementTemplate

_SCALE = 1e-3
"""A millimetre weighs as much as a milliradian: residuals are in them."""
_LOST = 1e3
"""The residual of a specification that cannot be measured, and the largest of any other."""
_COARSE = 17
"""Shares of the stroke at which the search starts."""
_NUDGE = 1e-3
"""Metres by which a closed length is moved to see …"""
_MOVED = 1e-3
"""… which specifications depend on it: their residual changes by more than this."""
_GOOD = 10.0
"""The worst residual, millimetres or milliradians, of a good fit."""


@dataclass(frozen=True)
class _Unknown:
    """One closed length to find: the driven cylinder of an actuator and the others that share it."""

    actuator: str
    driven: Cylinder
    others: tuple[Cylinder, ...]


def calibrate(mechanism: Mechanism) -> Mechanism:
    """The mechanism with every unknown closed length placed where the specifications that depend on it come out best.

    Only cylinders whose `sources["closed_length"]` begins with `UNKNOWN` are touched; the cylinders of one actuator
    share one closed length. Used are measurements that set the actuator to a share of its stroke, those that solve for
    several actuators at once only where there is no other; published and example values weigh alike, a millimetre as
    much as a milliradian. The slides' limits become −extension … stroke − extension; the source then begins with
    `CALIBRATED` and names the specifications, so that their measurements are reported as `calibrated` and never as
    accuracy.

    Findings: KIN010 what was placed on what and how well (info; a warning where it fits badly), KIN011 nothing to
    place it on (warning).
    """
    unknown = _unknown(mechanism)
    if not unknown:
        return mechanism
    chain = ClosedChain(mechanism)
    findings: list[Finding] = []
    depends = {u.actuator: _settled_by(u.actuator, mechanism) for u in unknown}
    for group in _groups([u for u in unknown if depends[u.actuator]], depends):
        found = _solve(mechanism, chain, group, depends)
        templates = _templates(mechanism, group, depends)
        residuals = _residuals(mechanism, chain, templates, _ranges(group, found))
        settled = {}
        for number, u in enumerate(group):
            nudged = found.copy()
            nudged[number] += _NUDGE if found[number] < 0.5 * u.driven.stroke else -_NUDGE
            moved = np.abs(_residuals(mechanism, chain, templates, _ranges(group, nudged)) - residuals) > _MOVED
            settled[u.actuator] = tuple(t for t, m in zip(templates, moved, strict=True) if m)
        depends.update(settled)
        for u, extension in zip(group, found, strict=True):
            if depends[u.actuator]:
                mechanism = _placed(mechanism, u, float(extension), depends[u.actuator])
                findings.append(_report(u, float(extension), depends[u.actuator], templates, residuals))
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
    return replace(mechanism, findings=(*mechanism.findings, *findings))


def _settled_by(actuator: str, mechanism: Mechanism) -> tuple[MeasurementTemplate, ...]:
    """Measurements with a known specification whose steps leave the actuator at a share of its stroke."""
    found: list[MeasurementTemplate] = []
    for template in mechanism.measurements:
        if template.unpublished or specified(mechanism, template.specification)[0] is None:
            continue
        last: object = None
        for step in template.steps:
            last = step.get("set", {}).get(actuator, last)
            moved = {condition["actuator"] for condition in step.get("solve", ())}
            for key in ("extreme", "level_cut"):
                moved |= set(step.get(key, {}).get("actuators", ()))
            if actuator in moved:
                last = None
        if last is not None and last not in ("drawn", "straight"):
            found.append(template)
    quick = [t for t in found if all(len(step.get("solve", ())) < 2 for step in t.steps)]
    return tuple(quick or found)


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
            values.append((model - spec) / _SCALE)
        except Unmeasurable:
            values.append(_LOST)
    return np.array(values)


def _groups(unknown: Sequence[_Unknown], depends: Mapping[str, Sequence[MeasurementTemplate]]) -> list[list[_Unknown]]:
    """Unknowns that some measurement ties together."""
    groups: list[list[_Unknown]] = []
    for u in unknown:
        names = {t.name for t in depends[u.actuator]}
        tied = [g for g in groups if any(names & {t.name for t in depends[o.actuator]} for o in g)]
        groups = [g for g in groups if g not in tied] + [[*(o for g in tied for o in g), u]]
    return groups


def _templates(
    mechanism: Mechanism, unknown: Sequence[_Unknown], depends: Mapping[str, Sequence[MeasurementTemplate]]
) -> list[MeasurementTemplate]:
    names = {t.name for u in unknown for t in depends[u.actuator]}
    return [t for t in mechanism.measurements if t.name in names]


def _solve(
    mechanism: Mechanism,
    chain: ClosedChain,
    unknown: Sequence[_Unknown],
    depends: Mapping[str, Sequence[MeasurementTemplate]],
) -> np.ndarray:
    """Extensions in metres: each over a coarse row on its own measurements, twice where several are tied; then all."""
    strokes = np.array([u.driven.stroke for u in unknown])

    def residual(shares: np.ndarray, templates: Sequence[MeasurementTemplate]) -> np.ndarray:
        return np.clip(_residuals(mechanism, chain, templates, _ranges(unknown, shares * strokes)), -_LOST, _LOST)

    best = np.full(len(unknown), 0.5)
    for _ in range(2 if len(unknown) > 1 else 1):
        for k, u in enumerate(unknown):
            tried = []
            for share in np.linspace(0.0, 1.0, _COARSE):
                at = best.copy()
                at[k] = share
                tried.append((float(np.sum(residual(at, depends[u.actuator]) ** 2)), float(share)))
            best[k] = min(tried)[1]
    solved = least_squares(
        residual,
        np.clip(best, 1e-6, 1.0 - 1e-6),
        args=(_templates(mechanism, unknown, depends),),
        bounds=(0.0, 1.0),
        diff_step=[1e-6] * len(best),
        xtol=1e-14,
        ftol=1e-14,
        gtol=1e-14,
    )
    return np.asarray(solved.x * strokes)


def _placed(
    mechanism: Mechanism, unknown: _Unknown, extension: float, depends: Sequence[MeasurementTemplate]
) -> Mechanism:
    closed = unknown.driven.drawn_length - extension
    source = CALIBRATED + "; ".join(dict.fromkeys(t.specification for t in depends))
    placed = {
        c.slide: replace(c, closed_length=closed, sources={**c.sources, "closed_length": source})
        for c in (unknown.driven, *unknown.others)
    }
    return replace(
        mechanism,
        cylinders=tuple(placed.get(c.slide, c) for c in mechanism.cylinders),
        joints=tuple(_limited(j, placed[j.name], source) if j.name in placed else j for j in mechanism.joints),
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
    worst = max((abs(r) for r in own if r < _LOST), default=_LOST)
    lost = sum(r >= _LOST for r in own)
    names = "; ".join(dict.fromkeys(t.specification for t in depends))
    return Finding(
        "KIN010",
        "info" if worst <= _GOOD and not lost else "warning",
        u.driven.slide,
        f"its closed length is {1e3 * (u.driven.drawn_length - extension):.1f} mm, {1e3 * extension:.1f} mm less than "
        f"drawn, calibrated on {names}: within {worst:.2g} mm or mrad"
        + (f", {lost} of them out of reach" if lost else ""),
        "These values place the cylinder, so they prove nothing; the closed length from the sheet would be better.",
    )
