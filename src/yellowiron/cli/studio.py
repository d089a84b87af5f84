"""`studio`: what the program doubts, settled on a local page."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from typing import Annotated

import typer
from rich.text import Text

from yellowiron.cli.application import app
from yellowiron.cli.options import Config, Mirror, Settings, Sheets, command
from yellowiron.cli.telling import progress_shown
from yellowiron.model.errors import YellowironError
from yellowiron.report import terminal


@command(app)
def studio(
    machine: Annotated[
        str, typer.Argument(metavar="FOLDER|TYPE", help="The folder of a build, or a type with --cad and --out.")
    ],
    cad: Annotated[Path | None, typer.Option("--cad", help="The CAD model.")] = None,
    out: Annotated[Path | None, typer.Option("--out", help="The folder to keep decisions and the machine in.")] = None,
    specs: Sheets = None,
    data: Annotated[
        list[Path] | None, typer.Option("--data", help="Materials, collision, relations or joints.")
    ] = None,
    settings: Settings = None,
    config: Config = "",
    mirror: Mirror = False,
    by: Annotated[str, typer.Option("--by", help="Who decides.", envvar="YELLOWIRON_USER")] = "",
    port: Annotated[int, typer.Option("--port", min=0, max=65535, help="Of the page (0: any that is free).")] = 0,
    opened: Annotated[bool, typer.Option("--open/--no-open", help="Open the page in the browser.")] = True,
) -> None:
    """Settle what is in doubt on a local page, with the machine moving beside it."""
    from yellowiron.studio import Session, Setup, read_setup
    from yellowiron.studio.server import serve

    if cad is None:
        if out is not None or specs or data or settings or config or mirror:
            raise YellowironError(
                "The CAD model is not named", where="studio", hint="Name TYPE, --cad and --out, or a folder alone."
            )
        setup = read_setup(Path(machine))
    elif out is None:
        raise YellowironError(
            "There is no folder to keep the decisions in", where="studio", hint=f"Name one: --out out/{machine}."
        )
    else:
        setup = Setup(
            machine, cad, out, sheets=tuple(specs or ()), documents=tuple(data or ()), settings=tuple(settings or ()),
            config=config, mirror=mirror,
        )  # fmt: skip
    with progress_shown() as progress:
        session = Session(setup, by=by, progress=progress)

    def ready(address: str) -> None:
        terminal.print_text(Text(f"The studio is at {address}\nCtrl-C ends it; every decision is kept as it is made."))
        if opened:
            webbrowser.open(address)

    serve(session, port=port, ready=ready)
