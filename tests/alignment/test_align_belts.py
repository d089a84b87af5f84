"""Tracks drawn as belts: what carries a machine is at its bottom, whatever a belt touches."""

from __future__ import annotations

import pytest

from kit.scene import scene
from kit.scoring import score
from yellowiron.library import load_template
from yellowiron.model.specification import Specifications
from yellowiron.stages import find_roles

pytestmark = pytest.mark.slow


@pytest.mark.parametrize(("seed", "right"), [(4, 99.5), (3, 75.0)])
def test_belts_go_with_the_undercarriage_or_are_asked(seed: int, right: float) -> None:
    """Of the second machine the belts are fast on the upperstructure by their contacts: that is doubted, not done
    better."""
    drawn = scene("excavator", seed, "belts", names="without")
    template = load_template(drawn.type)
    assembly, alignment = find_roles(drawn.assembly, template, Specifications())
    found = score(assembly, alignment, None, drawn.truth, drawn.joints, drawn.height, template)
    assert 100.0 * found.right / found.area >= right
    assert found.silent == 0.0
