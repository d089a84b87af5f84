"""The whole way on the bundled wheel loader, as a user runs it: the console script, in a folder of its own.

A process of its own, the CAD reader and the page are there where a test looks at them, or at every byte."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kit.builds import MadeOnce, console, read_once, reading_once, without_pages, without_usd
from kit.machines.nameless import write_nameless

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("cad_read_once", "kept_stages", "no_pages")]

ANGLE_BAR = 0.01
"""Degrees between a built axis and the true one."""
OFFSET_BAR = 1e-5
"""Metres between them, across the axis."""


def yellowiron(*arguments: str | Path, cwd: Path) -> subprocess.CompletedProcess[str]:
    """The console script in a process of its own."""
    return subprocess.run(
        [sys.executable, "-m", "yellowiron", *map(str, arguments)], cwd=cwd, capture_output=True, text=True, timeout=600
    )


def build(
    example: Path,
    out: Path,
    *,
    cad: Path | None = None,
    cwd: Path | None = None,
    run: Callable[..., subprocess.CompletedProcess[str]] = console,
) -> Any:
    outcome = run(
        "build", "wheel_loader", "--cad", cad or example / "wheel_loader.step",
        "--specs", example / "specifications.pdf", "--out", out, cwd=cwd or out.parent,
    )  # fmt: skip
    assert outcome.returncode == 0, outcome.stdout + outcome.stderr
    return json.loads((out / "report.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def named(five_lines: Path) -> tuple[Path, dict[str, Any]]:
    out = five_lines / "out"
    return out, json.loads((out / "report.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="session")
def nameless(
    example: Path, made_once: MadeOnce, tmp_path_factory: pytest.TempPathFactory
) -> tuple[Path, dict[str, Any]]:
    folder = tmp_path_factory.mktemp("nameless")
    cad = write_nameless(example / "wheel_loader.step", folder / "part.step")
    with without_pages(), without_usd(), reading_once(made_once, folder):
        return folder / "machine", build(example, folder / "machine", cad=cad)


@pytest.fixture(params=["named", "nameless"])
def report(request: pytest.FixtureRequest) -> dict[str, Any]:
    return request.getfixturevalue(request.param)[1]  # type: ignore[no-any-return]


@pytest.fixture(scope="session")
def truth(example: Path) -> dict[str, Any]:
    return json.loads((example / "truth.json").read_text(encoding="utf-8"))  # type: ignore[no-any-return]


def test_every_joint_is_on_its_pin(report: dict[str, Any], truth: dict[str, Any]) -> None:
    frame = np.array(report["frame"])
    joints = {j["name"]: j for j in report["joints"]}
    assert set(joints) == set(truth["joints"])
    for name, true in truth["joints"].items():
        joint = joints[name]
        axis = frame[:3, :3] @ np.array(true["axis"])
        anchor = frame[:3, :3] @ np.array(true["anchor"]) + frame[:3, 3]
        built = np.array(joint["axis"])
        angle = math.degrees(math.atan2(np.linalg.norm(np.cross(axis, built)), abs(axis @ built)))
        gap = np.array(joint["anchor"]) - anchor
        offset = np.linalg.norm(gap - (gap @ axis) * axis)
        assert joint["type"] == true["type"], name
        assert {joint["body0"], joint["body1"]} == {true["body0"], true["body1"]}, name
        assert angle <= ANGLE_BAR, f"{name}: {angle}°"
        assert offset <= OFFSET_BAR, f"{name}: {offset * 1e3} mm"


def test_nothing_is_left_to_review(report: dict[str, Any]) -> None:
    assert report["alignment"]["to_review"] == []
    assert report["alignment"]["missing"] == []
    assert report["alignment"]["assigned"] == report["alignment"]["parts"] >= 180


@pytest.mark.parametrize("which", ["named", "nameless"])
def test_every_part_is_in_its_body(
    which: str, request: pytest.FixtureRequest, example: Path, truth: dict[str, Any], made_once: MadeOnce
) -> None:
    folder = request.getfixturevalue(which)[0]
    cad = example / "wheel_loader.step" if which == "named" else folder.parent / "part.step"
    alignment = json.loads((folder / "alignment.json").read_text(encoding="utf-8"))
    found = {part["part"]: part["body"] for part in alignment["parts"]}
    drawn = [part.id for part in read_once(cad, made_once).parts]  # the truth is in the order of the CAD file
    assert len(found) == len(drawn)
    true = [(part, entry["body"]) for part, entry in zip(drawn, truth["parts"].values(), strict=True)]
    assert [(part, found[part], body) for part, body in true if found[part] != body] == []


def test_the_machine_moves_as_it_should(report: dict[str, Any]) -> None:
    assert report["mobility"]["computed"] == report["mobility"]["expected"]
    cuts = [loop["cut"] for loop in report["loops"]]
    assert sorted(cuts) == sorted(j["name"] for j in report["joints"] if j["cut"])
    assert len(set(cuts)) == len(cuts) == report["counts"]["loops"]
    bodies, joints = report["counts"]["bodies"], len(report["joints"])
    assert joints - len(cuts) == bodies - 1, "the uncut joints are a tree"


def test_published_values_hold(report: dict[str, Any]) -> None:
    checked = [m for m in report["measurements"] if m["role"] == "checked" and m["spec"] is not None]
    assert len(checked) >= 8
    for m in checked:
        assert m["model"] is not None, f"{m['name']}: {m['reason']}"
        bar = math.radians(0.1) if m["unit"] == "rad" else 0.002 * abs(m["spec"])
        assert abs(m["model"] - m["spec"]) <= bar, m


def test_example_values_are_told_apart(report: dict[str, Any]) -> None:
    examples = {m["name"] for m in report["measurements"] if m["role"] == "example"}
    assert {"Rack Back at Ground", "Rack Back at Maximum Lift"} <= examples


def test_masses_meet_the_sheet(report: dict[str, Any]) -> None:
    values = {s["name"]: s["value"] for s in report["specifications"]}
    masses = {b["name"]: b["mass"] for b in report["bodies"]}
    assert sum(masses.values()) == pytest.approx(values["Operating Weight"], rel=1e-9)
    assert masses["bucket"] == pytest.approx(values["Bucket Weight"], rel=1e-9)
    for body in report["bodies"]:
        moments = np.linalg.eigvalsh(np.array(body["inertia"]))
        assert moments[0] > 0 and moments[0] + moments[1] >= moments[2], body["name"]


def test_every_value_has_its_evidence(report: dict[str, Any]) -> None:
    for s in report["specifications"]:
        if s["status"] == "ok" and s["source"] == "sheet":
            assert s["page"] >= 1 and s["quote"], s["name"]


def test_a_second_run_from_another_folder_gives_the_same_bytes(
    named: tuple[Path, dict[str, Any]], example: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("YELLOWIRON_FRESH", "1")
    first = named[0]
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    second = tmp_path / "again"
    relative = Path(os.path.relpath(example, elsewhere))
    build(relative, second, cwd=elsewhere)
    # Once more over its own result: the alignment found there is read back.
    build(relative, second, cwd=elsewhere, run=yellowiron)
    names = sorted(p.relative_to(first) for p in first.rglob("*") if p.is_file())
    assert names == sorted(p.relative_to(second) for p in second.rglob("*") if p.is_file())
    for name in names:
        if name.name != "timings.json":
            assert (first / name).read_bytes() == (second / name).read_bytes(), name


def test_a_person_s_edit_wins_and_survives(named: tuple[Path, dict[str, Any]], example: Path, tmp_path: Path) -> None:
    document = json.loads((named[0] / "alignment.json").read_text(encoding="utf-8"))
    bolt = next(p for p in document["parts"] if p["role"] == "boom" and p["role"] == p["body"])
    bolt["role"] = "front_frame"
    # And a joint that a person puts 3 mm further forward, though its pin is drawn.
    name, back = "boom2bucket_joint", np.linalg.inv(np.array(named[1]["frame"]))
    before = next(j for j in named[1]["joints"] if j["name"] == name)
    place = np.add(before["anchor"], (0.003, 0.0, 0.0))
    by_hand = {"anchor": [*(back @ [*place, 1.0])[:3]], "axis": [*(back[:3, :3] @ before["axis"])]}
    document["joints"] = {name: by_hand}
    edited = tmp_path / "edited.json"
    edited.write_text(json.dumps(document), encoding="utf-8")
    out = tmp_path / "machine"
    command = ("build", "wheel_loader", "--cad", example / "wheel_loader.step", "--out", out,
               "--specs", example / "specifications.pdf")  # fmt: skip
    for more in (("--alignment", edited), ()):
        with without_usd():
            outcome = console(*command, *more, cwd=tmp_path)
        assert outcome.returncode in (0, 1), outcome.stderr
        parts = json.loads((out / "alignment.json").read_text(encoding="utf-8"))["parts"]
        kept = next(p for p in parts if p["part"] == bolt["part"])
        assert (kept["role"], kept["body"], kept["source"]) == ("front_frame", "front_frame", "edited")
        joints = json.loads((out / "report.json").read_text(encoding="utf-8"))["joints"]
        joint = next(j for j in joints if j["name"] == name)
        assert joint["source"]["method"].startswith("set by a person")
        off = np.array(joint["anchor"]) - before["anchor"]
        assert np.hypot(off[0] - 0.003, off[2]) < 1e-6


def test_the_filled_joint_template_is_taken_back(
    named: tuple[Path, dict[str, Any]], example: Path, tmp_path: Path
) -> None:
    """Without the sheet, the limits that an earlier run filled in still hold."""
    with without_usd():
        outcome = console(
            "build", "wheel_loader", "--cad", example / "wheel_loader.step", "--out", tmp_path / "machine",
            "--data", named[0] / "joints.filled.json", cwd=tmp_path,
        )  # fmt: skip
    assert outcome.returncode in (0, 1), outcome.stderr
    again = json.loads((tmp_path / "machine" / "report.json").read_text(encoding="utf-8"))
    assert again["missing"] == []
    slides = {j["name"]: (j["lower"], j["upper"]) for j in named[1]["joints"] if j["type"] == "prismatic"}
    for joint in again["joints"]:
        if joint["name"] in slides:
            assert (joint["lower"], joint["upper"]) == pytest.approx(slides[joint["name"]], abs=1e-6)


def test_without_a_sheet_the_machine_is_built_and_the_missing_values_are_named(example: Path, tmp_path: Path) -> None:
    outcome = console(
        "build", "wheel_loader", "--cad", example / "wheel_loader.step", "--out", tmp_path / "machine", cwd=tmp_path
    )
    assert outcome.returncode == 1, outcome.stderr
    report = json.loads((tmp_path / "machine" / "report.json").read_text(encoding="utf-8"))
    assert report["missing"] == ["Steering Cylinder Stroke", "Lift Cylinder Stroke", "Tilt Cylinder Stroke"]
    assert "--set" in outcome.stdout
    assert (tmp_path / "machine" / "scene.usda").exists()


def test_values_by_hand_win(example: Path, tmp_path: Path) -> None:
    outcome = console(
        "build", "wheel_loader", "--cad", example / "wheel_loader.step", "--specs", example / "specifications.pdf",
        "--out", tmp_path / "machine", "--set", "Tilt Cylinder Stroke=500 mm", "--set", "wheel_drive=rear",
        cwd=tmp_path,
    )  # fmt: skip
    report = json.loads((tmp_path / "machine" / "report.json").read_text(encoding="utf-8"))
    assert outcome.returncode == 1, "the CAD's own piston travel contradicts 500 mm, and so does the sheet"
    tilt = next(c for c in report["cylinders"] if c["stroke"] == 0.5)
    assert "set" in tilt["sources"]["stroke"]
    assert report["counts"]["angular_drives"] == 2


def test_json_output_is_one_document(example: Path, tmp_path: Path) -> None:
    outcome = console("extract", "wheel_loader", example / "specifications.pdf", "--json", cwd=tmp_path)
    values = {s["name"]: s for s in json.loads(outcome.stdout)["specifications"]}
    assert values["Lift Cylinder Stroke"]["value"] == pytest.approx(0.764)
    assert values["Lift Cylinder Stroke"]["status"] == "ok"


def test_measure_reads_the_usd_file_alone(named: tuple[Path, dict[str, Any]], tmp_path: Path) -> None:
    outcome = yellowiron("measure", named[0] / "wheel_loader.usda", "--json", cwd=tmp_path)
    assert outcome.returncode == 0, outcome.stderr
    again = {m["name"]: m["model"] for m in json.loads(outcome.stdout)["measurements"]}
    for m in named[1]["measurements"]:
        assert again[m["name"]] == pytest.approx(m["model"], rel=1e-6, abs=1e-6), m["name"]


def test_convert_writes_usd_alone(example: Path, tmp_path: Path) -> None:
    from pxr import Usd, UsdGeom

    outcome = console("convert", example / "wheel_loader.step", "--out", tmp_path / "cad.usd", cwd=tmp_path)
    assert outcome.returncode == 0, outcome.stderr
    stage = Usd.Stage.Open(str(tmp_path / "cad.usd"))
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    assert [p.name for p in tmp_path.iterdir()] == ["cad.usd"]
