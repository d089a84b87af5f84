"""Pictures of a sheet's pages with a box around every value that was read, for a person who checks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from yellowiron.model.errors import OutputError
from yellowiron.model.specification import Evidence, SheetPage, Specifications
from yellowiron.specs.reader import check_file, in_child, opened_pages

PICTURE_SCALE = 1.6
"""Pixels a point, less on a page that would be more than this many pixels:"""
_MOST_PIXELS = 12_000_000
PICTURE_MARGIN = 330
MOST_BYTES = 1_500_000
"""Of all pages in a report, which is no more than 5 MB."""
_SCALES = (1.6, 1.1, 0.75, 0.5, 0.3)
_COLORS = {"ok": (24, 128, 56), "example": (32, 96, 190), "review": (214, 118, 0), "conflict": (200, 30, 30)}
Mark = tuple[int, tuple[float, float, float, float], str, str]
"""Page, box in points, kind (a key of the colours), caption."""


def draw_evidence(sheets: Sequence[Path], specifications: Specifications, folder: Path) -> tuple[Path, ...]:
    """Writes a PNG of each page that gave evidence into `folder`, with a captioned box around each value.

    Green: `ok`; blue: an example value; orange: to review; red: one candidate of a conflict. Returns the paths written.
    `SheetError` for a PDF that cannot be read, `OutputError` for a folder that cannot be written.
    """
    folder = Path(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(
            f"{folder.name} cannot be made: {error.strerror or error}", where=str(folder), hint="Choose another folder."
        ) from error
    written: list[Path] = []
    for sheet in sheets:
        marks = _marks(specifications, Path(sheet).name)
        if not marks:
            continue
        check_file(Path(sheet))
        pages = in_child("evidence_images:draw_pages", Path(sheet), marks, folder.resolve())
        written.extend(folder / name for name in pages)
    return tuple(written)


def page_pictures(sheets: Sequence[Path], specifications: Specifications) -> tuple[SheetPage, ...]:
    """The pages that gave evidence, without boxes, for a page that draws these itself: all together no more than
    `MOST_BYTES`, the more there are the smaller. `SheetError` for a PDF that cannot be read."""
    wanted = [(Path(s), sorted({mark[0] for mark in _marks(specifications, Path(s).name)})) for s in sheets]
    count = sum(len(numbers) for _, numbers in wanted)
    found: list[SheetPage] = []
    for sheet, numbers in wanted:
        if numbers:
            found += in_child("evidence_images:bare_pages", sheet, numbers, MOST_BYTES // count)
    return tuple(found)


def bare_pages(sheet: Path, numbers: Sequence[int], most: int) -> list[SheetPage]:
    """Pages of one sheet (runs in the guarded child), each in about `most` bytes."""
    import io

    pages: list[SheetPage] = []
    for number, opened in opened_pages(sheet, numbers, "Drawing"):
        for scale in _SCALES:
            buffer = io.BytesIO()
            _drawn(opened, scale)[0].save(buffer, "WEBP", quality=60, method=2)
            if buffer.tell() <= most:
                break
        pages.append(SheetPage(sheet.name, number, opened.get_size(), buffer.getvalue()))
    return pages


def _drawn(page: Any, scale: float) -> tuple[Any, float]:
    """A page's picture, at so many pixels a point or fewer, and how many these are."""
    width, height = page.get_size()
    scale = min(scale, (_MOST_PIXELS / max(width * height, 1.0)) ** 0.5)
    return page.render(scale=scale).to_pil().convert("RGB"), scale


def _marks(specifications: Specifications, file: str) -> list[Mark]:
    marks: list[Mark] = []
    for specification in specifications:
        kind = "example" if specification.example and specification.status == "ok" else specification.status
        if specification.status == "conflict":
            shown: list[Evidence | None] = [c.evidence for c in specification.candidates]
        else:
            shown = [specification.evidence]
        for evidence in shown:
            if evidence is not None and evidence.box is not None and evidence.file == file and kind in _COLORS:
                marks.append((evidence.page, evidence.box, kind, specification.name))
    return marks


def draw_pages(sheet: Path, marks: Sequence[Mark], folder: Path) -> list[str]:
    """Draws the marked pages of one sheet (runs in the guarded child); the names of the files written."""
    from PIL import Image, ImageDraw

    names: list[str] = []
    for number, opened in opened_pages(sheet, sorted({mark[0] for mark in marks}), "Drawing"):
        page, scale = _drawn(opened, PICTURE_SCALE)
        image = Image.new("RGB", (page.width + 2 * PICTURE_MARGIN, page.height), (250, 250, 250))
        image.paste(page, (PICTURE_MARGIN, 0))
        _draw(ImageDraw.Draw(image, "RGBA"), page.width, scale, [m for m in marks if m[0] == number])
        name = f"{sheet.stem}-page-{number}.png"
        image.save(folder / name)
        names.append(name)
    return names


def _draw(draw: Any, width: int, scale: float, marks: Sequence[Mark]) -> None:
    """A box around each value; its names in the nearer margin at its height, below each other, with a line between
    that runs under the row's words."""
    from PIL import ImageFont

    font = ImageFont.load_default(size=11)
    captions: dict[tuple[tuple[float, float, float, float], str], list[str]] = {}
    for _, box, kind, name in marks:
        captions.setdefault((box, kind), []).append(name)
    free = {True: 6.0, False: 6.0}
    for (box, kind), names in sorted(captions.items(), key=lambda item: (item[0][0][1], item[0][0][0])):
        color = _COLORS[kind]
        x0, top, x1, bottom = (v * scale for v in box)
        left = x0 + x1 < width
        x0, top, x1, bottom = x0 + PICTURE_MARGIN - 3, top - 3, x1 + PICTURE_MARGIN + 3, bottom + 3
        draw.rectangle((x0, top, x1, bottom), outline=(*color, 255), fill=(*color, 24), width=2)
        words = ", ".join(names)
        y = max((top + bottom) / 2 - 7, free[left])
        turn, out, end = (PICTURE_MARGIN, -16, x0) if left else (PICTURE_MARGIN + width, 16, x1)
        draw.line((end, bottom - 1, turn, bottom - 1, turn + out, y + 7), fill=(*color, 110), width=1)
        at = turn + out - 4 - draw.textlength(words, font=font) if left else turn + out + 4
        draw.text((at, y), words, fill=(*color, 255), font=font)
        free[left] = y + 15
