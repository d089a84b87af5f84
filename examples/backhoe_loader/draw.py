"""Draws a backhoe loader of the JCB 3CX class as one STEP assembly, its sheet, and the truth about it.

`python -m backhoe_loader.draw FOLDER`, run in `examples/`, writes `backhoe_loader.step`, `specifications.pdf` and
`truth.json`; the same bytes every time. The values it is drawn to are in `values.py`.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from pathlib import Path

from drawing import loader
from drawing.cylinders import Cylinder, draw_cylinder, put_pair
from drawing.digger import Linkage, Pose
from drawing.files import run, write_example
from drawing.hardware import placed
from drawing.planar import Point, direction
from drawing.product import Assembly, Use
from drawing.solids import Vector
from drawing.stabiliser import RAISED, draw_stabilisers, put_stabiliser_cylinders
from drawing.steer_axle import draw_steer_axle
from drawing.wheels import WheelSizes, draw_wheel, put_wheels, wheel_places

from . import values as v
from .backhoe import ROD_PIN, draw_boom, draw_bucket, draw_dipper, draw_extension, draw_links, draw_post, out
from .chassis import LEG_X, LIFT_Y, REAR_SPINDLE, draw_frame, draw_rear, draw_top
from .linkage import (
    FRONT_RADIUS,
    FRONT_X,
    HALF_ARC,
    REAR_RADIUS,
    SWING_X,
    SWING_Z,
    drawn_in,
    solve_axle,
    solve_backhoe,
    solve_loader,
    solve_stabiliser,
    solve_swing,
)
from .loader import draw_arms, draw_rocker
from .loader import draw_bucket as draw_shovel
from .sheet import write
from .truth import FRAME, truth

SHARES = {
    "loader_lift": 0.22, "loader_bucket": 0.6, "boom": 0.9, "dipper": 0.5, "extension": 0.2, "backhoe_bucket": 0.6,
    "stabilizer": 0.15,
}  # fmt: skip
"""How far out the cylinders are drawn: neither end of a stroke, both buckets clear of the ground, straight ahead."""
_SIZES: dict[str, tuple[str, str, tuple[float, ...]]] = {
    "loader_lift": ("LOADER LIFT CYL", "LIFT", (108, 55, 44, 56, 85, 28, 50, 60)),
    "loader_bucket": ("LOADER BUCKET CYL", "TILT", (102, 60, 48, 80, 92, 30, 55, 65)),
    "boom": ("BOOM CYL", "BOOM", (140, 70, 50, 68, 95, 30, 60, 70)),
    "dipper": ("DIPPER CYL", "DIPPER", (120, 70, 48, 68, 95, 30, 55, 65)),
    "extension": ("EXTENSION CYL", "EXTENSION", (76, 40, 34, 56, 60, 20, 40, 50)),
    "backhoe_bucket": ("HOE BUCKET CYL", "BUCKET", (118, 55, 40, 66, 78, 24, 48, 58)),
    "swing": ("SWING CYL", "SWING", (102, 45, 38, 60, 72, 24, 48, 58)),
    "stabilizer": ("STABILISER CYL", "STABILISER", (98, 40, 34, 46, 58, 20, 42, 46)),
}
"""Name, prefix of its values; outside, pin, eye, eye's width, base, cap, piston, gland in millimetres."""


@functools.cache
def cylinders() -> dict[str, Cylinder]:
    """Sizes of a cylinder of each kind, at its drawn length."""
    swing, leg = solve_swing(), solve_stabiliser()
    found = {}
    for name, (title, key, sizes) in _SIZES.items():
        bore, rod, stroke = (getattr(v, f"{key}_{what}").value for what in ("BORE", "ROD", "STROKE"))
        closed = {"swing": swing.length(-HALF_ARC), "stabilizer": leg.length(RAISED)}.get(name)
        closed = getattr(v, f"{key}_CLOSED").value if closed is None else closed
        drawn = swing.length(0.0) if name == "swing" else closed + SHARES[name] * stroke
        outside, pin, eye, width, base, cap, piston, gland = sizes
        found[name] = Cylinder(
            title, bore, rod, stroke, closed, drawn, outside=outside, pin=pin, eye=eye, eye_width=width, base=base,
            cap=cap, piston=piston, gland=gland, port=10.0,
        )  # fmt: skip
    return found


@dataclass(frozen=True, slots=True, eq=False)
class Drawn:
    """The linkages as they stand in the file: the loader's, the backhoe's with its dipper as far out as it is."""

    shovel: loader.Linkage
    arms: loader.Pose
    hoe: Linkage
    pose: Pose
    leg: float

    @property
    def extension(self) -> tuple[Point, Point]:
        """The extension cylinder's pins, on the dipper's line."""
        unit = (self.pose.K - self.pose.B) / self.hoe.arm
        barrel = v.DIPPER_LENGTH.value - ROD_PIN - v.EXTENSION_CLOSED.value
        return self.pose.B + barrel * unit, self.pose.K - ROD_PIN * unit


@functools.cache
def drawn() -> Drawn:
    """How the machine stands in the file."""
    sizes, shovel = cylinders(), solve_loader()
    hoe = drawn_in(solve_backhoe(), (1.0 - SHARES["extension"]) * v.EXTENSION_STROKE.value)
    arms = shovel.pose(sizes["loader_lift"].drawn, sizes["loader_bucket"].drawn)
    pose = hoe.pose(*(sizes[name].drawn for name in ("boom", "dipper", "backhoe_bucket")))
    return Drawn(shovel, arms, hoe, pose, solve_stabiliser().angle(sizes["stabilizer"].drawn))


def draw_cylinders(d: Drawn) -> Assembly:
    """All cylinders, in one assembly as a parts book has them."""
    tree, made = Assembly("HYDRAULIC CYLINDERS"), {name: draw_cylinder(size) for name, size in cylinders().items()}
    hoe, pose = d.hoe, d.pose

    def put(name: str, at: object, side: str = "") -> None:
        halves = {"barrel": f"{name}_cylinder_barrel{side}", "rod": f"{name}_piston_rod{side}"}
        tree.uses.append(Use(made[name], at, names=halves))

    def high(p: Point, y: float) -> Vector:
        return float(p[0]), y, float(p[1])

    put_pair(tree, made["loader_lift"], "loader_lift", high(d.shovel.C, LIFT_Y), high(d.arms.D, LIFT_Y))
    e = d.shovel.E
    put("loader_bucket", placed((float(e[0]), 0.0, float(e[1])), direction(d.arms.F - e)))
    for name, start, end in (
        ("boom", hoe.C, pose.D), ("dipper", pose.M, pose.P), ("extension", *d.extension),
        ("backhoe_bucket", pose.E, pose.H),
    ):  # fmt: skip
        put(name, out(start, direction(end - start)))
    swing = solve_swing()
    put_pair(
        tree,
        made["swing"],
        "swing",
        *((SWING_X + float(p[0]), float(p[1]), SWING_Z) for p in (swing.barrel, swing.rod(0.0))),
    )
    put_stabiliser_cylinders(tree, made["stabilizer"], solve_stabiliser(), d.leg, sum(LEG_X) / 2)
    return tree


def draw_machine() -> Assembly:
    """The whole product tree, in the machine frame."""
    d, hardware, root, wheels = drawn(), Assembly("PINS"), Assembly("BACKHOE LOADER GA"), Assembly("WHEELS")
    sizes = {
        "front": WheelSizes("12.5-18", FRONT_RADIUS, v.FRONT_TYRE_WIDTH.value, 180.0, 45.0, 118.0, 8, inner=92.0),
        "rear": WheelSizes("16.9-28", REAR_RADIUS, v.REAR_TYRE_WIDTH.value, 290.0, REAR_SPINDLE, 190.0, 10),
    }
    places = wheel_places({"front": (FRONT_X, v.FRONT_TREAD.value), "rear": (0.0, v.REAR_TREAD.value)}, 0.0)
    for end, size in sizes.items():
        own = {body: (x, y, size.radius) for body, (x, y, _) in places.items() if body.startswith(end)}
        put_wheels(wheels, draw_wheel(size), own)
    chassis, shovel, hoe = Assembly("CHASSIS"), Assembly("LOADER"), Assembly("BACKHOE")
    for child in (draw_frame(hardware), draw_rear(hardware), draw_top()):
        chassis.add(child)
    for part in (draw_arms, draw_rocker, draw_shovel):
        shovel.add(part(d.shovel, d.arms, hardware))
    hoe.add(draw_post(d.hoe, hardware))
    for draw in (draw_boom, draw_dipper, draw_extension, draw_links, draw_bucket):
        hoe.add(draw(d.hoe, d.pose, hardware))
    axle, legs = draw_steer_axle(solve_axle(), hardware), draw_stabilisers(solve_stabiliser(), d.leg, LEG_X, hardware)
    for child in (chassis, axle, shovel, hoe, legs, wheels, draw_cylinders(d), hardware):
        root.add(child)
    return root


def main(folder: Path) -> None:
    """Writes the three files into `folder`."""
    root = draw_machine()
    write_example(folder, "backhoe_loader", root, FRAME, truth(root, drawn(), cylinders()), write)


if __name__ == "__main__":
    run(main, __file__)
