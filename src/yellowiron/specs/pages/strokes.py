"""A page's rules and filled bars: the straight, level parts of its drawing."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

Box = tuple[float, float, float, float]
"""x0, top, x1, bottom: points, origin at the page's top left, y down."""
Place = Callable[[float, float], tuple[float, float]]
"""PDF user space → points from the top left of the page as shown."""

SNAP = 3.0
"""Points within which the ends and edges of rules and fills are at one place: pdfplumber's own tolerance for them."""
_THIN = 2.5
"""A filled rectangle thinner than this is a rule."""
_LETTER = (2.0, 20.0)
"""Points that a letter drawn as an outline is high at least and at most."""
_WIDEST = 1.6
"""Of such a letter, in its height."""
_RUN = 4
"""Letters side by side that are a word: fewer are marks of a drawing."""


@dataclass(frozen=True)
class DrawnRule:
    """A straight rule, horizontal (`top == bottom`) or vertical (`x0 == x1`)."""

    x0: float
    top: float
    x1: float
    bottom: float

    @property
    def horizontal(self) -> bool:
        """True for a horizontal rule."""
        return self.top == self.bottom


def strokes_of(page: Any, place: Place, unit: float) -> tuple[list[DrawnRule], list[Box], int, int]:
    """Straight rules, filled bars (at least as high as a line of text), the number of images, and that of letters
    drawn as outlines: small fills side by side. `unit`: so many points are one of the page's type."""
    import pypdfium2.raw as pdfium

    rules: list[DrawnRule] = []
    bars: list[Box] = []
    letters: list[Box] = []
    images = 0
    for item in page.get_objects(filter=(pdfium.FPDF_PAGEOBJ_PATH, pdfium.FPDF_PAGEOBJ_IMAGE)):
        if item.type == pdfium.FPDF_PAGEOBJ_IMAGE:
            images += 1
            continue
        mode, stroked = ctypes.c_int(), ctypes.c_int()
        pdfium.FPDFPath_GetDrawMode(item.raw, mode, stroked)
        if not (mode.value or stroked.value):
            continue
        points = _polylines(item, straight=not stroked.value)
        if mode.value and not stroked.value:
            left, low, right, high = item.get_bounds()
            box = _extent([place(left, low), place(right, high)])
            tall = box[3] - box[1]
            if _LETTER[0] * unit < tall < _LETTER[1] * unit and 0.3 < box[2] - box[0] < _WIDEST * tall:
                letters.append(box)
        for line in points:
            placed = [place(x, y) for x, y in line]
            box = _extent(placed)
            if mode.value and _is_rectangle(placed, unit):
                if min(box[2] - box[0], box[3] - box[1]) < _THIN * unit:
                    rules.append(_as_rule(box))
                    continue
                if box[3] - box[1] >= 6 * unit:
                    bars.append(box)
            if stroked.value:
                rules.extend(_edges(placed, unit))
    return rules, bars, images, _in_words(letters)


def _in_words(letters: list[Box]) -> int:
    """How many small fills stand side by side, as letters do: at one foot, closer than they are high."""
    rows: dict[int, list[Box]] = {}
    for box in letters:
        rows.setdefault(round(box[3]), []).append(box)
    count = 0
    for row in rows.values():
        run = 0
        for last, box in pairwise([*sorted(row), (float("inf"), 0.0, 0.0, 0.0)]):
            run += 1
            if not -0.3 < (box[0] - last[2]) / (last[3] - last[1]) < 1.0:
                count += run if run >= _RUN else 0
                run = 0
    return count


def _polylines(item: Any, *, straight: bool) -> list[list[tuple[float, float]]]:
    """The straight parts of a path in page space (containers' matrices applied); `straight`: none of one that has
    curves, as letters drawn as outlines have."""
    import pypdfium2.raw as pdfium

    matrix = item.get_matrix()
    container = getattr(item, "container", None)
    while container is not None:
        matrix = matrix.multiply(container.get_matrix())
        container = getattr(container, "container", None)
    a, b, c, d, e, f = matrix.get()
    lines: list[list[tuple[float, float]]] = []
    x, y = ctypes.c_float(), ctypes.c_float()
    for index in range(min(pdfium.FPDFPath_CountSegments(item.raw), 20000)):
        segment = pdfium.FPDFPath_GetPathSegment(item.raw, index)
        kind = pdfium.FPDFPathSegment_GetType(segment)
        if straight and kind == pdfium.FPDF_SEGMENT_BEZIERTO:
            return []
        pdfium.FPDFPathSegment_GetPoint(segment, x, y)
        point = (a * x.value + c * y.value + e, b * x.value + d * y.value + f)
        if kind == pdfium.FPDF_SEGMENT_MOVETO or not lines:
            lines.append([point])
        elif kind == pdfium.FPDF_SEGMENT_LINETO:
            lines[-1].append(point)
        else:  # a curve ends the straight part
            lines.append([point])
        if pdfium.FPDFPathSegment_GetClose(segment) and len(lines[-1]) > 2:
            lines[-1].append(lines[-1][0])
    return [line for line in lines if len(line) > 1]


def _extent(points: list[tuple[float, float]]) -> Box:
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return (min(xs), min(ys), max(xs), max(ys))


def _is_rectangle(points: list[tuple[float, float]], unit: float) -> bool:
    if not 4 <= len(points) <= 6:
        return False
    x0, top, x1, bottom = _extent(points)
    return all(
        min(abs(x - x0), abs(x - x1)) < 0.1 * unit and min(abs(y - top), abs(y - bottom)) < 0.1 * unit
        for x, y in points
    )


def _as_rule(box: Box) -> DrawnRule:
    x0, top, x1, bottom = box
    if x1 - x0 >= bottom - top:
        middle = (top + bottom) / 2
        return DrawnRule(x0, middle, x1, middle)
    middle = (x0 + x1) / 2
    return DrawnRule(middle, top, middle, bottom)


def _edges(points: list[tuple[float, float]], unit: float) -> Iterator[DrawnRule]:
    for (xa, ya), (xb, yb) in pairwise(points):
        if abs(ya - yb) < 0.5 * unit and abs(xa - xb) > 3 * unit:
            y = (ya + yb) / 2
            yield DrawnRule(min(xa, xb), y, max(xa, xb), y)
        elif abs(xa - xb) < 0.5 * unit and abs(ya - yb) > 3 * unit:
            x = (xa + xb) / 2
            yield DrawnRule(x, min(ya, yb), x, max(ya, yb))
