"""The small loader, exported once."""

from __future__ import annotations

from pathlib import Path

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
def mjcf_file(usd_file: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    from yellowiron.exporters import export_mjcf
    from yellowiron.usd import read_mechanism

    return export_mjcf(read_mechanism(usd_file), usd_file, tmp_path_factory.mktemp("mjcf"))
