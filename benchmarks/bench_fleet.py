"""Times a batch against the builds themselves, the plan and the page of ten thousand machines, a thousand variants.

Run with `python benchmarks/bench_fleet.py [--items 4] [--entries 10000] [--variants 1000] [--only batch|plan|vary]`.
Processor seconds are of all processes; those of the clock are beside them, and mean little on a busy machine.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from rich.console import Console
from rich.table import Table

from yellowiron.fleet import planned, vary
from yellowiron.fleet.places import store_at
from yellowiron.fleet.whole import collected
from yellowiron.pipeline import build

ROOT = Path(__file__).resolve().parent.parent
EXAMPLE = ROOT / "examples" / "wheel_loader"


def taken(work: Callable[[], object]) -> tuple[float, float]:
    """Seconds of the clock, and of all processors, that something takes."""

    def processor() -> float:
        used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
        return sum(each.ru_utime + each.ru_stime for each in used)

    clock, before = time.perf_counter(), processor()
    work()
    return time.perf_counter() - clock, processor() - before


def command(*words: str | Path) -> None:
    environment = {**os.environ, "YELLOWIRON_FRESH": "1"}
    subprocess.run([sys.executable, "-m", "yellowiron", *map(str, words), "-q"], env=environment, check=False)


def batches(folder: Path, items: int, table: Table) -> None:
    """As many loaders, built one after the other by hand, and in a batch of one at a time; in turns."""
    inputs = {"cad": str(EXAMPLE / "wheel_loader.step"), "specs": [str(EXAMPLE / "specifications.pdf")]}
    alone, together = [], []
    for turn in range(items):
        out = folder / f"alone{turn}"
        alone.append(taken(lambda out=out: command(
            "build", "wheel_loader", "--cad", inputs["cad"], "--specs", inputs["specs"][0], "--out", out
        )))  # fmt: skip
        manifest = folder / f"one{turn}.json"
        manifest.write_text(json.dumps({"machines": [{"id": "loader", "type": "wheel_loader", **inputs}]}))
        fleet = folder / f"fleet{turn}"
        together.append(taken(lambda m=manifest, f=fleet: command("batch", m, "--out", f, "-j", "1")))
    many = folder / "many.json"
    machines = [{"id": f"loader{n}", "type": "wheel_loader", **inputs} for n in range(items)]
    many.write_text(json.dumps({"machines": machines}))
    whole = taken(lambda: command("batch", many, "--out", folder / "many", "-j", "1"))
    for name, place in (("clock", 0), ("processor", 1)):
        hand = sum(each[place] for each in alone)
        single = sum(each[place] for each in together)
        table.add_row(f"{items} builds by hand, {name}", f"{hand:.1f} s", "")
        table.add_row(f"a batch of each, {name}", f"{single:.1f} s", f"{100.0 * (single / hand - 1.0):+.1f} %")
        table.add_row(
            f"a batch of {items}, {name}", f"{whole[place]:.1f} s", f"{100.0 * (whole[place] / hand - 1.0):+.1f} %"
        )


def plans(folder: Path, entries: int, table: Table) -> None:
    """A manifest of so many entries planned, anew and over a fleet that is there; the table and the page of it."""
    (folder / "in").mkdir()
    for number in range(entries):
        (folder / "in" / f"m{number}.glb").write_bytes(b"glTF" + str(number).encode() * 1000)
    lines = ["defaults: {type: wheel_loader}", "machines:"]
    lines += [f"  - {{id: m{n}, cad: in/m{n}.glb, specs: in/m{n % 40}.glb, timeout: 20 min}}" for n in range(entries)]
    for name, text in {
        "entries.yaml": "\n".join(lines),
        "pattern.yaml": "machines: [{type: x, cad: in/*.glb}]",
    }.items():
        (folder / name).write_text(text)
        clock, processor = taken(lambda name=name: planned(folder / name, folder / "out", resume=True))
        table.add_row(f"{entries} machines planned, {name}", f"{clock:.1f} s", f"{processor:.1f} s of a processor")
    plan, _, choices = planned(folder / "entries.yaml", folder / "out")
    for choice in choices:
        place = folder / "out" / "items" / choice.item.id
        place.mkdir(parents=True)
        mark = {"id": choice.item.id, "key": choice.key, "status": "refused", "message": "The CAD file is empty"}
        (place / "item.json").write_text(json.dumps(mark))
        (place / "seconds.json").write_text('{"seconds": 1.0, "peak_mb": 50.0}')
    clock, processor = taken(lambda: planned(folder / "entries.yaml", folder / "out", resume=True))
    table.add_row("the same, all of them there", f"{clock:.1f} s", f"{processor:.1f} s of a processor")
    clock, processor = taken(lambda: collected(plan, store_at(folder / "out")))
    size = (folder / "out" / "index.html").stat().st_size / 1e6
    table.add_row(f"table and page of {entries}", f"{clock:.1f} s", f"page {size:.1f} MB")


def variants(folder: Path, count: int, table: Table) -> None:
    """So many variants of the loader, in which everything varies, on two cores."""
    machine = build("wheel_loader", EXAMPLE / "wheel_loader.step", folder / "machine",
                    sheets=[EXAMPLE / "specifications.pdf"], page=False)  # fmt: skip
    made = []
    clock, processor = taken(lambda: made.append(vary(
        machine.usd, ROOT / "examples" / "variants" / "loader.yaml", folder / "out", count=count, seed=1, jobs=2
    )))  # fmt: skip
    sizes = {path: path.stat().st_size for path in (folder / "out").rglob("*") if path.is_file()}
    largest = max(sizes[folder / "out" / file] for file in made[0].files)
    table.add_row(f"{count} variants of the loader", f"{clock:.1f} s", f"{processor:.1f} s of a processor")
    table.add_row("all files", f"{sum(sizes.values()) / 1e6:.1f} MB", f"a layer {1e-3 * largest:.1f} kB at most")
    table.add_row("samples refused", str(len(made[0].refused)), "loops that do not close over the strokes")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--items", type=int, default=4)
    parser.add_argument("--entries", type=int, default=10_000)
    parser.add_argument("--variants", type=int, default=1000)
    parser.add_argument("--only", choices=["batch", "plan", "vary"])
    arguments = parser.parse_args()
    table = Table("what", "", "")
    parts = {
        "batch": lambda folder: batches(folder, arguments.items, table),
        "plan": lambda folder: plans(folder, arguments.entries, table),
        "vary": lambda folder: variants(folder, arguments.variants, table),
    }
    for name, part in parts.items():
        if arguments.only in (None, name):
            with tempfile.TemporaryDirectory() as folder:
                part(Path(folder))
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
