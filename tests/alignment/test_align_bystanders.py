"""What stands beside the machine in the scene's tree is listed for review."""

from __future__ import annotations

import numpy as np
import pytest

from yellowiron.alignment.labelling.bystanders import WORDS, doubted
from yellowiron.model.alignment import Alignment, AssignmentSource, PartAssignment
from yellowiron.model.assembly import Part

MACHINE = {"truck/frame": "chassis", "truck/forks": "carriage", "truck/wheel": "front_wheel_l"}


def scene(bodies: dict[str, str | None], source: AssignmentSource = "solved") -> tuple[Alignment, list[Part]]:
    """Parts by their paths, under one node that has all of them, and the bodies that they were given."""
    parts = [Part(id, id.split("/")[-1], ("world", *id.split("/")[:-1]), "shape", np.eye(4)) for id in bodies]
    labels = [PartAssignment(id, body, body, 0.99, "touches it", source=source) for id, body in bodies.items()]
    return Alignment("forklift", np.eye(4), tuple(labels)), parts


def listed(bodies: dict[str, str | None], source: AssignmentSource = "solved") -> list[str]:
    found = doubted(*scene(bodies, source))
    told = [p for p in found.parts if WORDS in p.reason]
    assert all(p.confidence <= 0.5 for p in told)
    assert sorted(p.part for p in told) == sorted(found.to_review)
    return list(found.to_review)


def test_a_lorry_beside_a_forklift_is_asked_about() -> None:
    assert listed(MACHINE | {"lorry/cab": "chassis", "lorry/bed": "chassis", "rack/post": None}) == [
        "lorry/bed", "lorry/cab",
    ]  # fmt: skip


@pytest.mark.parametrize("more", [
    {},  # nothing beside it
    {"mast/rail": "outer_mast"},  # bodies are nodes of their own
    {"seat": "chassis"},  # a part under no node
])  # fmt: skip
def test_the_tree_says_nothing_where_bodies_are_spread_over_it(more: dict[str, str | None]) -> None:
    assert listed(MACHINE | more) == []


def test_a_person_is_not_asked_again() -> None:
    assert listed(MACHINE | {"lorry/cab": "chassis"}, source="confirmed") == []
