"""Sheets that cannot be read, or hardly: one clear sentence, never a wrong number, never a crash."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from PIL import Image
from reportlab.lib.pdfencrypt import StandardEncryption
from reportlab.lib.utils import ImageReader
from reportlab.pdfgen.canvas import Canvas
from specs_layouts import canvas, leaders, put, ruled, template, wanted

from yellowiron.model.errors import SheetError, YellowironError
from yellowiron.specs import draw_evidence, extract, merge
from yellowiron.specs.extraction import read

ASKED = template(wanted("Wheelbase", "length"), wanted("Operating Weight", "mass"))
ROWS = [("Wheelbase", "3450 mm"), ("Operating weight", "25 510 kg")]


@pytest.fixture(autouse=True)
def _no_text_recognition(monkeypatch: pytest.MonkeyPatch) -> None:
    """As on a machine without tesseract; with it: `test_specs_ocr.py`."""
    monkeypatch.setattr("yellowiron.specs.ocr.programs", lambda: ())


def good(path: Path) -> Path:
    c = canvas(path)
    leaders(c, 36, 780, 300, ROWS)
    c.save()
    return path


def scanned(path: Path, pages: int = 2) -> Path:
    picture = Image.new("L", (60, 80), 200)
    c = canvas(path)
    for _ in range(pages):
        c.drawImage(ImageReader(picture), 0, 0, 595, 842)
        c.showPage()
    c.save()
    return path


def test_a_good_sheet(tmp_path: Path) -> None:
    found = extract(ASKED, [good(tmp_path / "a.pdf")])
    assert found.number("Wheelbase") == 3.45 and found.number("Operating Weight") == 25510.0
    assert found.findings == ()


def test_no_sheet_is_all_missing() -> None:
    assert {s.status for s in extract(ASKED, [])} == {"missing"}


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (None, "sheet.pdf cannot be read: No such file or directory"),
        (b"", "sheet.pdf is empty"),
        (b"PK\x03\x04 this is a zip", "sheet.pdf is not a PDF"),
        (b"%PDF-1.7\nnothing more", "sheet.pdf is cut short: its end is missing"),
        (b"%PDF-1.7\nnonsense\n%%EOF\n", "sheet.pdf is a damaged PDF"),
    ],
)
def test_what_is_no_sheet_says_so(tmp_path: Path, content: bytes | None, sentence: str) -> None:
    path = tmp_path / "sheet.pdf"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(SheetError) as caught:
        extract(ASKED, [path])
    assert caught.value.message == sentence
    assert str(path) in caught.value.where and caught.value.hint


def test_a_folder_is_no_sheet(tmp_path: Path) -> None:
    with pytest.raises(SheetError, match=f"{tmp_path.name} is a folder"):
        extract(ASKED, [tmp_path])


def test_the_folder_one_is_in_has_a_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SheetError, match=f"^{tmp_path.name} is a folder"):
        extract(ASKED, [Path()])


NO_PAGES = (
    b"%PDF-1.4\n1 0 obj\n<< /Type /Catalog /Pages 2 0 R >>\nendobj\n"
    b"2 0 obj\n<< /Type /Pages /Kids [] /Count 0 >>\nendobj\n"
    b"xref\n0 3\n0000000000 65535 f \n0000000009 00000 n \n0000000058 00000 n \n"
    b"trailer\n<< /Size 3 /Root 1 0 R >>\nstartxref\n110\n%%EOF\n"
)


def test_a_sheet_without_pages_says_so(tmp_path: Path) -> None:
    (tmp_path / "sheet.pdf").write_bytes(NO_PAGES)
    with pytest.raises(SheetError, match=r"^sheet\.pdf has no pages"):
        extract(ASKED, [tmp_path / "sheet.pdf"])


def test_a_truncated_sheet_says_so(tmp_path: Path) -> None:
    whole = good(tmp_path / "whole.pdf").read_bytes()
    path = tmp_path / "sheet.pdf"
    for share in (0.3, 0.6, 0.95):
        path.write_bytes(whole[: int(share * len(whole))])
        with pytest.raises(SheetError, match=r"sheet\.pdf is cut short"):
            extract(ASKED, [path])


def test_an_encrypted_sheet_says_so(tmp_path: Path) -> None:
    path = tmp_path / "sheet.pdf"
    c = Canvas(str(path), encrypt=StandardEncryption("secret", canPrint=0))
    put(c, 36, 780, "Wheelbase 3450 mm")
    c.save()
    with pytest.raises(SheetError, match=r"sheet\.pdf is encrypted and asks for a password"):
        extract(ASKED, [path])


@pytest.mark.slow
def test_flipped_bytes_give_the_truth_or_a_sentence(tmp_path: Path) -> None:
    whole = bytearray(good(tmp_path / "whole.pdf").read_bytes())
    for position in range(40, len(whole), len(whole) // 12):
        broken = bytearray(whole)
        broken[position : position + 8] = bytes((b ^ 0x55) for b in broken[position : position + 8])
        path = tmp_path / "broken.pdf"
        path.write_bytes(bytes(broken))
        try:
            found = extract(ASKED, [path])
        except YellowironError as error:
            assert error.hint and error.where
        else:
            assert found.number("Wheelbase") in (3.45, None)
            assert found.number("Operating Weight") in (25510.0, None)


def test_a_sheet_without_text_is_unreadable_not_missing(tmp_path: Path) -> None:
    found = extract(ASKED, [scanned(tmp_path / "scan.pdf", pages=3)])
    assert {s.status for s in found} == {"unreadable"}
    (finding,) = found.findings
    assert (finding.code, finding.severity) == ("SPC001", "warning")
    assert "scan.pdf" in finding.where and "pages 1–3" in finding.where and finding.hint
    assert all('--set "' in s.hint for s in found)


def test_what_another_sheet_says_is_not_unreadable(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 36, 780, "Wheelbase 3450 mm")
    c.save()
    found = extract(ASKED, [tmp_path / "a.pdf", scanned(tmp_path / "scan.pdf")])
    assert [s.status for s in found] == ["ok", "unreadable"]


def test_a_page_of_pictures_in_a_sheet_is_only_mentioned(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    c.drawImage(ImageReader(Image.new("L", (60, 80), 200)), 0, 0, 595, 842)
    c.showPage()
    leaders(c, 36, 780, 300, ROWS[:1])
    c.save()
    found = extract(ASKED, [tmp_path / "a.pdf"])
    assert [s.status for s in found] == ["ok", "missing"]
    assert [(f.severity, f.where) for f in found.findings] == [("info", "a.pdf, page 1")]
    evidence = found.values["Wheelbase"].evidence
    assert evidence is not None and evidence.page == 2


def test_two_sheets_that_differ_are_a_conflict(tmp_path: Path) -> None:
    c = canvas(tmp_path / "b.pdf")
    put(c, 36, 780, "Wheelbase 3350 mm")
    c.save()
    found = extract(ASKED, [good(tmp_path / "a.pdf"), tmp_path / "b.pdf"])
    wheelbase = found.values["Wheelbase"]
    assert wheelbase.status == "conflict"
    assert [(c.value, c.evidence.file) for c in wheelbase.candidates] == [(3.45, "a.pdf"), (3.35, "b.pdf")]
    assert found.number("Operating Weight") == 25510.0


@pytest.mark.parametrize("turns", [90, 180, 270])
def test_turned_pages_read_as_shown(tmp_path: Path, turns: int) -> None:
    path = tmp_path / "turned.pdf"
    c = canvas(path)
    c.setPageRotation(turns)
    # drawn so that it stands upright once the page is turned
    c.translate({90: 595, 180: 595, 270: 0}[turns], {90: 0, 180: 842, 270: 595}[turns])
    c.rotate(turns)
    ruled(c, 36, 500, (300,), [("Wheelbase", "3450 mm"), ("Operating weight", "25 510 kg")])
    c.save()
    found = extract(ASKED, [path])
    assert found.number("Wheelbase") == 3.45 and found.number("Operating Weight") == 25510.0
    evidence = found.values["Wheelbase"].evidence
    assert evidence is not None and evidence.box is not None and evidence.quote == "Wheelbase 3450 mm"
    assert 200 < evidence.box[0] < evidence.box[2] < 301


def test_a_moved_crop_box_moves_the_boxes(tmp_path: Path) -> None:
    path = tmp_path / "cropped.pdf"
    c = canvas(path)
    c.setCropBox((20, 100, 595, 842))
    leaders(c, 36, 780, 300, ROWS)
    c.save()
    evidence = extract(ASKED, [path]).values["Wheelbase"].evidence
    assert evidence is not None and evidence.box is not None
    assert evidence.box[2] == pytest.approx(336 - 20, abs=1) and evidence.box[3] == pytest.approx(842 - 780, abs=3)


def test_exponents_of_their_own_and_footnotes(tmp_path: Path) -> None:
    c = canvas(tmp_path / "a.pdf")
    put(c, 36, 780, "Bucket capacity")
    width = put(c, 200, 780, "4.2 m")
    put(c, 200 + width, 783, "3", size=5)
    put(c, 36, 766, "Wheelbase")
    width = put(c, 200, 766, "3450 mm")
    put(c, 200 + width, 769, "2)", size=5)
    put(c, 36, 752, "Tread")
    put(c, 200, 752, "2140 mm*")
    put(c, 36, 60, "* example value", size=6)
    c.save()
    asked = template(wanted("Bucket Capacity", "volume"), wanted("Wheelbase", "length"), wanted("Tread", "length"))
    found = extract(asked, [tmp_path / "a.pdf"])
    assert [(s.status, s.value, s.example) for s in found] == [
        ("ok", 4.2, False),
        ("ok", 3.45, False),
        ("ok", 2.14, True),
    ]


@pytest.mark.slow
def test_a_crowded_page_ends_in_time(tmp_path: Path) -> None:
    c = canvas(tmp_path / "crowd.pdf")
    for row in range(120):
        for column in range(40):
            put(c, 10 + 14 * column, 830 - 6.8 * row, f"{row}.{column}", size=4)
            c.rect(8 + 14 * column, 828 - 6.8 * row, 14, 6.8)
    c.save()
    assert {s.status for s in extract(ASKED, [tmp_path / "crowd.pdf"])} == {"missing"}


@pytest.mark.slow
def test_many_pages_are_read(tmp_path: Path) -> None:
    c = canvas(tmp_path / "book.pdf")
    for number in range(1001):
        c.drawString(72, 700, f"Operating weight {number} kg")
        c.showPage()
    c.save()
    sheet = read(tmp_path / "book.pdf")
    assert sheet.pages == 1001 and len(sheet.statements) == 1001


def test_nothing_is_drawn_without_evidence(tmp_path: Path) -> None:
    scan = scanned(tmp_path / "scan.pdf")
    assert draw_evidence([scan], extract(ASKED, [scan]), tmp_path / "seen") == ()
    (tmp_path / "file").write_text("")
    with pytest.raises(YellowironError, match="cannot be made"):
        draw_evidence([scan], merge(), tmp_path / "file")


def test_a_picture_of_text_with_hidden_text_is_read(tmp_path: Path) -> None:
    """A scan that went through text recognition: invisible text over a picture."""
    path = tmp_path / "ocr.pdf"
    buffer = io.BytesIO()
    Image.new("L", (60, 80), 230).save(buffer, "PNG")
    c = canvas(path)
    c.drawImage(ImageReader(io.BytesIO(buffer.getvalue())), 0, 0, 595, 842)
    text = c.beginText(36, 780)
    text.setTextRenderMode(3)
    text.setFont("Helvetica", 8)
    text.textLine("Wheelbase 3450 mm")
    c.drawText(text)
    c.save()
    assert extract(ASKED, [path]).number("Wheelbase") == 3.45
