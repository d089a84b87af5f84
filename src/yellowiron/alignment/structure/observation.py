"""What geometry shows of a CAD model before any role: solids, contacts, hydraulic cylinders, wheels, and what each
contact can mean."""

from __future__ import annotations

from dataclasses import dataclass, replace

from yellowiron.alignment.features.ball_joints import ball_fits_of
from yellowiron.alignment.features.contacts import (
    Flat,
    bare_fits_of,
    fits_of,
    flats_of,
    neighbours,
)
from yellowiron.alignment.features.cylinders import DrawnCylinder, cylinders_of
from yellowiron.alignment.features.distance import Touch
from yellowiron.alignment.features.pinless_pivots import has_drilled_pivots, round_end_fits_of, stay_bars_of
from yellowiron.alignment.features.solids import Solid, size_of, solids_of
from yellowiron.alignment.features.telescopes import Nest, nests_of
from yellowiron.alignment.features.undrilled import interrupted_fits_of, pierced_fits_of, rimmed_fits_of
from yellowiron.alignment.features.undrilled_cylinders import apart_cylinders_of, solid_cylinders_of
from yellowiron.alignment.features.wheels import Wheel, rolling_of
from yellowiron.alignment.structure.branches import branches_of
from yellowiron.alignment.structure.contact_evidence import ContactEvidence, Contacts, evidence_of, tables_of
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats
from yellowiron.model.template import Template
from yellowiron.support.caching.remembered import remembered


@dataclass(frozen=True, eq=False)
class Observation:
    """What geometry shows, before any role: the solids, flat contacts and `near` pairs of them, hydraulic cylinders,
    wheels, sections in each other (`nests`), pairs of solids of which one is the other's child in
    the scene's tree (`branches`), what the contacts can mean (`evidence`: the usual reading first, then, if
    it differs, the one with slewing bearings), what asks for distances (`touch`), the machine's size in metres, the
    upright where it is known, and the solids of its tracks (`rows`), which the others are without. CAD frame."""

    solids: tuple[Solid, ...]
    flats: list[Flat]
    near: list[tuple[int, int]]
    cylinders: tuple[DrawnCylinder, ...]
    wheels: list[Wheel]
    evidence: tuple[ContactEvidence, ...]
    touch: Touch
    size: float
    up: Floats | None = None
    nests: tuple[Nest, ...] = ()
    branches: tuple[tuple[int, int], ...] = ()
    rows: tuple[Solid, ...] = ()


@remembered
def observe(assembly: Assembly, template: Template, contact: float) -> Observation:
    """Looks at a model with a contact tolerance (share of its diagonal); `template` says what to look for: hydraulic
    cylinders, how many wheels, a slewing bearing."""
    solids = solids_of(assembly)
    if not solids:
        return Observation((), [], [], (), [], (), Touch((), 0.0), 0.0)
    size = size_of(solids)
    tolerance = contact * size
    touch = Touch(solids, tolerance)
    fixed = any(c.rams for a in template.actuators for c in a.cylinders)
    # A rope in its block looks like a cylinder.
    drawn = fixed or any(r.kind in ("barrel", "rod") for r in template.roles)
    cylinders = cylinders_of(solids, tolerance, fixed=fixed) if drawn else []
    if any(r.kind == "barrel" for r in template.roles):
        cylinders += solid_cylinders_of(solids, cylinders, tolerance)
        cylinders += apart_cylinders_of(solids, cylinders, tolerance)
    fits = fits_of(solids, tolerance) + ball_fits_of(solids, tolerance)
    fits += interrupted_fits_of(solids, fits, tolerance)
    fits += rimmed_fits_of(solids, fits, touch)
    pierced = pierced_fits_of(solids, fits, cylinders, touch, size)
    fits += pierced
    stays: frozenset[int] = frozenset()
    holes = has_drilled_pivots(solids, template, size)
    if not holes:
        ended = round_end_fits_of(solids, fits, cylinders, touch, size)
        stays = stay_bars_of(pierced, ended, solids, touch)
        fits += ended
    bare = bare_fits_of(solids, fits, tolerance)
    near = neighbours(solids, tolerance)
    flats = flats_of(solids, near, tolerance)
    nests = tuple(nests_of(solids, size, tolerance)) if _sections(template) else ()
    taken = {i for r in cylinders for i in r.barrel | r.rod}
    wheels = rolling_of(solids, template, taken, tolerance)

    contacts = Contacts(
        solids, fits, bare, flats, cylinders, wheels, near, touch.touching, tolerance, nests, stays, holes, fixed
    )  # fmt: skip
    evidence = [evidence_of(contacts)]
    if slewing_joints(template):
        other = evidence_of(replace(contacts, fits=[*fits, *tables_of(solids, flats)]), slewing=True)
        evidence += [other] if len(other.races) > len(evidence[0].races) else []
    branches = branches_of(assembly, solids)
    return Observation(
        solids, flats, near, tuple(cylinders), wheels, tuple(evidence), touch, size, nests=nests, branches=branches
    )


def _sections(template: Template) -> bool:
    """Whether it has slides that are no hydraulic cylinder's: sections of a telescopic boom."""
    kinds = {r.name: r.kind for r in template.roles}
    sliding = [template.bodies_of(j) for j in template.joints if j.type == "prismatic"]
    return any(not {"barrel", "rod"} & {kinds[b] for b in ends if b is not None} for ends in sliding)


def slewing_joints(template: Template) -> list[str]:
    """Joints between two frames that have a motor: the machine turns about them on a bearing."""
    frames = {r.name for r in template.roles if r.kind == "frame" and r.rigid}
    driven = [j for j in template.joints if j.type == "revolute" and j.drive is not None]
    return [j.name for j in driven if set(template.bodies_of(j)) <= frames]
