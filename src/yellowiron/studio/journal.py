"""The history of a studio's decisions, on the disk before anybody is told that it was heard.

A file of JSON lines: `{"do": operation}`, `{"undo": true}`, `{"redo": true}`, after a first one, `{"base": …}`, that
says what was decided before. A line that a killed program did not finish counts as not said.
"""

from __future__ import annotations

import contextlib
import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from yellowiron.model.errors import OutputError, YellowironError
from yellowiron.studio.operations import Operation, to_entry
from yellowiron.support.files.inputs import MEGABYTE, read_input

FILE = "studio.jsonl"
_MOST = 64 * MEGABYTE


class Journal:
    """Operations in the order they were made, those before the cursor in force, on top of a `base` (None: of a new
    journal, which `begin` gives one). `read` takes an operation from its line; one that it does not take, of a part
    that a revised CAD model does not have, is passed over. `passed`: the operations in force after each line."""

    def __init__(self, file: Path, read: Callable[[object], Operation]) -> None:
        self._file = file
        self.operations: list[Operation] = []
        self.cursor = 0
        self.passed: list[list[Operation]] = [[]]
        lines = self._lines()
        self.base: Mapping[str, Any] | None = lines[0].get("base") if lines else None
        for line in lines[1:]:
            with contextlib.suppress(YellowironError):
                self._apply(line, read)
                self.passed.append(self.in_force)

    def begin(self, base: Mapping[str, Any]) -> None:
        """A new history on top of these decisions; the old one is gone."""
        self.base, self.operations, self.cursor = base, [], 0
        self._write(json.dumps({"base": base}, ensure_ascii=False, sort_keys=True) + "\n", "w")

    def do(self, operation: Operation) -> None:
        """Makes an operation; what was undone is gone."""
        self._append({"do": to_entry(operation)})
        self._done(operation)

    def undo(self) -> bool:
        """Takes the last operation in force back; False where there is none."""
        if self.cursor == 0:
            return False
        self._append({"undo": True})
        self.cursor -= 1
        return True

    def redo(self) -> bool:
        """Makes the operation that was undone last again; False where there is none."""
        if self.cursor == len(self.operations):
            return False
        self._append({"redo": True})
        self.cursor += 1
        return True

    @property
    def written_ns(self) -> int:
        """When it was last written, nanoseconds since 1970."""
        return self._file.stat().st_mtime_ns

    @property
    def in_force(self) -> list[Operation]:
        """The operations that hold, in order."""
        return self.operations[: self.cursor]

    def _done(self, operation: Operation) -> None:
        self.operations = [*self.in_force, operation]
        self.cursor = len(self.operations)

    def _apply(self, line: Mapping[str, Any], read: Callable[[object], Operation]) -> None:
        if "do" in line:
            self._done(read(line["do"]))
        elif "undo" in line:
            self.cursor = max(self.cursor - 1, 0)
        elif "redo" in line:
            self.cursor = min(self.cursor + 1, len(self.operations))

    def _lines(self) -> list[dict[str, Any]]:
        if not self._file.is_file():
            return []
        text = read_input(self._file, what="The studio's history", most=_MOST, error=YellowironError)
        found = []
        for line in text.decode("utf-8", errors="replace").split("\n"):
            try:
                entry = json.loads(line)
            except ValueError:
                continue
            if isinstance(entry, dict):
                found.append(entry)
        return found

    def _append(self, entry: Mapping[str, Any]) -> None:
        # Behind a line that was cut short the next begins on one of its own.
        self._write("\n" + json.dumps(entry, ensure_ascii=False) + "\n", "a")

    def _write(self, text: str, mode: str) -> None:
        try:
            self._file.parent.mkdir(parents=True, exist_ok=True)
            with self._file.open(mode, encoding="utf-8") as stream:
                stream.write(text)
                stream.flush()
                os.fsync(stream.fileno())
        except OSError as error:
            raise OutputError(
                f"The decision cannot be kept: {error.strerror or error}", where=str(self._file),
                hint="Make room there; nothing was decided.",
            ) from error  # fmt: skip
