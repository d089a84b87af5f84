"""Machines of the generators of which a part is not drawn, all else being known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from kit.machines.synthetic import Machine
from yellowiron import kinematics
from yellowiron.library import load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.rows import count_members, expand
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose


def without(
    machine: Machine,
    kind: str,
    words: Sequence[str],
    *,
    upright: Sequence[str] = (),
    sheet: Specifications | None = None,
    choices: Mapping[str, str] | None = None,
) -> Mechanism:
    """The machine as its parts truly move, those of bodies with such a word in their names left out; `upright` slides
    go straight up."""
    chosen = choose(load_template(kind), choices or {})
    template = expand(chosen, count_members([role for role, _ in machine.truth.values()], chosen))
    parts = [
        PartAssignment(part.id, role or None, body or None, 1.0, "drawn")
        for part in machine.parts for role, body in [machine.truth[part.id]]
        if not any(word in name for word in words for name in (role, body))
    ]  # fmt: skip
    alignment = Alignment(
        kind, np.eye(4), tuple(parts), axes=dict.fromkeys(upright, ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    )
    built = build_mechanism(machine.assembly(), template, alignment, sheet or Specifications(), name="truck")
    return kinematics.complete(built)
