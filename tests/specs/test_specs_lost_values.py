"""What makers' brochures print and reading lost: each cause in the smallest form that shows it."""

from __future__ import annotations

from yellowiron.specs.layout.statement import Statement
from yellowiron.specs.values.claims import claims_of


def test_a_bare_number_with_feet_in_brackets_behind_it_has_the_unit_in_which_they_agree() -> None:
    row = Statement(1, 0, "Distancia entre ejes", "3,275 (10'9\")", (0, 0, 9, 9), "q")
    (claim,) = claims_of([row], "point")
    assert (claim.quantity.si_value, claim.quantity.unit, claim.doubt) == (3.275, "mm", "")
    other = Statement(1, 0, "Distancia entre ejes", "3,275 (9'6\")", (0, 0, 9, 9), "q")
    assert all(c.doubt for c in claims_of([other], "point") if c.quantity.unit)
