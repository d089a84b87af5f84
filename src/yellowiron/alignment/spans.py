"""Which of many intervals reach a given one, without asking all of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from yellowiron.model.geometry import Floats

COMMON = 0.95
"""This share of the intervals is not long."""


class Spans:
    """Intervals [low, high], (n,) each, sorted once. Few of them are long: all others that reach a place begin not far
    before it."""

    def __init__(self, low: Floats, high: Floats) -> None:
        width = high - low
        self._width = float(np.quantile(width, COMMON)) if len(width) else 0.0
        self._long = np.flatnonzero(width > self._width)
        short = np.flatnonzero(width <= self._width)
        self._order = short[np.argsort(low[short], kind="stable")]
        self._starts = low[self._order]

    def reaching(self, low: float, high: float) -> NDArray[np.intp]:
        """The numbers of the intervals that reach [low, high], and of some others, in no particular order."""
        slack = 1e-9 + 1e-3 * self._width
        first, last = np.searchsorted(self._starts, (low - self._width - slack, high + slack))
        return np.concatenate([self._long, self._order[first:last]])
