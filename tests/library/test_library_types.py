"""An equipment type is a folder: of the library, of the user's, or of an installed package; no code knows its name."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from typer.testing import CliRunner

from kit.packages import install_package
from yellowiron import library
from yellowiron.cli import app
from yellowiron.library import type_folders
from yellowiron.model.errors import YellowironError

SOUND = Path(__file__).resolve().parent.parent / "data" / "templates" / "sound"


def test_a_folder_among_the_librarys_is_a_type(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(SOUND, tmp_path / "tower_crane")
    monkeypatch.setattr(type_folders, "library_folder", lambda: tmp_path)
    assert library.list_templates() == ("tower_crane",)
    assert library.load_template("Tower Crane") == library.load_template(tmp_path / "tower_crane")
    assert library.lint(library.load_template("tower_crane")).sound
    assert not library.is_sheet_only("tower_crane")


def test_a_folder_anywhere_is_a_type(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(SOUND, tmp_path / "tower_crane")
    monkeypatch.chdir(tmp_path)
    assert library.load_template("./tower_crane").root == "base"
    assert "tower_crane" not in library.list_templates()


def installed(folder: Path, patch: pytest.MonkeyPatch, value: str) -> None:
    """A package `acme` with a type, as an installer leaves it, whose entry point is `value`."""
    (folder / "acme" / "machines").mkdir(parents=True)
    for package in ("acme", "acme/machines"):
        (folder / package / "__init__.py").write_text("")
    shutil.copytree(SOUND, folder / "acme" / "machines" / "tower_crane")
    shutil.copytree(SOUND, folder / "acme" / "machines" / "excavator")
    (folder / "acme" / "no_package").mkdir()
    install_package(folder, patch, name="acme", group="yellowiron.templates", entries={"acme": value})


def test_types_of_an_installed_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    own = library.list_templates()
    installed(tmp_path, monkeypatch, "acme.machines")
    assert set(library.list_templates()) - set(own) == {"tower_crane"}
    assert library.load_template("tower_crane").root == "base"
    assert library.load_template("excavator").root == "undercarriage"
    listed = CliRunner().invoke(app, ["templates", "list"]).output.splitlines()
    assert "tower_crane" in listed


@pytest.mark.parametrize("value", ["acme.trucks", "acme.no_package"])
def test_an_installed_package_without_the_folder_it_names(
    value: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    installed(tmp_path, monkeypatch, value)
    with pytest.raises(YellowironError, match=r"cannot be (found|loaded)") as caught:
        library.list_templates()
    assert caught.value.where == f"acme (yellowiron.templates: acme = {value})"


def test_a_users_own_template_is_told_from_a_type_of_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("wheel_loader").mkdir()
    assert library.own_template("wheel_loader") is None and library.own_template("Wheel Loader") is None
    assert library.own_template("./wheel_loader") is not None
    assert library.own_template(tmp_path / "wheel_loader") == tmp_path / "wheel_loader"
    with pytest.raises(YellowironError):
        library.own_template("no_such_type")
