"""The smallest machine, and what is built of it, once a run."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from kit.builds import MadeOnce, reading_once, without_pages
from kit.small import write_small


@pytest.fixture(scope="module")
def small(made_once: MadeOnce) -> Iterator[Path]:
    """The folder of the smallest machine, not to be written to; what its CAD file holds is read once."""
    folder = made_once("small_machine", lambda place: write_small(place) and None)
    with reading_once(made_once, folder):
        yield folder


@pytest.fixture(scope="session")
def small_build(made_once: MadeOnce) -> Path:
    """The smallest machine as it is built, not to be written to."""

    def fill(folder: Path) -> None:
        from yellowiron.pipeline import build

        write_small(folder)
        with without_pages():
            build(folder / "type", folder / "small.glb", folder / "out",
                  settings=["Arm Angle Up=40 deg", "Arm Angle Down=10 deg"])  # fmt: skip

    return made_once("small_build", fill) / "out"
