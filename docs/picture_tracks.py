"""Draws docs/excavator_tracks.webp: the example with every shoe a body, driving in MuJoCo, every twelfth shoe marked.

Run after `yellowiron build excavator --cad examples/excavator/excavator.step --specs
examples/excavator/specifications.pdf --tracks shoes --out out/excavator_shoes`: `python docs/picture_tracks.py`.
"""

from __future__ import annotations

import json
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
from PIL import Image

from yellowiron.cad import read_cad
from yellowiron.exporters import BodyGeometry, Geometry, actuator_names, export_mjcf, read_geometry
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism, chained, rolling
from yellowiron.report.html.pictures import encode, look_at, machine_triangles, posed, render
from yellowiron.usd import read_mechanism

ROOT = Path(__file__).resolve().parent.parent
TIMES = (0.0, 0.8, 1.6, 2.4)
SPEED, RAMP = 2.0, 0.5
"""rad/s of the sprockets, and the seconds in which they reach it."""
MARKED, EVERY = "track_shoe_l_", 12


def drive(mechanism: Mechanism, geometry: Geometry) -> list[dict[str, Floats]]:
    """Displacements (4, 4) of every body from its drawn pose at each of `TIMES`; says how fast it ran."""
    bare = Geometry({n: BodyGeometry((), b.colliders) for n, b in geometry.bodies.items()}, geometry.filtered)
    with tempfile.TemporaryDirectory() as folder:
        export_mjcf(mechanism, bare, Path(folder))
        model = mujoco.MjModel.from_xml_path(f"{folder}/scene.xml")
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    names = actuator_names(mechanism)
    motors = [model.actuator(control).id for name in ("travel_left", "travel_right") for control in names[name]]
    seen, begun = [], time.process_time()
    for moment in TIMES:
        while data.time < moment:
            data.ctrl[motors] = SPEED * min(1.0, data.time / RAMP)
            mujoco.mj_step(model, data)
        places = {}
        for body in mechanism.bodies:
            number = model.body(body.name).id
            places[body.name] = np.eye(4)
            places[body.name][:3, :3] = data.xmat[number].reshape(3, 3)
            places[body.name][:3, 3] = data.xpos[number] - places[body.name][:3, :3] @ np.asarray(body.origin)
        seen.append(places)
        ways = (places[mechanism.root][0, 3], places[f"{MARKED}1"][0, 3])
        share = moment / (time.process_time() - begun)
        sys.stderr.write(f"{moment} s: machine {ways[0]:.3f} m, its shoe {ways[1]:.3f} m, {share:.3f} of real time\n")
    return seen


def main() -> None:
    """Drives the machine and writes the picture."""
    out = ROOT / "out" / "excavator_shoes"
    file = Path(sys.argv[1]) if len(sys.argv) > 1 else out / "excavator.usda"
    mechanism = read_mechanism(file)
    assembly = read_cad(ROOT / "examples" / "excavator" / "excavator.step")
    frame = np.array(json.loads((file.parent / "report.json").read_text(encoding="utf-8"))["frame"])
    seen = drive(mechanism, read_geometry(file))
    wanted = (chained(mechanism) | rolling(mechanism) | {mechanism.root}) - {"upperstructure"}
    left = [b for b in mechanism.bodies if b.name in wanted and (b.name == mechanism.root or b.origin[1] > 0.0)]
    drawn = machine_triangles(replace(mechanism, bodies=tuple(left)), assembly, frame)
    colors = drawn.colors.copy()
    for name, (first, last) in drawn.spans.items():
        if name.startswith(MARKED):
            marked = int(name.removeprefix(MARKED)) % EVERY == 1
            colors[first:last] = (0.8, 0.05, 0.02) if marked else (0.3, 0.3, 0.32)
        elif name == mechanism.root:
            colors[first:last] = (0.55, 0.4, 0.1)
    drawn = replace(drawn, colors=colors)
    corners = [posed(drawn, places).corners.reshape(-1, 3) for places in (seen[0], seen[-1])]
    camera = look_at(np.concatenate(corners), azimuth=1.45, elevation=0.16, width=900, height=250)
    pictures = [render(posed(drawn, places), camera, supersample=3) for places in seen]
    strip = Image.new("RGB", (camera.width, camera.height * len(pictures)))
    for number, picture in enumerate(pictures):
        strip.paste(picture, (0, number * camera.height))
    (ROOT / "docs" / "excavator_tracks.webp").write_bytes(encode(strip, quality=80))


if __name__ == "__main__":
    main()
