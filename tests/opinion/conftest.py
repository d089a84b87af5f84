"""One machine for all tests of the second opinion."""

from __future__ import annotations

import pytest
from doubted_machine import Doubted, excavator_in_doubt


@pytest.fixture(scope="session")
def doubted() -> Doubted:
    return excavator_in_doubt()


@pytest.fixture(autouse=True)
def _alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is kept, and nothing in the environment names a model."""
    monkeypatch.setenv("YELLOWIRON_CACHE", "off")
    for name in ("URL", "MODEL", "KEY"):
        monkeypatch.delenv(f"YELLOWIRON_LLM_{name}", raising=False)
