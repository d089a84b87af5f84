"""The whole build, as the command line does it, in a process of its own."""

from __future__ import annotations

import os
import subprocess
import threading
from dataclasses import dataclass, field
from typing import Literal

from yellowiron.studio.setup import Setup
from yellowiron.support import isolated

_KEPT = 200
"""Lines of a build that are kept."""


@dataclass
class Build:
    """The last build: what it said, line by line, and how it ended. `count` grows with every change."""

    setup: Setup
    state: Literal["none", "running", "ready", "short", "failed"] = "none"
    lines: list[str] = field(default_factory=list)
    count: int = 0
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _process: subprocess.Popen[str] | None = None

    def start(self) -> bool:
        """Begins a build of the decisions that are in the output folder; False where one runs."""
        with self._lock:
            if self.state == "running":
                return False
            self.state, self.lines = "running", []
            self.count += 1
        threading.Thread(target=self._run, daemon=True).start()
        return True

    def stop(self) -> None:
        """Ends a build that runs; what it would have replaced stays as it was."""
        if self._process is not None and self._process.poll() is None:
            self._process.terminate()

    def _run(self) -> None:
        # As the command does: no module that lies in the current folder is run.
        command = [*isolated.interpreter(), "-m", "yellowiron", *self.setup.command(), "--verbose"]
        self._process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
            encoding="utf-8", errors="replace", env=isolated.shielded(os.environ),
        )  # fmt: skip
        assert self._process.stderr is not None
        for line in self._process.stderr:
            self.lines = [*self.lines[-_KEPT:], line.rstrip()]
            self.count += 1
        code = self._process.wait()
        self.state = "ready" if code == 0 else "short" if code == 1 else "failed"
        self.count += 1
