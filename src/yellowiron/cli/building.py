"""From CAD models and specification sheets: `build`, `extract`, `convert`, `align`."""

from __future__ import annotations

import datetime
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Literal

import typer
from rich.text import Text

import yellowiron
from yellowiron.cli.application import app
from yellowiron.cli.options import (
    Config,
    Mirror,
    SecondOpinion,
    Settings,
    Sheets,
    Type,
    asks_a_model,
    command,
    reads_sheets,
)
from yellowiron.cli.telling import answer, progress_shown, tell
from yellowiron.support import stopping


@command(app)
@asks_a_model
@reads_sheets
def build(
    equipment_type: Type,
    cad: Annotated[Path, typer.Option("--cad", help="The CAD model.")],
    out: Annotated[Path, typer.Option("--out", help="The folder to write the machine to.")],
    specs: Sheets = None,
    alignment: Annotated[Path | None, typer.Option("--alignment", help="An alignment that a person edited.")] = None,
    data: Annotated[
        list[Path] | None, typer.Option("--data", help="Materials, collision, relations or joints.")
    ] = None,
    settings: Settings = None,
    tracks: Annotated[
        Literal["belt", "shoes", "fixed"] | None,
        typer.Option("--tracks", help="How a crawler's tracks are modelled: hidden wheels, every shoe, or standing."),
    ] = None,
    mirror: Mirror = False,
    simulate: Annotated[bool, typer.Option("--simulate", help="Drive it in every engine that is installed.")] = False,
    watch: Annotated[
        bool, typer.Option("--watch", help="Build again whenever an input changes, until Ctrl-C.")
    ] = False,
    second_opinion: SecondOpinion = False,
    *,
    reading: dict[str, Any],
    llm: Any,
) -> None:
    """Build a machine: the whole way."""
    engines: tuple[str, ...] = ()
    opinion = llm if second_opinion else None
    if simulate:
        from yellowiron.simulation import installed_engines

        engines = installed_engines()
    from yellowiron import library
    from yellowiron.inputs import checked_inputs
    from yellowiron.report import build_summary

    def once() -> int:
        # Before the libraries of a build are loaded, which takes more than a second.
        checked_inputs(equipment_type, cad, out, sheets=specs or (), alignment_file=alignment, documents=data or (),
                       settings=settings or (), opinion=opinion)  # fmt: skip
        with progress_shown() as progress:
            machine = yellowiron.build(
                equipment_type, cad, out, sheets=specs or (), alignment_file=alignment, documents=data or (),
                settings=[*(settings or ()), *([f"--tracks={tracks}"] if tracks else [])],
                mirror=mirror, engines=engines, progress=progress, model=llm, opinion=opinion, **reading,
            )  # fmt: skip
        reasons = machine.fell_short
        answer(machine.document, build_summary(machine.document, reasons, str(out)))
        return 1 if reasons else 0

    kept = alignment or out / "alignment.json"
    own = library.own_template(equipment_type) if watch else None
    inputs = [cad, *(specs or ()), *(data or ()), kept, *([own] if own is not None else ())]
    raise typer.Exit(_watched(once, inputs, kept) if watch else once())


def _watched(once: Callable[[], int], inputs: Sequence[Path], kept: Path) -> int:
    """Does something once, and again whenever inputs change, until it is interrupted: the last exit code. `kept` is an
    input that it writes itself."""
    from yellowiron.cli.watching import stamps, wait_for_change
    from yellowiron.model.errors import YellowironError
    from yellowiron.report import terminal

    code = 0
    with stopping.until_interrupted():
        while True:
            before = stamps(inputs)
            try:
                code = once()
            except YellowironError as error:
                terminal.complain(error)
                code = 2
            terminal.flush()
            tell(f"Watching {len(inputs)} inputs; Ctrl-C ends.")
            changed = wait_for_change(inputs, {**{p: s for p, s in before.items() if p != kept}, **stamps([kept])})
            tell(f"Changed: {', '.join(path.name for path in changed[:3])}")
    return code


@command(app)
@asks_a_model
@reads_sheets
def extract(
    equipment_type: Type,
    sheets: Annotated[list[Path], typer.Argument(metavar="PDF...", help="Specification sheets.")],
    show: Annotated[Path | None, typer.Option("--show", help="Write the pages as pictures, values boxed.")] = None,
    settings: Settings = None,
    accept: Annotated[
        list[str] | None,
        typer.Option("--accept", help="A value to review that is right: its name, or all-proven; may be repeated."),
    ] = None,
    models: Annotated[bool, typer.Option("--models", help="List the columns that --config takes, and stop.")] = False,
    *,
    reading: dict[str, Any],
    llm: Any,
) -> None:
    """Read the specifications a template asks for, each with its evidence."""
    from yellowiron import library, specs
    from yellowiron.report import missing_limits, specification_entry, specification_table

    if models:
        with progress_shown() as progress:
            columns = specs.columns_of([specs.read(sheet, progress=progress) for sheet in sheets])
        words = "\n".join(f"{c.name}  (page {c.page} of {c.file}, {c.values} values)" for c in columns)
        answer({"columns": [asdict(c) for c in columns]}, Text(words or "The sheets have no columns."))
        return
    with progress_shown() as progress:
        found = yellowiron.extract(
            equipment_type, sheets, settings=settings or (), accepted=accept or (), show=show, progress=progress,
            model=llm, **reading,
        )  # fmt: skip
    template = library.load_template(equipment_type, sheet_only=True)
    entries = [specification_entry(s) for s in found]
    missing, findings = specs.missing_values(template, found), [asdict(f) for f in found.findings]
    answer(
        {"specifications": entries, "missing": missing, "findings": findings},
        specification_table(entries, missing=missing, findings=findings),
    )
    short = any(e["status"] in ("review", "conflict", "unreadable") for e in entries) or missing_limits(template, found)
    raise typer.Exit(1 if short else 0)


@command(app)
def convert(
    cad: Annotated[Path, typer.Argument(metavar="CAD", help="The CAD model.")],
    out: Annotated[Path, typer.Option("--out", help="The .usd, .usda or .usdc file to write.")],
) -> None:
    """Convert CAD to USD, nothing else."""
    with progress_shown() as progress:
        assembly = yellowiron.convert(cad, out, progress=progress)
    document = {
        "file": str(out),
        "parts": len(assembly.parts),
        "shapes": len(assembly.shapes),
        "findings": [asdict(f) for f in assembly.findings],
    }
    answer(document, Text(f"{out}: {document['parts']} parts, {document['shapes']} shapes"))


@command(app, "align")
@asks_a_model
def align_parts(
    equipment_type: Type,
    cad: Annotated[Path, typer.Argument(metavar="CAD", help="The CAD model.")],
    out: Annotated[
        Path | None, typer.Option("--out", help="The alignment file to write (edits in it are kept).")
    ] = None,
    explain: Annotated[str | None, typer.Option("--explain", help="Say why for one role or part.")] = None,
    roles: Annotated[
        list[str] | None,
        typer.Option("--set-role", metavar="PATTERN=ROLE", help="Give parts of the CAD tree a role (none: left out)."),
    ] = None,
    confirmed: Annotated[
        list[str] | None, typer.Option("--confirm", metavar="PATTERN", help="Say that roles in --out are right.")
    ] = None,
    forgotten: Annotated[
        list[str] | None, typer.Option("--forget", metavar="PATTERN", help="Take decisions back.")
    ] = None,
    machine: Annotated[
        list[str] | None,
        typer.Option("--machine", metavar="NAME=WHAT", help="Say forward=-x, up=z, VARIANT=choice or ROLE=absent."),
    ] = None,
    why: Annotated[str, typer.Option("--why", help="The reason, kept with the decision.")] = "",
    by: Annotated[str, typer.Option("--by", help="Who decides.", envvar="YELLOWIRON_USER")] = "",
    sheets: Sheets = None,
    settings: Settings = None,
    config: Config = "",
    mirror: Mirror = False,
    second_opinion: SecondOpinion = False,
    *,
    llm: Any,
) -> None:
    """Find the part that plays each role; with a sheet, the model's scale is checked against it."""
    from yellowiron.alignment import explain as explained
    from yellowiron.report import alignment_entry, alignment_table

    with progress_shown() as progress:
        alignment = yellowiron.align(
            equipment_type, cad, sheets=sheets or (), settings=settings or (), config=config, mirror=mirror, out=out,
            roles=roles or (), confirmed=confirmed or (), forgotten=forgotten or (), machine=machine or (),
            by=by, date=datetime.date.today().isoformat(), why=why,
            opinion=llm if second_opinion else None, progress=progress,
        ).alignment  # fmt: skip
    if explain is not None:
        words = explained(alignment, explain)
        answer({"explain": explain, "reason": words}, Text(words))
    else:
        answer(alignment_entry(alignment), alignment_table(alignment))
    raise typer.Exit(1 if alignment.to_review or alignment.missing else 0)
