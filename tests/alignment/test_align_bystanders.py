"""What stands beside the machine in the scene's tree is listed for review, and what touches another body than what it
hangs with is of."""

from __future__ import annotations

import numpy as np
import pytest

from kit.machines.solids import box
from yellowiron.alignment.features.solids import solids_of
from yellowiron.alignment.labelling.bystanders import STRANGE, WORDS, among_strangers, doubted
from yellowiron.alignment.labelling.place import DOUBTFUL, Place
from yellowiron.model.alignment import Alignment, AssignmentSource, PartAssignment
from yellowiron.model.assembly import Assembly, Part

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


BRACKET = "frame/ram/bracket"


@pytest.mark.parametrize(
    ("places", "asked"),
    [
        pytest.param({}, True, id="two of three are of the cylinder"),
        pytest.param({"frame/ram/tube": ("chassis", 0.9)}, False, id="half are of the frame"),
        pytest.param({"frame/ram/tube": ("chassis", 0.3), "frame/ram/rod": ("chassis", 0.3)}, True, id="in doubt"),
        pytest.param({"frame/ram/bracket": ("boom", 0.9)}, True, id="a third body"),
        pytest.param({"frame/ram/bracket": ("barrel", 0.9)}, False, id="with its kin"),
    ],
)
def test_what_hangs_with_another_body_than_it_touches_is_asked_about(
    places: dict[str, tuple[str, float]], asked: bool
) -> None:
    """A bracket under a cylinder's node that touches the frame, beside a frame of more surface than that node has."""
    placed = {
        "frame/plate": ("chassis", 0.9), "frame/side": ("chassis", 0.9), "frame/ram/tube": ("barrel", 0.9),
        "frame/ram/rod": ("barrel", 0.9), BRACKET: ("chassis", 0.9), **places,
    }  # fmt: skip
    shapes = {name: box(name, 1.0 + k, 1.0, 1.0) for k, name in enumerate(["bracket", "rod", "tube", "plate", "side"])}
    parts = tuple(
        Part(id, id.split("/")[-1], ("world", *id.split("/")[:-1]), id.split("/")[-1], np.eye(4)) for id in placed
    )
    solids = solids_of(Assembly("machine", "synthetic", 1.0, parts, shapes))
    known = {
        k: Place(body, body, sure, "touches it", how="touch" if p.id == BRACKET else "judged")
        for k, (p, (body, sure)) in enumerate(zip(parts, placed.values(), strict=True))
    }
    found = among_strangers(known, solids)
    told = [parts[i].id for i, place in found.items() if STRANGE in place.reason]
    assert told == [BRACKET] * asked
    assert all(found[k].confidence == (DOUBTFUL if parts[k].id in told else known[k].confidence) for k in known)
