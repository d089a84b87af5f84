"""What is said of a run: its steps, each with its time, on standard error; its answer on standard output."""

from __future__ import annotations

import contextlib
import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any

from rich.console import RenderableType
from rich.status import Status
from rich.text import Text

from yellowiron.report import terminal

_WIDE = 46
"""Letters of a step's words before its time."""


@dataclass(frozen=True)
class Telling:
    """How a command says what it does: its answer as JSON; nothing but errors; every step."""

    as_json: bool = False
    quiet: bool = False
    verbose: bool = False


_PLAIN = Telling()
_TELLING: ContextVar[Telling] = ContextVar("telling", default=_PLAIN)


def telling(*, as_json: bool, quiet: bool, verbose: bool) -> None:
    """Sets it for the command that runs."""
    _TELLING.set(Telling(as_json, quiet, verbose))


def telling_too(*, as_json: bool, quiet: bool, verbose: bool) -> None:
    """Adds what is said behind a command to what was said before it."""
    said = _TELLING.get()
    _TELLING.set(Telling(said.as_json or as_json, said.quiet or quiet, said.verbose or verbose))


def answer(document: Any, renderable: RenderableType) -> None:
    """The answer: the document where JSON was asked for, else the table or text."""
    told = _TELLING.get()
    if told.as_json:
        terminal.print_json(document)
    elif not told.quiet:
        terminal.print_text(renderable)


def tell(words: str) -> None:
    """A line on standard error, unless silence was asked for."""
    told = _TELLING.get()
    if not told.quiet:
        terminal.print_step(words)


@contextmanager
def progress_shown() -> Iterator[Callable[[str], None]]:
    """A function that is called with a few words at every step. On standard error each is a line with its time when it
    is done, and what is being done, in a terminal, a line that goes again. Nothing where JSON or silence was asked
    for, unless every step was."""
    told = _TELLING.get()
    if told.quiet or (told.as_json and not told.verbose):
        yield lambda words: None
        return
    steps = _Steps(told.verbose)
    with steps.shown():
        yield steps
        steps.done()


class _Steps:
    """The steps of a run. Those that differ in a number or in what stands behind a colon are one, unless every step was
    asked for."""

    def __init__(self, verbose: bool) -> None:
        self._verbose = verbose
        self._words = self._name = ""
        self._begin = 0.0

    def __call__(self, words: str) -> None:
        name = words if self._verbose else re.split(r" \(|: ", re.sub(r" page \d+ of \d+ of", "", words))[0]
        if name != self._name:
            self.done()
            self._name, self._begin = name, time.perf_counter()
        self._words = words

    def done(self) -> None:
        """The last step is over."""
        if self._name:
            terminal.print_step(f"{self._name:<{_WIDE}}{time.perf_counter() - self._begin:7.1f} s")
        self._name = ""

    @contextmanager
    def shown(self) -> Iterator[None]:
        """What is being done is shown in a terminal, and nowhere else."""
        console = terminal.error_terminal()
        with Status(self, console=console) if console is not None else contextlib.nullcontext():
            yield

    def __rich__(self) -> Text:
        return Text(f"{self._words} … {time.perf_counter() - self._begin:.0f} s" if self._name else "")
