"""The wheeled excavator's template: what it has of the excavator's, what it has not, mobility in every variant."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from yellowiron import library
from yellowiron.library.type_folders import library_folder
from yellowiron.model.errors import TemplateError
from yellowiron.model.template import Template, choose

TYPE = "wheeled_excavator"


@pytest.fixture(scope="module")
def template() -> Template:
    return library.load_template(TYPE)


@pytest.mark.slow
def test_it_moves_as_it_should(template: Template) -> None:
    report = library.lint(template)
    assert [f for f in report.findings if f.severity != "info"] == []
    for found in report.mobility:
        # Slewing, boom, arm, bucket, four wheels, steering.
        expected = 9 + (found.choices["boom_type"] != "mono") + (found.choices["blade"] != "none")
        expected += 2 * (found.choices["stabilizers"] == "hinged") + (found.choices["axle_oscillation"] == "free")
        assert (found.computed, found.expected) == (expected, expected), found.choices
    assert len(report.mobility) == 60


def test_what_it_has_of_the_crawler_excavator_and_what_not(template: Template) -> None:
    crawler = library.load_template("excavator")
    assert template.equipment_type == TYPE and crawler.equipment_type == "excavator"
    roles, others = {r.name for r in template.roles}, {r.name for r in crawler.roles}
    gone = others - roles - {"excavator"}
    assert gone and all(name.startswith(("track_", "sprocket_", "idler_", "carrier_roller_")) for name in gone)
    assert {"front_axle", "knuckle_l", "rear_wheel_r", "stabilizer_l"} <= roles - others
    wanted = {w.name for w in template.wanted}
    assert {"Wheelbase", "Turning Radius", "Maximum Digging Depth"} <= wanted and "Track Gauge" not in wanted
    measured = [m.name for m in template.measurements]
    assert measured.count("Overall Width") == 1 and "Track Length" not in measured


def test_a_road_is_faster_than_tracks(template: Template) -> None:
    fastest = {w.name: w.maximum for w in template.wanted}["Maximum Travel Speed"]
    assert fastest == pytest.approx(12.0)


@pytest.mark.parametrize("oscillation", ["free", "locked"])
def test_the_axle_may_be_locked(template: Template, oscillation: str) -> None:
    chosen = choose(template, {"axle_oscillation": oscillation})
    assert chosen.role("front_axle").rigid is (oscillation == "free")
    assert ("undercarriage2front_axle_joint" in {j.name for j in chosen.joints}) is (oscillation == "free")


def test_a_copy_says_everything_itself(template: Template, tmp_path: Path) -> None:
    folder = library.copy_template(TYPE, tmp_path / "own")
    assert all("like" not in json.loads(file.read_text(encoding="utf-8")) for file in folder.iterdir())
    copied = library.load_template(folder)
    assert (copied.roles, copied.joints, copied.measurements) == (
        template.roles,
        template.joints,
        template.measurements,
    )
    assert (copied.wanted, copied.actuators, copied.words) == (template.wanted, template.actuators, template.words)


def test_what_is_left_out_is_a_list_of_names(tmp_path: Path) -> None:
    (tmp_path / "joints.json").write_text(json.dumps({"like": "excavator", "without": "track_*"}), encoding="utf-8")
    with pytest.raises(TemplateError, match="no list of names") as found:
        library.load_template(tmp_path)
    assert found.value.where is not None and found.value.where.endswith("joints.json: without")


def test_a_document_is_not_like_itself(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As two types of an installed package may be like each other."""
    types = {"one": tmp_path / "one", "other": tmp_path / "other"}
    for folder, other in zip(types.values(), reversed(types), strict=True):
        folder.mkdir()
        (folder / "joints.json").write_text(json.dumps({"like": other}), encoding="utf-8")
    monkeypatch.setattr("yellowiron.library.composing.documents.type_folders", lambda: types)
    with pytest.raises(TemplateError, match="like itself"):
        library.load_template(types["one"])


@pytest.mark.parametrize("like", ["excavatr", "common"])
def test_a_type_that_is_not_there_is_named(tmp_path: Path, like: str) -> None:
    (tmp_path / "joints.json").write_text(json.dumps({"like": like}), encoding="utf-8")
    with pytest.raises(TemplateError, match=f"'{like}'") as found:
        library.load_template(tmp_path)
    assert found.value.where is not None and found.value.where.endswith("joints.json: like")
    assert (library_folder() / "excavator" / "joints.json").is_file()
