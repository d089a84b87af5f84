"""Does a real model move? Its mechanism in MuJoCo, each actuator over a part of its stroke, alone."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from yellowiron import kinematics, usd
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template
from yellowiron.simulation.commands import Motion, motions, travel
from yellowiron.simulation.engine import Setup
from yellowiron.simulation.loads import carried
from yellowiron.simulation.registry import ENGINES, load_engine
from yellowiron.simulation.strokes.comparison import Comparison
from yellowiron.simulation.strokes.held import held_machine
from yellowiron.simulation.strokes.run import play
from yellowiron.stages import complete_mechanism

PART = 0.25
"""The share of its stroke that an actuator is driven, to the side where there is more of it."""
SECONDS, REST = 2.0, 0.5
"""That this takes, and that it then rests."""
TURN = 0.3
"""rad/s that a motor is turned with."""
HALF = 0.5
"""What comes this share of the way has moved …"""
SOME = 0.05
"""… and of motors, which take their time to get a machine turning, this."""
CLOSED = 0.002
"""Loops hold if no pin is farther from where the closed chain has it, of the largest part's extent."""


@dataclass(frozen=True)
class Driven:
    """Which actuators moved, which are stuck (with how far they came, of the way), the machine's worst pin error
    (of the largest part's extent), and why nothing could be driven, if nothing could."""

    moved: tuple[str, ...] = ()
    stuck: tuple[str, ...] = ()
    apart: float = 0.0
    failed: str = ""

    @property
    def words(self) -> str:
        """For a column of a table."""
        if self.failed:
            return f"does not move: {self.failed}"
        loops = f"loops {'hold' if self.apart < CLOSED else 'OPEN'} ({self.apart:.2%})"
        return ", ".join(self.moved) + (f"; not {', '.join(self.stuck)}" if self.stuck else "") + f"; {loops}"


def driven(assembly: Assembly, template: Template, alignment: Alignment) -> Driven:
    """A machine driven, as it is built without a sheet; `template` with its variants decided and rows expanded."""

    try:
        mechanism = complete_mechanism(assembly, template, alignment, Specifications())
        start = kinematics.legal_start(mechanism)
        if start is not None:
            assembly, template, alignment = kinematics.started(assembly, template, alignment, start)
            mechanism = complete_mechanism(assembly, template, alignment, Specifications())
        size = float(max(np.ptp(assembly.points_of(p), axis=0).max() for p in assembly.parts))
        wanted = [a.name for a in template.actuators]
        with tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
            usd.write_machine(mechanism, assembly, Path(folder), name="machine", frame=alignment.frame)
            return _driven(Path(folder) / "machine.usda", wanted, size)
    except YellowironError as error:
        return Driven(failed=str(error))


def _driven(file: Path, wanted: list[str], size: float) -> Driven:
    mechanism, _ = held_machine(file, "fixed")
    moves = motions(mechanism)
    comparison, step = Comparison(mechanism), ENGINES["mujoco"].timestep
    moved, stuck, apart = [], [], 0.0
    for name in wanted:
        own = [m for m in moves if m.actuator == name]
        if not own:
            stuck.append(f"{name} (nothing to drive)")
            continue
        engine = load_engine("mujoco", Setup(file, mechanism, "fixed", step, comparison.measured))
        targets = {m.joint: _targets(m, step) if m in own else np.zeros(1) for m in moves}
        length = max(len(row) for row in targets.values())
        targets = {j: np.concatenate([row, np.full(length - len(row), row[-1])]) for j, row in targets.items()}
        told = carried(comparison.chain, moves, targets, step)
        measured, rotations, origins = play(engine, tuple(told), np.column_stack(list(told.values())))
        engine.close()
        share = min(_share(m, measured[:, comparison.measured.index(m.joint)], targets[m.joint], step) for m in own)
        if np.isfinite(measured).all() and share > (HALF if own[0].position else SOME):
            moved.append(name)
        else:
            stuck.append(f"{name} ({100 * share:.0f} % of the way)" if np.isfinite(share) else f"{name} (broke down)")
        last = slice(-1, None)
        apart = max(apart, comparison.compare(measured[last], rotations[last], origins[last]).pin.value / size)
    return Driven(tuple(moved), tuple(stuck), apart)


def _targets(motion: Motion, step: float) -> Floats:
    """The targets of one motion, a step each."""
    count = round(SECONDS / step)
    if not motion.position:
        return np.full(count, motion.sign * min(TURN, motion.speed))
    end = max(motion.low, motion.high, key=abs)
    end = float(np.clip(np.sign(end) * PART * motion.stroke, motion.low, motion.high))
    row = travel(0.0, end, 2.0 * abs(end) / SECONDS, step)
    return np.concatenate([row, np.full(round(REST / step), end)])


def _share(motion: Motion, values: Floats, targets: Floats, step: float) -> float:
    """How far it came, of the way it was told."""
    if not motion.position:
        return float((values[-1] - values[0]) / (targets.sum() * step))
    return float((values[-1] - values[0]) / targets[-1]) if targets[-1] else 0.0
