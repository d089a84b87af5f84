"""The small loader as USD, and the wheel loader example as built for the slow tests."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from kit.machines import small_machine
from yellowiron.model.mechanism import Mechanism


@pytest.fixture(scope="session")
def usd_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_machine.write(tmp_path_factory.mktemp("usd"))


@pytest.fixture(scope="session")
def mechanism(usd_file: Path) -> Mechanism:
    from yellowiron.usd import read_mechanism

    return read_mechanism(usd_file)


@pytest.fixture(scope="session")
def wheel_loader(built_loader: Any) -> Path:
    file: Path = built_loader.folder / "wheel_loader.usda"
    return file
