"""The mechanism, in order: where the parts are, where the joints are, which joints are cut, what the cylinders can do,
what everything weighs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from yellowiron.mechanism import sensors, sites, values
from yellowiron.mechanism.actuation import cylinders, drives
from yellowiron.mechanism.actuation.direct_drives import (
    direct_drives,
    out_of_reach,
    with_direct_hinges,
    without_cylinders,
)
from yellowiron.mechanism.actuation.proportion import proportion_of
from yellowiron.mechanism.actuation.usual_hinges import hinges_driven_directly, with_senses
from yellowiron.mechanism.actuation.winches import winch_drives, winch_falls, winch_limits, with_winches
from yellowiron.mechanism.bodies import body, mass
from yellowiron.mechanism.bodies.choice import Choice
from yellowiron.mechanism.bodies.hidden_knuckles import with_knuckles
from yellowiron.mechanism.bodies.hidden_wheels import hidden_wheels, with_wheels
from yellowiron.mechanism.joints import chains
from yellowiron.mechanism.joints.couplings import with_hidden_couplings
from yellowiron.mechanism.joints.followers import with_followers
from yellowiron.mechanism.joints.frames import JointFrame, joint_frames, weld
from yellowiron.mechanism.joints.held_balls import with_held_balls
from yellowiron.mechanism.joints.kingpins import with_kingpins
from yellowiron.mechanism.joints.planarity import follow_first, make_parallel
from yellowiron.mechanism.joints.tree import Tree, links, loop_groups, loose_bodies, planar_loops
from yellowiron.mechanism.placement import Placement, ancestors, place
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import MechanismError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import HELD, STATED, Drive, Joint, Mechanism, Spring, Vector
from yellowiron.model.rows import as_drawn, names_known
from yellowiron.model.specification import Specifications
from yellowiron.model.template import JointTemplate, Material, Template
from yellowiron.support.graphs import blocks
from yellowiron.support.vectors import clean_triple


class Documents(Protocol):
    """What a user's own documents say of materials and collision, by role or CAD part name."""

    @property
    def materials(self) -> Mapping[str, Material]:
        """Materials by role or part name."""

    @property
    def collision(self) -> Mapping[str, str]:
        """Collision approximations by role or part name."""


def build_mechanism(
    assembly: Assembly,
    template: Template,
    alignment: Alignment,
    specifications: Specifications,
    *,
    name: str,
    documents: Documents | None = None,
    standing: Mapping[str, str] | None = None,
) -> Mechanism:
    """The machine in SI units and the machine frame, in the drawn pose.

    `template` has its variants decided (`choose`); `alignment` says which part moves with which body, and where the
    machine frame is. `documents` win over the template's materials and collision; `standing` names slides whose
    cylinders are to stand as drawn, and why. What could not be found is left out or guessed, with a finding; raises
    `MechanismError` only where no part is any body's.

    Pivot limits that follow from loops, gains, mobility and the branch signs of loops are the kinematics' part.
    """
    # Where the parts and the joints are.
    placement, findings = place(assembly, template, alignment)
    template = _standing(template, placement, assembly.name, findings)
    whole, template = template, _as_drawn(template, placement, findings)
    template, winches = with_winches(template)
    wheels = hidden_wheels(placement, template, findings)
    frames, remarks = joint_frames(placement, template, wheels)
    findings += remarks
    frames = without_cylinders(template, frames, standing or {})
    template, frames, direct, knuckles = with_kingpins(whole, template, frames, placement, findings)
    template, frames, couplings = with_hidden_couplings(whole, template, frames, placement)
    template, frames, crosses = with_held_balls(template, frames, findings)
    knuckles |= couplings | crosses
    idle = out_of_reach(template, frames, placement)
    frames = without_cylinders(template, frames, idle)
    template = cylinders.with_leaders(template, frames, findings)
    template, hinges = with_direct_hinges(template, frames, placement, idle | dict(standing or {}), findings)
    direct |= hinges

    # Which joints make the tree, which close its loops; axes of a loop exactly parallel.
    floating = chains.heads(placement, template, frames)
    frames = _weld_loose(frames, placement, template, floating, findings)
    tree = chains.span(template.root, floating, links(template, frames))
    findings += _uncuttable(tree, frames)
    frames, remarks = make_parallel(frames, loop_groups(planar_loops(tree.loops, frames)))
    findings += remarks
    frames, remarks = follow_first(frames, sorted(direct, key=lambda name: tree.bodies.index(tree.sides[name][1])))
    findings += remarks

    # What everything weighs.
    by_document = documents.materials if documents is not None else {}
    weighed: list[Finding] = []
    masses = mass.weigh(placement, template, specifications, by_document, tree.bodies, weighed)
    proportion = proportion_of(placement, masses, tree.bodies)

    # What moves them, how far and how hard.
    fitted, remarks = cylinders.fit_cylinders(placement, template, frames, specifications)
    findings += remarks
    powered = drives.slide_drives(template, fitted, proportion, findings)
    radii = chains.pitch_radii(placement, template, frames) | {name: wheel.radius for name, wheel in wheels.items()}
    motors = replace(template, actuators=tuple(a for a in template.actuators if not direct.keys() & {*a.joints}))
    powered |= drives.motor_drives(
        motors, frames, tree.sides, placement, specifications, findings, proportion=proportion, radii=radii
    )
    powered |= direct_drives(direct, frames) | winch_drives(template, frames, specifications, findings)
    stated = drives.stated_drives(template, frames, findings)
    powered |= stated
    actuators = drives.actuators(template, frames, fitted, stated, findings, winches=winches)
    falls = winch_falls(template, specifications)
    actuators = tuple(replace(a, falls=falls.get(a.name, 0)) for a in actuators)
    slides = {f.cylinder.slide: f for group in fitted.values() for f in group}
    reached = {f.cylinder.slide: (f.lower, f.upper, f.evidence) for f in slides.values()}
    reached |= winch_limits(template, frames, specifications, findings)
    joints = tuple(
        _joint(_sourced(frame, alignment), tree, reached, powered, specifications, findings)
        for frame in frames.values()
    )

    # The bodies.
    findings += weighed
    drawn = [b for b in tree.bodies if b not in wheels and b not in knuckles]
    origins = _origins(tree, frames) | {b: clean_triple(_middle(placement, b)) for b in floating}
    tokens = Choice(template, documents.collision if documents is not None else {}, template.collision)
    bodies = body.bodies(drawn, origins, placement, masses, tokens, findings)
    bodies = with_knuckles(bodies, knuckles, findings)
    bodies = with_wheels(bodies, tree.bodies, wheels, placement, masses, findings)

    # What has no cylinder carries what hangs on it; what nothing drives follows or is held.
    joints = hinges_driven_directly(
        template, joints, direct, lambda b: placement.points_of(placement.rows_of_body(b)), proportion, bodies
    )
    actuators = with_senses(template, actuators, joints, direct)
    joints = with_followers(joints, template, frames, findings)
    joints = _with_idle_held(joints, tree, findings)

    # What is named and what is sensed on it.
    named = sites.sites(template, frames, placement, findings)
    fitted_cylinders = tuple(f.cylinder for f in slides.values())
    sensed = sensors.sensors(template, named, frames, fitted_cylinders, placement, findings)

    findings = _told_once(findings, whole)
    return Mechanism(
        name=name,
        equipment_type=template.equipment_type,
        root=template.root,
        bodies=bodies,
        joints=joints,
        cylinders=fitted_cylinders,
        actuators=actuators,
        loops=tree.loops,
        sites=named,
        materials=masses.used,
        measurements=template.measurements,
        payload=template.payload,
        tests=template.tests,
        specifications=values.carried(specifications),
        findings=tuple(dict.fromkeys(findings)),
        sensors=sensed,
        floating=floating,
    )


def _standing(template: Template, placement: Placement, where: str, findings: list[Finding]) -> Template:
    """The template with a body as its root that the CAD model has: its own, else the one fewest joints away."""
    hint = "Give its parts that role in the alignment."
    if placement.has_body(template.root):
        return template
    ends = [template.bodies_of(j) for j in template.joints]
    near = [template.root]
    for name in near:
        beside = [str(b) for pair in ends if name in pair for b in pair if b is not None and b not in near]
        near += dict.fromkeys(beside)
    order = [*near, *(r.name for r in template.roles if r.rigid)]
    stand = next((name for name in order if placement.has_body(name)), None)
    if stand is None:
        raise MechanismError(f"No part of the CAD model is the root body '{template.root}'", where=where, hint=hint)
    words = f"No part of the CAD model is the root body: '{stand}' stands in for it."
    findings.append(Finding("MEC015", "error", template.root, words, hint))
    return replace(template, root=stand)


def _as_drawn(template: Template, placement: Placement, findings: list[Finding]) -> Template:
    """The template without axles, frames and slideways that are not drawn (`as_drawn`), with a finding for each."""
    names = [r.name for r in template.roles if r.rigid]
    merged = as_drawn(template, [name for name in names if placement.has_body(name)])
    merged_away = {name for name in names if not merged.role(name).rigid and not placement.has_body(name)}
    rolling = {template.body_of(str(r.parent)) for r in template.roles if r.kind == "wheel" and r.rigid}
    for name in names:
        # What hangs on an axle that is not drawn goes with it.
        if name in merged_away and template.body_of(str(template.role(name).parent)) not in merged_away:
            onto = merged.body_of(name)
            what = "its wheels turn on" if name in rolling else "it is one with"
            what = "what slides on it slides on" if template.role(name).kind == "arm" else what
            what = _across_coupling(name, template, merged) or f"{what} '{onto}'"
            words = f"No part of the CAD model is '{name}': {what}."
            findings.append(Finding("MEC017", "warning", name, words, "Give its parts that role in the alignment."))
    return merged


def _across_coupling(name: str, template: Template, merged: Template) -> str:
    """How a coupling that is not drawn has what it joins move, "" for what is no coupling."""
    known = {j.name for j in template.joints}
    bearer = str(merged.body_of(name))
    beside = {str(b) for j in template.joints if name in template.bodies_of(j) for b in template.bodies_of(j)}
    for joint in (j for j in merged.joints if j.name not in known and bearer in merged.bodies_of(j)):
        other = next(str(b) for b in merged.bodies_of(joint) if b != bearer)
        if other in beside:
            return (
                f"'{other}' turns on '{bearer}'" if joint.type != "fixed" else f"'{other}' and '{bearer}' move as one"
            )
    return ""


_IN_WORDS = ("MEC013", "MEC026", "MEC038")
"""Codes that say of an actuator that it has to do without its cylinders."""


def _told_once(findings: Sequence[Finding], template: Template) -> list[Finding]:
    """The findings, those on single joints of linkages that are not drawn, and on sensors of theirs, notes only where
    it is said what moves (or does not) instead."""
    without = {f.where for f in findings if f.code in _IN_WORDS}
    ends = {j.name: template.bodies_of(j) for j in template.joints if names_known(j, template)}
    slides = {c.slide for a in template.actuators if a.name in without for c in a.cylinders}
    theirs = {name for block in blocks(ends) if slides & {*block} for name in block}
    theirs |= {name for a in template.actuators if a.name in without for c in a.cylinders for name in c.joints}
    mounted = {s.name for s in template.sensors if (without | theirs) & {*map(str, s.mount.values())}}
    notes = {("MEC002", name) for name in theirs} | {("MEC060", name) for name in mounted}
    return [replace(f, severity="info") if (f.code, f.where) in notes else f for f in findings]


def _weld_loose(
    frames: Mapping[str, JointFrame],
    placement: Placement,
    template: Template,
    floating: Sequence[str],
    findings: list[Finding],
) -> dict[str, JointFrame]:
    """Frames with a weld for every group of bodies that no joint ties to the root, so that nothing falls apart; save
    the `floating` ones."""
    present = [r.name for r in template.roles if r.rigid and placement.has_body(r.name)]
    result = dict(frames)
    for loose in loose_bodies(template.root, present, links(template, frames)):
        if loose in floating:
            continue
        above = [r.name for r in ancestors(template, loose)[1:] if r.rigid and placement.has_body(r.name)]
        holder = above[0] if above else template.root
        joint = JointTemplate(f"{holder}2{loose}_weld_joint", "fixed", (holder, loose))
        result[joint.name] = weld(joint, (holder, loose), placement, method="weld: no joint leads to this body")
        words = f"No joint leads to the body '{loose}': it was welded to '{holder}'."
        hint = "See the findings on its joints; check its pins in the alignment."
        findings.append(Finding("MEC011", "error", loose, words, hint))
    return result


def _uncuttable(tree: Tree, frames: Mapping[str, JointFrame]) -> list[Finding]:
    """Findings on loops in which nothing but a weld or a slide was left to cut."""
    words = "Its loop has no pin that could be cut, so the {} joint was."
    kinds = {name: frames[name].joint.type for name in tree.cuts}
    return [
        Finding("MEC012", "error", name, words.format(kind), "Check the joints of the template.")
        for name, kind in kinds.items()
        if kind in ("fixed", "prismatic")
    ]


def _sourced(frame: JointFrame, alignment: Alignment) -> JointFrame:
    """A joint's frame, its source saying by which published dimensions its axis was placed, if it was."""
    by = alignment.calibrated.get(frame.joint.name)
    return frame if by is None else replace(frame, source={**frame.source, "axis": by})


def _joint(
    frame: JointFrame,
    tree: Tree,
    reached: Mapping[str, tuple[float | None, float | None, Mapping[str, Any]]],
    powered: Mapping[str, Drive],
    specifications: Specifications,
    findings: list[Finding],
) -> Joint:
    """A joint with its sides, sense, limits, drive and evidence; `reached`: how far slides of cylinders and ropes go,
    and the evidence of that."""
    entry = frame.joint
    body0, body1 = tree.sides[entry.name]
    # A slide's axis was found from its first body to its second; extension is from parent to child.
    turned = entry.type == "prismatic" and (body0, body1) != frame.bodies
    source: dict[str, Any] = dict(frame.source)
    if entry.name in reached:
        lower, upper, evidence = reached[entry.name]
        source |= evidence
    else:
        lower, upper = _limits(entry, specifications, source, findings)
    if "joint" in entry.documents:
        source["document"] = entry.documents["joint"]
    if entry.name in tree.cuts:
        source["cut"] = tree.cuts[entry.name]
    return Joint(
        name=entry.name,
        type=entry.type,
        body0=body0,
        body1=body1,
        anchor=clean_triple(frame.anchor),
        axis=clean_triple(-frame.axis if turned else frame.axis),
        lower=lower,
        upper=upper,
        cut=entry.name in tree.cuts,
        free=entry.free,
        drive=powered.get(entry.name),
        source=source,
        spring=_spring(entry),
    )


def _spring(entry: JointTemplate) -> Spring | None:
    """A joint's spring; where one that is to hold the machine as drawn rests is the kinematics' part."""
    if entry.rest is None:
        return None
    rest, as_drawn = (0.0, True) if isinstance(entry.rest, str) else (entry.rest, False)
    stated = ", ".join(name for name in ("stiffness", "damping", "rest") if getattr(entry, name) is not None)
    gains = entry.stiffness or 0.0, entry.damping or 0.0
    return Spring(*gains, rest, rest, as_drawn=as_drawn, source=f"{STATED}{stated}")


def _with_idle_held(joints: Sequence[Joint], tree: Tree, findings: list[Finding]) -> tuple[Joint, ...]:
    """The joints, those kept as drawn that nothing moves or holds: a barrel without its rod, a lone link, what follows
    a joint that stands."""
    closed = {name for loop in tree.loops for name in loop.joints}
    by_name = {joint.name: joint for joint in joints}

    def idle(joint: Joint) -> bool:
        if joint.free or joint.name in closed or joint.drive is not None:
            return False
        if joint.follows is not None:
            return idle(by_name[joint.follows.joint])
        return joint.type in ("revolute", "prismatic", "spherical")

    held = []
    for joint in joints:
        if idle(joint):
            words = f"Nothing moves or holds '{joint.body1}' on it: it stands as drawn."
            hint = "Give what is missing of its linkage in CAD, or make the joint free in a joints document (--data)."
            findings.append(Finding("MEC019", "warning", joint.name, words, hint))
            source = {**joint.source, "limits": "held as drawn"}
            joint = replace(joint, lower=-HELD, upper=HELD, source=source, follows=None)
        held.append(joint)
    return tuple(held)


def _limits(
    entry: JointTemplate, specifications: Specifications, source: dict[str, Any], findings: list[Finding]
) -> tuple[float | None, float | None]:
    """The template's limits; the evidence of those that a specification gives goes into `source`."""
    found: list[float | None] = []
    for side, stated in (("lower", entry.lower), ("upper", entry.upper)):
        number, evidence = values.limit(stated, specifications)
        source |= {f"{side}_{key}": value for key, value in evidence.items()}
        found.append(number)
        if "missing" in evidence:
            words = f"Its {side} limit '{evidence['missing']}' is not known: it is not limited there."
            findings.append(Finding("MEC050", "warning", entry.name, words, f'--set "{evidence["missing"]}=…"'))
    lower, upper = found
    if lower is not None and upper is not None and lower > upper:
        lower, upper = upper, lower
    return lower, upper


def _origins(tree: Tree, frames: Mapping[str, JointFrame]) -> dict[str, Vector]:
    """Each body's origin: the joint that leads to it; the root's is the machine's."""
    origins: dict[str, Vector] = dict.fromkeys(tree.bodies, (0.0, 0.0, 0.0))
    return origins | {b: clean_triple(frames[joint].anchor) for b, joint in tree.leading.items()}


def _middle(placement: Placement, name: str) -> Floats:
    """The middle of the box around a body's points."""
    points = placement.points_of(placement.rows_of_body(name))
    return np.asarray(0.5 * (points.min(axis=0) + points.max(axis=0)), dtype=np.float64)
