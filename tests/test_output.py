"""Output is whole or absent."""

from __future__ import annotations

from pathlib import Path

import pytest

from yellowiron.model.errors import OutputError
from yellowiron.support.output import output_file, output_folder


def test_a_folder_appears_whole(tmp_path: Path) -> None:
    with output_folder(tmp_path / "a" / "out") as folder:
        (folder / "payloads").mkdir()
        (folder / "payloads" / "x").write_text("1")
        assert not (tmp_path / "a" / "out").exists()
    assert (tmp_path / "a" / "out" / "payloads" / "x").read_text() == "1"
    assert [p.name for p in (tmp_path / "a").iterdir()] == ["out"]


def test_a_failure_leaves_what_was_there(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "x").write_text("old")
    with pytest.raises(RuntimeError), output_folder(tmp_path / "out") as folder:
        (folder / "x").write_text("new")
        raise RuntimeError
    assert (tmp_path / "out" / "x").read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


def test_a_second_run_replaces_its_own_and_keeps_the_user_s(tmp_path: Path) -> None:
    for content in ("first", "second"):
        with output_folder(tmp_path / "out") as folder:
            (folder / "payloads").mkdir()
            (folder / "payloads" / "base").write_text(content)
        (tmp_path / "out" / "notes.txt").write_text("mine")
        (tmp_path / "out" / "payloads" / "notes.txt").write_text("mine")
    assert (tmp_path / "out" / "payloads" / "base").read_text() == "second"
    assert sorted(str(p.relative_to(tmp_path / "out")) for p in (tmp_path / "out").rglob("*")) == [
        "notes.txt",
        "payloads",
        "payloads/base",
        "payloads/notes.txt",
    ]
    assert [p.name for p in tmp_path.iterdir()] == ["out"]


def test_a_file_appears_whole(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError), output_file(tmp_path / "a.usd") as path:
        path.write_text("half")
        raise RuntimeError
    assert list(tmp_path.iterdir()) == []
    with output_file(tmp_path / "a.usd") as path:
        assert path.suffix == ".usd"
        path.write_text("whole")
    assert [p.name for p in tmp_path.iterdir()] == ["a.usd"]


def test_a_place_that_cannot_be_written_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError), output_folder(tmp_path / "file"):
        pass
    with pytest.raises(OutputError), output_folder(tmp_path / "file" / "out"):
        pass
    with pytest.raises(OutputError), output_file(tmp_path):
        pass


def test_another_suffix_is_refused_before_any_work(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"\.stl"), output_file(tmp_path / "a.stl", suffixes=(".usd",)):
        raise AssertionError("the block must not run")


def test_a_file_in_a_folder_s_place_is_an_error_before_anything_is_moved(tmp_path: Path) -> None:
    for taken in ("scene.xml", "assets"):
        out = tmp_path / taken
        out.mkdir()
        (out / "machine.xml").write_text("old")
        (out / "scene.xml").mkdir() if taken == "scene.xml" else (out / "assets").write_text("mine")
        with pytest.raises(OutputError, match="has to be written") as caught, output_folder(out) as folder:
            (folder / "assets").mkdir()
            (folder / "assets" / "a.stl").write_text("")
            (folder / "machine.xml").write_text("new")
            (folder / "scene.xml").write_text("")
        assert caught.value.where == str(out / taken)
        assert (out / "machine.xml").read_text() == "old"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["assets", "scene.xml"]
