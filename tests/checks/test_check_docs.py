"""`docs/findings.md` and the code agree."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from yellowiron.checks.rules import RULES

CODE = re.compile(r"\b([A-Z]{3}\d{3})\b")


@pytest.fixture(scope="module")
def rows(root: Path) -> dict[str, list[str]]:
    """Code → the other cells of its row."""
    found: dict[str, list[str]] = {}
    for line in (root / "docs" / "findings.md").read_text(encoding="utf-8").splitlines():
        cells = [c.strip() for c in line.strip("|").split("|")]
        if line.startswith("|") and CODE.fullmatch(cells[0]):
            assert cells[0] not in found, f"{cells[0]} has two rows"
            found[cells[0]] = cells[1:]
    return found


def test_every_rule_has_its_row(rows: dict[str, list[str]]) -> None:
    written = {code: tuple(cells) for code, cells in rows.items() if code.startswith("CHK")}
    assert written == {r.code: (r.severity, r.meaning, r.hint) for r in RULES}


def test_every_code_of_every_stage_has_its_row(rows: dict[str, list[str]], root: Path) -> None:
    """Codes are written as strings where a finding is made."""
    used = {
        code
        for path in sorted((root / "src").rglob("*.py"))
        for code in re.findall(r"[\"']([A-Z]{3}\d{3})[\"']", path.read_text(encoding="utf-8"))
    }
    assert used <= set(rows), sorted(used - set(rows))


def test_no_row_is_left_over(rows: dict[str, list[str]], root: Path) -> None:
    text = "".join(p.read_text(encoding="utf-8") for p in sorted((root / "src").rglob("*.py")))
    known = set(CODE.findall(text))
    assert set(rows) <= known, sorted(set(rows) - known)
