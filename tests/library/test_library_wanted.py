"""What every type asks a sheet for: enough of it, in six languages, and no label that stands for two things."""

from __future__ import annotations

import json
import shutil
from collections import Counter, defaultdict
from pathlib import Path

import jsonschema
import pytest
from typer.testing import CliRunner

from yellowiron import library
from yellowiron.cli import app
from yellowiron.library.type_folders import library_folder
from yellowiron.model.errors import TemplateError
from yellowiron.model.template import Template, Wanted
from yellowiron.specs.language.vocabulary import has_cjk, squeezed, tokens
from yellowiron.support.units import SI_UNIT

LANGUAGES = {"en", "de", "fr", "es", "zh", "ja"}
TYPES = library.list_templates()
SHEET_ONLY: set[str] = set()
"""Of the library none any more; a folder of one's own may still be that."""


def test_which_types_there_are() -> None:
    assert set(TYPES) == SHEET_ONLY | {
        "articulated_dump_truck",
        "backhoe_loader",
        "crawler_crane",
        "dozer",
        "grader",
        "mobile_crane",
        "rigid_dump_truck",
        "roller",
        "wheel_loader",
        "excavator",
        "forklift",
        "skid_steer",
        "telehandler",
        "wheeled_excavator",
    }
    assert {t for t in TYPES if library.is_sheet_only(t)} == SHEET_ONLY


@pytest.fixture(scope="module", params=TYPES)
def template(request: pytest.FixtureRequest) -> Template:
    return library.load_template(request.param, sheet_only=True)


@pytest.mark.slow
def test_at_least_25_names_of_every_kind(template: Template) -> None:
    assert len(template.wanted) >= 25
    dimensions = {w.dimension for w in template.wanted}
    assert {"length", "mass", "pressure", "flow", "power", "speed", "angle"} <= dimensions
    assert any("Cylinder Stroke" in w.name for w in template.wanted)
    assert any(w.mass_of == "*" for w in template.wanted)


def test_every_name_says_what_it_is_where_it_stands_and_how_it_is_called_in_six_languages(template: Template) -> None:
    for wanted in template.wanted:
        assert wanted.dimension in SI_UNIT and wanted.use and wanted.where, wanted.name
        assert wanted.minimum is not None and wanted.maximum is not None and wanted.minimum < wanted.maximum
        if wanted.in_label_of is None:
            assert set(wanted.synonyms) == LANGUAGES and all(wanted.synonyms.values()), wanted.name
            for language in ("zh", "ja"):
                assert all(has_cjk(label) for label in wanted.synonyms[language]), wanted.name
            for language in ("en", "de", "fr", "es"):
                assert not any(has_cjk(label) for label in wanted.synonyms[language]), wanted.name


def test_no_label_stands_for_two_names(template: Template) -> None:
    owners: dict[tuple[str, str], dict[str, str]] = defaultdict(dict)
    by_name = {w.name: w for w in template.wanted}
    for wanted in template.wanted:
        for label in (wanted.name, *(label for labels in wanted.synonyms.values() for label in labels)):
            owners[_key(label), wanted.dimension][wanted.name] = label
    for names in owners.values():
        # A label that a name's forbidden words rule out is not that name's.
        open_ = [n for n, _ in names.items() if not any(_forbids(by_name[n], label) for label in names.values())]
        assert len(open_) < 2, names


def test_a_name_does_not_forbid_its_own_labels(template: Template) -> None:
    for wanted in template.wanted:
        for label in (label for labels in wanted.synonyms.values() for label in labels):
            assert not _forbids(wanted, label), (wanted.name, label)


def _key(label: str) -> str:
    return squeezed(label) if has_cjk(label) else " ".join(sorted(set(tokens(label))))


def _forbids(wanted: Wanted, label: str) -> bool:
    words = set(tokens(label))
    for phrase in wanted.forbidden:
        parts = set(tokens(phrase))
        if has_cjk(phrase) or phrase.startswith('"'):
            forbidden = squeezed(phrase) in squeezed(label)
        elif parts:
            forbidden = parts <= words
        else:  # filler words ("over ") as they are printed
            forbidden = phrase.casefold() in label.casefold()
        if forbidden:
            return True
    return False


@pytest.fixture
def sheet_only(tmp_path: Path) -> Path:
    """A folder that has the crane's wanted values and nothing else."""
    folder = tmp_path / "crane_sheet"
    folder.mkdir()
    shutil.copy(library_folder() / "mobile_crane" / "wanted.json", folder)
    return folder


def test_a_type_known_by_its_sheet_only_says_so_when_a_machine_is_asked_of_it(sheet_only: Path) -> None:
    with pytest.raises(TemplateError, match="is sheet-only so far") as caught:
        library.load_template(sheet_only)
    assert "yellowiron extract" in caught.value.hint
    template = library.load_template(sheet_only, sheet_only=True)
    assert template.sheet_only
    assert library.lint(template).sound
    assert not library.load_template("excavator", sheet_only=True).sheet_only


def test_the_list_says_which_types_are_known_by_their_sheet_only(sheet_only: Path) -> None:
    told = CliRunner().invoke(app, ["templates", "list"]).output.splitlines()
    assert "excavator" in told and not [line for line in told if line.endswith("sheet only")]
    shown = CliRunner().invoke(app, ["templates", "show", str(sheet_only)]).output
    assert "asked of a sheet" in shown and "Luffing Cylinder Stroke" in shown


# ---- what types have in common ---------------------------------------------------------------------------------------
COMMON = json.loads((library_folder() / "common.json").read_text(encoding="utf-8"))


def test_the_common_document_is_valid_as_it_is_written() -> None:
    jsonschema.validate(COMMON, library.template_schema("common"))


def test_everything_common_is_used_more_than_once() -> None:
    written = [
        entry
        for name in TYPES
        for entry in json.loads((library_folder() / name / "wanted.json").read_text(encoding="utf-8")).values()
        if isinstance(entry, dict)
    ]
    entries = [*written, *COMMON["wanted"].values()]
    assert min(Counter(e.get("common") for e in entries)[name] for name in COMMON["wanted"]) > 1
    for key in ("sections", "forbidden"):
        named = Counter(word for e in entries for word in e.get(key, ()))
        assert all(named[f"@{name}"] > 1 for name in COMMON[key]), key


def test_an_entry_states_only_what_differs_from_the_common_one(tmp_path: Path) -> None:
    entry = {"common": "net_power", "minimum": "5 kW", "synonyms": {"de": ["Netto"]}, "sections": ["@engine", "data"]}
    (tmp_path / "wanted.json").write_text(json.dumps({"Power": entry, "Net Power": {"common": "Net Power"}}))
    mine, plain = library.load_template(tmp_path, sheet_only=True).wanted
    assert (mine.name, mine.minimum, mine.maximum) == ("Power", 5000.0, plain.maximum)
    assert mine.synonyms == {**plain.synonyms, "de": ("Netto",)}
    assert mine.sections == (*COMMON["sections"]["engine"], "data") == (*plain.sections, "data")
    assert (mine.use, mine.where, mine.dimension) == (plain.use, plain.where, "power")


def test_a_usual_length_is_from_the_shorter_to_the_longer(tmp_path: Path) -> None:
    entry = {"dimension": "length", "usual_length": {"least": "4 m", "most": "1600 cm", "source": "a sheet"}}
    (tmp_path / "wanted.json").write_text(json.dumps({"Length": entry}))
    (read,) = library.load_template(tmp_path, sheet_only=True).wanted
    assert read.usual_length == pytest.approx((4.0, 16.0))
    entry["usual_length"] = {"least": "16 m", "most": "4 m", "source": "a sheet"}
    (tmp_path / "wanted.json").write_text(json.dumps({"Length": entry}))
    with pytest.raises(TemplateError, match="least length"):
        library.load_template(tmp_path, sheet_only=True)


@pytest.mark.slow
@pytest.mark.parametrize("equipment_type", TYPES)
def test_a_copy_needs_nothing_of_the_library(equipment_type: str, tmp_path: Path) -> None:
    folder = library.copy_template(equipment_type, tmp_path / equipment_type)
    copied = json.loads((folder / "wanted.json").read_text(encoding="utf-8"))
    for name, entry in copied.items():
        assert "common" not in entry and "dimension" in entry, name
        assert not any(word.startswith("@") for key in ("sections", "forbidden") for word in entry.get(key, ()))
    assert (
        library.load_template(folder, sheet_only=True).wanted
        == library.load_template(equipment_type, sheet_only=True).wanted
    )
