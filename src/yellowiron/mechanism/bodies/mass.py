"""Mass: volume × density, exact, then reconciled with published weights.

Everything is carried as second moments Σ = ∫ x xᵀ dm about a centre of mass rather than as inertia: a linear map L
takes a solid's Σ to |det L| · L Σ Lᵀ whatever it mirrors or scales, sums stay positive semi-definite, and the inertia
I = tr(Σ)·1 − Σ then always meets the triangle inequality.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from yellowiron.mechanism.bodies.choice import Choice
from yellowiron.mechanism.placement import Placement
from yellowiron.mechanism.values import known
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Shape
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Material, Template
from yellowiron.support.text import display, with_article

STEEL = 7850.0
"""Density where a material states none, kg/m³."""
SHELL = 0.005
"""Thickness of an open mesh, metres: its mass is surface × this × density."""
_THIN = 1e-4
"""Least radius of gyration of a body along any axis, metres: an inertia of zero stops every engine."""
_PLAUSIBLE = (0.5, 2.0)
"""Factors to a published weight outside of this are a warning."""

_USUAL = 30.0
"""What a machine weighs, kg, for each m³ of the cube of its box's diagonal: from makers' weights and dimensions, 18
(a 20 t excavator) to 35 (a 12 t compactor); dozers 60."""
_SOLID = 3.0
"""So many times as much and more is of hollow things that are drawn solid."""


@dataclass(frozen=True, eq=False)
class Moments:
    """A mass (kg) with its centre (3,) in metres and its second moments Σ (3, 3) about the centre, kg·m²."""

    mass: float
    center: Floats
    second: Floats

    def scaled(self, factor: float) -> Moments:
        """The same solid with another density."""
        return Moments(self.mass * factor, self.center, self.second * factor)

    @property
    def inertia(self) -> Floats:
        """(3, 3) inertia about the centre of mass, kg·m²; always positive, and within the triangle inequality."""
        values, vectors = np.linalg.eigh(0.5 * (self.second + self.second.T))
        floor = self.mass * _THIN**2
        second = (vectors * np.maximum(values, floor)) @ vectors.T
        inertia = np.trace(second) * np.eye(3) - second
        return np.asarray(0.5 * (inertia + inertia.T), dtype=np.float64)


def combine(many: Iterable[Moments]) -> Moments:
    """Several masses as one: Σ about the common centre by the parallel axis theorem."""
    parts = list(many)
    mass = sum(p.mass for p in parts)
    if mass <= 0.0:
        return Moments(0.0, np.zeros(3), np.zeros((3, 3)))
    center = sum((p.mass * p.center for p in parts), np.zeros(3)) / mass
    second = sum((p.second + p.mass * np.outer(p.center - center, p.center - center) for p in parts), np.zeros((3, 3)))
    return Moments(mass, center, second)


def solid_moments(shape: Shape, transform: Floats, density: float) -> Moments:
    """A closed shape's mass in the frame that `transform` (4, 4) takes it to; any linear part, mirrored and scaled
    too."""
    linear = transform[:3, :3]
    stretch = abs(float(np.linalg.det(linear)))
    second = 0.5 * np.trace(shape.inertia) * np.eye(3) - shape.inertia
    return Moments(
        mass=density * stretch * shape.volume,
        center=linear @ shape.centroid + transform[:3, 3],
        second=density * stretch * (linear @ second @ linear.T),
    )


def shell_moments(corners: Floats, surface_density: float) -> Moments:
    """A thin shell's mass from its triangles' corners (m, 3, 3); `surface_density` in kg/m².

    For a triangle a, b, c: ∫ x xᵀ dA = A/12 · (aaᵀ + bbᵀ + ccᵀ + ssᵀ), s = a + b + c.
    """
    area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    total = float(area.sum())
    if total <= 0.0:
        return Moments(0.0, np.zeros(3), np.zeros((3, 3)))
    center = area @ corners.mean(axis=1) / total
    arms = corners - center
    sums = arms.sum(axis=1)
    outer = np.einsum("mki,mkj->mij", arms, arms) + np.einsum("mi,mj->mij", sums, sums)
    second = np.einsum("m,mij->ij", area / 12.0, outer)
    return Moments(surface_density * total, center, surface_density * second)


@dataclass(frozen=True)
class PartMaterial:
    """The material of a part, its key among the mechanism's, and which entry chose it."""

    key: str
    material: Material
    source: str


@dataclass(frozen=True)
class Factor:
    """By how much a body's mass was scaled, and why."""

    value: float
    source: str


@dataclass(frozen=True, eq=False)
class Masses:
    """What everything weighs: of every placed part its material and its `moments` by volume and density, machine
    frame; by body the factor to published weights. `used` are the materials in use by key."""

    parts: tuple[PartMaterial, ...]
    moments: tuple[Moments, ...]
    factors: Mapping[str, Factor]
    used: dict[str, Material]
    choice: Choice[Material]

    def key_of_role(self, role: str) -> str:
        """The key of the material of a role that no part plays; it comes into `used`."""
        return key_of(_material(self.choice, "", role)[0], self.used)


def weigh(
    placement: Placement,
    template: Template,
    specifications: Specifications,
    by_document: Mapping[str, Material],
    bodies: Sequence[str],
    findings: list[Finding],
) -> Masses:
    """The masses of the parts and of the `bodies` of those names. A user's documents (`by_document`: materials by part
    or role) win over the template."""
    choice = Choice(template, by_document, template.materials)
    used: dict[str, Material] = {}
    materials = _part_materials(placement, choice, used)
    moments = _part_moments(placement, materials, findings)
    weights = {b: sum(moments[row].mass for row in placement.rows_of_body(b)) for b in bodies}
    factors = _factors(weights, template, specifications, findings)
    if all(f.value == 1.0 for f in factors.values()):
        factors = _hollowed(weights, placement, findings) or factors
    return Masses(materials, moments, factors, used, choice)


def _material(choice: Choice[Material], part: str, role: str | None) -> tuple[Material, str]:
    """The material of a part of that name and role, and what chose it."""
    return choice.of(part, role) or (Material("steel", density=STEEL), "default")


def _part_materials(
    placement: Placement, choice: Choice[Material], used: dict[str, Material]
) -> tuple[PartMaterial, ...]:
    """The material of every placed part; those in use come into `used`."""
    chosen = []
    for part, role in zip(placement.parts, placement.roles, strict=True):
        material, source = _material(choice, part.name, role)
        chosen.append(PartMaterial(key_of(material, used), material, source))
    return tuple(chosen)


def key_of(material: Material, keys: dict[str, Material]) -> str:
    """The key of a material among those in use, to which it is added: its name, numbered where two differ."""
    key, number = material.name, 2
    while keys.setdefault(key, material) != material:
        key, number = f"{material.name} {number}", number + 1
    return key


def _part_moments(
    placement: Placement, materials: Sequence[PartMaterial], findings: list[Finding]
) -> tuple[Moments, ...]:
    """The mass of every placed part by its volume and density, machine frame."""
    result = []
    undense: dict[str, None] = {}
    open_shapes: dict[str, str] = {}
    for row, chosen in enumerate(materials):
        shape = placement.shapes[row]
        density = chosen.material.density
        if density is None:
            density = STEEL
            undense[chosen.key] = None
        if shape.closed and shape.volume > 0.0:
            result.append(solid_moments(shape, placement.transforms[row], density))
        else:
            corners = placement.points(row)[shape.mesh.triangles]
            result.append(shell_moments(corners, density * SHELL))
            open_shapes.setdefault(shape.key, placement.parts[row].id)
    words = f"The material has no density: {STEEL:g} kg/m³ was taken."
    findings += [Finding("MEC030", "info", key, words) for key in undense]
    words = f"The shape is not a closed solid: its mass is that of {with_article(f'{SHELL * 1e3:g}')} mm shell."
    hint = "Close the solid in CAD, or give its body's weight."
    findings += [Finding("MEC031", "info", where, words, hint) for where in open_shapes.values()]
    return tuple(result)


def _factors(
    masses: Mapping[str, float], template: Template, specifications: Specifications, findings: list[Finding]
) -> dict[str, Factor]:
    """The factor of each body's mass: to its published weight where there is one, and to what these leave of the
    operating weight elsewhere. The operating weight includes fluids and operator, so they are spread over the
    bodies."""
    factors = {body: Factor(1.0, "volume × density") for body in masses}
    published = {w.mass_of: (w.name, k) for w in template.wanted if w.mass_of and (k := known(specifications, w.name))}
    for body, (name, weight) in published.items():
        if masses.get(body, 0.0) > 0.0:
            value = weight.value / masses[body]
            factors[body] = Factor(value, f"volume × density × {value:.4g} to {weight.source}")
            _report(body, value, name, weight.value, findings)
    total = published["*"][1] if "*" in published else None
    if total is None:
        return factors
    rest = [body for body in masses if body not in published]
    left = total.value - sum(masses[b] * factors[b].value for b in masses if b in published)
    drawn = sum(masses[b] for b in rest)
    if left <= 0.0 or drawn <= 0.0:
        words = (
            f"The components' published weights leave {display(left, 'kg')} of {display(total.value, 'kg')} for the "
            "other bodies, which keep volume × density."
        )
        findings.append(Finding("MEC033", "warning", "mass", words, "Check the weights."))
        return factors
    value = left / drawn
    for body in rest:
        factors[body] = Factor(value, f"volume × density × {value:.4g} to {total.source}, fluids and operator included")
    _report(
        "every other body" if len(rest) < len(masses) else "every body",
        value,
        "operating weight",
        total.value,
        findings,
    )
    return factors


def _hollowed(weights: Mapping[str, float], placement: Placement, findings: list[Finding]) -> dict[str, Factor] | None:
    """The factor of every body's mass to what a machine of this size usually weighs, where no weight is published and
    it weighs far more: a cab or a frame that is drawn as one solid block. Else None."""
    points = placement.points_of([row for body in weights for row in placement.rows_of_body(body)])
    drawn = sum(weights.values())
    usual = _USUAL * float(np.linalg.norm(np.ptp(points, axis=0))) ** 3 if len(points) else 0.0
    if not drawn > _SOLID * usual > 0.0:
        return None
    value = usual / drawn
    words = (
        f"By volume and density it would weigh {display(drawn, 'kg')}: hollow parts are drawn solid. No sheet gives "
        f"its weight: {display(usual, 'kg')} was taken, usual for its size."
    )
    findings.append(Finding("MEC035", "warning", "mass", words, "Give its operating weight, or a sheet."))
    return {body: Factor(value, f"volume × density × {value:.4g} to the usual weight of its size") for body in weights}


def _report(where: str, factor: float, name: str, weight: float, findings: list[Finding]) -> None:
    words = f"Its mass by volume and density was scaled by {factor:.3f} to meet {name} {display(weight, 'kg')}."
    if _PLAUSIBLE[0] <= factor <= _PLAUSIBLE[1]:
        findings.append(Finding("MEC032", "info", where, words))
    else:
        hint = "Check densities, hollow parts drawn solid, and that the CAD model is whole."
        findings.append(Finding("MEC032", "warning", where, words, hint))
