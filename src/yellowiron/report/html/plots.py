"""Small line plots as SVG, in the page's own colours."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.report.words import MINUS

WIDTH, HEIGHT = 540, 190
_LEFT, _RIGHT, _TOP, _BOTTOM = 52, 14, 28, 26


@dataclass(frozen=True)
class Chart:
    """What curves are drawn on: values from `low` to `high`. `bar`: a limit drawn across; `ticks`: values to label
    (default: ends and middle); `moments`: times (seconds) marked by a faint upright line."""

    title: str
    unit: str
    low: float
    high: float
    bar: float | None = None
    bar_label: str = ""
    ticks: Sequence[float] = ()
    moments: Sequence[float] = ()


@dataclass(frozen=True, eq=False)
class Curve:
    """A curve over (n,) times: `number` picks its colour, `wanted` ones are dashed."""

    times: Floats
    values: Floats
    label: str = ""
    number: int = 0
    wanted: bool = False


def plot(curves: Sequence[Curve], chart: Chart) -> str:
    """Curves over time in seconds on a chart, as SVG."""
    low, high, title, bar = chart.low, chart.high, escape(chart.title), chart.bar
    end = max((float(curve.times[-1]) for curve in curves if len(curve.times)), default=1.0)
    span = high - low or 1.0

    def x(time: float) -> float:
        return _LEFT + (WIDTH - _LEFT - _RIGHT) * time / end

    def y(value: float) -> float:
        return HEIGHT - _BOTTOM - (HEIGHT - _TOP - _BOTTOM) * (min(max(value, low), high) - low) / span

    made = [f'<text class="title" x="0" y="14">{title}</text>']
    for value in chart.ticks or (low, 0.5 * (low + high), high):
        made.append(f'<line class="grid" x1="{_LEFT}" x2="{WIDTH - _RIGHT}" y1="{y(value):.1f}" y2="{y(value):.1f}"/>')
        label = f"{_number(value)}{chart.unit}"
        made.append(f'<text class="tick end" x="{_LEFT - 7}" y="{y(value) + 4:.1f}">{label}</text>')
    for time in _seconds(end):
        made.append(f'<text class="tick middle" x="{x(time):.1f}" y="{HEIGHT - 8}">{_number(time)} s</text>')
    for time in chart.moments:
        made.append(f'<line class="moment" x1="{x(time):.1f}" x2="{x(time):.1f}" y1="{_TOP}" y2="{HEIGHT - _BOTTOM}"/>')
    if bar is not None:
        made.append(f'<line class="bar" x1="{_LEFT}" x2="{WIDTH - _RIGHT}" y1="{y(bar):.1f}" y2="{y(bar):.1f}"/>')
        label = escape(chart.bar_label)
        made.append(f'<text class="tick bar end" x="{WIDTH - _RIGHT}" y="{y(bar) - 5:.1f}">{label}</text>')
    for curve in curves:
        points = " ".join(f"{x(t):.1f},{y(v):.1f}" for t, v in zip(curve.times, curve.values, strict=True))
        kind = f"series s{curve.number % 6}{' wanted' if curve.wanted else ''}"
        made.append(f'<polyline class="{kind}" points="{points}"><title>{escape(curve.label)}</title></polyline>')
    head = f'<svg class="plot" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{title}">'
    return head + "".join(made) + "</svg>"


def _number(value: float) -> str:
    return f"{value:.4g}".replace("-", MINUS)


def _seconds(end: float) -> list[float]:
    """Round times from 0 on, four to seven of them."""
    step = 10.0 ** math.floor(math.log10(max(end, 1e-9)))
    for share in (5.0, 2.0, 1.0, 0.5, 0.2):
        if end / (share * step) >= 3.5:
            return [float(t) for t in np.arange(0.0, end + 1e-9, share * step)]
    return [0.0, end]
