"""The program and its groups of commands."""

from __future__ import annotations

from typing import Annotated

import typer
from rich.text import Text

import yellowiron
from yellowiron.cli.telling import telling
from yellowiron.report import terminal

app = typer.Typer(
    name="yellowiron",
    help="From a construction machine's CAD model and specification sheet to a simulation-ready USD machine.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
    pretty_exceptions_enable=False,
)
templates = typer.Typer(help="The template library.", no_args_is_help=True)
app.add_typer(templates, name="templates")


AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON document and nothing else.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print nothing but errors.")]
Verbose = Annotated[bool, typer.Option("--verbose", "-v", help="Say every step, with its time.")]
"""Before a command or behind it."""


def _version(asked: bool) -> None:
    if asked:
        terminal.print_text(Text(f"yellowiron {yellowiron.__version__}"))
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", "-V", help="Print it and stop.", callback=_version, is_eager=True)
    ] = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """From a construction machine's CAD model and specification sheet to a simulation-ready USD machine."""
    telling(as_json=as_json, quiet=quiet, verbose=verbose)
