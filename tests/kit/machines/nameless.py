"""Takes every name out of a STEP file: what a machine looks like when its CAD office gave none."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

_STRING = r"'(?:[^']|'')*'"
_PRODUCT = re.compile(rf"\bPRODUCT\s*\(\s*{_STRING}\s*,\s*{_STRING}")
_USAGE = re.compile(rf"\bNEXT_ASSEMBLY_USAGE_OCCURRENCE\s*\(\s*{_STRING}\s*,\s*{_STRING}\s*,\s*{_STRING}")
_SHAPE = re.compile(
    rf"\b(MANIFOLD_SOLID_BREP|BREP_WITH_VOIDS|SHELL_BASED_SURFACE_MODEL|ADVANCED_BREP_SHAPE_REPRESENTATION"
    rf"|SHAPE_REPRESENTATION|MAPPED_ITEM|PRODUCT_DEFINITION_SHAPE)\s*\(\s*{_STRING}"
)


def write_nameless(source: Path, target: Path) -> Path:
    """Copies a STEP file with every product, occurrence and solid renamed Part_001, Part_002, …"""
    number = itertools.count(1)

    def product(_: re.Match[str]) -> str:
        name = f"'Part_{next(number):03d}'"
        return f"PRODUCT({name},{name}"

    text = source.read_text(encoding="latin-1")
    text = _PRODUCT.sub(product, text)
    text = _USAGE.sub(lambda m: f"NEXT_ASSEMBLY_USAGE_OCCURRENCE('{next(number)}','',''", text)
    text = _SHAPE.sub(lambda m: f"{m.group(1)}(''", text)
    target.write_text(text, encoding="latin-1")
    return target
