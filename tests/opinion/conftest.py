"""One machine for all tests of the second opinion."""

from __future__ import annotations

import pytest
from doubted_machine import Doubted, excavator_in_doubt


@pytest.fixture(scope="session")
def doubted() -> Doubted:
    return excavator_in_doubt()
