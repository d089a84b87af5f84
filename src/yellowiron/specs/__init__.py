"""Specification sheets: PDF → layout statements → the values a template asks for, each with its evidence.

`extract` reads sheets by rules, without any network, or with a language model that the user names; `parse_settings`
takes values a person gives; `merge` decides between sources; `draw_evidence` shows on pictures of the pages where each
value stands; `missing_values` says what a person can still give.
"""

from __future__ import annotations

from yellowiron.specs.evidence_images import draw_evidence
from yellowiron.specs.extraction import Extractor, extract
from yellowiron.specs.llm.endpoint import EndpointError, ModelOptions
from yellowiron.specs.values.overrides import merge, parse_settings, split_settings
from yellowiron.specs.values.requested import missing_values

__all__ = [
    "EndpointError",
    "Extractor",
    "ModelOptions",
    "draw_evidence",
    "extract",
    "merge",
    "missing_values",
    "parse_settings",
    "split_settings",
]
