"""A picture of a page, turned so that its rows are level."""

from __future__ import annotations

import numpy as np
from PIL import Image

_MOST_DEG = 3.0
_FINEST_DEG = 0.05
_LEAST_DEG = 0.1
"""Below it nothing is turned: letters stay as they were drawn."""
_WIDE_PX = 1000


def straightened(picture: Image.Image) -> Image.Image:
    """The grey picture turned by the angle (of at most 3 degrees) at which its rows of ink are parted most sharply;
    as it is, if that is less than a tenth of a degree."""
    small = picture.convert("L")
    small.thumbnail((_WIDE_PX, _WIDE_PX), Image.Resampling.BOX)
    best, step = 0.0, 0.5
    angles = np.arange(-_MOST_DEG, _MOST_DEG + step, step)
    while step >= _FINEST_DEG:
        best = float(max(angles, key=lambda angle: (round(_sharpness(small, float(angle)), 6), -abs(angle))))
        step /= 3
        angles = best + step * np.arange(-2, 3)
    if abs(best) < _LEAST_DEG:
        return picture
    return picture.rotate(best, Image.Resampling.BICUBIC, fillcolor=255)


def _sharpness(picture: Image.Image, angle: float) -> float:
    """How much the darkness of neighbouring rows differs when turned so far."""
    turned = np.asarray(picture.rotate(angle, Image.Resampling.BILINEAR, fillcolor=255), float)
    height, width = turned.shape
    inner = turned[height // 20 : -(height // 20) or None, width // 20 : -(width // 20) or None]
    return float(np.square(np.diff(inner.mean(axis=1))).mean())
