"""What the tests of every example use."""

from __future__ import annotations

from types import ModuleType

import pytest
from example_file import module


@pytest.fixture(scope="module")
def values(request: pytest.FixtureRequest) -> ModuleType:
    """The values that the example of a test's module (its `TYPE`) is drawn to."""
    return module(request.module.TYPE, "values")
