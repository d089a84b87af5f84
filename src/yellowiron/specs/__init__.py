"""Specification sheets: PDF → layout statements → the values a template asks for, each with its evidence.

`extract` reads sheets by rules, without any network; `parse_settings` takes values a person gives; `merge` decides
between sources; `draw_evidence` shows on pictures of the pages where each value stands.
"""

from __future__ import annotations

from yellowiron.specs.extract import extract
from yellowiron.specs.picture import draw_evidence
from yellowiron.specs.settings import merge, parse_settings, split_settings

__all__ = ["draw_evidence", "extract", "merge", "parse_settings", "split_settings"]
