"""Draws a wheel loader of the Komatsu WA475-10 class as one STEP assembly, and the truth about it.

`python -m wheel_loader.draw [folder]`, run in `examples/`, writes `wheel_loader.step` and `truth.json`; the same bytes
every time. The values it is drawn to are in `values.py`, where its pins are in `linkage.py`. It knows nothing of what
is later made of the file.
"""

from __future__ import annotations

from pathlib import Path

from OCP.gp import gp_Trsf

from drawing.articulation import Steering
from drawing.cylinders import Cylinder, draw_cylinder
from drawing.files import run, write_example
from drawing.hardware import placed
from drawing.loader import Pose
from drawing.planar import direction
from drawing.product import GREY, Assembly, Use
from drawing.solids import X, Z, frame, shift, turn

from . import values as v
from .frames import (
    PIN_C,
    PIN_E,
    PIN_STEER,
    PIN_TRUNNION,
    STEER_Z,
    draw_counterweight,
    draw_front_fenders,
    draw_front_frame,
    draw_rear_frame,
)
from .front_end import draw_boom, draw_bucket, draw_link, draw_rocker, heel_x
from .linkage import Linkage, solve, solve_steering
from .superstructure import draw_cab, draw_hood, draw_power_train, draw_sides
from .truth import FRAME, truth
from .wheels import draw_front_axle, draw_rear_axle, draw_wheel

LIFT_DRAWN = v.LIFT_CLOSED.value + 0.30 * v.LIFT_STROKE.value
TILT_DRAWN = v.TILT_CLOSED.value + 0.58 * v.TILT_STROKE.value
"""Cylinder lengths in the file: neither end of a stroke, the bucket clear of the ground."""
LIFT_Y = 450.0
"""Lateral distance of the lift cylinders."""


def lift_cylinder() -> Cylinder:
    """Sizes of a lift cylinder."""
    return Cylinder(
        "LIFT CYL",
        v.LIFT_BORE.value,
        v.LIFT_ROD.value,
        v.LIFT_STROKE.value,
        v.LIFT_CLOSED.value,
        LIFT_DRAWN,
        outside=184,
        pin=PIN_C,
        eye=80,
        eye_width=110,
        base=130,
        cap=35,
        piston=90,
        gland=110,
    )


def tilt_cylinder() -> Cylinder:
    """Sizes of the bucket cylinder."""
    return Cylinder(
        "Tilt cyl",
        v.TILT_BORE.value,
        v.TILT_ROD.value,
        v.TILT_STROKE.value,
        v.TILT_CLOSED.value,
        TILT_DRAWN,
        outside=220,
        pin=PIN_E,
        eye=95,
        eye_width=130,
        base=155,
        cap=35,
        piston=105,
        gland=125,
    )


def steering_cylinder(drawn: float) -> Cylinder:
    """Sizes of a steering cylinder."""
    return Cylinder(
        "ST CYL",
        v.STEER_BORE.value,
        v.STEER_ROD.value,
        v.STEER_STROKE.value,
        v.STEER_CLOSED.value,
        drawn,
        outside=120,
        pin=PIN_STEER,
        eye=48,
        eye_width=80,
        base=90,
        cap=28,
        piston=60,
        gland=75,
        colour=GREY,
    )


def drawn_pose() -> tuple[Linkage, Pose, Steering]:
    """Linkage, its pose in the file, and the steering."""
    k = solve()
    return k, k.pose(LIFT_DRAWN, TILT_DRAWN), solve_steering()


def draw_hydraulics(k: Linkage, pose: Pose, s: Steering) -> Assembly:
    """The five cylinders, in one assembly as the parts book has them."""
    tree = Assembly("HYDRAULICS")

    def put(child: Assembly, at: gp_Trsf, barrel: str, piston_rod: str) -> None:
        tree.uses.append(Use(child, at, names={"barrel": barrel, "rod": piston_rod}))

    lift = draw_cylinder(lift_cylinder())
    lift.name = "LIFT CYL ASSY"
    for letter, y in (("l", LIFT_Y), ("r", -LIFT_Y)):
        at = placed((k.C[0], y, k.C[1]), direction(pose.D - k.C))
        put(lift, at, f"boom_cylinder_barrel_{letter}", f"boom_piston_rod_{letter}")
    tilt = draw_cylinder(tilt_cylinder(), pin_fast_in_rod=True)
    tilt.name = "TILT CYL ASSY"
    put(
        tilt,
        placed((k.E[0], 0, k.E[1]), direction(pose.F - k.E)),
        "bucket_cylinder_barrel",
        "bucket_piston_rod",
    )
    steer = draw_cylinder(steering_cylinder(s.length(0.0)))
    steer.name = "STRG CYL ASSY"
    for letter, sign in (("l", 1.0), ("r", -1.0)):
        p, along = s.P, s.Q - s.P
        at = frame((p[0], sign * p[1], STEER_Z), (along[0], sign * along[1], 0.0), (0.0, 0.0, 1.0)).Multiplied(
            turn(X, 90.0)
        )
        put(steer, at, f"steering_cylinder_barrel_{letter}", f"steering_piston_rod_{letter}")
    return tree


def draw_machine() -> Assembly:
    """The whole product tree, in the machine frame."""
    k, pose, s = drawn_pose()
    carry = k.pose(k.lift_for_hinge(v.HINGE_HEIGHT_CARRY.value), v.TILT_CLOSED.value + v.TILT_STROKE.value)
    hardware = Assembly("HARDWARE")
    root = Assembly("WHEEL LOADER GA")

    front = Assembly("FRONT MACHINE")
    front.add(draw_front_frame(k, s, hardware))
    front.add(draw_front_fenders())
    axle = draw_front_axle()
    front.add(axle)
    work = Assembly("WORK EQUIPMENT")
    work.add(draw_boom(k, pose, hardware))
    work.add(draw_rocker(k, pose, hardware))
    work.add(draw_link(k, pose, hardware))
    work.add(draw_bucket(k, pose, heel_x(k, carry), hardware))
    rear = Assembly("REAR MACHINE")
    rear.add(draw_rear_frame(s, hardware))
    rear_axle = draw_rear_axle(PIN_TRUNNION)
    rear.add(rear_axle)
    for part in (draw_power_train, draw_hood, draw_cab, draw_sides):
        rear.add(part())
    rear.add(draw_counterweight(hardware))

    wheel = draw_wheel()
    half, x, z = v.TREAD.value / 2, v.WHEELBASE.value / 2, v.TYRE_DIAMETER.value / 2
    for end, sign in (("front", 1.0), ("rear", -1.0)):
        group = axle if sign > 0 else rear_axle
        left = shift(sign * x, half, z)
        right = shift(sign * x, -half, z).Multiplied(turn(Z, 180.0))
        group.uses.append(Use(wheel, left, names={"wheel": f"{end}_wheel_l"}))
        group.uses.append(Use(wheel, right, names={"wheel": f"{end}_wheel_r"}))
    for child in (front, rear, work, draw_hydraulics(k, pose, s), hardware):
        root.add(child)
    return root


def main(folder: Path) -> None:
    """Writes both files into `folder`."""
    root = draw_machine()
    k, pose, s = drawn_pose()
    cylinders = {"lift": lift_cylinder(), "tilt": tilt_cylinder(), "steer": steering_cylinder(s.length(0.0))}
    document = truth(root, k, pose, s, cylinders, STEER_Z, LIFT_Y)
    write_example(folder, "wheel_loader", root, FRAME, document)


if __name__ == "__main__":
    run(main, __file__)
