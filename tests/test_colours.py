"""Linear colours: the same digits on every processor."""

from __future__ import annotations

import numpy as np
import pytest

from yellowiron.model.geometry import linear, linear_values


def test_a_colour_has_the_same_digits_alone_and_among_many() -> None:
    """A power's last digits differ between processors, and between one number and eight at once on the same one."""
    values = np.linspace(0.0, 1.0, 256)
    together = linear_values(values)
    alone = [linear((v, v, v))[0] for v in values.tolist()]
    assert together.tolist() == alone
    assert together.tolist() == together.round(12).tolist()


def test_the_curve_is_the_standards() -> None:
    """IEC 61966-2-1: a straight start, 0.0031308 at 0.04045, and 0.2140 at a half."""
    assert linear((0.0, 0.04045, 1.0)) == pytest.approx((0.0, 0.04045 / 12.92, 1.0), abs=1e-12)
    assert linear((0.5, 0.5, 0.5))[0] == pytest.approx(0.21404114, abs=1e-8)
