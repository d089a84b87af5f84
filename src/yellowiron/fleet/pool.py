"""Schedulers. `Runner` is what a batch knows of one: items in, outcomes out, each as it ends. Here, the local one."""

from __future__ import annotations

import os
import time
from collections import deque
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Protocol

from yellowiron.fleet.attending import Child, keep
from yellowiron.fleet.places import Store
from yellowiron.fleet.values import Item, Outcome
from yellowiron.model.errors import OutputError
from yellowiron.support import stopping

_LOOK_S = 0.02
_EACH_MB = 2500
"""Megabytes that a build is counted with, where it is chosen how many run at once."""
_TRIES = 2
"""A child that was ended from outside gets another try, once the others have ended or begun."""

Work = Sequence[tuple[Item, str]]
"""Items with their keys."""
_Waiting = tuple[Item, str, int]
"""An item, its key, and which try it is."""


class Runner(Protocol):
    """Runs items, keeps their results in a store and says what became of each, in the order in which they end. Closing
    the iterator ends what is at work."""

    def __call__(self, work: Work, store: Store) -> Iterator[Outcome]:
        """Runs them."""


class LocalRunner:
    """Runs items in child processes of this one, `jobs` at a time."""

    def __init__(self, jobs: int) -> None:
        self.jobs = jobs

    def __call__(self, work: Work, store: Store) -> Iterator[Outcome]:
        """Runs them; see `Runner`."""
        waiting = deque((item, key, 1) for item, key in work)
        running: list[tuple[Child, int]] = []
        staging = store.staging()
        try:
            while waiting or running:
                # Whenever it is told to stop, every child is among those that run.
                with stopping.shielded():
                    ended = [*self._started(waiting, running, staging), *_kept(waiting, running, store)]
                yield from ended
                time.sleep(_LOOK_S)
        finally:
            for child, _ in running:
                child.end()
                child.clear()
            _remove_empty(staging)

    def _started(self, waiting: deque[_Waiting], running: list[tuple[Child, int]], staging: Path) -> list[Outcome]:
        """Starts as many as may run; the outcomes of those that cannot be started."""
        failed = []
        while waiting and len(running) < self.jobs:
            item, key, tries = waiting.popleft()
            try:
                running.append((Child.start(item, key, staging), tries))
            except OutputError as error:
                failed.append(Outcome(item.id, "disk", error.message, item.id, error.hint))
        return failed


def _kept(waiting: deque[_Waiting], running: list[tuple[Child, int]], store: Store) -> list[Outcome]:
    """The outcomes of those that have ended, their results in their places; what was killed waits again."""
    ended = []
    for entry in [*running]:
        child, tries = entry
        outcome = child.ended()
        if outcome is None:
            continue
        running.remove(entry)
        if outcome.status == "killed" and tries < _TRIES:
            child.clear()
            waiting.append((child.item, child.key, tries + 1))
        else:
            ended.append(keep(child, outcome, store))
    return ended


def _remove_empty(folder: Path) -> None:
    if folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()


def usual_jobs() -> int:
    """As many as there are cores for this process, and memory that is free for."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    try:
        words = Path("/proc/meminfo").read_text(encoding="ascii").partition("MemAvailable:")[2].split()
        fit = int(words[0]) // (1024 * _EACH_MB)
    except (OSError, ValueError, IndexError):
        fit = cores
    return max(1, min(cores, fit))
