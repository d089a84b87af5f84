"""A machine of which much is in doubt: an excavator's work equipment alone, without a name."""

from __future__ import annotations

from dataclasses import dataclass

from kit.machines.damages import damaged
from kit.machines.synthetic import disguise
from yellowiron.alignment import align
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.rows import expand
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose


@dataclass(frozen=True, eq=False)
class Doubted:
    """A machine, what was found of it, and part → the body that it truly is."""

    assembly: Assembly
    template: Template
    alignment: Alignment
    truth: dict[str, str]


def excavator_in_doubt() -> Doubted:
    assembly, truth, _ = disguise(damaged("excavator", 4, "work equipment"), 4)
    template = load_template("excavator")
    found = align(assembly, template, Specifications())
    chosen = expand(choose(template, found.choices), found.counts)
    return Doubted(assembly, chosen, found, {part: body for part, (_, body) in truth.items()})
