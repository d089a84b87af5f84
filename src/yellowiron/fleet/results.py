"""A fleet's table, from its items' folders: one row a machine, in the manifest's order, as CSV and as Parquet."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping, Sequence
from typing import Any

from yellowiron.fleet.attending import SECONDS, folder_of
from yellowiron.fleet.figures import COLUMNS
from yellowiron.fleet.places import MARK, Store
from yellowiron.fleet.values import CODES, Plan
from yellowiron.model.errors import YellowironError

Row = Mapping[str, Any]
TABLE, PLAIN = "fleet.parquet", "fleet.csv"


def rows_of(plan: Plan, store: Store) -> list[dict[str, Any]]:
    """A row for every item of a plan, with all `COLUMNS`; of one that was not run yet the status is `absent`."""
    marks = marks_of(plan, store)
    times = {
        name.split("/")[1]: json.loads(content)
        for name, content in store.read_all(f"{folder_of(item)}/{SECONDS}" for item in plan.items).items()
    }
    rows = []
    for item in plan.items:
        mark = marks.get(item.id, {"status": "absent"})
        told = {**mark, **mark.get("figures", {}), **times.get(item.id, {})}
        told |= {"id": item.id, "type": item.type, "code": CODES.get(mark["status"], 2)}
        rows.append({name: told.get(name, _EMPTY.get(kind)) for name, kind in COLUMNS.items()})
    return rows


_EMPTY: Mapping[str, Any] = {"text": "", "texts": []}


def marks_of(plan: Plan, store: Store) -> dict[str, dict[str, Any]]:
    """What the folders of a plan's items say, those that are there and whole."""
    found = {}
    for name, content in store.read_all(f"{folder_of(item)}/{MARK}" for item in plan.items).items():
        try:
            told = json.loads(content)
        except ValueError:
            continue
        if isinstance(told, dict) and {"id", "key", "status"} <= told.keys():
            found[name.split("/")[1]] = told
    return found


def as_csv(rows: Sequence[Row]) -> bytes:
    """The table as CSV; several words in a cell have a space between them."""
    text = io.StringIO()
    writer = csv.DictWriter(text, list(COLUMNS), lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow({name: " ".join(value) if isinstance(value, list) else value for name, value in row.items()})
    return text.getvalue().encode("utf-8", errors="backslashreplace")


def as_parquet(columns: Mapping[str, str], rows: Sequence[Row]) -> bytes:
    """A table as Parquet, for DuckDB, pandas and Polars; the same rows give the same bytes. `columns` are names and
    kinds, as in `COLUMNS`. `YellowironError` where pyarrow is not installed."""
    arrow, parquet = _arrow()
    kinds = {
        "text": arrow.string(), "integer": arrow.int64(), "number": arrow.float64(), "flag": arrow.bool_(),
        "texts": arrow.list_(arrow.string()),
    }  # fmt: skip
    fields = [arrow.field(name, kinds[kind]) for name, kind in columns.items()]
    table = arrow.Table.from_pylist([dict(row) for row in rows], schema=arrow.schema(fields))
    sink = io.BytesIO()
    parquet.write_table(table, sink, compression="zstd")
    return sink.getvalue()


def has_parquet() -> bool:
    """Whether pyarrow is installed."""
    try:
        _arrow()
    except YellowironError:
        return False
    return True


def _arrow() -> tuple[Any, Any]:
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError as error:
        hint = "pip install 'yellowiron[fleet]'; fleet.csv says the same."
        raise YellowironError("Parquet needs pyarrow, which is not installed", where=TABLE, hint=hint) from error
    return pyarrow, pyarrow.parquet
