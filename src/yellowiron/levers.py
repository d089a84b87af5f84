"""Stroke ↔ angle ↔ lever arm of a built machine, for learners: a cut pivot is no coordinate in an engine, but its angle
follows from the cylinder's stroke.

    boom = LeverTable.from_report("out/report.json", "boom", pivot="front_frame2boom_joint")
    angle = boom.angle(stroke)          # arrays of any shape, e.g. one stroke an environment
    torque = force * boom.lever(stroke)

numpy and the standard library alone, so that it runs where the simulator does.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from yellowiron.model.errors import YellowironError

Floats = NDArray[np.float64]
_HINT = "Build the machine again; `yellowiron build` writes report.json."


@dataclass(frozen=True, eq=False)
class LeverTable:
    """One pivot's angle over an actuator's stroke, the other actuators as drawn.

    `joint` is the driven slide; `strokes` (n,) its coordinate, metres from the drawn pose, rising; `angles` (n,) those
    of `pivot`, radians from the drawn pose; `rates` (n,) angle by stroke, rad/m. Between the table's strokes a cubic
    runs through angles and rates (Hermite's): with the 21 strokes of a report it stays within 2e-4 rad of the example
    loader's linkage. Beyond the ends of the stroke the ends hold.
    """

    actuator: str
    joint: str
    pivot: str
    strokes: Floats
    angles: Floats
    rates: Floats

    @classmethod
    def from_report(cls, path: str | Path, actuator: str, *, pivot: str = "") -> LeverTable:
        """The table of an actuator in a `report.json`; `pivot` may be left out where it turns only one.

        `YellowironError` where the file, the actuator or the pivot is not there.
        """
        try:
            report = json.loads(Path(path).read_text(encoding="utf-8"))
        except (OSError, UnicodeDecodeError, json.JSONDecodeError) as error:
            raise YellowironError("The report cannot be read", where=str(path), hint=_HINT) from error
        levers = report.get("levers") if isinstance(report, dict) else None
        if not isinstance(levers, dict):
            raise YellowironError("The report has no levers", where=str(path), hint=_HINT)
        if not levers.get(actuator):
            known = ", ".join(name for name, table in levers.items() if table)
            raise YellowironError(
                f"The report has no lever table for '{actuator}'", where=str(path), hint=f"It has: {known}."
            )
        return cls.from_table(levers[actuator], actuator, pivot=pivot)

    @classmethod
    def from_table(cls, table: Mapping[str, Any], actuator: str, *, pivot: str = "") -> LeverTable:
        """As `from_report`, from what `yellowiron.kinematics.lever_table` gives."""
        pivots = table["pivots"]
        if pivot not in pivots:
            if pivot or len(pivots) != 1:
                words = (
                    f"'{actuator}' turns no pivot '{pivot}'" if pivot else f"'{actuator}' turns {len(pivots)} pivots"
                )
                raise YellowironError(words, where=actuator, hint=f"Name one: pivot={' or '.join(pivots)}.")
            (pivot,) = pivots
        levers = np.array([np.inf if v is None else v for v in pivots[pivot]["lever"]], dtype=np.float64)
        return cls(
            actuator=actuator,
            joint=str(table["joint"]),
            pivot=pivot,
            strokes=np.array(table["stroke"], dtype=np.float64),
            angles=np.array(pivots[pivot]["angle"], dtype=np.float64),
            rates=1.0 / levers,
        )

    def angle(self, stroke: ArrayLike) -> Floats:
        """The pivot's angle, radians from the drawn pose, at strokes (metres, any shape)."""
        return self._cubic(stroke)[0]

    def rate(self, stroke: ArrayLike) -> Floats:
        """Angle by stroke, rad/m: the pivot's speed by the cylinder's."""
        return self._cubic(stroke)[1]

    def lever(self, stroke: ArrayLike) -> Floats:
        """The cylinder's lever arm about the pivot, metres, signed: torque = force × lever. Infinite where the pivot
        stands still."""
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / self.rate(stroke), dtype=np.float64)

    def stroke(self, angle: ArrayLike) -> Floats:
        """The stroke, metres from the drawn pose, at which the pivot has angles (radians, any shape).

        `YellowironError` where the angle turns back on its way, so that two strokes have it.
        """
        steps = np.diff(self.angles)
        if not (np.all(steps > 0.0) or np.all(steps < 0.0)):
            raise YellowironError(
                f"The angle of '{self.pivot}' turns back on its way: its stroke is not unique",
                where=self.actuator,
                hint="Ask for the angle of a stroke instead.",
            )
        order = 1 if steps[0] > 0.0 else -1
        wanted = np.clip(np.asarray(angle, dtype=np.float64), self.angles.min(), self.angles.max())
        found = np.interp(wanted, self.angles[::order], self.strokes[::order])
        for _ in range(4):  # Newton's steps; the table's own strokes are near enough for two.
            reached, rate = self._cubic(found)
            step = np.divide(wanted - reached, rate, out=np.zeros_like(rate), where=rate != 0.0)
            found = np.clip(found + step, self.strokes[0], self.strokes[-1])
        return np.asarray(found, dtype=np.float64)

    def _cubic(self, stroke: ArrayLike) -> tuple[Floats, Floats]:
        """Angle and rate on Hermite's cubics."""
        s = np.clip(np.asarray(stroke, dtype=np.float64), self.strokes[0], self.strokes[-1])
        i = np.clip(np.searchsorted(self.strokes, s, side="right") - 1, 0, len(self.strokes) - 2)
        width = self.strokes[i + 1] - self.strokes[i]
        t = (s - self.strokes[i]) / width
        rise = self.angles[i + 1] - self.angles[i]
        first, last = width * self.rates[i], width * self.rates[i + 1]
        b, c = 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise
        angle = self.angles[i] + t * (first + t * (b + t * c))
        return np.asarray(angle), np.asarray((first + t * (2.0 * b + 3.0 * t * c)) / width)
