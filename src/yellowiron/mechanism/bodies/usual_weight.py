"""What a machine of a type weighs by the length of what it stands on."""

from __future__ import annotations

import numpy as np

from yellowiron.mechanism.placement import Placement
from yellowiron.mechanism.values import Known
from yellowiron.model.template import Template

_WHEELS = frozenset({"wheel", "tyre"})
_TRACKS = frozenset({"sprocket", "idler", "roller", "carrier", "shoe"})
_LEAST, _APART = 0.8, 1.3
"""Of its width, and, on wheels, of the longest one's length: wheels of one axle alone, or of one side of it, are no
length to judge a machine by."""

_PIECE = 0.15
"""What is shorter than this share of the machine's diagonal is a piece of what it stands on: excavators whose booms are
stretched out stand on 0.3 of it."""


def usual_weight(placement: Placement, template: Template) -> Known | None:
    """The weight (kg) that machines of the template's type have for the length of what they stand on (`ground_length`),
    by the `usual_weight` of the wanted value that is the machine's weight; None where either is not known, or only a
    piece of what it stands on."""
    entry = next((w for w in template.wanted if w.usual_weight is not None), None)
    length = ground_length(placement, template)
    if entry is None or entry.usual_weight is None or length is None:
        return None
    if length < _PIECE * placement.diagonal(range(len(placement.roles))):
        return None
    source = f"usual for {template.equipment_type.replace('_', ' ')}s that stand on {length:.2f} m"
    return Known(entry.usual_weight * length**3, source)


def ground_length(placement: Placement, template: Template) -> float | None:
    """Metres along x: from the front of the front wheels to the back of the rear ones, or of the tracks and the frame
    between them where the type has no wheels; None where too little of them is found."""
    kinds = {role.name: role.kind for role in template.roles}
    if _WHEELS & {*kinds.values()}:
        rows = [row for row, role in enumerate(placement.roles) if role and kinds.get(role) in _WHEELS]
    else:
        rows = [row for row, role in enumerate(placement.roles) if role and kinds.get(role) in _TRACKS]
        rows += placement.rows_of_body(template.root)
    if not rows:
        return None
    length, width, _ = np.ptp(placement.points_of(rows), axis=0)
    least = _LEAST * width
    if _WHEELS & {*kinds.values()}:
        least = max(least, _APART * max(float(np.ptp(placement.points_of([row])[:, 0])) for row in rows))
    return float(length) if length >= least else None
