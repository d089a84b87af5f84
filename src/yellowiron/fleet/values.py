"""What a batch is made of: items, the plan they make, and what became of each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

Status = Literal["ready", "short", "refused", "crashed", "timeout", "memory", "killed", "disk", "absent"]
"""What became of an item. `ready` and `short` (built, and something is left to a person) have a machine; `refused` has
an input that is unusable, `crashed` ended without a word, `timeout` and `memory` went beyond their limits, `killed` was
ended from outside, `disk` could not be written. `absent`: not run yet."""

BUILT: frozenset[Status] = frozenset({"ready", "short"})
PASSING: frozenset[Status] = frozenset({"killed", "disk"})
"""What was no fault of the item: it is run again by `resume`. The rest would come out the same again."""
CODES: Mapping[Status, int] = {"ready": 0, "short": 1}
"""Exit code of an item; 2 for all others."""


@dataclass(frozen=True)
class Variants:
    """Variants that an item's machine gets once it is built: their file, how many, from which seed."""

    file: str
    count: int
    seed: int = 0


@dataclass(frozen=True)
class Item:
    """One machine of a batch: what `yellowiron build` is told of it, and its bounds. Paths and addresses are absolute.
    `where` is its place in the manifest; `timeout_s` in seconds of the clock, `memory_mb` of memory in use by all of
    its processes together."""

    id: str
    type: str
    cad: str
    specs: tuple[str, ...] = ()
    data: tuple[str, ...] = ()
    alignment: str = ""
    set: tuple[str, ...] = ()
    config: str = ""
    tracks: str = ""
    mirror: bool = False
    page: bool = True
    engines: tuple[str, ...] = ()
    variants: Variants | None = None
    timeout_s: float = 3600.0
    memory_mb: int = 8192
    where: str = ""

    @property
    def inputs(self) -> tuple[str, ...]:
        """The files that it reads, each once, in the order in which it names them."""
        named = [self.cad, *self.specs, *self.data, self.alignment, self.variants.file if self.variants else ""]
        return tuple(dict.fromkeys(filter(None, named)))


@dataclass(frozen=True)
class Plan:
    """The items of a manifest, in its order. `file` is the manifest's path or address."""

    file: str
    items: tuple[Item, ...]


@dataclass(frozen=True)
class Outcome:
    """What became of one run of an item. `message`, `where` and `hint` say why, where it was not built; `figures` are
    those of its machine (`results.COLUMNS`). `seconds` of the clock and `peak_mb` of memory are the run's own: they are
    kept apart from what should be the same again."""

    id: str
    status: Status
    message: str = ""
    where: str = ""
    hint: str = ""
    figures: Mapping[str, Any] = field(default_factory=dict)
    seconds: float = 0.0
    peak_mb: float = 0.0
