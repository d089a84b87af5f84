"""A run that is told to end takes away what it made, whenever it is told."""

import contextlib
import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from yellowiron.support import stopping

_RUN = """
import signal, sys
from pathlib import Path
from yellowiron.support import output, stopping

stopping.listen()
target, wanted, sent = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
seen = 0
OURS = ("output.py", "staging.py", "stopping.py", "contextlib.py")

def trace(frame, event, arg):
    global seen
    if event == "line" and frame.f_code.co_filename.endswith(OURS):
        seen += 1
        if seen == wanted:
            signal.raise_signal(sent)
            signal.raise_signal(signal.SIGHUP)
    return trace

sys.settrace(trace)
output.check_folder(target)
with output.output_folder(target) as folder:
    (folder / "file").write_text("whole")
sys.settrace(None)
print(seen)
"""


@pytest.mark.slow
@pytest.mark.parametrize("sent", [signal.SIGTERM, signal.SIGINT])
def test_told_at_any_line(tmp_path: Path, sent: signal.Signals) -> None:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    command = [sys.executable, "-c", _RUN]
    target = tmp_path / "base" / "out" / "machine"
    whole = [*command, target, "0", str(int(sent))]
    first = subprocess.run(whole, env=environment, capture_output=True, text=True, check=True)
    lines = int(first.stdout)
    assert lines > 100 and (target / "file").read_text() == "whole"
    for wanted in range(1, lines + 1, 11):
        place = tmp_path / str(wanted) / "out" / "machine"
        words = [*command, place, str(wanted), str(int(sent))]
        # Tests that run in the background would hand their deafness to Ctrl-C on.
        ended = subprocess.run(words, env=environment, capture_output=True, text=True,
                               preexec_fn=lambda: signal.signal(sent, signal.SIG_DFL))  # fmt: skip
        assert ended.returncode == 128 + sent, (wanted, ended.stderr)
        kept = (place / "file").is_file() and not list(place.parent.glob(".yellowiron-*"))
        assert kept or not (tmp_path / str(wanted)).exists(), wanted


def test_another_thread_holds_no_signal_back(monkeypatch: pytest.MonkeyPatch) -> None:
    """A studio writes in the background: a closed terminal must not wait for that, nor end only the writer."""
    monkeypatch.setattr(stopping, "_asked", [])
    monkeypatch.setattr(stopping, "_raised", [])
    inside, done = threading.Event(), threading.Event()

    def write() -> None:
        with stopping.shielded():
            inside.set()
            assert done.wait(30)

    worker = threading.Thread(target=write)
    worker.start()
    assert inside.wait(30)
    with pytest.raises(SystemExit):
        stopping._ask(signal.SIGHUP, None)
    done.set()
    worker.join()
    assert stopping._depth == 0


@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM])
def test_only_ctrl_c_is_how_a_watch_ends(monkeypatch: pytest.MonkeyPatch, sent: signal.Signals) -> None:
    monkeypatch.setattr(stopping, "_asked", [])
    monkeypatch.setattr(stopping, "_raised", [])
    left = pytest.raises(SystemExit) if sent != signal.SIGINT else contextlib.nullcontext()
    with left, stopping.until_interrupted():
        stopping._ask(sent, None)
    assert stopping._asked == ([] if sent == signal.SIGINT else [sent])


def test_a_program_that_ends_itself_is_not_held_up() -> None:
    with pytest.raises(SystemExit, match="3"), stopping.until_interrupted():
        sys.exit(3)


_LOADED = """
import sys, time
from yellowiron.support import stopping

stopping.listen()
sys.path.insert(0, sys.argv[1])
import library
time.sleep(30)
print("went on")
"""
_LIBRARY = """
import os, signal, time
try:
    os.kill(os.getpid(), signal.SIGTERM)
    time.sleep(0.3)
except BaseException:
    print("interrupted")
print("loaded", flush=True)
"""


def test_a_library_that_is_being_loaded_is_waited_for(tmp_path: Path) -> None:
    """It would take what is raised in it for its own, and the run went on to its end."""
    (tmp_path / "library.py").write_text(_LIBRARY)
    ended = subprocess.run([sys.executable, "-c", _LOADED, tmp_path], capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout) == (128 + signal.SIGTERM, "loaded\n")


_ENDED = """
import atexit, os, signal
from yellowiron.cli import entry

atexit.register(os.abort)
print("said", end="")
entry.terminal.called = lambda app: os.kill(os.getpid(), signal.SIGTERM)
entry.main()
"""


def test_a_run_that_was_ended_is_not_taken_down() -> None:
    """A library that was stopped while it loads may crash where Python takes it down: nothing asks it any more."""
    ended = subprocess.run([sys.executable, "-c", _ENDED], capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout) == (128 + signal.SIGTERM, "said")
