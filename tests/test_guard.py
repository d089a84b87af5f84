"""The guard: whatever a reader does in its child process is an error message here."""

from __future__ import annotations

import contextlib
import os
import pickle
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from yellowiron.model.errors import CadError, SheetError, YellowironError
from yellowiron.support import limits
from yellowiron.support.guard import run_guarded
from yellowiron.support.limits import must_end


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
        run_guarded("yellowiron.support.units:parse_quantity", "many", where="x")
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


@pytest.mark.slow
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
    code = "from yellowiron.support.limits import must_end\nwith must_end(0.5):\n    while True: pass"
    start = time.monotonic()
    with pytest.raises(CadError, match="came to no end"):
        run_guarded("builtins:exec", code, where="bad.brep", error=CadError, timeout_s=60.0)
    assert time.monotonic() - start < 30.0


def test_what_ends_in_time_may_go_on() -> None:
    """Also in a process that has run for long: the limit was held against all of its time, by another clock."""
    with must_end(3600.0):
        assert 3500.0 < signal.getitimer(signal.ITIMER_PROF)[0] <= 3601.0
        with must_end(60.0):
            assert signal.getitimer(signal.ITIMER_PROF)[0] <= 61.0
        assert 3500.0 < signal.getitimer(signal.ITIMER_PROF)[0] <= 3601.0
        with must_end(7200.0):
            assert signal.getitimer(signal.ITIMER_PROF)[0] <= 3601.0
    assert signal.getitimer(signal.ITIMER_PROF)[0] == 0.0


WINDOWS = """
import importlib.abc, os, signal, sys

class Absent(importlib.abc.MetaPathFinder):
    def find_spec(self, name, *_):
        if name in ("fcntl", "grp", "pwd", "resource", "termios"):
            raise ModuleNotFoundError(f"No module named '{name}'", name=name)

sys.meta_path.insert(0, Absent())
sys.platform = "win32"
del os.EX_IOERR, os.killpg, signal.SIGKILL, signal.SIGPROF, signal.setitimer, signal.getitimer
"""
"""What makes a process see what there is on Windows, as far as the guard could use it."""


def on_windows(code: str) -> str:
    """What a program that believes itself on Windows prints."""
    done = subprocess.run([sys.executable, "-c", WINDOWS + code], capture_output=True, text=True, timeout=120.0)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_the_package_is_imported_where_there_are_no_limits() -> None:
    code = (
        "import yellowiron\n"
        "from yellowiron.support.units import parse_quantity\n"
        "from yellowiron.support.limits import must_end\n"
        "with must_end(1.0):\n"
        "    print(type(yellowiron.load_template('excavator')).__name__, yellowiron.read_cad.__name__)"
    )
    assert on_windows(code) == "Template read_cad"


def test_a_reader_is_refused_in_one_sentence_where_there_are_no_limits() -> None:
    code = (
        "from yellowiron.model.errors import YellowironError\n"
        "from yellowiron.support.guard import run_guarded\n"
        "try:\n"
        "    run_guarded('math:sqrt', 4.0, where='x')\n"
        "except YellowironError as error:\n"
        "    print(error)"
    )
    said = on_windows(code)
    assert said.startswith("yellowiron runs on Linux and macOS: ") and "(where: win32)" in said and "use WSL" in said
    assert "\n" not in said


@pytest.mark.parametrize("missing", ["platform", "resource"])
def test_either_sign_is_enough(missing: str, monkeypatch: pytest.MonkeyPatch) -> None:
    limits.require_supported_platform()
    monkeypatch.setattr(*((sys, "platform", "win32") if missing == "platform" else (limits, "resource", None)))
    with pytest.raises(YellowironError, match="runs on Linux and macOS") as caught:
        limits.require_supported_platform()
    assert caught.value.hint and caught.value.where


def test_macos_has_all_but_a_limit_of_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    before = resource.getrlimit(resource.RLIMIT_AS)
    monkeypatch.setattr(sys, "platform", "darwin")
    limits.require_supported_platform()
    limits.limit_memory(1)
    assert resource.getrlimit(resource.RLIMIT_AS) == before
    assert run_guarded("math:sqrt", 4.0, where="x") == 2.0


STARTS_AND_IS_KILLED = """
import os, signal, subprocess, sys
from yellowiron.support import guard
subprocess.Popen(guard.child_command("yellowiron.support.guard:run_child", sys.argv[1]), start_new_session=True)
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere no parent's end is told")
def test_a_child_whose_parent_ended_before_it_began_does_nothing(tmp_path: Path, root: Path) -> None:
    done = tmp_path / "done"
    call = tmp_path / "call"
    call.write_bytes(pickle.dumps(("os:mkdir", (str(done),), None, str(tmp_path / "answer"), -1)))
    environment = {**os.environ, "PYTHONPATH": str(root / "src")}
    subprocess.run([sys.executable, "-c", STARTS_AND_IS_KILLED, str(call)], env=environment, check=False)
    for _ in range(100):
        if str(call) not in "".join(commands()):
            break
        time.sleep(0.05)
    assert not done.exists()
    assert not (tmp_path / "answer").exists()


def commands() -> list[str]:
    """The command lines of all processes."""
    found = []
    for file in Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            found.append(file.read_text(encoding="utf-8", errors="replace"))
    return found
