"""Roles for the parts of a CAD model: the machine is what stands together; it is read again with what floats far from
it, where that may be its own, and the judge's points decide."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from yellowiron.alignment.fusion.judge import weights
from yellowiron.alignment.fusion.pieces import LARGE
from yellowiron.alignment.fusion.reading import AS_GOOD
from yellowiron.alignment.machines import with_floating
from yellowiron.alignment.pipeline import Reading, read
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import AlignmentError
from yellowiron.model.geometry import Floats
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template


def align(
    assembly: Assembly,
    template: Template,
    specifications: Specifications,
    *,
    edits: Alignment | None = None,
    choices: Mapping[str, str] | None = None,
    square: Floats | None = None,
) -> Alignment:
    """Roles for the parts of a CAD model.

    `template` may carry variants: those `decided_by` geometry are tried and the best is taken, unless `choices` fixes
    them. `edits` is an earlier alignment, as a person left it (`read_alignment`): its rules and the parts that were
    `DECIDED` keep their role. `square`: how the model was turned against its file (`squared`). `AlignmentError` for an
    assembly without parts, for an unknown choice, and for edits that name parts or roles that do not exist. The result
    does not depend on the order or names (beyond their weight) of the parts.
    """
    if not assembly.parts:
        raise AlignmentError(
            "The CAD model has no parts", where=assembly.name, hint="Check that the file holds solids."
        )
    first = read(assembly, template, specifications, edits, choices, square, None)
    if first.score is None:
        return first.found
    floating = with_floating(first.single, first.apart, first.found.frame[2, :3])
    if floating is None:
        return first.found
    whole = read(assembly, template, specifications, edits, choices, square, floating)
    return (whole if _standing(whole) > _standing(first) + AS_GOOD else first).found


def _standing(reading: Reading) -> float:
    """What the judge makes of all that is drawn: what is large is not left out lightly."""
    if reading.score is None:
        return np.inf
    areas = {p.id: reading.single.shape_of(p).area for p in reading.single.parts}
    most = max((area for part, area in areas.items() if part not in reading.apart), default=0.0) or 1.0
    shares = [min(1.0, areas[part] / most) for part, metres in sorted(reading.apart.items()) if metres > 0.0]
    return reading.score + weights()["left out"] * sum(float(np.sqrt(s)) for s in shares if s > LARGE)
