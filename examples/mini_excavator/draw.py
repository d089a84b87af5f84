"""Draws a mini excavator of the JCB 8008 CTS class, with swing boom and blade, as one STEP assembly, its sheet, and the
truth about it.

`python -m mini_excavator.draw FOLDER`, run in `examples/`, writes `mini_excavator.step`, `specifications.pdf` and
`truth.json`; the same bytes every time. The values it is drawn to are in `values.py`. It knows nothing of what is later
made of the file.
"""

from __future__ import annotations

import functools
from pathlib import Path

from OCP.gp import gp_Trsf

from drawing.cylinders import Cylinder, draw_cylinder
from drawing.digger import Linkage, Pose
from drawing.files import run, write_example
from drawing.hardware import placed
from drawing.planar import Point, direction
from drawing.product import Assembly, Use
from drawing.solids import frame

from . import values as v
from .carrier import draw_blade, draw_bracket, draw_undercarriage, draw_upper
from .equipment import draw_arm, draw_boom, draw_bucket, draw_links
from .linkage import BLADE_BARREL, STROKES, SWING_Z, solve, solve_blade, solve_swing
from .sheet import write
from .truth import FRAME, truth

SHARES = {"boom": 0.62, "arm": 0.4, "bucket": 0.62, "blade": 0.45}
"""How far out the cylinders are drawn: neither end of a stroke, the bucket clear of the ground, the boom straight
ahead."""
_SIZES: dict[str, tuple[float, ...]] = {
    "boom": (68, 30, 30, 44, 65, 18, 35, 45),
    "arm": (62, 30, 28, 44, 62, 18, 35, 45),
    "bucket": (56, 25, 25, 40, 58, 16, 32, 40),
    "swing": (50, 22, 22, 40, 50, 14, 28, 36),
    "blade": (62, 25, 26, 44, 58, 16, 32, 40),
}
"""Outside, pin, eye, eye's width, base, cap, piston, gland; millimetres."""


@functools.cache
def cylinders() -> dict[str, Cylinder]:
    """The five cylinders' sizes, at their drawn lengths."""
    closed = {"boom": STROKES.boom[0], "arm": STROKES.arm[0], "bucket": STROKES.bucket[0]}
    closed |= {"swing": solve_swing().closed, "blade": solve_blade().closed}
    found = {}
    for name, sizes in _SIZES.items():
        bore, rod, stroke = (getattr(v, f"{name.upper()}_{what}").value for what in ("BORE", "ROD", "STROKE"))
        drawn = solve_swing().length(0.0) if name == "swing" else closed[name] + SHARES[name] * stroke
        outside, pin, eye, width, base, cap, piston, gland = sizes
        found[name] = Cylinder(
            f"{'BOOM SWING' if name == 'swing' else name.upper()} CYLINDER",
            bore, rod, stroke, closed[name], drawn, outside=outside, pin=pin, eye=eye, eye_width=width, base=base,
            cap=cap, piston=piston, gland=gland, port=8.0,
        )  # fmt: skip
    return found


def drawn_pose() -> tuple[Linkage, Pose]:
    """The digger's linkage and its pose in the file."""
    k, sizes = solve(), cylinders()
    return k, k.pose(*(sizes[name].drawn for name in ("boom", "arm", "bucket")))


def draw_cylinders(pose: Pose, k: Linkage) -> Assembly:
    """All cylinders, in one assembly as a parts book has them."""
    tree = Assembly("HYDRAULIC CYLINDERS")
    blade, swing = solve_blade(), solve_swing()

    def upright(start: Point, end: Point) -> gp_Trsf:
        return placed((start[0], 0, start[1]), direction(end - start))

    along = swing.rod(0.0) - swing.barrel
    places = {
        "boom": upright(k.C, pose.D),
        "arm": upright(pose.M, pose.P),
        "bucket": upright(pose.E, pose.H),
        "blade": upright(BLADE_BARREL, blade.pins(blade.angle(cylinders()["blade"].drawn))[0]),
        # Drawn with its pins along y, which stand upright here.
        "swing": frame((*swing.barrel, SWING_Z), (along[0], along[1], 0.0), (along[1], -along[0], 0.0)),
    }
    for name, at in places.items():
        child = draw_cylinder(cylinders()[name], pin_fast_in_rod=name == "bucket")
        child.name += " ASSY"
        halves = {"barrel": f"{name}_cylinder_barrel", "rod": f"{name}_piston_rod"}
        tree.uses.append(Use(child, at, names=halves))
    return tree


def draw_machine() -> Assembly:
    """The whole product tree, in the machine frame."""
    k, pose = drawn_pose()
    blade, swing = solve_blade(), solve_swing()
    hardware, root = Assembly("PINS"), Assembly("MINI EXCAVATOR GA")
    work = Assembly("WORK EQUIPMENT")
    work.add(draw_bracket(k, swing, hardware))
    for part in (draw_boom, draw_arm, draw_links, draw_bucket):
        work.add(part(k, pose, hardware))
    root.add(draw_undercarriage(hardware))
    root.add(draw_blade(blade, blade.angle(cylinders()["blade"].drawn), hardware))
    for child in (draw_upper(swing, hardware), work, draw_cylinders(pose, k), hardware):
        root.add(child)
    return root


def main(folder: Path) -> None:
    """Writes the three files into `folder`."""
    root = draw_machine()
    write_example(folder, "mini_excavator", root, FRAME, truth(root, *drawn_pose(), cylinders()), write)


if __name__ == "__main__":
    run(main, __file__)
