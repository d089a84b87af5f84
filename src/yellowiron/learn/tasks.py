"""Three tasks: the tool to a pose in a trench, a boulder into the tool and up, the machine to a point.

Importing this module gives Gymnasium their names, `yellowiron/TrenchPose-v0`, `yellowiron/LoadBoulder-v0` and
`yellowiron/DriveTo-v0`. Soil there is none: nothing resists a tool in the ground, and what is loaded is a rigid rock.
"""

from __future__ import annotations

import functools
import math
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from yellowiron.kinematics import ClosedChain
from yellowiron.learn.environment import MachineEnv, register
from yellowiron.learn.model import BOULDER, MachineModel, load_machine
from yellowiron.model.geometry import Floats

POSES = 200
"""Poses of the tool that a trench's goals are taken from."""
NEAR, TURNED = 0.15, 0.15
"""Metres and radians: a tool this near to its goal is there."""
SIDEWAYS = math.radians(60.0)
"""A goal is no farther to either side, where something swings the tool."""
ARRIVED = 1.0
"""Metres: the machine has come to its goal."""
LIFTED = 1.0
"""Metres over the ground that a boulder's lowest point is to be lifted."""
_SMOOTH = 0.01
"""What moving levers to and fro costs, a unit of lever."""
_SEED = 7


class TrenchPose(MachineEnv):
    """Brings the tool's tip to a point and its floor to an angle, both drawn from poses that the linkage reaches, below
    the ground where some are. The base is held. The goal, and where the tool is, are told in cylinder coordinates about
    the vertical through the machine's origin (an excavator's swing axis), as a guidance system works them out of the
    encoders: distance, height and angle still to go, then where it is."""

    seconds = 8.0

    def __init__(self, machine: str | Path, **more: Any) -> None:
        """As `MachineEnv`'s; the base is fixed unless `base` says otherwise."""
        built = load_machine(machine, base=more.get("base", "fixed"))
        self._poses = _reachable(built)
        self._wanted_pose = self._poses[0]
        self._before: Floats | None = None
        super().__init__(machine, **{"base": "fixed", **more})

    def usual_levers(self) -> tuple[str, ...]:
        """Those that move the tool."""
        return self.machine.digging

    def goal(self) -> Floats:
        """Radial way, sideways way, height (m) and angle (half turns) still to go; then the distance from the axis and
        the height (in fives of metres), sine and cosine of the angle."""
        now = self._pose()
        way = self._way(now)
        far = [now[0] / 5.0, now[2] / 5.0, math.sin(now[3]), math.cos(now[3])]
        return np.array([*way[:3], way[3] / math.pi, *far])

    def score(self, action: Floats) -> tuple[float, bool, bool]:
        """Less for every metre and radian that is left, and for levers moved to and fro; 1 more at the goal."""
        way = self._way(self._pose())
        distance, angle = float(np.linalg.norm(way[:3])), abs(float(way[3]))
        there = distance < NEAR and angle < TURNED
        restless = 0.0 if self._before is None else float(np.abs(action - self._before).sum())
        self._before = action.copy()
        return float(there) - 0.2 * distance - 0.1 * angle - _SMOOTH * restless, there, False

    def _aim(self) -> None:
        self._before = None
        chosen = self._poses[int(self.np_random.integers(len(self._poses)))].copy()
        if any(lever.speed is not None for lever in self.levers):
            chosen[1] += float(self.np_random.uniform(-SIDEWAYS, SIDEWAYS))
        self._wanted_pose = chosen

    def _way(self, now: Floats) -> Floats:
        """Metres outwards, sideways and up, and radians, from a pose to the goal."""
        goal = self._wanted_pose
        aside = math.remainder(goal[1] - now[1], 2.0 * math.pi)
        return np.array(
            [goal[0] - now[0], goal[0] * aside, goal[2] - now[2], math.remainder(goal[3] - now[3], 2.0 * math.pi)]
        )

    def _pose(self) -> Floats:
        """The tip now, as `cylindrical`, in the root's frame."""
        root, body = self.data.body(self.machine.mechanism.root), self.data.body(self.machine.tip.body)
        turn = root.xmat.reshape(3, 3).T
        origin = np.asarray(self.machine.mechanism.body(self.machine.mechanism.root).origin)
        place = turn @ (self.data.site(self.machine.tip.name).xpos - root.xpos) + origin
        return cylindrical(place, turn @ body.xmat.reshape(3, 3)[:, 0])


class LoadBoulder(MachineEnv):
    """Takes up a boulder that lies before the tool, and lifts it. The boulder, a rigid ball of rock, touches the ground
    and the tool's hollow colliders; the task is done while it is in the tool and `LIFTED` over the ground."""

    seconds = 20.0

    def __init__(self, machine: str | Path, **more: Any) -> None:
        """As `MachineEnv`'s; the machine stands on the ground."""
        super().__init__(machine, **{**more, "boulder": True, "base": "floating"})

    def goal(self) -> Floats:
        """The boulder from the middle of what the tool holds, in the tool's frame (m), and its height (m)."""
        return np.array([*self._apart(), float(self.data.body(BOULDER).xpos[2]) - self.machine.boulder])

    def score(self, action: Floats) -> tuple[float, bool, bool]:
        """Less for every metre between the boulder and its place, more for every metre that it is up; 1 more when
        done."""
        apart, height = float(np.linalg.norm(self._apart())), float(self.data.body(BOULDER).xpos[2])
        held = apart < 3.0 * self.machine.boulder
        up = min(max(height - self.machine.boulder, 0.0), LIFTED) if held else 0.0
        done = held and up >= LIFTED
        return float(done) + up - 0.1 * apart - _SMOOTH * float(np.abs(action).sum()), done, False

    def _apart(self) -> Floats:
        """The boulder from the tool's middle, in the tool's frame, metres."""
        body = self.data.body(self.machine.middle.body)
        apart = self.data.body(BOULDER).xpos - self.data.site(self.machine.middle.name).xpos
        return np.asarray(body.xmat.reshape(3, 3).T @ apart, dtype=np.float64)

    def _aim(self) -> None:
        radius, tip = self.machine.boulder, np.asarray(self.machine.tip.position)
        start = int(self.model.joint(BOULDER).qposadr[0])
        out = float(np.hypot(tip[0], tip[1])) + radius + float(self.np_random.uniform(0.2, 1.5))
        swings = any(lever.speed is not None and lever.name in self.machine.digging for lever in self.levers)
        if swings:
            out = 0.8 * float(np.hypot(tip[0], tip[1])) + float(self.np_random.uniform(-0.5, 0.5))
        aside = math.atan2(tip[1], tip[0]) + float(self.np_random.uniform(-0.05, 0.05))
        self.data.qpos[start : start + 3] = (out * math.cos(aside), out * math.sin(aside), radius)


class DriveTo(MachineEnv):
    """Drives to a point on flat ground, 5 to 15 m off. The goal is told as the machine's receivers and compass have it:
    metres forward and to the left, in tens, and the way the machine faces."""

    seconds = 30.0

    def __init__(self, machine: str | Path, **more: Any) -> None:
        """As `MachineEnv`'s; the machine stands on the ground."""
        self._point = np.zeros(2)
        self._left = 0.0
        super().__init__(machine, **{**more, "base": "floating"})

    def usual_levers(self) -> tuple[str, ...]:
        """Motors of wheels or tracks, and what steers them."""
        return self.machine.driving

    def goal(self) -> Floats:
        """The point ahead and to the left, tens of metres; sine and cosine of the machine's heading."""
        ahead, heading = self._ahead()
        return np.array([*(ahead / 10.0), math.sin(heading), math.cos(heading)])

    def score(self, action: Floats) -> tuple[float, bool, bool]:
        """Metres that it has come nearer, and 10 for arriving, which ends the episode."""
        left = float(np.linalg.norm(self._ahead()[0]))
        nearer, self._left = self._left - left, left
        return nearer + 10.0 * (left < ARRIVED) - _SMOOTH * float(np.abs(action).sum()), left < ARRIVED, left < ARRIVED

    def _ahead(self) -> tuple[Floats, float]:
        """The goal in the machine's frame, (2,) m, and the machine's heading, rad."""
        root = self.data.body(self.machine.mechanism.root)
        along = root.xmat.reshape(3, 3)[:2, 0]
        heading = math.atan2(along[1], along[0])
        # The root's frame stands off the machine's origin; as drawn that is where the machine is.
        origin = np.asarray(self.machine.mechanism.body(self.machine.mechanism.root).origin)[:2]
        cosine, sine = math.cos(heading), math.sin(heading)
        turn = np.array([[cosine, sine], [-sine, cosine]])
        return turn @ (self._point - root.xpos[:2]) + origin, heading

    def _aim(self) -> None:
        far, aside = float(self.np_random.uniform(5.0, 15.0)), float(self.np_random.uniform(-1.0, 1.0))
        self._point = far * np.array([math.cos(aside), math.sin(aside)])
        mujoco.mj_forward(self.model, self.data)
        self._left = float(np.linalg.norm(self._ahead()[0]))


def cylindrical(place: Floats, along: Floats) -> Floats:
    """Of a point (3,) and a tool's own x axis (3,): distance from the vertical through the origin (m), angle about it
    (rad), height (m), and the axis's angle over the level, seen along the way out (rad)."""
    out = np.array([place[0], place[1], 0.0]) / max(float(np.hypot(place[0], place[1])), 1e-9)
    return np.array(
        [
            float(np.hypot(place[0], place[1])),
            math.atan2(place[1], place[0]),
            float(place[2]),
            math.atan2(float(along[2]), float(along @ out)),
        ]
    )


@functools.lru_cache(maxsize=8)
def _reachable(machine: MachineModel) -> Floats:
    """Poses (n, 4) of the tip, as `cylindrical`, over strokes drawn evenly: those below the ground where a tenth is."""
    rng, mechanism = np.random.default_rng(_SEED), machine.mechanism
    chain = ClosedChain(mechanism)
    slides = {
        name: mechanism.joint(lever.joints[0])
        for name, lever in machine.levers.items()
        if lever.speed is None and name in machine.digging and lever.joints[0] in chain.independent
    }
    found = []
    for _ in range(POSES):
        wanted = {}
        for joint in slides.values():
            low, high = joint.lower or 0.0, joint.upper or 0.0
            wanted[joint.name] = float(low + rng.uniform(0.05, 0.95) * (high - low))
        state, _ = chain.reach(wanted)
        moved = chain.displacement(state, machine.tip.body)
        found.append(cylindrical(moved[:3, :3] @ np.asarray(machine.tip.position) + moved[:3, 3], moved[:3, 0]))
    poses = np.array(found)
    below = poses[poses[:, 2] < 0.0]
    return below if len(below) * 10 >= len(poses) else poses


for _name, _task in (("TrenchPose", TrenchPose), ("LoadBoulder", LoadBoulder), ("DriveTo", DriveTo)):
    register(f"yellowiron/{_name}-v0", _task)
