"""What carries a machine is at its bottom, whatever a belt touches and whether its slewing bearing is drawn."""

from __future__ import annotations

import pytest

from kit.scene import scene
from kit.scoring import score
from yellowiron.library import load_template
from yellowiron.model.specification import Specifications
from yellowiron.stages import find_roles

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(
    ("seed", "damage", "right"),
    [
        (4, "belts", 99.5),
        (3, "belts", 99.0),  # the belts run into the deck above them
        (7103, "decimated 30", 99.0),  # the bearing is not round any more
    ],
)
def test_what_carries_and_what_is_carried_are_two(seed: int, damage: str, right: float) -> None:
    drawn = scene("excavator", seed, damage, names="without")
    template = load_template(drawn.type)
    assembly, alignment = find_roles(drawn.assembly, template, Specifications())
    found = score(assembly, alignment, None, drawn.truth, drawn.joints, drawn.height, template)
    assert 100.0 * found.right / found.area >= right
    assert found.silent == 0.0
    if seed == 3:
        moved = [p for p in alignment.parts if "it reaches the ground, and was drawn into" in p.reason]
        assert moved and all(p.body == template.root and p.part in alignment.to_review for p in moved)
