"""Whole builds for tests that look at one thing of them: what else there is to do is left out, or done once a run."""

from __future__ import annotations

import contextlib
import hashlib
import io
import os
import pickle
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

MadeOnce = Callable[[str, Callable[[Path], None]], Path]
"""A folder by its name, filled by the first of a run's workers that asks for it."""


@contextmanager
def without_pages() -> Iterator[None]:
    """Builds inside draw no pictures, a third of the work: `report.html` is empty."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("yellowiron.report.page", lambda *_, **__: "")
        yield


@contextmanager
def without_usd() -> Iterator[None]:
    """Builds inside write and check no USD file, half of the work: for those whose report and mechanism are looked
    at."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("yellowiron.memory.write", lambda *_, **__: ((), {}, {}))
        yield


@contextmanager
def stages_kept() -> Iterator[None]:
    """Builds inside find, in the run's cache, what others in here made of the same inputs: as a user's do."""
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("YELLOWIRON_FRESH", raising=False)
        yield


def read_once(file: Path, made_once: MadeOnce) -> Any:
    """The assembly in a CAD file that nobody changes, which the first worker that asks for it has read."""
    from yellowiron.cad.read import read_cad

    def fill(folder: Path) -> None:
        folder.mkdir()
        (folder / "assembly.pickle").write_bytes(pickle.dumps(read_cad(file)))

    whole = hashlib.sha256(os.path.realpath(file).encode()).hexdigest()[:12]  # drawings without names are named alike
    return pickle.loads((made_once(f"read_{file.stem}_{whole}", fill) / "assembly.pickle").read_bytes())


@contextmanager
def reading_once(made_once: MadeOnce, *folders: Path) -> Iterator[None]:
    """Builds inside share what the CAD files under some folders hold; others they read themselves."""
    from yellowiron.cad.read import read_cad

    def read(path: str | Path, **limits: Any) -> Any:
        file = Path(os.path.realpath(path))
        known = any(file.is_relative_to(folder.resolve()) for folder in folders) and file.is_file()
        return read_once(file, made_once) if known else read_cad(path, **limits)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("yellowiron.cad.read_cad", read)
        yield


def script(root: Path, name: str, *arguments: str | Path) -> str:
    """What one of the documentation's scripts prints, run from the repository's root."""
    command = [sys.executable, str(root / "docs" / "scripts" / name), *map(str, arguments)]
    done = subprocess.run(
        command, cwd=root, capture_output=True, text=True, env={**os.environ, "MPLBACKEND": "agg"}, timeout=300
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def console(*words: str | Path, cwd: Path) -> subprocess.CompletedProcess[str]:
    """The console script in this process, whose imports would be most of the work in one of its own."""
    from yellowiron.cli import main

    command = ["yellowiron", *map(str, words)]
    stdout, stderr, code = io.StringIO(), io.StringIO(), 0
    handlers = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP)}
    with contextlib.chdir(cwd), contextlib.redirect_stdout(stdout), contextlib.redirect_stderr(stderr):
        try:
            with pytest.MonkeyPatch.context() as patch:
                patch.setattr(sys, "argv", command)
                main()
        except SystemExit as ended:
            code = int(ended.code or 0)
        finally:
            for number, handler in handlers.items():
                signal.signal(number, handler)
    return subprocess.CompletedProcess(command, code, stdout.getvalue(), stderr.getvalue())
