"""Levers through the oil in Newton: every cylinder by its lever from one end to the other and back, timed.

    python examples/learning/levers_in_newton.py out/wheel_loader/wheel_loader.usda [--hz 240] [--device cpu]

The file as it is, with Newton's own settings, its base held. `yellowiron.hydraulics` is the actuator: valves that open
over time, one pump's flow, and targets that Newton's drives are told at every step. Printed beside each time: what the
pump's flow alone would need. It needs the extra `newton`.
"""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Mapping
from pathlib import Path

import newton
import newton_usd_schemas  # noqa: F401  registers its schemas before a stage opens
import numpy as np
import physx_usd_schemas  # noqa: F401  likewise
import warp
from pxr import Usd, UsdGeom, UsdPhysics

from yellowiron import read_mechanism
from yellowiron.hydraulics import Circuit, Hydraulics

NEAR, PATIENCE = 0.02, 60.0
"""Of the stroke: so near to its end a slide has arrived; seconds, after which it does not."""


def main() -> None:
    """Times every lever, both ways."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("machine", type=Path)
    parser.add_argument("--hz", type=float, default=240.0)
    parser.add_argument("--device", default="cpu")
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    warp.config.quiet = True
    print("| lever | out | by flow alone | in | by flow alone |\n|---|---|---|---|---|")
    with warp.ScopedDevice(given.device):
        machine = Machine(given.machine, 1.0 / given.hz)
        for name, circuit in machine.oil.circuits.items():
            machine.push(name, -1.0)
            times = [machine.push(name, 1.0), machine.push(name, -1.0)]
            cells = [
                f"{seconds:.2f} s | {_by_flow(circuit, machine.oil.flow, sense):.2f} s"
                for seconds, sense in zip(times, (1, -1), strict=True)
            ]
            machine.push(name, None)
            print(f"| {name} | {cells[0]} | {cells[1]} |", flush=True)


class Machine:
    """One machine in Newton with its oil."""

    def __init__(self, file: Path, step: float) -> None:
        builder = newton.ModelBuilder()
        newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
        found = builder.add_usd(held(file), load_visual_shapes=False)
        model = builder.finalize()
        self.oil, self._step = Hydraulics(read_mechanism(file)), step
        self._solver = newton.solvers.SolverMuJoCo(model)
        self._states, self._control = [model.state(), model.state()], model.control()
        newton.eval_fk(model, model.joint_q, model.joint_qd, self._states[0])
        starts, joints = model.joint_q_start.numpy(), found["path_joint_map"]
        own = {path.rsplit("/", 1)[-1]: int(starts[number]) for path, number in joints.items()}
        self._places = {circuit.slide: own[circuit.slide] for circuit in self.oil.circuits.values()}
        self._told = self._control.joint_target_q.numpy().copy()
        self._drawn = self.strokes()

    def strokes(self) -> dict[str, float]:
        """Slide → its coordinate, m."""
        coordinates = self._states[0].joint_q.numpy()
        return {slide: float(coordinates[place]) for slide, place in self._places.items()}

    def step(self, levers: Mapping[str, float]) -> None:
        """A step on, with the levers so."""
        targets = self.oil.step(levers, self.strokes(), self._step)
        for slide, target in targets.items():
            self._told[self._places[slide]] = target
        self._control.joint_target_q.assign(self._told)
        self._solver.step(self._states[0], self._states[1], self._control, None, self._step)
        newton.eval_ik(self._solver.model, self._states[1], self._states[1].joint_q, self._states[1].joint_qd)
        self._states.reverse()

    def push(self, name: str, sense: float | None) -> float:
        """Pushes a lever whole until its slide has arrived, then lets go for a second; without a sense, back to where
        it is drawn. Seconds; infinite where it does not arrive."""
        circuit, count = self.oil.circuits[name], 0
        way = circuit.upper - circuit.lower
        end = self._drawn[circuit.slide]
        if sense is not None:
            end = circuit.upper if sense * circuit.sign > 0.0 else circuit.lower
        while abs(end - (now := self.strokes()[circuit.slide])) > NEAR * way and count * self._step < PATIENCE:
            self.step({name: circuit.sign * np.sign(end - now)})
            count += 1
        for _ in range(round(1.0 / self._step)):
            self.step({})
        return count * self._step if count * self._step < PATIENCE else np.inf


def held(machine: Path) -> Usd.Stage:
    """The machine alone, its base fixed and without colliders: nothing is there to touch."""
    stage = Usd.Stage.CreateInMemory()
    UsdPhysics.Scene.Define(stage, "/scene")
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    prim = stage.DefinePrim("/machine", "Xform")
    prim.GetReferences().AddReference(str(machine.resolve()))
    prim.GetVariantSet("Base").SetVariantSelection("fixed")
    for path in [each.GetPath() for each in Usd.PrimRange(prim) if each.GetName() == "colliders"]:
        stage.GetPrimAtPath(path).SetActive(False)
    return stage


def _by_flow(circuit: Circuit, flow: float, sense: int) -> float:
    """Seconds in which a flow fills a stroke."""
    way = int(sense * circuit.sign > 0)
    return circuit.areas[way] * (circuit.upper - circuit.lower) / min(flow, circuit.areas[way] * circuit.speeds[way])


if __name__ == "__main__":
    main()
