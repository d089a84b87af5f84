"""Mass: volume × density, exact, then reconciled with published weights.

Everything is carried as second moments Σ = ∫ x xᵀ dm about a centre of mass rather than as inertia: a linear map L
takes a solid's Σ to |det L| · L Σ Lᵀ whatever it mirrors or scales, sums stay positive semi-definite, and the inertia
I = tr(Σ)·1 − Σ then always meets the triangle inequality.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from yellowiron.mechanism.bodies.axle_loads import balance_of
from yellowiron.mechanism.bodies.choice import Choice
from yellowiron.mechanism.bodies.usual_shares import WITHIN, shares_finding, shares_of, within_usual
from yellowiron.mechanism.bodies.usual_weight import usual_weight
from yellowiron.mechanism.placement import Placement
from yellowiron.mechanism.values import Known, known
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats, Shape
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Material, Template
from yellowiron.support.text import display

STEEL = 7850.0
"""Density where a material states none, kg/m³."""
SHELL = 0.005
"""Thickness of an open mesh, metres, where nothing else is known: its mass is surface × this × density."""
THICKNESS = (0.002, 0.02)
"""… and within which the machine's weight decides it: plates of small machines and of large ones."""
_THIN = 1e-4
"""Least radius of gyration of a body along any axis, metres: an inertia of zero stops every engine."""
_FLAT = 5e-7
"""… and of its largest second moment, so that the principal moments of what is flat are possible ones in single
precision too."""
_PLAUSIBLE = (0.5, 2.0)
"""Factors to a published weight outside of this are a warning."""

_WHOLE = "*"
"""The whole machine, where a weight says of what it is."""

_USUAL = 30.0
"""What a machine weighs, kg, for each m³ of the cube of its box's diagonal: from makers' weights and dimensions, 18
(a 20 t excavator) to 35 (a 12 t compactor); dozers 60."""
_SOLID = 3.0
"""So many times as much and more is of hollow things that are drawn solid."""
_NEAR = (0.67, 1.5)
"""By volume and density a machine may weigh so many times what is usual for its type and size."""


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
        floor = max(self.mass * _THIN**2, _FLAT * float(values.max()))
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
    moments, sheets = _part_moments(placement, materials, findings)
    rows = [row for body in bodies for row in placement.rows_of_body(body)]
    published = _published(template, specifications)
    total = published[_WHOLE][1] if _WHOLE in published else None
    drawn = sum(moments[row].mass for row in rows)
    if total is None:
        total = _assumed(drawn, placement, template, findings)
    moments = _rolled(moments, sheets, rows, total, placement, findings)
    weights = {b: sum(moments[row].mass for row in placement.rows_of_body(b)) for b in bodies}
    factors = _factors(weights, published, total, findings)
    least, most = _PLAUSIBLE if _WHOLE in published else _NEAR
    balance = balance_of(template, placement, specifications)
    amiss = total is not None and not least <= drawn / total.value <= most
    if amiss or (balance is not None and balance.far(*_bodies(moments, factors, placement))):
        factors = _held(factors, weights, published, template, placement, findings)
    if balance is not None:
        body, by = balance.forward_by(*_bodies(moments, factors, placement), findings)
        moments = _moved(moments, placement.rows_of_body(body), by)
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
) -> tuple[tuple[Moments, ...], frozenset[int]]:
    """The mass of every placed part by its volume and density, machine frame, and the rows of those that are no closed
    solids, which weigh as sheets of `SHELL`."""
    result = []
    undense: dict[str, None] = {}
    sheets = set()
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
            sheets.add(row)
    words = f"The material has no density: {STEEL:g} kg/m³ was taken."
    findings += [Finding("MEC030", "info", key, words) for key in undense]
    return tuple(result), frozenset(sheets)


def _published(template: Template, specifications: Specifications) -> dict[str, tuple[str, Known]]:
    """Body (or `*`) → the wanted name that gives its weight, and the weight, kg."""
    return {w.mass_of: (w.name, k) for w in template.wanted if w.mass_of and (k := known(specifications, w.name))}


def _assumed(drawn: float, placement: Placement, template: Template, findings: list[Finding]) -> Known | None:
    """The weight (kg) that a machine of this type and size usually has, where none is published and volume and density
    give another; MEC035 then."""
    usual = usual_weight(placement, template)
    if usual is None:
        return _hollowed(drawn, placement, _hint(template), findings)
    if drawn <= 0.0 or _NEAR[0] <= drawn / usual.value <= _NEAR[1]:
        return None
    words = (
        f"By volume and density it would weigh {display(drawn, 'kg')}: hollow parts are drawn solid, or solid ones as "
        f"sheets. No sheet gives its weight: {display(usual.value, 'kg')} was assumed, {usual.source}."
    )
    findings.append(Finding("MEC035", "warning", "mass", words, _hint(template)))
    return usual


def _hint(template: Template) -> str:
    """What to give for a weight that was assumed."""
    name = next((w.name for w in template.wanted if w.mass_of == _WHOLE), None)
    return f'Give --set "{name}=… kg", or a sheet.' if name is not None else "Give its operating weight, or a sheet."


def _rolled(
    moments: Sequence[Moments],
    sheets: Container[int],
    rows: Sequence[int],
    total: Known | None,
    placement: Placement,
    findings: list[Finding],
) -> tuple[Moments, ...]:
    """The parts with sheets as thick as the machine's weight makes them, where it is known: what is closed has its
    volume, and the rest of the weight is in what is not. MEC031 says for every open shape how thick it is."""
    opened = [row for row in rows if row in sheets]
    thin = sum(moments[row].mass for row in opened)
    thickness, why = SHELL, ""
    if total is not None and thin > 0.0:
        solid = sum(moments[row].mass for row in rows) - thin
        thickness = float(np.clip(SHELL * (total.value - solid) / thin, *THICKNESS))
        why = ", by what the machine's weight leaves for its open shapes"
    words = f"The shape is not a closed solid: it weighs as a sheet of {1e3 * thickness:.2g} mm{why}."
    hint = "Close the solid in CAD, or give its body's weight."
    shown = {placement.shapes[row].key: placement.parts[row].id for row in reversed(opened)}
    findings += [Finding("MEC031", "info", where, words, hint) for where in reversed(shown.values())]
    return tuple(m.scaled(thickness / SHELL) if row in sheets else m for row, m in enumerate(moments))


def _factors(
    masses: Mapping[str, float],
    published: Mapping[str, tuple[str, Known]],
    total: Known | None,
    findings: list[Finding],
) -> dict[str, Factor]:
    """The factor of each body's mass: to its published weight where there is one, and to what these leave of the
    machine's (published or assumed) elsewhere. The operating weight includes fluids and operator, so they are spread
    over the bodies."""
    factors = {body: Factor(1.0, "volume × density") for body in masses}
    for body, (name, weight) in published.items():
        if masses.get(body, 0.0) > 0.0:
            value = weight.value / masses[body]
            factors[body] = Factor(value, f"volume × density × {value:.4g} to {weight.source}")
            _report(body, value, name, weight.value, findings)
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
    if _WHOLE not in published:  # told with what was assumed
        return factors
    _report(
        "every other body" if len(rest) < len(masses) else "every body",
        value,
        "operating weight",
        total.value,
        findings,
    )
    return factors


def _held(
    factors: Mapping[str, Factor],
    weights: Mapping[str, float],
    published: Mapping[str, tuple[str, Known]],
    template: Template,
    placement: Placement,
    findings: list[Finding],
) -> dict[str, Factor]:
    """The factors of a machine that volume and density say little of: no body far from its usual share of the
    weight, but those of published weight. MEC039 says which that changed."""
    masses = {body: weight * factors[body].value for body, weight in weights.items() if weight > 0.0}
    kept = {body: masses[body] for body in published if body in masses}
    held = within_usual(masses, shares_of(template, placement), kept)
    told = shares_finding(masses, held, template.equipment_type.replace("_", " ") + "s")
    if told is None:
        return dict(factors)
    findings.append(told)
    return {
        body: factor
        if body in kept or body not in masses
        else Factor(held[body] / weights[body], f"{factor.source}; held to within {WITHIN:g} times its usual share")
        for body, factor in factors.items()
    }


def _bodies(
    moments: Sequence[Moments], factors: Mapping[str, Factor], placement: Placement
) -> tuple[dict[str, float], dict[str, Floats]]:
    """What bodies weigh, kg, and their centres of mass (3,), machine frame."""
    whole = {b: combine(moments[r] for r in placement.rows_of_body(b)).scaled(f.value) for b, f in factors.items()}
    return {b: m.mass for b, m in whole.items()}, {b: m.center for b, m in whole.items()}


def _moved(moments: Sequence[Moments], rows: Container[int], by: float) -> tuple[Moments, ...]:
    """The parts, those of some rows so far forward, m."""
    shift = np.array([by, 0.0, 0.0])
    return tuple(replace(m, center=m.center + shift) if r in rows else m for r, m in enumerate(moments))


def _hollowed(drawn: float, placement: Placement, hint: str, findings: list[Finding]) -> Known | None:
    """What a machine of this size usually weighs (kg), where it weighs far more: a cab or a frame that is drawn as one
    solid block. Else None."""
    points = placement.points_of(range(len(placement.parts)))
    usual = _USUAL * float(np.linalg.norm(np.ptp(points, axis=0))) ** 3 if len(points) else 0.0
    if not drawn > _SOLID * usual > 0.0:
        return None
    words = (
        f"By volume and density it would weigh {display(drawn, 'kg')}: hollow parts are drawn solid. No sheet gives "
        f"its weight: {display(usual, 'kg')} was taken, usual for its size."
    )
    findings.append(Finding("MEC035", "warning", "mass", words, hint))
    return Known(usual, "the usual weight of its size")


def _report(where: str, factor: float, name: str, weight: float, findings: list[Finding]) -> None:
    words = f"Its mass by volume and density was scaled by {factor:.3f} to meet {name} {display(weight, 'kg')}."
    if _PLAUSIBLE[0] <= factor <= _PLAUSIBLE[1]:
        findings.append(Finding("MEC032", "info", where, words))
    else:
        hint = "Check densities, hollow parts drawn solid, and that the CAD model is whole."
        findings.append(Finding("MEC032", "warning", where, words, hint))
