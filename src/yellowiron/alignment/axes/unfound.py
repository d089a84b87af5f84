"""The joints that the search did not find though both their bodies are there: an axis for each, and what to say."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from yellowiron.alignment.axes.estimate import estimate_axes
from yellowiron.alignment.axes.pivots import pivots_of
from yellowiron.alignment.axes.values import AxisEstimate, Frame
from yellowiron.alignment.features.solids import Solid
from yellowiron.model.alignment import PartAssignment, Vector
from yellowiron.model.assembly import Assembly
from yellowiron.model.finding import Finding, Severity
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template
from yellowiron.support.vectors import triple

SURE = 0.002
"""An axis that is known to this share of the machine's size is told for information only."""


def unfound_axes(
    solids: Sequence[Solid],
    parts: Sequence[PartAssignment],
    template: Template,
    *,
    found: Collection[str],
    size: float,
    frame: Floats | None = None,
    assembly: Assembly | None = None,
    ways: Mapping[str, Vector] | None = None,
) -> dict[str, AxisEstimate]:
    """Joint → its axis, for the template's hinges and slides that are not `found` though parts move with both of their
    bodies. `frame`: the machine's (4, 4), CAD → machine, if it is known; `assembly`: the model,
    whose scene's tree tells pivots; `ways`: hinge → the direction that pins or bores showed."""
    body_of = {p.part: p.body for p in parts if p.body is not None}
    labels: dict[str, list[int]] = {}
    for solid in solids:
        if solid.part.id in body_of:
            labels.setdefault(body_of[solid.part.id], []).append(solid.index)
    wanted = {
        j.name
        for j in template.joints
        if j.type in ("revolute", "spherical", "prismatic") and not j.ring and j.name not in found
        and all(b in labels for b in template.bodies_of(j))
    }  # fmt: skip
    if not wanted:
        return {}
    machine = Frame(*(np.asarray(row) for row in frame[:3, :3])) if frame is not None else Frame()
    pivots = pivots_of(assembly, body_of, template) if assembly is not None and assembly.nodes else None
    shown = {name: np.asarray(way) for name, way in (ways or {}).items()}
    estimates = estimate_axes(solids, labels, template, frame=machine, size=size, pivots=pivots, ways=shown)
    return {name: e for name, e in estimates.items() if name in wanted}


def lines_of(estimates: Mapping[str, AxisEstimate]) -> dict[str, tuple[Vector, Vector]]:
    """The axes as an alignment holds them."""
    return {name: (triple(e.origin), triple(e.direction)) for name, e in estimates.items()}


def rough_axes(estimates: Mapping[str, AxisEstimate], template: Template, size: float) -> dict[str, float]:
    """Hinge → how well its axis is known, metres, of those that are told as a warning."""
    hinges = {j.name for j in template.joints if j.type == "revolute"}
    return {name: e.across for name, e in estimates.items() if name in hinges and e.across > SURE * size}


def axis_findings(estimates: Mapping[str, AxisEstimate], size: float) -> list[Finding]:
    """ALN016 for every axis that was estimated, the least sure first: to how many millimetres and degrees it is known,
    and by what."""
    order = sorted(estimates.values(), key=lambda e: (-round(e.across, 9), e.joint))
    findings = []
    for e in order:
        text = (
            f"No pin or common bore shows this joint: its axis is estimated to {1e3 * e.across:.0f} mm and "
            f"{math.degrees(e.angle):.1f}° (one sigma), from {e.how}"
        )
        if e.candidates and e.across > SURE * size:
            count = len(e.candidates)
            text += f"; {count} other {'line' if count == 1 else 'lines'} could be it"
        severity: Severity = "warning" if e.across > SURE * size else "info"
        hint = "Compare it with the machine; give its pin that role in alignment.json, or draw the pin."
        findings.append(Finding("ALN016", severity, e.joint, text, hint))
    return findings
