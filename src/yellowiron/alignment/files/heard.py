"""What a person says of a whole machine, against what else was said and what is drawn. Both are told, and the person
obeyed: a part's own decision goes before a role that is said to be absent, `--set` before a variant here."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from yellowiron.alignment.facing import Facing
from yellowiron.alignment.files.whole import Whole, whole
from yellowiron.alignment.undrawn import undrawn
from yellowiron.model.alignment import DECIDED, Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.finding import Finding
from yellowiron.model.template import Template, choose

_LOOK = "It is done as decided; look at it once more, or take the decision back."
_MEANT = "Nothing to do if that is meant; else remove one of them."


def heard_of_whole(
    edits: Alignment | None,
    decided: Mapping[str, str],
    assembly: Assembly,
    template: Template,
    choices: Mapping[str, str],
) -> tuple[Whole, tuple[Finding, ...]]:
    """What holds of the whole machine, with the `choices` that go before it, and what there is to say of that.
    `decided`: part → the role that a person gave it (empty: none). `AlignmentError` for what means nothing."""
    said = whole(edits.machine, template) if edits is not None else Whole({}, {}, Facing())
    findings = [
        Finding("ALN027", "info", name, f"{name}={choices[name]}, as set, goes before what an alignment says of the "
                f"machine, {name}={said.choices[name]}", _MEANT)
        for name in sorted(said.choices) if choices.get(name, said.choices[name]) != said.choices[name]
    ]  # fmt: skip
    given = _given(said, decided, template)
    findings += [
        Finding("ALN027", "info", part, f"{name} is said not to be drawn, and '{part}' to be of it: it is", _MEANT)
        for name, part in given.items()
    ]  # fmt: skip
    kept = {name: pattern for name, pattern in said.absent.items() if name not in given}
    return replace(said, choices={**said.choices, **choices}, absent=kept), tuple(findings)


def unlikely(
    said: Whole, scores: Mapping[str, Mapping[str, float]], found: Alignment, template: Template, cylinders: int
) -> tuple[Finding, ...]:
    """What is said of the machine that names, or what was `found`, speak clearly against. `scores`: part → body → how
    far its name says that (1: clearly); `template`: with all roles and variants; `cylinders`: hydraulic cylinders that
    are drawn."""
    findings = []
    for name in sorted(said.absent):
        named = [part for part, of in sorted(scores.items()) if of and max(of, key=of.__getitem__) == name]
        clearest = max(named, key=lambda part: scores[part][name], default="")
        if clearest and scores[clearest][name] >= 1.0:
            text = f"{name} is said not to be drawn; the name of '{clearest}' speaks for it"
            findings.append(Finding("ALN028", "info", clearest, text, _LOOK))
    played = {word for part in found.parts for word in (part.role, part.body)}
    for variant in template.variants:
        chosen = said.choices.get(variant.name)
        own = {r.name for r in template.roles if r.rigid and chosen in r.when.get(variant.name, ())}
        shared = {r.name for r in template.roles if set(variant.choices) <= set(r.when.get(variant.name, ()))}
        if chosen is not None and own - shared and own.isdisjoint(played):
            text = f"{variant.name} is said to be {chosen}; nothing drawn is of it ({', '.join(sorted(own)[:3])})"
            findings.append(Finding("ALN028", "info", variant.name, text, _LOOK))
        if variant.name in said.choices:
            missed = {c: abs(cylinders - _barrels(template, found, {variant.name: c})) for c in variant.choices}
            best = min(variant.choices, key=lambda c: missed[c])
            if missed[best] < missed[said.choices[variant.name]]:
                text = f"{variant.name} is said to be {chosen}; the {cylinders} hydraulic cylinders speak for {best}"
                findings.append(Finding("ALN028", "info", variant.name, text, _LOOK))
    return tuple(findings)


def _barrels(template: Template, found: Alignment, choices: Mapping[str, str]) -> int:
    """How many hydraulic cylinders the type has under some choices, with those that were found for the rest."""
    return sum(role.kind == "barrel" for role in choose(template, {**found.choices, **choices}).roles)


def as_said(template: Template, alignment: Alignment, choices: Mapping[str, str]) -> Template:
    """The template with its variants decided (`choices`), without what a person says is not drawn, and has given to no
    part."""
    said = whole(alignment.machine, template)
    given = _given(said, {p.part: p.role or "" for p in alignment.parts if p.source in DECIDED}, template)
    return undrawn(choose(template, choices), said.absent.keys() - given.keys())


def _given(said: Whole, decided: Mapping[str, str], template: Template) -> dict[str, str]:
    """Role that is said to be absent → a part that was given it, or what moves with it."""
    given: dict[str, str] = {}
    for part, role in sorted(decided.items()):
        for name in (role, template.body_of(role)) if role and template.knows(role) else ():
            if name in said.absent:
                given.setdefault(str(name), part)
    return given
