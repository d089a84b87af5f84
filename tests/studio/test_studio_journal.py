"""The journal: what was said is on the disk before it is answered, whatever happens after."""

from __future__ import annotations

import tempfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from yellowiron.library import load_template
from yellowiron.model.errors import YellowironError
from yellowiron.model.template import Template
from yellowiron.studio.journal import Journal
from yellowiron.studio.operations import Operation, from_entry, words

PARTS = ("A/boom", "A/boom#2", "Mulde ü", "板")


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("excavator")


def reader(template: Template):  # type: ignore[no-untyped-def]
    return lambda entry: from_entry(entry, PARTS, template)


OPERATIONS = st.one_of(
    st.builds(
        lambda kind, parts: Operation(kind, parts=parts),
        st.sampled_from(("role", "confirm", "forget")),
        st.dictionaries(st.sampled_from(PARTS), st.sampled_from(("boom", "arm", None)), min_size=1),
    ),
    st.builds(
        lambda text: Operation("value", name="Boom Cylinder Stroke", text=text), st.sampled_from(("", "1 m", "2 ft"))
    ),
    st.builds(
        lambda name, text: Operation("rule", name=name, text=text),
        st.sampled_from(("A/*", "*ü")),
        st.sampled_from(("", "boom", "none")),
    ),
)
STEPS = st.lists(st.one_of(OPERATIONS, st.just("undo"), st.just("redo")), max_size=12)


def played(journal: Journal, steps: list[object]) -> None:
    for step in steps:
        if isinstance(step, Operation):
            journal.do(step)
        elif step == "undo":
            journal.undo()
        else:
            journal.redo()


@given(STEPS, STEPS)
def test_a_history_is_read_as_it_was_made(template: Template, first: list[object], then: list[object]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        journal = Journal(Path(folder) / "studio.jsonl", reader(template))
        journal.begin({"parts": {}})
        played(journal, first)
        again = Journal(Path(folder) / "studio.jsonl", reader(template))
        assert (again.operations, again.cursor, again.base) == (journal.operations, journal.cursor, {"parts": {}})
        played(journal, then)
        last = Journal(Path(folder) / "studio.jsonl", reader(template))
        assert (last.operations, last.cursor) == (journal.operations, journal.cursor)


@given(st.lists(OPERATIONS, min_size=2, max_size=5), st.integers(1, 30))
def test_a_killed_program_loses_nothing_that_it_answered(template: Template, said: list[Operation], cut: int) -> None:
    """Of a file that was cut in its last line, all lines before hold, and what is said next too."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "studio.jsonl"
        journal = Journal(file, reader(template))
        journal.begin({})
        played(journal, list(said[:-1]))
        whole = file.read_bytes()
        journal.do(said[-1])
        last = file.read_bytes()
        file.write_bytes(last[: len(whole) + min(cut, len(last) - len(whole) - 2)])
        again = Journal(file, reader(template))
        assert again.operations == said[:-1]
        again.do(said[-1])
        assert Journal(file, reader(template)).operations == said


def test_what_a_revised_model_does_not_have_is_passed_over(template: Template, tmp_path: Path) -> None:
    file = tmp_path / "studio.jsonl"
    journal = Journal(file, reader(template))
    journal.begin({})
    journal.do(Operation("role", parts={"A/boom": "boom"}))
    journal.do(Operation("role", parts={"板": "arm"}))
    fewer = Journal(file, lambda entry: from_entry(entry, PARTS[:2], template))
    assert [list(o.parts) for o in fewer.operations] == [["A/boom"]]


@pytest.mark.parametrize(
    ("entry", "says"),
    [
        (None, "none of"), ([], "none of"), ({"kind": "delete"}, "none of"), ({"kind": "role"}, "no part"),
        ({"kind": "role", "parts": {}}, "no part"), ({"kind": "role", "parts": ["A/boom"]}, "no part"),
        ({"kind": "role", "parts": {"B": "boom"}}, "not in the CAD model"),
        ({"kind": "role", "parts": {"A/boom": "wing"}}, "no role"),
        ({"kind": "role", "parts": {"A/boom": 3}}, "no role"),
        ({"kind": "value"}, "no name"), ({"kind": "value", "name": "a=b", "text": "1 m"}, "no name"),
        ({"kind": "value", "name": "x", "text": "1\n2"}, "short text"),
        ({"kind": "value", "name": "x" * 300, "text": "1 m"}, "short text"),
        ({"kind": "confirm", "parts": {"A/boom": "boom"}, "why": 7}, "short text"),
    ],
)  # fmt: skip
def test_what_is_no_decision_is_refused(template: Template, entry: object, says: str) -> None:
    with pytest.raises(YellowironError) as caught:
        from_entry(entry, PARTS, template)
    assert says in caught.value.message
    assert "\n" not in caught.value.message


def test_words() -> None:
    parts = dict.fromkeys(PARTS, "boom_cylinder_barrel")
    assert words(Operation("role", parts=parts)) == "boom, boom#2 and 2 more → boom cylinder barrel"
    assert words(Operation("role", parts={"A/boom": None})) == "boom → no part of the machine"
    assert words(Operation("confirm", parts={"A/boom": "boom"})) == "boom: boom, yes"
    assert words(Operation("value", name="Stroke", text="")) == "Stroke as the sheet has it"
