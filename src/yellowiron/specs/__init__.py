"""Specification sheets: PDF → layout statements → the values a template asks for, each with its evidence.

`extract` reads sheets by rules, without any network, or with a language model that the user names; `parse_settings`
takes values a person gives; `merge` decides between sources; `draw_evidence` shows on pictures of the pages where each
value stands; `missing_values` says what a person can still give.
"""

from __future__ import annotations

from yellowiron.specs.asked import missing_values
from yellowiron.specs.endpoint import EndpointError, ModelOptions
from yellowiron.specs.extract import Extractor, extract
from yellowiron.specs.picture import draw_evidence
from yellowiron.specs.settings import merge, parse_settings, split_settings

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
