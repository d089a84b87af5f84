"""What is said of a machine besides its CAD model, as stages hear it: by its sheet, by a person."""

from __future__ import annotations

from pathlib import Path

from yellowiron import specs
from yellowiron.alignment import read_values
from yellowiron.model.specification import Specification, Specifications, fold
from yellowiron.model.template import Template


def heard_of(template: Template, specifications: Specifications) -> Specifications:
    """What `stages.find_roles` hears of the sheet: lengths of the whole machine, of its cylinders, and those that hang
    on no pose; no evidence."""
    names = [w.name for w in template.wanted if w.length_of == "*"]
    names += [m.specification for m in template.measurements if not m.steps and m.unit == "m"]
    names += _of_cylinders(template)
    numbers = {name: number for name in names if (number := specifications.number(name)) is not None}
    return Specifications({name: Specification(name, number, "m", "ok") for name, number in numbers.items()})


def without_cylinders(specifications: Specifications, template: Template) -> Specifications:
    """The specifications without the diameters of hydraulic cylinders."""
    names = {fold(name) for name in _of_cylinders(template)}
    return Specifications({n: value for n, value in specifications.values.items() if fold(n) not in names})


def _of_cylinders(template: Template) -> list[str]:
    quantities = ("bore", "rod_diameter")
    return [name for a in template.actuators for q in quantities if (name := a.specifications.get(q)) is not None]


def values_by_hand(earlier: Path | None, template: Template) -> Specifications:
    """The values that a person wrote into an earlier alignment; none without one."""
    values = read_values(earlier) if earlier is not None else {}
    return specs.parse_settings([f"{name}={value.text}" for name, value in values.items()], template)
