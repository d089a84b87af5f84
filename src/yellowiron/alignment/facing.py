"""Which way a machine faces, where a person says so: a direction decides between those that were found."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field

import numpy as np

from yellowiron.model.alignment import Vector
from yellowiron.model.geometry import Floats
from yellowiron.support.vectors import triple, unit

NEAR = 0.8
"""A direction that is said means the one that was found this near to it (cosine); else itself."""


@dataclass(frozen=True)
class Facing:
    """What a person says: where `forward` and `up` are, in the CAD file's frame. Where both are said and lie along one
    line, `up` is obeyed."""

    forward: Vector | None = None
    up: Vector | None = None
    square: Floats | None = field(default=None, compare=False)
    """The rotation (3, 3) from the file's frame to the one in which these are told, where that is another one."""

    def turned(self, rotation: Floats) -> Facing:
        """The same in a frame to which a rotation (3, 3) takes the file's."""
        forward, up = (None if way is None else triple(rotation @ np.array(way)) for way in (self.forward, self.up))
        return Facing(forward, up, square=rotation)

    def obeyed(self, rotation: Floats) -> Floats:
        """A rotation (3, 3), rows forward, left, up in the CAD file's frame, turned to what is said: by quarters where
        that means directions that it has, else to the very directions."""
        if self.forward is None and self.up is None:
            return rotation

        def fit(turned: Floats) -> tuple[float, ...]:
            said = ((self.up, turned[2]), (self.forward, turned[0]))
            told = [float(np.array(way) @ own) for way, own in said if way is not None]
            return (*np.round(told, 6), *np.round([turned[2] @ rotation[2], turned[0] @ rotation[0]], 6))

        found = max((np.asarray(quarter @ rotation) for quarter in quarters()), key=fit)
        up = _meant(self.up, found[2])
        forward = _meant(self.forward, found[0])
        if self.up is None:
            up = up - (up @ forward) * forward
        forward = forward - (forward @ up) * up / (up @ up)
        if np.linalg.norm(forward) < 1.0 - NEAR:
            forward = found[0]
        return np.array([unit(forward), unit(np.cross(up, forward)), unit(up)])

    def against(self, rotation: Floats) -> tuple[str, ...]:
        """What is said otherwise than a rotation has it, in words."""
        said = (("forward", self.forward, rotation[0]), ("up", self.up, rotation[2]))
        file = np.eye(3) if self.square is None else self.square
        return tuple(
            f"{name} is {named_direction(np.array(way) @ file)} as a person says; "
            f"what was found speaks for {named_direction(own @ file)}"
            for name, way, own in said if way is not None and float(np.array(way) @ own) < NEAR
        )  # fmt: skip


UNTOLD = Facing()


def named_direction(direction: Floats | Vector) -> str:
    """A direction as a person writes it: `x`, `-z`, or three numbers."""
    own = np.round(np.array(direction, dtype=np.float64), 4) + 0.0
    k = int(np.argmax(np.abs(own)))
    if np.count_nonzero(own) == 1:
        return f"{'-' if own[k] < 0 else ''}{'xyz'[k]}"
    return " ".join(f"{value:g}" for value in own)


def quarters() -> list[Floats]:
    """The 24 turns (3, 3) by quarters."""
    signed = (
        np.diag(signs) @ np.eye(3)[list(order)]
        for order in itertools.permutations(range(3)) for signs in itertools.product((1.0, -1.0), repeat=3)
    )  # fmt: skip
    return [turn for turn in signed if np.linalg.det(turn) > 0]


def _meant(said: Vector | None, found: Floats) -> Floats:
    return found if said is None or float(np.array(said) @ found) >= NEAR else np.array(said)
