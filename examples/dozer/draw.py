"""Draws a dozer of the Cat D6 class with a six-way blade as one STEP assembly, its sheet, and the truth about it.

`python -m dozer.draw FOLDER`, run in `examples/`, writes `dozer.step`, `specifications.pdf` and `truth.json`; the same
bytes every time. The values it is drawn to are in `values.py`.
"""

from __future__ import annotations

import functools
from pathlib import Path

from drawing.cylinders import Cylinder, draw_cylinder
from drawing.files import run, write_example
from drawing.product import Assembly, Use
from drawing.solids import Vector, X, Z, frame, turn

from . import values as v
from .carrier import LIFT_EYE, LIFT_PIN, draw_cab, draw_frame, draw_power, draw_undercarriage
from .equipment import ANGLE_PIN, TILT_PIN, carried, draw_blade, draw_c_frame, draw_link
from .linkage import ANGLE_FOOT, LIFT_FOOT, LIFTED, raised, solve, turn_for
from .sheet import write
from .truth import FRAME, truth

UP = turn_for(LIFTED)
"""How far the C-frame is turned up in the file."""


@functools.cache
def cylinders() -> dict[str, Cylinder]:
    """Sizes of a cylinder of each kind, at its drawn length."""
    k = solve()
    lengths = {"lift": k.lift_length(UP)}
    lengths |= {name: k.closed(name) + getattr(v, f"{name.upper()}_STROKE").value / 2 for name in ("tilt", "angle")}
    sizes = {
        "lift": (118, LIFT_PIN, 46, LIFT_EYE, 150, 28, 55, 65),
        "tilt": (142, TILT_PIN, 46, 72, 120, 32, 60, 65),
        "angle": (98, ANGLE_PIN, 36, 48, 65, 24, 48, 55),
    }
    found = {}
    for name, (outside, pin, eye, width, base, cap, piston, gland) in sizes.items():
        bore, rod, stroke = (getattr(v, f"{name.upper()}_{what}").value for what in ("BORE", "ROD", "STROKE"))
        found[name] = Cylinder(
            f"{name.upper()} CYL", bore, rod, stroke, k.closed(name), lengths[name], outside=outside, pin=pin, eye=eye,
            eye_width=width, base=base, cap=cap, piston=piston, gland=gland, port=12.0,
        )  # fmt: skip
    return found


def draw_cylinders() -> Assembly:
    """All five, in one assembly as a parts book has them: the lift cylinders with level pins, the others carried with
    the C-frame, their pins upright on it."""
    tree, k = Assembly("HYDRAULIC CYLINDERS"), solve()
    at = carried(UP)

    def put(child: Assembly, name: str, start: Vector, end: Vector, *, upright: bool) -> None:
        along = (end[0] - start[0], end[1] - start[1], end[2] - start[2])
        place = frame(start, along, Z if upright else (-along[2], 0.0, along[0]))
        place = at.Multiplied(place).Multiplied(turn(X, 90.0)) if upright else place
        side = f"_{name[-1]}" if name[-2:] in ("_l", "_r") else ""
        base = name.removesuffix(side) if side else name
        halves = {"barrel": f"{base}_cylinder_barrel{side}", "rod": f"{base}_piston_rod{side}"}
        tree.uses.append(Use(child, place, names=halves))

    def three(p: object) -> Vector:
        x, y, z = (float(c) for c in p)  # type: ignore[attr-defined]
        return (x, y, z)

    lift, tilt, angle = (draw_cylinder(cylinders()[name]) for name in ("lift", "tilt", "angle"))
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        mirror = (1.0, sign, 1.0)
        put(lift, f"lift_{letter}", three(LIFT_FOOT * mirror), three(raised(UP, k.lift_eye) * mirror), upright=False)
        put(angle, f"angle_{letter}", three(ANGLE_FOOT * mirror), three(k.angle_eye * mirror), upright=True)
    put(tilt, "tilt", three(k.tilt_foot), three(k.tilt_eye), upright=True)
    return tree


def draw_machine() -> Assembly:
    """The whole product tree, in the machine frame."""
    k, sizes = solve(), cylinders()
    hardware, root, work = Assembly("PINS"), Assembly("DOZER GA"), Assembly("BLADE EQUIPMENT")
    work.add(draw_c_frame(k, UP, hardware, sizes))
    work.add(draw_link(UP, hardware))
    work.add(draw_blade(k, UP, hardware, sizes))
    for child in (
        draw_undercarriage(), draw_frame(hardware), draw_power(), draw_cab(), work, draw_cylinders(), hardware,
    ):  # fmt: skip
        root.add(child)
    return root


def main(folder: Path) -> None:
    """Writes the three files into `folder`."""
    root = draw_machine()
    write_example(folder, "dozer", root, FRAME, truth(root, solve(), UP, cylinders()), write)


if __name__ == "__main__":
    run(main, __file__)
