"""The small loader as USD."""

from __future__ import annotations

from pathlib import Path

import pytest

from kit.machines import small_machine


@pytest.fixture(scope="session")
def usd_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_machine.write(tmp_path_factory.mktemp("learn"))
