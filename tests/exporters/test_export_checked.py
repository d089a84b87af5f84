"""What is exported, read back by `check` and held against its machine over the strokes; and each planted fault told."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest

import yellowiron
from kit.builds import console
from yellowiron.model.errors import YellowironError
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Mechanism

FORMATS = {
    "mjcf": "small_loader.xml",
    "mjcf-tendons": "small_loader.xml",
    "urdf": "urdf/small_loader.urdf",
    "sdf": "model.sdf",
    "drake": "small_loader.sdf",
}


@pytest.fixture(scope="module")
def exported(usd_file: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    found = {}
    for to, name in FORMATS.items():
        folder = tmp_path_factory.mktemp("exported") / to
        yellowiron.export(usd_file, to=to, out=folder)
        found[to] = folder / name
    return found


@pytest.mark.parametrize("to", FORMATS)
def test_every_format_agrees_with_its_machine(to: str, exported: dict[str, Path], mechanism: Mechanism) -> None:
    (agreed,) = yellowiron.check(exported[to], machine=mechanism)
    assert agreed.code == "EXP006"
    told = re.fullmatch(r"Over (\d+) poses .* within ([\d.e+-]+) µm .*", agreed.message)
    assert told is not None and int(told[1]) >= 10 and float(told[2]) < 1e-3  # µm; the bar is 1


def test_the_welded_model_agrees_too(exported: dict[str, Path], mechanism: Mechanism) -> None:
    assert [f.code for f in yellowiron.check(exported["sdf"].with_name("model_welds.sdf"), machine=mechanism)] == [
        "EXP006"
    ]


def changed(file: Path, folder: Path, pattern: str, other: str) -> Path:
    """A copy of an export with one place changed."""
    whole = folder / "copy"
    shutil.copytree(file.parent.parent, whole)
    path = whole / file.parent.name / file.name
    text, count = re.subn(pattern, other, path.read_text(encoding="utf-8"), count=1, flags=re.DOTALL)
    assert count == 1
    path.write_text(text, encoding="utf-8")
    return path


def told(path: Path, mechanism: Mechanism) -> dict[str, Finding]:
    return {f.code: f for f in yellowiron.check(path, machine=mechanism)}


def test_a_joint_that_stands_elsewhere_is_told(exported: dict[str, Path], mechanism: Mechanism, tmp_path: Path) -> None:
    # The barrel's pin, and with it what hangs there, a millimetre forward.
    moved = changed(exported["mjcf"], tmp_path, r'(<joint name="barrel_joint"[^>]*pos=")0 ', r"\g<1>0.001 ")
    found = told(moved, mechanism)
    assert found["EXP002"].where == "barrel_joint" and "EXP006" not in found


def test_a_tendon_that_pulls_elsewhere_is_told(exported: dict[str, Path], mechanism: Mechanism, tmp_path: Path) -> None:
    slide = mechanism.cylinders[0].slide
    moved = changed(exported["mjcf-tendons"], tmp_path, rf'(<site name="{slide}.1" pos=")[^ ]+ ', r"\g<1>0.3 ")
    found = told(moved, mechanism)
    assert found["EXP002"].where == slide and "EXP006" not in found


def test_a_tendon_that_ends_early_is_told(exported: dict[str, Path], mechanism: Mechanism, tmp_path: Path) -> None:
    slide = mechanism.cylinders[0].slide
    short = changed(
        exported["mjcf-tendons"], tmp_path, rf'(<spatial name="{slide}" [^>]*range=")([^ ]+) [^"]+', r"\g<1>\g<2> 1.0"
    )
    assert told(short, mechanism)["EXP003"].where == slide


def test_a_limit_that_stops_the_machine_is_told(
    exported: dict[str, Path], mechanism: Mechanism, tmp_path: Path
) -> None:
    slide = next(j for j in mechanism.joints if j.type == "prismatic")
    assert slide.upper is not None
    short = changed(
        exported["urdf"],
        tmp_path,
        rf'(<joint name="{slide.name}" type="prismatic">.*?upper=")[^"]+',
        rf"\g<1>{slide.upper - 0.05}",
    )
    found = told(short, mechanism)
    assert found["EXP003"].where == slide.name and "50 mm early" in found["EXP003"].message


def test_a_mass_and_a_missing_body_are_told(exported: dict[str, Path], mechanism: Mechanism, tmp_path: Path) -> None:
    heavy = changed(exported["sdf"], tmp_path / "a", r"<mass>[^<]+", "<mass>12345")
    assert "12345 kg" in told(heavy, mechanism)["EXP004"].message
    renamed = tmp_path / "b.sdf"
    renamed.write_text(exported["sdf"].read_text(encoding="utf-8").replace("boom", "bo0m"), encoding="utf-8")
    assert told(renamed, mechanism)["EXP001"].where == "boom"


def test_open_loops_are_told(exported: dict[str, Path], mechanism: Mechanism, tmp_path: Path) -> None:
    alone = tmp_path / "alone.urdf"
    shutil.copy(exported["urdf"], alone)
    found = told(alone, mechanism)
    assert found["EXP005"].severity == "info" and "boom_joint" in found["EXP005"].message


def test_a_stage_is_held_against_nothing(usd_file: Path, mechanism: Mechanism) -> None:
    with pytest.raises(YellowironError, match="exported"):
        yellowiron.check(usd_file, machine=mechanism)


def test_the_command(exported: dict[str, Path], usd_file: Path, tmp_path: Path) -> None:
    done = console("check", exported["drake"], "--machine", usd_file, "--json", cwd=tmp_path)
    assert done.returncode == 0
    assert [f["code"] for f in json.loads(done.stdout)["findings"]] == ["EXP006"]
