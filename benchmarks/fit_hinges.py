"""How the hinges of a type usually move: `hinges.json` of its template, from machines that were built with cylinders.

    python benchmarks/fit_hinges.py MACHINE.usda …

From the repository's root. For every actuator with cylinders the hinge that they turn: over which angles (as
`mechanism.actuation.usual_hinges` counts them) its stroke turns it, the others as drawn; how fast, at the speeds of its
drive; how hard, in the middle of its stroke. Of several machines of a type the means.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "src")]

from yellowiron.kinematics import ClosedChain  # noqa: E402
from yellowiron.kinematics.solver.pose_grid import explore, joint_values  # noqa: E402
from yellowiron.library import load_template  # noqa: E402
from yellowiron.mechanism.actuation.direct_drives import hinge_of  # noqa: E402
from yellowiron.mechanism.actuation.proportion import FASTEST  # noqa: E402
from yellowiron.mechanism.actuation.usual_hinges import Turned, angle_of, sense  # noqa: E402
from yellowiron.model.mechanism import GRAVITY, Mechanism, rolling  # noqa: E402
from yellowiron.usd import read_mechanism  # noqa: E402

POINTS = 61
STRONGEST = 1.0
"""Times weight and length: a hinge that takes more turns too little for what its cylinders lift."""
UPRIGHT = 0.7
"""Of an axis that steers: its part upwards."""
LEAST = np.radians(2.0)
"""A hinge that turns less is not what the cylinders are for."""


@dataclass(frozen=True)
class Row:
    """An actuator, which way its hinge turns (±1), whether it steers a wheel (its angles are from the drawn pose), and
    the least and the largest angle (degrees), the speed (degrees/s) and the torque (times weight and length); None
    where those say nothing."""

    actuator: str
    sense: int
    steers: bool
    usual: tuple[float, float, float, float] | None


def measured(mechanism: Mechanism) -> Iterator[Row]:
    """The rows of a machine's actuators with cylinders."""
    template = load_template(mechanism.equipment_type)
    chain = ClosedChain(mechanism)
    hulls = {body.name: np.asarray(body.hull) for body in mechanism.bodies}
    tree = hinges(mechanism)
    every = np.concatenate([hull for hull in hulls.values() if len(hull)])
    scale = GRAVITY * sum(body.mass for body in mechanism.bodies) * float(np.linalg.norm(np.ptp(every, axis=0)))
    bodies = {j.name: (j.body0, j.body1) for j in mechanism.joints if j.type == "revolute"}
    moved = {actuator.name: actuator for actuator in mechanism.actuators}
    claimed: set[str | None] = set()
    for entry in (a for a in template.actuators if a.cylinders and a.name in moved):
        actuator = moved[entry.name]
        hinge = hinge_of(template, entry, bodies, lambda b: float(np.linalg.norm(np.ptp(hulls[b], axis=0))), claimed)
        claimed.add(hinge)
        if not actuator.cylinders:
            continue
        slide = mechanism.joint(actuator.joints[0].joint)
        if hinge not in tree or slide.lower is None or slide.upper is None or slide.drive is None:
            continue
        grid = explore(chain, {slide.name: (slide.lower, slide.upper)}, points=POINTS)
        order = np.argsort(grid.values[:, 0])
        way = grid.values[order, 0]
        rotations, _ = chain.placements(grid.states)
        joint = mechanism.joint(hinge)
        turn = np.unwrap(joint_values(chain, grid, joint, rotations)[order])
        # A joint turns its second body against its first.
        turn = turn * sense(tree[hinge].axis) * (1.0 if joint.body1 == tree[hinge].after else -1.0)
        steers = _steers(mechanism, tree[hinge])
        drawn = 0.0 if steers else angle_of(hinge, tree, hulls.__getitem__)
        if np.ptp(turn) < LEAST:
            continue
        positive = int(np.sign(turn[-1] - turn[0])) * actuator.joints[0].sign
        if drawn is None:
            yield Row(actuator.name, positive, steers, None)
            continue
        turn += drawn - np.interp(0.0, way, turn)
        rates = np.abs(np.gradient(turn, way))
        back, out = slide.drive.speeds
        seconds = max(0.5 * np.ptp(way) * (1.0 / back + 1.0 / out), FASTEST)
        torque = slide.drive.strongest / float(np.median(rates)) / scale
        if torque > STRONGEST:
            yield Row(actuator.name, positive, steers, None)
            continue
        # The outer wheel of a turn goes less far than the inner one: two that turn alike go as far as their mean.
        half = 0.5 * float(np.ptp(turn))
        low, high = np.degrees([-half, half] if steers else [turn.min(), turn.max()])
        speed = float(np.degrees(np.ptp(turn)) / seconds)
        yield Row(actuator.name, positive, steers, (low, high, speed, torque))


def _steers(mechanism: Mechanism, hinge: Turned) -> bool:
    """Whether it turns a knuckle: one wheel rolls on what it turns, about an upright axis."""
    wheels = rolling(mechanism)
    own = [j for j in mechanism.joints if hinge.after in (j.body0, j.body1) and {j.body0, j.body1} & wheels]
    return abs(hinge.axis[2]) > UPRIGHT and len(own) == 1


def hinges(mechanism: Mechanism) -> dict[str, Turned]:
    """Its hinges, cut ones too, as they stand without cylinders: each from the body that is nearer to the root."""
    halves = {half for c in mechanism.cylinders if c.pins for half in (c.barrel, c.rod)}
    joints = [j for j in mechanism.joints if not halves & {j.body0, j.body1}]
    reached, found = {mechanism.root}, {}
    while True:
        beyond = [j for j in joints if (j.body0 in reached) != (j.body1 in reached)]
        for joint in beyond:
            before, after = (joint.body0, joint.body1) if joint.body0 in reached else (joint.body1, joint.body0)
            if joint.type == "revolute":
                found[joint.name] = Turned(np.asarray(joint.anchor), np.asarray(joint.axis), before, after)
        if not beyond:
            return found
        reached |= {body for joint in beyond for body in (joint.body0, joint.body1)}


def main() -> None:
    found: dict[str, dict[str, list[Row]]] = {}
    for file in sys.argv[1:]:
        mechanism = read_mechanism(file)
        for row in measured(mechanism):
            found.setdefault(mechanism.equipment_type, {}).setdefault(row.actuator, []).append(row)
            sys.stdout.write(f"{mechanism.name} {row}\n")
    for kind, rows in found.items():
        table = {name: entry for name, own in rows.items() if (entry := _entry(own))}
        path = ROOT / "src/yellowiron/library/data" / kind / "hinges.json"
        lines = ",\n".join(f'  "{name}": {json.dumps(row)}' for name, row in table.items())
        path.write_text("{\n" + lines + "\n}\n", encoding="utf-8")


def _entry(rows: Sequence[Row]) -> dict[str, object]:
    """What the document says of an actuator; nothing where its hinge moves as any might."""
    sense = {"sense": -1} if sum(row.sense for row in rows) < 0 else {}
    usual = [row.usual for row in rows if row.usual is not None]
    if not usual:
        return sense
    low, high, speed, torque = np.mean(usual, axis=0).tolist()
    counted = {"from": "drawn"} if any(row.steers for row in rows) else {}
    kept = {"speed": float(f"{speed:.2g}"), "torque": float(f"{torque:.2g}")}
    return {"low": round(low), "high": round(high), **counted, **sense, **kept}


if __name__ == "__main__":
    main()
