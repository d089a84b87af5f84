"""Draws a crawler crane of the Hitachi Sumitomo SCX500 class, its basic boom on, as one STEP assembly, its sheet, and
the truth about it: with the boom up, or lowered.

`python -m crawler_crane.draw FOLDER`, run in `examples/`, writes `crawler_crane.step`, `specifications.pdf` and
`truth.json`; the same bytes every time. The values it is drawn to are in `values.py`.
"""

from __future__ import annotations

import math
from pathlib import Path

from drawing.files import run, write_example
from drawing.product import Assembly

from .boom import draw_boom, draw_boom_hoist, draw_hoist
from .carrier import draw_superstructure, draw_undercarriage
from .linkage import Pose
from .sheet import write
from .truth import FRAME, truth

POSES = {"working": Pose(math.radians(73.0)), "lowered": Pose(math.radians(30.0))}


def draw_machine(pose: Pose) -> Assembly:
    """The whole product tree, in the machine frame."""
    hardware, root, boom = Assembly("PINS"), Assembly("CRAWLER CRANE GA"), Assembly("BOOM GP")
    for part in (draw_boom(pose, hardware), draw_boom_hoist(pose), draw_hoist(pose)):
        boom.add(part)
    for child in (draw_undercarriage(), draw_superstructure(hardware), boom, hardware):
        root.add(child)
    return root


def main(folder: Path, kind: str = "working") -> None:
    """Writes the three files of the crane, its boom `working` or `lowered`, into `folder`."""
    pose = POSES[kind]
    root = draw_machine(pose)
    write_example(folder, "crawler_crane", root, FRAME, truth(root, pose), write)


if __name__ == "__main__":
    run(main, __file__)
