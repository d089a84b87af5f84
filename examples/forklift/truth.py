"""The truth about the drawn machine: what each part is, where each joint is, what the drawing gives. CAD frame,
metres."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from drawing.cylinders import Cylinder
from drawing.product import Assembly, extent, occurrences
from drawing.truth import CadFrame, value_rows

from . import values as v
from .mast import FACE, FREE_RAM, PIVOT, RAM, Mast, free_ram, lift_ram, tilt_pin_y
from .steer_axle import AXLE

FRAME = CadFrame((-900.0, 0.0, 300.0), x=(1.0, 0.0, 0.0), z=(0.0, -1.0, 0.0))
"""From a point of the drawing office's: x forward, y up, z to the right."""
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def joints(mast: Mast, tilt: tuple[float, float], anchor: tuple[float, float]) -> dict[str, dict[str, Any]]:
    """Every joint of the machine, by name; slides point outwards, pitch axes to the left."""
    out: dict[str, dict[str, Any]] = {}

    def add(a: str, b: str, at: tuple[float, float, float], axis: tuple[float, float, float] = Y, name: str = "",
            kind: str = "revolute") -> None:  # fmt: skip
        entry = {"type": kind, "body0": a, "body1": b, "anchor": FRAME.point(at), "axis": FRAME.axis(axis)}
        out[name or f"{a}2{b}_joint"] = entry

    r = v.TYRE_DIAMETER.value / 2
    add("chassis", "outer_mast", (PIVOT[0], 0, PIVOT[1]))
    add("chassis", "steer_axle", (AXLE.x, 0, AXLE.z), X)
    y = tilt_pin_y(mast)
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        barrel, piston = f"tilt_cylinder_barrel_{letter}", f"tilt_piston_rod_{letter}"
        add("chassis", barrel, (anchor[0], sign * y, anchor[1]))
        add("outer_mast", piston, (tilt[0], sign * y, tilt[1]))
        along = (tilt[0] - anchor[0], 0.0, tilt[1] - anchor[1])
        add(barrel, piston, (anchor[0], sign * y, anchor[1]), along, kind="prismatic")
        wheels = (("front", "chassis", 0.0, v.FRONT_TREAD), ("rear", f"knuckle_{letter}", AXLE.x, v.REAR_TREAD))
        for end, on, x, tread in wheels:
            wheel = f"{end}_wheel_{letter}"
            add(on, wheel, (x, sign * tread.value / 2, r), name=f"{wheel}_joint")
        add("steer_axle", f"knuckle_{letter}", (AXLE.x, sign * AXLE.king, AXLE.z), Z)
        add(f"knuckle_{letter}", f"tie_rod_{letter}", (AXLE.arm[0], sign * AXLE.arm[1], AXLE.ram_z), Z)
        add("steering_piston_rod", f"tie_rod_{letter}", (AXLE.end[0], sign * AXLE.end[1], AXLE.ram_z), Z)
    add("steer_axle", "steering_piston_rod", (AXLE.end[0], 0, AXLE.ram_z), Y, kind="prismatic")
    lifted = mast.body(mast.stages - 2)
    add("outer_mast", lifted, (RAM[0], 0, RAM[2]), Z, kind="prismatic")
    if mast.stages == 3:
        add("middle_mast", "inner_mast", (FACE, 0, 0), Z, kind="prismatic")
    if mast.has_free_lift:
        add("inner_mast", "free_lift_crosshead", FREE_RAM, Z, kind="prismatic")
    name = "inner_mast2carriage_joint"
    add("inner_mast", "carriage", (FACE, 0, 0), Z, name, "prismatic")
    return out


def truth(
    root: Assembly, mast: Mast, tilt: tuple[float, float], anchor: tuple[float, float], cylinder: Cylinder
) -> dict[str, Any]:
    """The document written as `truth.json`."""
    leaves = occurrences(root)

    def named(*names: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.part.name.startswith(names)])

    def of(*bodies: str) -> Any:
        return extent([leaf for leaf in leaves if leaf.body in bodies])

    masts = of("outer_mast", "middle_mast", "inner_mast")
    raised = mast.lift * (1 if mast.stages == 2 else 2)
    carriage = of("carriage")[1, 2] - mast.rise(-1)
    full = (1 if mast.kind == "duplex" else 2) * mast.stroke + (2 * v.FREE_STROKE.value if mast.has_free_lift else 0.0)
    drawn = {
        v.LOWERED_HEIGHT.name: float(masts[1, 2] - raised),
        v.EXTENDED_HEIGHT.name: float(carriage + full),
        v.LIFT_HEIGHT.name: full,
        v.GUARD_HEIGHT.name: float(named("GUARD ROOF")[1, 2]),
        v.LENGTH_TO_FORK.name: float(FACE - of("chassis")[0, 0]),
        v.OVERALL_LENGTH.name: float(named("FORK LH")[1, 0] - of("chassis")[0, 0]),
        v.OVERALL_WIDTH.name: float(np.ptp(named("TYRE")[:, 1])),
        v.CARRIAGE_WIDTH.name: float(np.ptp(of("carriage")[:, 1])),
        v.MAST_CLEARANCE.name: float(of("outer_mast")[0, 2]),
    }
    slides = {f"tilt_cylinder_barrel_{s}2tilt_piston_rod_{s}_joint": cylinder.slide() for s in "lr"}
    slides["steer_axle2steering_piston_rod_joint"] = AXLE.ram().slide()
    slides[f"outer_mast2{mast.body(mast.stages - 2)}_joint"] = lift_ram(mast).slide()
    if mast.has_free_lift:
        slides["inner_mast2free_lift_crosshead_joint"] = free_ram(mast).slide()
    half = v.STEER_STROKE.value / 2
    return {
        "about": "CAD frame, metres. A part's key is its product names from the root joined by '/', in tree "
        "order; the second of two equal keys ends in '#2', the third in '#3'.",
        "frame": FRAME.matrix(),
        "mast": mast.kind,
        "joints": joints(mast, tilt, anchor),
        "parts": {leaf.path: {"body": leaf.body, "role": leaf.role} for leaf in leaves},
        "cylinders": slides,
        "knuckles": {
            "rod to the left": [round(math.degrees(AXLE.knuckle_angle(half, side)), 6) for side in (1.0, -1.0)],
            "rod to the right": [round(math.degrees(AXLE.knuckle_angle(-half, side)), 6) for side in (1.0, -1.0)],
        },
        "values": value_rows((*v.PUBLISHED, *v.EXAMPLE), {}, drawn),
    }  # fmt: skip
