"""Alignment: Assembly × Template × Specifications → which part plays which role, by geometry first, names as evidence.

In: an `Assembly`, a `Template`, `Specifications`, and an earlier `Alignment` that a person edited. Out: an `Alignment`;
of a machine of no known type, a `FoundMachine`. Each sub-package builds on those before it: `features` (parts and
contacts), `structure` (rigid clusters, hinges), `assignment` (which cluster is which body), `labelling` (every part's
role). `axes` (where joints are that no pin shows) needs `features` only, `discovery` the first two, `files` only the
model. `pipeline` is the whole way, in order; `readings` goes it again where what floats may be the machine's own;
`machines`: which of what is drawn the machine is; `tolerances` are what several of them share.

Findings: `ALN001` no part plays a required role · `ALN002` a joint is found but no part of its own plays its pin ·
`ALN003` the machine's frame is partly a guess · `ALN004` the search was cut short · `ALN005` an edited role exists only
under another choice of a variant · `ALN006` a hydraulic cylinder is not drawn as the sheet has it ·
`ALN007` no body is left for parts that could move · `ALN008` a cylinder is to one side · `ALN009` parts stand apart and
are left out · `ALN010` there seems to be more than one machine · `ALN011` the wheels have no tyres · `ALN016` a joint's
axis is estimated · `ALN026` to `ALN028`: see `files.decisions` · `ALN029` one half is drawn ·
`ALN032` a variant is in doubt · `ALN033` parts in another unit ·
`ALN034` another size than the sheet's machine.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.alignment.apart import between_apart, between_found
    from yellowiron.alignment.assignment.sides import twin_role
    from yellowiron.alignment.assignment.unit_scale import other_size, scaled, to_scale
    from yellowiron.alignment.discovery.discover import discover
    from yellowiron.alignment.discovery.robot import declared_roles, discover_declared
    from yellowiron.alignment.facing import named_direction
    from yellowiron.alignment.files.alignment_json import (
        parts_in,
        read_alignment,
        read_joints,
        read_values,
        said_in,
        write_alignment,
    )
    from yellowiron.alignment.files.decisions import decide, fits, parse_rules
    from yellowiron.alignment.files.explanation import explain
    from yellowiron.alignment.files.heard import as_said
    from yellowiron.alignment.files.whole import ABSENT, parse_machine, whole
    from yellowiron.alignment.labelling.confidence import REVIEW
    from yellowiron.alignment.labelling.halves import of_drawn
    from yellowiron.alignment.mixed_units import in_one_unit, reviewed
    from yellowiron.alignment.readings import align
    from yellowiron.alignment.square import squared, turned_back

__all__ = [
    "ABSENT",
    "REVIEW",
    "align",
    "as_said",
    "between_apart",
    "between_found",
    "decide",
    "declared_roles",
    "discover",
    "discover_declared",
    "explain",
    "fits",
    "in_one_unit",
    "named_direction",
    "of_drawn",
    "other_size",
    "parse_machine",
    "parse_rules",
    "parts_in",
    "read_alignment",
    "read_joints",
    "read_values",
    "reviewed",
    "said_in",
    "scaled",
    "squared",
    "to_scale",
    "turned_back",
    "twin_role",
    "whole",
    "write_alignment",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "ABSENT": "files.whole",
        "REVIEW": "labelling.confidence",
        "align": "readings",
        "as_said": "files.heard",
        "between_apart": "apart",
        "between_found": "apart",
        "decide": "files.decisions",
        "declared_roles": "discovery.robot",
        "discover": "discovery.discover",
        "discover_declared": "discovery.robot",
        "explain": "files.explanation",
        "fits": "files.decisions",
        "in_one_unit": "mixed_units",
        "named_direction": "facing",
        "other_size": "assignment.unit_scale",
        "of_drawn": "labelling.halves",
        "parse_machine": "files.whole",
        "parse_rules": "files.decisions",
        "parts_in": "files.alignment_json",
        "read_alignment": "files.alignment_json",
        "read_joints": "files.alignment_json",
        "read_values": "files.alignment_json",
        "reviewed": "mixed_units",
        "said_in": "files.alignment_json",
        "scaled": "assignment.unit_scale",
        "squared": "square",
        "to_scale": "assignment.unit_scale",
        "turned_back": "square",
        "twin_role": "assignment.sides",
        "whole": "files.whole",
        "write_alignment": "files.alignment_json",
    },
)
