"""JSON as the library's own documents are written."""

from __future__ import annotations

import json
from typing import Any


def document_text(value: Any, indent: str = "") -> str:
    """JSON with one line for each key, and lists on one line."""
    if not isinstance(value, dict):
        return json.dumps(value, ensure_ascii=False)
    if not value:
        return "{}"
    inner = indent + "  "
    lines = [
        f"{inner}{json.dumps(key, ensure_ascii=False)}: {document_text(item, inner)}" for key, item in value.items()
    ]
    return "\n".join(("{", ",\n".join(lines), indent + "}"))
