"""PhysX (`ovphysx`, on the CPU) on our USD.

Only the session API is used: the older tensor bindings take a hidden step of a nanosecond at their first access, over
which the rounding of a closed loop is a velocity of hundreds of metres a second.
"""

from __future__ import annotations

import math
import tempfile
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
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
from ovphysx.types import GlobalConfigKey, LogLevel, ObjectScope, SimObjectType

from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Joint
from yellowiron.simulate.coordinates import Coordinates, rotation_matrices
from yellowiron.simulate.engine import Setup
from yellowiron.simulate.world import World, compose, save

_ORDINAL = 1
_SCHEMAS = ("PhysxSchema", "OmniUsdPhysicsDeformableSchema")
_TARGETS = {"position": "jointPositionTarget", "velocity": "jointVelocityTarget"}


def load(setup: Setup) -> PhysxEngine:
    """The machine in PhysX. `YellowironError` where it does not load, or not all its bodies are simulated."""
    return PhysxEngine(compose(setup), setup)


class PhysxEngine:
    """An `Engine`. Poses and velocities are single precision, as PhysX has them."""

    def __init__(self, world: World, setup: Setup) -> None:
        _prepare()
        self._timestep = setup.timestep
        self._mechanism, self._joints, self._paths_of = setup.mechanism, world.joints, world.bodies
        self._pushed: dict[str, Any] = {}
        self._stage: Any = None
        self._physx: Any = ovphysx.PhysX()
        try:
            self._stage = _attach(self._physx, world, setup)
            self._links = self._physx.query(SimObjectType.ARTICULATION_LINK, scope=ObjectScope.ALL).wait()
            self._order = self._body_order(world)
            self._drives = self._find_drives()
        except BaseException:
            self.close()
            raise
        self._targets = {kind: dict.fromkeys(scale, 0.0) for kind, (_, scale, _) in self._drives.items()}
        self._measured = Coordinates(setup.mechanism, setup.measured)
        self._poses: tuple[Floats, Floats] | None = None

    @property
    def version(self) -> str:
        """The version of ovphysx."""
        return metadata.version("ovphysx")

    def set_targets(self, targets: Mapping[str, float]) -> None:
        """See `Engine`."""
        for kind, (query, scale, paths) in self._drives.items():
            held = self._targets[kind]
            new = {name: value for name, value in targets.items() if name in scale and value != held[name]}
            if not new:
                continue
            held.update(new)
            with self._physx.write(query, [_TARGETS[kind]]).wait() as session:
                while (group := session.fetch_next().wait()) is not None:
                    for name, tensor in zip(paths, group.tensors, strict=True):
                        tensor.fill_(scale[name] * held[name])
                    session.commit_sync(group)

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
        self._poses = None

    def poses(self) -> tuple[Floats, Floats]:
        """See `Engine`."""
        if self._poses is None:
            self._poses = self._read_poses()
        return self._poses

    def coordinates(self) -> Floats:
        """See `Engine`."""
        return self._measured.read(*self.poses())

    def velocities(self) -> dict[str, float]:
        """Velocities of the articulation's joints by name, m/s or rad/s. After the first step they must be small."""
        with self._physx.read_sync(SimObjectType.ARTICULATION_JOINT, ["jointVelocity"], scope=ObjectScope.ALL) as read:
            found = {
                path: float(tensor.numpy()[0])
                for group in read.groups
                for path, tensor in zip(self._paths(group), group.tensors, strict=True)
            }
        joints = [(j, self._joints[j.name]) for j in self._mechanism.joints if self._joints[j.name] in found]
        return {j.name: found[path] / _unit(j) for j, path in joints}

    def close(self) -> None:
        """Ends PhysX's instance; its stage goes with it."""
        if self._physx is None:
            return
        if self._stage is not None and self._physx.is_stage_attached(self._stage):
            self._physx.wait_task(self._physx.detach_ovstage())
        self._physx.destroy()
        if self._stage is not None:
            self._stage.destroy()
        self._physx = self._stage = None

    def _read_poses(self) -> tuple[Floats, Floats]:
        found: dict[int, Floats] = {}
        with self._physx.read(self._links, ["position", "orientation"]).wait() as read:
            while (group := read.fetch_next().wait()) is not None:
                rows = group.tensors[0].numpy()
                found[rows.shape[1]] = np.array(rows[self._order], dtype=np.float64)
                del rows, group
        return rotation_matrices(found[4]), found[3]

    def _paths(self, group: Any) -> list[str]:
        paths = ovstage.PathDictionary(self._stage).get_path_strings(group.prim_list)
        return list(paths[group.prim_offset : group.prim_offset + group.prim_count])

    def _body_order(self, world: World) -> Any:
        """Row of every body of the mechanism among PhysX's links, whose order never changes."""
        with _quiet(), self._physx.read_sync(SimObjectType.ARTICULATION_LINK, ["position"], scope=ObjectScope.ALL) as r:
            rows = {path: row for group in r.groups for row, path in enumerate(self._paths(group))}
        for body in self._mechanism.bodies:
            if world.bodies[body.name] not in rows:
                raise YellowironError(
                    f"PhysX has no link for the body '{body.name}'",
                    where=self._mechanism.name,
                    hint="A body needs a joint that is not cut to the rest of the machine.",
                )
        return np.array([rows[world.bodies[body.name]] for body in self._mechanism.bodies])

    def _find_drives(self) -> dict[str, tuple[Any, dict[str, float], list[str]]]:
        """For each kind of drive: a query for its joints, the factor from SI to PhysX's unit by joint (degrees for
        pivots), and the joints in the query's order."""
        found: dict[str, tuple[Any, dict[str, float], list[str]]] = {}
        dictionary = ovstage.PathDictionary(self._stage)
        for kind in _TARGETS:
            joints = [j for j in self._mechanism.joints if j.drive is not None and not j.cut and j.drive.kind == kind]
            if not joints:
                continue
            scale = {j.name: _unit(j) for j in joints}
            names = {self._joints[j.name]: j.name for j in joints}
            handles = [dictionary.intern_path(path) for path in names]
            query = self._physx.query(
                SimObjectType.ARTICULATION_JOINT, prim_paths=handles, scope=ObjectScope.ALL
            ).wait()
            order: list[str] = []
            with self._physx.read(query, ["jointPosition"]).wait() as read:
                while (group := read.fetch_next().wait()) is not None:
                    order += [names[path] for path in self._paths(group)]
            found[kind] = (query, scale, order)
        return found


def _unit(joint: Joint) -> float:
    """Factor from SI to PhysX's unit: degrees for pivots, as in USD."""
    return 1.0 if joint.type == "prismatic" else math.degrees(1.0)


@cache
def _prepare() -> None:
    """What holds for the whole process: no GPU, PhysX's schemas known to its own USD, errors only in the log."""
    warp.config.quiet = True
    ovphysx.PhysX.set_cpu_mode(True)
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


@contextmanager
def _quiet() -> Iterator[None]:
    """Without the warning that Warp, which moves the arrays, was built for GPUs too."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        yield
