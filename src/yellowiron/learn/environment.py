"""One machine as a Gymnasium environment: levers go through the oil to its drives, step by step."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, ClassVar, Literal

import mujoco
import numpy as np

from yellowiron.learn.model import Base, Lever, MachineModel, load_machine
from yellowiron.learn.senses import Senses
from yellowiron.model.errors import YellowironError
from yellowiron.model.geometry import Floats

try:
    import gymnasium
except ModuleNotFoundError as error:  # pragma: no cover - the extra is not installed
    raise YellowironError(
        "Environments for learners need Gymnasium, which is not installed",
        where="yellowiron.learn",
        hint="pip install 'yellowiron[learn]'",
    ) from error

Actions = Literal["levers", "strokes"]
CONTROL = 0.05
"""Seconds between two actions."""
OIL = 0.01
"""Seconds between two steps of the hydraulics."""
SPOOL = 0.15
"""Seconds in which a motor's valve opens; a cylinder's is the hydraulics'."""
SETTLE = 0.4
"""Seconds at the start, for a machine on the ground."""
REACHED = 0.05
"""Of its stroke: so near to a wanted stroke its valve begins to close."""


def register(name: str, task: type[MachineEnv]) -> None:
    """Gives Gymnasium a task's name, for `gymnasium.make`."""
    gymnasium.register(name, entry_point=task)


class MachineEnv(gymnasium.Env[Any, Any]):
    """What all tasks have in common; a task adds a goal, `goal()` and `score()`.

    Actions are Box(−1, 1), one a lever in `self.levers`' order, positive in the actuator's positive sense. With
    `actions="strokes"` a cylinder's is the wanted place in its stroke (−1 one end, 1 the other); its valve is opened
    that way. Observations: all sensors (`self.senses.places`), how far valves are open, then the goal.
    """

    metadata: ClassVar[dict[str, Any]] = {"render_modes": []}
    seconds = 10.0
    """Of an episode, after which it is truncated."""

    def __init__(
        self,
        machine: str | Path,
        *,
        levers: Sequence[str] | None = None,
        base: Base = "floating",
        actions: Actions = "levers",
        boulder: bool = False,
        timestep: float | None = None,
        seconds: float | None = None,
    ) -> None:
        """`machine`: the USD file of a build. `levers`: the actuators that are commanded, the others hold (default: the
        task's). `timestep` of the engine and `seconds` of an episode: defaults are the class's.

        `YellowironError` where there is no such lever, or nothing to command.
        """
        more = {} if timestep is None else {"timestep": timestep}
        self.machine: MachineModel = load_machine(machine, base=base, boulder=boulder, **more)
        chosen = tuple(levers) if levers is not None else self.usual_levers()
        for name in chosen:
            if name not in self.machine.levers:
                raise YellowironError(
                    f"There is no lever '{name}'", where=str(machine), hint=f"Known: {', '.join(self.machine.levers)}."
                )
        if not chosen:
            raise YellowironError(
                "The machine has no lever for this task", where=str(machine), hint="Take another task or machine."
            )
        self.levers: tuple[Lever, ...] = tuple(self.machine.levers[name] for name in chosen)
        self.actions = actions
        self.model = self.machine.model
        self.data = mujoco.MjData(self.model)
        self.senses = Senses(self.machine.mechanism, self.model)
        self._between = max(1, round(OIL / self.model.opt.timestep))
        self._turns = max(1, round(CONTROL / (self._between * self.model.opt.timestep)))
        self._steps = max(1, round((seconds or self.seconds) / self.dt))
        self._oil = self.machine.oil()
        circuits = self._oil.circuits if self._oil is not None else {}
        dofs = {c.slide: self.model.joint(c.slide) for c in circuits.values()}
        self._slides = {name: (int(j.qposadr[0]), int(j.dofadr[0])) for name, j in dofs.items()}
        self._servos = {name: self.machine.levers[name].controls[0] for name in circuits if name in self.machine.levers}
        self._open = np.zeros(len(self.levers))
        self._count = 0
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (len(self.levers),), np.float32)
        mujoco.mj_forward(self.model, self.data)
        self._aim()
        size = self.senses.size + len(self.levers) + len(self.goal())
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (size,), np.float32)

    @property
    def dt(self) -> float:
        """Seconds between two actions."""
        return float(self._turns * self._between * self.model.opt.timestep)

    # ---- what a task says -------------------------------------------------------------------------------------------
    def usual_levers(self) -> tuple[str, ...]:
        """The actuators that are commanded where nobody names any."""
        return tuple(self.machine.levers)

    def goal(self) -> Floats:
        """What an observation says of the goal, (n,)."""
        raise NotImplementedError

    def score(self, action: Floats) -> tuple[float, bool, bool]:
        """The reward of the step just done, whether the task is done now, and whether the episode ends with it."""
        raise NotImplementedError

    def _aim(self) -> None:
        """Chooses a goal with `self.np_random`, the machine at rest."""
        raise NotImplementedError

    # ---- Gymnasium --------------------------------------------------------------------------------------------------
    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """The machine as drawn, at rest, and a new goal."""
        super().reset(seed=seed, options=options)
        mujoco.mj_resetData(self.model, self.data)
        self._oil = self.machine.oil()
        self._open[:] = 0.0
        self._count = 0
        self._aim()
        mujoco.mj_forward(self.model, self.data)
        if self.machine.model.ngeom:
            for _ in range(round(SETTLE / (self._between * self.model.opt.timestep))):
                self._turn(np.zeros(len(self.levers)))
        mujoco.mj_forward(self.model, self.data)
        return self._observe(), {"success": False}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Holds levers for `dt` seconds. `info["success"]`: whether the task is done now."""
        told = np.clip(np.asarray(action, dtype=np.float64), -1.0, 1.0)
        for _ in range(self._turns):
            self._turn(told)
        # Sensors and sites are those of the step's start otherwise.
        mujoco.mj_forward(self.model, self.data)
        self._count += 1
        lost = not np.isfinite(self.data.qpos).all()
        reward, success, ends = self.score(told) if not lost else (0.0, False, True)
        seen = self._observe() if not lost else np.zeros(self.observation_space.shape or (0,), np.float32)
        return seen, float(reward), bool(ends), self._count >= self._steps, {"success": bool(success)}

    def _observe(self) -> Any:
        return np.concatenate([self.senses.read(self.data), self._open, self.goal()]).astype(np.float32)

    # ---- the machine ------------------------------------------------------------------------------------------------
    def _turn(self, told: Floats) -> None:
        """One step of the hydraulics, and the engine's steps until the next."""
        data, seconds = self.data, self._between * self.model.opt.timestep
        wanted = {lever.name: self._wanted(lever, float(value)) for lever, value in zip(self.levers, told, strict=True)}
        if self._oil is not None:
            strokes = {slide: float(data.qpos[place]) for slide, (place, _) in self._slides.items()}
            forces = {slide: float(data.qfrc_actuator[dof]) for slide, (_, dof) in self._slides.items()}
            own = {name: value for name, value in wanted.items() if name in self._servos}
            targets = self._oil.step(own, strokes, seconds, forces=forces)
            for name, control in self._oil.controls(targets).items():
                data.ctrl[self._servos[name]] = control
        most = seconds / SPOOL
        for number, lever in enumerate(self.levers):
            self._open[number] += float(np.clip(wanted[lever.name] - self._open[number], -most, most))
            if lever.speed is not None:
                data.ctrl[list(lever.controls)] = self._shared(lever, self._open[number] * lever.speed)
        mujoco.mj_step(self.model, data, self._between)

    def _wanted(self, lever: Lever, told: float) -> float:
        """The lever, −1 … 1, for an action."""
        if self.actions == "levers" or lever.speed is not None or self._oil is None:
            return told
        circuit = self._oil.circuits[lever.name]
        middle, half = 0.5 * (circuit.upper + circuit.lower), 0.5 * (circuit.upper - circuit.lower)
        way = middle + circuit.sign * told * half - float(self.data.qpos[self._slides[circuit.slide][0]])
        return float(np.clip(circuit.sign * way / (2.0 * half * REACHED), -1.0, 1.0))

    def _shared(self, lever: Lever, speed: float) -> Floats:
        """The controls of a motor with several wheels: they get one torque, as open differentials give it, so that in a
        curve each turns as fast as it rolls."""
        numbers = list(lever.controls)
        joints = self.model.actuator_trnid[numbers, 0]
        turning = self.model.actuator_gear[numbers, 0] * self.data.qvel[self.model.jnt_dofadr[joints]]
        low, high = self.model.actuator_ctrlrange[numbers].T
        told = turning + speed - turning.mean()
        return np.asarray(np.clip(told, low, high) if (high > low).all() else told, dtype=np.float64)
