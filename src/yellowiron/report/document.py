"""`report.json`: everything a build decided and measured, as one document (docs/report.md)."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Body, Joint, Measurement, Mechanism
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import Template
from yellowiron.report.verdict import levers_of, verdict
from yellowiron.support.text import to_json

REVOLUTE_TOLERANCE = 0.1
"""Degrees: how far a measured angle may be from a published one before the build falls short."""
RELATIVE_TOLERANCE = 0.2
"""Percent: the same for every other quantity."""


@dataclass(frozen=True, eq=False)
class BuildFacts:
    """What a build's stages gave, for its report. `findings`: those that no other value here carries; `usd_counts`: of
    joints in the written file; `colliders`: body → how many it has there by detail; `levers`: actuator → its table;
    `simulation`: engine → its document; `declared`: the joints that the CAD file itself declares, beside what was
    found."""

    mechanism: Mechanism
    template: Template
    alignment: Alignment
    specifications: Specifications
    measurements: Sequence[Measurement] = ()
    findings: Sequence[Finding] = ()
    usd_counts: Mapping[str, int] = field(default_factory=dict)
    colliders: Mapping[str, Mapping[str, int]] = field(default_factory=dict)
    levers: Mapping[str, Any] = field(default_factory=dict)
    simulation: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    declared: Sequence[Any] = ()


def report_document(facts: BuildFacts) -> dict[str, Any]:
    """The document behind `report.json` and `report.html`. SI units, machine frame, radians."""
    mechanism, alignment = facts.mechanism, facts.alignment
    everything = (*facts.findings, *facts.specifications.findings, *alignment.findings, *mechanism.findings)
    return {
        "machine": mechanism.name,
        "verdict": verdict(levers_of(mechanism, facts.template, alignment)),
        "equipment_type": mechanism.equipment_type,
        "frame": alignment.frame,
        "alignment": _alignment_counts(alignment),
        "specifications": [specification_entry(s) for s in facts.specifications],
        "bodies": [{**_body_entry(b), "colliders": dict(facts.colliders.get(b.name, {}))} for b in mechanism.bodies],
        "joints": [_joint_entry(j) for j in mechanism.joints],
        "declared_joints": [asdict(d) for d in facts.declared],
        "cylinders": [{**asdict(c), "extension": c.extension} for c in mechanism.cylinders],
        "actuators": [asdict(a) for a in mechanism.actuators],
        "loops": [asdict(loop) for loop in mechanism.loops],
        "levers": dict(facts.levers),
        "sensors": [asdict(s) for s in mechanism.sensors],
        "counts": _counts(mechanism, facts.template),
        "usd_counts": dict(facts.usd_counts),
        "mobility": asdict(mechanism.mobility) if mechanism.mobility else None,
        "measurements": [asdict(m) for m in facts.measurements],
        "findings": [asdict(f) for f in _unique(everything)],
        "simulation": {engine: _repeatable(run) for engine, run in facts.simulation.items()},
        "missing": missing_limits(facts.template, facts.specifications, built={j.name for j in facts.mechanism.joints}),
    }


def specification_entry(specification: Specification) -> dict[str, Any]:
    """One specification as `report.json` and `extract --json` give it."""
    evidence = specification.evidence
    return {
        "name": specification.name,
        "value": specification.value,
        "unit": specification.unit,
        "status": specification.status,
        "example": specification.example,
        "page": evidence.page if evidence else None,
        "quote": evidence.quote if evidence else None,
        "box": evidence.box if evidence else None,
        "file": evidence.file if evidence else None,
        "source": specification.source,
        "confidence": specification.confidence,
        "reason": specification.reason,
        "hint": specification.hint,
        "candidates": [
            {"value": c.value, "unit": c.unit, "page": c.evidence.page, "quote": c.evidence.quote,
             "box": c.evidence.box, "file": c.evidence.file, "configuration": c.configuration}
            for c in specification.candidates
        ],
    }  # fmt: skip


def alignment_entry(alignment: Alignment) -> dict[str, Any]:
    """An alignment as `align --json` gives it."""
    return {
        "frame": alignment.frame,
        "choices": dict(alignment.choices),
        "parts": [_part_entry(a) for a in alignment.parts],
        "missing": list(alignment.missing),
        "to_review": list(alignment.to_review),
        "findings": [asdict(f) for f in alignment.findings],
    }


def _part_entry(entry: PartAssignment) -> dict[str, Any]:
    said = {key: getattr(entry, key) for key in ("part", "role", "body", "confidence", "reason")}
    return {**said, **({"suggestion": asdict(entry.suggestion)} if entry.suggestion is not None else {})}


def within_tolerance(measurement: Measurement) -> bool | None:
    """Whether a measurement meets its specification (0.2 %, or 0.1° for an angle); None where either is unknown."""
    if measurement.spec is None or measurement.model is None:
        return None
    gap = abs(measurement.model - measurement.spec)
    if measurement.unit == "rad":
        return gap <= REVOLUTE_TOLERANCE * 3.141592653589793 / 180.0
    return gap <= RELATIVE_TOLERANCE / 100.0 * abs(measurement.spec)


def fell_short(document: Mapping[str, Any]) -> list[str]:
    """What a person must still look at, one phrase each; empty when the machine is ready (exit code 0)."""
    unplayed = set(document["alignment"]["missing"])
    reasons = [f"missing: {name}" for name in document["missing"]]
    reasons += [f"no part plays {role}" for role in document["alignment"]["missing"]]
    reasons += [f"to review: {item}" for item in document["alignment"]["to_review"] if item not in unplayed]
    reasons += [
        f"{s['status']}: {s['name']}"
        for s in document["specifications"]
        if s["status"] in ("conflict", "review", "unreadable")
    ]
    reasons += [
        f"{f['code']} {f['where']}: {_with_hint(f['message'], f['hint'])}"
        for f in document["findings"]
        # Of a role that no part plays all is said above.
        if f["severity"] != "info" and not (f["code"] == "ALN001" and f["where"] in unplayed)
    ]
    reasons += [
        f"{f['code']} {engine}, {f['where']}: {f['message']}"
        for engine, run in document["simulation"].items()
        for f in run["findings"]
        if f.get("severity") != "info"
    ]
    mobility = document["mobility"]
    if mobility is not None and mobility["computed"] != mobility["expected"]:
        reasons.append(f"mobility {mobility['computed']}, expected {mobility['expected']}")
    for entry in document["measurements"]:
        if entry["role"] == "checked" and within_tolerance(Measurement(**entry)) is False:
            reasons.append(f"off the sheet: {entry['name']} by {entry['error_percent']:+.2f} %")
    return reasons


def _with_hint(message: str, hint: str) -> str:
    if not hint:
        return message
    return f"{message} {hint}" if message.endswith((".", ":", "!", "?")) else f"{message}. {hint}"


def write_document(document: Mapping[str, Any], path: Path) -> None:
    """Writes a document as JSON, the same bytes for the same content. A byte of a file's name that is no letter in any
    encoding is written as JSON spells it."""
    path.write_text(to_json(document), encoding="utf-8", errors="backslashreplace")


def _repeatable(run: Mapping[str, Any]) -> dict[str, Any]:
    """A simulation's document without its steps per second. They differ from run to run: they belong to the console,
    not to a file that should not."""
    return {key: value for key, value in run.items() if key != "steps_per_second"}


def _alignment_counts(alignment: Alignment) -> dict[str, Any]:
    return {
        "parts": len(alignment.parts),
        "assigned": sum(a.body is not None for a in alignment.parts),
        "to_review": list(alignment.to_review),
        "missing": list(alignment.missing),
        "choices": dict(alignment.choices),
    }


def _body_entry(body: Body) -> dict[str, Any]:
    return {
        "name": body.name,
        "mass": body.mass,
        "center_of_mass": body.center_of_mass,
        "inertia": body.inertia,
        "parts": [p.part for p in body.parts],
        "source": body.source,
    }


def _joint_entry(joint: Joint) -> dict[str, Any]:
    entry = asdict(joint)
    drive, more = entry.pop("drive"), {key: entry.pop(key) for key in ("follows", "spring")}
    return {**entry, "drive": drive, **{key: value for key, value in more.items() if value}}


def _counts(mechanism: Mechanism, template: Template) -> dict[str, int]:
    """The template's joints and drives as modelled, before cuts and before one of a twin becomes passive."""
    built = {j.name for j in mechanism.joints}
    types = [j.type for j in mechanism.joints]
    drives = [j.drive for j in template.joints if j.name in built]
    return {
        "bodies": len(mechanism.bodies),
        **{kind: types.count(kind) for kind in ("revolute", "prismatic", "fixed", "spherical", "distance")},
        "linear_drives": drives.count("linear"),
        "angular_drives": drives.count("angular"),
        "loops": len(mechanism.loops),
    }


def missing_limits(
    template: Template, specifications: Specifications, *, built: Collection[str] | None = None
) -> list[str]:
    """Names that a joint limit needs and nothing gives: what a person must supply. `built`: the joints that there are;
    what another would need is asked of nobody."""
    names: dict[str, None] = {}
    for joint in (each for each in template.joints if built is None or each.name in built):
        for limit in (joint.lower, joint.upper):
            if isinstance(limit, str):
                name = limit.lstrip("-− ").strip()
                if specifications.number(name) is None:
                    names[name] = None
    return list(names)


def _unique(findings: Sequence[Finding]) -> list[Finding]:
    """Findings once each, the gravest first, otherwise in the order they came."""
    order = {"error": 0, "warning": 1, "info": 2}
    return sorted(dict.fromkeys(findings), key=lambda f: order[f.severity])
