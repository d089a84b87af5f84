"""Why an alignment is as it is, in sentences."""

from __future__ import annotations

from difflib import get_close_matches

import numpy as np

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.errors import AlignmentError


def explain(alignment: Alignment, role_or_part: str) -> str:
    """Why a role has its parts, the doubtful ones first, or a part its role, in sentences: how probable it is, what it
    was found by, what else it could be; for a single part also the figures that its probability rests on.

    A part is named by its id, or by the end of it (its name, say) where that leaves no doubt. `AlignmentError` for a
    name that is neither, or that several parts end with.
    """
    chosen = [p for p in alignment.parts if role_or_part in (p.part, p.role)]
    if not chosen:
        chosen = [p for p in alignment.parts if p.body == role_or_part]
    if not chosen and role_or_part not in alignment.missing:
        chosen = _ending(alignment, role_or_part)
    if not chosen:
        if role_or_part in alignment.missing:
            return f"{role_or_part}: no part plays it."
        known = {p.part for p in alignment.parts} | {p.part.rpartition("/")[2] for p in alignment.parts}
        known |= {r for p in alignment.parts for r in (p.role, p.body) if r}
        raise AlignmentError(
            f"'{role_or_part}' is neither a role nor a part of this alignment", where=role_or_part,
            hint=near(role_or_part, known) or "Name a role of the template or a part id.",
        )  # fmt: skip
    chosen = sorted(chosen, key=lambda p: p.confidence)
    if len(chosen) == 1:
        return "\n".join([_sentence(chosen[0]), *_figures(chosen[0])])
    sure = f"{chosen[0].confidence:.0%} to {chosen[-1].confidence:.0%} sure"
    review = [p.part for p in chosen if p.part in alignment.to_review]
    doubt = f", {len(review)} to review" if review else ""
    return "\n".join([f"{role_or_part}: {len(chosen)} parts, {sure}{doubt}.", *(_sentence(p) for p in chosen)])


def _ending(alignment: Alignment, name: str) -> list[PartAssignment]:
    """The one part whose id ends with these names; as they are written, else without regard to case."""
    for fold in (str, str.casefold):
        found = [p for p in alignment.parts if f"/{fold(p.part)}".endswith(f"/{fold(name.strip('/'))}")]
        if len(found) > 1:
            some = ", ".join(f"'{p.part}'" for p in found[:4]) + (", …" if len(found) > 4 else "")
            raise AlignmentError(
                f"{len(found)} parts are named '{name}'", where=name, hint=f"Say more of the path: {some}."
            )
        if found:
            return found
    return []


_FIGURES = {
    "whole": "the whole machine was found: {0:g} (1: every body and joint)",
    "rung": "contact tolerance widened {0:g} times",
    "names for": "its names speak for it by {0:g}",
    "names against": "its names speak for another body by {0:g}",
    "lead": "joints ahead of the runner-up's: {0:.0%}",
}


def _figures(p: PartAssignment) -> list[str]:
    """What a probability rests on, a line each; what plays no part is left out."""
    by = [f"  found by: {name.removeprefix('by ')}" for name in p.evidence if name.startswith("by ")]
    odds = p.evidence.get("strength")
    by += [f"  strength of that: {1 / (1 + float(np.exp(-odds))):.2f}"] if odds is not None else []
    return by + [f"  {_FIGURES[n].format(v)}" for n, v in p.evidence.items() if n in _FIGURES and (v or n == "whole")]


def _sentence(p: PartAssignment) -> str:
    text = f"{p.part}: {p.role or 'no role'} ({p.confidence:.0%}, {p.source}): {p.why}."
    moves = f" Moves with {p.body}." if p.body not in (None, p.role) else ""
    rival = f" Otherwise: {p.runner_up}." if p.runner_up else ""
    return text + moves + rival


def near(name: str, known: set[str]) -> str:
    """A question after the known name that a name is most like; empty where none is."""
    close = get_close_matches(name, sorted(known), n=1)
    return f"Did you mean '{close[0]}'?" if close else ""
