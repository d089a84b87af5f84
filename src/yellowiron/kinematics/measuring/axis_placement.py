"""The sheet as a measuring tape: axes that the drawing leaves open, placed where the published dimensions put them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from yellowiron.kinematics.measuring.measurement import CALIBRATED, calibrating, measure
from yellowiron.model.errors import MechanismError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Measurement, Mechanism
from yellowiron.model.specification import fold
from yellowiron.support.units import parse_quantity

SHEET = (0.005, 0.005)
"""How well a published value is a machine's own, one sigma: this share of it, and at least so many metres …"""
SHEET_ANGLE = 0.01
"""… or radians."""
MOST = 6
"""So many axes are placed at most, the least sure first: each costs two builds."""
STEP = 0.5
"""Of its sigma, by which an axis is moved to see what depends on it."""
TELLS = 0.5
"""A value tells of an axis if one sigma of this moves it by at least so many of the value's own."""
GAIN = 0.9
"""An axis is placed if its uncertainty becomes less than this share of what it was."""
CONTRADICTED = 3.0
"""A value that is further off than so many sigmas afterwards cannot be met."""
LOOKS = 2
"""How often what it comes to is measured anew."""
ROUNDS = 8
"""Of reweighting what does not fit (P. J. Huber, Ann. Math. Stat. 35, 1964)."""

Build = Callable[[Mapping[str, Floats]], Mechanism]


@dataclass(frozen=True, eq=False)
class OpenAxis:
    """A hinge whose axis along the unit `direction` is known to `across` metres (one sigma), across it."""

    joint: str
    direction: Floats
    across: float


@dataclass(frozen=True, eq=False)
class PlacedAxes:
    """Joint → by what (3,) metres its axis moves, how well it is known then, and what `JointFrame.source["axis"]` says
    of it: `CALIBRATED` and the specifications that placed it."""

    shifts: Mapping[str, Floats] = field(default_factory=dict)
    across: Mapping[str, float] = field(default_factory=dict)
    sources: Mapping[str, str] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()


def place_axes(axes: Sequence[OpenAxis], build: Build) -> PlacedAxes:
    """Axes by least squares: what the sheet publishes, each value as exact as a sheet is, and where the drawing has
    the axis, as exact as it is known.

    `build` gives the mechanism with axes moved by (3,) metres, in the frame of `direction`. Where nothing that is
    measured depends on an axis, it stays; values that place a cylinder already say nothing more. Findings: KIN013 what
    was placed, on what and how well (info); KIN014 a value that cannot be met within the uncertainty of the axes
    (warning). Where most values cannot be met nothing is placed: the sheet, or the model, is another machine's.
    """
    axes = sorted(axes, key=lambda a: (-round(a.across, 9), a.joint))[:MOST]
    base = _measured(build({})) if axes else {}
    if not base:
        return PlacedAxes()
    names = sorted(base)
    spec = np.array([base[n].spec or 0.0 for n in names])
    sigma = np.array([_sigma(base[n]) for n in names])
    ways = [_across(a.direction) * a.across for a in axes]
    columns = [(k, way) for k in range(len(axes)) for way in ways[k]]

    def values(shifts: Mapping[str, Floats]) -> Floats:
        found = _measured(build(shifts), names) if shifts else base
        return np.array([_value(found.get(n)) for n in names])

    start = (values({}) - spec) / sigma
    moved = [(values({axes[k].joint: STEP * way}) - spec) / sigma for k, way in columns]
    slope = np.nan_to_num(np.stack([(m - start) / STEP for m in moved], axis=1))
    start = np.nan_to_num(start)
    # What tells of no axis is a check, as any other value.
    rows = np.abs(slope).max(axis=1) > TELLS
    if not rows.any():
        return PlacedAxes()
    slope, start, spec, sigma = slope[rows], start[rows], spec[rows], sigma[rows]
    names = [n for n, told in zip(names, rows, strict=True) if told]
    x, left = np.zeros(len(columns)), start
    for _ in range(LOOKS):
        # Gauss-Newton from where it is, with the slopes of the start; what does not fit weighs less.
        at, there, weight = x, left, np.ones(len(names))
        for _ in range(ROUNDS):
            normal = (slope * weight[:, None]).T @ slope + np.eye(len(x))
            x = np.linalg.solve(normal, (slope * weight[:, None]).T @ (slope @ at - there))
            weight = np.minimum(1.0, CONTRADICTED / np.maximum(np.abs(there + slope @ (x - at)), 1e-9))
        trial = (values(_moves(axes, ways, x)) - spec) / sigma
        left = np.where(np.isfinite(trial), trial, there + slope @ (x - at))
    known = np.sqrt(np.diag(np.linalg.inv(normal)))
    unmet = np.abs(left) > CONTRADICTED
    findings = [_unmet(base[n], off) for n, off, bad in zip(names, left * sigma, unmet, strict=True) if bad]
    if unmet.mean() > 0.5:
        return PlacedAxes(findings=tuple(findings))
    moves = _moves(axes, ways, x)
    shifts, across, sources = {}, {}, {}
    for k, axis in enumerate(axes):
        own = [c for c, (of, _) in enumerate(columns) if of == k]
        if float(known[own].min()) > GAIN:
            continue
        told = [n for n, row, bad in zip(names, np.abs(slope[:, own]).max(axis=1), unmet, strict=True)
                if row > TELLS and not bad]  # fmt: skip
        if not told:
            continue
        shifts[axis.joint] = moves[axis.joint]
        across[axis.joint] = axis.across * float(np.sqrt((known[own] ** 2).mean()))
        sources[axis.joint] = CALIBRATED + "; ".join(dict.fromkeys(base[n].specification for n in told))
        findings.append(_placed(axis, shifts[axis.joint], across[axis.joint], sources[axis.joint]))
    return PlacedAxes(shifts, across, sources, tuple(findings))


def _moves(axes: Sequence[OpenAxis], ways: Sequence[Floats], x: Floats) -> dict[str, Floats]:
    """Joint → by what its axis moves, from coordinates (2 n,) in sigmas."""
    return {axis.joint: np.asarray(x[2 * k : 2 * k + 2] @ ways[k]) for k, axis in enumerate(axes)}


def _measured(mechanism: Mechanism, names: Collection[str] | None = None) -> dict[str, Measurement]:
    """Measurement → what the machine makes of it, of those (of `names`) that are published; none where the joints make
    no tree."""
    known = {fold(name) for name, entry in mechanism.specifications.items() if entry.get("value") is not None}
    taken = calibrating(mechanism)
    asked = tuple(
        m for m in mechanism.measurements
        if fold(m.specification) in known - taken and (names is None or m.name in names)
    )  # fmt: skip
    try:
        found = measure(replace(mechanism, measurements=asked)) if asked else ()
    except MechanismError:
        return {}
    return {m.name: m for m in found if m.spec is not None and m.model is not None}


def _value(measurement: Measurement | None) -> float:
    return float("nan") if measurement is None or measurement.model is None else measurement.model


def _sigma(measurement: Measurement) -> float:
    """How well a published value is this machine's, SI."""
    if parse_quantity(f"1 {measurement.unit}")[1] == "rad":
        return SHEET_ANGLE
    return max(SHEET[0] * abs(measurement.spec or 0.0), SHEET[1])


def _across(direction: Floats) -> Floats:
    """(2, 3) unit vectors across a direction."""
    u = np.cross(direction, np.eye(3)[int(np.argmin(np.abs(direction)))])
    u = u / np.linalg.norm(u)
    return np.stack([u, np.cross(direction, u)])


def _placed(axis: OpenAxis, shift: Floats, across: float, source: str) -> Finding:
    text = (
        f"Its axis, drawn to {1e3 * axis.across:.0f} mm, is moved by {1e3 * float(np.linalg.norm(shift)):.0f} mm "
        f"and then known to {1e3 * across:.0f} mm: {source}"
    )
    hint = "These values place the axis, so they prove nothing; a pin that is drawn would be better."
    return Finding("KIN013", "info", axis.joint, text, hint)


def _unmet(measurement: Measurement, off: float) -> Finding:
    unit = "rad" if _sigma(measurement) == SHEET_ANGLE else "m"
    text = f"{measurement.name} is {abs(off):.3f} {unit} off the sheet wherever its joints' axes could be"
    hint = "Check that the sheet is this machine's, its scale, and the roles of the parts it is measured on."
    return Finding("KIN014", "warning", measurement.specification, text, hint)
