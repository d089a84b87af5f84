"""Confidence is a probability: what it rests on, and that more evidence is never worth less."""

from __future__ import annotations

import json
from importlib import resources

import pytest

from yellowiron.alignment.labelling.confidence import LIMIT, grounds, probability
from yellowiron.alignment.labelling.place import Place


def place(strength: float = 0.9, how: str = "joints", said: float = 0.0) -> Place:
    return Place("boom", "boom", strength, "", how=how, said=said, lead=0.5)


def test_grounds() -> None:
    found = grounds(place(0.9, said=-0.4), whole=True, rung=1)
    assert found == {
        "strength": pytest.approx(2.197, abs=1e-3),
        "by joints": 1.0,
        "whole": 1.0,
        "rung": 1.0,
        "names for": 0.0,
        "names against": 0.4,
        "lead": 0.5,
    }
    assert "lead" not in grounds(place(how="near"), whole=True, rung=0)
    assert grounds(place(0.4), whole=True, rung=0)["doubted"] == 1.0


@pytest.mark.parametrize("how", ["joints", "pin", "bores", "flat", "ring", "touch", "near", "name", "track"])
def test_more_evidence_is_never_worth_less(how: str) -> None:
    def sure(strength: float = 0.7, said: float = 0.0, rung: int = 0, whole: bool = True) -> float:
        return probability(grounds(place(strength, how, said), whole=whole, rung=rung))

    assert sure(0.1) < sure(0.4) < sure(0.7) <= sure(0.95) <= 1.0 - LIMIT
    assert sure(said=0.5) >= sure() >= sure(said=-0.5)
    assert sure() >= sure(rung=2)
    assert sure() >= sure(whole=False)


def test_the_fit_says_what_it_was_made_of() -> None:
    text = resources.files("yellowiron.alignment").joinpath("data/confidence.json").read_text(encoding="utf-8")
    assert "synthetic loaders and excavators, seeds" in json.loads(text)["source"]
