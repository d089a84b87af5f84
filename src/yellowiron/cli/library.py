"""Of the template library: `templates list`, `show`, `check`, `copy`, `new`."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Group
from rich.text import Text

import yellowiron
from yellowiron.cli.application import templates
from yellowiron.cli.options import Type, command
from yellowiron.cli.telling import answer, progress_shown
from yellowiron.model.errors import YellowironError


@command(templates, "list")
def list_templates() -> None:
    """List the equipment types of the library, and the modules that they are put together from."""
    from yellowiron import library

    names = library.list_templates()
    sheets = [name for name in names if library.is_sheet_only(name)]
    modules = {name: module.about for name, module in library.modules().items()}
    lines = [Text.assemble(name, ("  sheet only" if name in sheets else "", "dim")) for name in names]
    lines += [Text(), Text("modules", style="italic")]
    lines += [Text.assemble(name, (f"  {about}", "dim")) for name, about in modules.items()]
    answer({"templates": list(names), "sheet_only": sheets, "modules": modules}, Text("\n").join(lines))


@command(templates, "show")
def show_template(equipment_type: Type) -> None:
    """Show a template's hierarchy and joints, or what it asks a sheet for."""
    from yellowiron import library

    template = library.load_template(equipment_type, sheet_only=True)
    uses = {name: dict(use) for name, use in library.uses_of(Path(template.folder)).items()}
    answer({**asdict(template), "modules": uses}, library.tree(template, uses))


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
    name: Annotated[
        str | None, typer.Argument(metavar="[NAME]", help="Without a CAD model: the new type, and its folder.")
    ] = None,
    cad: Annotated[
        Path | None, typer.Option("--from", help="The CAD model of a machine that the library does not have.")
    ] = None,
    like: Annotated[
        str | None,
        typer.Option(
            "--like",
            help="With --from: a type to take roles, names and limits from where bodies match. "
            "Else: the type that the new one is like.",
        ),
    ] = None,
    modules: Annotated[
        list[str] | None, typer.Option("--with", help="A module: MODULE, or MODULE:PARAMETER=VALUE,…; may be repeated.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="The folder to write; with --from nothing is written without it.")
    ] = None,
) -> None:
    """Propose a template from the joints and bodies that geometry finds in a CAD model, or begin one that is like a
    type, with modules."""
    from yellowiron.report import proposal_table

    if cad is None:
        _compose(name, like, modules or [], out)
        return
    if name is not None or modules:
        raise YellowironError(
            "A template is proposed from a CAD model, or begun with a name and modules",
            where=name or ", ".join(modules or []),
            hint="Leave --from away, or give --from alone.",
        )
    with progress_shown() as progress:
        document = yellowiron.new_template(cad, out, like=like, progress=progress)
    answer(document, proposal_table(document))
    raise typer.Exit(1 if any(f["severity"] == "error" for f in document["findings"]) else 0)


def _compose(name: str | None, like: str | None, modules: list[str], out: Path | None) -> None:
    from yellowiron import library
    from yellowiron.report import lint_table

    if name is None and out is None:
        raise YellowironError(
            "A new template wants a name, or a CAD model",
            where="templates new",
            hint="Write e.g. `yellowiron templates new my_loader --like wheel_loader`, or --from CAD.",
        )
    folder = library.compose_template(out or Path(name or ""), like=like, modules=modules)
    lint = library.lint(library.load_template(folder.resolve(), sheet_only=True))
    document = {
        "folder": str(folder),
        "modules": {each: dict(use) for each, use in library.uses_of(folder).items()},
        "findings": [asdict(f) for f in lint.findings],
        "counts": dict(lint.counts),
        "mobility": [asdict(m) for m in lint.mobility],
    }
    answer(
        document, Group(lint_table(document), Text(f"{folder}: yours to change; build with it by naming it.", "dim"))
    )
    raise typer.Exit(1 if any(f.severity == "error" for f in lint.findings) else 0)
