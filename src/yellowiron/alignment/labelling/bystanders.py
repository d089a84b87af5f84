"""What the scene's tree casts doubt on: other objects, which hang under a node of their own beside the node that has
the machine, and parts that touch another body than what they hang with is of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.labelling.confidence import REVIEW
from yellowiron.alignment.labelling.place import DOUBTFUL, Place
from yellowiron.model.alignment import DECIDED, Alignment
from yellowiron.model.assembly import Part

SEVERAL = 3
"""So many bodies under one node are a machine."""
DOUBT = 0.5
HALF = 0.5
"""What hangs under one node is of one body if this share of its surface is. A node with more than this share of the
machine's surface says nothing: it is the machine."""
BESIDE = frozenset({"bores", "flat", "ring", "touch", "near"})
"""How a part is found by nothing but what it is beside."""
STRANGE = "but most of what hangs under the same node is of other bodies, or in doubt"
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


def among_strangers(places: Mapping[int, Place], solids: Sequence[Solid]) -> dict[int, Place]:
    """The places, solid → place, those doubtful that only what they are beside speaks for, where less than half of what
    hangs under the same node is surely of that body: a bracket of a cylinder may touch the frame, too. For machines
    that contacts did not find."""
    surface: dict[tuple[str, ...], float] = {}
    agreed: dict[tuple[tuple[str, ...], str], float] = {}
    for solid in solids:
        place = places.get(solid.index)
        path = (*solid.part.path, solid.part.name)
        # What carries others is a node itself.
        for node in (path[:n] for n in range(1, len(path) + 1)):
            surface[node] = surface.get(node, 0.0) + solid.surface
            if place is not None and place.confidence >= REVIEW:
                agreed[node, place.body] = agreed.get((node, place.body), 0.0) + solid.surface
    most = HALF * sum(s.surface for s in solids)
    found = dict(places)
    for i, place in places.items():
        own, node = solids[i].surface, solids[i].part.path
        others = surface.get(node, 0.0) - own
        if place.how not in BESIDE or place.confidence < REVIEW or not 0.0 < others < most - own:
            continue
        if agreed[node, place.body] - own < HALF * others:
            found[i] = replace(place, confidence=DOUBTFUL, reason=f"{place.reason}; {STRANGE}")
    return found


def _shared(parts: Sequence[Part]) -> int:
    """How many nodes every part hangs under."""
    paths = [p.path for p in parts]
    return next((n for n, names in enumerate(zip(*paths, strict=False)) if len(set(names)) > 1),
                min((len(path) for path in paths), default=0))  # fmt: skip
