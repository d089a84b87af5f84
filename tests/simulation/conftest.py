"""The small loader as USD, and the wheel loader example built once for the slow tests."""

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
def wheel_loader(example: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    from yellowiron.pipeline import build

    cad, sheet = example / "wheel_loader.step", example / "specifications.pdf"
    if not cad.is_file() or not sheet.is_file():
        pytest.skip("the wheel loader example is not drawn")
    folder = tmp_path_factory.mktemp("loader") / "out"
    build("wheel_loader", cad, folder, sheets=(sheet,), config="Standard boom; Stock pile, Bolt-on edge")
    return folder / "wheel_loader.usda"
