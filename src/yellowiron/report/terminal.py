"""The program's own end of standard output and error: any of them may be closed, full, or unable to take a letter."""

from __future__ import annotations

import errno
import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, NoReturn, TextIO

from rich.console import Console, RenderableType
from rich.text import Text

from yellowiron.model.errors import OutputError, YellowironError
from yellowiron.support.text import to_json

STANDARD_OUTPUT = "standard output"
_PIPE = 128 + 13
"""The exit code of a program whose reader has gone (SIGPIPE)."""
_PIPE_WIDTH = 160
"""Letters in a line where nobody looks on: a pipe has no width, and tables are to be as wide as their text."""


def prepare() -> None:
    """Makes the standard streams safe to write to. What is closed leads nowhere: the next file that is opened would
    take its number, and have written into it what a library prints. A letter that a stream cannot take is spelled
    out."""
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        stream = getattr(sys, name)
        if stream is None:
            try:
                os.fstat(number)
            except OSError:
                nowhere = os.open(os.devnull, os.O_RDWR)
                if nowhere != number:
                    os.dup2(nowhere, number)
                    os.close(nowhere)
        elif number and hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")


def print_text(renderable: RenderableType) -> None:
    """Prints a text or table on standard output; nothing where that is closed. `OutputError` where it takes no more."""
    with _printed():
        if sys.stdout is not None:
            width = None if Console().is_terminal else _PIPE_WIDTH
            Console(width=width).print(renderable)


def print_json(document: Any) -> None:
    """Prints one JSON document on standard output, as ASCII where that takes nothing else. `OutputError` where it is
    closed or takes no more."""
    with _printed():
        if sys.stdout is None:
            raise OSError(errno.EBADF, "it is closed")
        whole = (sys.stdout.encoding or "").lower().replace("_", "-") in ("utf-8", "utf8")
        sys.stdout.write(to_json(document, ascii_only=not whole))


def flush() -> None:
    """Everything that was printed is out. `OutputError` where standard output takes no more."""
    with _printed():
        if sys.stdout is not None:
            sys.stdout.flush()


def leave(code: int) -> NoReturn:
    """Ends the program at once, as it stands: what was printed is out where it can be, and nothing is taken down."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            if stream is not None:
                stream.flush()
    os._exit(code)


def complain(error: YellowironError) -> None:
    """An error on standard error: a line each for what, where, and what to do."""
    lines = [("error: ", "bold red", error.message), ("where: ", "bold", error.where), ("hint:  ", "bold", error.hint)]
    try:
        if sys.stderr is not None:
            stderr = Console(stderr=True)
            for word, style, said in lines:
                if said:
                    stderr.print(Text.assemble((word, style), printable(said)), soft_wrap=True)
            sys.stderr.flush()
    except OSError:
        _silence(sys.stderr)


def print_step(words: str) -> None:
    """A line on standard error, as it is; nothing where that takes no more."""
    try:
        if sys.stderr is not None:
            Console(stderr=True).print(Text(words, "dim"), soft_wrap=True)
    except OSError:
        _silence(sys.stderr)


def error_terminal() -> Console | None:
    """Standard error, where it is a terminal."""
    stderr = Console(stderr=True)
    return stderr if stderr.is_terminal else None


def printable(text: str) -> str:
    """A text on one line, without what steers a terminal; the middle of one of over 2000 letters is left out."""
    text = "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)
    return text if len(text) <= 2000 else f"{text[:1400]} … {text[-500:]}"


def called(app: Callable[..., Any]) -> int:
    """The exit code of a typer app; what is wrong with its command line, or with a file, is a `YellowironError`."""
    import typer

    # Of typer's own copy of click, or of click itself: that depends on typer's version.
    complaint: type[Exception] = next(k for k in typer.BadParameter.__mro__ if k.__name__ == "ClickException")
    try:
        return int(app(prog_name="yellowiron", standalone_mode=False) or 0)
    except complaint as caught:
        error: Any = caught
        if type(error).__name__ == "NoArgsIsHelpError":
            error.show()
            return 2
        context = getattr(error, "ctx", None)
        command = context.command_path if context is not None else "yellowiron"
        message = " ".join(error.format_message().replace("Value error, ", "").split())
        raise YellowironError(message, where=command, hint=f"`{command} --help` says what it takes.") from error
    except typer.Abort:
        return 128 + signal.SIGINT
    except OSError as error:
        if error.filename is None and error.errno in (errno.ENOSPC, errno.EIO, errno.EBADF, errno.EPIPE):
            raise _unprintable(error) from error
        raise YellowironError(
            f"A file cannot be used: {error.strerror or error}",
            where=str(error.filename or command_line()),
            hint="Check the path, its permissions, and the room on its disk.",
        ) from error
    except MemoryError as error:
        raise YellowironError(
            "There is not enough memory", where=command_line(), hint="Close other programs, or split the model."
        ) from error


def command_line() -> str:
    """What was typed."""
    return " ".join(["yellowiron", *sys.argv[1:]])


@contextmanager
def _printed() -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise _unprintable(error) from error


def _unprintable(error: OSError) -> OutputError:
    """The error of a standard output that took no more; ends the program where its reader has gone, which is none."""
    _silence(sys.stdout)
    if error.errno == errno.EPIPE:
        sys.exit(_PIPE)
    return OutputError(
        f"The answer cannot be printed: {error.strerror or error}",
        where=STANDARD_OUTPUT,
        hint="Let it lead to a terminal, or to a file on a disk with room.",
    )


def _silence(stream: TextIO | None) -> None:
    """What a stream still holds goes nowhere: the interpreter would complain of it at its end."""
    if stream is not None:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)
