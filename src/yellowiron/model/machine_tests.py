"""What a machine is put to in an engine, as a template's data: payload, tipping load, forces, times."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

TestKind = Literal["tipping", "force", "time", "lift"]
SPARSE = "sparse"
"""In a field's metadata: a machine's file leaves it out while it is its default."""


@dataclass(frozen=True)
class RatedLoad:
    """Where a rated payload can come from: `factor` times the value (SI) of a wanted name is kilograms, so that of a
    volume it is a density; `source` says by which rule. `at`: the wanted name that says where it is rated, if it is
    nowhere else (a crane's radius)."""

    specification: str
    factor: float
    source: str = ""
    at: str = field(default="", metadata={SPARSE: True})


@dataclass(frozen=True)
class PayloadTemplate:
    """The load in the machine's tool: its middle is at `site`, or where that is not there at the first of `others` that
    is; what it is rated for comes from the first of `rated` whose specification is known."""

    site: str
    rated: tuple[RatedLoad, ...] = ()
    others: tuple[str, ...] = field(default=(), metadata={"undecided": True})

    def among(self, sites: Collection[str]) -> PayloadTemplate:
        """It, at the first of its sites that is there; at its first where none is."""
        found = next((name for name in (self.site, *self.others) if name in sites), self.site)
        return replace(self, site=found, others=())


@dataclass(frozen=True)
class MachineTest:
    """One test (docs: template format). After `steps`, as a measurement's, `tipping`: a load on `site` grows; `force`:
    against `site`, moved by `offset` (metres along its x axis), in the `direction` up or along the site's path, while
    `actuator` pushes in the sense of `to`, `best` actuators first brought, one after the other, to where their own
    force there is greatest; `time` and `lift`: `actuator` moves to its end `to` with `payload` (times the rated one)
    in the tool, at the flow that the wanted name `flow` gives.

    `base` floating: on the ground; `expected`: whether a `lift` arrives. `inputs`: wanted names that the figure hangs
    on; `specification`: the one that it is compared with, "" for none. `when`: choices under which it is made, until
    they are decided (`template.UNDECIDED`). `unweighted`: what is published of a force leaves out the weights
    that the actuator carries.
    """

    name: str
    kind: TestKind
    specification: str = ""
    steps: tuple[Mapping[str, Any], ...] = ()
    site: str = ""
    offset: float = 0.0
    direction: Literal["up", "path"] = "up"
    actuator: str = ""
    best: tuple[str, ...] = ()
    to: Literal["max", "min"] = "max"
    payload: float = 0.0
    flow: str = ""
    base: Literal["fixed", "floating"] = "floating"
    expected: bool = True
    unweighted: bool = field(default=False, metadata={SPARSE: True})
    inputs: tuple[str, ...] = field(default=())
    definition: str = ""
    when: Mapping[str, tuple[str, ...]] = field(default_factory=dict, metadata={"undecided": True})
