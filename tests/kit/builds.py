"""Whole builds for tests that do not look at the report's page, which is a third of the work."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import pytest


@contextmanager
def without_pages() -> Iterator[None]:
    """Builds inside draw no pictures: `report.html` is empty."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("yellowiron.report.page", lambda *_, **__: "")
        yield
