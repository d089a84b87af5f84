"""No file takes more than 1 GB of memory beside what a sound one of its format and size needs."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
from bombs import BOMBS, Bomb

from yellowiron.cad.need import need_mb
from yellowiron.cad.read import read_cad
from yellowiron.cad.recognition import format_of
from yellowiron.model.errors import YellowironError
from yellowiron.specs.extraction import read
from yellowiron.support import limits

LIBRARIES_MB = 330
"""What the largest of the libraries takes when it is loaded, and a file that is refused."""
_FAST = ("OBJ, a face of 9 million corners",)


@pytest.fixture
def peak(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[float]]:
    """The most memory that any guarded child has had in use, megabytes."""
    found = [0.0]
    seen = limits.memory_in_use

    def memory_in_use(process: int) -> float:
        try:
            status = Path(f"/proc/{process}/status").read_text()
        except OSError:
            return 0.0
        lines = [line for line in status.splitlines() if line.startswith("VmHWM:")]
        found[0] = max([found[0], *(int(line.split()[1]) / 1024.0 for line in lines)])
        return seen(process)

    monkeypatch.setattr(limits, "memory_in_use", memory_in_use)
    if not Path("/proc/self/status").exists():
        pytest.skip("the system does not say what memory a process has in use")
    yield found


@pytest.mark.parametrize(
    "bomb", [pytest.param(b, id=b.name, marks=() if b.name in _FAST else pytest.mark.slow) for b in BOMBS]
)
def test_a_bomb_stays_below_its_bound(
    bomb: Bomb, tmp_path: Path, peak: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("yellowiron.cad.read._BESIDE_MB", bomb.beside_mb)
    file = tmp_path / bomb.file
    file.write_bytes(bomb.content())
    need = 100 if file.suffix == ".pdf" else need_mb(file, format_of(file))
    begin, said = time.monotonic(), "read"
    try:
        read(file) if file.suffix == ".pdf" else read_cad(file)
    except YellowironError as error:
        said = error.message
        assert error.hint and error.where
    seconds = time.monotonic() - begin
    figures = f"{file.stat().st_size / 1e6:.3f} MB | {peak[0]:.0f} MB | {need} MB | {seconds:.1f} s"
    sys.stdout.write(f"{bomb.name} | {figures} | {said}\n")
    assert bomb.word in said
    assert 20.0 < peak[0] <= (LIBRARIES_MB if bomb.early else need + bomb.beside_mb + 128)
