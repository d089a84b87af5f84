"""What a machine's tests gave: figures beside the sheet's and beside statics, as values and as a document. SI."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

from yellowiron.kinematics.measuring.sheet import specified
from yellowiron.model.finding import Finding
from yellowiron.model.machine_tests import MachineTest
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.specification import fold
from yellowiron.support.text import display

BARS: Mapping[str, float] = {"tipping": 10.0, "force": 10.0, "time": 15.0}
"""Percent by which a figure may miss the published one, by kind."""
UNITS: Mapping[str, str] = {"tipping": "kg", "force": "N", "time": "s", "lift": "1"}
RIG: Mapping[str, str] = {
    "tipping": "cylinders locked",
    "force": "its own cylinders at pressure times area, the others locked",
    "time": "its drive lets the sheet's flow pass, its target goes at that speed",
    "lift": "its own cylinders at pressure times area and the sheet's flow, the others locked",
}
"""By kind: what a test puts in the place of what the machine's file says. Of colliders those count that stand on the
ground, in every test."""
AGREED = 5.0
"""Percent by which engine and statics may differ, for what statics says in full: loads and forces."""


@dataclass(frozen=True)
class Input:
    """A specification that a figure hangs on; `published` false where no sheet gives it or as an example value only."""

    name: str
    value: float | None
    unit: str
    source: str
    published: bool


@dataclass(frozen=True)
class Figure:
    """One test's outcome. `engine_value` and `statics_value` in kg, N, s, or (lift) as the share of the way; None where
    it could not be made, `reason` says why; `role` is that of `spec`, as a measurement's. A `lift` has `arrived`.
    `weights`: newtons of a force, by statics, that come of the machine's own weight and that the sheet leaves out."""

    test: MachineTest
    engine_value: float | None
    statics_value: float | None
    reason: str = ""
    arrived: bool | None = None
    spec: float | None = None
    role: Literal["checked", "example", "calibrated"] = "checked"
    inputs: tuple[Input, ...] = ()
    weights: float = 0.0

    @property
    def comparable(self) -> float | None:
        """The engine's value as the sheet counts it."""
        return None if self.engine_value is None else self.engine_value - self.weights

    @property
    def error_percent(self) -> float | None:
        """Engine against sheet, as the sheet counts."""
        return _percent(self.comparable, self.spec)

    @property
    def statics_difference_percent(self) -> float | None:
        """Engine against statics."""
        return _percent(self.engine_value, self.statics_value)

    @property
    def passed(self) -> bool | None:
        """Whether it is within its bar, or a lift ended as expected; None where there is nothing to hold it against."""
        if self.test.kind == "lift":
            return None if self.arrived is None else self.arrived == self.test.expected
        error = self.error_percent
        return None if error is None else abs(error) <= BARS[self.test.kind]


def beside_sheet(figure: Figure, mechanism: Mechanism, *, calibrated: bool) -> Figure:
    """The figure with the sheet's value, its role, and what it hangs on. `calibrated`: the sheet's value made it."""
    spec, example, reason = (
        specified(mechanism, figure.test.specification) if figure.test.specification else (None, False, "")
    )
    role: Literal["checked", "example", "calibrated"] = "example" if example else "checked"
    return replace(
        figure,
        spec=spec,
        role="calibrated" if calibrated and spec is not None else role,
        reason="; ".join(text for text in (figure.reason, reason) if text),
        inputs=tuple(_input(mechanism, name) for name in figure.test.inputs),
    )


def figures_document(figures: Sequence[Figure]) -> list[dict[str, Any]]:
    """The figures as `simulate --json` and `report.json` have them (docs: simulate)."""
    return [
        {
            "name": f.test.name,
            "kind": f.test.kind,
            "definition": f.test.definition,
            "unit": UNITS[f.test.kind],
            "rig": RIG[f.test.kind],
            "engine_value": f.engine_value,
            "statics_value": f.statics_value,
            **({"weights": f.weights} if f.weights else {}),
            "statics_difference_percent": f.statics_difference_percent,
            "spec": f.spec,
            "error_percent": f.error_percent,
            "role": f.role,
            "bar_percent": BARS.get(f.test.kind),
            "payload": f.test.payload,
            "expected": f.test.expected if f.test.kind == "lift" else None,
            "arrived": f.arrived,
            "passed": f.passed,
            "inputs": [
                {"name": i.name, "value": i.value, "unit": i.unit, "source": i.source, "published": i.published}
                for i in f.inputs
            ],
            "reason": f.reason,
        }
        for f in figures
    ]


def figure_findings(figures: Sequence[Figure]) -> Iterator[Finding]:
    """SIM006 … SIM008; figures beside an example value or one that made them are shown and prove nothing."""
    for f in figures:
        name, unit = f.test.name, UNITS[f.test.kind]
        if f.test.kind == "lift" and f.passed is False:
            words = "it was not lifted" if f.test.expected else "it was lifted, which the machine should not do"
            yield Finding("SIM007", "warning", name, f"{words}: {f.reason}" if f.reason else words)
        elif f.passed is False and f.role == "checked":
            unpublished = [i.name for i in f.inputs if not i.published]
            hint = f"Not published: {', '.join(unpublished)}." if unpublished else "Check masses and pins."
            words = (
                f"{display(f.comparable, unit)} against {display(f.spec, unit)}, {f.error_percent:+.1f} %, "
                f"more than {BARS[f.test.kind]:g} %"
            )
            yield Finding("SIM006", "warning", name, words, hint)
        apart = f.statics_difference_percent
        if f.test.kind in ("tipping", "force") and apart is not None and abs(apart) > AGREED:
            words = f"the engine's figure differs by {apart:+.1f} % from statics"
            yield Finding("SIM008", "warning", name, words, "Try a smaller time step.")


def _percent(value: float | None, of: float | None) -> float | None:
    return 100.0 * (value / of - 1.0) if value is not None and of else None


def _input(mechanism: Mechanism, name: str) -> Input:
    entry: Mapping[str, Any] = next((e for k, e in mechanism.specifications.items() if fold(k) == fold(name)), {})
    value, example, _ = specified(mechanism, name)
    if value is None:
        return Input(name, None, str(entry.get("unit", "")), "no sheet gives it", False)
    page = f", page {entry['page']}" if entry.get("page") else ""
    words = f"{entry.get('source', 'sheet')}{page}{' (example value)' if example else ''}"
    return Input(name, value, str(entry.get("unit", "")), words, not example)
