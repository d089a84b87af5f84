"""A studio on the wheel loader example, without its sheet: three strokes are open, and every part may be decided."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from yellowiron import memory
from yellowiron.studio import Session, Setup


@pytest.fixture
def open_studio(
    cad_read_once: None, kept_stages: None, example: Path, tmp_path: Path
) -> Iterator[Callable[..., Session]]:
    """Opens a session in one folder, again and again; those before are closed. Machines are measured in this process,
    by the dozen: one of its own takes seconds to start."""
    opened: list[Session] = []

    def opening() -> Session:
        for one in opened:
            one.close()
        opened.append(Session(Setup("wheel_loader", example / "wheel_loader.step", tmp_path / "machine"), by="Ann"))
        return opened[-1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("yellowiron.studio.session.measured_of", memory.measure)
        yield opening
    for one in opened:
        one.close()


@pytest.fixture(scope="module")
def untouched(
    cad_read_once: None, kept_stages: None, example: Path, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Session]:
    """A session in which nobody decides anything, one for all tests of a module."""
    session = Session(
        Setup("wheel_loader", example / "wheel_loader.step", tmp_path_factory.mktemp("untouched") / "machine")
    )
    yield session
    session.close()
