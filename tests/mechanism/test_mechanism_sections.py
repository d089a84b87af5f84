"""How far a section slides of which no cylinder is drawn and no sheet says it."""

from __future__ import annotations

import numpy as np
import pytest

from kit.machines.lift_trucks import lift_truck
from kit.machines.partly_drawn import without
from yellowiron.model.mechanism import ESTIMATE

SLIDES = ("outer_mast2inner_mast_joint", "inner_mast2carriage_joint")
RAMS = ("lift_cylinder", "lift_piston", "free_lift")


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 5, 9])
def test_a_mast_rises_until_a_quarter_of_a_section_is_left_in_the_other(seed: int) -> None:
    machine = lift_truck(seed, "simplex")
    built = without(machine, "forklift", RAMS, upright=SLIDES)
    slide = built.joint("outer_mast2inner_mast_joint")
    cylinder = next(c for c in built.cylinders if c.slide == slide.name)
    mast, inner = (np.asarray(built.body(name).hull)[:, 2] for name in ("outer_mast", "inner_mast"))
    assert cylinder.stroke == pytest.approx(mast.max() - inner.min() - 0.25 * np.ptp(inner), rel=1e-6)
    assert cylinder.sources["stroke"].startswith(ESTIMATE)
    assert slide.lower is not None and slide.upper is not None
    assert (slide.lower, slide.upper) == pytest.approx((0.0, cylinder.stroke), abs=1e-6)
    assert "MEC023" in {f.code for f in built.findings}


def test_what_is_drawn_of_a_ram_says_more() -> None:
    built = without(lift_truck(2, "simplex"), "forklift", ())
    cylinder = next(c for c in built.cylinders if c.slide == "outer_mast2inner_mast_joint")
    assert "sections" not in cylinder.sources["stroke"]
