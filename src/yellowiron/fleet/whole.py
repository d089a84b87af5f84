"""A batch, the whole way: what a manifest asks for, what is there, the rest run, and the results put together."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from yellowiron.fleet import gallery
from yellowiron.fleet.figures import COLUMNS
from yellowiron.fleet.keys import Keys
from yellowiron.fleet.manifest import read_manifest, shard_of
from yellowiron.fleet.places import Store, store_at
from yellowiron.fleet.pool import LocalRunner, Runner, usual_jobs
from yellowiron.fleet.results import PLAIN, TABLE, as_csv, as_parquet, has_parquet, marks_of, rows_of
from yellowiron.fleet.values import BUILT, CODES, PASSING, Item, Outcome, Plan
from yellowiron.support import stopping

Only = Literal["all", "failed"]
Told = Callable[[Outcome, int, int], None]
"""Called as each item ends: its outcome, how many have ended, of how many."""
_QUIET: Told = lambda outcome, ended, of: None  # noqa: E731


@dataclass(frozen=True)
class Choice:
    """What a batch does with an item: `run` it, or leave it as it is `there`; `why`, in a few words."""

    item: Item
    key: str
    run: bool
    why: str


@dataclass(frozen=True)
class Fleet:
    """What a batch returns: a row for every item of its manifest (`figures.COLUMNS`), the outcomes of those that were
    run, and where all is. `parquet`: whether `fleet.parquet` could be written."""

    address: str
    rows: Sequence[Mapping[str, Any]]
    outcomes: Sequence[Outcome]
    parquet: bool
    ids: frozenset[str] = field(default=frozenset())

    @property
    def code(self) -> int:
        """The exit code of the worst item of this batch's share."""
        return max((row["code"] for row in self.rows if row["id"] in self.ids), default=0)


def planned(
    manifest: str | Path,
    out: str | Path,
    *,
    resume: bool = False,
    only: Only = "all",
    shard: str = "",
) -> tuple[Plan, Store, list[Choice]]:
    """The plan of a manifest, the store of its results, and what would be done with each item of the share.

    Without `resume` everything is run. With it, an item is run whose folder is absent, whose key is another (inputs,
    options or version have changed), or which was ended from outside; what was refused, crashed or went beyond a limit
    would come out the same again, and stays. `only="failed"` runs those, and what is absent, whatever their keys.
    """
    plan = read_manifest(manifest)
    share = shard_of(plan, shard) if shard else plan
    store = store_at(out)
    marks = marks_of(share, store) if resume or only == "failed" else {}
    keys = Keys()
    choices = []
    for item in share.items:
        key, mark = keys.of(item), marks.get(item.id)
        if mark is None:
            choices.append(Choice(item, key, True, "not there yet" if resume or only == "failed" else ""))
            continue
        status, same = mark["status"], mark["key"] == key
        if only == "failed":
            choices.append(Choice(item, key, status not in BUILT, f"{status} before"))
        elif not same:
            choices.append(Choice(item, key, True, "its inputs, options or the version have changed"))
        else:
            choices.append(Choice(item, key, status in PASSING, f"{status} before" if status in PASSING else status))
    return plan, store, choices


def batch(
    manifest: str | Path,
    out: str | Path,
    *,
    jobs: int | None = None,
    resume: bool = False,
    only: Only = "all",
    shard: str = "",
    runner: Runner | None = None,
    told: Told = _QUIET,
) -> Fleet:
    """Builds the machines of a manifest into `out` (a folder, or an address that fsspec reaches), each in a child
    process of its own, `jobs` at a time (default: by cores and memory), or as `runner` does it.

    `out` gets `items/<id>/` (`machine/` as `yellowiron build` writes it, `picture.webp`, `item.json`; of what was not
    built `item.json` alone, which says why), `fleet.parquet`, `fleet.csv`, `index.html` and `seconds.js`. Nothing that
    one item does touches another. Items not chosen (`planned`) stay as they are. Ctrl-C, or closing the terminal, ends
    what is at work and leaves what is whole. Raises `YellowironError` for a manifest that cannot be used.
    """
    plan, store, choices = planned(manifest, out, resume=resume, only=only, shard=shard)
    work = [(choice.item, choice.key) for choice in choices if choice.run]
    store.clear(choice.item.id for choice in choices)
    run = runner or LocalRunner(jobs or usual_jobs())
    outcomes: list[Outcome] = []
    if work:
        ended = run(work, store)
        try:
            for outcome in ended:
                outcomes.append(outcome)
                told(outcome, len(outcomes), len(work))
        finally:
            with stopping.shielded():
                close = getattr(ended, "close", None)
                if close is not None:
                    close()
                collected(plan, store)
    rows, parquet = collected(plan, store)
    lost = {outcome.id: outcome for outcome in outcomes if outcome.status == "disk"}
    rows = [_with(row, lost.get(row["id"])) for row in rows]
    return Fleet(store.address, rows, outcomes, parquet, frozenset(choice.item.id for choice in choices))


def collected(plan: Plan, store: Store) -> tuple[list[dict[str, Any]], bool]:
    """Writes a fleet's table and page from its items' folders: the rows, and whether Parquet could be written."""
    rows = rows_of(plan, store)
    title = Path(plan.file).stem
    parquet = has_parquet()
    store.write(PLAIN, as_csv(rows))
    if parquet:
        store.write(TABLE, as_parquet(COLUMNS, rows))
    store.write(gallery.TIMES, gallery.times(rows))
    store.write(gallery.PAGE, gallery.page(title, rows, {item.id for item in plan.items if item.page}))
    return rows, parquet


def _with(row: dict[str, Any], outcome: Outcome | None) -> dict[str, Any]:
    """A row with what could not be written down."""
    if outcome is None or row["status"] != "absent":
        return row
    return {**row, "status": outcome.status, "code": CODES.get(outcome.status, 2), "message": outcome.message}
