"""Draws a crawler excavator of the Komatsu PC210LC-11 class as one STEP assembly, and the truth about it.

`python -m excavator.draw [folder]`, run in `examples/`, writes `excavator.step` and `truth.json`; the same bytes every
time. The values it is drawn to are in `values.py`, where its pins are in `linkage.py`, its shoes in `track.py`. It
knows nothing of what is later made of the file.
"""

from __future__ import annotations

import json
import logging
import sys
from pathlib import Path

from OCP.gp import gp_Trsf

from drawing.cylinders import Cylinder, draw_cylinder
from drawing.digger import Linkage, Pose
from drawing.hardware import placed
from drawing.planar import direction
from drawing.product import Assembly, Use, write_step

from . import values as v
from .bucket import draw_bucket, draw_bucket_link, draw_tipping_links
from .cab import draw_cab
from .equipment import CYLINDER_Y, PIN_C, PIN_E, PIN_M, draw_arm, draw_boom
from .linkage import solve
from .track import solve_track
from .truth import frame, truth
from .undercarriage import draw_undercarriage
from .upper import draw_counterweight, draw_frame, draw_hood, draw_rails, draw_tanks

BOOM_DRAWN = v.BOOM_CLOSED.value + 0.62 * v.BOOM_STROKE.value
ARM_DRAWN = v.ARM_CLOSED.value + 0.40 * v.ARM_STROKE.value
BUCKET_DRAWN = v.BUCKET_CLOSED.value + 0.62 * v.BUCKET_STROKE.value
"""Cylinder lengths in the file: neither end of a stroke, the bucket clear of the ground."""


def boom_cylinder(side: str) -> Cylinder:
    """Sizes of a boom cylinder."""
    return Cylinder(
        f"BOOM CYLINDER {side}",
        v.BOOM_BORE.value,
        v.BOOM_ROD.value,
        v.BOOM_STROKE.value,
        v.BOOM_CLOSED.value,
        BOOM_DRAWN,
        outside=158,
        pin=PIN_C,
        eye=80,
        eye_width=110,
        base=165,
        cap=40,
        piston=95,
        gland=110,
    )


def arm_cylinder() -> Cylinder:
    """Sizes of the arm cylinder."""
    return Cylinder(
        "ARM CYLINDER",
        v.ARM_BORE.value,
        v.ARM_ROD.value,
        v.ARM_STROKE.value,
        v.ARM_CLOSED.value,
        ARM_DRAWN,
        outside=170,
        pin=PIN_M,
        eye=88,
        eye_width=124,
        base=168,
        cap=45,
        piston=105,
        gland=120,
    )


def bucket_cylinder() -> Cylinder:
    """Sizes of the bucket cylinder."""
    return Cylinder(
        "BUCKET CYLINDER",
        v.BUCKET_BORE.value,
        v.BUCKET_ROD.value,
        v.BUCKET_STROKE.value,
        v.BUCKET_CLOSED.value,
        BUCKET_DRAWN,
        outside=148,
        pin=PIN_E,
        eye=76,
        eye_width=110,
        base=152,
        cap=40,
        piston=90,
        gland=105,
    )


def drawn_pose() -> tuple[Linkage, Pose]:
    """Linkage and its pose in the file."""
    k = solve()
    return k, k.pose(BOOM_DRAWN, ARM_DRAWN, BUCKET_DRAWN)


def draw_cylinders(pose: Pose, k: Linkage) -> Assembly:
    """The four cylinders, in one assembly as the parts book has them."""
    tree = Assembly("HYDRAULIC CYLINDERS")

    def put(child: Assembly, at: gp_Trsf, barrel: str, piston_rod: str) -> None:
        child.name += " ASSY"
        tree.uses.append(Use(child, at, names={"barrel": barrel, "rod": piston_rod}))

    for letter, y in (("l", CYLINDER_Y), ("r", -CYLINDER_Y)):
        at = placed((k.C[0], y, k.C[1]), direction(pose.D - k.C))
        cylinder = draw_cylinder(boom_cylinder(f"{letter.upper()}H"))
        put(cylinder, at, f"boom_cylinder_barrel_{letter}", f"boom_piston_rod_{letter}")
    at = placed((pose.M[0], 0, pose.M[1]), direction(pose.P - pose.M))
    put(draw_cylinder(arm_cylinder()), at, "arm_cylinder_barrel", "arm_piston_rod")
    at = placed((pose.E[0], 0, pose.E[1]), direction(pose.H - pose.E))
    put(draw_cylinder(bucket_cylinder(), pin_fast_in_rod=True), at, "bucket_cylinder_barrel", "bucket_piston_rod")
    return tree


def draw_machine() -> Assembly:
    """The whole product tree, in the machine frame."""
    k, pose = drawn_pose()
    hardware = Assembly("PINS AND BOLTS")
    root = Assembly("HYDRAULIC EXCAVATOR GA")
    upper = Assembly("UPPER STRUCTURE")
    upper.add(draw_frame(k, hardware))
    upper.add(draw_counterweight(hardware))
    for part in (draw_hood, draw_tanks, draw_cab, draw_rails):
        upper.add(part())
    work = Assembly("WORK EQUIPMENT")
    work.add(draw_boom(k, pose, hardware))
    work.add(draw_arm(k, pose, hardware))
    work.add(draw_tipping_links(k, pose, hardware))
    work.add(draw_bucket_link(k, pose))
    work.add(draw_bucket(k, pose, hardware))
    for child in (draw_undercarriage(solve_track(), hardware), upper, work, draw_cylinders(pose, k), hardware):
        root.add(child)
    return root


def main(folder: Path) -> None:
    """Writes both files into `folder`."""
    root = draw_machine()
    write_step(root, folder / "excavator.step", cad=frame().to_cad())
    k, pose = drawn_pose()
    cylinders = {"boom": boom_cylinder(""), "arm": arm_cylinder(), "bucket": bucket_cylinder()}
    document = truth(root, k, pose, cylinders)
    (folder / "truth.json").write_text(json.dumps(document, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    logging.getLogger(__name__).info("%d parts", len(document["parts"]))


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
