"""The sheet in the page: its pages as pictures, a box around every value, and a piece of the page beside each."""

from __future__ import annotations

import base64
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from yellowiron.model.specification import SheetPage

_PIECE = (250.0, 26.0)
"""Points of the piece of a page around a value: its width, and its least height."""
_AROUND = 7.0
"""Points above and below a box."""
_PIXELS = 1.2
"""A point of a piece."""


Box = tuple[float, ...]


def sheet_pages(pages: Sequence[SheetPage], values: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """The pages for the template, each with its boxes; one box for all values that were read from the same words.
    `values`: the rows of the page's table, in order."""
    rows = []
    for number, page in enumerate(pages, start=1):
        read: dict[Box, list[tuple[int, str, str]]] = {}
        for place, entry in enumerate(values, start=1):
            for box, kind in _boxes(entry, page):
                read.setdefault(box, []).append((place, str(entry["name"]), kind))
        boxes = [
            {
                "id": _id(number, box),
                "back": f"value-{said[0][0]}",
                "kind": said[0][2],
                "name": ", ".join(dict.fromkeys(name for _, name, _ in said)),
                **_rectangle(box),
            }
            for box, said in sorted(read.items(), key=lambda item: (item[0][1], item[0][0]))
        ]
        picture = "data:image/webp;base64," + base64.b64encode(page.picture).decode("ascii")
        rows.append({"id": f"sheet-{number}", "title": f"Page {page.page} of {page.file}", "picture": picture,
                     "width": page.size[0], "height": page.size[1], "boxes": boxes})  # fmt: skip
    return rows


def pieces(pages: Sequence[SheetPage], entry: Mapping[str, Any]) -> list[dict[str, Any]]:
    """What a value's row shows of the sheet: the piece of a page that it was read from, or each that it may be from."""
    return [
        {"sheet": f"sheet-{number}", "to": _id(number, box), "kind": kind, "page": page.page,
         "box": _rectangle(box), **_piece(box, page.size)}
        for number, page in enumerate(pages, start=1)
        for box, kind in dict(_boxes(entry, page)).items()
    ]  # fmt: skip


def _boxes(entry: Mapping[str, Any], page: SheetPage) -> Iterator[tuple[Box, str]]:
    """Boxes on a page, and their kind, of what a value's row says."""
    kind = "example" if entry["example"] and entry["status"] == "ok" else str(entry["status"])
    for said in entry["candidates"] if entry["status"] == "conflict" else [entry]:
        if said["box"] is not None and (said["file"], said["page"]) == (page.file, page.page):
            yield tuple(said["box"]), kind


def _id(number: int, box: Box) -> str:
    return f"box-{number}-" + "-".join(f"{v:.0f}" for v in box)


def _rectangle(box: Box) -> dict[str, float]:
    x0, top, x1, bottom = box
    return {"x": round(x0 - 2, 1), "y": round(top - 2, 1), "w": round(x1 - x0 + 4, 1), "h": round(bottom - top + 4, 1)}


def _piece(box: Box, size: tuple[float, float]) -> dict[str, Any]:
    """Around a box, within its page; more of what stands before it, which says what it is."""
    x0, top, x1, bottom = box
    wide = min(max(_PIECE[0], x1 - x0 + 2 * _AROUND), size[0])
    high = min(max(_PIECE[1], bottom - top + 2 * _AROUND), size[1])
    left = min(max(x1 + 2 * _AROUND - wide, 0.0), size[0] - wide)
    above = min(max(0.5 * (top + bottom - high), 0.0), size[1] - high)
    view = " ".join(f"{v:.1f}" for v in (left, above, wide, high))
    return {"view": view, "across": round(_PIXELS * wide), "down": round(_PIXELS * high)}
