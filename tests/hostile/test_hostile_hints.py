"""Every error that is raised says where, and what to do."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

FAMILY = {"YellowironError", "CadError", "SheetError", "TemplateError", "AlignmentError", "MechanismError",
          "OutputError", "NoReaderError", "EndpointError", "KinematicsError"}  # fmt: skip


def statements(node: ast.AST) -> Iterator[ast.AST]:
    """All statements below a node; what they say is a hundred times as many."""
    for field in ("body", "orelse", "finalbody", "handlers", "cases"):
        for one in found if isinstance(found := getattr(node, field, ()), list) else ():
            yield one
            yield from statements(one)


def test_every_error_has_where_and_hint(root: Path) -> None:
    bare = []
    for file in sorted((root / "src").rglob("*.py")):
        text = file.read_text(encoding="utf-8")
        for node in statements(ast.parse(text)) if "raise " in text else ():
            if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call) and isinstance(node.exc.func, ast.Name):
                said = {keyword.arg for keyword in node.exc.keywords}
                if node.exc.func.id in FAMILY and not {"where", "hint"} <= said:
                    bare.append(f"{file.relative_to(root)}:{node.lineno}")
    assert bare == []
