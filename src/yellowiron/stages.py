"""What a build does between reading and writing, of what it read: roles, the sheet's say, the mechanism."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from yellowiron import cad, kinematics, library, specs
from yellowiron.alignment import (
    align,
    as_said,
    between_apart,
    between_found,
    decide,
    declared_roles,
    in_one_unit,
    of_drawn,
    other_size,
    parts_in,
    read_alignment,
    reviewed,
    said_in,
    scaled,
    squared,
    to_scale,
    turned_back,
    twin_role,
)
from yellowiron.mechanism import (
    at_known_places,
    build_mechanism,
    compare_declared,
    declared_findings,
    declared_values,
)
from yellowiron.model.alignment import UNDECIDED, Alignment, Decisions
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import MechanismError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.rows import expand
from yellowiron.model.specification import Specifications, fold
from yellowiron.model.template import Template, choose, in_position
from yellowiron.said import without_cylinders
from yellowiron.solved import Solved
from yellowiron.support.caching.disk import kept
from yellowiron.support.caching.recent import recent
from yellowiron.support.vectors import triple


def solve(
    template: Template,
    assembly: Assembly,
    alignment: Alignment,
    specifications: Specifications,
    data: library.Documents,
    choices: Mapping[str, str],
) -> Solved:
    """The mechanism of an aligned CAD model: axes put where the sheet has them, values that the CAD file declares lent,
    the machine brought to a pose within its limits."""
    chosen = as_said(template, alignment, {**alignment.choices, **choices})
    specifications = _missed(specifications, template, chosen)
    template = in_position(at_known_places(expand(chosen, alignment.counts), specifications))
    alignment, tape = on_sheet(assembly, template, alignment, specifications, data)
    mechanism = complete_mechanism(assembly, template, alignment, specifications, data)
    compared = compare_declared(mechanism, assembly, alignment)
    lent = declared_values(mechanism, template, assembly, alignment, compared, specifications)
    if lent.values:
        specifications = specs.merge(lent, specifications)
        mechanism = complete_mechanism(assembly, template, alignment, specifications, data)
    start = kinematics.legal_start(mechanism, {j.name: float(j.at) for j in template.joints if j.at})
    if start is not None:
        assembly, template, alignment = kinematics.started(assembly, template, alignment, start)
        template = in_position(template)
        mechanism = complete_mechanism(assembly, template, alignment, specifications, data)
        mechanism = replace(mechanism, findings=(*mechanism.findings, *start.findings))
    mechanism = replace(mechanism, findings=(*mechanism.findings, *tape))
    moved = start.coordinates if start is not None else {}
    return Solved(chosen, template, assembly, alignment, mechanism, specifications, compared, moved)


def _missed(specifications: Specifications, template: Template, chosen: Template) -> Specifications:
    """The specifications without what no sheet has and what this machine, its variants `chosen`, has no use for."""
    of_others = {fold(w.name) for w in template.wanted} - {fold(w.name) for w in chosen.wanted}
    kept = {
        name: value
        for name, value in specifications.values.items()
        if fold(name) not in of_others or value.status not in ("missing", "unreadable")
    }
    return replace(specifications, values=kept) if len(kept) < len(specifications) else specifications


def find_roles(
    assembly: Assembly,
    template: Template,
    specifications: Specifications,
    *,
    earlier: Path | None = None,
    data: library.Documents | None = None,
    choices: Mapping[str, str] | None = None,
    decisions: Decisions = UNDECIDED,
) -> tuple[Assembly, Alignment]:
    """Roles for the parts of a CAD model, and the model whose parts they are: scaled where the sheet's overall length
    asks for it; left and right hydraulic cylinders in one mesh apart, where they were taken for one of the two; left
    and right wheels in one mesh apart, if that finds two that were missing; hydraulic cylinders that are drawn into
    other meshes taken out, where that finds a barrel and a rod that were missing; where bodies are missing, or every
    mesh may be a whole one, taken apart, if that finds a limb, two wheels, or most of what is missing. `earlier` is an
    alignment file whose edits hold, and whose parts are the model's as long as a person decides on them; `decisions` go
    before them. Parts in another unit than the rest are put in its unit first, and are for review; and the whole model
    in the sheet's size, where what was found is another size throughout."""
    assembly, units = in_one_unit(assembly)

    def found(assembly: Assembly, specifications: Specifications) -> tuple[Assembly, Alignment]:
        return _roles_in_one_unit(
            assembly, template, specifications, earlier=earlier, data=data, choices=choices, decisions=decisions
        )

    model, best = found(assembly, specifications)
    other = other_size(assembly, _sizes(model, template, best, specifications, choices or {}))
    if other is not None:
        factor, finding = other
        if factor != 1.0:
            # A size that is known within a tenth tells no cylinder by its bore.
            model, best = found(scaled(assembly, factor), without_cylinders(specifications, template))
        model = replace(model, findings=(*model.findings, finding))
    return model, reviewed(best, model, units)


def _sizes(
    assembly: Assembly,
    template: Template,
    alignment: Alignment,
    specifications: Specifications,
    choices: Mapping[str, str],
) -> Mapping[str, tuple[float, float]]:
    """`kinematics.still_sizes` of what was found; none where the sheet settles none, or no machine was found."""
    measured = {fold(m.specification) for m in template.measurements if not m.steps}
    if not any(fold(name) in measured for name in specifications.values):
        return {}
    chosen = expand(as_said(template, alignment, {**alignment.choices, **choices}), alignment.counts)
    try:
        mechanism = build_mechanism(assembly, chosen, alignment, specifications, name=assembly.name)
        return kinematics.still_sizes(mechanism)
    except MechanismError:
        return {}


def _roles_in_one_unit(
    assembly: Assembly,
    template: Template,
    specifications: Specifications,
    *,
    earlier: Path | None,
    data: library.Documents | None,
    choices: Mapping[str, str] | None,
    decisions: Decisions,
) -> tuple[Assembly, Alignment]:
    """`find_roles` of a model whose parts are in one unit."""

    def found(model: Assembly) -> Alignment:
        edits = read_alignment(earlier, model, template) if earlier is not None else None
        edits = decide(edits, decisions, model, template)
        return _roles_of_whole(model, template, specifications, edits=edits, data=data, choices=choices)

    def unplayed(alignment: Alignment) -> set[str]:
        """The bodies that no part is of, also of a machine that was taken for drawn in part: what is not drawn may be
        inside of what is. Neither pins nor the root count: many models have none, whatever is done to them."""
        roles = [r for r in choose(template, alignment.choices).roles if r.rigid and r.name != template.root]
        played = {str(part.body) for part in alignment.parts} - {*alignment.missing}
        return {r.name for r in roles if not (r.optional or r.many)} - played

    def hidden(alignment: Alignment) -> int:
        return len(unplayed(alignment))

    def halves(alignment: Alignment) -> int:
        """How many barrels and rods are missing."""
        return sum(role.name in alignment.missing for role in template.roles if role.kind in ("barrel", "rod"))

    def wheels(alignment: Alignment) -> int:
        """How many wheels are missing."""
        return sum(role.name in unplayed(alignment) for role in template.roles if role.kind == "wheel")

    def misnamed(alignment: Alignment) -> bool:
        """Whether names contradict what was found."""
        return any(finding.code == "ALN015" for finding in alignment.findings)

    def limbs(alignment: Alignment) -> tuple[int, int]:
        """How many arms, links and tools are found, and missing: they are drawn into others, which frames are too large
        for."""
        arms = {role.name for role in template.roles if role.kind == "arm"}
        kindless = {role.name for role in template.roles if role.rigid and not role.kind}
        ends = [set(template.bodies_of(joint)) for joint in template.joints]
        tools = {body for pair in ends if pair & arms for body in pair & kindless}
        played = {part.body for part in alignment.parts} - {*alignment.missing}
        return len(played & (arms | tools)), len(unplayed(alignment) & (arms | tools))

    assembly = to_scale(assembly, template, specifications)
    if earlier is not None and (decisions != UNDECIDED or said_in(earlier, template)):
        meant = _known_by(parts_in(earlier), assembly)
        if meant is not None:
            return meant, _of_drawn(found(meant), meant, template)
    alignment = found(assembly)
    twins = cad.twins_apart(assembly)
    both = {part.id for part in assembly.parts} - {part.id for part in twins.parts}
    # What is left and right in one mesh was taken for one of the two.
    if any(part.part in both and twin_role(part.body or "") is not None for part in alignment.parts):
        assembly, alignment = twins, found(twins)
    rolling = cad.wheels_apart(assembly) if wheels(alignment) >= 2 else assembly
    if rolling is not assembly and wheels(other := found(rolling)) + 2 <= wheels(alignment):
        assembly, alignment = rolling, other
    model, best = assembly, alignment
    rams = cad.rams_apart(assembly) if halves(alignment) else assembly
    # A barrel and its rod at least.
    if rams is not assembly and halves(other := found(rams)) + 2 <= halves(alignment):
        model, best = rams, other
    moving = {part.body for part in alignment.parts}
    merged = len(assembly.parts) < 2 * len(moving)
    apart = _apart(assembly) if alignment.missing and (merged or hidden(alignment)) else None
    if apart is not None:
        other = found(apart)
        # Bodies in crumbs answer to more roles, wrongly: where few bodies were missing, pins must be found as well, or
        # a limb that was drawn into another, or wheels, with no more pins lost than found.
        fewer = hidden(other) < hidden(best)
        pins = {role.name for role in template.roles if role.kind == "pin"}
        gained = pins & (set(best.missing) - set(other.missing))
        lost = pins & {str(part.role) for part in best.parts} & (set(other.missing) - set(best.missing))
        rolls = wheels(other) + 2 <= wheels(best)
        (now, lacking), (before, lacked) = limbs(other), limbs(best)
        # A variant that has more of them misses more, and finds no more for that.
        limb = fewer and ((now > before and lacking < lacked) or rolls) and len(lost) <= len(gained)
        # A bracket between two others that the meshes do not show is no less for its cylinder, which is not drawn.
        limb = limb or (bool(between_apart(best, other, template)) and len(lost) <= len(gained))
        most = hidden(alignment) > len(moving) and hidden(other) < 0.5 * hidden(alignment)
        pinned = len(other.missing) < 0.5 * len(alignment.missing)
        # Names that agree with the meshes and not with what is made of their crumbs tell these to be another machine's;
        # of meshes that are few bodies of many (one a material) they tell nothing. Nor is a bracket lost in crumbs.
        played = {part.body for part in best.parts} - {*best.missing}
        told = not misnamed(best) and hidden(best) <= len(played)
        contrary = (told and misnamed(other)) or bool(between_found(other, best, template))
        if not contrary and (limb or ((fewer or best is alignment) and (most or pinned))):
            model, best = apart, other
    return model, _of_drawn(best, model, template)


def _known_by(parts: frozenset[str], drawn: Assembly) -> Assembly | None:
    """The model, as drawn or taken apart, that has exactly these parts; None where none has."""
    return next((model for model in _ways(drawn) if parts == {part.id for part in model.parts}), None)


def _ways(drawn: Assembly) -> Iterator[Assembly]:
    """The model as drawn, and as `find_roles` may take it apart."""
    for twins in (drawn, cad.twins_apart(drawn)):
        for model in (twins, cad.wheels_apart(twins)):
            yield model
            yield cad.rams_apart(model)
            if (apart := _apart(model)) is not None:
                yield apart


def _apart(assembly: Assembly) -> Assembly | None:
    """The model with its merged meshes taken apart; None where there are none."""

    def make() -> Assembly | None:
        apart = cad.taken_apart(assembly)
        return None if apart is assembly else apart

    return kept("apart", make, assembly)


def roles_of(
    assembly: Assembly,
    template: Template,
    specifications: Specifications,
    *,
    edits: Alignment | None = None,
    data: library.Documents | None = None,
    choices: Mapping[str, str] | None = None,
) -> Alignment:
    """Roles for the parts of a CAD model as it is; `edits` is an earlier alignment whose decisions hold."""
    found = _roles_of_whole(assembly, template, specifications, edits=edits, data=data, choices=choices)
    return _of_drawn(found, assembly, template)


def _roles_of_whole(
    drawn: Assembly,
    template: Template,
    specifications: Specifications,
    *,
    edits: Alignment | None,
    data: library.Documents | None,
    choices: Mapping[str, str] | None,
) -> Alignment:
    """Roles for what is drawn and, where that is one half of a machine, for its mirror image: a half looks like no
    machine."""
    edits = edits if data is None else library.with_relations(edits, data)
    square, rotation = squared(drawn) or (drawn, None)
    found = _roles_of_square(square, template, specifications, edits, choices, rotation)
    found = found if rotation is None else turned_back(found, rotation)
    return found if data is None else library.with_axes(found, data)


def _roles_of_square(
    drawn: Assembly,
    template: Template,
    specifications: Specifications,
    edits: Alignment | None,
    choices: Mapping[str, str] | None,
    rotation: Floats | None,
) -> Alignment:
    """`_roles_of_whole` of a model that stands square in its frame, to which `rotation` took its file's."""
    half = cad.half_of(drawn)
    assembly = drawn if half is None else cad.completed(drawn, half)
    alignment = align(assembly, template, specifications, edits=edits, choices=choices, square=rotation)
    # A robot description whose bodies are the template's: what it says goes before what was found.
    declared = declared_roles(assembly, template, alignment)
    if declared:
        edits = replace(edits or alignment, parts=(*(edits.parts if edits else ()), *declared))
        alignment = align(assembly, template, specifications, edits=edits, choices=choices, square=rotation)
    return alignment


def _of_drawn(found: Alignment, assembly: Assembly, template: Template) -> Alignment:
    """The alignment of the parts of `assembly`, without those of its mirror image."""
    drawn = {part.id for part in assembly.parts}
    return found if len(found.parts) == len(drawn) else of_drawn(found, drawn, template)


def on_sheet(
    assembly: Assembly,
    template: Template,
    alignment: Alignment,
    specifications: Specifications,
    data: library.Documents | None = None,
) -> tuple[Alignment, tuple[Finding, ...]]:
    """The alignment with those of its axes that are known roughly placed where the sheet's dimensions put them, and
    what there is to say of it. `template` has its variants decided."""
    rough = {j: s for j, s in alignment.across.items() if j in alignment.axes}
    if not rough or not specifications.values:
        return alignment, ()

    def moved(shifts: Mapping[str, Floats]) -> Alignment:
        axes = {j: (triple(np.array(alignment.axes[j][0]) + by), alignment.axes[j][1]) for j, by in shifts.items()}
        return replace(alignment, axes={**alignment.axes, **axes})

    def built(shifts: Mapping[str, Floats]) -> Mechanism:
        name = template.equipment_type
        mechanism = build_mechanism(assembly, template, moved(shifts), specifications, name=name, documents=data)
        return kinematics.calibrate(mechanism)

    axes = [kinematics.OpenAxis(j, np.array(alignment.axes[j][1]), across) for j, across in sorted(rough.items())]
    placed = kinematics.place_axes(axes, built)
    across = {**alignment.across, **placed.across}
    return replace(moved(placed.shifts), across=across, calibrated=placed.sources), placed.findings


def compare_with_declared(
    assembly: Assembly, template: Template, alignment: Alignment, specifications: Specifications
) -> tuple[Finding, ...]:
    """How the joints that the CAD file declares agree with those that its geometry shows."""
    chosen = expand(as_said(template, alignment, alignment.choices), alignment.counts)
    try:
        mechanism = build_mechanism(assembly, chosen, alignment, specifications, name=assembly.name)
    except MechanismError:
        return ()
    return declared_findings(compare_declared(mechanism, assembly, alignment), assembly.name)


@recent
def _completed(mechanism: Mechanism) -> Mechanism:
    """Most of what a person decides leaves the machine as it is: what its loops come to is not worked out again."""
    return kinematics.complete(kinematics.calibrate(mechanism))


def complete_mechanism(
    assembly: Assembly,
    template: Template,
    alignment: Alignment,
    specifications: Specifications,
    data: library.Documents | None = None,
) -> Mechanism:
    """The mechanism with its cylinders calibrated, limits, mobility and gains found. Cylinders whose linkage does not
    work as it was found stand as drawn, and what they would move is driven at its hinge: a machine that moves, and
    says what is wrong, is of more use than one that locks. `template` has its variants decided and its rows counted."""
    standing: dict[str, str] = {}
    while True:
        mechanism = build_mechanism(
            assembly, template, alignment, specifications,
            name=template.equipment_type, documents=data, standing=standing,
        )  # fmt: skip
        mechanism = _completed(mechanism)
        wrong = kinematics.unworkable(mechanism)
        if not wrong:
            return mechanism
        standing |= wrong
