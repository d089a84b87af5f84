"""What is said of a machine besides its CAD model, as stages hear it: by its sheet, by a person."""

from __future__ import annotations

from pathlib import Path

from yellowiron import specs
from yellowiron.alignment import read_values
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import Template


def heard_of(template: Template, specifications: Specifications) -> Specifications:
    """What `stages.find_roles` hears of the sheet: lengths of the whole machine, and of its cylinders; no evidence."""
    quantities = ("bore", "rod_diameter")
    names = [w.name for w in template.wanted if w.length_of == "*"]
    names += [name for a in template.actuators for q in quantities if (name := a.specifications.get(q)) is not None]
    numbers = {name: number for name in names if (number := specifications.number(name)) is not None}
    return Specifications({name: Specification(name, number, "m", "ok") for name, number in numbers.items()})


def values_by_hand(earlier: Path | None, template: Template) -> Specifications:
    """The values that a person wrote into an earlier alignment; none without one."""
    values = read_values(earlier) if earlier is not None else {}
    return specs.parse_settings([f"{name}={value.text}" for name, value in values.items()], template)
