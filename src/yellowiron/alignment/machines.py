"""Which of what is drawn is the machine, where nearness alone does not say: one of several in a scene that is called
so, or one whose parts float far from each other.

Each way is what is *no* part of the machine: part id → metres from it, 0 for the ground.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from yellowiron.alignment.features.separate_parts import gaps, groups, separate_parts, size_of_boxes
from yellowiron.alignment.tolerances import FAR
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Floats
from yellowiron.model.specification import fold
from yellowiron.model.template import ITSELF, Template

MUCH = 0.02
"""What floats and has less than this share of the surface makes no other machine of the rest."""
LOW = 0.05
"""What is no higher over the machine's lowest point than this share of its size stands as low."""
MACHINE = 0.05
"""A group with this share of the surface of the largest machine may be the machine itself."""
CALLED = 0.5
"""What is called a machine of the type is it if this share of its surface is called so."""


def apart_from(assembly: Assembly, template: Template, wanted: frozenset[str] = frozenset()) -> Mapping[str, float]:
    """The parts that are no part of the machine, which is the one of several that is called a machine of the type, else
    what stands together (`separate_parts`). `wanted` parts are of it: a person said so."""
    apart = separate_parts(assembly)
    kept = wanted & apart.keys()
    apart = separate_parts(assembly, kept) if kept else apart
    called = _called_apart(assembly, template, apart) if not wanted else None
    return apart if called is None else called


def _called_apart(assembly: Assembly, template: Template, apart: Mapping[str, float]) -> dict[str, float] | None:
    """What is no part of the machine, where one of several groups that stand apart from each other is called a machine
    of the type and no other is; None where names do not tell it from `apart`."""
    words = {fold(w) for words in template.words.get(ITSELF, {}).values() for w in words}
    words.add(fold(template.equipment_type.replace("_", " ")))
    there = _drawn(assembly)
    main = [p for p in there if p.id not in apart]
    found = [group for group in (main, *_beside(assembly, apart)) if _is_called(assembly, group, words)]
    if len(found) != 1 or found[0] is main or _surface(assembly, found[0]) < MACHINE * _surface(assembly, main):
        return None
    own = _boxes(assembly, found[0])
    kept = {p.id for p in found[0]}
    rest = [p for p in there if p.id not in kept]
    gap = {p.id: float(gaps(low, high, *own).min()) for p, low, high in zip(rest, *_boxes(assembly, rest), strict=True)}
    return {part: 0.0 if apart.get(part) == 0.0 else metres for part, metres in gap.items()}


def with_floating(assembly: Assembly, apart: Mapping[str, float], up: Floats) -> dict[str, float] | None:
    """What is no part of the machine if what floats far from it is its own, as in models of few loose blocks; None
    where little floats, as much as the machine has, or what stands as low as it: another machine, or a pallet. `up`
    (3,): a unit direction of the CAD frame."""
    there = _drawn(assembly)
    floating = [p for p in there if apart.get(p.id, 0.0) > 0.0]
    main = [p for p in there if p.id not in apart]
    if not floating or not main:
        return None
    lowest = [min(float((assembly.points_of(p) @ up).min()) for p in some) for some in (floating, main)]
    if lowest[0] < lowest[1] + LOW * size_of_boxes(*_boxes(assembly, main)):
        return None
    share = _surface(assembly, floating) / (_surface(assembly, there) or 1.0)
    if 2 * len(floating) >= len(there) or not MUCH < share < 0.5:
        return None
    return {part: metres for part, metres in apart.items() if metres == 0.0}


def _beside(assembly: Assembly, apart: Mapping[str, float]) -> list[list[Part]]:
    """The groups that stand apart from the machine, each of parts that are near each other."""
    rest = [p for p in _drawn(assembly) if apart.get(p.id, 0.0) > 0.0]
    if not rest:
        return []
    low, high = _boxes(assembly, rest)
    own = _boxes(assembly, [p for p in _drawn(assembly) if p.id not in apart] or rest)
    number = groups(low, high, FAR * size_of_boxes(*own))
    return [[p for p, k in zip(rest, number.tolist(), strict=True) if k == g] for g in sorted(set(number.tolist()))]


def _drawn(assembly: Assembly) -> list[Part]:
    """The parts that have a mesh."""
    return [p for p in assembly.parts if len(assembly.shape_of(p).mesh.points)]


def _boxes(assembly: Assembly, parts: Sequence[Part]) -> tuple[Floats, Floats]:
    """(n, 3) the lowest and the highest corners of the parts' boxes, metres."""
    points = [assembly.points_of(p) for p in parts]
    return np.array([p.min(axis=0) for p in points]), np.array([p.max(axis=0) for p in points])


def _is_called(assembly: Assembly, parts: Sequence[Part], words: Collection[str]) -> bool:
    """Whether most of the surface of some parts is called one of these words, on its own or by a node above it."""
    called = [p for p in parts if any(w in fold(name) for name in (*p.path, p.name) for w in words)]
    return _surface(assembly, called) > CALLED * _surface(assembly, parts)


def _surface(assembly: Assembly, parts: Sequence[Part]) -> float:
    """Of some parts, m²."""
    return float(sum(assembly.shape_of(p).area for p in parts))
