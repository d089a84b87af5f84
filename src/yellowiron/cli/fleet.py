"""Of many machines: `batch`, `vary`."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Annotated, Any, Literal

import typer
from rich.table import Table
from rich.text import Text

from yellowiron.cli.application import app
from yellowiron.cli.options import command
from yellowiron.cli.telling import answer, progress_shown, tell
from yellowiron.model.errors import YellowironError

_STYLE = {"ready": "green", "short": "yellow", "absent": "dim"}
_SAID = {"ready": "ready", "short": "not ready", "absent": "not run"}


@command(app)
def batch(
    manifest: Annotated[str, typer.Argument(metavar="MANIFEST", help="YAML, TOML, JSON or CSV: a path or an address.")],
    out: Annotated[str, typer.Option("--out", help="The folder, or the address (s3://…), to write the fleet to.")],
    jobs: Annotated[
        int | None, typer.Option("--jobs", "-j", min=1, help="Builds at once (default: by cores and memory).")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="Leave what is whole and was built of the same.")] = False,
    only: Annotated[
        Literal["all", "failed"], typer.Option("--only", help="failed: what was not built, once more.")
    ] = "all",
    shard: Annotated[str, typer.Option("--shard", metavar="I/N", help="The I-th of N shares, for job arrays.")] = "",
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Say what would be run, and what is there.")] = False,
    engine: Annotated[Literal["local", "ray"], typer.Option("--engine", help="Who runs the builds.")] = "local",
    address: Annotated[str, typer.Option("--address", help="Of a Ray cluster (default: one is started here).")] = "",
) -> None:
    """Build the machines of a manifest; nothing that one does touches another."""
    from yellowiron import fleet

    if dry_run:
        _, store, choices = fleet.planned(manifest, out, resume=resume, only=only, shard=shard)
        answer(
            {
                "out": store.address,
                "items": [{"id": c.item.id, "type": c.item.type, "run": c.run, "why": c.why} for c in choices],
            },
            _choices(choices),
        )
        return
    if address and engine != "ray":
        raise YellowironError("An address is of a Ray cluster", where="--address", hint="Say --engine ray too.")
    runner = fleet.RayRunner(address, jobs=jobs) if engine == "ray" else None
    made = fleet.batch(
        manifest, out, jobs=jobs, resume=resume, only=only, shard=shard, runner=runner, told=_ended
    )  # fmt: skip
    counts = Counter(row["status"] for row in made.rows if row["id"] in made.ids)
    document = {
        "out": made.address, "run": len(made.outcomes), "counts": dict(sorted(counts.items())),
        "items": [row for row in made.rows if row["id"] in made.ids],
    }  # fmt: skip
    answer(document, _summary(made))
    raise typer.Exit(made.code)


def _ended(outcome: Any, ended: int, of: int) -> None:
    said = _SAID.get(outcome.status, f"{outcome.status}: {outcome.message}")
    tell(f"{ended:>{len(str(of))}}/{of}  {outcome.id:<28} {outcome.seconds:7.1f} s  {said}")


def _choices(choices: Any) -> Any:
    table = _table("", "machine", "type", "why")
    for choice in choices:
        table.add_row("run" if choice.run else "there", choice.item.id, Path(choice.item.type).name, choice.why)
    running = sum(choice.run for choice in choices)
    table.add_row("", "", "", "")
    table.add_row("", f"{running} of {len(choices)} would be run", "", "")
    return table


def _summary(made: Any) -> Any:
    table = _table("machine", "type", "verdict", "error", "time", right=("error", "time"))
    for row in made.rows:
        if row["id"] not in made.ids:
            continue
        status, worst = row["status"], row["worst_error_percent"]
        said = row["verdict"] if row["verdict"] and not row["open"] else row["open"] or row["message"]
        words = Text.assemble((_SAID.get(status, status), _STYLE.get(status, "red")), f"  {said}" if said else "")
        seconds = "" if row["seconds"] is None else f"{row['seconds']:.1f} s"
        table.add_row(row["id"], Path(row["type"]).name, words, "" if worst is None else f"{worst:.2f} %", seconds)
    table.add_row("", "", "", "", "")
    files = "index.html, fleet.parquet and fleet.csv" if made.parquet else "index.html and fleet.csv"
    table.add_row(Text(f"{made.address}: {files}", "dim"), "", "", "", "")
    if not made.parquet:
        hint = "fleet.parquet needs pyarrow: pip install 'yellowiron[fleet]'"
        table.add_row(Text(hint, "dim"), "", "", "", "")
    return table


def _table(*columns: str, right: tuple[str, ...] = ()) -> Table:
    table = Table(box=None, pad_edge=False, header_style="bold", show_edge=False)
    for column in columns:
        table.add_column(column, justify="right" if column in right else "left")
    return table


@command(app)
def vary(
    machine: Annotated[Path, typer.Argument(metavar="FILE.usd|FOLDER", help="A machine that build wrote.")],
    variants: Annotated[Path, typer.Argument(metavar="VARIANTS", help="What varies: YAML, TOML or JSON.")],
    out: Annotated[Path, typer.Option("--out", help="The folder to write variants to.")],
    count: Annotated[int, typer.Option("--count", min=1, help="How many.")],
    seed: Annotated[int, typer.Option("--seed", min=0, help="The same seed gives the same bytes.")] = 0,
    to: Annotated[Literal["usd", "mjcf"], typer.Option("--to", help="USD layers, or MJCF deltas.")] = "usd",
    jobs: Annotated[int | None, typer.Option("--jobs", "-j", min=1, help="Processes (default: by cores).")] = None,
) -> None:
    """Write variants of a machine: small layers over one base, and a table of what was sampled."""
    from yellowiron import fleet

    with progress_shown() as progress:
        made = fleet.vary(machine, variants, out, count=count, seed=seed, to=to, jobs=jobs, progress=progress)
    words = [f"{made.count} variants in {made.folder}: {made.table} says what was sampled."]
    if made.refused:
        words.append(f"{len(made.refused)} samples were refused:")
        words += [f"  {number} × {why}" for why, number in Counter(why for _, why in made.refused).most_common()]
    document = {
        "folder": str(made.folder), "count": made.count, "table": made.table,
        "refused": [{"sample": number, "why": why} for number, why in made.refused],
    }  # fmt: skip
    answer(document, Text("\n".join(words)))
