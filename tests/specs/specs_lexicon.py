"""Labels as makers print them, each a sheet of one row: what the extractor takes it for."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache

from test_specs_languages import printed

from yellowiron.library import load_template
from yellowiron.model.template import Template
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.reader import Sheet


@cache
def asked_for(equipment_type: str) -> Template:
    return load_template(equipment_type, sheet_only=True)


def value_of(equipment_type: str, name: str) -> str:
    """A value in a name's range, as text; a text that is no name of the type stays as it is."""
    names = [w.name for w in asked_for(equipment_type).wanted]
    return printed(asked_for(equipment_type).wanted[names.index(name)], names.index(name))[0] if name in names else name


def misread(
    equipment_type: str, rows: Iterable[tuple[str, str, str]], *, strict: bool = False
) -> list[tuple[str, str, dict[str, str]]]:
    """Of rows of a wanted name (or of a value that is nobody's), label and section: those that do not come back `ok`
    for that name alone, with what came. `strict`: nor may anything else be seen in them, to review or in conflict."""
    inside = {w.name for w in asked_for(equipment_type).wanted if w.in_label_of is not None}
    names = {w.name for w in asked_for(equipment_type).wanted}
    wrong = []
    for name, label, section in rows:
        text = value_of(equipment_type, name)
        row = Statement(1, 0, label, text, (10.0, 0.0, 90.0, 9.0), f"{label} {text}", section=section)
        found = from_sheets(asked_for(equipment_type), [Sheet("a.pdf", 1, (row,), (), "point")])
        came = {s.name: s.status for s in found if s.status != "missing" and (strict or s.name not in inside)}
        if not strict:
            came = {n: status for n, status in came.items() if status == "ok"}
        if came != ({name: "ok"} if name in names else {}):
            wrong.append((name, label, came))
    return wrong
