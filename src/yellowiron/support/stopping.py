"""Ends a run that was asked to end: as an interrupted one does, and never while it takes away what it made."""

from __future__ import annotations

import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_LOOK_S = 0.02
"""Seconds until it is looked again whether a library is loaded."""
_IMPORT = "<frozen importlib._bootstrap>"
"""The file of every frame that imports."""

_asked: list[int] = []
_raised: list[int] = []
_depth = 0


def listen() -> list[int]:
    """From now on a termination, a closed terminal, or Ctrl-C leaves by `SystemExit`: once, so that nothing that is
    taken away on the way out is left half. What nohup has told to stay stays. The list has the signals that came. A
    library that is being loaded is waited for: it may make of what is raised in it what it likes, keep Python's lock
    for imports, or crash where it is taken down half made."""
    signal.signal(signal.SIGALRM, _look)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, _ask)
    return _asked


@contextmanager
def shielded() -> Iterator[None]:
    """A signal that comes inside is heard at the end, or where `exposed` lets it in. Of the main thread, which hears
    signals: in others it does nothing."""
    global _depth
    if not _hears():
        yield
        return
    _depth += 1
    try:
        yield
    finally:
        _depth -= 1
        _leave()


@contextmanager
def exposed() -> Iterator[None]:
    """Takes back one `shielded` around it: what may be ended at any point."""
    global _depth
    if not _hears():
        yield
        return
    _depth -= 1
    try:
        _leave()
        yield
    finally:
        _depth += 1


@contextmanager
def until_interrupted() -> Iterator[None]:
    """What is meant to go on until Ctrl-C ends it: that is no failure."""
    try:
        yield
    except KeyboardInterrupt:
        pass
    except SystemExit:
        if _asked[:1] != [signal.SIGINT]:
            raise
        _asked.clear()
        _raised.clear()


def _hears() -> bool:
    return threading.current_thread() is threading.main_thread()


def _ask(number: int, frame: FrameType | None) -> None:
    _asked.append(number)
    _look(number, frame)


def _look(number: int, frame: FrameType | None) -> None:
    if _asked and not _raised and _imports(frame):
        signal.setitimer(signal.ITIMER_REAL, _LOOK_S)
    else:
        _leave()


def _imports(frame: FrameType | None) -> bool:
    """Whether a library is being loaded."""
    while frame is not None:
        if frame.f_code.co_filename == _IMPORT:
            return True
        frame = frame.f_back
    return False


def _leave() -> None:
    if _asked and not _raised and not _depth:
        _raised.append(_asked[0])
        sys.exit(128 + _asked[0])
