"""The truth about the drawn crane: what each part is, where each joint is, what linkage and shapes give. CAD frame,
metres."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from drawing.planar import Point
from drawing.product import Assembly, extent, farthest, occurrences
from drawing.truth import CadFrame, Joints, Triple, document, value_rows

from . import values as v
from .carrier import SEAT, TRACK
from .linkage import G, P, Pose
from .linkage import values as linked

FRAME = CadFrame((1_000.0, 0.0, 0.0), x=(0.0, 1.0, 0.0), z=(0.0, 0.0, 1.0))
"""From a point of the drawing office's: x to the left, y backward, z up."""
Z = (0.0, 0.0, 1.0)


def _high(p: Point) -> Triple:
    return float(p[0]), 0.0, float(p[1])


def joints(pose: Pose) -> dict[str, dict[str, Any]]:
    """Every joint of the crane; `when` names the choice that a joint belongs to."""
    found = Joints(FRAME)
    for letter, y in (("l", TRACK.side), ("r", -TRACK.side)):
        for body, x in ((f"sprocket_{letter}", -TRACK.half), (f"idler_{letter}", TRACK.half)):
            found.pivot("undercarriage", body, (x, y, TRACK.axle))
        for row, places in TRACK.rollers().items():
            for i, (x, z) in enumerate(places, 1):
                name = f"undercarriage2{row}_{letter}_joint_{i}"
                found.pivot("undercarriage", f"{row}_{letter}_{i}", (x, y, z), name=name)
        shoe, pins = f"track_shoe_{letter}", TRACK.pins()
        for i in range(1, len(pins) + 1):
            after = i % len(pins) + 1
            x, z = pins[after - 1]
            found.pivot(f"{shoe}_{i}", f"{shoe}_{after}", (x, y, z), name=f"{shoe}2{shoe}_joint_{i}")
    for entry in found.found.values():
        entry["when"] = {"tracks": "shoes"}
    found.pivot("undercarriage", "superstructure", (0.0, 0.0, SEAT), Z)
    found.pivot("superstructure", "boom", _high(P))
    found.pivot("superstructure", "boom_hoist_rope", _high(G))
    found.pivot("boom", "boom_pendant", _high(pose.pendant))
    along = (math.cos(pose.line), 0.0, math.sin(pose.line))
    found.slide("boom_hoist_rope", "boom_pendant", _high(G), along)
    found.ball("boom", "hoist_rope", _high(pose.head))
    found.slide("hoist_rope", "hook_block", _high(pose.head), (0.0, 0.0, -1.0))
    return found.found


def drawn_values(root: Assembly) -> dict[str, float]:
    """What the drawn shapes give, by the value's name; millimetres."""
    leaves = occurrences(root)

    def of(*bodies: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.body.startswith(bodies)])

    def named(name: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.part.name.startswith(name)])

    shoes, left = of("track_shoe"), of("track_shoe_l")
    return {
        v.TAIL.name: farthest([leaf for leaf in leaves if leaf.part.name == "COUNTERWEIGHT"], {}),
        v.GANTRY.name: float(of("superstructure")[1, 2]),
        v.WIDTH.name: float(np.ptp(shoes[:, 1])),
        v.TRACK.name: float(np.ptp(left[:, 0])),
        v.SHOE.name: float(np.ptp(left[:, 1])),
        v.GAUGE.name: float(left.mean(0)[1] - of("track_shoe_r").mean(0)[1]),
        v.ON_GROUND.name: float(of("idler_l").mean(0)[0] - of("sprocket_l").mean(0)[0]),
        v.CLEARANCE.name: float(named("CARBODY")[0, 2]),
    }


def truth(root: Assembly, pose: Pose) -> dict[str, Any]:
    """The document written as `truth.json`."""
    values = value_rows([*v.PUBLISHED, *v.EXAMPLE], linked(), drawn_values(root))
    return document(FRAME, root, joints(pose), {}, values, undercarriage_with=TRACK.bodies())
