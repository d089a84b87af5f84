"""The template of a machine that was found, while it is written."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from yellowiron.library.proposal.likeness import Likeness
from yellowiron.model.found import FoundJoint, FoundMachine

Json = dict[str, Any]


@dataclass
class Draft:
    """The template while it is written. `names` and `reasons` of the bodies and `joint_names`, in the order of
    the machine's; `pins`: role → (body that carries it, its parts); the rest as in the files of that name."""

    machine: FoundMachine
    names: list[str]
    reasons: list[str]
    like: Likeness
    joint_names: list[str] = field(default_factory=list)
    pins: dict[str, tuple[int, tuple[str, ...]]] = field(default_factory=dict)
    joints: Json = field(default_factory=dict)
    wanted: Json = field(default_factory=dict)
    actuators: Json = field(default_factory=dict)

    def want(self, name: str, dimension: str, use: str) -> str:
        """The name, wanted from now on."""
        entry = self.like.wanted.get(name) or {
            "dimension": dimension, "use": use, "synonyms": {"en": [name.casefold()]}
        }  # fmt: skip
        self.wanted.setdefault(name, entry)
        return name


def other_body(joint: FoundJoint, end: int) -> int:
    """The other of a joint's two bodies."""
    return joint.b if joint.a == end else joint.a
