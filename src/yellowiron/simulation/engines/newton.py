"""Newton, with MuJoCo's solver on the CPU, on our USD."""

from __future__ import annotations

import contextlib
import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import mujoco
import newton
import newton_usd_schemas  # noqa: F401  registers its schemas before a stage opens
import numpy as np
import physx_usd_schemas  # noqa: F401  likewise
import warp
from pxr import Usd

from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import chained
from yellowiron.simulation.engine import Readings, Setup
from yellowiron.simulation.engines.coordinates import Coordinates, rotation_matrices
from yellowiron.simulation.engines.world import World, compose
from yellowiron.support import guard
from yellowiron.support.record import CONE, IMPRATIO, integrator_of
from yellowiron.usd.authoring.stage import Types, apply_schemas, over, set_attribute

_FIELD = "NewtonSDFCollisionAPI"


def load(setup: Setup) -> NewtonEngine:
    """The machine in Newton. `YellowironError` where Newton takes it, but not all of it.

    Its solver wants every body in an articulation: rings of track shoes become articulations of their own here. In the
    file they are none, since PhysX tears such rings apart within a step.
    """
    for joint in setup.mechanism.joints:
        if joint.type == "distance":
            raise YellowironError(
                "Newton's solver has no distance joints", where=joint.name, hint="Use mujoco or physx for this machine."
            )
    world = compose(setup)
    loose = chained(setup.mechanism)
    for joint in setup.mechanism.joints:
        if joint.body0 in loose and not joint.cut:
            spec = over(world.layer, world.joints[joint.name])
            set_attribute(spec, "physics:excludeFromArticulation", Types.Bool, False, uniform=True)
    for head in setup.mechanism.floating:
        apply_schemas(over(world.layer, world.bodies[head]), "PhysicsArticulationRootAPI")
    return NewtonEngine(world, setup)


class NewtonEngine:
    """An `Engine`. MuJoCo steps in double precision; Newton's state, which follows it, is single.

    Poses are read from MuJoCo: Newton's, carried from joint to joint in single precision, are 5 µm off at the end of an
    excavator's arm, and a linkage shows that ten times larger.
    """

    def __init__(self, world: World, setup: Setup) -> None:
        warp.config.quiet = True
        warp.config.enable_backward = False  # nothing is differentiated: kernels compile in half the time
        self._timestep = setup.timestep
        with warp.ScopedDevice("cpu"), _quiet():
            builder = newton.ModelBuilder(up_axis=newton.Axis.Z)
            newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
            found = builder.add_usd(_without_fields(Usd.Stage.Open(world.layer)), load_visual_shapes=False)
            self._model: Any = builder.finalize(device="cpu")
            told = {"integrator": integrator_of(setup.mechanism).lower(), "cone": CONE, "impratio": IMPRATIO}
            self._solver: Any = newton.solvers.SolverMuJoCo(
                self._model,
                use_mujoco_cpu=True,
                update_data_interval=0,  # what MuJoCo has come to is its own, unrounded: it is not told back every step
                **(told if setup.settings == "file" else {}),
            )
            self._states = [self._model.state(), self._model.state()]
            self._control: Any = self._model.control()
            newton.eval_fk(self._model, self._model.joint_q, self._model.joint_qd, self._states[0])
        self._numbers = {b.name: _index(found["path_body_map"], world.bodies[b.name]) for b in setup.mechanism.bodies}
        places = self._solver.mjc_body_to_newton.numpy()[0].tolist()
        self._bodies = np.array([places.index(number) for number in self._numbers.values()])
        self._centers = self._model.body_com.numpy().astype(np.float64)
        # Forces of no body are not handed over: a tenth of a step.
        self._forces: Any = self._states[0].body_f
        for state in self._states:
            state.body_f = None
        self._pushed: set[int] = set()
        starts = {"position": self._model.joint_q_start.numpy(), "velocity": self._model.joint_qd_start.numpy()}
        self._drives = {
            joint.name: (joint.drive.kind, int(starts[joint.drive.kind][_index(found["path_joint_map"], path)]))
            for joint in setup.mechanism.joints
            if joint.drive is not None and not joint.cut and (path := world.joints[joint.name])
        }
        self._targets = {
            "position": self._control.joint_target_q.numpy(),
            "velocity": self._control.joint_target_qd.numpy(),
        }
        self._measured = Coordinates(setup.mechanism, setup.measured)
        self._rows = [state.body_q.numpy() for state in self._states]  # views: the CPU's arrays are numpy's
        mujoco.mj_kinematics(self._solver.mj_model, self._solver.mj_data)

    @property
    def version(self) -> str:
        """Newton's version."""
        return str(newton.__version__)

    def targets(self, joints: Sequence[str], rows: Floats) -> Iterator[None]:
        """See `Engine`."""
        parts = []
        for kind, targets in self._targets.items():
            if own := [number for number, joint in enumerate(joints) if self._drives[joint][0] == kind]:
                parts.append((targets, np.array([self._drives[joints[number]][1] for number in own]), np.array(own)))
        for row in rows:
            for targets, places, given in parts:
                targets[places] = row[given]
            yield

    def push(self, body: str, force: Floats, point: Floats) -> None:
        """See `Engine`."""
        number = self._numbers[body]
        row = self._rows[0][number].astype(np.float64)
        center = row[:3] + rotation_matrices(row[None, 3:])[0] @ self._centers[number]
        # Newton's wrench is a force, then a torque about the body's centre of mass.
        self._states[0].body_f = self._forces
        self._forces.numpy()[number] = np.concatenate([force, np.cross(np.asarray(point) - center, force)])
        self._pushed.add(number)

    def step(self) -> None:
        """See `Engine`."""
        before, after = self._states
        self._solver.step(before, after, self._control, None, self._timestep)
        mujoco.mj_kinematics(self._solver.mj_model, self._solver.mj_data)
        if self._pushed:
            before.body_f = None
            self._forces.numpy()[list(self._pushed)] = 0.0
            self._pushed.clear()
        self._states = [after, before]
        self._rows.reverse()
        guard.beat()

    def state(self) -> Any:
        """See `Engine`."""
        data = self._solver.mj_data
        return np.concatenate([data.xpos, data.xquat], axis=1)

    def read(self, states: Sequence[Any]) -> Readings:
        """See `Engine`."""
        rows = np.concatenate(states).reshape(len(states), -1, 7)[:, self._bodies]
        rotations, origins = rotation_matrices(np.roll(rows[..., 3:], -1, axis=-1)), rows[..., :3]
        return Readings(self._measured.read(rotations, origins), rotations, origins)

    def velocities(self) -> Floats:
        """Velocities of all joints, m/s or rad/s. After the first step they must be small."""
        return np.array(self._states[0].joint_qd.numpy(), dtype=np.float64)

    def close(self) -> None:
        """Nothing is held outside Python."""


def _index(found: Mapping[str, int], path: str) -> int:
    if path not in found:
        raise YellowironError(
            "Newton has left out a body or joint of the machine", where=path, hint="Simulate it in mujoco or physx."
        )
    return found[path]


def _without_fields(stage: Usd.Stage) -> Usd.Stage:
    """The stage with no signed distance fields asked for: Newton builds them on a GPU alone, and contacts here are
    MuJoCo's, which has no use for them."""
    for prim in list(stage.Traverse()):
        if _FIELD in prim.GetAppliedSchemas():
            prim.RemoveAppliedSchema(_FIELD)
    return stage


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """Without what Newton says of MuJoCo's version and of meshes that it takes as their hulls."""
    with warnings.catch_warnings(), Path(os.devnull).open("w") as nowhere, contextlib.redirect_stdout(nowhere):
        warnings.simplefilter("ignore")
        yield
