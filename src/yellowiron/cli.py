"""The commands. Exit code 0: done; 1: done, and something fell short; 2: the input is unusable."""

from __future__ import annotations

import datetime
import functools
import inspect
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Literal

import typer
from rich.console import Console, RenderableType
from rich.text import Text

import yellowiron
from yellowiron.model.errors import YellowironError
from yellowiron.report import terminal
from yellowiron.support.limits import require_supported_platform

app = typer.Typer(
    name="yellowiron",
    help="From a construction machine's CAD model and specification sheet to a simulation-ready USD machine.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
templates = typer.Typer(help="The template library.", no_args_is_help=True)
app.add_typer(templates, name="templates")

Type = Annotated[str, typer.Argument(metavar="TYPE", help="A library type (templates list) or a template folder.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON document and nothing else.")]
Sheets = Annotated[list[Path] | None, typer.Option("--specs", help="A specification sheet (PDF); may be repeated.")]
Settings = Annotated[
    list[str] | None, typer.Option("--set", help='A value by hand: "Lift Cylinder Stroke=764 mm"; may be repeated.')
]
Config = Annotated[str, typer.Option("--config", help="The column of the sheet to take, by its heading.")]


def _reading(
    config: Config = "",
    extractor: Annotated[
        Literal["rules", "llm", "both"],
        typer.Option(
            "--extractor", help="How sheets are read: by rules (no network), by a language model, or by both."
        ),
    ] = "rules",
    llm_url: Annotated[
        str,
        typer.Option("--llm-url", envvar="YELLOWIRON_LLM_URL", help="An OpenAI-compatible endpoint, http://…/v1."),
    ] = "",
    llm_model: Annotated[
        str, typer.Option("--llm-model", envvar="YELLOWIRON_LLM_MODEL", help="The model's name there.")
    ] = "",
    llm_key: Annotated[
        str,
        typer.Option(
            "--llm-key", envvar="YELLOWIRON_LLM_KEY", show_envvar=True, help="Its key; better in the environment."
        ),
    ] = "",
    llm_record: Annotated[
        Path | None, typer.Option("--llm-record", help="Write the conversation with the model here.")
    ] = None,
    llm_replay: Annotated[
        Path | None, typer.Option("--llm-replay", help="Answer from a recorded conversation, no network.")
    ] = None,
) -> dict[str, Any]:
    """How sheets are read, as `yellowiron.extract` and `yellowiron.build` take it; the model is asked only where the
    extractor is one that asks."""
    from yellowiron.specs import ModelOptions

    model = ModelOptions(llm_model, llm_url, llm_key, record=llm_record, replay=llm_replay)
    return {"config": config, "extractor": extractor, "model": model}


def _reads_sheets(command: Callable[..., None]) -> Callable[..., None]:
    """Gives a command the options of `_reading`, before its last (`--json`); it gets what they say as `reading`."""
    own = [p for p in inspect.signature(command, eval_str=True).parameters.values() if p.name != "reading"]
    options = list(inspect.signature(_reading, eval_str=True).parameters.values())

    @functools.wraps(command)
    def with_options(**given: Any) -> None:
        reading = _reading(**{option.name: given.pop(option.name) for option in options})
        command(**given, reading=reading)

    parameters = [*own[:-1], *options, own[-1]]
    # typer reads the one and the other.
    with_options.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    with_options.__annotations__ = {p.name: p.annotation for p in parameters}
    return with_options


@app.command()
@_reads_sheets
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
    simulate: Annotated[bool, typer.Option("--simulate", help="Drive it in every engine that is installed.")] = False,
    as_json: Json = False,
    *,
    reading: dict[str, Any],
) -> None:
    """Build a machine: the whole way."""
    engines: tuple[str, ...] = ()
    if simulate:
        from yellowiron.simulation import installed_engines

        engines = installed_engines()
    from yellowiron.inputs import checked_inputs
    from yellowiron.report import build_summary

    # Before the libraries of a build are loaded, which takes more than a second.
    checked_inputs(equipment_type, cad, out, sheets=specs or (), alignment_file=alignment, documents=data or (),
                   settings=settings or ())  # fmt: skip
    with _progress(as_json) as progress:
        machine = yellowiron.build(
            equipment_type, cad, out, sheets=specs or (), alignment_file=alignment, documents=data or (),
            settings=[*(settings or ()), *([f"--tracks={tracks}"] if tracks else [])],
            engines=engines, progress=progress, **reading,
        )  # fmt: skip
    reasons = machine.fell_short
    _show(machine.document, build_summary(machine.document, reasons, str(out)), as_json)
    raise typer.Exit(1 if reasons else 0)


@app.command()
@_reads_sheets
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
    as_json: Json = False,
    *,
    reading: dict[str, Any],
) -> None:
    """Read the specifications a template asks for, each with its evidence."""
    from yellowiron import library, specs
    from yellowiron.report import missing_limits, specification_entry, specification_table

    if models:
        with _progress(as_json) as progress:
            columns = specs.columns_of([specs.read(sheet, progress=progress) for sheet in sheets])
        words = "\n".join(f"{c.name}  (page {c.page} of {c.file}, {c.values} values)" for c in columns)
        _show({"columns": [asdict(c) for c in columns]}, Text(words or "The sheets have no columns."), as_json)
        return
    with _progress(as_json) as progress:
        found = yellowiron.extract(
            equipment_type, sheets, settings=settings or (), accepted=accept or (), show=show, progress=progress,
            **reading,
        )  # fmt: skip
    template = library.load_template(equipment_type, sheet_only=True)
    entries = [specification_entry(s) for s in found]
    missing, findings = specs.missing_values(template, found), [asdict(f) for f in found.findings]
    _show(
        {"specifications": entries, "missing": missing, "findings": findings},
        specification_table(entries, missing=missing, findings=findings),
        as_json,
    )
    short = any(e["status"] in ("review", "conflict", "unreadable") for e in entries) or missing_limits(template, found)
    raise typer.Exit(1 if short else 0)


@app.command()
def convert(
    cad: Annotated[Path, typer.Argument(metavar="CAD", help="The CAD model.")],
    out: Annotated[Path, typer.Option("--out", help="The .usd, .usda or .usdc file to write.")],
    as_json: Json = False,
) -> None:
    """Convert CAD to USD, nothing else."""
    with _progress(as_json) as progress:
        assembly = yellowiron.convert(cad, out, progress=progress)
    document = {
        "file": str(out),
        "parts": len(assembly.parts),
        "shapes": len(assembly.shapes),
        "findings": [asdict(f) for f in assembly.findings],
    }
    _show(document, Text(f"{out}: {document['parts']} parts, {document['shapes']} shapes"), as_json)


@app.command("align")
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
    why: Annotated[str, typer.Option("--why", help="The reason, kept with the decision.")] = "",
    by: Annotated[str, typer.Option("--by", help="Who decides.", envvar="YELLOWIRON_USER")] = "",
    sheets: Sheets = None,
    settings: Settings = None,
    config: Config = "",
    as_json: Json = False,
) -> None:
    """Find the part that plays each role; with a sheet, the model's scale is checked against it."""
    from yellowiron.alignment import explain as explained
    from yellowiron.report import alignment_entry, alignment_table

    with _progress(as_json) as progress:
        alignment = yellowiron.align(
            equipment_type, cad, sheets=sheets or (), settings=settings or (), config=config, out=out,
            roles=roles or (), confirmed=confirmed or (), forgotten=forgotten or (),
            by=by, date=datetime.date.today().isoformat(), why=why, progress=progress,
        ).alignment  # fmt: skip
    if explain is not None:
        words = explained(alignment, explain)
        _show({"explain": explain, "reason": words}, Text(words), as_json)
    else:
        _show(alignment_entry(alignment), alignment_table(alignment), as_json)
    raise typer.Exit(1 if alignment.to_review or alignment.missing else 0)


@app.command()
def measure(
    machine: Annotated[Path, typer.Argument(metavar="FILE.usd", help="A machine that build wrote.")],
    as_json: Json = False,
) -> None:
    """Measure a machine against its sheet."""
    from yellowiron.report import measurement_table, within_tolerance

    found = yellowiron.measure(machine)
    entries = [asdict(m) for m in found]
    _show({"measurements": entries}, measurement_table(entries), as_json)
    raise typer.Exit(1 if any(m.role == "checked" and within_tolerance(m) is False for m in found) else 0)


@app.command()
def check(
    file: Annotated[Path, typer.Argument(metavar="FILE.usd", help="Any UsdPhysics file.")], as_json: Json = False
) -> None:
    """Check any UsdPhysics file, ours or not."""
    from yellowiron.report import finding_table

    with _progress(as_json) as progress:
        progress("Checking the file")
        entries = [asdict(f) for f in yellowiron.check(file)]
    sound = Text("Sound.", "bold green")
    _show({"findings": entries}, finding_table(entries) if entries else sound, as_json)
    raise typer.Exit(1 if any(e["severity"] == "error" for e in entries) else 0)


@app.command()
def simulate(
    machine: Annotated[Path, typer.Argument(metavar="FILE.usd", help="A machine that build wrote.")],
    engine: Annotated[str, typer.Option("--engine", help="mujoco, physx or newton.")],
    base: Annotated[
        Literal["fixed", "floating"], typer.Option("--base", help="In the air, or on the ground.")
    ] = "fixed",
    payload: Annotated[str, typer.Option("--payload", help="Load in the bucket: kg, or 'rated'.")] = "0",
    test: Annotated[
        Literal["strokes", "drive", "hydraulics", "all"],
        typer.Option("--test", help="Every actuator's stroke; driving; the template's tests; or all."),
    ] = "strokes",
    dt: Annotated[float | None, typer.Option("--dt", help="Time step in seconds (default: the engine's).")] = None,
    as_json: Json = False,
) -> None:
    """Drive every actuator in an engine, compare every step with the kinematics; drive about; test the hydraulics."""
    from yellowiron.report import simulation_table

    with _progress(as_json) as progress:
        document = yellowiron.simulate(
            machine, engine=engine, test=test, base=base, payload=payload, dt=dt, progress=progress
        )
    _show(document, simulation_table(document), as_json)
    raise typer.Exit(1 if document["findings"] else 0)


@app.command()
def export(
    machine: Annotated[Path, typer.Argument(metavar="FILE.usd", help="A machine that build wrote.")],
    to: Annotated[str, typer.Option("--to", help="mjcf.")],
    out: Annotated[Path, typer.Option("--out", help="The folder to write to.")],
    as_json: Json = False,
) -> None:
    """Write the same machine for another simulator."""
    from yellowiron.exporters import find_exporter

    with _progress(as_json) as progress:
        written = yellowiron.export(machine, out, to=to, progress=progress)
    scene = find_exporter(to).scene
    files = {"machine": str(written), **({"scene": str(out / scene)} if scene else {})}
    said = f"{written}; {scene} beside it is the machine on the ground" if scene else str(written)
    _show(files, Text(said), as_json)


@templates.command("list")
def list_templates(as_json: Json = False) -> None:
    """List the equipment types of the library."""
    from yellowiron import library

    names = library.list_templates()
    sheets = [name for name in names if library.is_sheet_only(name)]
    lines = [Text.assemble(name, ("  sheet only" if name in sheets else "", "dim")) for name in names]
    _show({"templates": list(names), "sheet_only": sheets}, Text("\n").join(lines), as_json)


@templates.command("show")
def show_template(equipment_type: Type, as_json: Json = False) -> None:
    """Show a template's hierarchy and joints, or what it asks a sheet for."""
    from yellowiron import library

    template = library.load_template(equipment_type, sheet_only=True)
    _show(asdict(template), library.tree(template), as_json)


@templates.command("check")
def check_template(equipment_type: Type, as_json: Json = False) -> None:
    """Check a template: names, references, mobility."""
    from yellowiron import library
    from yellowiron.report import lint_table

    lint = library.lint(library.load_template(equipment_type, sheet_only=True))
    document = {
        "findings": [asdict(f) for f in lint.findings],
        "counts": dict(lint.counts),
        "mobility": [asdict(m) for m in lint.mobility],
    }
    _show(document, lint_table(document), as_json)
    raise typer.Exit(1 if any(f.severity == "error" for f in lint.findings) else 0)


@templates.command("copy")
def copy_template(
    equipment_type: Type, folder: Annotated[Path, typer.Argument(metavar="DIR")], as_json: Json = False
) -> None:
    """Copy a template to a folder of yours, to change it."""
    from yellowiron import library

    library.copy_template(equipment_type, folder)
    sheet_only = library.is_sheet_only(equipment_type)
    use = (
        "it says what to ask a sheet for, and has no joints to build from; name the folder to `yellowiron extract`"
        if sheet_only
        else "build with it by naming the folder"
    )
    _show({"folder": str(folder), "sheet_only": sheet_only}, Text(f"{folder}: yours to change; {use}."), as_json)


@templates.command("new")
def new_template(
    cad: Annotated[Path, typer.Option("--from", help="The CAD model of a machine that the library does not have.")],
    like: Annotated[
        str | None, typer.Option("--like", help="A type to take roles, names and limits from where bodies match.")
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="The folder to write; without it nothing is written.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Propose a template from the joints and bodies that geometry finds in a CAD model."""
    from yellowiron.report import proposal_table

    with _progress(as_json) as progress:
        document = yellowiron.new_template(cad, out, like=like, progress=progress)
    _show(document, proposal_table(document), as_json)
    raise typer.Exit(1 if any(f["severity"] == "error" for f in document["findings"]) else 0)


def _version(asked: bool) -> None:
    if asked:
        terminal.print_text(Text(f"yellowiron {yellowiron.__version__}"))
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", help="Print it and stop.", callback=_version, is_eager=True)
    ] = False,
) -> None:
    """From a construction machine's CAD model and specification sheet to a simulation-ready USD machine."""


def stoppable() -> list[int]:
    """Has signals that end a run raise `SystemExit`; the list has the one that did."""
    stopped: list[int] = []

    def stop(number: int, frame: object) -> None:
        stopped.append(number)
        sys.exit(128 + number)

    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) != signal.SIG_IGN:
            signal.signal(number, stop)
    return stopped


def main() -> None:
    """The console script: whatever is unusable is one sentence on stderr and exit code 2, never a traceback."""
    terminal.prepare()
    try:
        require_supported_platform()
        # A terminated run, or one whose terminal was closed, leaves as an interrupted one does: its child ends, its
        # temporary folders go. What nohup has told to stay stays.
        stopped = stoppable()
        try:
            code = terminal.called(app)
        except BaseException:
            # A library that was interrupted while it loads may make of it what it likes.
            if stopped:
                raise SystemExit(128 + stopped[0]) from None
            raise
        terminal.flush()
    except YellowironError as error:
        terminal.complain(error)
        code = 2
    sys.exit(code)


@contextmanager
def _progress(quiet: bool) -> Iterator[Any]:
    """A function that says what is being done, shown on stderr when it is a terminal."""
    stderr = Console(stderr=True)
    if quiet or not stderr.is_terminal:
        yield lambda words: None
        return
    with stderr.status("") as status:
        yield lambda words: status.update(f"{words} …")


def _show(document: Any, renderable: RenderableType, as_json: bool) -> None:
    if as_json:
        terminal.print_json(document)
    else:
        terminal.print_text(renderable)


if __name__ == "__main__":
    main()
