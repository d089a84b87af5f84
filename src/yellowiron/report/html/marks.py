"""Numbered marks over a picture, as SVG: points of the machine where they are seen, with labels that keep apart."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np

from yellowiron.model.geometry import Floats
from yellowiron.report.html.pictures import Camera


@dataclass(frozen=True, eq=False)
class Mark:
    """A label at the first of `points` (n, 3), dots at all of them; `kind` is its CSS class (`hollow`: white)."""

    label: str
    title: str
    points: Floats
    kind: str = ""


def overlay(camera: Camera, picture: str, marks: Sequence[Mark], *, alt: str, under: str = "") -> Any:
    """The picture (a data URI) with the marks on it; `under` is SVG between the two, in pixels."""
    from markupsafe import Markup

    spots = [camera.project(np.asarray(mark.points, dtype=np.float64).reshape(-1, 3)) for mark in marks]
    labels = spread(np.array([points[0] for points in spots])) if spots else np.zeros((0, 2))
    made = [_mark(mark, points, label) for mark, points, label in zip(marks, spots, labels, strict=True)]
    return Markup(
        f'<svg class="marked" viewBox="0 0 {camera.width} {camera.height}" role="img" aria-label="{escape(alt)}">'
        f'<image href="{picture}" width="{camera.width}" height="{camera.height}"/>{under}{"".join(made)}</svg>'
    )


def _mark(mark: Mark, points: Floats, label: Floats) -> str:
    (ax, ay), (x, y) = points[0], label
    dots = "".join(f'<circle class="dot" cx="{px:.1f}" cy="{py:.1f}" r="3"/>' for px, py in points)
    wide = 10.0 + 3.5 * max(0, len(mark.label) - 2)
    return (
        f'<g class="mark {mark.kind}"><title>{escape(mark.title)}</title>'
        f'<line x1="{ax:.1f}" y1="{ay:.1f}" x2="{x:.1f}" y2="{y:.1f}"/>{dots}'
        f'<rect x="{x - wide:.1f}" y="{y - 10:.1f}" width="{2 * wide:.1f}" height="20" rx="10"/>'
        f'<text x="{x:.1f}" y="{y + 4:.1f}">{escape(mark.label)}</text></g>'
    )


def spread(pixels: Floats, *, gap: float = 23.0, rounds: int = 200) -> Floats:
    """Labels pushed apart until none overlaps another: twins and left/right pairs project onto the same pixel."""
    # A tiny spiral separates exact coincidences in a fixed order.
    turn = np.arange(len(pixels)) * 2.4
    spots = pixels + np.stack([np.cos(turn), np.sin(turn)], axis=1)
    for _ in range(rounds):
        offset = spots[:, None, :] - spots[None, :, :]
        distance = np.linalg.norm(offset, axis=2) + np.eye(len(spots)) * 1e9
        push = np.clip(gap - distance, 0.0, None) / 2
        if not push.any():
            break
        spots = spots + np.einsum("ij,ijk->ik", push, offset / distance[..., None]) * 0.6
    return np.asarray(spots, dtype=np.float64)
