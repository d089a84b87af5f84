"""A person's decisions as hard constraints: roles of parts, of assemblies by a pattern, a yes to what was found.

A part's own decision goes before a pattern, a later pattern before an earlier one, a person's before a document's. What
contradicts another decision, or fits nothing, is told and obeyed: `ALN026` a pattern fits no part · `ALN027` two
decisions speak of the same parts, and differ · `ALN028` what was found speaks clearly for another body than the one
decided.
"""

from __future__ import annotations

import fnmatch
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.alignment.files.whole import whole
from yellowiron.model.alignment import (
    DECIDED,
    UNDECIDED,
    UNSIGNED,
    Alignment,
    AssignmentSource,
    Decisions,
    PartAssignment,
    PartDecision,
    RoleRule,
    Signature,
)
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import AlignmentError
from yellowiron.model.finding import Finding
from yellowiron.model.template import Template

FEW = 4
"""So many parts are named, the rest counted."""


@dataclass(frozen=True)
class Decision:
    """What was decided of a part (no role: not part of the machine), in which way, why in words, and by whom."""

    role: str | None
    source: AssignmentSource
    reason: str
    signature: Signature = UNSIGNED


def fits(pattern: str) -> Callable[[Part], bool]:
    """Whether a part, or an assembly that it is in, is named by a pattern: as much of its path in the CAD tree as the
    pattern gives, `*` standing for any text, `/` too (`ADT30/HITCH/*`, `HITCH`, `*BOLT*`). Case does not count, and
    `_`, `-` and a space are the same."""
    wanted = re.compile(fnmatch.translate(_plain(pattern).replace("[", "[[]"))).fullmatch

    def fit(part: Part) -> bool:
        ids = _plain(part.id)
        whole = [_plain(name) for name in (*part.path, part.name)]
        runs = {"/".join(whole[a:b]) for a in range(len(whole)) for b in range(a + 1, len(whole) + 1)}
        tails = {ids, *(ids[k + 1 :] for k, letter in enumerate(ids) if letter == "/")}
        return any(wanted(name) for name in runs | tails)

    return fit


def decide(earlier: Alignment | None, decisions: Decisions, assembly: Assembly, template: Template) -> Alignment | None:
    """An earlier alignment with further decisions, which go before those it has. `AlignmentError` for a role that the
    template does not have, for a yes to what no earlier alignment says, and for a pattern to confirm or forget that
    fits nothing."""
    if decisions == UNDECIDED:
        return earlier
    for rule in decisions.rules:
        _known(rule.role, template, f"{rule.pattern}={rule.role}")
    if earlier is None and decisions.confirmed:
        raise AlignmentError(
            "There is no earlier alignment whose roles could be confirmed", where=decisions.confirmed[0],
            hint="Run `yellowiron align … --out alignment.json` first, and confirm with the same --out.",
        )  # fmt: skip
    whole(decisions.machine, template)
    given = {*(rule.pattern for rule in earlier.rules), *earlier.machine} if earlier is not None else set()
    for pattern in (*decisions.confirmed, *(p for p in decisions.forgotten if p not in given)):
        if not any(map(fits(pattern), assembly.parts)):
            raise AlignmentError(
                f"The pattern '{pattern}' fits no part of the CAD model", where=pattern,
                hint="Give as much of a part's path in the CAD tree as you like; `*` stands for any text.",
            )  # fmt: skip
    edits = earlier or Alignment(template.equipment_type, np.eye(4), ())
    parts = {p.id: p for p in assembly.parts}

    def fit(assignment: PartAssignment, patterns: Iterable[Callable[[Part], bool]]) -> bool:
        part = parts.get(assignment.part)
        return part is not None and any(one(part) for one in patterns)

    forgotten, confirmed = ([fits(p) for p in some] for some in (decisions.forgotten, decisions.confirmed))
    ruled = [fits(rule.pattern) for rule in decisions.rules]
    kept = []
    for assignment in edits.parts:
        own = assignment.source in ("edited", "confirmed")
        if own and (fit(assignment, forgotten) or fit(assignment, ruled)):
            assignment = replace(assignment, source="solved", signature=UNSIGNED)
        if fit(assignment, confirmed):
            assignment = replace(
                assignment, source="edited" if assignment.source == "edited" else "confirmed",
                signature=decisions.signature,
            )  # fmt: skip
        if assignment.part not in decisions.parts:
            kept.append(assignment)
    kept += [_single(part, one, template) for part, one in decisions.parts.items() if part in parts]
    # What is said again as it was keeps who said it first, and when.
    said = {(rule.pattern, rule.role): rule for rule in edits.rules}
    new = [rule if rule.signature.why else said.get((rule.pattern, rule.role), rule) for rule in decisions.rules]
    gone = {*decisions.forgotten, *(rule.pattern for rule in new)}
    rules = (*(rule for rule in edits.rules if rule.pattern not in gone), *new)
    # What is said later of the whole machine is the last of several.
    told = {**edits.machine}
    for name in {*decisions.forgotten, *decisions.machine} & told.keys():
        del told[name]
    return replace(edits, parts=tuple(kept), rules=rules, machine={**told, **decisions.machine})


def decided(
    assembly: Assembly, template: Template, edits: Alignment | None
) -> tuple[dict[str, Decision], tuple[Finding, ...]]:
    """Part id → what a person, or a document of theirs, decided of it, and what there is to say of that.
    `AlignmentError` for decisions that name parts or roles that do not exist."""
    if edits is None:
        return {}, ()
    found: dict[str, Decision] = {}
    findings: list[Finding] = []
    own = _own(assembly, template, edits)
    for rule in edits.rules:
        _known(rule.role, template, rule.pattern)
        fit = fits(rule.pattern)
        words = _words(f"set by a person for '{rule.pattern}'", rule.signature)
        ruled = [part.id for part in assembly.parts if fit(part)]
        if not ruled:
            text = f"The pattern '{rule.pattern}', which a person gave the role {rule.role or 'none'}, fits no part"
            findings.append(Finding("ALN026", "warning", rule.pattern, text, "Correct the pattern, or remove it."))
        before = {i: found[i] for i in ruled if i in found and found[i].role != rule.role}
        after = {i: own[i] for i in ruled if i in own and own[i].source != "data" and own[i].role != rule.role}
        findings += [_contradicted(f"'{rule.pattern}' goes before an earlier pattern", before)] if before else []
        findings += [_contradicted(f"A part's own decision goes before '{rule.pattern}'", after)] if after else []
        found |= dict.fromkeys(ruled, Decision(rule.role, "rule", words, rule.signature))
    return found | {i: d for i, d in own.items() if d.source != "data" or i not in found}, tuple(findings)


def doubts(decisions: Mapping[str, Decision], found: Sequence[PartAssignment]) -> tuple[Finding, ...]:
    """What was decided against a clear finding. `found`: what the solver would have given the parts that were decided
    otherwise, where it was sure of it."""
    alike: dict[tuple[str, str], list[PartAssignment]] = {}
    for part in found:
        decision = decisions[part.part]
        alike.setdefault((decision.reason, decision.role or "none"), []).append(part)
    told = []
    for (reason, role), parts in alike.items():
        rivals = sorted({str(p.body) for p in parts})
        text = (
            f"{_some([p.part for p in parts])}: {reason}, role {role}; geometry and names speak clearly for "
            f"{' or '.join(rivals)} (up to {max(p.confidence for p in parts):.0%})"
        )
        hint = "It is done as decided; look at it once more, or take the decision back."
        told.append(Finding("ALN028", "info", parts[0].part, text, hint))
    return tuple(told)


def _own(assembly: Assembly, template: Template, edits: Alignment) -> dict[str, Decision]:
    """The decisions of single parts."""
    parts = {p.id for p in assembly.parts}
    found = {}
    for item in edits.parts:
        if item.source not in DECIDED or item.source == "rule":
            continue
        if item.part not in parts:
            raise AlignmentError(
                f"The alignment names a part that is not in the CAD model: '{item.part}'", where=item.part,
                hint="Remove that entry, or align the CAD model it was made for.",
            )  # fmt: skip
        _known(item.role, template, item.part)
        said = {"edited": "set by a person", "confirmed": "found, and confirmed by a person"}.get(item.source)
        words = _words(said, item.signature) if said is not None else item.reason
        found[item.part] = Decision(item.role, item.source, words, item.signature)
    return found


def _single(part: str, decision: PartDecision, template: Template) -> PartAssignment:
    """A decision on one part as an alignment file has it."""
    role = decision.role
    _known(role, template, part)
    body = template.body_of(role) if role is not None else None
    return PartAssignment(part, role, body, 1.0, "", source=decision.source, signature=decision.signature)


def _contradicted(words: str, others: Mapping[str, Decision]) -> Finding:
    roles = " or ".join(sorted({d.role or "none" for d in others.values()}))
    text = f"{words}, which differ: {_some(sorted(others))} ({roles})"
    return Finding("ALN027", "info", min(others), text, "Nothing to do if that is meant; else remove one of them.")


def _known(role: str | None, template: Template, where: str) -> None:
    if role is not None and not template.knows(role):
        raise AlignmentError(
            f"'{role}' is no role of the template {template.equipment_type}", where=where,
            hint="`yellowiron templates show TYPE` lists the roles.",
        )  # fmt: skip


def _words(said: str, signature: Signature) -> str:
    by = f" ({', '.join(w for w in (signature.by, signature.date) if w)})" if signature.by or signature.date else ""
    return f"{said}{by}{f': {signature.why}' if signature.why else ''}"


def _some(parts: Sequence[str]) -> str:
    more = f" and {len(parts) - FEW} more" if len(parts) > FEW else ""
    return ", ".join(f"'{p}'" for p in parts[:FEW]) + more


def _plain(text: str) -> str:
    return "/".join(re.sub(r"[\s_-]+", "_", piece.strip().casefold()) for piece in text.strip("/").split("/"))


def parse_rules(texts: Sequence[str], signature: Signature = UNSIGNED) -> tuple[RoleRule, ...]:
    """Texts such as `ADT30/HITCH/*=hitch` (`=none`: not part of the machine) as rules. `AlignmentError` for others."""
    rules = []
    for text in texts:
        pattern, mark, role = text.rpartition("=")
        if not mark or not pattern.strip() or not role.strip():
            raise AlignmentError(
                f"'{text}' is no pattern with a role", where="--set-role",
                hint="Write PATTERN=role, as in 'ADT30/HITCH/*=hitch'; role none leaves the parts out.",
            )  # fmt: skip
        named = role.strip()
        rules.append(RoleRule(pattern.strip(), None if named.casefold() == "none" else named, signature))
    return tuple(rules)
