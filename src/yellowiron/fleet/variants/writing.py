"""Variants of a machine, the whole way: drawn, put to the mechanism, solved, and written as layers or deltas."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import yellowiron
from yellowiron.fleet.documents import UnusableError
from yellowiron.fleet.pool import usual_jobs
from yellowiron.fleet.results import as_parquet, has_parquet
from yellowiron.fleet.variants import scripts
from yellowiron.fleet.variants.changes import Changed, changed
from yellowiron.fleet.variants.parameters import read_parameters
from yellowiron.fleet.variants.sampling import Draw, drawn, draws_of
from yellowiron.fleet.variants.solving import Basis, RefusedError
from yellowiron.fleet.variants.tools import Tools, read_tools
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.support.guard import Wording, run_guarded
from yellowiron.support.output import keep_apart, output_folder
from yellowiron.support.text import to_json

To = Literal["usd", "mjcf"]
BASE, VARIANTS = "base", "variants"
SUFFIXES: Mapping[To, str] = {"usd": ".usdc", "mjcf": ".json"}
_PATIENCE_S, _MEMORY_MB = 3600.0, 16384
_TRIES = 10
"""So many samples are drawn for each that is wanted, before it is said that too many are refused."""
_FEW = 8
"""So few samples are made in this process."""
_MOST = 100_000


@dataclass(frozen=True)
class Varied:
    """What `vary` returns: the folder, how many variants it has, the name of the table, and the samples that were
    refused, each with why."""

    folder: Path
    count: int
    table: str
    refused: tuple[tuple[int, str], ...]
    files: tuple[str, ...]


@dataclass(frozen=True)
class _Made:
    """What became of a sample: a variant, of a machine that stands so much higher (metres), or why there is none."""

    number: int
    why: str = ""
    height: float = 0.0


def vary(
    machine: Path | str,
    parameters: Path | str,
    out: Path | str,
    *,
    count: int,
    seed: int = 0,
    to: To = "usd",
    jobs: int | None = None,
    progress: Callable[[str], None] = lambda words: None,
) -> Varied:
    """Writes `count` variants of a built machine (its USD file or folder) into the folder `out`.

    `parameters` is a file that says what varies (docs/fleet.md). `out` gets `base/`, the machine; `variants/00000.usdc`
    …, small layers over it (with `to="mjcf"` `00000.json`, what differs from the base's MJCF); `variants.csv`, with
    pyarrow `variants.parquet`, the sampled values in SI; `variants.json`, how it was made; and `isaaclab_cfg.py`. A
    sample whose loops do not close over its strokes is refused and another is drawn; it stands in the table all the
    same. The same seed gives the same bytes, on however many `jobs`; another parameter or a larger count changes no
    value of the others. `YellowironError` for what cannot be used, and where nearly all samples are refused.
    """
    file = _machine_file(Path(machine))
    place = Path(out)
    keep_apart(place, [file])
    if not 1 <= count <= _MOST:
        raise UnusableError(f"{count} variants cannot be made", where="--count", hint=f"From 1 to {_MOST}.")
    progress("Looking at the base machine")
    maker = Maker(file, Path(parameters), seed=seed, to=to)
    with output_folder(place) as folder:
        maker.write_base(folder)
        made = _all(maker, folder, count, jobs or usual_jobs(), progress)
        good = [one.number for one in made if not one.why]
        _write_table(maker, made, folder)
        files = tuple(f"{VARIANTS}/{number:05d}{SUFFIXES[to]}" for number in good)
        if to == "usd":
            scripts.write_isaaclab(maker.mechanism, file, files, folder)
    refused = tuple((one.number, one.why) for one in made if one.why)
    return Varied(place, len(good), "variants.csv", refused, files)


def _machine_file(machine: Path) -> Path:
    if not machine.is_dir():
        return machine
    try:
        name = json.loads((machine / "report.json").read_text(encoding="utf-8"))["machine"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        hint = "Name the folder that `yellowiron build` wrote to, or the machine's .usda file."
        raise UnusableError("There is no built machine in the folder", where=str(machine), hint=hint) from error
    return machine / f"{name}.usda"


class Maker:
    """Makes samples of one machine, each by its number alone."""

    def __init__(self, file: Path, parameters: Path, *, seed: int, to: To) -> None:
        from yellowiron.fleet.variants.deltas import Deltas
        from yellowiron.fleet.variants.layers import Layers
        from yellowiron.usd import read_mechanism

        self.file, self.parameters, self.seed, self.to = file, parameters, seed, to
        self.mechanism: Mechanism = read_mechanism(file)
        said = read_parameters(parameters)
        self.draws: tuple[Draw, ...] = draws_of(said, self.mechanism)
        self.tools: Tools = read_tools(said, self.mechanism, parameters)
        self._basis = Basis(self.mechanism)
        self._writer: Layers | Deltas = (Layers if to == "usd" else Deltas)(
            self.mechanism, file, self.draws, self.tools
        )

    def values(self, count: int) -> list[Floats]:
        """The values (count,) of each column."""
        return drawn(self.draws, seed=self.seed, count=count)

    def write_base(self, folder: Path) -> None:
        """The base machine, and what variants share."""
        (folder / VARIANTS).mkdir(parents=True)
        self._writer.write_base(folder / BASE)

    def make(self, numbers: Sequence[int], folder: Path) -> Iterator[_Made]:
        """Writes samples into a folder."""
        table = self.values(max(numbers) + 1)
        for number in numbers:
            row = [float(column[number]) for column in table]
            try:
                work = changed(self.mechanism, self.draws, row, self.tools)
                variant = self._basis.solved(work)
            except RefusedError as error:
                yield _Made(number, str(error))
                continue
            named = {draw.column: shown(draw, value) for draw, value in zip(self.draws, row, strict=True)}
            record = {"sample": number, "seed": self.seed, "values": named}
            self._writer.write(work, variant, record, folder / VARIANTS / f"{number:05d}")
            yield _Made(number, height=height(work))


def shown(draw: Draw, value: float) -> float | str:
    """A value as the table has it: SI, or a tool's name."""
    words = draw.parameter.spread.words
    return words[int(value)] if words else float(f"{value:.9g}") + 0.0


def height(work: Changed) -> float:
    """How much higher the variant stands, metres."""
    from yellowiron.usd.variant import stand_height

    return stand_height(work.mechanism, work.radii) if work.radii else 0.0


def _all(maker: Maker, folder: Path, count: int, jobs: int, progress: Callable[[str], None]) -> list[_Made]:
    """Samples in the order of their numbers, until so many are good."""
    made: list[_Made] = []
    good = 0
    while good < count:
        first, wanted = len(made), count - good
        numbers = range(first, first + wanted)
        progress(f"Writing variants: {good} of {count}")
        made += _some(maker, folder, numbers, jobs)
        good = sum(not one.why for one in made)
        if good < count and len(made) >= _TRIES * count:
            why = max((one.why for one in made if one.why), key=[one.why for one in made].count)
            raise UnusableError(
                f"Of {len(made)} samples {len(made) - good} were refused: {why}", where=str(maker.parameters),
                hint="Let link lengths, strokes and closed lengths vary less.",
            )  # fmt: skip
    return made


def _some(maker: Maker, folder: Path, numbers: range, jobs: int) -> list[_Made]:
    shares = [numbers[share::jobs] for share in range(min(jobs, len(numbers) // _FEW + 1))]
    if len(shares) <= 1:
        return list(maker.make(numbers, folder))
    shares = [numbers[share :: len(shares)] for share in range(len(shares))]

    def apart(share: range) -> list[_Made]:
        found: list[_Made] = run_guarded(
            "yellowiron.fleet.variants.writing:make_some", str(maker.file), str(maker.parameters), str(folder),
            maker.seed, maker.to, list(share), where=str(maker.file), timeout_s=_PATIENCE_S, memory_mb=_MEMORY_MB,
            wording=Wording("Writing variants", "Writing variants took more than", "Try fewer jobs (-j)."),
        )  # fmt: skip
        return found

    with ThreadPoolExecutor(len(shares) - 1) as pool:
        others = [pool.submit(apart, share) for share in shares[1:]]
        made = list(maker.make(shares[0], folder))
        for other in others:
            made += other.result()
    return sorted(made, key=lambda one: one.number)


def make_some(file: str, parameters: str, folder: str, seed: int, to: To, numbers: Sequence[int]) -> list[_Made]:
    """`Maker.make` in a process of its own."""
    return list(Maker(Path(file), Path(parameters), seed=seed, to=to).make(numbers, Path(folder)))


def _write_table(maker: Maker, made: Sequence[_Made], folder: Path) -> None:
    import csv
    import io

    columns = {"sample": "integer", "file": "text", "refused": "text", "stand_height": "number"}
    columns |= {draw.column: "text" if draw.parameter.spread.words else "number" for draw in maker.draws}
    table = maker.values(len(made))
    rows: list[dict[str, Any]] = []
    for one in made:
        values = {d.column: shown(d, float(v[one.number])) for d, v in zip(maker.draws, table, strict=True)}
        file = "" if one.why else f"{VARIANTS}/{one.number:05d}{SUFFIXES[maker.to]}"
        stand = None if one.why else float(f"{one.height:.9g}")
        rows.append({"sample": one.number, "file": file, "refused": one.why, "stand_height": stand, **values})
    text = io.StringIO()
    writer = csv.DictWriter(text, list(columns), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    (folder / "variants.csv").write_text(text.getvalue(), encoding="utf-8")
    if has_parquet():
        (folder / "variants.parquet").write_bytes(as_parquet(columns, rows))
    units = {d.column: unit_of(d) for d in maker.draws}
    document = {
        "machine": maker.mechanism.name, "equipment_type": maker.mechanism.equipment_type,
        "version": yellowiron.__version__, "seed": maker.seed, "variants": sum(not one.why for one in made),
        "refused": [{"sample": one.number, "why": one.why} for one in made if one.why],
        "columns": {
            d.column: {"vary": d.parameter.vary, "mode": d.parameter.mode, "of": list(d.names), "unit": units[d.column]}
            for d in maker.draws
        },
    }  # fmt: skip
    (folder / "variants.json").write_text(to_json(document), encoding="utf-8")


def unit_of(draw: Draw) -> str:
    """The unit of a column: SI; of a factor, or a name, none."""
    from yellowiron.support.units import SI_UNIT

    return "" if draw.parameter.mode == "factor" else SI_UNIT.get(draw.parameter.quantity.dimension, "")
