"""Joint positions of a machine from its cylinders' strokes, the pins of its loops closed. Python and numpy alone.

A URDF is a tree, so each closed loop of the machine is cut at one pin. `joints.json`, beside this file in an export,
has the tree, the cuts and which joints are given; all others follow.

    machine = JointStates("joints.json")
    positions = machine.positions({"boom": 0.2, "bucket": -0.1})    # every movable joint of the URDF
    # message.name, message.position = list(positions), list(positions.values())

The copy in an export is a script, too: `python joint_states.py boom=0.2 bucket=-0.1` prints them.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_CLOSED = 1e-10
"""Metres and radians to which loops are closed."""
_LONGEST = 0.1
"""Metres or radians of a given joint from one solved pose to the next, so that loops stay on their branch."""
_SHORTEST = 1e-6
"""Share of the way below which a halved step means that the linkage locks."""
_FARTHEST = 0.3
"""Largest correction, metres or radians, that still leads to the pose beside the last one."""
_ITERATIONS = 15
_ARM = 0.5
"""Metres between the two points at which a cut pivot is held."""
_RANK = 1e-9


class LockedError(ValueError):
    """Strokes that the linkage cannot take together."""


class JointStates:
    """The joints of a machine. It goes on from the last pose that it was asked for; one object serves one thread."""

    def __init__(self, source: str | Path | Mapping[str, Any]) -> None:
        """`source`: the path of a `joints.json`, or what such a file holds."""
        if isinstance(source, (str, Path)):
            source = json.loads(Path(source).read_text(encoding="utf-8"))
        self._document: Mapping[str, Any] = source  # type: ignore[assignment]
        self._joints: list[Any] = list(self._document["joints"])
        self.names: tuple[str, ...] = tuple(j["name"] for j in self._joints if j["type"] != "fixed")
        """The movable joints, in the order of all arrays here."""
        self.given: tuple[str, ...] = tuple(self._document["given"])
        """The joints whose position is given: driven slides, motors, and what moves freely."""
        self.actuators: Mapping[str, Mapping[str, int]] = self._document["actuators"]
        """Lever → the joints that it moves, with their signs."""
        self._column = {name: place for place, name in enumerate(self.names)}
        self._loose = np.array([n not in self.given for n in self.names], dtype=bool)
        self._above: dict[str, list[int]] = {self._document["root"]: []}
        for joint in self._joints:
            own = [] if joint["type"] == "fixed" else [self._column[joint["name"]]]
            self._above[joint["child"]] = [*self._above[joint["parent"]], *own]
        looped = set().union(*(set(self._above[c["parent"]]) ^ set(self._above[c["child"]]) for c in self._held()))
        looped |= {self._column[f["leader"]] for f in self._document["follows"] if self._column[f["joint"]] in looped}
        self._stepped = np.array([place in looped for place in range(len(self.names))], dtype=bool)
        self._position = np.zeros(len(self.names))

    def positions(self, strokes: Mapping[str, float]) -> dict[str, float]:
        """Joint → its position, metres or radians from the drawn pose, for every movable joint.

        `strokes`: levers or given joints → their position, metres or radians from the drawn pose (a name of both is the
        lever's); those that are not named stay as they were, at first as drawn. `KeyError` where a name is neither;
        `LockedError` where the loops cannot close, and nothing has moved then.
        """
        wanted = self._position.copy()
        for name, value in strokes.items():
            if name in self.actuators:
                for joint, sign in self.actuators[name].items():
                    wanted[self._column[joint]] = sign * float(value)
            elif name in self.given:
                wanted[self._column[name]] = float(value)
            else:
                known = ", ".join((*self.actuators, *self.given))
                raise KeyError(f"'{name}' is no lever and no given joint; there are: {known}")
        begin, position = self._position, self._position
        # What is on no loop, such as a wheel, gets there at once.
        way = np.where(self._stepped & ~self._loose, wanted - begin, 0.0)
        length = float(np.abs(way).max(initial=0.0)) / _LONGEST
        done, stride = 0.0, 1.0 / max(1.0, float(np.ceil(length)))
        longest, before = stride, (position, 0.0)
        while done < 1.0:
            ahead = min(1.0, done + stride)
            guess = position.copy()
            if done > before[1]:
                guess += (position - before[0]) * ((ahead - done) / (done - before[1]))
            closed = self._close(np.where(self._loose, guess, wanted - (1.0 - ahead) * way))
            if closed is None:
                stride *= 0.5
                if stride < _SHORTEST:
                    raise LockedError(
                        f"The linkage locks after {100.0 * done:.2f} % of the way to {dict(strokes)}; the limits in "
                        "joints.json are what it can do"
                    )
                continue
            before, position, done = (position, done), closed, ahead
            stride = min(2.0 * stride, longest)
        self._position = position
        return dict(zip(self.names, position.tolist(), strict=True))

    def poses(self) -> dict[str, Floats]:
        """Link → (4, 4) pose of its frame at the last positions, in the URDF's `base_link`, which is the machine
        frame."""
        return self._frames(self._position)[0]

    def gap(self) -> float:
        """The largest distance, metres, of the two halves of a cut pin at the last positions."""
        frames, _, _ = self._frames(self._position)
        apart = [
            _at(frames[c["parent"]], c["in_parent"]) - _at(frames[c["child"]], c["in_child"]) for c in self._held()
        ]
        return max((float(np.linalg.norm(one)) for one in apart), default=0.0)

    def _held(self) -> list[Any]:
        return [cut for cut in self._document["cuts"] if cut["type"] != "distance"]

    def _close(self, position: Floats) -> Floats | None:
        """The position with all loops closed, by Gauss-Newton on what is not given; None where it does not converge.
        The array given may be written to."""
        for led in self._document["follows"]:
            position[self._column[led["joint"]]] = led["ratio"] * position[self._column[led["leader"]]] + led["offset"]
        previous = np.inf
        for _ in range(_ITERATIONS):
            gaps, jacobian = self._gaps(position)
            worst = float(np.abs(gaps).max(initial=0.0))
            if worst <= _CLOSED:
                return position
            if not worst < previous:
                return position if worst <= 100.0 * _CLOSED else None
            previous = worst
            step = np.linalg.lstsq(jacobian[:, self._loose], -gaps, rcond=_RANK)[0]
            if not float(np.abs(step).max(initial=0.0)) <= _FARTHEST:
                return None
            position = position.copy()
            position[self._loose] += step
        return None

    def _frames(self, position: Floats) -> tuple[dict[str, Floats], Floats, Floats]:
        """Poses of the links, and of every movable joint its axis and a point on it, in the machine frame."""
        root = np.eye(4)
        root[:3, 3] = self._document["origin"]
        frames = {self._document["root"]: root}
        axes, points = np.zeros((len(self.names), 3)), np.zeros((len(self.names), 3))
        for joint in self._joints:
            frame = frames[joint["parent"]].copy()
            frame[:3, 3] += frame[:3, :3] @ joint["origin"]
            if joint["type"] != "fixed":
                column = self._column[joint["name"]]
                axes[column], points[column] = frame[:3, :3] @ joint["axis"], frame[:3, 3]
                if joint["type"] == "prismatic":
                    frame[:3, 3] += position[column] * axes[column]
                else:
                    frame[:3, :3] = frame[:3, :3] @ _turn(joint["axis"], position[column])
            frames[joint["child"]] = frame
        return frames, axes, points

    def _gaps(self, position: Floats) -> tuple[Floats, Floats]:
        """What is open at a position, and its derivative by all movable joints."""
        frames, axes, points = self._frames(position)
        sliding = np.array([j["type"] == "prismatic" for j in self._joints if j["type"] != "fixed"], dtype=bool)
        gaps: list[Floats] = []
        rows: list[Floats] = []
        for cut in self._held():
            for arm in _arms(cut):
                row, ends = np.zeros((3, len(self.names))), []
                for side, sign in (("parent", -1.0), ("child", 1.0)):
                    point = _at(frames[cut[side]], np.add(cut[f"in_{side}"], arm))
                    ends.append(point)
                    columns = self._above[cut[side]]
                    moved = np.where(
                        sliding[columns, None], axes[columns], np.cross(axes[columns], point - points[columns])
                    )
                    row[:, columns] += sign * moved.T
                gaps.append(ends[1] - ends[0])
                rows.append(row)
        for led in self._document["follows"]:
            own, leader = self._column[led["joint"]], self._column[led["leader"]]
            row = np.zeros((1, len(self.names)))
            row[0, own], row[0, leader] = 1.0, -led["ratio"]
            gaps.append(np.array([position[own] - led["ratio"] * position[leader] - led["offset"]]))
            rows.append(row)
        for link in self._document["untwisted"]:
            gap, derivative = self._twist(link, position)
            row = np.zeros((1, len(self.names)))
            row[0, [self._column[name] for name in link["joints"]]] = derivative
            gaps.append(np.array([gap]))
            rows.append(row)
        if not gaps:
            return np.zeros(0), np.zeros((0, len(self.names)))
        return np.concatenate(gaps), np.concatenate(rows)

    def _twist(self, link: Any, position: Floats) -> tuple[float, Floats]:
        """How far a link between two balls is twisted about its line: the part along it of its ball's turn."""
        axes = {joint["name"]: joint["axis"] for joint in self._joints}
        turns = [_turn(axes[name], position[self._column[name]]) for name in link["joints"]]
        line = np.asarray(link["line"])
        whole = turns[0] @ turns[1] @ turns[2]
        before = (np.eye(3), turns[0], turns[0] @ turns[1])
        derivative = [
            _axial(_cross(first @ axes[name]) @ whole) @ line
            for first, name in zip(before, link["joints"], strict=True)
        ]
        return float(_axial(whole) @ line), np.array(derivative)


def _arms(cut: Any) -> list[Floats]:
    """From a cut's pin, the points at which it is held: one of a ball, two of a pivot, three of a weld."""
    axis = np.asarray(cut["axis"], dtype=np.float64)
    arms = [np.zeros(3)]
    if cut["type"] in ("revolute", "fixed"):
        arms.append(_ARM * axis)
    if cut["type"] == "fixed":
        beside = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
        arms.append(_ARM * beside / np.linalg.norm(beside))
    return arms


def _at(frame: Floats, point: Any) -> Floats:
    return np.asarray(frame[:3, 3] + frame[:3, :3] @ np.asarray(point))


def _cross(vector: Any) -> Floats:
    x, y, z = (float(v) for v in vector)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def _turn(axis: Any, angle: float) -> Floats:
    """The rotation (3, 3) about a unit axis."""
    cross = _cross(axis)
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross))


def _axial(matrix: Floats) -> Floats:
    """The vector of a matrix's skew part."""
    return 0.5 * np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]])
