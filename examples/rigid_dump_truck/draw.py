"""Draws a rigid dump truck of the Cat 773F class as one STEP assembly, its sheet, and the truth about it.

`python -m rigid_dump_truck.draw FOLDER`, run in `examples/`, writes `rigid_dump_truck.step`, `specifications.pdf` and
`truth.json`; the same bytes every time. The values it is drawn to are in `values.py`.
"""

from __future__ import annotations

from pathlib import Path

from drawing.cylinders import Cylinder, draw_pairs
from drawing.files import run, write_example
from drawing.product import Assembly
from drawing.solids import Vector
from drawing.wheels import WheelSizes, draw_dual, draw_wheel, put_wheels

from . import values as v
from .chassis import PIN_HOIST, PIN_STEER, REAR_SPINDLE, SPINDLE, draw_axles, draw_frame, draw_knuckles, draw_top
from .dump_body import draw_body
from .layout import APART, HOIST_Y, RADIUS, STEER_Z, solve_hoist, solve_steering
from .sheet import write
from .truth import FRAME, WHEELS, truth

HOISTED = 0.2
"""How far out the hoist cylinders are drawn, as a share of their stroke; the steering stands straight."""


def cylinders() -> dict[str, Cylinder]:
    """Sizes of a steering and a hoist cylinder, at their drawn lengths."""
    return {
        "steering": Cylinder(
            "STRG CYL", v.STEER_BORE.value, v.STEER_ROD.value, v.STEER_STROKE.value, v.STEER_CLOSED.value,
            solve_steering().length(0.0), outside=174, pin=PIN_STEER, eye=50, eye_width=70, base=105, cap=30,
            piston=60, gland=75, port=14.0,
        ),
        "hoist": Cylinder(
            "HOIST CYL", v.HOIST_BORE.value, v.HOIST_ROD.value, v.HOIST_STROKE.value, v.HOIST_CLOSED.value,
            v.HOIST_CLOSED.value + HOISTED * v.HOIST_STROKE.value, outside=320, pin=PIN_HOIST, eye=90,
            eye_width=160, base=170, cap=45, piston=110, gland=130, port=14.0,
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
    hardware, root, wheels = Assembly("PINS"), Assembly("RIGID TRUCK GA"), Assembly("WHEELS")
    front = WheelSizes(v.TYRE_SIZE, RADIUS, v.TYRE_WIDTH.value, 445.0, SPINDLE, circle=300.0, bolts=14)
    rear = WheelSizes(v.TYRE_SIZE, RADIUS, v.TYRE_WIDTH.value, 445.0, REAR_SPINDLE, circle=300.0, bolts=14)
    for end, wheel in (("front", draw_wheel(front)), ("rear", draw_dual(rear, APART))):
        put_wheels(wheels, wheel, {body: at for body, at in WHEELS.items() if body.startswith(end)})
    chassis = Assembly("CHASSIS")
    for child in (draw_frame(hardware), draw_axles(hardware), draw_top()):
        chassis.add(child)
    body = draw_body(raised(), hardware)
    for child in (chassis, draw_knuckles(hardware), body, wheels, draw_pairs(cylinders(), pins()), hardware):
        root.add(child)
    return root


def main(folder: Path) -> None:
    """Writes the three files into `folder`."""
    root = draw_machine()
    write_example(folder, "rigid_dump_truck", root, FRAME, truth(root, raised(), cylinders()), write)


if __name__ == "__main__":
    run(main, __file__)
