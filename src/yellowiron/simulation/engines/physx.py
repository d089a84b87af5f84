"""PhysX (`ovphysx`, on the CPU) on our USD.

Values go in and out through tensor bindings, 5 µs each; the session API that is to replace them takes 0.5 ms, a fifth
of a step. Bindings want a warm-up: a step of a nanosecond, over which the rounding of a closed loop is a velocity of
hundreds of metres a second. What it has moved is put back before the first real step.
"""

from __future__ import annotations

import tempfile
import warnings
from collections.abc import Iterator, Sequence
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

import newton_usd_schemas  # noqa: F401  registers its schemas before a stage opens
import numpy as np
import ovphysx
import ovstage
import physx_usd_schemas  # noqa: F401  likewise
import warp
from ovphysx.types import GlobalConfigKey, LogLevel, ObjectScope, SimObjectType, TensorType

from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import chained
from yellowiron.simulation.engine import Readings, Setup
from yellowiron.simulation.engines.coordinates import Coordinates, rotation_matrices
from yellowiron.simulation.engines.world import World, compose, save
from yellowiron.support import guard

_ORDINAL = 1
_SCHEMAS = ("PhysxSchema", "OmniUsdPhysicsDeformableSchema")
_TARGETS = {
    "position": TensorType.ARTICULATION_DOF_POSITION_TARGET,
    "velocity": TensorType.ARTICULATION_DOF_VELOCITY_TARGET,
}

_DRAWN = (
    TensorType.ARTICULATION_DOF_POSITION,
    TensorType.ARTICULATION_DOF_VELOCITY,
    TensorType.ARTICULATION_ROOT_VELOCITY,
)
"""What is 0 in the drawn pose at rest."""


def load(setup: Setup) -> PhysxEngine:
    """The machine in PhysX. `YellowironError` where it does not load, or not all its bodies are simulated."""
    return PhysxEngine(compose(setup), setup)


class PhysxEngine:
    """An `Engine`. Poses and velocities are single precision, as PhysX has them."""

    def __init__(self, world: World, setup: Setup) -> None:
        _prepare()
        self._timestep = setup.timestep
        self._mechanism, self._joints, self._paths_of = setup.mechanism, world.joints, world.bodies
        self._root = world.root
        self._pushed: dict[str, Any] = {}
        self._bindings: list[Any] = []
        self._stage: Any = None
        self._physx: Any = ovphysx.PhysX()
        try:
            self._stage = _attach(self._physx, world, setup)
            self._physx.warmup()
            self._links = self._bind(TensorType.ARTICULATION_LINK_POSE)
            free = [world.bodies[name] for name in sorted(chained(setup.mechanism))]
            self._free = self._bind(TensorType.RIGID_BODY_POSE, free) if free else None
            self._rows = self._find_rows()
            self._targets = {kind: self._read(self._bind(tensor)) for kind, tensor in _TARGETS.items()}
            self._draw()
            self._speeds = self._bind(TensorType.ARTICULATION_DOF_VELOCITY)
        except BaseException:
            self.close()
            raise
        columns = {name: column for column, name in enumerate(self._speeds.dof_names)}
        self._columns = {
            name: columns[prim] for name, path in world.joints.items() if (prim := _prim_name(path)) in columns
        }
        self._kinds = {
            j.name: j.drive.kind for j in setup.mechanism.joints if j.drive is not None and j.name in self._columns
        }
        self._measured = Coordinates(setup.mechanism, setup.measured)

    @property
    def version(self) -> str:
        """The version of ovphysx."""
        return metadata.version("ovphysx")

    def targets(self, joints: Sequence[str], rows: Floats) -> Iterator[None]:
        """See `Engine`."""
        parts = []
        for kind, (binding, now) in self._targets.items():
            if own := [number for number, joint in enumerate(joints) if self._kinds[joint] == kind]:
                parts.append((binding, now, np.array([self._columns[joints[number]] for number in own]), np.array(own)))
        for row in rows.astype(np.float32):
            for binding, now, columns, given in parts:
                # What does not change is not written: a write wakes a machine that has come to rest.
                if not np.array_equal(now[0, columns], row[given]):
                    now[0, columns] = row[given]
                    binding.write(now)
            yield

    def push(self, body: str, force: Floats, point: Floats) -> None:
        """See `Engine`."""
        if body not in self._pushed:
            handle = ovstage.PathDictionary(self._stage).intern_path(self._paths_of[body])
            self._pushed[body] = self._physx.query(
                SimObjectType.ARTICULATION_LINK, prim_paths=[handle], scope=ObjectScope.ALL
            ).wait()
        values = np.concatenate([force, np.zeros(3), point]).astype(np.float32)
        with self._physx.write(self._pushed[body], ["wrench"]).wait() as session:
            while (group := session.fetch_next().wait()) is not None:
                group.tensors[0].assign(values.reshape(1, 9))
                session.commit_sync(group)

    def step(self) -> None:
        """See `Engine`."""
        self._physx.step_sync(self._timestep)
        guard.beat()

    def state(self) -> Any:
        """See `Engine`."""
        links = self._read(self._links)[1][0]
        return links if self._free is None else np.concatenate([links, self._read(self._free)[1]])

    def read(self, states: Sequence[Any]) -> Readings:
        """See `Engine`."""
        rows = np.concatenate(states).reshape(len(states), -1, 7)[:, self._rows].astype(np.float64)
        rotations, origins = rotation_matrices(rows[..., 3:]), rows[..., :3]
        return Readings(self._measured.read(rotations, origins), rotations, origins)

    def velocities(self) -> dict[str, float]:
        """Velocities of the articulation's joints by name, m/s or rad/s. After the first step they must be small."""
        values = self._read(self._speeds)[1][0]
        return {name: float(values[column]) for name, column in self._columns.items()}

    def close(self) -> None:
        """Ends PhysX's instance; its stage goes with it."""
        if self._physx is None:
            return
        for binding in self._bindings:
            binding.destroy()
        if self._stage is not None and self._physx.is_stage_attached(self._stage):
            self._physx.wait_task(self._physx.detach_ovstage())
        self._physx.destroy()
        if self._stage is not None:
            self._stage.destroy()
        self._physx = self._stage = None

    def _bind(self, tensor: TensorType, paths: Sequence[str] = ()) -> Any:
        """All values of a kind in the articulation, in SI and radians: one row, a column a link or joint. Of bodies
        that are in none, by their paths, a row each."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # they are deprecated, and Warp was built for GPUs too
            binding = self._physx.create_tensor_binding(prim_paths=list(paths) or [self._root], tensor_type=tensor)
        self._bindings.append(binding)
        return binding

    def _read(self, binding: Any) -> tuple[Any, Any]:
        values = np.zeros(binding.shape, dtype=np.float32)
        binding.read(values)
        return binding, values

    def _draw(self) -> None:
        """Puts the machine in its drawn pose, at rest."""
        root = self._mechanism.bodies[int(np.argmin(self._rows))]
        pose = np.array([[*root.origin, 0.0, 0.0, 0.0, 1.0]], dtype=np.float32)
        self._bind(TensorType.ARTICULATION_ROOT_POSE).write(pose)
        for binding in map(self._bind, _DRAWN):
            binding.write(np.zeros(binding.shape, dtype=np.float32))
        if self._free is None:
            return
        by_row = {int(row): body for row, body in zip(self._rows, self._mechanism.bodies, strict=True)}
        drawn = [[*by_row[self._links.shape[1] + k].origin, 0.0, 0.0, 0.0, 1.0] for k in range(self._free.shape[0])]
        self._free.write(np.array(drawn, dtype=np.float32))
        speeds = self._bind(TensorType.RIGID_BODY_VELOCITY, self._free.prim_paths)
        speeds.write(np.zeros(speeds.shape, dtype=np.float32))

    def _find_rows(self) -> Any:
        """Row of every body of the mechanism among PhysX's links, and after them the bodies that are none."""
        paths = [] if self._free is None else self._free.prim_paths
        rows = {name: row for row, name in enumerate([*self._links.body_names, *map(_prim_name, paths)])}
        for body in self._mechanism.bodies:
            if _prim_name(self._paths_of[body.name]) not in rows:
                raise YellowironError(
                    f"PhysX has no link for the body '{body.name}'",
                    where=self._mechanism.name,
                    hint="A body needs a joint that is not cut to the rest of the machine.",
                )
        return np.array([rows[_prim_name(self._paths_of[body.name])] for body in self._mechanism.bodies])


def _prim_name(path: str) -> str:
    return path.rpartition("/")[2]


@cache
def _prepare() -> None:
    """What holds for the whole process: no GPU, PhysX's schemas known to its own USD, errors only in the log."""
    warp.config.quiet = True
    ovphysx.PhysX.set_cpu_mode(True)
    # One machine is too little to share out: with threads of its own a step takes half as long again.
    ovphysx.set_global_config(GlobalConfigKey.NUM_THREADS, 0)
    ovphysx.set_global_config(GlobalConfigKey.LOG_LEVEL, int(LogLevel.ERROR))
    schemas = metadata.distribution("physx-usd-schemas")
    folders = [str(schemas.locate_file(f"physx_usd_schemas/{name}/resources")) for name in _SCHEMAS]
    ovstage.population.register_usd_schemas([*folders, str(ovphysx.newton_schema_root())])


def _attach(physx: Any, world: World, setup: Setup) -> Any:
    """The world as ovstage's stage, attached; the file it is read from lives only as long as that takes."""
    stage = ovstage.Stage("yellowiron")
    try:
        with tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
            file = save(world, Path(folder))
            ovstage.population.open_usd(stage, str(file), ordinal=_ORDINAL, domains=ovstage.PopulationDomain.ALL)
            stage.advance_write_floor(ordinal=_ORDINAL).wait()
            physx.wait_task(physx.attach_ovstage(stage, read_ordinal=_ORDINAL))
    except (ovstage.OvstageError, ovphysx.TaskError) as error:
        stage.destroy()
        raise YellowironError(
            "PhysX cannot load the machine", where=str(setup.usd_path), hint=f"PhysX says: {error}"
        ) from error
    return stage
