"""A run that is told to end takes away what it made, whenever it is told."""

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
target, wanted = Path(sys.argv[1]), int(sys.argv[2])
seen = 0
OURS = ("output.py", "staging.py", "stopping.py", "contextlib.py")

def trace(frame, event, arg):
    global seen
    if event == "line" and frame.f_code.co_filename.endswith(OURS):
        seen += 1
        if seen == wanted:
            signal.raise_signal(signal.SIGTERM)
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
def test_told_at_any_line(tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    command = [sys.executable, "-c", _RUN]
    target = tmp_path / "base" / "out" / "machine"
    first = subprocess.run([*command, target, "0"], env=environment, capture_output=True, text=True, check=True)
    lines = int(first.stdout)
    assert lines > 100 and (target / "file").read_text() == "whole"
    for wanted in range(1, lines + 1, 7):
        place = tmp_path / str(wanted) / "out" / "machine"
        ended = subprocess.run([*command, place, str(wanted)], env=environment, capture_output=True, text=True)
        assert ended.returncode == 128 + signal.SIGTERM, (wanted, ended.stderr)
        whole = (place / "file").is_file() and not list(place.parent.glob(".yellowiron-*"))
        assert whole or not (tmp_path / str(wanted)).exists(), wanted


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
