"""PDFs that are made to break a reader: one clear sentence in bounded time, or the truth."""

from __future__ import annotations

import sys
import time
import zlib
from pathlib import Path

import pytest
from PIL import Image
from specs_layouts import canvas, leaders, put, template, wanted

from yellowiron.model.errors import SheetError
from yellowiron.model.specification import Evidence, Specification, Specifications
from yellowiron.specs import draw_evidence, extract
from yellowiron.specs.extraction import read

ASKED = template(wanted("Wheelbase", "length"), wanted("Operating Weight", "mass"))
ROWS = [("Wheelbase", "3450 mm"), ("Operating weight", "25 510 kg")]


@pytest.fixture(autouse=True)
def _no_text_recognition(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("yellowiron.specs.ocr.programs", lambda: ())


def pdf(path: Path, *objects: bytes) -> Path:
    """A PDF of these objects, the first its catalogue."""
    data, places = b"%PDF-1.7\n", []
    for number, content in enumerate(objects, 1):
        places.append(len(data))
        data += b"%d 0 obj\n%s\nendobj\n" % (number, content)
    table = b"".join(b"%010d 00000 n \n" % place for place in places)
    head = b"xref\n0 %d\n0000000000 65535 f \n" % (len(objects) + 1)
    tail = b"trailer\n<</Size %d/Root 1 0 R>>\nstartxref\n%d\n%%%%EOF\n" % (len(objects) + 1, len(data))
    path.write_bytes(data + head + table + tail)
    return path


def stream(content: bytes, keys: bytes = b"") -> bytes:
    return b"<<%s/Length %d>>stream\n%s\nendstream" % (keys, len(content), content)


def page(path: Path, content: bytes, *more: bytes, box: bytes = b"0 0 595 842") -> Path:
    """One page with this content stream (object 4) and further objects, of which X is the fifth."""
    return pdf(
        path,
        b"<</Type/Catalog/Pages 2 0 R>>",
        b"<</Type/Pages/Kids[3 0 R]/Count 1>>",
        b"<</Type/Page/Parent 2 0 R/MediaBox[%s]/Contents 4 0 R/Resources<</XObject<</X 5 0 R>>>>>>" % box,
        content,
        *more,
    )


def form(number: int, content: bytes) -> bytes:
    """A form that can draw the object of this number as X."""
    return stream(content, b"/Type/XObject/Subtype/Form/BBox[0 0 595 842]/Resources<</XObject<</X %d 0 R>>>>" % number)


def test_a_broken_table_of_objects_is_mended(tmp_path: Path) -> None:
    path = tmp_path / "xref.pdf"
    c = canvas(path)
    leaders(c, 36, 780, 300, ROWS)
    c.save()
    data = path.read_bytes()
    path.write_bytes(data[: data.rindex(b"startxref")] + b"startxref\n12345\n%%EOF\n")
    assert extract(ASKED, [path]).number("Wheelbase") == 3.45


def test_a_page_tree_that_bites_its_tail_is_damaged(tmp_path: Path) -> None:
    path = pdf(tmp_path / "loop.pdf", b"<</Type/Catalog/Pages 2 0 R>>", b"<</Type/Pages/Kids[2 0 R]/Count 5>>")
    with pytest.raises(SheetError, match="the file is damaged"):
        read(path)


def test_ten_thousand_pages_are_refused_at_once(tmp_path: Path) -> None:
    kids = b" ".join(b"%d 0 R" % (n + 3) for n in range(10_000))
    leaf = b"<</Type/Page/Parent 2 0 R/MediaBox[0 0 595 842]>>"
    path = pdf(
        tmp_path / "book.pdf",
        b"<</Type/Catalog/Pages 2 0 R>>",
        b"<</Type/Pages/Kids[%s]/Count 10000>>" % kids,
        *([leaf] * 10_000),
    )
    with pytest.raises(SheetError, match="10000 pages, more than 5000"):
        read(path)


@pytest.mark.parametrize("depth", [300])
def test_forms_in_forms_and_arrays_in_arrays_end(tmp_path: Path, depth: int) -> None:
    forms = [form(n + 6, b"/X Do") for n in range(depth)]
    assert read(page(tmp_path / "forms.pdf", stream(b"/X Do"), *forms, form(5, b"0 0 m 9 9 l S"))).statements == ()
    nested = stream(b"[" * 50_000 + b"]" * 50_000 + b" TJ")
    assert read(page(tmp_path / "arrays.pdf", nested)).statements == ()


@pytest.mark.parametrize("kind", ["laughs", "bomb"])
@pytest.mark.slow
def test_what_never_ends_is_stopped(tmp_path: Path, kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Forms that draw the next one twice, forty deep; a stream of megabytes that unfolds to gigabytes."""
    monkeypatch.setattr(sys.modules["yellowiron.specs.extraction"], "TIMEOUT_S", 3.0)
    if kind == "laughs":
        forms = [form(n + 6, b"/X Do /X Do") for n in range(40)]
        path = page(tmp_path / "laughs.pdf", stream(b"/X Do"), *forms, form(5, b"0 0 m 9 9 l S"))
    else:
        unfolding = zlib.compressobj(9)
        parts = [unfolding.compress(b"0 0 m 1 1 l S\n" * 100_000) for _ in range(100)]
        path = page(
            tmp_path / "bomb.pdf", stream(b"".join([*parts, unfolding.flush()]), b"/Filter/FlateDecode"), stream(b"")
        )
    begin = time.monotonic()
    with pytest.raises(SheetError) as caught:
        read(path)
    assert time.monotonic() - begin < 60.0
    assert "more than 3 s" in caught.value.message or "memory" in caught.value.message
    assert caught.value.hint


def test_a_page_as_large_as_a_field_is_drawn_small(tmp_path: Path) -> None:
    path = tmp_path / "field.pdf"
    c = canvas(path)
    c.setPageSize((14_000, 14_000))
    put(c, 100, 13_000, "Wheelbase 3450 mm", size=60)
    c.save()
    evidence = Evidence("field.pdf", 1, "Wheelbase 3450 mm", (100.0, 900.0, 700.0, 1000.0))
    found = Specifications({"Wheelbase": Specification("Wheelbase", 3.45, "m", "ok", evidence=evidence)})
    (drawn,) = draw_evidence([path], found, tmp_path / "seen")
    with Image.open(drawn) as picture:
        assert picture.width * picture.height < 20_000_000


def test_progress_is_told_page_by_page(tmp_path: Path) -> None:
    path = tmp_path / "manual.pdf"
    c = canvas(path)
    for number in range(1, 13):
        put(c, 36, 780, f"Wheelbase {3000 + number} mm")
        c.showPage()
    c.save()
    said: list[str] = []
    assert read(path, progress=said.append).pages == 12
    assert said == [f"Reading page {n} of 12 of manual.pdf" for n in range(1, 13)]
