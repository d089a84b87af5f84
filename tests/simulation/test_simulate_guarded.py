"""Whatever an engine does in its own code is a sentence here: nothing of it reaches us but a result."""

from __future__ import annotations

import functools
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from kit.packages import install_package
from yellowiron.model.errors import YellowironError
from yellowiron.simulation import examine, installed_engines
from yellowiron.simulation.registry import GROUP

ENGINE = """
import os, signal, time

from yellowiron.support.guard import beat


def load(setup):
    return Engine(setup)


class Engine:
    version = "0"

    def __init__(self, setup):
        self.count = 0

    def targets(self, joints, rows):
        for _ in rows:
            yield

    def step(self):
        self.count += 1
        beat()
        if self.count == 20:
            {deed}

    def state(self):
        return 0

    def close(self):
        pass
"""
ENTRIES = """
from yellowiron.simulation.registry import EngineEntry

BAD = EngineEntry("bad_engine", 0.01)
ABSENT = EngineEntry("no_such_engine", 0.01, install="pip install absent")
"""


@pytest.fixture
def bad(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of a package with an engine `bad`, still to be written."""
    install_package(
        tmp_path / "site", monkeypatch, name="bad-engines", group=GROUP,
        entries={"bad": "bad_entries:BAD", "absent": "bad_entries:ABSENT"}, modules={"bad_entries": ENTRIES},
    )  # fmt: skip
    return tmp_path / "site"


def write(folder: Path, deed: str) -> None:
    (folder / "bad_engine.py").write_text(ENGINE.format(deed=deed))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("deed", "words"),
    [
        ("os.kill(os.getpid(), signal.SIGSEGV)", r"engine 'bad' crashed \(SIGSEGV\)"),
        ("os._exit(3)", "engine 'bad' ended with code 3"),
        ("raise RuntimeError('no contact')", "engine 'bad' failed: RuntimeError: no contact"),
    ],
)
def test_an_engine_that_ends_is_said(bad: Path, usd_file: Path, deed: str, words: str) -> None:
    write(bad, deed)
    with pytest.raises(YellowironError, match=words) as caught:
        examine(usd_file, engine="bad", test="strokes")
    assert caught.value.where == str(usd_file) and "another engine" in caught.value.hint


@pytest.mark.slow
def test_an_engine_that_hangs_is_stopped(bad: Path, usd_file: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Not one that is slow: the limit is on a step. What it was at has been shown."""
    write(bad, "time.sleep(600)")
    monkeypatch.setenv("YELLOWIRON_PATIENCE", "8")
    shown: list[str] = []
    start = time.monotonic()
    with pytest.raises(YellowironError, match="took no step for 8 s"):
        examine(usd_file, engine="bad", test="strokes", progress=shown.append)
    assert time.monotonic() - start < 60.0
    assert shown == ["Loading the machine into bad", "Simulating in bad: settle"]


@pytest.mark.parametrize("seconds", ["soon", "0", "-1", "inf", "nan"])
def test_patience_is_a_time(usd_file: Path, monkeypatch: pytest.MonkeyPatch, seconds: str) -> None:
    monkeypatch.setenv("YELLOWIRON_PATIENCE", seconds)
    with pytest.raises(YellowironError, match="no number of seconds"):
        examine(usd_file, engine="mujoco", test="drive")


def test_an_engine_that_is_not_installed_is_said(bad: Path, usd_file: Path) -> None:
    with pytest.raises(YellowironError, match=r"no_such_engine.*pip install absent"):
        examine(usd_file, engine="absent")


def test_mujoco_is_always_there() -> None:
    assert "mujoco" in installed_engines()


@pytest.mark.slow
@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM])
def test_stopping_the_command_stops_the_engine(bad: Path, usd_file: Path, sent: signal.Signals, tmp_path: Path) -> None:
    pid = tmp_path / "pid"
    write(bad, f"open({str(pid)!r}, 'w').write(str(os.getpid())); time.sleep(600)")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    command = [sys.executable, "-m", "yellowiron", "simulate", str(usd_file), "--engine", "bad", "--json"]
    # What runs in the background of a script ignores interrupts, and so would its children.
    heeding = functools.partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    ours = subprocess.Popen(command, env=environment, preexec_fn=heeding, **quiet)
    try:
        _until(lambda: pid.is_file() and pid.read_text() != "")
        ours.send_signal(sent)
        assert ours.wait(30.0) != 0
        _until(lambda: not _runs(int(pid.read_text())))
    finally:
        ours.kill()
        ours.wait()


def _until(done: Callable[[], bool]) -> None:
    end = time.monotonic() + 60.0
    while not done():
        assert time.monotonic() < end
        time.sleep(0.1)


def _runs(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False
