"""Closed-chain kinematics: Gauss-Newton on MuJoCo's own constraint residual and Jacobian, in double precision.

The machine's independent coordinates (driven slides, motor pivots, joints declared free) are given; all others follow
from the loops. Every solve continues from a solved state in steps, so that it stays on the assembly branch of the
drawn pose, and stops at a dead point instead of jumping over it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from yellowiron.kinematics.solver.floating import attached
from yellowiron.kinematics.solver.independence import locked_error, square_system, suspects
from yellowiron.kinematics.solver.multibody import build, reduced_masses, transverse
from yellowiron.kinematics.solver.positions import continued
from yellowiron.kinematics.tolerances import CLOSED, RANK
from yellowiron.model.errors import MechanismError
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism, chained, independent_joints
from yellowiron.support.spatial import idle_spins
from yellowiron.support.text import with_article

_STEP = {"prismatic": 0.2, "revolute": 0.35}
"""Longest step between solved states, metres or radians, so that they stay on the branch."""
_ITERATIONS = 12
"""Newton's, after which a step is halved."""
_CORRECTION, _CONTRACTION = 0.2, 0.5
"""Linkages with balls may have several poses at the same strokes that no sign tells apart: a step there is no longer
than that Newton's corrections stay below this (m, rad) and shrink the gaps by this each time, so that it stays near its
own."""
_SMALL_GAP = 1e-9
"""Metres from which on rounding may slow that down."""
_SHORTEST = 1e-7
"""Share of the way below which a halved step is a dead point."""
_NEAR, _SMALL = 1e-3, 0.05
"""Metres or radians: a row of a sweep is tried in one step where the last states lead this near to it, and it is no
farther than that from the last one."""


class KinematicsError(MechanismError):
    """A pose that the linkage cannot take. `reached` is the last state on the way there that it can, and `fraction` how
    much of the way that is."""

    reached: State
    fraction: float = 0.0


@dataclass(frozen=True, eq=False)
class State:
    """A solved pose: `position`, all tree coordinates in the solver's order (read them with `ClosedChain.coordinate`);
    `closure`, the largest gap in metres over every loop's connections, the redundant ones of overconstrained loops
    included."""

    position: Floats
    closure: float = 0.0


@dataclass(frozen=True)
class Component:
    """Coordinates that loops couple, or joints that follow others: the `drivers` that are given, the `dependent` tree
    joints that follow from them, and the `cuts` of those loops."""

    drivers: tuple[str, ...]
    dependent: tuple[str, ...]
    cuts: tuple[str, ...]


class ClosedChain:
    """The closed-chain kinematics of a mechanism, its root held still. Coordinates are 0 in the drawn pose; lengths in
    metres, angles in radians, poses in the machine frame. Not safe for use by several threads at once.

    `mechanism` is what was given without its floating chains, whose bodies stay with the root as they are drawn.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        """Builds the model and chooses, in the drawn pose, which equations and coordinates make a square system.

        Raises `MechanismError` where the joints are no tree with cuts.
        """
        floating = chained(mechanism)
        self.mechanism = mechanism = attached(mechanism)
        self._body = build(mechanism)
        self._model = self._body.model
        self._data = mujoco.MjData(self._model)
        self._joints = {joint.name: joint for joint in mechanism.joints}
        self.spins = idle_spins(mechanism)
        """Links that can spin idly; here they do not twist."""
        self._follows = [(joint.name, joint.follows) for joint in mechanism.joints if joint.follows is not None]
        self._origins = {body.name: np.array(body.origin, dtype=np.float64) for body in mechanism.bodies}
        for name in floating:
            self._body.bodies[name] = self._body.bodies[mechanism.root]
            self._origins[name] = self._origins[mechanism.root]
        self._axes = {joint.name: transverse(joint.axis) for joint in mechanism.joints if joint.type in _STEP}
        self._jacobian = np.zeros((0, self._model.nv))
        self._gaps = np.zeros(0)
        self._placed: State | None = None
        self._moving: tuple[State, str, Floats] | None = None
        self.drawn = State(np.array(self._model.qpos0, dtype=np.float64))
        size = float(np.ptp(np.array([joint.anchor for joint in mechanism.joints] or [(0, 0, 0)]), axis=0).max())
        self._tolerance = CLOSED * max(1.0, size / 10.0)
        self._evaluate(self.drawn.position)
        self._choose()

    # ---- what moves -------------------------------------------------------------------------------------------------
    def _choose(self) -> None:
        """Independent and dependent coordinates, and the closure equations that determine the latter."""
        given = [name for name in independent_joints(self.mechanism) if name in self._body.joints]
        fixed = np.zeros(self._model.nv, dtype=bool)
        for name in given:
            fixed[self._dofs(name)] = True
        loose = np.flatnonzero(~fixed)
        system = square_system(self._jacobian, loose, self._body.cuts.values(), len(self._follows) + len(self.spins))
        if system is None:
            raise MechanismError(
                "the drawn pose is at a dead point of a loop",
                where=", ".join(self._body.cuts),
                hint=suspects(self.mechanism) or "Draw another pose.",
            )
        self._rows, self._columns = system
        self._block = np.ix_(self._rows, self._columns)
        dependent = {int(column) for column in self._columns}
        self.independent: tuple[str, ...] = tuple(n for n in given if self._joints[n].type != "spherical")
        """Joints whose coordinates are given: driven, motor and free ones. A free ball has none that could be: what
        hangs on it stays as drawn."""
        self.dependent: tuple[str, ...] = tuple(
            name for name in self._body.joints if any(d in dependent for d in self._dofs(name))
        )
        """Tree joints whose coordinates follow from the loops, or from the joints that lead them."""
        self.idle: tuple[str, ...] = tuple(
            name for name in self._body.joints if name not in given and name not in self.dependent
        )
        """Tree joints that are neither: nothing drives them and no loop determines them."""
        self._given = np.array([self._dofs(name)[0] for name in self.independent], dtype=int)
        self._beside = np.ix_(self._rows, self._given)
        self._sign = self._orientation()

    def _dofs(self, joint: str) -> range:
        first = self._body.joints[joint][1]
        return range(first, first + (3 if self._joints[joint].type == "spherical" else 1))

    @property
    def balls(self) -> tuple[tuple[int, int], ...]:
        """Where the balls of the tree are in positions and in velocities."""
        return tuple(self._body.joints[n] for n in self._body.joints if self._joints[n].type == "spherical")

    @property
    def plain(self) -> bool:
        """Whether a state's position is one number a coordinate: no ball among the tree's joints."""
        return bool(self._model.nq == self._model.nv)

    @property
    def degrees_of_freedom(self) -> int:
        """Tree coordinates less the rank of the constraint Jacobian (singular values) in the drawn pose."""
        return int(self._model.nv) - self._rank()

    @property
    def undetermined(self) -> int:
        """How many ways are left to move in the drawn pose with all independent coordinates held, where others hold
        each other: there drives are at a dead point."""
        return self._rank() - len(self._rows)

    def _rank(self) -> int:
        jacobian = self._at(self.drawn)
        values = np.linalg.svd(jacobian, compute_uv=False) if jacobian.size else np.zeros(0)
        return int(np.count_nonzero(values > RANK * max(1.0, float(values.max(initial=0.0)))))

    def components(self) -> tuple[Component, ...]:
        """The groups of coordinates that the loops couple, in the mechanism's order."""
        jacobian = np.abs(self._at(self.drawn)) > 1e-9
        groups: list[tuple[set[int], list[str]]] = []
        coupling = [([c], [3 * point + row for point in p for row in range(3)]) for c, p in self._body.cuts.items()]
        coupling += [([], [row]) for row in range(3 * len(self._body.bases), len(jacobian))]
        for cut, rows in coupling:
            columns = {int(c) for c in np.flatnonzero(jacobian[rows].any(axis=0))}
            joined = [group for group in groups if group[0] & columns]
            merged = (columns.union(*(g[0] for g in joined)), [*(name for g in joined for name in g[1]), *cut])
            groups = [group for group in groups if group not in joined] + [merged]

        def moving(names: Sequence[str], columns: set[int]) -> tuple[str, ...]:
            return tuple(name for name in names if not columns.isdisjoint(self._dofs(name)))

        return tuple(
            Component(moving(self.independent, columns), moving(self.dependent, columns), tuple(cuts))
            for columns, cuts in groups
        )

    # ---- solving ----------------------------------------------------------------------------------------------------
    def solve(self, targets: Mapping[str, float], *, start: State | None = None) -> State:
        """The state in which the given independent coordinates have these values, reached step by step from `start`
        (default: the drawn pose); coordinates that are not named stay as they are in `start`.

        Raises `KinematicsError`, which carries the last good state, where a dead point or the linkage's geometry is in
        the way.
        """
        begin = self.drawn if start is None else start
        state, fraction = self.reach(targets, start=begin)
        if fraction < 1.0:
            error = KinematicsError(
                f"the linkage cannot follow: it locks after {100.0 * fraction:.2f} % of the way",
                where=", ".join(targets),
                hint="Past a dead point no pose exists on this branch; check stroke, closed length and pin positions.",
            )
            error.reached, error.fraction = state, fraction
            raise error
        return state

    def reach(self, targets: Mapping[str, float], *, start: State | None = None) -> tuple[State, float]:
        """Like `solve`, but returns the last state that could be reached and the share of the way it is (1: all)."""
        begin = self.drawn if start is None else start
        indices = np.array([self._index(name) for name in targets], dtype=int)
        wanted = np.array(list(targets.values()), dtype=np.float64)
        steps = np.array([_STEP[self._joints[name].type] for name in targets])
        origin = begin.position[indices]
        way = wanted - origin
        length = float(np.max(np.abs(way) / steps, initial=0.0))
        state, done, stride = begin, 0.0, 1.0 if length <= 1.0 else 1.0 / math.ceil(length)
        while done < 1.0:
            ahead = min(1.0, done + stride)
            position = state.position.copy()
            position[indices] = wanted if ahead == 1.0 else origin + ahead * way
            if self._close(position):
                state, done = self._accept(position), ahead
                stride = min(2.0 * stride, 1.0 / max(1.0, length))
            else:
                stride *= 0.5
                if stride < _SHORTEST:
                    return state, done
        return state, 1.0

    def sweep(self, paths: Mapping[str, Sequence[float] | Floats], *, start: State | None = None) -> tuple[State, ...]:
        """The states along paths of independent coordinates: equally many values each, one after the other.

        Shorter than the paths where the linkage locks; nothing is solved beyond that point.
        """
        names = list(paths)
        indices = np.array([self._index(name) for name in names], dtype=int)
        table = np.array([np.asarray(paths[name], dtype=np.float64) for name in names]).T
        state = self.drawn if start is None else start
        states: list[State] = []
        for row in table:
            # Paths are mostly smooth: guess the dependent coordinates from the last states.
            last = [each.position for each in states[-3:]]
            position = continued(last, self.balls) if len(last) == 3 else state.position.copy()
            near = float(np.abs(row - position[indices]).max(initial=0.0)) < _NEAR
            small = float(np.abs(row - state.position[indices]).max(initial=0.0)) < _SMALL
            position[indices] = row
            if near and small and self._close(position):
                state = self._accept(position)
            else:
                after, fraction = self.reach(dict(zip(names, row.tolist(), strict=True)), start=state)
                if fraction < 1.0:
                    break
                state = after
            states.append(state)
        return tuple(states)

    def combined(self, one: State, component: Component, other: State) -> State:
        """`other` with the coordinates of a component as they are in `one`: no solving is needed, as no loop couples
        them to the rest."""
        position = other.position.copy()
        for name in (*component.drivers, *component.dependent):
            first = self._body.joints[name][0]
            index = slice(first, first + (4 if self._joints[name].type == "spherical" else 1))
            position[index] = one.position[index]
        return State(position, max(one.closure, other.closure))

    def _index(self, joint: str) -> int:
        if joint in self.independent or joint in self.idle:
            if self._joints[joint].type == "spherical":
                raise MechanismError(
                    "a spherical joint takes no single target", where=joint, hint="Name another joint."
                )
            return self._body.joints[joint][0]
        known = joint in self._joints
        raise MechanismError(
            "the joint's coordinate follows from the loops and cannot be given" if known else "no such joint",
            where=joint,
            hint=f"Given ones are: {', '.join(self.independent) or 'none'}.",
        )

    def _close(self, position: Floats) -> bool:
        """Newton on the dependent coordinates of `position`, in place; false where it does not converge, or closes on
        the other side of a dead point."""
        previous = math.inf
        step = np.zeros(self._model.nv)
        for _ in range(_ITERATIONS):
            self._evaluate(position)
            gaps = self._gaps[self._rows]
            worst = float(np.abs(gaps).max(initial=0.0))
            if worst <= self._tolerance:
                return self._orientation() == self._sign
            if not worst < previous:  # also catches NaN
                return False
            if not self.plain and worst > max(_CONTRACTION * previous, _SMALL_GAP):
                return False
            previous = worst
            try:
                correction = np.linalg.solve(self._jacobian[self._block], -gaps)
            except np.linalg.LinAlgError:
                return False
            if float(np.abs(correction).max()) > (1.0 if self.plain else _CORRECTION):
                return False
            step[self._columns] = correction
            mujoco.mj_integratePos(self._model, position, step, 1.0)
        return False

    def _orientation(self) -> float:
        """Sign of the square closure Jacobian's determinant: it changes at a dead point and nowhere else."""
        return float(np.sign(np.linalg.det(self._jacobian[self._block]))) if len(self._rows) else 1.0

    def _accept(self, position: Floats) -> State:
        """The state of a position whose residual was just evaluated."""
        state = State(position, float(np.abs(self._gaps).max(initial=0.0)))
        self._placed = state
        return state

    def _evaluate(self, position: Floats) -> None:
        """Gaps (rows: 3 a connection point, in the cut's own frame on `body0`, then one a joint that follows, then one
        an idle spin) and their Jacobian at a position."""
        data, model = self._data, self._model
        data.qpos[:] = position
        self._placed = None
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        if len(self._body.bases):
            mujoco.mj_makeConstraint(model, data)
            points = len(self._body.bases)
            if data.nefc != 3 * points:
                raise locked_error(self.mechanism, tuple(self._body.cuts))
            turned = self._body.frames @ data.xmat[self._body.bases].reshape(points, 3, 3).transpose(0, 2, 1)
            self._gaps = (turned @ data.efc_pos.reshape(points, 3, 1)).reshape(-1)
            self._jacobian = (turned @ data.efc_J.reshape(points, 3, model.nv)).reshape(3 * points, model.nv)
        if self._follows or self.spins:
            self._evaluate_coupled(position)

    def _evaluate_coupled(self, position: Floats) -> None:
        """Puts a row below those of the loops for every joint that follows: how far it is from where it should be; and
        for every link that can spin: how far it is twisted (half, in radians, of the ball that leads to it)."""
        loops = 3 * len(self._body.bases)
        rows = np.zeros((len(self._follows) + len(self.spins), self._model.nv))
        gaps = np.zeros(len(rows))
        for number, (name, follows) in enumerate(self._follows):
            own, led = self._body.joints[name], self._body.joints[follows.joint]
            gaps[number] = position[own[0]] - follows.ratio * position[led[0]] - follows.offset
            rows[number, own[1]] = 1.0
            rows[number, led[1]] -= follows.ratio
        for number, spin in enumerate(self.spins, len(self._follows)):
            first, column = self._body.joints[spin.ball]
            w, vector = position[first], position[first + 1 : first + 4]
            gaps[number] = vector @ spin.line
            (a, b, c), (x, y, z) = spin.line.tolist(), vector.tolist()
            across = (b * z - c * y, c * x - a * z, a * y - b * x)  # numpy.cross takes ten times as long
            rows[number, column : column + 3] = 0.5 * (w * spin.line + across)
        self._gaps = np.concatenate([self._gaps[:loops], gaps])
        self._jacobian = np.concatenate([self._jacobian[:loops], rows])

    def _at(self, state: State) -> Floats:
        """Brings the model to a state; returns the closure Jacobian there."""
        if self._placed is not state:
            self._evaluate(state.position)
            self._placed = state
        return self._jacobian

    # ---- reading a state --------------------------------------------------------------------------------------------
    def pose(self, state: State) -> dict[str, Floats]:
        """Body → (4, 4) displacement from the drawn pose: apply it to points in drawn machine coordinates."""
        self._at(state)
        return {name: self._displacement(name) for name in self._body.bodies}

    def displacement(self, state: State, body: str) -> Floats:
        """(4, 4) displacement of one body from the drawn pose, machine frame."""
        self._at(state)
        return self._displacement(body)

    def placements(self, states: Sequence[State]) -> tuple[Floats, Floats]:
        """Rotations (n, bodies, 3, 3) and origins (n, bodies, 3) of all body frames in n states; `body_index` says
        which is whose."""
        count = self._model.nbody
        rotations, origins = np.empty((len(states), count, 3, 3)), np.empty((len(states), count, 3))
        for number, state in enumerate(states):
            self._data.qpos[:] = state.position
            mujoco.mj_kinematics(self._model, self._data)
            rotations[number] = self._data.xmat.reshape(count, 3, 3)
            origins[number] = self._data.xpos
        self._placed = None
        return rotations, origins

    def joint_axes(self, joint: str) -> Floats:
        """Rows (3, 3): a joint's axis and two normals to it, drawn pose, machine frame; its angle turns the second
        towards the third."""
        return self._axes[joint]

    def body_index(self, body: str) -> int:
        """A body's place in `placements`."""
        return self._body.bodies[body]

    def _displacement(self, body: str) -> Floats:
        index = self._body.bodies[body]
        matrix = np.eye(4)
        rotation = self._data.xmat[index].reshape(3, 3)
        matrix[:3, :3] = rotation
        matrix[:3, 3] = self._data.xpos[index] - rotation @ self._origins[body]
        return matrix

    def coordinate(self, state: State, joint: str) -> float:
        """Coordinate of any joint, cut ones included: metres, or radians (a cut pivot's within (−π, π])."""
        if joint in self._body.joints and self._joints[joint].type != "spherical":
            return float(state.position[self._body.joints[joint][0]])
        entry = self._joints[joint]
        if entry.type != "revolute":
            raise MechanismError(
                f"{with_article(entry.type)} joint has no single coordinate", where=joint, hint="Ask for its rotation."
            )
        self._at(state)
        relative = self._rotation(entry.body0).T @ self._rotation(entry.body1)
        _, b, c = self._axes[joint]
        turned = relative @ b
        return math.atan2(float(c @ turned), float(b @ turned))

    def quaternion(self, state: State, joint: str) -> Floats:
        """Unit quaternion (4,) w, x, y, z of a spherical tree joint: its child against its parent, machine axes in the
        drawn pose."""
        first = self._body.joints[joint][0]
        return np.array(state.position[first : first + 4])

    def _rotation(self, body: str) -> Floats:
        return np.asarray(self._data.xmat[self._body.bodies[body]].reshape(3, 3), dtype=np.float64)

    def tangent(self, state: State, joint: str) -> Floats:
        """Velocities of all tree coordinates (nv,) per unit velocity of one independent coordinate, the others held."""
        jacobian = self._at(state)
        if self._moving is not None and self._moving[0] is state and self._moving[1] == joint:
            return self._moving[2]
        velocity = np.zeros(self._model.nv)
        column = self._dofs(joint)[0]
        velocity[column] = 1.0
        if len(self._rows):
            velocity[self._columns] = np.linalg.solve(jacobian[self._block], -jacobian[self._rows, column])
        self._moving = (state, joint, velocity)
        return velocity

    def tangents(self, state: State) -> Floats:
        """Velocities of all tree coordinates (nv, independent), metres or radians a second, per unit velocity of each
        independent one in turn, the others held: `tangent` of all at once."""
        jacobian = self._at(state)
        velocities = np.zeros((self._model.nv, len(self._given)))
        velocities[self._given, np.arange(len(self._given))] = 1.0
        if len(self._rows):
            velocities[self._columns] = np.linalg.solve(jacobian[self._block], -jacobian[self._beside])
        return velocities

    def rate(self, state: State, joint: str, tangent: Floats) -> float:
        """Velocity of any joint's coordinate, cut ones included, where the tree moves with `tangent`."""
        if joint in self._body.joints:
            return float(tangent[self._dofs(joint)[0]])
        entry = self._joints[joint]
        self._at(state)
        spins = []
        for body in (entry.body0, entry.body1):
            jacobian = np.zeros((3, self._model.nv))
            mujoco.mj_jacBody(self._model, self._data, None, jacobian, self._body.bodies[body])
            spins.append(jacobian @ tangent)
        return float(self._rotation(entry.body0) @ self._axes[joint][0] @ (spins[1] - spins[0]))

    def effective_mass(self, state: State, joint: str) -> float:
        """Mass (kg) or inertia (kg·m²) that an independent coordinate feels through the linkage: twice the kinetic
        energy of all bodies at unit velocity of that coordinate, the root held."""
        velocity = self.tangent(state, joint)
        momentum = np.zeros(self._model.nv)
        mujoco.mj_makeM(self._model, self._data)
        mujoco.mj_mulM(self._model, self._data, momentum, velocity)
        return float(velocity @ momentum)

    def masses(self, state: State) -> tuple[Floats, Floats]:
        """The mass matrix (independent, independent) in those coordinates, SI: the root held, and the root free."""
        return reduced_masses(self._model, self._data, self.tangents(state))

    def point_velocity(self, state: State, joint: str, body: str, point: Floats) -> Floats:
        """Velocity (3,) of a body's point (drawn machine coordinates) per unit velocity of an independent coordinate,
        the others and the root held."""
        velocity = self.tangent(state, joint)
        jacobian = np.zeros((3, self._model.nv))
        there = self._displacement(body) @ np.append(point, 1.0)
        mujoco.mj_jac(self._model, self._data, jacobian, None, there[:3], self._body.bodies[body])
        return np.asarray(jacobian @ velocity)

    def raised_mass(self, state: State, joint: str) -> float:
        """How fast the bodies' mass rises per unit velocity of an independent coordinate, the root held upright:
        Σ m·dz, kg·m per metre or radian. Times gravity, it is the force that holds the weight."""
        velocity = self.tangent(state, joint)
        jacobian = np.zeros((3, self._model.nv))
        mujoco.mj_jacSubtreeCom(self._model, self._data, jacobian, 0)
        return float(self._model.body_subtreemass[0] * (jacobian[2] @ velocity))
