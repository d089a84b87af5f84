"""MuJoCo on our MJCF of the machine."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np

from yellowiron.export import BodyGeometry, Geometry, actuator_names, export_mjcf, read_geometry
from yellowiron.model.geometry import Floats
from yellowiron.simulate.engine import GROUND_FRICTION, Setup


def load(setup: Setup) -> MujocoEngine:
    """The machine in MuJoCo: exported to MJCF with what the ground can touch, and nothing to see."""
    standing = setup.standing if setup.base == "floating" else ()
    whole = read_geometry(setup.usd_path) if standing else Geometry()
    touched = Geometry({n: BodyGeometry((), g.colliders) for n, g in whole.bodies.items() if n in standing})
    with tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
        # Sensors would be computed at every step, and nobody reads them here.
        bare = replace(setup.mechanism, sensors=())
        file = export_mjcf(bare, touched, Path(folder), base=setup.base, timestep=setup.timestep)
        spec = mujoco.MjSpec.from_file(str(file if setup.base == "fixed" else file.with_name("scene.xml")))
        for number, block in enumerate(setup.blocks):
            name = f"block.{number}"
            spec.add_mesh(name=name, uservert=block.corners.ravel())
            spec.worldbody.add_geom(
                name=name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, friction=(GROUND_FRICTION, 0.005, 0.0001)
            )
        model = spec.compile()
    # On a state that is not finite MuJoCo starts again from the drawn pose, as if nothing had happened.
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    return MujocoEngine(model, setup)


class MujocoEngine:
    """An `Engine`."""

    def __init__(self, model: mujoco.MjModel, setup: Setup) -> None:
        self.model = model
        self.data = mujoco.MjData(model)
        mechanism = setup.mechanism
        self._rotations, self._origins = self.data.xmat.reshape(-1, 3, 3), self.data.xpos
        self._qpos, self._ctrl = self.data.qpos, self.data.ctrl
        self._numbers = {body.name: int(model.body(body.name).id) for body in mechanism.bodies}
        self._bodies = np.array(list(self._numbers.values()))
        self._pushed = False
        self._positions = np.array([int(model.joint(name).qposadr[0]) for name in setup.measured], dtype=int)
        self._controls: dict[str, tuple[int, int]] = {}
        for actuator in mechanism.actuators:
            signs = {entry.joint: entry.sign for entry in actuator.joints}
            for control, joint in actuator_names(mechanism)[actuator.name].items():
                self._controls[joint] = (int(model.actuator(control).id), signs[joint])
        # Else a warning is printed, and written to a file in the working folder; the comparison finds what it is about.
        self._warned = mujoco.get_mju_user_warning()
        mujoco.set_mju_user_warning(lambda message: None)
        mujoco.mj_resetDataKeyframe(model, self.data, 0)
        mujoco.mj_step1(model, self.data)

    @property
    def version(self) -> str:
        """MuJoCo's version."""
        return str(mujoco.__version__)

    def set_targets(self, targets: Mapping[str, float]) -> None:
        """See `Engine`."""
        for joint, value in targets.items():
            control, sign = self._controls[joint]
            self._ctrl[control] = sign * value

    def push(self, body: str, force: Floats, point: Floats) -> None:
        """See `Engine`."""
        number = self._numbers[body]
        arm = np.asarray(point) - self.data.xipos[number]
        self.data.xfrc_applied[number] = np.concatenate([force, np.cross(arm, force)])
        self._pushed = True

    def step(self) -> None:
        """One step, in MuJoCo's two halves the other way round: poses and coordinates then belong to the same
        instant."""
        mujoco.mj_step2(self.model, self.data)
        if self._pushed:
            self.data.xfrc_applied[:] = 0.0
            self._pushed = False
        mujoco.mj_step1(self.model, self.data)

    def poses(self) -> tuple[Floats, Floats]:
        """See `Engine`."""
        return self._rotations.take(self._bodies, axis=0), self._origins.take(self._bodies, axis=0)

    def coordinates(self) -> Floats:
        """See `Engine`."""
        return np.asarray(self._qpos.take(self._positions), dtype=np.float64)

    def close(self) -> None:
        """Gives MuJoCo's warnings back to whom they went before."""
        mujoco.set_mju_user_warning(self._warned)
