"""Hydraulic cylinders: sizes, stroke, closed length, forces and speeds, each with its source.

What decides, best first: what is set by hand, the user's documents, the sheet, the template's limits, the CAD model,
the template's defaults. Every way to a closed length is tried and
recorded, whichever is used.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from yellowiron.mechanism.actuation.cylinder_geometry import CylinderGeometry, measure_cylinder
from yellowiron.mechanism.actuation.proportion import FASTEST
from yellowiron.mechanism.joints.axes import Axis
from yellowiron.mechanism.joints.bearings import slide_bearing
from yellowiron.mechanism.joints.frames import JointFrame, barrel_end, drawn_rams
from yellowiron.mechanism.placement import Placement
from yellowiron.mechanism.tolerances import PARALLEL
from yellowiron.mechanism.values import Known, default, known, limit
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import DRAWN_OUTSIDE, ESTIMATE, UNKNOWN, Cylinder
from yellowiron.model.specification import Specifications
from yellowiron.model.template import ActuatorTemplate, CylinderTemplate, JointTemplate, Template
from yellowiron.support.text import display

_SIZE_TOLERANCE = 0.02
"""Relative difference of bore or rod between sheet and CAD that is worth a finding."""
_STROKE_TOLERANCE, _STROKE_SHARE = 5e-4, 0.002
"""Difference of the piston's travel in CAD and the stroke that is worth a finding: metres, and relative."""
_PASSIVE_ROOM = 0.05
"""A passive cylinder's limits are wider than its stroke by this share at each end: it must never stop its twin."""
_BY_EYE = "geometry: rod eye against gland"
WALL = 0.82
"""Bore over outer diameter of a barrel that shows none: welded cylinders have walls of about a tenth of their bore."""
_RATIO, _THIN = 2.0, 0.94
"""… where its rod leaves no pull with that: the bore that its area is so many times what it pulls with, the largest
ratio of ISO 7181 that machines lift and dig with, and no more than the second of the barrel's outer diameter."""

_ENGAGED = 0.25
"""Of a section: so much of it stays in the one it slides in. Masts and telescopes keep a fifth to a third."""
_DEAD, _SHARE, _LEAST = 4.0, 0.62, 0.4
"""A closed cylinder is longer than its stroke by so many bores, its stroke the second share of it where the bore is not
known, and never less than the third: of the six of the two examples 3.2 to 4.9 bores, 0.48 to 0.69."""


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


@dataclass(frozen=True, eq=False)
class _Work:
    """What every step needs, and where its findings go."""

    actuator: ActuatorTemplate
    placement: Placement
    template: Template
    frames: Mapping[str, JointFrame]
    specifications: Specifications
    findings: list[Finding]

    def printed(self, quantity: str) -> Known | None:
        """What a sheet (or the user) gives for one of the actuator's quantities."""
        return known(self.specifications, self.actuator.specifications.get(quantity))

    def assumed(self, quantity: str) -> Known | None:
        """What the template assumes, with a finding."""
        return default(self.actuator, quantity, self.findings)

    def warn(self, code: str, where: str, words: str, hint: str) -> None:
        """A warning."""
        self.findings.append(Finding(code, "warning", where, words, hint))

    def setting(self, quantity: str) -> str:
        """How a user gives a length by hand."""
        return f'--set "{self.actuator.specifications.get(quantity, quantity)}=… mm"'


@dataclass(frozen=True)
class _Sizes:
    """One cylinder before its neighbours in the actuator are known; areas are those of all `count` that are drawn as
    one, or that move its slide together. `length`: from the foot of a fixed barrel to the end of its rod, m, where they
    are drawn."""

    template: CylinderTemplate
    barrel: str
    rod: str
    geometry: CylinderGeometry
    bore: Known
    rod_diameter: Known
    count: int = 1
    length: float | None = None

    @property
    def push_area(self) -> float:
        return self.pull_area if self.template.rod_through else self.count * math.pi / 4.0 * self.bore.value**2

    @property
    def pull_area(self) -> float:
        return self.count * math.pi / 4.0 * (self.bore.value**2 - self.rod_diameter.value**2)


def with_leaders(template: Template, frames: Mapping[str, JointFrame], findings: list[Finding]) -> Template:
    """The template with a twin driven where the one it follows was not found."""
    actuators = []
    for actuator in template.actuators:
        present = [c for c in actuator.cylinders if c.slide in frames]
        if present and all(c.passive for c in present) and not actuator.slave:
            words = f"The cylinder it follows was not found: '{present[0].slide}' is driven in its place, alone."
            findings.append(
                Finding("MEC028", "warning", actuator.name, words, "Check its twin's parts in the alignment.")
            )
            cylinders = tuple(replace(c, passive=False) if c is present[0] else c for c in actuator.cylinders)
            actuator = replace(actuator, cylinders=cylinders)
        actuators.append(actuator)
    return replace(template, actuators=tuple(actuators))


def fit_cylinders(
    placement: Placement, template: Template, frames: Mapping[str, JointFrame], specifications: Specifications
) -> tuple[dict[str, tuple[FittedCylinder, ...]], list[Finding]]:
    """The cylinders of every actuator that has any, by actuator name, the driven ones first."""
    findings: list[Finding] = []
    fitted = {}
    for actuator in template.actuators:
        if actuator.kind == "cylinder":
            work = _Work(actuator, placement, template, frames, specifications, findings)
            whole = [c for c in actuator.cylinders if {*c.joints} <= frames.keys()]
            sizes = [_sizes(c, work) for c in whole]
            # sorted() is stable: the template's order within driven and passive
            driven_first = sorted(sizes, key=lambda s: s.template.passive)
            fitted[actuator.name] = tuple(_fit(one, sizes, work) for one in driven_first)
    return fitted, findings


def extension_axis(slide: JointFrame, hung: JointFrame, held: JointFrame) -> Axis:
    """A slide's line, from the foot of the barrel's pivot towards the rod's pivot."""
    axis = slide.axis if (held.anchor - hung.anchor) @ slide.axis >= 0.0 else -slide.axis
    return Axis(Axis(slide.anchor, axis).foot(hung.anchor), axis)


def pivot_distance(hung: JointFrame, held: JointFrame) -> float:
    """Length between a cylinder's pivots, metres: across their axes where both are parallel pivots, else between their
    anchors."""
    between: Floats = held.anchor - hung.anchor
    hinges = hung.joint.type == "revolute" and held.joint.type == "revolute"
    if hinges and np.linalg.norm(np.cross(hung.axis, held.axis)) < math.sin(PARALLEL):
        between = between - (between @ hung.axis) * hung.axis
    return float(np.linalg.norm(between))


def _sizes(entry: CylinderTemplate, work: _Work) -> _Sizes:
    slide = work.frames[entry.slide]
    if entry.pins:
        hung, held = (work.frames[name] for name in entry.pins)
        barrel = next((b for b in slide.bodies if b in hung.bodies), slide.bodies[0])
        rod = next(b for b in slide.bodies if b != barrel)
        rows = work.placement.rows_of_body(barrel), work.placement.rows_of_body(rod)
        geometry = measure_cylinder(work.placement, *rows, extension_axis(slide, hung, held))
        count, length = geometry.count, None
    else:
        end = barrel_end(entry, work.template, slide.bodies)
        barrel, rod = slide.bodies[end], slide.bodies[1 - end]
        geometry, count, length = _fixed(entry, end, work)
    bore = _size("bore", geometry.bore, entry.slide, work)
    diameter = _size("rod_diameter", geometry.rod_diameter, entry.slide, work)
    if bore.value == 0.0 and geometry.outer is not None:
        bore = _unbored(geometry.outer, diameter.value, entry, work)
    if count > 1:
        bore = Known(bore.value, f"{bore.source}; {count} cylinders {'drawn' if entry.pins else 'moving'} as one")
    return _Sizes(entry, barrel, rod, geometry, bore, diameter, count, length)


def _unbored(outer: float, rod: float, entry: CylinderTemplate, work: _Work) -> Known:
    """The bore of a barrel that is drawn without one, with a finding."""
    about_rod = min(rod * math.sqrt(_RATIO / (_RATIO - 1.0)), _THIN * outer)
    bore = max(WALL * outer, about_rod)
    share = f"{bore / outer:.2g} of the barrel's outer {_mm(outer)}, without a bore"
    why = f"; {WALL:g} would leave its rod of {_mm(rod)} hardly a pull" if bore > WALL * outer else ""
    words = (
        f"The barrel is drawn without its bore: {_mm(bore)} was taken, {bore / outer:.2g} of its outer diameter{why}."
    )
    name = work.actuator.specifications.get("bore", "bore")
    work.warn("MEC029", entry.slide, words, f'--set "{name}=… mm"')
    return Known(bore, f"geometry: {share}{why}")


def _fixed(entry: CylinderTemplate, end: int, work: _Work) -> tuple[CylinderGeometry, int, float | None]:
    """What the CAD model shows of a cylinder without pins: the first of its rams that is drawn, how many move the slide
    together, and how long the first is as drawn, metres."""
    slide, placement = work.frames[entry.slide], work.placement
    drawn = drawn_rams(entry, placement, work.template, slide.bodies)
    if not drawn:
        return CylinderGeometry(), max(1, len(entry.rams)), None
    barrel, rod = drawn[0][end], drawn[0][1 - end]
    axis = -slide.axis if end else slide.axis
    own = slide_bearing(placement, (barrel, rod), (None, None), None)
    line = Axis(own.line.point if own is not None else slide.anchor, axis)
    geometry = measure_cylinder(placement, barrel, rod, line, through=entry.rod_through)
    foot, tip = line.along(placement.points_of(barrel)).min(), line.along(placement.points_of(rod)).max()
    return geometry, len(drawn), float(tip - foot)


def _size(quantity: str, drawn: float | None, slide: str, work: _Work) -> Known:
    """A diameter: the sheet's, else the CAD model's, else the template's; 0 where nothing gives it."""
    printed = work.printed(quantity)
    if printed is None:
        if drawn is not None:
            return Known(drawn, f"geometry: {_mm(drawn)}")
        return work.assumed(quantity) or Known(0.0, UNKNOWN)
    if drawn is None:
        return printed
    if abs(drawn - printed.value) > _SIZE_TOLERANCE * printed.value:
        name = quantity.replace("_", " ")
        words = f"The {name} is {_mm(printed.value)} on the sheet, which is used, and {_mm(drawn)} in the CAD model."
        work.warn("MEC020", slide, words, "Check that sheet and CAD model are of one machine.")
    return Known(printed.value, f"{printed.source}; CAD {_mm(drawn)}")


def _fit(one: _Sizes, group: list[_Sizes], work: _Work) -> FittedCylinder:
    entry = one.template
    between = "between the pivots"
    if entry.pins:
        hung, held = (work.frames[name] for name in entry.pins)
        drawn = pivot_distance(hung, held)
        stroke = _stroke(one, drawn, work)
        closed = _closed_length(one, drawn, stroke.value, work)
    else:
        between = "from the barrel's foot to the rod's end" if one.length is not None else "none: no ram is drawn"
        stroke = _stroke(one, one.length or 0.0, work)
        drawn = stroke.value if one.length is None else one.length
        closed = _closed_length(one, drawn, stroke.value, work)
    pressure = work.printed("pressure") or work.assumed("pressure") or Known(0.0, UNKNOWN)
    extend, retract = _speeds(one, group, stroke.value, work)
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
            "drawn_length": f"geometry: {between}",
            "pressure": pressure.source,
            "speed": extend.source,
        },
    )
    lower, upper, evidence = _limits(cylinder, work)
    return FittedCylinder(cylinder, lower, upper, evidence, retract.value, entry.sign)


def _stroke(one: _Sizes, drawn: float, work: _Work) -> Known:
    """The stroke: set by hand, else a document's limit of the slide, else the sheet's, else the template's limit, else
    the piston's travel in the CAD model, else what its sections allow that slide in each other, else the template's
    default, else what a cylinder of its length has."""
    printed, travel, slide = work.printed("stroke"), one.geometry.travel, one.template.slide
    joint = work.frames[slide].joint
    limited = _limited(joint, work)
    if limited is not None and (printed is None or ("limit" in joint.documents and not _by_hand(printed.source))):
        printed = limited
    if printed is not None and travel is None:
        return printed
    if printed is not None and travel is not None:
        if abs(travel - printed.value) > max(_STROKE_TOLERANCE, _STROKE_SHARE * printed.value):
            words = f"The piston can travel {_mm(travel)} in the CAD model; the stroke is {_mm(printed.value)}."
            hint = "Check the stroke; the extension in the CAD model is only known to that difference."
            work.warn("MEC021", slide, words, hint)
        return Known(printed.value, f"{printed.source}; CAD: piston travel {_mm(travel)}")
    if travel is not None:
        found = Known(travel, f"geometry: piston travel {_mm(travel)}")
        words = f"it is the piston's travel in the CAD model, {_mm(travel)}"
    elif (sections := _sections_stroke(one, work)) is not None:
        found = Known(sections, f"{ESTIMATE}: as its sections stay in each other, {_mm(sections)}")
        words = f"{_mm(sections)} is taken, over which a quarter of '{one.rod}' stays in '{one.barrel}'"
    elif (assumed := work.assumed("stroke")) is not None:
        found, words = assumed, f"it is the template's, {_mm(assumed.value)}"
    elif not drawn:
        found, words = Known(0.0, UNKNOWN), "its slide has no end"
    else:
        usual = _usual_stroke(one, drawn)
        found = Known(usual, f"{ESTIMATE}: usual of cylinders of this length, {_mm(usual)}")
        words = f"{_mm(usual)} is taken, as is usual of cylinders of this length"
    name = work.actuator.specifications.get("stroke", "the stroke")
    work.warn("MEC023", slide, f"No sheet gives '{name}': {words}.", work.setting("stroke"))
    return found


def _sections_stroke(one: _Sizes, work: _Work) -> float | None:
    """How far a body may slide out of another one that it is guided in (a mast's section, a telescope's), so that the
    last `_ENGAGED` of it stays in; None of cylinders with pins, and of bodies that are not in each other."""
    entry = one.template
    if entry.pins or entry.rod_through:
        return None
    slide = work.frames[entry.slide]
    axis = slide.axis if slide.bodies[0] == one.barrel else -slide.axis
    outer, inner = (work.placement.points_of(work.placement.rows_of_body(b)) @ axis for b in (one.barrel, one.rod))
    if not len(outer) or not len(inner):
        return None
    stroke = float(outer.max() - inner.min() - _ENGAGED * (inner.max() - inner.min()))
    return stroke if stroke > _ENGAGED * float(np.ptp(inner)) else None


def _usual_stroke(one: _Sizes, drawn: float) -> float:
    """The stroke of a cylinder whose pivots are `drawn` metres apart: what its closed length leaves, which is where the
    rod's eye meets the gland, else half a stroke less; at least as far as it is drawn out."""
    out = one.geometry.to_eye
    dead = _DEAD * one.bore.value
    if out is not None and out < drawn:
        closed = drawn - out
    elif dead:
        closed = (drawn + 0.5 * dead) / 1.5
    else:
        closed = drawn / (1.0 + 0.5 * _SHARE)
    return max(closed - dead if dead else _SHARE * closed, _LEAST * closed, out or 0.0)


def _limited(joint: JointTemplate, work: _Work) -> Known | None:
    """The stroke that a slide's own upper limit states, where it is a number; with its source."""
    upper, named = limit(joint.upper, work.specifications)
    if named or upper is None or not upper > 0.0:
        return None
    document = joint.documents.get("limit")
    source = f"data: {document}" if document else "template"
    return Known(upper, f"{source}: limit of {joint.name}, {_mm(upper)}")


def _by_hand(source: str) -> bool:
    return source.startswith("set:")


def _closed_length(one: _Sizes, drawn: float, stroke: float, work: _Work) -> Known:
    """The closed length by the best way there is; the source names what every other way gives."""
    printed = work.printed("closed_length")
    ways = [printed] if printed is not None else []
    if one.geometry.to_base is not None:
        ways.append(Known(drawn - one.geometry.to_base, "geometry: piston against base"))
    if one.geometry.to_eye is not None:
        ways.append(Known(drawn - one.geometry.to_eye, _BY_EYE))
    slide, hint = one.template.slide, work.setting("closed_length")
    if not ways or (one.length is None and not one.template.pins):
        # What lifts or props stands low in a model; what comes out at both ends stands in the middle.
        low = not one.template.pins and not one.template.rod_through
        where = "closed" if low else "at mid-stroke"
        words = f"Neither sheet nor CAD model shows its closed length: drawn {where} until it is calibrated."
        work.warn("MEC022", slide, words, hint)
        if low:
            return Known(drawn, f"{UNKNOWN}: closed assumed")
        return Known(drawn - 0.5 * stroke, f"{UNKNOWN}: mid-stroke assumed")
    best, *others = ways
    if best.source == _BY_EYE and 0.0 < stroke < drawn - best.value:
        # The eye never reaches the gland: as it is drawn, the cylinder is at the end of its stroke at most.
        best = Known(drawn - stroke, f"{UNKNOWN}: drawn at the end of its stroke, at most")
        words = "Its closed length is such that it is drawn at the end of its stroke: it cannot be out any further."
        work.warn("MEC022", slide, words, hint)
    if best.source == _BY_EYE:
        words = "Its closed length is where the rod's eye would touch the gland: too short by the clearance there."
        work.warn("MEC022", slide, words, hint)
    compared = [f"{o.source}: {_mm(o.value)} ({(o.value - best.value) * 1e3:+.2f} mm)" for o in others]
    return Known(best.value, "; ".join((f"{best.source}: {_mm(best.value)}", *compared)))


def _speeds(one: _Sizes, group: list[_Sizes], stroke: float, work: _Work) -> tuple[Known, Known]:
    """Speeds extending and retracting, m/s: as printed, from the cycle time over the stroke, else the flow over the
    area it has to fill. Cylinders of one actuator share the flow; one of opposite sign takes it on its rod side."""
    alike = [s for s in group if s.template.sign == one.template.sign]
    against = [s for s in group if s.template.sign != one.template.sign]
    out_area = sum(s.push_area for s in alike) + sum(s.pull_area for s in against)
    in_area = sum(s.pull_area for s in alike) + sum(s.push_area for s in against)
    if not (out_area > 0.0 and in_area > 0.0):
        speed = work.printed("speed") or work.assumed("speed") or Known(0.0, UNKNOWN)
        return speed, speed
    flow = work.printed("flow")
    extend = _speed("extend_time", stroke, flow, out_area, work)
    retract = _speed("retract_time", stroke, flow, in_area, work)
    if extend is None and retract is None:
        if (assumed := work.assumed("speed")) is not None:
            return assumed, assumed
        flow = work.assumed("flow") or Known(0.0, UNKNOWN)
        most = stroke / FASTEST if stroke > 0.0 else math.inf
        longest = work.actuator.defaults.get("extend_time", 0.0)
        least = stroke / longest if longest > 0.0 else 0.0
        return _by_default(flow, out_area, least, most), _by_default(flow, in_area, least, most)
    # One way known: the same flow fills the other side.
    if extend is None and retract is not None:
        extend = Known(retract.value * in_area / out_area, f"{retract.source}, by the ratio of areas")
    if retract is None and extend is not None:
        retract = Known(extend.value * out_area / in_area, f"{extend.source}, by the ratio of areas")
    assert extend is not None and retract is not None
    return extend, retract


def _by_default(flow: Known, area: float, least: float, most: float) -> Known:
    """The speed (m/s) of the default flow over an area (m²), within bounds: a far larger machine has larger pumps."""
    speed = flow.value / area
    if speed < least:
        return Known(least, f"{flow.source}, no slower than such machines are")
    return Known(min(speed, most), flow.source)


def _speed(time: str, stroke: float, flow: Known | None, area: float, work: _Work) -> Known | None:
    """The speed one way that the sheet gives: itself, from the time it takes, or from the flow; the flow's beside
    it."""
    timed = work.printed(time)
    by_flow = Known(flow.value / area, f"{flow.source} over {area * 1e4:.1f} cm²") if flow is not None else None
    if (printed := work.printed("speed")) is not None:
        return printed
    if timed is None or timed.value <= 0.0 or stroke <= 0.0:
        return by_flow
    beside = f"; by flow {by_flow.value:.3f} m/s" if by_flow is not None else ""
    return Known(stroke / timed.value, timed.source + beside)


def _limits(cylinder: Cylinder, work: _Work) -> tuple[float | None, float | None, dict[str, Any]]:
    """The slide's limits from the drawn pose: the template's limits of the extension, or 0 … stroke, less the
    extension."""
    joint = work.frames[cylinder.slide].joint
    low, low_evidence = limit(joint.lower, work.specifications)
    high, high_evidence = limit(joint.upper, work.specifications)
    evidence = {f"lower_{k}": v for k, v in low_evidence.items()} | {f"upper_{k}": v for k, v in high_evidence.items()}
    low = 0.0 if low is None else low
    if high is not None and not high_evidence and _by_hand(cylinder.sources["stroke"]):
        # A stroke set by hand wins over a limit that is a number; one that names the stroke has it already.
        high, evidence["upper_source"] = cylinder.stroke, "set"
    elif (document := joint.documents.get("limit")) is not None:
        evidence["limits"] = f"data: {document}"
    if high is None and cylinder.stroke > 0.0:
        high = cylinder.stroke
    if high is None:
        return None, None, evidence
    if not low - DRAWN_OUTSIDE <= cylinder.extension <= high + DRAWN_OUTSIDE:
        words = f"The cylinder is drawn {_mm(cylinder.extension)} out, outside {_mm(low)} … {_mm(high)}."
        work.warn("MEC024", cylinder.slide, words, "Check stroke and closed length; a legal start pose is used.")
    room = _PASSIVE_ROOM * (high - low) if cylinder.passive else 0.0
    return low - cylinder.extension - room, high - cylinder.extension + room, evidence


def _name(one: _Sizes) -> str:
    """The barrel's name without 'barrel': boom_cylinder_l; of one without pins that of its ram, of several without a
    side: lift_cylinder."""
    rams = one.template.rams
    if not one.template.pins and not rams:
        return one.template.slide.removesuffix("_joint")
    words = (rams[0][0] if rams else one.barrel).split("_")
    left_out = ("barrel", "l", "r") if len(rams) > 1 else ("barrel",)
    return "_".join(word for word in words if word not in left_out) or one.template.slide


def _mm(value: float) -> str:
    return display(value, "m", digits=6)
