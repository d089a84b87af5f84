"""The table and the page of a fleet, made from its items' folders alone."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import pytest

from yellowiron.fleet.figures import COLUMNS, FIGURES
from yellowiron.fleet.places import Store, store_at
from yellowiron.fleet.results import as_csv, as_parquet, has_parquet, rows_of
from yellowiron.fleet.values import Item, Plan
from yellowiron.fleet.whole import collected


@pytest.fixture
def fleet(tmp_path: Path) -> tuple[Plan, Store]:
    """Three items: one built, one refused, one that was not run."""
    items = tuple(Item(name, "wheel_loader", f"/{name}.step") for name in ("good", "bad", "later"))
    store = store_at(tmp_path / "out")
    figures: dict[str, Any] = {
        **dict.fromkeys(FIGURES), "machine": "good", "verdict": "Moves: boom.", "open": "2 warnings", "bodies": 21,
        "worst_error_percent": 0.25, "findings": ["ALN003", "MEC027"], "engines": [],
    }  # fmt: skip
    marks = {
        "good": {"id": "good", "key": "k1", "status": "short", "figures": figures},
        "bad": {"id": "bad", "key": "k2", "status": "refused", "message": "The file is </script> empty", "where": "x",
                "hint": "Mend it.", "figures": {}},
    }  # fmt: skip
    for name, mark in marks.items():
        store.write(f"items/{name}/item.json", json.dumps(mark).encode())
        store.write(f"items/{name}/seconds.json", json.dumps({"seconds": 12.5, "peak_mb": 600.0}).encode())
    return Plan("/fleets/night.yaml", items), store


def test_a_row_an_item_in_the_manifest_s_order(fleet: tuple[Plan, Store]) -> None:
    rows = rows_of(*fleet)
    assert [(row["id"], row["status"], row["code"]) for row in rows] == [
        ("good", "short", 1), ("bad", "refused", 2), ("later", "absent", 2),
    ]  # fmt: skip
    assert all(list(row) == list(COLUMNS) for row in rows)
    assert rows[0]["seconds"] == 12.5
    assert rows[1]["findings"] == []
    table = list(csv.DictReader(io.StringIO(as_csv(rows).decode())))
    assert table[0]["findings"] == "ALN003 MEC027"
    assert table[1]["message"] == "The file is </script> empty"


def test_parquet_says_the_same_and_is_the_same_again(fleet: tuple[Plan, Store]) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    assert has_parquet()
    rows = rows_of(*fleet)
    content = as_parquet(COLUMNS, rows)
    assert content == as_parquet(COLUMNS, rows)
    back = parquet.read_table(io.BytesIO(content)).to_pylist()
    assert back == rows


def test_duckdb_reads_the_table(fleet: tuple[Plan, Store], tmp_path: Path) -> None:
    duckdb = pytest.importorskip("duckdb")
    pytest.importorskip("pyarrow")
    collected(*fleet)
    query = (
        f"SELECT id, worst_error_percent FROM '{tmp_path}/out/fleet.parquet' WHERE list_contains(findings, 'ALN003')"
    )
    assert duckdb.sql(query).fetchall() == [("good", 0.25)]


def test_the_page_says_nothing_that_differs_and_cannot_be_broken_out_of(fleet: tuple[Plan, Store]) -> None:
    plan, store = fleet
    collected(plan, store)
    page = (store.read("index.html") or b"").decode()
    assert "</script> empty" not in page
    assert "\\u003c/script> empty" in page
    assert "<title>night – yellowiron fleet</title>" in page
    assert "12.5" not in page
    assert (store.read("seconds.js") or b"").decode() == "const SECONDS = [12.5,12.5,null];\n"
    assert '"report":"items/good/machine/report.html"' in page
    for loaded in ("http://", "https://", "@import", "url("):
        assert loaded not in page


def test_without_pyarrow_there_is_a_hint(fleet: tuple[Plan, Store], monkeypatch: pytest.MonkeyPatch) -> None:
    import builtins

    real = builtins.__import__

    def without(name: str, *rest: Any, **more: Any) -> Any:
        if name.split(".")[0] == "pyarrow":
            raise ImportError(name)
        return real(name, *rest, **more)

    monkeypatch.setattr(builtins, "__import__", without)
    _, parquet = collected(*fleet)
    assert not parquet
    assert fleet[1].read("fleet.parquet") is None
    assert fleet[1].read("fleet.csv")
