"""Hydraulic cylinders: sizes, stroke, closed length, forces and speeds, each with its source.

What decides, best first: the sheet, the CAD model, the template's defaults. Every way to a closed length is tried and
recorded, whichever is used.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from yellowiron.mechanism.axes import Line
from yellowiron.mechanism.frames import JointFrame
from yellowiron.mechanism.placement import Placement
from yellowiron.mechanism.rams import Ram, measure_ram
from yellowiron.mechanism.values import Known, default, known, limit
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Cylinder
from yellowiron.model.specification import Specifications
from yellowiron.model.template import ActuatorTemplate, CylinderTemplate, Template
from yellowiron.model.text import display

_SIZE_TOLERANCE = 0.02
"""Relative difference of bore or rod between sheet and CAD that is worth a finding."""
_STROKE_TOLERANCE = 0.002
"""Relative difference of the piston's travel in CAD and the stroke that is worth a finding (at least 0.5 mm)."""
_PASSIVE_ROOM = 0.05
"""A passive cylinder's limits are wider than its stroke by this share at each end: it must never stop its twin."""
UNKNOWN = "unknown"
"""How the source of a quantity begins that nothing gives."""


@dataclass(frozen=True)
class FittedCylinder:
    """A cylinder with what its slide and drive need beside it: the slide's `lower` and `upper` from the drawn pose
    (m), their `evidence`, the `retract_speed` (m/s) and the actuator's `sign` for it."""

    cylinder: Cylinder
    lower: float | None
    upper: float | None
    evidence: Mapping[str, Any]
    retract_speed: float
    sign: int


@dataclass(frozen=True)
class _Sizes:
    """One cylinder before its neighbours in the actuator are known."""

    template: CylinderTemplate
    barrel: str
    rod: str
    ram: Ram
    bore: Known
    rod_diameter: Known

    @property
    def push_area(self) -> float:
        return math.pi / 4.0 * self.bore.value**2

    @property
    def pull_area(self) -> float:
        return math.pi / 4.0 * (self.bore.value**2 - self.rod_diameter.value**2)


def fit_cylinders(
    placement: Placement, template: Template, frames: Mapping[str, JointFrame], specifications: Specifications
) -> tuple[dict[str, tuple[FittedCylinder, ...]], list[Finding]]:
    """The cylinders of every actuator that has any, by actuator name, the driven ones first."""
    findings: list[Finding] = []
    fitted = {}
    for actuator in template.actuators:
        if actuator.kind != "cylinder":
            continue
        whole = [c for c in actuator.cylinders if {c.slide, c.barrel_joint, c.rod_joint} <= frames.keys()]
        sizes = [_sizes(c, actuator, placement, frames, specifications, findings) for c in whole]
        # sorted() is stable: the template's order within driven and passive
        fitted[actuator.name] = tuple(
            _fit(one, sizes, actuator, placement, frames, specifications, findings)
            for one in sorted(sizes, key=lambda s: s.template.passive)
        )
    return fitted, findings


def _sizes(
    entry: CylinderTemplate,
    actuator: ActuatorTemplate,
    placement: Placement,
    frames: Mapping[str, JointFrame],
    specifications: Specifications,
    findings: list[Finding],
) -> _Sizes:
    slide, hung = frames[entry.slide], frames[entry.barrel_joint]
    barrel = next((b for b in slide.bodies if b in hung.bodies), slide.bodies[0])
    rod = next(b for b in slide.bodies if b != barrel)
    ram = measure_ram(placement, barrel, rod, extension_line(entry, frames))

    def size(quantity: str, drawn: float | None) -> Known:
        printed = known(specifications, actuator.specifications.get(quantity))
        if printed and drawn is not None and abs(drawn - printed.value) > _SIZE_TOLERANCE * printed.value:
            findings.append(
                Finding(
                    "MEC020",
                    "warning",
                    entry.slide,
                    f"The {_plain(quantity)} is {_mm(printed.value)} on the sheet and {_mm(drawn)} in the CAD "
                    "model; the sheet's is used.",
                    "Check that sheet and CAD model are of one machine.",
                )
            )
        if printed:
            drawn_words = f"; CAD {_mm(drawn)}" if drawn is not None else ""
            return Known(printed.value, printed.source + drawn_words)
        if drawn is not None:
            return Known(drawn, f"geometry: {_mm(drawn)}")
        return default(actuator, quantity, findings) or Known(0.0, UNKNOWN)

    return _Sizes(entry, barrel, rod, ram, size("bore", ram.bore), size("rod_diameter", ram.rod_diameter))


def extension_line(entry: CylinderTemplate, frames: Mapping[str, JointFrame]) -> Line:
    """A slide's line, from the foot of the barrel's pivot towards the rod's pivot."""
    slide, hung, held = frames[entry.slide], frames[entry.barrel_joint], frames[entry.rod_joint]
    axis = slide.axis if (held.anchor - hung.anchor) @ slide.axis >= 0.0 else -slide.axis
    return Line(slide.anchor + ((hung.anchor - slide.anchor) @ axis) * axis, axis)


def pivot_distance(hung: JointFrame, held: JointFrame) -> float:
    """Length between a cylinder's pivots, metres: across their axes where both are parallel pivots, else between their
    anchors."""
    between: Floats = held.anchor - hung.anchor
    hinges = hung.joint.type == "revolute" and held.joint.type == "revolute"
    if hinges and np.linalg.norm(np.cross(hung.axis, held.axis)) < math.sin(math.radians(0.5)):
        between = between - (between @ hung.axis) * hung.axis
    return float(np.linalg.norm(between))


def _fit(
    one: _Sizes,
    group: list[_Sizes],
    actuator: ActuatorTemplate,
    placement: Placement,
    frames: Mapping[str, JointFrame],
    specifications: Specifications,
    findings: list[Finding],
) -> FittedCylinder:
    entry = one.template
    drawn = pivot_distance(frames[entry.barrel_joint], frames[entry.rod_joint])
    stroke = _stroke(one, actuator, specifications, findings)
    closed = _closed_length(one, actuator, drawn, stroke.value, specifications, findings)
    pressure = known(specifications, actuator.specifications.get("pressure"))
    pressure = pressure or default(actuator, "pressure", findings) or Known(0.0, UNKNOWN)
    extend, retract = _speeds(one, group, actuator, stroke.value, specifications, findings)
    cylinder = Cylinder(
        name=_name(one),
        barrel=one.barrel,
        rod=one.rod,
        slide=entry.slide,
        barrel_joint=entry.barrel_joint,
        rod_joint=entry.rod_joint,
        bore=one.bore.value,
        rod_diameter=one.rod_diameter.value,
        stroke=stroke.value,
        closed_length=closed.value,
        drawn_length=drawn,
        pressure=pressure.value,
        push_force=pressure.value * one.push_area,
        pull_force=pressure.value * one.pull_area,
        speed=extend.value,
        passive=entry.passive,
        sources={
            "bore": one.bore.source,
            "rod_diameter": one.rod_diameter.source,
            "stroke": stroke.source,
            "closed_length": closed.source,
            "drawn_length": "geometry: between the pivots",
            "pressure": pressure.source,
            "speed": extend.source,
        },
    )
    lower, upper, evidence = _limits(cylinder, frames, specifications, findings)
    return FittedCylinder(cylinder, lower, upper, evidence, retract.value, entry.sign)


def _stroke(one: _Sizes, actuator: ActuatorTemplate, specifications: Specifications, findings: list[Finding]) -> Known:
    printed = known(specifications, actuator.specifications.get("stroke"))
    travel = one.ram.travel
    where = one.template.slide
    if printed is not None:
        if travel is None:
            return printed
        if abs(travel - printed.value) > max(5e-4, _STROKE_TOLERANCE * printed.value):
            findings.append(
                Finding(
                    "MEC021",
                    "warning",
                    where,
                    f"The piston can travel {_mm(travel)} in the CAD model, and the sheet's stroke is "
                    f"{_mm(printed.value)}.",
                    "Check the stroke; the extension in the CAD model is only known to that difference.",
                )
            )
        return Known(printed.value, f"{printed.source}; CAD: piston travel {_mm(travel)}")
    if travel is not None:
        found = Known(travel, f"geometry: piston travel {_mm(travel)}")
        words = f"it is the piston's travel in the CAD model, {_mm(travel)}"
    elif (assumed := default(actuator, "stroke", findings)) is not None:
        found, words = assumed, f"it is the template's default, {_mm(assumed.value)}"
    else:
        found, words = Known(0.0, UNKNOWN), "the slide is not limited"
    name = actuator.specifications.get("stroke", "the stroke")
    findings.append(Finding("MEC023", "warning", where, f"No sheet gives '{name}': {words}.", f'--set "{name}=… mm"'))
    return found


def _closed_length(
    one: _Sizes,
    actuator: ActuatorTemplate,
    drawn: float,
    stroke: float,
    specifications: Specifications,
    findings: list[Finding],
) -> Known:
    """The closed length by the best way there is; the source names what every other way gives."""
    printed = known(specifications, actuator.specifications.get("closed_length"))
    ways: list[Known] = []
    if printed is not None:
        ways.append(printed)
    if one.ram.to_base is not None:
        ways.append(Known(drawn - one.ram.to_base, "geometry: piston against base"))
    if one.ram.to_eye is not None:
        ways.append(Known(drawn - one.ram.to_eye, "geometry: rod eye against gland"))
    if ways:
        best, others = ways[0], ways[1:]
        compared = "".join(f"; {o.source}: {_mm(o.value)} ({(o.value - best.value) * 1e3:+.2f} mm)" for o in others)
        if best.source.endswith("gland"):
            findings.append(
                Finding(
                    "MEC022",
                    "warning",
                    one.template.slide,
                    "Its closed length is where the rod's eye would touch the gland: too short by the clearance there.",
                    _closed_hint(actuator),
                )
            )
        return Known(best.value, f"{best.source}: {_mm(best.value)}{compared}")
    findings.append(
        Finding(
            "MEC022",
            "warning",
            one.template.slide,
            "Neither sheet nor CAD model shows its closed length: drawn at mid-stroke until it is calibrated.",
            _closed_hint(actuator),
        )
    )
    return Known(drawn - 0.5 * stroke, f"{UNKNOWN}: mid-stroke assumed")


def _speeds(
    one: _Sizes,
    group: list[_Sizes],
    actuator: ActuatorTemplate,
    stroke: float,
    specifications: Specifications,
    findings: list[Finding],
) -> tuple[Known, Known]:
    """Speeds extending and retracting, m/s: as printed, from the cycle time over the stroke, else the flow over the
    area it has to fill. Cylinders of one actuator share the flow; one of opposite sign takes it on its rod side."""
    flow = known(specifications, actuator.specifications.get("flow"))
    speed = known(specifications, actuator.specifications.get("speed"))
    alike = [s for s in group if s.template.sign == one.template.sign]
    against = [s for s in group if s.template.sign != one.template.sign]
    out_area = sum(s.push_area for s in alike) + sum(s.pull_area for s in against)
    in_area = sum(s.pull_area for s in alike) + sum(s.push_area for s in against)

    def one_way(time_name: str, area: float) -> Known | None:
        timed = known(specifications, actuator.specifications.get(time_name))
        by_time = Known(stroke / timed.value, timed.source) if timed and timed.value > 0.0 and stroke > 0.0 else None
        by_flow = Known(flow.value / area, f"{flow.source} over {area * 1e4:.1f} cm²") if flow and area > 0.0 else None
        if by_time and by_flow:
            return Known(by_time.value, f"{by_time.source}; by flow {by_flow.value:.3f} m/s")
        return speed or by_time or by_flow

    extend, retract = one_way("extend_time", out_area), one_way("retract_time", in_area)
    if extend is None and retract is None:
        assumed = default(actuator, "speed", findings)
        pump = default(actuator, "flow", findings) if assumed is None else None
        if pump is not None and out_area > 0.0 and in_area > 0.0:
            return Known(pump.value / out_area, pump.source), Known(pump.value / in_area, pump.source)
        assumed = assumed or Known(0.0, UNKNOWN)
        return assumed, assumed
    if extend is None and retract is not None:
        ratio = in_area / out_area if out_area > 0.0 else 1.0
        extend = Known(retract.value * ratio, f"{retract.source}, by the ratio of areas")
    if retract is None and extend is not None:
        ratio = out_area / in_area if in_area > 0.0 else 1.0
        retract = Known(extend.value * ratio, f"{extend.source}, by the ratio of areas")
    assert extend is not None and retract is not None
    return extend, retract


def _limits(
    cylinder: Cylinder, frames: Mapping[str, JointFrame], specifications: Specifications, findings: list[Finding]
) -> tuple[float | None, float | None, dict[str, Any]]:
    """The slide's limits from the drawn pose: the template's limits of the extension, or 0 … stroke, less the
    extension."""
    joint = frames[cylinder.slide].joint
    low, low_evidence = limit(joint.lower, specifications)
    high, high_evidence = limit(joint.upper, specifications)
    low = 0.0 if low is None else low
    if high is None and cylinder.stroke > 0.0:
        high = cylinder.stroke
    evidence = {
        **{f"lower_{k}": v for k, v in low_evidence.items()},
        **{f"upper_{k}": v for k, v in high_evidence.items()},
    }
    if high is None:
        return None, None, evidence
    if not low - 1e-6 <= cylinder.extension <= high + 1e-6:
        findings.append(
            Finding(
                "MEC024",
                "warning",
                cylinder.slide,
                f"The cylinder is drawn at {_mm(cylinder.extension)} of extension, outside {_mm(low)} … {_mm(high)}.",
                "Check stroke and closed length; a legal start pose is used.",
            )
        )
    room = _PASSIVE_ROOM * (high - low) if cylinder.passive else 0.0
    return low - cylinder.extension - room, high - cylinder.extension + room, evidence


def _name(one: _Sizes) -> str:
    """The barrel's name without 'barrel': boom_cylinder_l."""
    return "_".join(word for word in one.barrel.split("_") if word != "barrel") or one.template.slide


def _closed_hint(actuator: ActuatorTemplate) -> str:
    name = actuator.specifications.get("closed_length")
    return f'--set "{name}=… mm"' if name else "Give the published ranges it can be calibrated with."


def _plain(quantity: str) -> str:
    return quantity.replace("_", " ")


def _mm(value: float) -> str:
    return display(value, "m", digits=6)
