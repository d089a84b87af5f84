"""Other objects in the scene, by its tree: what hangs under a node of its own, beside the node that has the machine."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from yellowiron.model.alignment import DECIDED, Alignment
from yellowiron.model.assembly import Part

SEVERAL = 3
"""So many bodies under one node are a machine."""
DOUBT = 0.5
WORDS = "it hangs beside the machine in the scene's tree, and may be another object"


def doubted(found: Alignment, parts: Sequence[Part]) -> Alignment:
    """The alignment with the parts listed for review that hang under other nodes of the scene than the one which has
    every body of the machine: a lorry beside a forklift. Where bodies are spread over the nodes, or parts hang under
    none, the tree does not say what is a machine."""
    shared = _shared(parts)
    top = {p.id: p.path[shared] if len(p.path) > shared else None for p in parts}
    bodies: dict[str | None, set[str]] = {}
    for label in found.parts:
        if label.body is not None:
            bodies.setdefault(top.get(label.part), set()).add(label.body)
    played = set[str]().union(*bodies.values())
    whole = [node for node, there in bodies.items() if node is not None and there == played]
    if len(whole) != 1 or len(played) < SEVERAL:
        return found
    aside = {
        p.part for p in found.parts
        if top.get(p.part) not in (None, *whole) and p.body is not None and p.source not in DECIDED
    }  # fmt: skip
    if not aside:
        return found
    labels = tuple(
        replace(p, confidence=min(p.confidence, DOUBT), reason=f"{p.reason}; but {WORDS}") if p.part in aside else p
        for p in found.parts
    )
    return replace(found, parts=labels, to_review=tuple(dict.fromkeys((*found.to_review, *sorted(aside)))))


def _shared(parts: Sequence[Part]) -> int:
    """How many nodes every part hangs under."""
    paths = [p.path for p in parts]
    return next((n for n, names in enumerate(zip(*paths, strict=False)) if len(set(names)) > 1),
                min((len(path) for path in paths), default=0))  # fmt: skip
