"""MuJoCo on our MJCF of the machine."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from yellowiron.exporters import TIMESTEP, BodyGeometry, Geometry, actuator_names, export_mjcf, read_geometry
from yellowiron.model.geometry import Floats
from yellowiron.simulation.engine import Readings, Setup
from yellowiron.simulation.ground import GROUND_FRICTION
from yellowiron.support import guard


def load(setup: Setup) -> MujocoEngine:
    """The machine in MuJoCo: exported to MJCF with what the ground can touch, and nothing to see."""
    standing = setup.standing if setup.base == "floating" else ()
    whole = read_geometry(setup.usd_path) if standing else Geometry()
    touched = Geometry({n: BodyGeometry((), g.colliders) for n, g in whole.bodies.items() if n in standing})
    with tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
        # Sensors would be computed at every step, and nobody reads them here.
        bare = replace(setup.mechanism, sensors=())
        # With the engine's settings the file is the one that a user exports, and nothing but its step is changed.
        written = setup.timestep if setup.settings == "file" else TIMESTEP
        file = export_mjcf(bare, touched, Path(folder), base=setup.base, timestep=written)
        spec = mujoco.MjSpec.from_file(str(file if setup.base == "fixed" else file.with_name("scene.xml")))
        for number, block in enumerate(setup.blocks):
            name = f"block.{number}"
            spec.add_mesh(name=name, uservert=block.corners.ravel())
            spec.worldbody.add_geom(
                name=name, type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, friction=(GROUND_FRICTION, 0.005, 0.0001)
            )
        spec.option.timestep = setup.timestep
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
        # As bytes they are joined in a tenth of a microsecond; numpy takes eight times that.
        self._parts = (self.data.qpos.data, self.data.xpos.data, self.data.xmat.data)
        self._ctrl = self.data.ctrl
        self._numbers = {body.name: int(model.body(body.name).id) for body in mechanism.bodies}
        self._bodies = _places(list(self._numbers.values()))
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

    def targets(self, joints: Sequence[str], rows: Floats) -> Iterator[None]:
        """See `Engine`."""
        controls = np.array([self._controls[joint][0] for joint in joints], dtype=int)
        signs = np.array([self._controls[joint][1] for joint in joints], dtype=np.float64)

        for row in signs * rows:
            self._ctrl[controls] = row
            yield

    def push(self, body: str, force: Floats, point: Floats) -> None:
        """See `Engine`."""
        number = self._numbers[body]
        # Numbers, not arrays: several pushes a step, and `np.cross` alone takes ten times as long.
        x, y, z = (np.asarray(point) - self.data.xipos[number]).tolist()
        fx, fy, fz = np.asarray(force, dtype=np.float64).tolist()
        self.data.xfrc_applied[number] = (fx, fy, fz, y * fz - z * fy, z * fx - x * fz, x * fy - y * fx)
        self._pushed = True

    def step(self) -> None:
        """One step, in MuJoCo's two halves the other way round: poses and coordinates then belong to the same
        instant."""
        mujoco.mj_step2(self.model, self.data)
        if self._pushed:
            self.data.xfrc_applied[:] = 0.0
            self._pushed = False
        mujoco.mj_step1(self.model, self.data)
        guard.beat()

    def state(self) -> bytes:
        """See `Engine`."""
        return b"".join(self._parts)

    def read(self, states: Sequence[bytes]) -> Readings:
        """See `Engine`."""
        count = len(states)
        rows = np.frombuffer(b"".join(states)).reshape(count, -1)
        places, origins, rotations = np.split(rows, np.cumsum([part.nbytes // 8 for part in self._parts[:-1]]), axis=1)
        return Readings(
            places[:, self._positions],
            rotations.reshape(count, -1, 3, 3)[:, self._bodies],
            origins.reshape(count, -1, 3)[:, self._bodies],
        )

    def close(self) -> None:
        """Gives MuJoCo's warnings back to whom they went before."""
        mujoco.set_mju_user_warning(self._warned)


def _places(numbers: list[int]) -> Any:
    """What picks numbered rows of an array: a slice where they are in order, since that copies nothing."""
    first, last = numbers[0], numbers[-1] + 1
    return slice(first, last) if numbers == list(range(first, last)) else np.array(numbers)
