"""The language-model extractor against an endpoint that plays honest and other models; what reaches it; what the gates
let through."""

from __future__ import annotations

import functools
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specs_endpoint import (
    SECRET,
    Model,
    at_hand,
    chatting,
    failing,
    honest,
    inventing,
    refusing,
    serving,
    wrong_property,
    yes_saying,
)
from specs_layouts import canvas, leaders, put, template, wanted
from typer.testing import CliRunner

from yellowiron.cli import app
from yellowiron.library import load_template
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template
from yellowiron.specs import EndpointError, ModelOptions
from yellowiron.specs.extraction import from_sheets
from yellowiron.specs.extraction import read as read_pdf
from yellowiron.specs.llm.endpoint import parsed

pytestmark = pytest.mark.usefixtures("read_here")

TEMPLATE = template(
    wanted("Lift Cylinder Stroke", "length", "lift cylinder stroke"),
    wanted("Lift Cylinder Bore", "length", "lift cylinder bore"),
    wanted("Tilt Cylinder Stroke", "length", "tilt cylinder stroke"),
    wanted("Steering Cylinder Stroke", "length", "steering cylinder stroke", forbidden=("engine",)),
    wanted("Operating Weight", "mass"),
    wanted("Turning Radius", "length"),
)
ROWS = [
    ("Lift cylinders, bore x stroke", "150 x 764 mm"),
    ("Tilt cylinder stroke", "560 mm"),
    ("Engine stroke", "165 mm"),
    ("Steering ram, cylinder travel", "441 mm"),
    ("Operating weight", "20,500 kg"),
    ("Wheelbase", "3,450 mm"),
]
FACTS = {
    "Lift Cylinder Bore": ("lift cylinders", "150", "mm"),
    "Lift Cylinder Stroke": ("lift cylinders", "764", "mm"),
    "Tilt Cylinder Stroke": ("tilt cylinder", "560", "mm"),
    "Steering Cylinder Stroke": ("steering ram", "441", "mm"),
    "Operating Weight": ("operating weight", "20,500", "kg"),
}
TRUTH = {
    "Lift Cylinder Bore": 0.150,
    "Lift Cylinder Stroke": 0.764,
    "Tilt Cylinder Stroke": 0.560,
    "Steering Cylinder Stroke": 0.441,
    "Operating Weight": 20500.0,
}


_opened = functools.cache(read_pdf)


def extract(known: Template, pdfs: list[Path], **options: Any) -> Specifications:
    """`specs.extract`, each file read once."""
    return from_sheets(known, [_opened(pdf) for pdf in pdfs], **options)


@pytest.fixture(autouse=True)
def _no_cache(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("YELLOWIRON_CACHE", "off")
    for name in ("URL", "MODEL", "KEY"):
        monkeypatch.delenv(f"YELLOWIRON_LLM_{name}", raising=False)


@pytest.fixture(scope="module")
def sheet(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sheets") / "loader.pdf"
    c = canvas(path)
    put(c, 36, 800, "HYDRAULICS AND WEIGHTS", size=12, bold=True)
    leaders(c, 36, 770, 300, ROWS)
    c.save()
    return path


def read(sheet: Path, model: Model, *, extractor: str = "llm", **options: object) -> Specifications:
    with serving(model) as server:
        asked = ModelOptions("test-model", server.url, SECRET, **options)  # type: ignore[arg-type]
        return extract(TEMPLATE, [sheet], extractor=extractor, model=asked)  # type: ignore[arg-type]


def statuses(found: Specifications) -> dict[str, str]:
    return {s.name: s.status for s in found}


def test_an_honest_models_values_are_the_sheets(sheet: Path) -> None:
    found = read(sheet, honest(FACTS))
    for name, value in TRUTH.items():
        specification = found.get(name)
        assert specification is not None and specification.value == pytest.approx(value, rel=1e-12), name
        assert specification.evidence is not None and specification.evidence.page == 1
        assert "test-model points to it" in specification.reason
    assert statuses(found) == {
        "Lift Cylinder Stroke": "ok",
        "Lift Cylinder Bore": "ok",
        "Tilt Cylinder Stroke": "ok",
        "Operating Weight": "ok",
        "Steering Cylinder Stroke": "review",  # the row says it in part only
        "Turning Radius": "missing",
    }
    assert [f.code for f in found.findings] == ["SPC004"]
    assert "tokens in" in found.findings[0].message


def test_rows_of_one_value_are_asked_apart_and_others_as_a_table(sheet: Path) -> None:
    with serving(honest(FACTS)) as server:
        extract(TEMPLATE, [sheet], extractor="llm", model=ModelOptions("test-model", server.url, SECRET))
    kinds = [q.kind for q in server.questions]
    assert kinds.count("lines") == 1  # six rows go into one question
    assert kinds.count("value") == kinds.count("unit") == 3  # tilt, steering, weight
    assert kinds.count("rows") == 1 and kinds.count("answer") == 2  # bore and stroke, each checked
    for question, headers in zip(server.questions, server.headers, strict=True):
        assert headers["Authorization"] == f"Bearer {SECRET}"
        body = question.body
        assert body["model"] == "test-model" and body["temperature"] == 0.0
        assert body["response_format"]["json_schema"]["strict"] is True
        assert SECRET not in json.dumps(body) and str(sheet.parent) not in json.dumps(body)
        assert "none" in body["messages"][0]["content"]


def test_a_negative_answer_discards_the_row(sheet: Path) -> None:
    without_unit = {**FACTS, "Tilt Cylinder Stroke": ("tilt cylinder", "560", "none")}
    assert statuses(read(sheet, honest(without_unit)))["Tilt Cylinder Stroke"] == "missing"

    def denying(q):  # type: ignore[no-untyped-def]
        return (200, '{"answer": "no"}') if q.kind == "answer" else honest(FACTS)(q)

    assert statuses(read(sheet, denying))["Lift Cylinder Stroke"] == "missing"


@pytest.mark.parametrize("model", [yes_saying, inventing, wrong_property])
@pytest.mark.parametrize("extractor", ["llm", "both"])
def test_no_lie_passes_the_gates(sheet: Path, model: Model, extractor: str) -> None:
    for specification in read(sheet, model, extractor=extractor, most_calls=5000):
        if specification.status == "ok":
            assert specification.value == pytest.approx(TRUTH.get(specification.name), rel=1e-12), specification.name


def test_what_a_model_invents_is_on_no_sheet(sheet: Path) -> None:
    assert set(statuses(read(sheet, inventing)).values()) == {"missing"}


@pytest.mark.parametrize("kinds", [(), ("json_schema",), ("json_schema", "json_object")])
def test_endpoints_that_know_fewer_formats_and_models_that_chat(sheet: Path, kinds: tuple[str, ...]) -> None:
    found = read(sheet, refusing(chatting(honest(FACTS)), *kinds))
    assert {n for n, s in statuses(found).items() if s == "ok"} == TRUTH.keys() - {"Steering Cylinder Stroke"}


def test_a_refused_format_is_asked_for_once(sheet: Path) -> None:
    with serving(refusing(honest(FACTS), "json_schema")) as server:
        extract(TEMPLATE, [sheet], extractor="llm", model=ModelOptions("m", server.url))
    asked = [q.body.get("response_format", {}).get("type") for q in server.questions]
    assert asked.count("json_schema") == 1 and asked[0] == "json_schema"


def test_agreement_raises_confidence_and_disagreement_is_a_conflict(sheet: Path) -> None:
    rules = extract(TEMPLATE, [sheet])
    both = read(sheet, honest(FACTS), extractor="both")
    for specification in rules:
        other = both.get(specification.name)
        assert other is not None
        if specification.status == "ok":
            assert other.status == "ok" and other.confidence >= specification.confidence
            assert "points to it" in other.reason
    steering = both.get("Steering Cylinder Stroke")
    assert steering is not None and steering.status == "review" and steering.value == pytest.approx(0.441)

    swapped = {**FACTS, "Lift Cylinder Stroke": FACTS["Lift Cylinder Bore"]}
    lift = read(sheet, honest(swapped), extractor="both").get("Lift Cylinder Stroke")
    assert lift is not None and lift.status in ("ok", "conflict")
    assert lift.value is None or lift.value == pytest.approx(0.764)


def test_an_endpoint_that_fails_leaves_the_rules_word_and_a_finding(sheet: Path) -> None:
    both = read(sheet, failing, extractor="both")
    rules = extract(TEMPLATE, [sheet])
    assert statuses(both) == statuses(rules)
    finding = next(f for f in both.findings if f.code == "SPC003")
    assert finding.severity == "warning" and SECRET not in finding.message
    with pytest.raises(EndpointError) as caught:
        read(sheet, failing)
    assert "gives no answer" in caught.value.message and SECRET not in str(caught.value)


def test_calls_are_bounded(sheet: Path) -> None:
    with serving(lambda q: (200, "no JSON at all")) as server, pytest.raises(EndpointError, match="asked 3 times"):
        options = ModelOptions("m", server.url, attempts=5, most_calls=3)
        extract(TEMPLATE, [sheet], extractor="llm", model=options)
    assert len(server.questions) == 3


def test_nobody_is_called_without_being_asked_for(sheet: Path) -> None:
    with serving(honest(FACTS)) as server:
        extract(TEMPLATE, [sheet], model=ModelOptions("m", server.url))
    assert server.questions == []
    with pytest.raises(EndpointError, match="No language model is configured"):
        extract(TEMPLATE, [sheet], extractor="both")


def test_a_recorded_conversation_is_replayed_without_network(sheet: Path, tmp_path: Path) -> None:
    record = tmp_path / "conversation.jsonl"
    first = read(sheet, honest(FACTS), record=record)
    assert SECRET not in record.read_text()
    replayed = extract(TEMPLATE, [sheet], extractor="llm", model=ModelOptions("test-model", replay=record))
    assert replayed.values == first.values
    with pytest.raises(EndpointError, match="has no answer"):
        extract(TEMPLATE, [sheet], extractor="llm", model=ModelOptions("another", replay=record))
    record.write_text("{}\n")
    with pytest.raises(EndpointError, match="no recorded conversation"):
        extract(TEMPLATE, [sheet], extractor="llm", model=ModelOptions("test-model", replay=record))


def test_answers_are_kept_by_what_was_asked(sheet: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("YELLOWIRON_CACHE", str(tmp_path))
    with serving(honest(FACTS)) as server:
        options = ModelOptions("m", server.url, SECRET)
        first = extract(TEMPLATE, [sheet], extractor="llm", model=options)
        sent = len(server.questions)
        second = extract(TEMPLATE, [sheet], extractor="llm", model=options)
        assert len(server.questions) == sent and second == first  # and says it cost the same
        extract(TEMPLATE, [sheet], extractor="llm", model=replace(options, model="other"))
        assert len(server.questions) == 2 * sent


def test_the_command_line(sheet: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    loader = ["extract", "wheel_loader", str(sheet), "--json"]
    refused = CliRunner().invoke(app, [*loader, "--extractor", "llm"])
    assert isinstance(refused.exception, EndpointError)  # exit code 2 and one sentence, by main
    with serving(honest(FACTS)) as server:
        monkeypatch.setenv("YELLOWIRON_LLM_URL", server.url)
        monkeypatch.setenv("YELLOWIRON_LLM_MODEL", "m")
        result = CliRunner().invoke(app, [*loader, "--extractor", "both"])
    document = json.loads(result.stdout)
    found = {s["name"]: s for s in document["specifications"]}
    assert (
        found["Tilt Cylinder Stroke"]["status"] == "ok" and "m points to it" in found["Tilt Cylinder Stroke"]["reason"]
    )
    assert [f["code"] for f in document["findings"]] == ["SPC004"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("machine", "model"),
    [("wheel_loader", yes_saying), ("excavator", wrong_property), ("excavator", inventing)],
)
def test_no_lie_about_an_examples_sheet_passes_the_gates(root: Path, machine: str, model: Model) -> None:
    """The rules' values of these sheets are held to the drawing's elsewhere: here they are the truth."""
    pdf = root / "examples" / machine / "specifications.pdf"
    known = load_template(machine)
    truth = {s.name: s.value for s in extract(known, [pdf]) if s.status == "ok"}
    with at_hand(model) as questions:
        found = extract(known, [pdf], extractor="llm", model=ModelOptions("m", "http://localhost", most_calls=10**6))
    wrong = [s.name for s in found if s.status == "ok" and s.value != pytest.approx(truth.get(s.name), rel=1e-9)]
    assert wrong == [], wrong
    assert len(questions) > 20


SCHEMA = {"type": "object", "properties": {"value": {"type": "string"}}, "required": ["value"]}


@given(st.text(max_size=80))
def test_any_text_is_an_answer_or_none(text: str) -> None:
    value, why = parsed(text, SCHEMA)
    assert (value is None) == bool(why)
    assert value is None or isinstance(value["value"], str)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('{"value": "3"}', {"value": "3"}),
        ('Sure!\n```json\n{"value": "3"}\n```', {"value": "3"}),
        ('It is {"value": "3"}, I think.', {"value": "3"}),
        ('{"value": 3}', None),
        ('["value"]', None),
        ('{"value": "3"', None),
    ],
)
def test_what_counts_as_an_answer(text: str, expected: dict[str, str] | None) -> None:
    assert parsed(text, SCHEMA)[0] == expected
