"""A search that finds no whole machine ends, by counted effort and not by the clock."""

from __future__ import annotations

import pytest

from kit.machines.defects import spoiled
from kit.machines.synthetic import disguise
from yellowiron.alignment import align
from yellowiron.alignment.assignment import search
from yellowiron.alignment.assignment.cp_sat import Effort, Solution, solve
from yellowiron.alignment.structure.clusters import Structure
from yellowiron.library import load_template
from yellowiron.model.specification import Specifications
from yellowiron.model.template import choose


def test_what_has_no_effort_left_finds_nothing() -> None:
    template = choose(load_template("excavator"), {})
    effort = Effort(0.0)
    assert effort.spent
    assert solve(Structure(), template, at_least=1, effort=effort) is None


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
