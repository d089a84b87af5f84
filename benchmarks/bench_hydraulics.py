"""Levers through the oil against published times and forces: raise, lower, dump, swing, dig and break out, by plain
calls of MuJoCo.

    python benchmarks/bench_hydraulics.py [FILE.usda …]     (default: both examples, built into a temporary folder)

Of every test of a machine whose kind is a time: its lever is pushed whole, through `yellowiron.hydraulics` at the
pump's flow and the engine's power, until the slide is within 2 % of its end, with the test's share of the rated payload
in the tool. A slewing motor is turned at full lever, held against the sheet's swing speed, and timed over a quarter and
half a turn. A digging or breakout force is what a spring before the tool bears with its lever pushed whole, every other
cylinder locked, at the strongest of places over the stroke where the test asks for that; the engine counts weights,
makers do not. By hand: the stroke's volume by the pump's flow, or pressure times area over the lever arm. "published"
says whether the sheet prints its figure as its maker's; an example value proves nothing.
"""

from __future__ import annotations

import argparse
import math
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from plain import built
from yellowiron.hydraulics import Hydraulics
from yellowiron.kinematics import State
from yellowiron.kinematics.measuring.bench import Bench
from yellowiron.model.geometry import Floats
from yellowiron.model.machine_tests import MachineTest
from yellowiron.model.mechanism import Mechanism, Site
from yellowiron.model.specification import fold
from yellowiron.usd import read_mechanism

NEAR = 0.02
"""Of the stroke: so near to its end a slide has arrived."""
PATIENCE = 60.0
"""Seconds, after which a lever has not done it."""
REST = 1.0
PRESSED = 6.0
"""Seconds for which a tool is pressed against its spring."""
GIVES = 0.02
"""Metres that the spring gives under the force that is expected."""
LOCKED = 100.0
SETTLES = 0.02
"""Seconds: the spring's damping by its stiffness."""
PLACES = 33
"""Over a stroke, among which the strongest is looked for."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path)
    files = parser.parse_args().files
    print("| machine | what | sheet | through the oil | | by hand | |\n|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for file in files or built(Path(folder)):
            bench(file, Path(folder, f"{file.parent.name}.mjcf"))


def bench(file: Path, folder: Path) -> None:
    command = [sys.executable, "-m", "yellowiron", "export", file, "--to", "mjcf", "--out", folder]
    subprocess.run(command, check=True, capture_output=True)
    mechanism = read_mechanism(file)
    document = next(f for f in folder.glob("*.xml") if f.name not in ("scene.xml", "lidar.xml"))
    for test in mechanism.tests:
        if test.actuator not in Hydraulics(mechanism).circuits:
            continue
        if test.kind == "time":
            timed(file.parent.name, mechanism, document, test)
        if test.kind == "force" and test.base == "fixed":
            dug(file.parent.name, mechanism, document, test)
    for actuator in mechanism.actuators:
        sheet = known(mechanism, "Swing Speed")
        joint = mechanism.joint(actuator.joints[0].joint) if actuator.kind == "motor" else None
        if sheet and joint is not None and len(actuator.joints) == 1 and abs(joint.axis[2]) > 0.9:
            swung(file.parent.name, mechanism, document, actuator.name, sheet)


def known(mechanism: Mechanism, name: str) -> tuple[float, bool] | None:
    """A value of the sheet (SI) that is sure, and whether it is the maker's own and no example's."""
    for key, entry in mechanism.specifications.items():
        if fold(key) == fold(name) and entry.get("status", "ok") == "ok" and entry.get("value") is not None:
            return float(entry["value"]), not entry.get("example")
    return None


def load(mechanism: Mechanism, document: Path, payload: float, base: str = "fixed") -> tuple[Any, Any]:
    """The machine held by its root, or on the ground, with kilograms at the place of its load."""
    spec = mujoco.MjSpec.from_file(str(document if base == "fixed" else document.with_name("scene.xml")))
    if base == "fixed":
        for joint in list(spec.joints):
            if joint.type == mujoco.mjtJoint.mjJNT_FREE:
                spec.delete(joint)
        for key in list(spec.keys):
            spec.delete(key)
    site = next((s for s in mechanism.sites if mechanism.payload and s.name == mechanism.payload.site), None)
    if payload > 0.0 and site is not None:
        body = mechanism.body(site.body)
        ball = 0.4 * payload * (payload / 1800.0 * 0.75 / math.pi) ** (2.0 / 3.0)
        carried = spec.body(site.body).add_body(name="payload", pos=np.subtract(site.position, body.origin))
        carried.mass, carried.inertia, carried.ipos = payload, [ball] * 3, [0.0] * 3
        carried.explicitinertial = True
    model = spec.compile()
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


class Driver:
    """The model with its oil: levers in, a step on."""

    def __init__(self, mechanism: Mechanism, model: Any, data: Any) -> None:
        self.oil, self.model, self.data = Hydraulics(mechanism), model, data
        self.origins = {body.name: body.origin for body in mechanism.bodies}
        self._places = {
            name: (model.joint(c.slide).qposadr[0], model.joint(c.slide).dofadr[0], model.actuator(name).id)
            for name, c in self.oil.circuits.items()
        }

    def step(self, levers: Mapping[str, float]) -> None:
        slides = {c.slide: self._places[name] for name, c in self.oil.circuits.items()}
        strokes = {slide: float(self.data.qpos[place]) for slide, (place, _, _) in slides.items()}
        forces = {slide: float(self.data.qfrc_actuator[dof]) for slide, (_, dof, _) in slides.items()}
        targets = self.oil.step(levers, strokes, self.model.opt.timestep, forces=forces)
        for name, control in self.oil.controls(targets).items():
            self.data.ctrl[self._places[name][2]] = control
        mujoco.mj_step(self.model, self.data)

    def share(self, name: str) -> float:
        """Of its stroke, 0 … 1 in the lever's sense."""
        circuit = self.oil.circuits[name]
        done = (float(self.data.qpos[self._places[name][0]]) - circuit.lower) / (circuit.upper - circuit.lower)
        return done if circuit.sign > 0 else 1.0 - done

    def bring(self, name: str, end: str) -> float:
        """Seconds until a lever has brought its slide within `NEAR` of an end; infinite where it never does."""
        lever, wanted = (1.0, 1.0) if end == "max" else (-1.0, 0.0)
        for count in range(round(PATIENCE / self.model.opt.timestep)):
            if abs(self.share(name) - wanted) < NEAR:
                return count * float(self.model.opt.timestep)
            self.step({name: lever})
        return math.inf

    def go(self, wanted: Mapping[str, float]) -> None:
        """Brings slides to their coordinates, by their levers."""
        for _ in range(round(PATIENCE / self.model.opt.timestep)):
            off = {
                name: circuit.sign * (wanted[name] - float(self.data.qpos[self._places[name][0]]))
                for name, circuit in self.oil.circuits.items()
            }
            if max(map(abs, off.values())) < 1e-3:
                return
            self.step({name: max(-1.0, min(1.0, 10.0 * each)) for name, each in off.items()})

    def press(self, name: str, lever: float, site: Site, offset: float, away: Floats, stiffness: float) -> float:
        """N in a spring that the site's point runs into along a direction, in the end."""
        body = self.model.body(site.body).id
        local = np.asarray(site.position) + offset * np.asarray(site.x_axis) - np.asarray(self.origins[site.body])
        start, last, borne = None, None, []
        for count in range(round(PRESSED / self.model.opt.timestep)):
            place = self.data.xpos[body] + self.data.xmat[body].reshape(3, 3) @ local
            start, last = (place, place) if start is None else (start, last)
            speed, last = float((place - last) @ away) / self.model.opt.timestep, place
            force = max(0.0, stiffness * (float((place - start) @ away) + SETTLES * speed))
            self.data.qfrc_applied[:] = 0.0
            mujoco.mj_applyFT(self.model, self.data, -force * away, np.zeros(3), place, body, self.data.qfrc_applied)
            self.step({name: lever})
            if count * self.model.opt.timestep > PRESSED - REST:
                borne.append(force)
        return float(np.mean(borne))

    def lock(self, *, but: str) -> None:
        """No cylinder but one gives way to any force."""
        for name, (_, dof, control) in self._places.items():
            if name != but:
                self.model.jnt_actfrcrange[self.model.dof_jntid[dof]] *= LOCKED
                self.model.actuator_forcerange[control] *= LOCKED

    def rest(self) -> None:
        for _ in range(round(REST / self.model.opt.timestep)):
            self.step({})


def timed(machine: str, mechanism: Mechanism, document: Path, test: MachineTest) -> None:
    sheet = known(mechanism, test.specification)
    if sheet is None:
        return
    model, data = load(mechanism, document, test.payload * rated(mechanism), test.base)
    driver = Driver(mechanism, model, data)
    for step in test.steps:
        for name, end in step.get("set", {}).items():
            if end in ("max", "min") and name in driver.oil.circuits:
                driver.bring(name, end)
                # The last of the way: 2 % before its end nobody begins to take the time.
                for _ in range(round(REST / model.opt.timestep)):
                    driver.step({name: 1.0 if end == "max" else -1.0})
    driver.rest()
    circuit = driver.oil.circuits[test.actuator]
    way = int((test.to == "max") == (circuit.sign > 0))
    volume, taken = circuit.areas[way] * (circuit.upper - circuit.lower), circuit.areas[way] * circuit.speeds[way]
    flow = volume / min(driver.oil.flow, taken)
    found = driver.bring(test.actuator, test.to)
    done = driver.share(test.actuator)
    said(machine, test.name, sheet, found, flow, "s", stalled=done if test.to == "max" else 1.0 - done)


def dug(machine: str, mechanism: Mechanism, document: Path, test: MachineTest) -> None:
    """What a stiff spring before the tool bears with the lever pushed whole, beside relief pressure over the lever
    arm, weightless as makers reckon it."""
    sheet = known(mechanism, test.specification)
    site = next((s for s in mechanism.sites if s.name == test.site), None)
    if sheet is None or site is None:
        return
    bench = Bench(mechanism)
    state, arm = strongest(bench, test, site)
    model, data = load(mechanism, document, 0.0)
    driver = Driver(mechanism, model, data)
    wanted = {name: bench.chain.coordinate(state, c.slide) for name, c in driver.oil.circuits.items()}
    driver.go(wanted)
    driver.rest()
    away = np.array([0.0, 0.0, 1.0]) if test.direction == "up" else arm / np.linalg.norm(arm)
    driver.lock(but=test.actuator)
    circuit = driver.oil.circuits[test.actuator]
    sense = 1.0 if test.to == "max" else -1.0
    alone = circuit.forces[int(sense * circuit.sign > 0)] / float(arm @ away)
    found = driver.press(test.actuator, sense, site, test.offset, away, alone / GIVES)
    said(machine, test.name, (1e-3 * sheet[0], sheet[1]), 1e-3 * found, 1e-3 * alone, "kN")


def strongest(bench: Bench, test: MachineTest, site: Site) -> tuple[State, Floats]:
    """The state for the test, and the way (3,) of its point by that of the driven slide, in the test's sense."""

    def way(state: State, name: str, sense: float) -> Floats:
        entry = bench.actuator(name).joints[0]
        here = bench.chain.coordinate(state, entry.joint)
        moved = [point(bench.chain.solve({entry.joint: here + d}, start=state)) for d in (-1e-4, 1e-4)]
        return sense * entry.sign * (moved[1] - moved[0]) / 2e-4

    def point(state: State) -> Floats:
        local = np.asarray(site.position) + test.offset * np.asarray(site.x_axis)
        return (bench.chain.displacement(state, site.body) @ np.append(local, 1.0))[:3]

    state = bench.pose(test.steps)
    for name in test.best:
        joint, (low, high) = bench.driven(name), sorted(bench.range(name))
        first, _ = bench.chain.reach({joint: low}, start=state)
        states = bench.chain.sweep({joint: np.linspace(low, high, PLACES)[1:-1]}, start=first)
        state = min(states, key=lambda each: float(np.linalg.norm(way(each, name, 1.0))))
    return state, way(state, test.actuator, 1.0 if test.to == "max" else -1.0)


def rated(mechanism: Mechanism) -> float:
    for rule in mechanism.payload.rated if mechanism.payload is not None else ():
        value = known(mechanism, rule.specification)
        if value is not None:
            return rule.factor * value[0]
    return 0.0


def swung(machine: str, mechanism: Mechanism, document: Path, name: str, sheet: tuple[float, bool]) -> None:
    model, data = load(mechanism, document, 0.0)
    control = model.actuator(name).id
    joint = model.joint(int(model.actuator_trnid[control, 0]))
    place, dof = int(joint.qposadr[0]), int(joint.dofadr[0])
    driver = Driver(mechanism, model, data)
    driver.rest()
    high = float(model.actuator_ctrlrange[control, 1])
    turns: dict[str, float] = {}
    start, top = float(data.qpos[place]), 0.0
    for count in range(round(20.0 / model.opt.timestep)):
        # A motor's valve opens as a cylinder's does.
        data.ctrl[control] = high * min(1.0, count * model.opt.timestep / 0.15)
        driver.step({})
        turned, top = abs(float(data.qpos[place]) - start), max(top, abs(float(data.qvel[dof])))
        for words, angle in (("90°", 0.5 * math.pi), ("180°", math.pi)):
            if turned >= angle and words not in turns:
                turns[words] = (count + 1) * float(model.opt.timestep)
    rpm = 30.0 / math.pi
    said(machine, "Swing Speed", (sheet[0] * rpm, sheet[1]), top * rpm, abs(high) * rpm, "rpm")
    for words, seconds in turns.items():
        print(f"| {machine} | swing of {words} from rest | | {seconds:.1f} s | | | |", flush=True)


def said(
    machine: str, what: str, sheet: tuple[float, bool], found: float, alone: float, unit: str, stalled: float = 0.0
) -> None:
    value, published = sheet
    kind = "published" if published else "example value"
    shares = [f"{100.0 * (v / value - 1.0):+.0f} %" for v in (found, alone)]
    if math.isfinite(found):
        cells = f"{found:.2f} {unit} | {shares[0]}"
    else:
        cells = f"stalls at {100.0 * stalled:.0f} % of the way |"
    print(
        f"| {machine} | {what} | {value:.3g} {unit}, {kind} | {cells} | {alone:.2f} {unit} | {shares[1]} |", flush=True
    )


if __name__ == "__main__":
    main()
