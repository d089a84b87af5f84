"""A search that finds no whole machine ends, by counted effort and not by the clock."""

from __future__ import annotations

from typing import Any

import pytest

from kit.machines.defects import spoiled
from kit.machines.synthetic import disguise
from yellowiron.alignment import align
from yellowiron.alignment.assignment import search
from yellowiron.alignment.assignment.cp_sat import Effort, Solution, at_most, solve
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.library import load_template
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose


def test_what_has_no_effort_left_finds_nothing() -> None:
    template = choose(load_template("excavator"), {})
    effort = Effort(0.0)
    assert effort.spent
    assert solve(Structure(), template, at_least=1, effort=effort) is None


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "defect"), [("excavator", "sound"), ("loader", "no pins")])
def test_no_answer_is_better_than_what_all_could_be(kind: str, defect: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is not tried for that could not have been better: the bound holds for every program of a search."""
    bounds: list[int] = []

    def checked(structure: Structure, template: Template, **given: Any) -> Solution | None:
        most = at_most(structure, template, given["unary"])
        given["at_least"] = None
        found = solve(structure, template, **given)
        assert found is not None
        assert found.objective <= most
        bounds.append(most)
        return found

    monkeypatch.setattr(search, "solve", checked)
    assembly, _, _ = disguise(spoiled(kind, 3, defect), 3)
    align(assembly, load_template({"loader": "wheel_loader"}.get(kind, kind)), Specifications())
    assert bounds


@pytest.mark.slow
def test_a_search_without_a_whole_machine_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    spent: list[tuple[int, float]] = []

    def counted(*given: object, effort: Effort, **more: object) -> Solution | None:
        before = effort.left
        found = solve(*given, effort=effort, **more)  # type: ignore[arg-type]
        spent.append((id(effort), before - effort.left))
        return found

    monkeypatch.setattr(search, "solve", counted)
    assembly, _, _ = disguise(spoiled("excavator", 1, "missing cylinder"), 1)
    template = load_template("excavator")
    whole = align(assembly, template, Specifications())
    tries, effort = len(spent), sum(e for _, e in spent)
    assert 0.0 < effort < search.EFFORT
    spent.clear()
    monkeypatch.setattr(search, "EFFORT", 0.25 * effort)
    short = align(assembly, template, Specifications())
    assert 0 < len(spent) < tries
    assert sum(e for _, e in spent[:-1]) < search.EFFORT
    assert len(short.parts) == len(whole.parts)
    again = align(assembly, template, Specifications())
    assert [(p.part, p.role, p.confidence) for p in again.parts] == [
        (p.part, p.role, p.confidence) for p in short.parts
    ]
