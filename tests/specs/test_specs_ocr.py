"""Pages without a text layer through tesseract: through a stand-in that speaks its TSV, and through the program itself
where it is installed."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import pypdfium2
import pytest
from reportlab.lib.utils import ImageReader
from reportlab.pdfbase.pdfmetrics import stringWidth
from specs_layouts import canvas, put, template, wanted

from yellowiron.model.specification import Specification
from yellowiron.specs import draw_evidence, extract
from yellowiron.specs.extraction import read

ASKED = template(wanted("Wheelbase", "length"), wanted("Operating Weight", "mass"), wanted("Tread", "length"))
ROWS = [("Wheelbase", "3450 mm"), ("Operating weight", "25 510 kg")]
HEAD = "level\tpage_num\tblock_num\tpar_num\tline_num\tword_num\tleft\ttop\twidth\theight\tconf\ttext"


def typeset(path: Path, rows: list[tuple[str, str]]) -> Path:
    c = canvas(path)
    for index, (label, value) in enumerate(rows):
        put(c, 72, 700 - 30 * index, label, size=12)
        put(c, 300, 700 - 30 * index, value, size=12)
    c.save()
    return path


def pictured(path: Path, rows: list[tuple[str, str]], *, text: list[tuple[str, str]] = ()) -> Path:  # type: ignore[assignment]
    """The rows as a picture of a page; then a page with a text layer, if `text` is given."""
    drawn = typeset(path.with_name("drawn.pdf"), rows)
    page = pypdfium2.PdfDocument(drawn)[0]
    c = canvas(path)
    c.drawImage(ImageReader(page.render(scale=200 / 72, grayscale=True).to_pil()), 0, 0, *page.get_size())
    c.showPage()
    for index, (label, value) in enumerate(text):
        put(c, 72, 700 - 30 * index, label, size=12)
        put(c, 300, 700 - 30 * index, value, size=12)
    c.save()
    return path


def words(rows: list[tuple[str, str]], scale: float) -> list[str]:
    """What tesseract prints of `typeset` rows, in pixels of a page of A4 at `scale` pixels a point."""
    lines = []
    for index, row in enumerate(rows):
        top = round((842 - 700 + 30 * index - 8.6) * scale)
        for block, (text, left) in enumerate(zip(row, (72, 300), strict=True)):
            x = float(left)
            for number, word in enumerate(text.split()):
                width = stringWidth(word, "Helvetica", 12)
                at = f"5\t1\t{2 * index + block + 1}\t1\t1\t{number + 1}"
                lines.append(
                    f"{at}\t{round(x * scale)}\t{top}\t{round(width * scale)}\t{round(8.6 * scale)}\t91.5\t{word}"
                )
                x += width + stringWidth(" ", "Helvetica", 12)
    return lines


@pytest.fixture(autouse=True)
def no_package(monkeypatch: pytest.MonkeyPatch) -> None:
    """As where rapidocr is not installed."""
    monkeypatch.setattr("yellowiron.specs.recognition.rapid.installed", lambda: False)


@pytest.fixture
def stand_in(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[list[str], int], None]:
    """Puts a `tesseract` on PATH that prints these lines of TSV and ends with this code."""

    def put_on_path(lines: list[str], code: int = 0) -> None:
        folder = tmp_path / "bin"
        folder.mkdir()
        program = folder / "tesseract"
        program.write_text(
            f"#!{sys.executable}\n"
            "import sys\n"
            "if '--list-langs' in sys.argv:\n"
            "    print('List of available languages (1):\\neng')\n"
            "else:\n"
            "    assert sys.stdin.buffer.read(8) == b'\\x89PNG\\r\\n\\x1a\\n'\n"
            "    assert sys.argv[1:] == ['stdin', 'stdout', '-l', 'eng', '--psm', '11', 'tsv'], sys.argv\n"
            f"    print({chr(10).join([HEAD, *lines])!r})\n"
            f"    sys.exit({code})\n"
        )
        program.chmod(0o755)
        monkeypatch.setenv("PATH", str(folder))

    return put_on_path


SCALE = 300 / 72


@pytest.mark.slow
def test_a_picture_is_read_for_review_with_its_box(tmp_path: Path, stand_in: Callable[..., None]) -> None:
    dirt = ["5\t1\t9\t1\t1\t1\t10\t10\t50\t50\t12.0\twu.", "5\t1\t9\t1\t1\t2\t0\t0\t0\t0\t-1\t "]
    stand_in([*words(ROWS, SCALE), *dirt])
    scan = pictured(tmp_path / "scan.pdf", ROWS)
    found = extract(ASKED, [scan])
    assert [(s.name, s.status) for s in found] == [
        ("Wheelbase", "review"), ("Operating Weight", "review"), ("Tread", "missing"),
    ]  # fmt: skip
    assert_read(found.values["Wheelbase"], 3.45)
    assert_read(found.values["Operating Weight"], 25510.0)
    assert found.number("Wheelbase") is None  # nothing relies on it
    (finding,) = found.findings
    assert (finding.code, finding.severity) == ("SPC005", "info") and "page 1" in finding.where
    (picture,) = draw_evidence([scan], found, tmp_path / "seen")
    assert picture.name == "scan-page-1.png"


def assert_read(one: Specification, value: float) -> None:
    assert one.value == pytest.approx(value, rel=1e-12) and one.confidence <= 0.5
    assert "tesseract" in one.reason and "--set" in one.hint
    assert one.evidence is not None and one.evidence.page == 1 and one.evidence.box is not None
    x0, top, x1, bottom = one.evidence.box
    assert 295 < x0 < x1 < 480 and 120 < top < bottom < 190


@pytest.mark.slow
def test_what_a_page_with_text_says_needs_no_picture(tmp_path: Path, stand_in: Callable[..., None]) -> None:
    stand_in(words([("Wheelbase", "3950 mm"), ("Tread", "2140 mm")], SCALE))
    sheet = pictured(tmp_path / "a.pdf", [("Wheelbase", "3950 mm"), ("Tread", "2140 mm")], text=ROWS)
    found = extract(ASKED, [sheet])
    assert [(s.status, s.value) for s in found] == [("ok", 3.45), ("ok", 25510.0), ("review", 2.14)]


def test_without_the_program_the_page_is_unreadable_and_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    found = extract(ASKED, [pictured(tmp_path / "scan.pdf", ROWS)])
    assert {s.status for s in found} == {"unreadable"}
    (finding,) = found.findings
    assert finding.code == "SPC001" and "tesseract" in finding.hint


def test_a_program_that_fails_leaves_the_page_unreadable_and_says_why(
    tmp_path: Path, stand_in: Callable[..., None]
) -> None:
    stand_in([], 1)
    found = extract(ASKED, [pictured(tmp_path / "scan.pdf", ROWS)])
    assert {s.status for s in found} == {"unreadable"}
    (finding,) = found.findings
    assert finding.code == "SPC001" and "Text recognition failed" in finding.message


@pytest.mark.slow
def test_a_picture_without_words_is_unreadable(tmp_path: Path, stand_in: Callable[..., None]) -> None:
    stand_in([])
    found = extract(ASKED, [pictured(tmp_path / "scan.pdf", ROWS)])
    assert {s.status for s in found} == {"unreadable"} and found.findings[0].code == "SPC001"


@pytest.mark.skipif(shutil.which("tesseract") is None, reason="the program tesseract is not installed")
def test_the_program_itself(tmp_path: Path) -> None:
    said: list[str] = []
    scan = pictured(tmp_path / "scan.pdf", ROWS)
    sheet = read(scan, progress=said.append)
    assert sheet.recognised == (1,) and sheet.silent == ()
    assert said == ["Reading page 1 of 1 of scan.pdf", "Recognising the text of page 1 of scan.pdf"]
    found = extract(ASKED, [scan])
    assert_read(found.values["Wheelbase"], 3.45)
    assert_read(found.values["Operating Weight"], 25510.0)
