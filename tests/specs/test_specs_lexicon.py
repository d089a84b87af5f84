"""Labels as makers print them, each a sheet of one row: each alone is the value it names, and no other's.

The wordings are in `lexicon/<language>.txt`: below a type's [name] rows of "name = label ; label @ heading above it",
parted by " | " or a new line. A row "- 130 mm = …" is a value that no name asks for: it is nobody's.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from pathlib import Path

import pytest
from test_specs_languages import LANGUAGES, printed

from kit.templates import template
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.reader import Sheet

Row = tuple[str, str, str]
"""A wanted name, or a value that is nobody's; a label; the section it stands in."""
STRICT = ("en", "es")
"""Languages in which nothing else may be seen in a row, not even to review or in conflict."""


@cache
def rows(language: str) -> dict[str, list[Row]]:
    """The rows by type."""
    found: dict[str, list[Row]] = {}
    text = (Path(__file__).parent / "lexicon" / f"{language}.txt").read_text(encoding="utf-8")
    for line in text.splitlines():
        if line.startswith("["):
            here = found.setdefault(line.strip("[]"), [])
        elif not line.startswith("#"):
            for item in line.split(" | "):
                name, labels = item.split(" = ", 1)
                for entry in labels.split(" ; "):
                    label, _, section = entry.partition(" @ ")
                    here.append((name.removeprefix("- "), label, section))
    return found


def value_of(equipment_type: str, name: str) -> str:
    """A value in a name's range, as text; a text that is no name of the type stays as it is."""
    names = [w.name for w in template(equipment_type).wanted]
    return printed(template(equipment_type).wanted[names.index(name)], names.index(name))[0] if name in names else name


def misread(equipment_type: str, own: Iterable[Row], *, strict: bool) -> list[tuple[str, str, dict[str, str]]]:
    """The rows that do not come back `ok` for their name alone, with what came."""
    inside = {w.name for w in template(equipment_type).wanted if w.in_label_of is not None}
    names = {w.name for w in template(equipment_type).wanted}
    wrong = []
    for name, label, section in own:
        text = value_of(equipment_type, name)
        row = Statement(1, 0, label, text, (10.0, 0.0, 90.0, 9.0), f"{label} {text}", section=section)
        found = from_sheets(template(equipment_type), [Sheet("a.pdf", 1, (row,), (), "point")])
        came = {s.name: s.status for s in found if s.status != "missing" and (strict or s.name not in inside)}
        if not strict:
            came = {n: status for n, status in came.items() if status == "ok"}
        if came != ({name: "ok"} if name in names else {}):
            wrong.append((name, label, came))
    return wrong


@pytest.mark.slow
@pytest.mark.parametrize(("language", "equipment_type"), [(one, kind) for one in LANGUAGES for kind in rows(one)])
def test_labels_are_taken_for_what_they_mean(language: str, equipment_type: str) -> None:
    assert misread(equipment_type, rows(language)[equipment_type], strict=language in STRICT) == []
