"""What taking meshes apart finds that whole meshes do not show."""

from __future__ import annotations

from yellowiron.model.alignment import Alignment
from yellowiron.model.template import Template, choose

SHAPED = ("barrel", "rod", "wheel")
"""Bodies of these kinds are told by their shape."""


def between_found(found: Alignment, other: Alignment, template: Template) -> frozenset[str]:
    """The bodies that an `other` alignment has between two of its bodies and the variants of the one that was `found`
    have not, where pins or bores that are drawn show both joints. `template` has its variants still."""
    chosen, now = choose(template, other.choices), _plain(other, template)
    guessed = {finding.where for finding in other.findings if finding.code == "ALN016"}
    had = {r.name for r in choose(template, found.choices).roles}
    shown: dict[str, set[str]] = {}
    for joint in chosen.joints:
        pair = {str(b) for b in chosen.bodies_of(joint)}
        if joint.type == "revolute" and joint.name not in guessed and pair <= now:
            for body in pair:
                shown.setdefault(body, set()).update(pair - {body})
    return frozenset(body for body in now - had if len(shown.get(body, ())) > 1)


def between_apart(found: Alignment, apart: Alignment, template: Template) -> frozenset[str]:
    """The bodies between two others (`between_found`) that were drawn into other meshes, which were taken `apart`: what
    is a mesh of its own is what it was `found` to be. None where that lost a body."""
    if not _plain(found, template) <= _plain(apart, template):
        return frozenset()
    whole = {part.part for part in found.parts}
    own = {part.body for part in apart.parts if part.part in whole}
    return between_found(found, apart, template) - own


def _plain(alignment: Alignment, template: Template) -> frozenset[str]:
    """The bodies that parts are of and that neither their shape nor their number tells."""
    played = {part.body for part in alignment.parts} - {*alignment.missing}
    roles = choose(template, alignment.choices).roles
    plain = {r.name for r in roles if r.rigid and r.kind not in SHAPED and not (r.optional or r.many)}
    return frozenset(plain & {str(body) for body in played})
