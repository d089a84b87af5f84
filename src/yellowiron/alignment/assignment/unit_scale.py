"""The unit and the size of a CAD model, checked against the sheet: a machine of 300 "metres" was drawn in inches, one
of half the sheet's lengths by an artist."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np
from scipy.spatial import ConvexHull, QhullError
from scipy.spatial.distance import pdist

from yellowiron.alignment.features.cylinders import cylinders_of
from yellowiron.alignment.features.solids import size_of, solids_of
from yellowiron.alignment.machines import apart_from
from yellowiron.alignment.tolerances import CONTACT
from yellowiron.model.assembly import Assembly, DeclaredJoint
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import CylinderFeature, Floats, PlaneFeature, Shape, SphereFeature
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template

POSES = (0.55, 1.9)
"""The longest extent, which is a diagonal, as a share of the overall length: the sheet's machine has its arms folded,
the drawn one may have them anywhere."""
UNITS = {"millimetres": 1e-3, "centimetres": 1e-2, "inches": 0.0254, "feet": 0.3048, "metres": 1.0}
UNLIKELY = {"millimetres": 0.0, "metres": 0.0, "centimetres": 1.5, "inches": 1.5, "feet": 4.0}
"""How much less than millimetres a model without a unit is in these: minus the logarithm of how often."""
APPLIED_TWICE = {"millimetres": 1e3, "centimetres": 1e2}
"""Metres that were taken for these, and written as metres: what a number is then."""
TWICE = 4.0
"""So unlikely is that, in the same measure."""
NO_UNIT = 8.0
"""So unlikely is that no unit explains a length: four standard deviations from what is usual."""
NEAR = 4.0
"""Units that are no more unlikely than this beside the likeliest are told of."""
TOY = 0.05
"""Metres: no toy is drawn so small."""
AGREE = 0.01
"""Two diameters agree within this share."""
ENOUGH = 3
"""So many diameters of hydraulic cylinders that agree with the sheet's give the scale of a model without a unit."""
OTHER_SIZE = 1.2
"""What is less than so many times as large, or as small, may be a sister of the sheet's machine, or drawn roughly."""
SIZES_AGREE, SIZES = 0.15, 3
"""So many lengths, and two of three of them, agree on it within this share: what an artist draws has a machine's
proportions roughly."""


def to_scale(assembly: Assembly, template: Template, specifications: Specifications) -> Assembly:
    """The model in metres, by the sheet's overall length (the template's value that is `length_of` the whole machine),
    with a finding (ALN014) if that changed it. Without that on a sheet, by how long machines of the type usually are.

    A length that is off by more than a pose can explain means a wrong unit: that unit is taken with which the length
    comes out. If there is none, the diameters of the hydraulic cylinders give the scale; without these the length
    itself does, which is told as a guess.
    """
    wanted = next((w for w in template.wanted if w.length_of == "*"), None)
    length = specifications.number(wanted.name) if wanted is not None else None
    if length is None or length <= 0.0:
        return _to_usual_size(assembly, template)
    drawn = _extent(assembly, template)
    if drawn <= 0.0 or POSES[0] <= drawn / length <= POSES[1]:
        return assembly
    read = f"The CAD model is {drawn:.4g} m long, the sheet's machine {length:.4g} m"
    fitting = {name: unit / assembly.unit for name, unit in UNITS.items()}
    fitting = {name: f for name, f in fitting.items() if POSES[0] <= f * drawn / length <= POSES[1]}
    by_diameters = _by_diameters(assembly, template, specifications, length / drawn)
    if fitting:
        true, factor = min(fitting.items(), key=lambda item: abs(math.log(item[1] * drawn / length)))
        if by_diameters is None or abs(factor / by_diameters - 1) < AGREE:
            return _rescaled(assembly, factor, f"{read}: its numbers are {true}; scaled by {factor:.6g}")
    if by_diameters is not None:
        words = f"{read}: scaled by {by_diameters:.6g}, with which its hydraulic cylinders are the sheet's"
        return _rescaled(assembly, by_diameters, words)
    factor = length / drawn
    return _rescaled(assembly, factor, f"{read}, and no unit explains that: scaled by {factor:.4g}, which is a guess")


def _to_usual_size(assembly: Assembly, template: Template) -> Assembly:
    """The model in the unit with which it is about as long as machines of its type usually are, if it cannot be one as
    it is, or nothing says its unit. What is small in a unit that its file states may be a toy."""
    wanted = next((w for w in template.wanted if w.usual_length is not None or w.length_of == "*"), None)
    if wanted is None or not wanted.minimum or not wanted.maximum:
        return assembly
    usual = wanted.usual_length or (wanted.minimum, wanted.maximum)
    drawn = _extent(assembly, template)
    unknown = any(f.code == "CAD009" and f.severity == "warning" for f in assembly.findings)
    if drawn <= 0.0 or (not unknown and TOY <= drawn <= POSES[1] * wanted.maximum):
        return assembly
    middle = math.sqrt(usual[0] * usual[1])
    # Most of them are between the two: 95 % of a normal distribution of the logarithm.
    spread = math.log(usual[1] / usual[0]) / 4.0

    def unlikely(factor: float) -> float:
        return 0.5 * (math.log(factor * drawn / middle) / spread) ** 2

    units = {name: unit / assembly.unit for name, unit in UNITS.items()}
    doubt = {name: UNLIKELY[name] + unlikely(factor) for name, factor in units.items()}
    name, *others = sorted(doubt, key=lambda name: doubt[name])
    read = f"The CAD model is {drawn:.4g} m long, "
    read += "and no unit is stated" if unknown else "no machine of its type is"
    if doubt[name] <= NO_UNIT:
        words = f"{read}: its numbers are taken for {name}"
        near = [other for other in others if doubt[other] - doubt[name] <= NEAR]
        words += "".join(f", in {other} it would be {units[other] * drawn:.3g} m long" for other in near)
        return assembly if abs(units[name] - 1) < 1e-9 else _rescaled(assembly, units[name], words)
    again = {name: factor / assembly.unit for name, factor in APPLIED_TWICE.items()}
    name = min(again, key=lambda name: unlikely(again[name]))
    if TWICE + unlikely(again[name]) <= NO_UNIT:
        words = f"{read}: its numbers are taken for metres that were read as {name} before"
        return _rescaled(assembly, again[name], words)
    words = f"{read}, and none explains it: scaled by {middle / drawn:.4g} to {middle:.3g} m, which is usual: a guess"
    return _rescaled(assembly, middle / drawn, words)


def other_size(assembly: Assembly, sizes: Mapping[str, tuple[float, float]]) -> tuple[float, Finding] | None:
    """By how much to enlarge a model that is another size than the sheet's machine, as lengths that hang on no pose
    agree (`sizes`: name → on the model, on the sheet, metres, above 0), and what there is to say of that (ALN034); None
    where they do not. 1 where its file is exact: CAD has a size, and the sheet may be another machine's."""
    ratios = {name: math.log(sheet / model) for name, (model, sheet) in sizes.items()}
    middle = float(np.median([*ratios.values()])) if ratios else 0.0
    agreed = [name for name, ratio in ratios.items() if abs(ratio - middle) <= SIZES_AGREE]
    if abs(middle) <= math.log(OTHER_SIZE) or len(agreed) < max(SIZES, 2 * len(ratios) / 3):
        return None
    factor = math.exp(middle)
    words = f"The CAD model is {1.0 / factor:.3g} times as large as the sheet's machine, by {', '.join(agreed)}"
    hint = "Nothing to do if the model is to be the sheet's machine; else give the sheet of the machine that is drawn."
    if any(shape.exact for shape in assembly.shapes.values()):
        factor, hint = 1.0, "Check that the sheet is this machine's; CAD is taken at its word."
    else:
        words += f": scaled by {factor:.3g}"
    return factor, Finding("ALN034", "warning", assembly.name, words, hint)


def _rescaled(assembly: Assembly, factor: float, words: str) -> Assembly:
    hint = "Check the unit that the model was exported in, or give a sheet with the overall length."
    finding = Finding("ALN014", "warning", assembly.name, words, hint)
    return replace(scaled(assembly, factor), findings=(*assembly.findings, finding))


def _extent(assembly: Assembly, template: Template) -> float:
    """Metres between the two points of the machine that are farthest apart; what stands apart does not count."""
    apart = apart_from(assembly, template)
    clouds = [assembly.points_of(p) for p in assembly.parts if p.id not in apart]
    clouds = [c for c in clouds if len(c)]
    if not clouds:
        return 0.0
    points = np.concatenate(clouds)
    try:
        points = points[ConvexHull(points).vertices]
    except QhullError:
        points = np.array([points.min(axis=0), points.max(axis=0)])
    return float(pdist(points[:: max(1, len(points) // 2000)]).max())


def _by_diameters(assembly: Assembly, template: Template, specifications: Specifications, near: float) -> float | None:
    """The scale with which the most diameters of hydraulic cylinders are the sheet's, if enough are and the length
    `near` suggests it too."""
    values = sorted(set(_diameters(template, specifications)))
    solids = solids_of(assembly)
    if not values or not solids:
        return None
    size = size_of(solids)
    drawn = sorted(
        {2 * r for cylinder in cylinders_of(solids, CONTACT[0] * size) for r in (cylinder.bore, cylinder.rod_radius)}
    )
    best: tuple[int, float, float] | None = None
    for first in (v / d for v in values for d in drawn if POSES[0] < v / d / near < POSES[1]):
        pairs = [v / d for v in values for d in drawn if abs(v / d / first - 1) < AGREE]
        met = len({v for v in values for d in drawn if abs(v / d / first - 1) < AGREE})
        rank = (met, -abs(math.log(first / near)), float(np.median(pairs)))
        best = rank if best is None or rank > best else best
    return best[2] if best is not None and best[0] >= ENOUGH else None


def _diameters(template: Template, specifications: Specifications) -> Iterator[float]:
    for actuator in template.actuators:
        for quantity in ("bore", "rod_diameter"):
            name = actuator.specifications.get(quantity)
            value = specifications.number(name) if name is not None else None
            if value is not None and value > 0:
                yield value


def scaled(assembly: Assembly, factor: float) -> Assembly:
    """The model `factor` times as large, about the CAD file's origin."""
    mark = f"x{factor:.9g}"
    shapes = {key + mark: larger(shape, factor, shape.key + mark) for key, shape in assembly.shapes.items()}
    parts = []
    for part in assembly.parts:
        parts.append(replace(part, transform=farther(part.transform, factor), shape=part.shape + mark))
    joints = tuple(_joint(joint, factor) for joint in assembly.joints)
    nodes = tuple(replace(node, transform=farther(node.transform, factor)) for node in assembly.nodes)
    unit = assembly.unit * factor
    return replace(assembly, parts=tuple(parts), shapes=shapes, unit=unit, joints=joints, nodes=nodes)


def farther(transform: Floats, factor: float) -> Floats:
    """A (4, 4) transform, its place `factor` times as far from the origin."""
    matrix = transform.copy()
    matrix[:3, 3] *= factor
    return matrix


def _joint(joint: DeclaredJoint, factor: float) -> DeclaredJoint:
    along = factor if joint.type == "prismatic" else 1.0
    lower, upper = (None if v is None else v * along for v in (joint.lower, joint.upper))
    return replace(joint, anchor=_triple(joint.anchor, factor), lower=lower, upper=upper)


def larger(shape: Shape, factor: float, key: str) -> Shape:
    """A shape `factor` times as large about its frame's origin, under a key of its own."""
    mesh = shape.mesh
    return replace(
        shape,
        key=key,
        mesh=replace(mesh, points=mesh.points * factor),
        volume=shape.volume * factor**3,
        area=shape.area * factor**2,
        centroid=shape.centroid * factor,
        inertia=shape.inertia * factor**5,
        cylinders=tuple(_cylinder(c, factor) for c in shape.cylinders),
        planes=tuple(PlaneFeature(_triple(p.point, factor), p.normal, p.area * factor**2) for p in shape.planes),
        bounds=shape.bounds * factor,
        knuckles=tuple(_cylinder(c, factor) for c in shape.knuckles),
        spheres=tuple(
            SphereFeature(_triple(s.center, factor), s.radius * factor, s.inner, s.area * factor**2)
            for s in shape.spheres
        ),
    )


def _cylinder(c: CylinderFeature, factor: float) -> CylinderFeature:
    return replace(
        c, point=_triple(c.point, factor), radius=c.radius * factor, lower=c.lower * factor, upper=c.upper * factor,
        area=c.area * factor**2, error=c.error * factor,
    )  # fmt: skip


def _triple(v: tuple[float, float, float], factor: float) -> tuple[float, float, float]:
    return (v[0] * factor, v[1] * factor, v[2] * factor)
