"""The studio shows what a language model said beside its questions, as long as they are open."""

from __future__ import annotations

from pathlib import Path

import pytest
from doubted_machine import Doubted

from yellowiron.alignment import read_alignment, write_alignment
from yellowiron.model.alignment import Alignment, Suggestion
from yellowiron.opinion.doubts import boxes_of
from yellowiron.studio import Session, Setup
from yellowiron.studio.questions import questions


def suggested(alignment: Alignment) -> dict[str, Suggestion]:
    return {p.part: p.suggestion for p in alignment.parts if p.suggestion is not None}


@pytest.mark.slow
def test_suggestions_stay_while_their_parts_are_in_doubt(doubted: Doubted, example: Path, tmp_path: Path) -> None:
    out = tmp_path / "machine"
    out.mkdir()
    arm = [p for p in doubted.alignment.parts if p.body == "arm" and p.part in doubted.alignment.to_review]
    first, second = arm[0].part, arm[1].part
    said = {first: Suggestion("boom", "m", "1f"), second: Suggestion(None, "m", "2e")}
    write_alignment(doubted.alignment.suggested(said), doubted.assembly, out / "alignment.json")
    # What is drawn is handed in; the file is there because one has to be.
    session = Session(Setup("excavator", example / "wheel_loader.step", out), assembly=doubted.assembly)
    try:
        state = session.settled(60.0)
        assert suggested(state.alignment) == said
        known = {part: q.known for q in questions(state, boxes_of(doubted.assembly)) for part in q.parts}
        assert any("m says, and decides nothing: Boom (1 part)." in words for words in known[first])
        assert any("none of those offered (1 part)." in words for words in known[second])
        session.do(session.read({"kind": "role", "parts": {first: "boom"}}))
        assert suggested(session.settled(60.0).alignment).keys() == {second}
        session.undo()
        session.keep()
        kept = read_alignment(out / "alignment.json", doubted.assembly, doubted.template)
        assert suggested(kept) == said
    finally:
        session.close()
