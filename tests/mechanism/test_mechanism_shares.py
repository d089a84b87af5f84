"""Bodies of a machine whose volumes cannot say what it weighs: held to their type's usual shares."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from kit.machines.lift_trucks import lift_truck
from kit.machines.partly_drawn import without
from yellowiron.library import list_templates, load_template
from yellowiron.library.notation.validated_json import read_document
from yellowiron.library.parsing.usual import read_shares
from yellowiron.library.type_folders import is_sheet_only
from yellowiron.mechanism.bodies.usual_shares import WITHIN, within_usual
from yellowiron.model.errors import TemplateError

MASSES = st.dictionaries(st.sampled_from("abcdef"), st.floats(1e-3, 1e6), min_size=2)


@given(MASSES, st.dictionaries(st.sampled_from("abcdef"), st.floats(0.01, 0.3), min_size=1))
def test_the_sum_stays_and_shares_are_near_the_usual_ones(masses: dict[str, float], usual: dict[str, float]) -> None:
    total = sum(masses.values())
    held = within_usual(masses, usual, {})
    assert sum(held.values()) == pytest.approx(total)
    known = [body for body in masses if body in usual]
    if len(known) < len(masses) and WITHIN * sum(usual[b] for b in known) < 1.0:
        # What is not known takes the rest.
        for body in known:
            assert usual[body] / WITHIN - 1e-9 <= held[body] / total <= usual[body] * WITHIN + 1e-9
    inside = [b for b in known if 1.01 / WITHIN < held[b] / total / usual[b] < 0.99 * WITHIN]
    for one, other in itertools.pairwise(inside):
        assert held[one] / held[other] == pytest.approx(masses[one] / masses[other], rel=1e-6)


def test_a_published_weight_is_kept() -> None:
    held = within_usual({"a": 10.0, "b": 880.0, "c": 110.0}, {"a": 0.3, "b": 0.3, "c": 0.3}, {"c": 110.0})
    assert held == pytest.approx({"a": 290.0, "b": 600.0, "c": 110.0})
    assert within_usual({"a": 1.0, "b": 2.0}, {}, {}) == {"a": 1.0, "b": 2.0}


def test_a_mast_that_is_drawn_solid_does_not_weigh_more_than_its_truck() -> None:
    sound = without(lift_truck(3, "simplex"), "forklift", ())
    machine = lift_truck(3, "simplex")
    heavy = {part.shape for part in machine.parts if machine.truth[part.id][1] == "outer_mast"}
    machine.shapes.update({
        key: replace(shape, volume=300.0 * shape.volume, inertia=300.0 * np.asarray(shape.inertia))
        for key, shape in machine.shapes.items() if key in heavy
    })  # fmt: skip
    built = without(machine, "forklift", ())
    whole = sum(body.mass for body in built.bodies)
    shares = load_template("forklift").shares
    for name in ("chassis", "outer_mast", "inner_mast", "carriage"):
        share = built.body(name).mass / whole
        assert shares[name] / WITHIN - 1e-6 <= share <= shares[name] * WITHIN + 1e-6, name
    assert built.body("outer_mast").mass / whole == pytest.approx(WITHIN * shares["outer_mast"])
    assert "held to within" in built.body("outer_mast").source
    assert "MEC039" in {f.code for f in built.findings}
    drawn_so = {b.name: b.mass for b in sound.bodies}
    assert drawn_so["chassis"] > 5.0 * drawn_so["outer_mast"]


@pytest.mark.slow
def test_the_library_s_shares_are_whole_machines() -> None:
    for kind in filter(lambda name: not is_sheet_only(name), list_templates()):
        shares = load_template(kind).shares
        if shares:
            assert sum(shares.values()) == pytest.approx(1.0, abs=0.015), kind


def test_names_and_sums_that_cannot_be_are_told(tmp_path) -> None:  # type: ignore[no-untyped-def]
    roles = load_template("excavator").roles
    path = tmp_path / "shares.json"
    for text, words in (('{"boon": 5}', "no body"), ('{"boom": 60, "arm": 70}', "more than 100")):
        path.write_text(text)
        with pytest.raises(TemplateError, match=words):
            read_shares(read_document(path, "shares"), roles)
