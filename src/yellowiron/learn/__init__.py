"""Gymnasium environments of a built machine: its USD file in, levers as actions and its own sensors as observations.

    import gymnasium
    env = gymnasium.make("yellowiron.learn.tasks:yellowiron/TrenchPose-v0", machine="out/excavator/excavator.usda")

In the order in which they build on each other: `model` (the machine in MuJoCo by its MJCF, with what touches anything),
`senses` (its sensors' readings, scaled), `environment` (levers through the oil, step by step), `tasks` (what is to be
done). It needs the extra `learn`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.learn.environment import MachineEnv
    from yellowiron.learn.model import MachineModel, load_machine
    from yellowiron.learn.tasks import DriveTo, LoadBoulder, TrenchPose

__all__ = ["DriveTo", "LoadBoulder", "MachineEnv", "MachineModel", "TrenchPose", "load_machine"]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "DriveTo": "tasks",
        "LoadBoulder": "tasks",
        "MachineEnv": "environment",
        "MachineModel": "model",
        "TrenchPose": "tasks",
        "load_machine": "model",
    },
)
