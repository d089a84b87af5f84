"""Of the template library: `templates list`, `show`, `check`, `copy`, `new`."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer
from rich.text import Text

import yellowiron
from yellowiron.cli.application import templates
from yellowiron.cli.options import Type, command
from yellowiron.cli.telling import answer, progress_shown


@command(templates, "list")
def list_templates() -> None:
    """List the equipment types of the library."""
    from yellowiron import library

    names = library.list_templates()
    sheets = [name for name in names if library.is_sheet_only(name)]
    lines = [Text.assemble(name, ("  sheet only" if name in sheets else "", "dim")) for name in names]
    answer({"templates": list(names), "sheet_only": sheets}, Text("\n").join(lines))


@command(templates, "show")
def show_template(equipment_type: Type) -> None:
    """Show a template's hierarchy and joints, or what it asks a sheet for."""
    from yellowiron import library

    template = library.load_template(equipment_type, sheet_only=True)
    answer(asdict(template), library.tree(template))


@command(templates, "check")
def check_template(equipment_type: Type) -> None:
    """Check a template: names, references, mobility."""
    from yellowiron import library
    from yellowiron.report import lint_table

    lint = library.lint(library.load_template(equipment_type, sheet_only=True))
    document = {
        "findings": [asdict(f) for f in lint.findings],
        "counts": dict(lint.counts),
        "mobility": [asdict(m) for m in lint.mobility],
    }
    answer(document, lint_table(document))
    raise typer.Exit(1 if any(f.severity == "error" for f in lint.findings) else 0)


@command(templates, "copy")
def copy_template(equipment_type: Type, folder: Annotated[Path, typer.Argument(metavar="DIR")]) -> None:
    """Copy a template to a folder of yours, to change it."""
    from yellowiron import library

    library.copy_template(equipment_type, folder)
    sheet_only = library.is_sheet_only(equipment_type)
    use = (
        "it says what to ask a sheet for, and has no joints to build from; name the folder to `yellowiron extract`"
        if sheet_only
        else "build with it by naming the folder"
    )
    answer({"folder": str(folder), "sheet_only": sheet_only}, Text(f"{folder}: yours to change; {use}."))


@command(templates, "new")
def new_template(
    cad: Annotated[Path, typer.Option("--from", help="The CAD model of a machine that the library does not have.")],
    like: Annotated[
        str | None, typer.Option("--like", help="A type to take roles, names and limits from where bodies match.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="The folder to write; without it nothing is written.")
    ] = None,
) -> None:
    """Propose a template from the joints and bodies that geometry finds in a CAD model."""
    from yellowiron.report import proposal_table

    with progress_shown() as progress:
        document = yellowiron.new_template(cad, out, like=like, progress=progress)
    answer(document, proposal_table(document))
    raise typer.Exit(1 if any(f["severity"] == "error" for f in document["findings"]) else 0)
