"""Intervals that reach a place, against asking all of them."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from yellowiron.alignment.spans import Spans


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 10_000), st.integers(0, 60))
def test_no_interval_that_reaches_is_left_out(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    low = rng.random(count)
    high = low + rng.exponential(0.05, count)
    spans = Spans(low, high)
    start = float(rng.random())
    end = start + 0.1
    found = spans.reaching(start, end)
    assert len(set(found.tolist())) == len(found)
    assert set(np.flatnonzero((low <= end) & (high >= start)).tolist()) <= set(found.tolist())


def test_few_others_are_named() -> None:
    low = np.arange(1000.0)
    assert len(Spans(low, low + 1.5).reaching(500.0, 501.0)) < 10
