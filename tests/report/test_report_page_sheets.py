"""The sheet in the page: where the boxes are, what leads where, and how many bytes it takes."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from yellowiron import specs
from yellowiron.model.specification import Candidate, Evidence, SheetPage, Specification, Specifications
from yellowiron.report import specification_entry
from yellowiron.report.html.sheets import pieces, sheet_pages
from yellowiron.specs import evidence_images

PAGES = (SheetPage("a.pdf", 2, (600.0, 800.0), b"one"), SheetPage("b.pdf", 2, (300.0, 200.0), b"two"))
LINE = (500.0, 100.0, 560.0, 108.0)


def entry(name: str, *places: tuple[str, tuple[float, ...] | None], status: Any = "ok") -> dict[str, Any]:
    seen = [Evidence(file, 2, "words", box) for file, box in places]  # type: ignore[arg-type]
    candidates = tuple(Candidate(float(n), "m", e) for n, e in enumerate(seen)) if status == "conflict" else ()
    return specification_entry(Specification(name, 1.0, "m", status, evidence=seen[0], candidates=candidates))


def test_values_of_the_same_words_share_a_box_and_the_page_leads_back_to_the_first() -> None:
    values = [entry("Axle", ("a.pdf", None)), entry("Bore", ("a.pdf", LINE)), entry("Stroke", ("a.pdf", LINE))]
    first, second = sheet_pages(PAGES, values)
    assert not second["boxes"]
    (box,) = first["boxes"]
    assert (box["back"], box["name"], box["kind"]) == ("value-2", "Bore, Stroke", "ok")
    assert [[piece["to"] for piece in pieces(PAGES, value)] for value in values] == [[], [box["id"]], [box["id"]]]


def test_a_conflict_shows_what_each_sheet_says_and_a_piece_stays_on_its_page() -> None:
    value = entry("Stroke", ("a.pdf", LINE), ("b.pdf", (0.0, 190.0, 40.0, 200.0)), status="conflict")
    found = pieces(PAGES, value)
    assert [(piece["sheet"], piece["kind"]) for piece in found] == [("sheet-1", "conflict"), ("sheet-2", "conflict")]
    for piece, page in zip(found, PAGES, strict=True):
        left, above, wide, high = map(float, piece["view"].split())
        assert left >= 0.0 and left + wide <= page.size[0] and above >= 0.0 and above + high <= page.size[1]
        box = piece["box"]
        assert left <= box["x"] + 2.0 and box["x"] + box["w"] - 2.0 <= left + wide


def test_pages_are_pictures_of_their_size_the_same_every_time_and_within_the_budget(
    example: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sheet = example / "specifications.pdf"
    found = Specifications(
        {name: Specification(name, 1.0, "m", "ok", evidence=Evidence(sheet.name, page, "", LINE))
         for name, page in (("one", 1), ("two", 2), ("three", 2))}
    )  # fmt: skip
    pages = specs.page_pictures([sheet], found)
    assert [page.page for page in pages] == [1, 2] and pages == specs.page_pictures([sheet], found)
    for page in pages:
        with Image.open(io.BytesIO(page.picture)) as picture:
            assert picture.width / page.size[0] == pytest.approx(picture.height / page.size[1], rel=0.01)
    assert sum(len(page.picture) for page in pages) <= evidence_images.MOST_BYTES
    monkeypatch.setattr(evidence_images, "MOST_BYTES", 30_000)
    assert sum(len(page.picture) for page in specs.page_pictures([sheet], found)) <= 30_000
    assert specs.page_pictures([], found) == ()
