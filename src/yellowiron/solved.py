"""A machine before it is measured and written. Read from the disk it needs no library of the stage that made it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from yellowiron.mechanism import ComparedJoint
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template


@dataclass(frozen=True, eq=False)
class Solved:
    """What `stages.solve` makes of an aligned CAD model: `chosen`, the template with its variants decided, `template`,
    that with its rows counted; the CAD model, as started; what the file's declared joints were `compared` to;
    `started`: joint → metres or radians from the drawn pose to the one it starts in."""

    chosen: Template
    template: Template
    assembly: Assembly
    alignment: Alignment
    mechanism: Mechanism
    specifications: Specifications
    compared: tuple[ComparedJoint, ...]
    started: Mapping[str, float] = field(default_factory=dict)
