"""Of machines that were built: `measure`, `compare`, `check`, `simulate`, `export`, `film`."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Literal

import typer
from rich.text import Text

import yellowiron
from yellowiron.cli.application import app
from yellowiron.cli.options import command
from yellowiron.cli.telling import answer, progress_shown
from yellowiron.model.errors import YellowironError
from yellowiron.support.files.inputs import MEGABYTE, read_input


@command(app)
def measure(
    machine: Annotated[Path, typer.Argument(metavar="FILE.usd", help="A machine that build wrote.")],
) -> None:
    """Measure a machine against its sheet."""
    from yellowiron.report import measurement_table, within_tolerance

    found = yellowiron.measure(machine)
    entries = [asdict(m) for m in found]
    answer({"measurements": entries}, measurement_table(entries))
    raise typer.Exit(1 if any(m.role == "checked" and within_tolerance(m) is False for m in found) else 0)


@command(app)
def compare(
    before: Annotated[Path, typer.Argument(metavar="FOLDER", help="A folder that build wrote to.")],
    after: Annotated[Path, typer.Argument(metavar="FOLDER", help="Another.")],
) -> None:
    """Say what differs between two builds: values, measurements, cylinders, joints, masses, parts, findings."""
    from yellowiron.report import difference_table, differences

    found = differences(_report(before), _report(after))
    answer({"differences": [asdict(one) for one in found]}, difference_table(found))
    raise typer.Exit(1 if found else 0)


def _report(folder: Path) -> dict[str, Any]:
    """The `report.json` of a build."""
    file = folder / "report.json" if folder.is_dir() else folder
    hint = "Name the folder that a build wrote to."
    try:
        document = json.loads(read_input(file, what="The report", most=256 * MEGABYTE, error=YellowironError))
    except ValueError as error:
        raise YellowironError("This is no report of a build", where=str(file), hint=hint) from error
    if not isinstance(document, dict) or not {"verdict", "alignment", "joints", "cylinders"} <= document.keys():
        raise YellowironError("This is no report of a build", where=str(file), hint=hint)
    return document


@command(app)
def check(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="Any UsdPhysics file; URDF, SDFormat, MJCF.")],
    machine: Annotated[
        Path | None,
        typer.Option(
            "--machine", metavar="FILE.usd", help="What it was exported from: held against it over its strokes."
        ),
    ] = None,
) -> None:
    """Check any UsdPhysics file, ours or not, or the joints of a URDF, SDFormat or MJCF file."""
    from yellowiron.report import finding_table

    with progress_shown() as progress:
        progress("Checking the file")
        entries = [asdict(f) for f in yellowiron.check(file, machine=machine)]
    sound = Text("Sound.", "bold green")
    answer({"findings": entries}, finding_table(entries) if entries else sound)
    raise typer.Exit(1 if any(e["severity"] == "error" for e in entries) else 0)


@command(app)
def simulate(
    machine: Annotated[Path, typer.Argument(metavar="FILE.usd", help="A machine that build wrote.")],
    engine: Annotated[str, typer.Option("--engine", help="mujoco, physx or newton.")],
    base: Annotated[
        Literal["fixed", "floating"] | None,
        typer.Option("--base", help="In the air, or on the ground (default: in the air, if it would not turn over)."),
    ] = None,
    payload: Annotated[str, typer.Option("--payload", help="Load in the bucket: kg, or 'rated'.")] = "0",
    test: Annotated[
        Literal["strokes", "drive", "hydraulics", "all"],
        typer.Option("--test", help="Every actuator's stroke; driving; the template's tests; or all."),
    ] = "strokes",
    dt: Annotated[float | None, typer.Option("--dt", help="Time step in seconds (default: the engine's).")] = None,
    settings: Annotated[
        Literal["file", "engine"] | None,
        typer.Option("--settings", help="What a build writes (the default), or the engine's own defaults."),
    ] = None,
    hz: Annotated[
        str, typer.Option("--hz", help="Steps a second, as 60,120,240: a table of how far pins come apart.")
    ] = "",
) -> None:
    """Drive every actuator in an engine, compare every step with the kinematics; drive about; test the hydraulics."""
    from yellowiron.report import rate_table, simulation_table

    with progress_shown() as progress:
        document = yellowiron.simulate(
            machine, engine=engine, test=test, base=base, payload=payload, dt=dt, settings=settings, rates=_rates(hz),
            progress=progress,
        )  # fmt: skip
    answer(document, rate_table(document) if "rates" in document else simulation_table(document))
    raise typer.Exit(1 if document["findings"] else 0)


def _rates(text: str) -> tuple[float, ...]:
    """Steps a second, as a person lists them."""
    try:
        found = tuple(float(each) for each in text.split(",") if each.strip())
    except ValueError:
        found = (0.0,)
    if not all(10.0 <= rate <= 100_000.0 for rate in found):
        raise YellowironError("These are no rates", where=f"--hz {text}", hint="Write steps a second, as 60,120,240.")
    return found


@command(app)
def export(
    machine: Annotated[Path, typer.Argument(metavar="FILE.usd", help="A machine that build wrote.")],
    to: Annotated[str, typer.Option("--to", help="mjcf, urdf, sdf, drake or isaaclab.")],
    out: Annotated[Path, typer.Option("--out", help="The folder to write to.")],
    detail: Annotated[
        str, typer.Option("--detail", help="Of its colliders: full, light (few, for learning) or visual (none).")
    ] = "full",
) -> None:
    """Write the same machine for another simulator."""
    from yellowiron.exporters import find_exporter, unsaid
    from yellowiron.usd import read_mechanism

    with progress_shown() as progress:
        written = yellowiron.export(machine, out, to=to, detail=detail, progress=progress)
    scene = find_exporter(to).scene
    files = {"machine": str(written), **({"scene": str(out / scene)} if scene else {})}
    said = f"{written}; {scene} beside it is the machine on the ground" if scene else str(written)
    short = unsaid(read_mechanism(machine), to=to)
    answer({**files, "unsaid": list(short)}, Text("\n".join((said, *short))))


@command(app)
def film(
    machine: Annotated[Path, typer.Argument(metavar="FOLDER", help="The folder of a build.")],
    out: Annotated[Path, typer.Option("--out", help="The .webp, .gif or .mp4 file to write.")],
) -> None:
    """A film of a few seconds: parts come together, joints light up, a value finds its cylinder, the machine works."""
    import tempfile

    from yellowiron import build
    from yellowiron.film import film as made
    from yellowiron.studio import read_setup

    setup = read_setup(machine)
    kept = setup.out / "alignment.json"
    with progress_shown() as progress, tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
        built = build(
            setup.equipment_type, setup.cad, Path(folder, "machine"), sheets=setup.sheets, documents=setup.documents,
            settings=setup.settings, config=setup.config, mirror=setup.mirror,
            alignment_file=kept if kept.exists() else None, page=False, progress=progress,
        )  # fmt: skip
        made(built, out, sheets=setup.sheets, progress=progress)
    answer({"file": str(out)}, Text(str(out)))
