"""The console script."""

from __future__ import annotations

import sys

from yellowiron.cli import building, fleet, library, machines, studio  # noqa: F401 - each adds its commands
from yellowiron.cli.application import app
from yellowiron.model.errors import OutputError, YellowironError
from yellowiron.report import terminal
from yellowiron.support import stopping
from yellowiron.support.limits import require_supported_platform


def main() -> None:
    """Whatever is unusable is one sentence on stderr and exit code 2, with `--json` one document on stdout; never a
    traceback."""
    terminal.prepare()
    try:
        require_supported_platform()
        stopped = stopping.listen()
        try:
            code = terminal.called(app)
        except BaseException:
            if not stopped:
                raise
        # Not taken down: a library that loads beside it would crash there.
        if stopped:
            terminal.leave(128 + stopped[0])
        terminal.flush()
    except YellowironError as error:
        _tell(error)
        code = 2
    sys.exit(code)


def _tell(error: YellowironError) -> None:
    words = sys.argv[1:]
    asked = "--json" in words[: words.index("--") if "--" in words else None]
    # An answer that cannot be printed is no place to say so.
    if asked and not (isinstance(error, OutputError) and error.where == terminal.STANDARD_OUTPUT):
        try:
            terminal.print_json({"error": {"message": error.message, "where": error.where, "hint": error.hint}})
            terminal.flush()
            return
        except OutputError:
            pass
    terminal.complain(error)
