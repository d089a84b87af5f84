"""The truth about the drawn crane: what each part is, where each joint is, what linkage and shapes give. CAD frame,
metres."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np

from drawing.cylinders import Cylinder
from drawing.planar import Point
from drawing.product import Assembly, extent, occurrences
from drawing.steer_axle import steering_joints
from drawing.truth import CadFrame, Joints, Triple, document, value_rows
from drawing.wheels import wheel_places

from . import values as v
from .boom import BODIES
from .carrier import DECK, ENDS, beam_ram, jack, place_of
from .linkage import HALF_BASE, RADIUS, P, Pose, solve_axle
from .linkage import values as linked

FRAME = CadFrame((1_000.0, 0.0, 0.0), x=(0.0, 1.0, 0.0), z=(0.0, 0.0, 1.0))
"""From a point of the drawing office's: x to the left, y backward, z up."""
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def _high(p: Point) -> Triple:
    return float(p[0]), 0.0, float(p[1])


def joints(pose: Pose, pins: dict[str, tuple[Point, Point]]) -> dict[str, dict[str, Any]]:
    """Every joint of the crane."""
    found, treads = Joints(FRAME), {"front": (HALF_BASE, v.TREAD.value), "rear": (-HALF_BASE, v.TREAD.value)}
    places = wheel_places(treads, RADIUS)
    for end in ("front", "rear"):
        steering_joints(found, solve_axle(end))
        for letter, sign in (("l", 1.0), ("r", -1.0)):
            wheel, name = f"{end}_wheel_{letter}", f"{end}_outrigger"
            found.pivot(f"{end}_knuckle_{letter}", wheel, places[wheel], name=f"{wheel}_joint")
            x, y = place_of(end, letter, pose)
            found.slide("carrier", f"{name}_beam_{letter}", (x, 0.0, 600.0), (0.0, sign, 0.0))
            found.slide(f"{name}_beam_{letter}", f"{name}_jack_{letter}", (x, y, 500.0), (0.0, 0.0, -1.0))
    found.pivot("carrier", "superstructure", (0.0, 0.0, DECK), Z)
    found.pivot("superstructure", "boom", _high(P))
    found.cylinder("luffing", "", ("superstructure", "boom"), *(_high(p) for p in pins["luffing"]), Y)
    along = (math.cos(pose.boom), 0.0, math.sin(pose.boom))
    for one, other in itertools.pairwise(BODIES):
        found.slide(one, other, _high(P), along)
    found.cylinder("telescope", "", ("boom", "middle_boom"), *(_high(p) for p in pins["telescope"]), Y)
    found.ball("inner_boom", "hoist_rope", _high(pose.head))
    found.slide("hoist_rope", "hook_block", _high(pose.head), (0.0, 0.0, -1.0))
    return found.found


def drawn_values(root: Assembly, pose: Pose) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.body in bodies])

    carrier, wheels = of("carrier"), of("front_wheel_l", "front_wheel_r")
    behind = of("superstructure")
    return {
        v.WHEELBASE.name: float(of("front_wheel_l").mean(0)[0] - of("rear_wheel_l").mean(0)[0]),
        v.HEIGHT.name: float(behind[1, 2]),
        v.WIDTH.name: float(np.ptp(carrier[:, 1])),
        v.CLEARANCE.name: float(carrier[0, 2]),
        v.TYRE.name: float(np.ptp(wheels[:, 2])),
        v.BASE.name: ENDS["front"] - ENDS["rear"],
    }


def truth(
    root: Assembly, pose: Pose, drawn: dict[str, Cylinder], pins: dict[str, tuple[Point, Point]]
) -> dict[str, Any]:
    """The document written as `truth.json`."""
    slides: dict[str, Any] = {f"{n}_cylinder_barrel2{n}_piston_rod_joint": c.slide() for n, c in drawn.items()}
    for end in ("front", "rear"):
        slides[f"carrier2{end}_steering_piston_rod_joint"] = solve_axle(end).ram().slide()
        for letter in "lr":
            name = f"{end}_outrigger"
            out, low = pose.beam * v.BEAM_STROKE.value, pose.jack * v.JACK_STROKE.value
            slides[f"carrier2{name}_beam_{letter}_joint"] = beam_ram(out).slide()
            slides[f"{name}_beam_{letter}2{name}_jack_{letter}_joint"] = jack(low).slide()
    values = value_rows([*v.PUBLISHED, *v.EXAMPLE], linked(), drawn_values(root, pose))
    return document(FRAME, root, joints(pose, pins), slides, values)
