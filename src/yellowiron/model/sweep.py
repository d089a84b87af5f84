"""What an engine's run leaves to be looked at: a few poses, and errors and positions over time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from yellowiron.model.geometry import Floats


@dataclass(frozen=True, eq=False)
class Snapshot:
    """The machine at one step: `time` in seconds from the sweep's start; `share` (0 … 1) of the way of what moves, None
    for motors; `poses`: body → (4, 4) displacement from the drawn pose, machine frame, the root's own included."""

    time: float
    share: float | None
    poses: Mapping[str, Floats]


@dataclass(frozen=True, eq=False)
class Trace:
    """A driven joint over the sweep's times: `wanted` and `measured` (n,), shares of the stroke (0: fully in) where
    `kind` is position, rad/s or m/s where it is velocity."""

    joint: str
    kind: Literal["position", "velocity"]
    wanted: Floats
    measured: Floats


@dataclass(frozen=True, eq=False)
class Sweep:
    """One phase of a run: an actuator alone, or all `together`. `times` (n,) in seconds from its start; `pin_error`
    (n,) metres and `angle_error` (n,) radians are each the worst since the time before; `snapshots` go from low to
    high."""

    name: str
    times: Floats
    pin_error: Floats
    angle_error: Floats
    traces: tuple[Trace, ...]
    snapshots: tuple[Snapshot, ...]
