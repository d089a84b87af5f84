"""Draws docs/wheel_loader.webp, the README's picture: the example as drawn, and by body with the bucket raised.

Run after `make demo`: `python docs/picture.py`.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from PIL import Image

from yellowiron.cad import read_cad
from yellowiron.kinematics import ClosedChain
from yellowiron.report.html.pictures import contact_sheet, encode, look_at, machine_triangles, render
from yellowiron.usd import read_mechanism

ROOT = Path(__file__).resolve().parent.parent


def main() -> None:
    """Reads the demo's result and writes the picture."""
    out = ROOT / "out" / "wheel_loader"
    mechanism = read_mechanism(out / "wheel_loader.usda")
    assembly = read_cad(ROOT / "examples" / "wheel_loader" / "wheel_loader.step")
    frame = np.array(json.loads((out / "report.json").read_text(encoding="utf-8"))["frame"])
    chain = ClosedChain(mechanism)
    actuators = {a.name: a.joints[0].joint for a in mechanism.actuators}
    boom = mechanism.joint(actuators["boom"])
    steering = mechanism.joint(actuators["steering"])
    targets = {boom.name: 0.9 * (boom.upper or 0.0), steering.name: 0.6 * (steering.lower or 0.0)}
    state, _ = chain.reach(targets)
    raised = {body.name: chain.displacement(state, body.name) for body in mechanism.bodies}
    pictures: list[Image.Image] = []
    for poses in ({}, raised):
        drawn = machine_triangles(mechanism, assembly, frame, poses=poses)
        camera = look_at(drawn.corners.reshape(-1, 3), azimuth=-0.8, elevation=0.28, width=760, height=560)
        colors = drawn.by_body(mechanism) if poses else None
        pictures.append(render(drawn, camera, colors=colors, supersample=3))
    (ROOT / "docs" / "wheel_loader.webp").write_bytes(encode(contact_sheet(pictures), quality=88))


if __name__ == "__main__":
    main()
