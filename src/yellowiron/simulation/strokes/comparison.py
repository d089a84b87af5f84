"""An engine's poses against the closed-chain kinematics at the strokes that the engine measures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from yellowiron.kinematics import ClosedChain, State, branch_pivots
from yellowiron.kinematics.solver.branches import branch_sines
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulation.strokes.expected import led_over, solved
from yellowiron.support import guard

_PIVOTS = ("revolute", "spherical")
_CHUNK = 2000
_LED = 1e-8
"""Metres by which loops may stay open in poses between solved ones: near dead points too, pins are 0.1 µm off then."""


@dataclass(frozen=True)
class Worst:
    """The largest value of its kind: metres or radians, where and at which step."""

    value: float = 0.0
    where: str = ""
    step: int = 0


@dataclass(frozen=True, eq=False)
class Agreement:
    """How a stretch of steps agrees with the kinematics, the root's own motion taken out.

    `pin`: distance of a pin (or of a place on a slide that follows another joint), carried by either of its bodies,
    from where the kinematics has it; `gap`: between its places on its two bodies, for cut joints; `angle`: by which a
    body is turned from its pose, the spin of links between two balls apart (what hangs on a free ball has no pose to be
    in). `sines`: cut joint → the least signed sine at its loop's triangle of pivots, positive on the drawn branch.
    `followed` is false where poses were not finite or no pose of the kinematics belongs to the measured strokes.
    `pins`, `angles` (m ≤ n,): the worst of each step that was compared.
    """

    pin: Worst
    gap: Worst
    angle: Worst
    sines: dict[str, float]
    followed: bool
    pins: Floats = field(default_factory=lambda: np.zeros(0))
    angles: Floats = field(default_factory=lambda: np.zeros(0))


class Comparison:
    """Follows one machine: every stretch continues from the pose where the last one ended."""

    def __init__(self, mechanism: Mechanism, stride: int = 1) -> None:
        """`stride`: every so many steps the kinematics is solved; what lies between is led over, and solved too where
        its loops would stay open."""
        self._mechanism, self._stride = mechanism, stride
        self.chain = ClosedChain(mechanism)
        self._state: State = self.chain.drawn
        self._bodies = np.array([self.chain.body_index(body.name) for body in mechanism.bodies])
        number = {body.name: index for index, body in enumerate(mechanism.bodies)}
        self._root = number[mechanism.root]
        self._lines = [(number[body], spin.line) for spin in self.chain.spins for body in spin.bodies]
        hanging = _hanging(mechanism)
        self._posed = np.array([body.name not in hanging for body in mechanism.bodies], dtype=np.float64)
        self._pins: list[str] = []
        carriers, arms = [], []
        for joint in mechanism.joints:
            if (joint.type in _PIVOTS or joint.follows is not None) and not hanging & {joint.body0, joint.body1}:
                for body in (joint.body0, joint.body1):
                    self._pins.append(joint.name)
                    carriers.append(number[body])
                    arms.append(np.asarray(joint.anchor) - np.asarray(mechanism.body(body).origin))
        self._carriers, self._arms = np.array(carriers, dtype=int), np.array(arms).reshape(-1, 3)
        cut = {joint.name for joint in mechanism.joints if joint.cut}
        self._cuts = np.array([i for i in range(0, len(self._pins), 2) if self._pins[i] in cut], dtype=int)
        self._shown = cut <= set(self._pins)
        """Whether each loop's cut shows in its pins how well the loop closes."""
        signs = {loop.cut: loop.branch for loop in mechanism.loops if loop.branch}
        self._triangles = {c: (p, signs[c]) for c, p in branch_pivots(mechanism).items() if c in signs}

    @property
    def measured(self) -> tuple[str, ...]:
        """The joints whose coordinates give the pose."""
        return self.chain.independent

    def compare(self, coordinates: Floats, rotations: Floats, origins: Floats) -> Agreement:
        """Agreement of n steps: coordinates (n, measured), rotations (n, bodies, 3, 3), origins (n, bodies, 3)."""
        count = len(coordinates)
        finite = np.isfinite(coordinates).all(axis=1) & np.isfinite(origins).all(axis=(1, 2))
        good = count if bool(finite.all()) else int(np.argmin(finite))
        parts: list[Agreement] = []
        for start in range(0, good, _CHUNK):
            chunk = slice(start, min(good, start + _CHUNK))
            guard.beat()
            parts.append(self._chunk(coordinates[chunk], rotations[chunk], origins[chunk], start))
            if not parts[-1].followed:
                break
        return _together(parts, good == count)

    def _chunk(self, coordinates: Floats, rotations: Floats, origins: Floats, first: int) -> Agreement:
        states, placed, at = self._expected(coordinates)
        followed = len(states) == len(coordinates)
        if not states:
            return Agreement(Worst(), Worst(), Worst(), {}, False)
        self._state = states[-1]
        expected, expected_at = placed[:, self._bodies], at[:, self._bodies]
        rotations, origins = self._without_root(rotations[: len(states)], origins[: len(states)])
        pins = self._places(rotations, origins)
        off = np.linalg.norm(pins - self._places(expected, expected_at), axis=2)
        gaps = np.linalg.norm(pins[:, self._cuts] - pins[:, self._cuts + 1], axis=2)
        turned = np.swapaxes(rotations, 2, 3) @ expected
        skew = turned - np.swapaxes(turned, 2, 3)
        sine = 0.5 * np.sqrt(skew[..., 0, 1] ** 2 + skew[..., 0, 2] ** 2 + skew[..., 1, 2] ** 2)
        angles = np.arctan2(sine, 0.5 * (np.trace(turned, axis1=2, axis2=3) - 1.0)) * self._posed
        for body, line in self._lines:
            apart = rotations[:, body] @ line - expected[:, body] @ line
            angles[:, body] = 2.0 * np.arcsin(np.minimum(1.0, 0.5 * np.linalg.norm(apart, axis=1)))
        full, full_at = placed.copy(), at.copy()
        full[:, self._bodies], full_at[:, self._bodies] = rotations, origins
        return Agreement(
            pin=_worst(off, self._pins, first),
            gap=_worst(gaps, [self._pins[i] for i in self._cuts.tolist()], first),
            angle=_worst(angles, [body.name for body in self._mechanism.bodies], first),
            sines={
                cut: float((sign * branch_sines(self.chain, pivots, full, full_at)).min())
                for cut, (pivots, sign) in self._triangles.items()
            },
            followed=followed,
            pins=off.max(axis=1, initial=0.0),
            angles=angles.max(axis=1, initial=0.0),
        )

    def _expected(self, coordinates: Floats) -> tuple[Sequence[State], Floats, Floats]:
        """The kinematics' states, and the rotations and origins of all bodies in them."""
        states: list[State] = led_over(self.chain, coordinates, self._state, self._stride) if self._shown else []
        placed, at = self.chain.placements(states)
        halves = self._places(placed[:, self._bodies], at[:, self._bodies])
        gaps = np.abs(halves[:, self._cuts] - halves[:, self._cuts + 1]).max(axis=(1, 2), initial=0.0)
        opened = np.flatnonzero(gaps > _LED).tolist()
        for step in opened:
            alone = solved(self.chain, coordinates[step : step + 1], states[max(0, step - 1)])
            if not alone:
                states = []
                break
            states[step] = alone[0]
        if len(states) < len(coordinates):
            states = list(solved(self.chain, coordinates, self._state))
        if opened or len(placed) != len(states):
            placed, at = self.chain.placements(states)
        return states, placed, at

    def _without_root(self, rotations: Floats, origins: Floats) -> tuple[Floats, Floats]:
        """Poses as they were with the root body in its drawn pose."""
        back = np.swapaxes(rotations[:, self._root], 1, 2)
        drawn = np.asarray(self._mechanism.body(self._mechanism.root).origin)
        moved = np.einsum("nij,nbj->nbi", back, origins - origins[:, self._root, None]) + drawn
        return back[:, None] @ rotations, moved

    def _places(self, rotations: Floats, origins: Floats) -> Floats:
        return np.asarray(
            np.einsum("npij,pj->npi", rotations[:, self._carriers], self._arms) + origins[:, self._carriers]
        )


def _hanging(mechanism: Mechanism) -> set[str]:
    """The bodies beyond free balls, which swing as they will."""
    tree = [joint for joint in mechanism.joints if not joint.cut]
    found = {joint.body1 for joint in tree if joint.type == "spherical" and joint.free}
    for _ in mechanism.bodies if found else ():
        found |= {joint.body1 for joint in tree if joint.body0 in found}
    return found


def _worst(values: Floats, names: list[str], first: int) -> Worst:
    if not values.size:
        return Worst()
    step, column = np.unravel_index(int(np.argmax(values)), values.shape)
    return Worst(float(values[step, column]), names[int(column)], first + int(step))


def _together(parts: list[Agreement], finite: bool) -> Agreement:
    return Agreement(
        pin=max((p.pin for p in parts), key=lambda w: w.value, default=Worst()),
        gap=max((p.gap for p in parts), key=lambda w: w.value, default=Worst()),
        angle=max((p.angle for p in parts), key=lambda w: w.value, default=Worst()),
        sines={cut: min(p.sines[cut] for p in parts if cut in p.sines) for p in parts[:1] for cut in p.sines},
        followed=finite and all(p.followed for p in parts),
        pins=np.concatenate([np.zeros(0), *(p.pins for p in parts)]),
        angles=np.concatenate([np.zeros(0), *(p.angles for p in parts)]),
    )
