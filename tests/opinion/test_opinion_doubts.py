"""What is asked of a machine in doubt: what lies together, the most consequential first."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from doubted_machine import Doubted

from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.opinion.doubts import Doubt, apart, boxes_of, doubts_of, size_of, spread

LARGE, SMALL, FAR = "beam", "bolt", "beam on the other side"
BOXES = {
    LARGE: np.array([[0.0, 0.0, 0.0], [4.0, 0.5, 0.5]]),
    SMALL: np.array([[4.02, 0.0, 0.0], [4.1, 0.1, 0.1]]),
    FAR: np.array([[0.0, 2.0, 0.0], [4.0, 2.5, 0.5]]),
}


def test_every_part_to_review_is_in_one_doubt(doubted: Doubted) -> None:
    boxes = boxes_of(doubted.assembly)
    found = doubts_of(doubted.alignment, doubted.template, boxes)
    parts = [part for doubt in found for part in doubt.parts]
    known = {p.part: p for p in doubted.alignment.parts}
    assert sorted(parts) == sorted(p for p in doubted.alignment.to_review if p in known) and len(parts) > 40
    for doubt in found:
        assert {known[part].body for part in doubt.parts} == {doubt.body}
        assert doubt.body not in doubt.others and len(set(doubt.others)) == len(doubt.others)
        assert all(doubted.template.knows(other) for other in doubt.others)
    pieces = apart(found, boxes)
    assert sorted(part for piece in pieces for part in piece.parts) == sorted(parts)
    assert [p.weight for p in pieces] == sorted((p.weight for p in pieces), reverse=True)


def test_what_lies_together_is_one_and_the_largest_first() -> None:
    doubt = Doubt("boom", "arm", (LARGE, FAR, SMALL, "without a mesh"), ("arm",), 2.0, "")
    pieces = apart([doubt], BOXES)
    assert [piece.parts for piece in pieces] == [(LARGE, SMALL), (FAR,)]
    whole = sum(spread(box) for box in BOXES.values())
    assert pieces[1].weight == pytest.approx(2.0 * spread(BOXES[FAR]) / whole)
    assert sum(piece.weight for piece in pieces) == pytest.approx(2.0)
    pin = replace(doubt, parts=(SMALL,), weight=9.0)  # by how much hangs on the body alone, it would be the first
    assert [piece.parts for piece in apart([pin, doubt], BOXES)][-1] == (SMALL,)


def test_the_runner_up_comes_before_what_is_near(doubted: Doubted) -> None:
    parts = tuple(
        PartAssignment(part, body, body, 0.4, "", runner_up=other)
        for part, body, other in ((LARGE, "boom", "bucket"), (SMALL, "arm", None), (FAR, "tipping_link", None))
    )
    alignment = replace(Alignment("excavator", np.eye(4), parts), to_review=(LARGE,))
    (doubt,) = doubts_of(alignment, doubted.template, BOXES)
    assert (doubt.body, doubt.runner_up, doubt.others) == ("boom", "bucket", ("bucket", "arm", "tipping_link"))


def test_sizes() -> None:
    assert size_of(BOXES) == pytest.approx(np.linalg.norm([4.1, 2.5, 0.5]))
    assert size_of({}) == 1.0
    assert spread(BOXES[LARGE]) == pytest.approx(2 * (4 * 0.5 * 2 + 0.25))
