"""The columns of a sheet's tables: the models or configurations that `--config` chooses among."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from yellowiron.specs.layout.statement import Statement, is_key, is_unit
from yellowiron.specs.reader import Sheet
from yellowiron.specs.values.claims import is_system

_FEWEST = 3
"""Values under a head that name a column; a table with fewer is none of specifications."""


@dataclass(frozen=True)
class SheetColumn:
    """A column: its head as `--config` takes it, the sheet's file, the first page it stands on (1 = first), and how
    many values stand under it."""

    name: str
    file: str
    page: int
    values: int


def columns_of(sheets: Sequence[Sheet]) -> list[SheetColumn]:
    """The columns that stand beside others of their row, each with its own values, in the order of the sheets."""
    found: list[SheetColumn] = []
    for sheet in sheets:
        rows: dict[tuple[int, int], list[Statement]] = {}
        for statement in sheet.statements:
            if statement.column:
                rows.setdefault((statement.page, statement.row), []).append(statement)
        under: dict[str, list[int]] = {}
        for row in rows.values():
            shared = set.intersection(*(set(s.column) for s in row))
            for statement in row if len(row) > 1 else []:
                for head in statement.column:
                    if head not in shared and _names_one(head):
                        under.setdefault(head, []).append(statement.page)
        found += [
            SheetColumn(head, sheet.file, min(pages), len(pages))
            for head, pages in under.items()
            if len(pages) >= _FEWEST
        ]
    return found


def _names_one(head: str) -> bool:
    """Whether a head may name a model or a configuration: it has letters, and is no unit, system or drawing's key."""
    return any(map(str.isalpha, head)) and not (is_unit(head) or is_system(head) or is_key(head))
