"""The pages for users of simulators say what a built machine has."""

from __future__ import annotations

import ast
import importlib.util
import json
import re
from pathlib import Path
from typing import Any

import pytest

from kit.builds import script
from yellowiron.model.sensor import PARAMETERS


def blocks(page: Path) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def test_every_parameter_of_a_sensor_is_documented(root: Path) -> None:
    page = (root / "docs" / "sensors.md").read_text(encoding="utf-8")
    rows: dict[str, str] = {}
    kind = ""
    for first, second in re.findall(r"^\| (.*?)\| (.*?) \|", page, re.MULTILINE):
        kind = first.strip(" `") or kind
        rows[kind] = rows.get(kind, "") + second
    for name, parameters in PARAMETERS.items():
        assert {p for p in parameters if f"`{p}`" not in rows[name]} == set(), name


@pytest.mark.parametrize("name", ["isaac-lab", "isaac-sim", "learners", "learning"])
def test_code_on_the_pages_is_python(root: Path, name: str) -> None:
    for block in blocks(root / "docs" / f"{name}.md"):
        ast.parse(block)


@pytest.fixture(scope="module")
def built(built_loader: Any) -> Path:
    """The example, built."""
    folder: Path = built_loader.folder
    return folder


@pytest.fixture(scope="module")
def joints(built: Path) -> dict[str, dict[str, Any]]:
    report = json.loads((built / "report.json").read_text(encoding="utf-8"))
    return {j["name"]: j for j in report["joints"]}


def groups(root: Path) -> dict[str, list[str]]:
    """Actuator group → its expressions, from the page's `ArticulationCfg`."""
    (block,) = blocks(root / "docs" / "isaac-lab.md")
    found: dict[str, list[str]] = {}
    for node in ast.walk(ast.parse(block)):
        if isinstance(node, ast.Dict):
            for key, value in zip(node.keys, node.values, strict=True):
                if isinstance(value, ast.Call) and isinstance(key, ast.Constant):
                    (names,) = (k.value for k in value.keywords if k.arg == "joint_names_expr")
                    found[str(key.value)] = ast.literal_eval(names)
    return found


@pytest.mark.slow
def test_the_articulation_cfg_names_every_joint_once(root: Path, joints: dict[str, dict[str, Any]]) -> None:
    """As Isaac Lab does: an expression matches a whole name, and each finds at least one."""
    tree = [j for j in joints.values() if not j["cut"] and j["type"] != "fixed"]
    owners: dict[str, list[str]] = {j["name"]: [] for j in tree}
    for group, expressions in groups(root).items():
        for expression in expressions:
            matched = [name for name in owners if re.fullmatch(expression, name)]
            assert matched, expression
            for name in matched:
                owners[name].append(group)
    assert {name: found for name, found in owners.items() if len(found) != 1} == {}
    driven = {j["name"]: j["drive"]["kind"] for j in tree if j["drive"]}
    assert {name for name, (group,) in owners.items() if group != "passive"} == set(driven)
    assert {driven[name] for name, (group,) in owners.items() if group == "wheels"} == {"velocity"}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["isaac-lab", "isaac-sim"])
def test_joints_named_on_the_pages_exist(root: Path, joints: dict[str, dict[str, Any]], name: str) -> None:
    text = (root / "docs" / f"{name}.md").read_text(encoding="utf-8")
    single = {"boom_cylinder_barrel2boom_piston_rod_joint"}
    named = set(re.findall(r"\b[a-z_0-9]+_joint\b", text)) - {"_joint"} - single
    assert {n for n in named if n not in joints and not n.startswith("_")} == set()
    for cut in re.findall(r"`(rear2front_joint|front_frame2boom_joint|boom2bucket_joint)`", text):
        assert joints[cut]["cut"]


@pytest.mark.slow
def test_prims_named_on_the_pages_exist(built: Path, root: Path) -> None:
    from pxr import Usd

    stage = Usd.Stage.Open(str(built / "scene.usda"))
    for path in ("rear_frame/cab_camera", "rear_frame/roof_lidar/device", "bucket", "boom/bucket_camera"):
        assert stage.GetPrimAtPath(f"/World/wheel_loader/{path}"), path


@pytest.mark.slow
def test_the_learners_page_runs(root: Path, built: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "wheel_loader").symlink_to(built)  # where `make demo` leaves it
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    for block in blocks(root / "docs" / "learners.md"):
        exec(compile(block, "docs/learners.md", "exec"), names)
    assert names["boom"].angle(names["boom"].stroke(-0.5)) == pytest.approx(-0.5, abs=1e-6)
    turned = names["chain"].coordinate(names["state"], names["boom"].pivot)
    assert turned == pytest.approx(float(names["boom"].angle(0.2)), abs=2e-4)
    assert names["controls"]["boom"] > 0.0 > names["controls"]["bucket"]


@pytest.mark.slow
def test_the_environments_page_runs(root: Path, built: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("gymnasium", reason="needs pip install 'yellowiron[learn]'")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "wheel_loader").symlink_to(built)
    monkeypatch.chdir(tmp_path)
    names: dict[str, Any] = {}
    for block in blocks(root / "docs" / "learning.md"):
        exec(compile(block, "docs/learning.md", "exec"), names)
    assert names["seen"].shape == names["env"].observation_space.shape
    assert len(names["levers"]) == len(names["env"].action_space.low)
    assert names["where"]


@pytest.mark.slow
def test_pages_made_from_docstrings_are_those_of_the_code(root: Path) -> None:
    """`python docs/generate.py` writes them anew."""
    spec = importlib.util.spec_from_file_location("generate", root / "docs" / "generate.py")
    assert spec is not None and spec.loader is not None
    generate = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(generate)
    assert (root / "docs" / "api.md").read_text(encoding="utf-8") == generate.api_page()
    assert (root / "docs" / "rooms.md").read_text(encoding="utf-8") == generate.rooms_page()


@pytest.mark.slow
def test_a_machine_in_five_lines(five_lines: Path) -> None:
    said = (five_lines / "said.txt").read_text(encoding="utf-8").splitlines()
    assert said[0] == "Ready."
    assert all(Path(line).is_file() for line in said[1:3])
    (height,) = (line for line in said if line.startswith("Hinge Pin Height at Maximum Lift"))
    assert float(height.split()[-2]) == pytest.approx(4.370, rel=1e-3)


@pytest.mark.slow
def test_a_loop_over_strokes(root: Path, built: Path, tmp_path: Path) -> None:
    picture = tmp_path / "height.png"
    said = script(root, "bucket_height.py", built / "wheel_loader.usda", picture)
    assert float(said.split()[3]) == pytest.approx(4.370, rel=1e-3)
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_files_that_pages_name_are_there(root: Path) -> None:
    pages = [*sorted((root / "docs").glob("*.md")), root / "README.md", root / "CONTRIBUTING.md"]
    named = {
        (page.name, path)
        for page in pages
        for path in re.findall(
            r"\b(?:src/yellowiron|tests|docs|benchmarks|examples)/[\w./-]+\.\w+", page.read_text("utf-8")
        )
    }
    assert len(named) > 20
    assert {(page, path) for page, path in named if not (root / path).exists() and "nnn" not in path} == set()
