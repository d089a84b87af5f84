"""The guard: whatever a reader does in its child process is an error message here."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import time
from pathlib import Path

import pytest

from yellowiron.model.errors import CadError, SheetError
from yellowiron.support.guard import must_end, run_guarded


def test_a_result_comes_back() -> None:
    assert run_guarded("math:hypot", 3.0, 4.0, where="x") == 5.0


@pytest.mark.parametrize(
    ("target", "arguments", "words"),
    [
        ("os:abort", (), "crashed (SIGABRT)"),
        ("os:_exit", (7,), "ended with code 7"),
        ("math:sqrt", (-1.0,), "ValueError"),
        ("no_such_module:f", (), "ModuleNotFoundError"),
    ],
)
def test_a_failure_is_one_sentence(target: str, arguments: tuple[object, ...], words: str) -> None:
    with pytest.raises(CadError) as caught:
        run_guarded(target, *arguments, where="bad.step", error=CadError)
    assert words in caught.value.message
    assert caught.value.where == "bad.step"
    assert caught.value.hint


def test_a_hang_is_stopped() -> None:
    start = time.monotonic()
    with pytest.raises(SheetError, match="more than 1 s"):
        run_guarded("time:sleep", 60, where="slow.pdf", error=SheetError, timeout_s=1.0)
    assert time.monotonic() - start < 10.0


def test_a_bomb_is_bounded() -> None:
    with pytest.raises(CadError, match="memory"):
        run_guarded("builtins:bytearray", 2**34, where="bomb.step", error=CadError, memory_mb=1024)


def test_our_own_errors_cross_the_process_whole() -> None:
    with pytest.raises(Exception) as caught:
        run_guarded("yellowiron.model.units:parse_quantity", "many", where="x")
    assert "many" in str(caught.value) and "764 mm" in str(caught.value)


def test_the_child_is_another_process() -> None:
    assert run_guarded("os:getpid", where="x") != os.getpid()


def test_nothing_stays_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    run_guarded("math:sqrt", 4.0, where="x")
    assert list(tmp_path.iterdir()) == []


def test_a_full_disk_is_not_the_file_s_fault() -> None:
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    # Python ignores SIGXFSZ, so a file past the limit is an error of the write, as on a full disk.
    resource.setrlimit(resource.RLIMIT_FSIZE, (8192, before[1]))
    try:
        with pytest.raises(CadError, match="cannot be stored") as caught:
            run_guarded("builtins:bytes", 100_000, where="fine.step", error=CadError)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert "TMPDIR" in caught.value.hint


def test_the_child_ends_with_its_parent(tmp_path: Path) -> None:
    script = "from yellowiron.support.guard import run_guarded; run_guarded('time:sleep', 60, where='x')"
    parent = subprocess.Popen([sys.executable, "-c", script])
    deadline = time.monotonic() + 20.0
    children: list[str] = []
    while not children and time.monotonic() < deadline:
        children = Path(f"/proc/{parent.pid}/task/{parent.pid}/children").read_text().split()
        time.sleep(0.05)
    # The child arms itself in its first moments.
    time.sleep(1.0)
    parent.kill()
    parent.wait()
    while any(Path(f"/proc/{child}").exists() for child in children) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert children and not any(Path(f"/proc/{child}").exists() for child in children)


def test_what_goes_round_in_a_circle_is_ended() -> None:
    code = "from yellowiron.support.guard import must_end\nwith must_end(0.5):\n    while True: pass"
    start = time.monotonic()
    with pytest.raises(CadError, match="came to no end"):
        run_guarded("builtins:exec", code, where="bad.brep", error=CadError, timeout_s=60.0)
    assert time.monotonic() - start < 30.0


def test_what_ends_in_time_may_go_on() -> None:
    before = resource.getrlimit(resource.RLIMIT_CPU)
    with must_end(3600.0):
        assert resource.getrlimit(resource.RLIMIT_CPU) != before
    assert resource.getrlimit(resource.RLIMIT_CPU) == before
