"""Small machines to build, each in a second or two; readers that crash, hang and take all memory, as a package."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from kit.fleets import FAULTY, READERS
from kit.packages import install_package
from kit.small import write_small


@pytest.fixture
def inputs(tmp_path: Path) -> Path:
    """A folder with two small machines and their type, an empty file, one that is no CAD, and half a STEP file."""
    folder = tmp_path / "in"
    write_small(folder)
    shutil.copy(folder / "small.glb", folder / "other.glb")
    (folder / "empty.step").touch()
    (folder / "wrong.txt").write_text("no machine")
    return folder


@pytest.fixture
def faulty_readers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, inputs: Path) -> None:
    """Formats of another package whose readers crash, hang and take all memory; a file of each."""
    install_package(
        tmp_path / "site", monkeypatch, name="faulty-readers", group="yellowiron.cad_formats",
        entries=FAULTY, modules={"faulty_readers": READERS},
    )  # fmt: skip
    for name in FAULTY:
        (inputs / f"bad.{name}").write_text(name.upper())
