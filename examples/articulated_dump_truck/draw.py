"""Draws an articulated dump truck of the Cat 740 GC class as one STEP assembly, its sheet, and the truth about it.

`python -m articulated_dump_truck.draw FOLDER`, run in `examples/`, writes `articulated_dump_truck.step`,
`specifications.pdf` and `truth.json`; the same bytes every time. The values it is drawn to are in `values.py`.
"""

from __future__ import annotations

from pathlib import Path

from drawing.cylinders import Cylinder, draw_pairs
from drawing.files import run, write_example
from drawing.product import Assembly
from drawing.solids import Vector
from drawing.wheels import WheelSizes, draw_wheel, put_wheels

from . import values as v
from .dump_body import draw_body
from .layout import HOIST_Y, RADIUS, STEER_Z, solve_hoist, solve_steering
from .sheet import write
from .tractor import draw_axle, draw_cab, draw_frame, draw_power
from .trailer import HOIST_EYE, PIN_HOIST, PIN_STEER, SPINDLE, draw_bogie, draw_hitch, draw_rear_frame
from .truth import FRAME, WHEELS, truth

HOISTED = 0.25
"""How far out the hoist cylinders are drawn, as a share of their stroke; the steering stands straight."""


def cylinders() -> dict[str, Cylinder]:
    """Sizes of a steering and a hoist cylinder, at their drawn lengths."""
    return {
        "steering": Cylinder(
            "STRG CYL", v.STEER_BORE.value, v.STEER_ROD.value, v.STEER_STROKE.value, v.STEER_CLOSED.value,
            solve_steering().length(0.0), outside=155, pin=PIN_STEER, eye=50, eye_width=80, base=105, cap=32,
            piston=65, gland=80, port=14.0,
        ),
        "hoist": Cylinder(
            "HOIST CYL", v.HOIST_BORE.value, v.HOIST_ROD.value, v.HOIST_STROKE.value, v.HOIST_CLOSED.value,
            v.HOIST_CLOSED.value + HOISTED * v.HOIST_STROKE.value, outside=230, pin=PIN_HOIST, eye=85,
            eye_width=HOIST_EYE, base=160, cap=40, piston=100, gland=120, port=16.0,
        ),
    }  # fmt: skip


def raised() -> float:
    """How far the body is raised in the file, radians."""
    return solve_hoist().raised(cylinders()["hoist"].drawn)


def pins() -> dict[str, tuple[Vector, Vector]]:
    """Where the left cylinders hang, barrel and rod."""
    p, q = ((float(at[0]), float(at[1]), STEER_Z) for at in (solve_steering().P, solve_steering().Q))
    return {"steering": (p, q), "hoist": solve_hoist().pins(raised(), HOIST_Y)}


def draw_machine() -> Assembly:
    """The whole product tree, in the machine frame."""
    hardware, root, wheels = Assembly("PINS"), Assembly("ARTICULATED TRUCK GA"), Assembly("WHEELS")
    sizes = WheelSizes(v.TYRE_SIZE, RADIUS, v.TYRE_WIDTH.value, 318.0, SPINDLE, circle=235.0, bolts=12)
    put_wheels(wheels, draw_wheel(sizes), WHEELS)
    tractor, trailer = Assembly("TRACTOR"), Assembly("TRAILER")
    for child in (draw_frame(hardware), draw_axle(), draw_power(), draw_cab()):
        tractor.add(child)
    for child in (draw_rear_frame(hardware), draw_bogie()):
        trailer.add(child)
    body = draw_body(raised(), hardware)
    for child in (tractor, draw_hitch(hardware), trailer, body, wheels, draw_pairs(cylinders(), pins()), hardware):
        root.add(child)
    return root


def main(folder: Path) -> None:
    """Writes the three files into `folder`."""
    root = draw_machine()
    document = truth(root, raised(), cylinders())
    write_example(folder, "articulated_dump_truck", root, FRAME, document, write)


if __name__ == "__main__":
    run(main, __file__)
