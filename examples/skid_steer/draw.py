"""Draws a skid steer loader of the Bobcat S76 class as one STEP assembly, its sheet, and the truth about it.

`python -m skid_steer.draw FOLDER`, run in `examples/`, writes `skid_steer.step`, `specifications.pdf` and `truth.json`;
the same bytes every time. The values it is drawn to are in `values.py`. `draw_machine("radial")` draws it with arms on
one pivot instead of two links a side.
"""

from __future__ import annotations

from pathlib import Path

from drawing.cylinders import Cylinder, draw_cylinder
from drawing.files import run, write_example
from drawing.hardware import placed
from drawing.planar import direction, rot
from drawing.product import Assembly, Use
from drawing.wheels import put_wheels, wheel_places

from . import values as v
from .chassis import WHEEL_Y, draw_cab, draw_engine, draw_frame, draw_wheel
from .equipment import LIFT_Y, PIN, TILT_PIN, TILT_Y, draw_arms, draw_bucket, draw_links
from .linkage import AXLE_X, RADIUS, LiftPath, Linkage, solve
from .sheet import write
from .truth import FRAME, truth

LIFTED, TILTED = 0.22, 0.3
"""How far out the cylinders are drawn, as shares of their strokes: neither end, the bucket clear of the ground."""


def cylinders(k: Linkage) -> dict[str, Cylinder]:
    """Sizes of a lift and a tilt cylinder, at their drawn lengths."""
    closed = k.lift(0.0)
    return {
        "boom": Cylinder(
            "LIFT CYL", v.LIFT_BORE.value, v.LIFT_ROD.value, v.LIFT_STROKE.value, closed,
            closed + LIFTED * v.LIFT_STROKE.value, outside=84, pin=PIN, eye=40, eye_width=50, base=70, cap=24,
            piston=45, gland=55, port=10.0,
        ),
        "bucket": Cylinder(
            "TILT CYL", v.TILT_BORE.value, v.TILT_ROD.value, v.TILT_STROKE.value, v.TILT_CLOSED.value,
            v.TILT_CLOSED.value + TILTED * v.TILT_STROKE.value, outside=86, pin=TILT_PIN, eye=30, eye_width=44, base=60,
            cap=22, piston=40, gland=50, port=10.0,
        ),
    }  # fmt: skip


def pose(k: Linkage) -> tuple[float, float]:
    """How far the arms are turned as drawn, and the bucket's angle to them; radians."""
    sizes = cylinders(k)
    return k.turned(sizes["boom"].drawn), k.angle(sizes["bucket"].drawn)


def draw_cylinders(k: Linkage) -> Assembly:
    """The four cylinders, in one assembly as a parts book has them."""
    tree, sizes = Assembly("HYDRAULIC CYLINDERS"), cylinders(k)
    lifted, tilted = pose(k)
    ends = {
        "boom": (k.C, k.carry(lifted, k.D), LIFT_Y),
        "bucket": (k.carry(lifted, k.E), k.carry(lifted, k.B) + rot(lifted + tilted, k.J), TILT_Y),
    }
    for name, (start, end, y) in ends.items():
        child = draw_cylinder(sizes[name])
        for letter, sign in (("l", 1.0), ("r", -1.0)):
            at = placed((float(start[0]), sign * y, float(start[1])), direction(end - start))
            halves = {"barrel": f"{name}_cylinder_barrel_{letter}", "rod": f"{name}_piston_rod_{letter}"}
            tree.uses.append(Use(child, at, names=halves))
    return tree


def draw_machine(path: LiftPath = "vertical") -> Assembly:
    """The whole product tree, in the machine frame."""
    k = solve(path)
    lifted, tilted = pose(k)
    hardware, root, wheels = Assembly("PINS"), Assembly("SKID STEER GA"), Assembly("WHEELS")
    treads = {"front": (AXLE_X, 2 * WHEEL_Y), "rear": (-AXLE_X, 2 * WHEEL_Y)}
    put_wheels(wheels, draw_wheel(), wheel_places(treads, RADIUS))
    loader = Assembly("LOADER")
    loader.add(draw_arms(k, lifted, hardware))
    if path == "vertical":
        loader.add(draw_links(k, lifted))
    loader.add(draw_bucket(k, lifted, tilted, hardware))
    for child in (draw_frame(k, hardware), draw_engine(k), draw_cab(), wheels, loader, draw_cylinders(k), hardware):
        root.add(child)
    return root


def main(folder: Path, path: LiftPath = "vertical") -> None:
    """Writes the three files into `folder`."""
    root, k = draw_machine(path), solve(path)
    write_example(folder, "skid_steer", root, FRAME, truth(root, k, pose(k), cylinders(k)), write)


if __name__ == "__main__":
    run(main, __file__)
