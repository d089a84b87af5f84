"""A suggestion is kept with its part, shown where the part is, and decides nothing."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

from doubted_machine import Doubted

from yellowiron.alignment import align, explain, read_alignment, said_in, write_alignment
from yellowiron.library import load_template
from yellowiron.model.alignment import Suggestion
from yellowiron.model.specification import Specifications
from yellowiron.report import alignment_entry
from yellowiron.report.html.viewer import assignment_entry

OTHER = Suggestion("arm", "m", "1f", "it is long")


def test_it_goes_through_the_file_and_is_no_edit(doubted: Doubted, tmp_path: Path) -> None:
    plain, file = tmp_path / "plain.json", tmp_path / "alignment.json"
    part = doubted.alignment.to_review[-1]
    write_alignment(doubted.alignment, doubted.assembly, plain)
    write_alignment(doubted.alignment.suggested({part: OTHER}), doubted.assembly, file)
    document = json.loads(file.read_text())
    (entry,) = (e for e in document["parts"] if "suggestion" in e)
    assert entry.pop("suggestion") == {"body": "arm", "model": "m", "question": "1f", "reason": "it is long"}
    assert document == json.loads(plain.read_text())
    edits = read_alignment(file, doubted.assembly, doubted.template)
    assert [(p.part, p.suggestion) for p in edits.parts if p.suggestion] == [(part, OTHER)]
    assert said_in(file, doubted.template) == said_in(plain, doubted.template) == {}
    again = align(doubted.assembly, load_template("excavator"), Specifications(), edits=edits)
    assert again.parts == doubted.alignment.parts and again.to_review == doubted.alignment.to_review


def test_what_is_no_suggestion_is_passed_over(doubted: Doubted, tmp_path: Path) -> None:
    file = tmp_path / "alignment.json"
    write_alignment(doubted.alignment.suggested({doubted.alignment.to_review[-1]: OTHER}), doubted.assembly, file)
    text = file.read_text()
    for wrong in ('"wing"', "[]", "{}"):
        file.write_text(text.replace('"body": "arm",\n    "model"', f'"body": {wrong},\n    "model"'))
        assert wrong in file.read_text()
        read = read_alignment(file, doubted.assembly, doubted.template)
        assert not any(p.suggestion for p in read.parts)


def test_it_is_read_where_the_reason_is(doubted: Doubted) -> None:
    part = next(p for p in doubted.alignment.parts if p.body == "boom")
    said = doubted.alignment.suggested({part.part: OTHER})
    words = f"{part.reason}; m points to arm (it is long)"
    assert words in explain(said, part.part)
    (shown,) = (p for p in said.parts if p.suggestion)
    assert assignment_entry(shown)["reason"] == words
    assert [p["suggestion"]["body"] for p in alignment_entry(said)["parts"] if "suggestion" in p] == ["arm"]
    assert replace(shown, suggestion=replace(OTHER, body="boom", reason="")).why == f"{part.reason}; m agrees"
    assert replace(shown, suggestion=replace(OTHER, body=None, reason="")).why.endswith(
        "m takes it for none of those offered"
    )
