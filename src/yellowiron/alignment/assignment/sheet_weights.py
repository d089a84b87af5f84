"""What the specification sheet says about hydraulic cylinders, as evidence: bores and rod diameters."""

from __future__ import annotations

from collections.abc import Iterator

from yellowiron.alignment.assignment.cp_sat import Solution
from yellowiron.alignment.features.cylinders import DrawnCylinder
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.model.finding import Finding
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template

AGREE = 0.02
"""Two diameters agree within this share."""
SHEET_WEIGHT = 15


def sheet_weights(
    structure: Structure, cylinders: tuple[DrawnCylinder, ...], template: Template, specifications: Specifications
) -> dict[tuple[int, str], int]:
    """Weights of (cluster, body) for barrels and rods whose drawn diameters are the sheet's."""
    weights: dict[tuple[int, str], int] = {}
    for barrel, rod, quantity, _, value in _known(template, specifications):
        for barrel_cluster, rod_cluster, number in structure.slides:
            drawn = _drawn(cylinders[number], quantity) if number < len(cylinders) else None
            if drawn is not None and abs(drawn - value) <= AGREE * value:
                for key in ((barrel_cluster, barrel), (rod_cluster, rod)):
                    weights[key] = weights.get(key, 0) + SHEET_WEIGHT
    return weights


def sheet_findings(
    structure: Structure,
    cylinders: tuple[DrawnCylinder, ...],
    template: Template,
    specifications: Specifications,
    solution: Solution,
) -> list[Finding]:
    """A remark (ALN006) for each cylinder that is not drawn as the sheet has it."""
    # By both bodies: the barrels of several may be fixed to one.
    slides = {
        frozenset(solution.body_of.get(k) for k in (a, b)): n for a, b, n in structure.slides if n < len(cylinders)
    }
    findings = []
    for barrel, rod, quantity, name, value in _known(template, specifications):
        if frozenset((barrel, rod)) not in slides:
            continue
        drawn = _drawn(cylinders[slides[frozenset((barrel, rod))]], quantity)
        if drawn is not None and abs(drawn - value) > AGREE * value:
            text = f"{name} is {1e3 * value:.4g} mm on the sheet and {1e3 * drawn:.4g} mm in the CAD model"
            hint = "Check the sheet's value, the model's unit, and the cylinder's role."
            findings.append(Finding("ALN006", "warning", barrel, text, hint))
    return findings


def _known(template: Template, specifications: Specifications) -> Iterator[tuple[str, str, str, str, float]]:
    """(barrel, rod, quantity, wanted name, metres) of every diameter that the sheet gives."""
    kinds = {r.name: r.kind for r in template.roles}
    joints = {j.name: j for j in template.joints}
    for actuator in template.actuators:
        for quantity in ("bore", "rod_diameter"):
            name = actuator.specifications.get(quantity)
            value = specifications.number(name) if name is not None else None
            if name is None or value is None or value <= 0:
                continue
            for cylinder in actuator.cylinders:
                joint = joints.get(cylinder.slide)
                bodies = template.bodies_of(joint) if joint is not None else (None, None)
                barrel, rod = sorted(bodies, key=lambda b: kinds.get(b or "") != "barrel")
                if barrel is not None and rod is not None:
                    yield barrel, rod, quantity, name, value


def _drawn(cylinder: DrawnCylinder, quantity: str) -> float | None:
    """A diameter as it is drawn; None for the bore of a barrel that has none."""
    if quantity == "bore":
        return 2 * cylinder.bore if cylinder.hollow else None
    return 2 * cylinder.rod_radius
