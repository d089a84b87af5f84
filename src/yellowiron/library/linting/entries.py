"""What is wrong with a template whatever its choices: roles, gains, drives, materials, and names of values."""

from __future__ import annotations

from collections.abc import Iterator

from yellowiron.library.linting.named_values import machine_tests, measurements, specifications
from yellowiron.library.parsing.joints import stated_gains
from yellowiron.model.finding import Finding
from yellowiron.model.rows import split_index
from yellowiron.model.template import Template

SAMPLE = 2
"""Parts of a row that the mobility is looked at with: how many there are shows in the CAD model only."""


def entries(template: Template) -> Iterator[Finding]:
    """Every finding that does not depend on the choices."""
    yield from specifications(template)
    yield from _roles(template)
    yield from _gains(template)
    yield from _driven_followers(template)
    yield from _rows_and_drives(template)
    yield from measurements(template)
    yield from machine_tests(template)
    yield from _materials(template)


def _roles(template: Template) -> Iterator[Finding]:
    """Pins that no joint uses, and bodies that may be absent where a joint needs them."""
    used = {split_index(p)[0] for j in template.joints for p in j.parts}
    for role in template.roles:
        if role.kind == "pin" and role.name not in used:
            yield Finding(
                "TPL009",
                "warning",
                role.name,
                f"No joint uses the pin '{role.name}'.",
                "Name it in the Body of a joint.",
            )
        if role.rigid and role.optional and role.name in used:
            yield Finding(
                "TPL012",
                "warning",
                role.name,
                f"The body '{role.name}' is optional, and a joint needs it.",
                "Declare a variant instead: without the part, the joint is left out.",
            )


def _gains(template: Template) -> Iterator[Finding]:
    """Gains of joints that nothing drives."""
    for joint in template.joints:
        stated = [name for name, _ in stated_gains(joint)]
        if joint.drive is None and joint.rest is None and stated:
            yield Finding(
                "TPL017",
                "warning",
                joint.name,
                f"The joint states {', '.join(stated)} and has no drive: they have no effect.",
                'Give it a Drive, or a rest: "drawn" makes them those of a spring that holds it as drawn.',
            )


def _driven_followers(template: Template) -> Iterator[Finding]:
    """Joints that follow another and that an actuator drives; a cylinder on one that no lever moves is all right."""
    named = {c.slide: a.name for a in template.actuators for c in a.cylinders if not c.passive}
    named |= {joint: a.name for a in template.actuators for joint in a.joints}
    for joint in template.joints:
        if joint.follows is not None and joint.name in named:
            yield Finding(
                "TPL021",
                "error",
                joint.name,
                f"It follows '{joint.follows.joint}', and the actuator '{named[joint.name]}' drives it.",
                "Name the leader in actuators.json.",
            )


def _rows_and_drives(template: Template) -> Iterator[Finding]:
    """Rows, which are looked at with a few parts only, and a machine in which nothing is driven."""
    if any(r.many for r in template.roles):
        yield Finding(
            "TPL014",
            "info",
            template.equipment_type,
            f"Rows of parts (name[*]) are looked at with {SAMPLE} parts; rings are joined to nothing and not counted.",
        )
    if not template.actuators and not any(j.drive for j in template.joints):
        yield Finding(
            "TPL007",
            "warning",
            template.equipment_type,
            "Nothing is driven.",
            "Give joints a Drive, and actuators.json.",
        )


def _materials(template: Template) -> Iterator[Finding]:
    """Roles without a material, where the template has materials."""
    without = [r.name for r in template.roles if template.materials and r.name not in template.materials]
    if without:
        yield Finding(
            "TPL013", "info", ", ".join(without), "These roles have no material of their own.", 'Add an entry "*".'
        )
