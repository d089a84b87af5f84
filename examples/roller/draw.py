"""Draws a tandem roller of the Volvo DD128C class, or a soil compactor with a single drum, as one STEP assembly, its
sheet, and the truth about it.

`python -m roller.draw FOLDER`, run in `examples/`, writes `roller.step`, `specifications.pdf` and `truth.json`; the
same bytes every time. The values it is drawn to are in `values.py`; `main(folder, "single")` draws the other one.
"""

from __future__ import annotations

import functools
from pathlib import Path

from drawing.cylinders import Cylinder, draw_pairs
from drawing.files import run, write_example
from drawing.product import Assembly
from drawing.solids import Vector
from drawing.wheels import WheelSizes, draw_wheel, put_wheels

from . import values as v
from .drum import draw_drum, draw_frame, draw_scrapers, draw_tank
from .layout import STEER_Z, front_x, rear_x, solve_steering
from .sheet import write
from .tractor import PIN_STEER, SPINDLE, draw_axle, draw_hitch, draw_rear_frame, draw_superstructure
from .truth import FRAME, truth, wheels


def cylinders() -> dict[str, Cylinder]:
    """Sizes of a steering cylinder, at its drawn length: the steering stands straight."""
    return {
        "steering": Cylinder(
            "STRG CYL", v.STEER_BORE.value, v.STEER_ROD.value, v.STEER_STROKE.value, v.STEER_CLOSED.value,
            solve_steering().length(0.0), outside=100, pin=PIN_STEER, eye=40, eye_width=60, base=80, cap=28,
            piston=45, gland=60, port=10.0,
        )
    }  # fmt: skip


def pins() -> dict[str, tuple[Vector, Vector]]:
    """Where the left cylinder hangs, barrel and rod."""
    p, q = ((float(at[0]), float(at[1]), STEER_Z) for at in (solve_steering().P, solve_steering().Q))
    return {"steering": (p, q)}


def draw_machine(m: v.Machine) -> Assembly:
    """The whole product tree, in the machine frame."""
    hardware, root, rolling = Assembly("PINS"), Assembly("ROLLER GA"), Assembly("DRUMS AND WHEELS")
    front, rear = front_x(m), rear_x(m)
    rolling.add(draw_drum("front_drum", front))
    drum_end, tractor = Assembly("DRUM MODULE"), Assembly("TRACTOR")
    for child in (draw_frame("front_frame", front, tube=True), draw_scrapers("front_frame", front, 1.0)):
        drum_end.add(child)
    drum_end.add(draw_tank("front_frame", front))
    tractor.add(draw_rear_frame(m, hardware))
    if m.tyre is None:
        rolling.add(draw_drum("rear_drum", rear))
        tractor.add(draw_frame(BODY, rear))
        tractor.add(draw_scrapers(BODY, rear, -1.0))
    else:
        sizes = WheelSizes(v.TYRE_SIZE, m.tyre[0].value / 2, m.tyre[1].value, 330.0, SPINDLE, circle=200.0, bolts=8)
        put_wheels(rolling, draw_wheel(sizes), wheels(m))
        tractor.add(draw_axle(m))
    tractor.add(draw_superstructure(m))
    for child in (drum_end, draw_hitch(hardware), tractor, rolling, draw_pairs(cylinders(), pins()), hardware):
        root.add(child)
    return root


BODY = "rear_frame"


def main(folder: Path, kind: str = "tandem") -> None:
    """Writes the three files of the tandem or the single-drum machine into `folder`."""
    m = v.MACHINES[kind]
    root = draw_machine(m)
    write_example(folder, "roller", root, FRAME, truth(root, m, cylinders()), functools.partial(write, m=m))


if __name__ == "__main__":
    run(main, __file__)
