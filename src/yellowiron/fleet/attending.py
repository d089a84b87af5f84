"""One item's child process: started, watched over, ended, and its result put into its place, whole."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import signal
import subprocess
import time
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from yellowiron.fleet.places import MARK, Store, staged
from yellowiron.fleet.values import BUILT, Item, Outcome
from yellowiron.model.errors import OutputError
from yellowiron.support import guard, isolated, limits
from yellowiron.support.text import to_json

RUN = "yellowiron.fleet.child:run"
SECONDS = "seconds.json"
"""Of an item's folder, with `MARK` beside it: what differs from run to run."""
ITEMS = "items"
_LOOK_MEMORY_S = 0.1


def folder_of(item: Item) -> str:
    """The name of an item's folder in a store."""
    return f"{ITEMS}/{item.id}"


@dataclass(eq=False)
class Child:
    """A child process at work on an item. One thread starts it and attends to it: it ends with that thread."""

    item: Item
    key: str
    process: subprocess.Popen[bytes]
    place: Path
    begun: float
    peak_mb: float = 0.0
    looked: float = 0.0

    @classmethod
    def start(cls, item: Item, key: str, staging: Path) -> Child:
        """Starts it, in a new session, in a folder of its own in `staging`. `OutputError` where it cannot be."""
        place = staging / staged(item.id)
        try:
            shutil.rmtree(place, ignore_errors=True)
            for name in ("new", "tmp"):
                (place / name).mkdir(parents=True)
            call = {
                "item": asdict(item), "folder": str(place / "new"), "inputs": str(place / "inputs"),
                "answer": str(place / "answer"),
            }  # fmt: skip
            (place / "call").write_text(json.dumps(call), encoding="utf-8")
            environment = {**isolated.shielded(os.environ), "TMPDIR": str(place / "tmp")}
            process = subprocess.Popen(
                guard.child_command(RUN, str(place / "call")),
                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                env=environment, start_new_session=True,
            )  # fmt: skip
        except OSError as error:
            said = error.strerror or str(error)
            raise OutputError(f"The build cannot be started: {said}", where=item.id, hint="Make room.") from error
        return cls(item, key, process, place, time.monotonic())

    def ended(self) -> Outcome | None:
        """What became of it, None while it is at work. Beyond its time or memory it is ended here."""
        code = self.process.poll()
        now = time.monotonic()
        if code is None:
            return self._bounded(now)
        self.end()
        answer = self.place / "answer"
        try:
            told = json.loads(answer.read_text(encoding="utf-8"))
            outcome = Outcome(**told)
        except (OSError, ValueError, TypeError):
            outcome = self._unsaid(code)
        return self._timed(outcome, now)

    def _bounded(self, now: float) -> Outcome | None:
        if now - self.looked >= _LOOK_MEMORY_S:
            self.looked = now
            self.peak_mb = max(self.peak_mb, limits.memory_in_use(self.process.pid))
        most, longest = self.item.memory_mb, self.item.timeout_s
        if self.peak_mb > most:
            self.end()
            said = f"The build needs more than {most} MB of memory and was stopped"
            return self._timed(Outcome(self.item.id, "memory", said, self.item.cad, "Raise its memory: 12 GB."), now)
        if now - self.begun > longest:
            self.end()
            said = f"The build took more than {longest:g} s and was stopped"
            return self._timed(Outcome(self.item.id, "timeout", said, self.item.cad, "Raise its timeout: 2 h."), now)
        return None

    def _unsaid(self, code: int) -> Outcome:
        """Of a child that left no answer."""
        if code == os.EX_IOERR:
            return Outcome(self.item.id, "disk", "The disk does not take the result", self.item.id, "Make room there.")
        if code in (-signal.SIGKILL, -signal.SIGTERM, -signal.SIGHUP, -signal.SIGINT):
            name = signal.Signals(-code).name
            hint = "Where the system's memory ran out, run fewer at once (-j)."
            return Outcome(self.item.id, "killed", f"The build was ended from outside ({name})", self.item.cad, hint)
        named = signal.Signals(-code).name if -code in signal.valid_signals() else str(code)
        words = f"The build crashed ({named})" if code < 0 else f"The build ended with code {code} and no result"
        return Outcome(self.item.id, "crashed", words, self.item.cad, "Build it alone to see where.")

    def _timed(self, outcome: Outcome, now: float) -> Outcome:
        return replace(outcome, seconds=round(now - self.begun, 3), peak_mb=round(self.peak_mb, 1))

    def end(self) -> None:
        """Ends its processes; readers that it has started end with it."""
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()

    def clear(self) -> None:
        """Takes away what it has left."""
        shutil.rmtree(self.place, ignore_errors=True)


def finished(child: Child, outcome: Outcome) -> Path:
    """The folder of an item that has ended, whole: what was not built leaves its reason alone. `OSError`."""
    new = child.place / "new"
    if outcome.status not in BUILT:
        shutil.rmtree(new, ignore_errors=True)
        new.mkdir()
    (new / SECONDS).write_text(to_json({"seconds": outcome.seconds, "peak_mb": outcome.peak_mb}), encoding="utf-8")
    (new / MARK).write_text(to_json(mark_of(child.item, child.key, outcome)), encoding="utf-8")
    return new


def installed(folder: Path, item: Item, outcome: Outcome, store: Store) -> Outcome:
    """Puts an item's folder into its place. Where that cannot be written, the outcome says so."""
    try:
        store.install(folder, folder_of(item))
    except OutputError as error:
        return replace(outcome, status="disk", message=error.message, where=item.id, hint=error.hint, figures={})
    return outcome


def keep(child: Child, outcome: Outcome, store: Store) -> Outcome:
    """Puts the result of an item that has ended into its place, and takes the rest away."""
    try:
        outcome = installed(finished(child, outcome), child.item, outcome, store)
    except OSError as error:
        said = f"The disk does not take it: {error.strerror}"
        outcome = replace(outcome, status="disk", message=said, where=child.item.id, hint="Make room.", figures={})
    child.clear()
    return outcome


def mark_of(item: Item, key: str, outcome: Outcome) -> dict[str, Any]:
    """What an item's `MARK` says: nothing that differs from run to run."""
    reason = {"message": outcome.message, "where": outcome.where, "hint": outcome.hint} if outcome.message else {}
    more = {"variants": item.variants.count} if item.variants and outcome.figures else {}
    return {"id": item.id, "type": item.type, "key": key, "status": outcome.status, **reason, **more,
            "figures": dict(outcome.figures)}  # fmt: skip
