"""The truth about the drawn roller: what each part is, where each joint is, what layout and shapes give. CAD frame,
metres."""

from __future__ import annotations

from typing import Any

import numpy as np

from drawing.cylinders import Cylinder
from drawing.product import Assembly, extent, occurrences
from drawing.truth import CadFrame, Joints, document, twin_slides, value_rows
from drawing.wheels import wheel_places

from . import values as v
from .layout import DRUM, ROLL_Z, STEER_Z, front_x, measured, rear_x, solve_steering

FRAME = CadFrame((0.0, 0.0, DRUM), x=(0.0, 1.0, 0.0), z=(0.0, 0.0, 1.0))
"""From the articulation at the height of the drum's axis, as the drawing office of this example has it: x to the
left, z up, y backwards."""
X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)


def wheels(m: v.Machine) -> dict[str, tuple[float, float, float]]:
    """Wheel → its middle."""
    return {} if m.tyre is None else wheel_places({"rear": (rear_x(m), m.tyre[2].value)}, m.tyre[0].value / 2)


def joints(m: v.Machine) -> dict[str, dict[str, Any]]:
    """Every joint of the roller."""
    found, steering = Joints(FRAME), solve_steering()
    found.pivot("rear_frame", "hitch", (0, 0, STEER_Z), Z)
    found.pivot("hitch", "front_frame", (0, 0, ROLL_Z), X)
    found.pivot("front_frame", "front_drum", (front_x(m), 0, DRUM), name="front_drum_joint")
    if m.tyre is None:
        found.pivot("rear_frame", "rear_drum", (rear_x(m), 0, DRUM), name="rear_drum_joint")
    for wheel, at in wheels(m).items():
        found.pivot("rear_frame", wheel, at, name=f"{wheel}_joint")
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        p, q = ((float(at[0]), sign * float(at[1]), STEER_Z) for at in (steering.P, steering.Q))
        found.cylinder("steering", f"_{letter}", ("rear_frame", "hitch"), p, q, Z)
    return found.found


def drawn_values(root: Assembly, m: v.Machine) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)
    every = extent(leaves)
    shell = extent([leaf for leaf in leaves if leaf.body == "front_drum" and leaf.part.name.startswith("DRUM SHELL")])
    frames = [leaf for leaf in leaves if leaf.body in ("front_frame", "hitch", "rear_frame")]
    front, rear = ([leaf for leaf in frames if leaf.body == f"{end}_frame"] for end in ("front", "rear"))
    length, width, _ = np.ptp(every, axis=0)
    found = {
        m.length.name: float(length),
        m.width.name: float(width),
        m.height.name: float(extent(rear)[1, 2]),
        m.ground.name: float(extent(frames)[0, 2]),
        v.CURB_CLEARANCE.name: float(extent(front)[0, 2]),
        v.DRUM_WIDTH.name: float(np.ptp(shell[:, 1])),
        v.DRUM_DIAMETER.name: float(np.ptp(shell[:, 2])),
    }
    if m.tyre is not None:
        tyres = extent([leaf for leaf in leaves if leaf.part.name.startswith("TYRE")])
        found[m.tyre[0].name] = float(np.ptp(tyres[:, 2]))
    return found


def truth(root: Assembly, m: v.Machine, drawn: dict[str, Cylinder]) -> dict[str, Any]:
    """The document written as `truth.json`."""
    values = value_rows(m.values, measured(m), drawn_values(root, m))
    return document(FRAME, root, joints(m), twin_slides(drawn), values)
