"""Text recognition through `rapidocr-onnxruntime`, whose networks are in its wheel (Chinese, Japanese characters and
unaccented Latin). It finds lines and reads their letters; where its words end is often lost, and is read from the ink.
"""

from __future__ import annotations

import functools
import importlib.util
import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from yellowiron.specs.pages.words import Word
from yellowiron.specs.recognition.mending import mended, with_whole_units, without_leaders

_LONGEST_PX = 4000
"""Of a picture's longer side; the program would shrink it to 2000 by itself."""
_LEAST = 0.6
"""Confidence (of 1) below which a line without a digit is dirt."""
_SPACE_BEFORE_CAPITAL = 0.15
"""The same between a small letter and a capital."""
_INK = 0.35
"""Share of a line's contrast from which on a point is ink."""
_SPACE = 0.26
"""Gap between two letters, as a share of the height of a capital, from which on they are of two words."""
_MANY, _SPACED = 8, 1.8
"""Of so many gaps, those wider than so many times their median: letters may be set apart from each other."""
_CAP = 0.72
"""Height of a capital letter or digit as a share of the size of its font."""
_X_HEIGHT = 0.52
"""The same of a small letter such as x."""
_LOW = set("gjpqyQ,;()[]{}|/")
_SMALL = set("acegijmnopqrsuvwxyz")
_IN_NUMBERS = set("0123456789.,")


def installed() -> bool:
    """Whether the package is there."""
    return importlib.util.find_spec("rapidocr_onnxruntime") is not None


def words_on(picture: Image.Image, scale: float) -> list[Word]:
    """The words on a grey picture of `scale` pixels a point, in points from its top left."""
    grey = np.asarray(picture)
    found, _ = _program()(np.repeat(grey[:, :, None], 3, axis=2), use_cls=False, return_word_box=True)
    words: list[Word] = []
    for corners, _text, sure, boxes, letters, *_ in found or []:
        if float(sure) < _LEAST and not any(c.isdigit() for c in letters):
            continue
        xs, ys = [x for x, _ in corners], [y for _, y in corners]
        if max(ys) - min(ys) > 1.5 * (max(xs) - min(xs)) and len(letters) > 1:
            continue  # runs up or down the page
        box = (min(xs), min(ys), max(xs), max(ys))
        centres = [float(np.mean([x for x, _ in letter])) for letter in boxes]
        words += words_of_line(grey, box, list(zip(letters, centres, strict=False)), scale)
    return without_leaders(words)


def words_of_line(
    grey: NDArray[np.uint8], box: tuple[float, float, float, float], letters: Sequence[tuple[str, float]], scale: float
) -> list[Word]:
    """The words of one line of a grey picture. `box`: left, top, right, bottom of the line; `letters`: its characters
    and where their middles are; pixels. A word ends at a space, and where the ink has a gap as wide as one."""
    height, width = grey.shape
    left, top = max(0, int(box[0])), max(0, int(box[1]))
    right, bottom = min(width, int(box[2]) + 1), min(height, int(box[3]) + 1)
    part = grey[top:bottom, left:right].astype(float)
    read = [(c, x - left) for c, x in letters]
    if part.size == 0 or not read:
        return []
    ink = _ink(part)
    first, last = _letter_rows(ink, read)
    columns = np.flatnonzero(ink[first : last + 1].any(axis=0))
    if not len(columns):
        return []
    small = all(c in _SMALL for c, _ in letters if c.isalnum())
    capital = (last + 1 - first) * (_CAP / _X_HEIGHT if small else 1.0)
    gaps = [(int(a) + 1, int(b)) for a, b in itertools.pairwise(columns) if b - a > 1]
    apart_set = _SPACED * float(np.median([b - a for a, b in gaps])) if len(gaps) >= _MANY else 0.0
    runs: list[tuple[list[str], float, float]] = [([], float(columns[0]), float(columns[-1]) + 1)]
    spaced = False
    before: tuple[str, float] | None = None
    for letter, at in read:
        if letter.isspace():
            spaced = True
            continue
        if before is not None:
            wide = max((g for g in gaps if before[1] < (g[0] + g[1]) / 2 < at), key=lambda g: g[1] - g[0], default=None)
            least = (
                _SPACE_BEFORE_CAPITAL if len(runs[-1][0]) > 1 and before[0].islower() and letter.isupper() else _SPACE
            )
            apart = wide is not None and wide[1] - wide[0] >= max(least * capital, apart_set)
            if spaced or (apart and not (before[0] in _IN_NUMBERS and letter in _IN_NUMBERS)):
                end, start = wide or ((before[1] + at) / 2, (before[1] + at) / 2)
                text, x0, x1 = runs[-1]
                runs[-1] = (text, x0, float(end))
                runs.append(([], float(start), x1))
        runs[-1][0].append(letter)
        before, spaced = (letter, at), False
    baseline, size = (top + last + 1) / scale, capital / scale / _CAP
    return with_whole_units(
        [Word(mended("".join(text)), (left + x0) / scale, (left + x1) / scale, baseline, size) for text, x0, x1 in runs]
    )


def _ink(part: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which points of a line are of its letters, be they darker or lighter than what is behind them; level rules are
    none."""
    ground = float(np.median(part))
    away = np.abs(part - ground)
    ink: NDArray[np.bool_] = away > _INK * max(float(np.percentile(away, 99)), 1.0)
    ink[ink.mean(axis=1) > 0.9] = False
    return ink


def _letter_rows(ink: NDArray[np.bool_], letters: Sequence[tuple[str, float]]) -> tuple[int, int]:
    """The rows of the top and the foot of the letters that hang under no baseline; of all, if none is such."""
    steps = np.diff([at for _, at in letters]) if len(letters) > 1 else np.array([ink.shape[1]])
    half = max(1, int(0.45 * float(np.median(steps))))
    standing = np.zeros(ink.shape[1], bool)
    for letter, at in letters:
        if letter not in _LOW and letter.isalnum():
            standing[max(0, int(at) - half) : int(at) + half + 1] = True
    least = max(1, int(0.02 * standing.sum()))
    rows = np.flatnonzero(ink[:, standing].sum(axis=1) > least) if standing.any() else np.empty(0, int)
    rows = max(np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1), key=len)  # the lines above and below are others
    if len(rows) < 0.3 * len(ink):
        rows = np.flatnonzero(ink.any(axis=1))
    return (int(rows[0]), int(rows[-1])) if len(rows) else (0, len(ink) - 1)


@functools.cache
def _program() -> Any:
    from rapidocr_onnxruntime import RapidOCR

    return RapidOCR(intra_op_num_threads=1, inter_op_num_threads=1, max_side_len=_LONGEST_PX)
