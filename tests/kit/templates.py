"""The library's templates, each loaded once a process."""

from __future__ import annotations

from functools import cache

from yellowiron.library import load_template
from yellowiron.model.template import Template


@cache
def template(equipment_type: str) -> Template:
    """All that a sheet can be asked for of a type; with bodies and joints where the library has them."""
    return load_template(equipment_type, sheet_only=True)
