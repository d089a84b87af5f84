"""Stages that are kept between runs: the same answer, at once; made anew where anything that they hang on changed."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from yellowiron import build, cad, checks, stages, usd
from yellowiron.cad.dependence import files_of
from yellowiron.library import load
from yellowiron.model.geometry import Mesh, PlaneFeature, SphereFeature
from yellowiron.support.caching import content, disk
from yellowiron.support.caching.content import content_of
from yellowiron.support.caching.disk import FRESH, VARIABLE, kept

PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False) | st.text() | st.binary(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner) | st.tuples(inner, inner),
    max_leaves=12,
)


@pytest.fixture
def memory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.setenv(VARIABLE, str(tmp_path / "cache"))
    monkeypatch.delenv(FRESH, raising=False)
    load._read.cache_clear()  # a template that this process has read already would not be kept in this folder
    yield tmp_path / "cache"


@given(PLAIN)
def test_content_is_that_of_an_equal_value(value: Any) -> None:
    from yellowiron.support.files import answers

    assert content_of(answers.loads(answers.dumps(value))) == content_of(value)


@pytest.mark.parametrize(("one", "other"), [
    (1, 1.0), (1, True), ("1", 1), ("ab", ["a", "b"]), ([["a"], "b"], ["a", ["b"]]), ({"a": 1}, {"a": 2}),
    (np.zeros(2), np.zeros(2, dtype=np.float32)), (np.zeros((2, 3)), np.zeros((3, 2))), (b"a", "a"), (None, ""),
    (Mesh(np.zeros((1, 3)), np.zeros((1, 3), dtype=int)), Mesh(np.ones((1, 3)), np.zeros((1, 3), dtype=int))),
    ([], {}), (0.0, -0.0), (Path("a"), "a"),
])  # fmt: skip
def test_content_tells_apart(one: Any, other: Any) -> None:
    assert content_of(one) != content_of(other)


def test_content_does_not_hang_on_what_is_shared_or_on_sets() -> None:
    array = np.arange(3.0)
    assert content_of([array, array]) == content_of([array.copy(), array.copy()])
    assert content_of(frozenset("abcdef")) == content_of(frozenset("fedcba"))
    with pytest.raises(TypeError, match="has no content"):
        content_of(object())
    with pytest.raises(TypeError, match="has no content"):
        content_of(np.array([object()]))


def test_rows_of_plain_values_are_told_apart_by_kind_and_content() -> None:
    centre = (1.0, 2.0, 3.0)
    shared = (SphereFeature(centre, 1.0, True, 3.0), SphereFeature(centre, 2.0, False, 4.0))
    own = (SphereFeature((1.0, 2.0, 3.0), 1.0, True, 3.0), SphereFeature((1.0, 2.0, 3.0), 2.0, False, 4.0))
    asked = content_of(shared)
    assert content_of(own) == asked
    assert asked not in {
        content_of(other)
        for other in (
            shared[::-1], shared[:1], (shared[0], replace(shared[1], radius=2)), (*shared, None),
            tuple(PlaneFeature(s.center, s.center, s.radius) for s in shared),
            (shared[0], replace(shared[1], radius=np.float64(2.0))),
            (shared[0], replace(shared[1], center=cast(Any, shared[0]))),
        )
    }  # fmt: skip


def test_a_value_is_digested_once_while_it_lives(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = Mesh(np.zeros((1, 3)), np.zeros((1, 3), dtype=int))
    again = Mesh(np.zeros((1, 3)), np.zeros((1, 3), dtype=int))
    asked = [content_of([mesh, "a"]), content_of(mesh), content_of(again)]
    before = len(content._remembered)
    with monkeypatch.context() as patch:
        patch.setattr(content, "_of_many", lambda value, known: pytest.fail("looked through again"))
        assert content_of(mesh) == asked[1] == asked[2]
    assert content_of([again, "a"]) == asked[0]
    del mesh, again
    assert len(content._remembered) == before - 2


def test_what_is_read_has_the_digest_of_what_was_made(memory: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def make() -> tuple[Mesh, int]:
        return Mesh(np.ones((4, 3)), np.zeros((1, 3), dtype=int)), 1

    made = content_of(kept("meshes", make)[0])
    read: Mesh = kept("meshes", lambda: pytest.fail("made again"))[0]
    with monkeypatch.context() as patch:
        patch.setattr(content, "_of_many", lambda value, known: pytest.fail("looked through again"))
        assert content_of(read) == made
    content._remembered.clear()
    assert content_of(read) == made


def test_kept_by_values_and_files(memory: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[int] = []
    file = tmp_path / "sheet.pdf"
    file.write_text("one")

    def ask(*given: object) -> int:
        return kept("numbers", lambda: calls.append(1) or len(calls), *given, files=[file])

    assert [ask("a"), ask("a"), ask("b"), ask("a")] == [1, 1, 2, 1]
    file.write_text("two")
    assert ask("a") == 3
    monkeypatch.setenv(FRESH, "1")
    assert [ask("a"), ask("a")] == [4, 5]
    monkeypatch.delenv(FRESH)
    # Another version of the program, or of a library, has its own answers.
    monkeypatch.setattr(disk, "_program", lambda: "another")
    assert ask("a") == 6
    monkeypatch.setenv(VARIABLE, "off")
    assert ask("a") == 7


def test_an_answer_that_fails_is_not_kept(memory: Path) -> None:
    for _ in range(2):
        with pytest.raises(ValueError, match="no"):
            kept("failures", lambda: int("no"))
    assert not list(memory.rglob("*.kept"))


def test_what_was_not_used_for_longest_goes(memory: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(disk, "_MOST", 3500)
    made: list[str] = []

    def ask(name: str) -> bytes:
        return kept("bytes", lambda: made.append(name) or bytes(1000), name)

    for name in ("a", "b", "c", "a", "d", "e"):
        ask(name)
    assert sum(file.stat().st_size for file in memory.rglob("*.kept")) <= 3500
    ask("e")
    assert made.count("e") == 1


def test_which_files_a_cad_file_hangs_on(tmp_path: Path, example: Path) -> None:
    assert files_of(example / "wheel_loader.step") == (example / "wheel_loader.step",)
    obj, urdf = tmp_path / "machine.obj", tmp_path / "machine.urdf"
    obj.write_text("mtllib looks.mtl\nv 0 0 0\n")
    urdf.write_text("<robot name='x'/>")
    (tmp_path / "looks.mtl").write_text("newmtl red")
    (tmp_path / "textures").mkdir()
    (tmp_path / "textures" / "rust.PNG").write_bytes(b"x")
    (tmp_path / "notes.txt").write_text("x")
    found = files_of(obj)
    assert found is not None
    assert [file.name for file in found] == ["machine.obj", "looks.mtl", "rust.PNG"]
    # A robot's meshes may be anywhere.
    assert files_of(urdf) is None
    assert files_of(tmp_path) is None


_LOADED = """
import sys
from yellowiron.cli import main
try:
    main()
except SystemExit as ended:
    assert not ended.code, ended
sys.stdout.write("loaded: " + " ".join({"mujoco", "networkx", "ortools", "pint", "pxr", "scipy"} & sys.modules.keys()))
"""


@pytest.mark.slow
def test_the_same_build_is_read_and_a_changed_one_made(
    memory: Path, example: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    model, sheet, out = example / "wheel_loader.step", example / "specifications.pdf", tmp_path / "out"

    def files() -> dict[str, bytes]:
        found = {str(f.relative_to(out)): f.read_bytes() for f in sorted(out.rglob("*")) if f.is_file()}
        found.pop("timings.json")
        return found

    build("wheel_loader", model, out, sheets=[sheet])
    first = files()
    monkeypatch.setenv(FRESH, "1")
    build("wheel_loader", model, out, sheets=[sheet])
    assert files() == first
    monkeypatch.delenv(FRESH)

    # What takes time is not asked again, though the first build has left its alignment in the folder.
    def refuse(*args: object, **kwargs: object) -> None:
        raise AssertionError("made again")

    with monkeypatch.context() as patch:
        for module, name in ((cad, "read_cad"), (stages, "find_roles"), (usd, "write_machine"), (checks, "check"),
                             (disk, "_write")):  # fmt: skip
            patch.setattr(module, name, refuse)
        shutil.rmtree(out / "payloads")
        machine = build("wheel_loader", model, out, sheets=[sheet])
        assert files() == first
        assert machine.mechanism.joint("front_frame2boom_joint").type == "revolute"

    # Nor is a library loaded that only asks for time.
    command = ["build", "wheel_loader", "--cad", model, "--specs", sheet, "--out", out]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    said = subprocess.run([sys.executable, "-c", _LOADED, *map(str, command)], env=environment, capture_output=True,
                          text=True, check=True)  # fmt: skip
    assert said.stdout.splitlines()[-1] == "loaded: "
    assert files() == first

    # A value does not touch who plays which role; the machine is another.
    with monkeypatch.context() as patch:
        patch.setattr(cad, "read_cad", refuse)
        patch.setattr(stages, "find_roles", refuse)
        build("wheel_loader", model, out, sheets=[sheet], settings=["Lift Cylinder Stroke=700 mm"])
        assert files() != first

    # A decision does, and is heard.
    document = json.loads((out / "alignment.json").read_text(encoding="utf-8"))
    entry = next(e for e in document["parts"] if e["role"] == "boom")
    entry["role"] = "front_frame"
    (out / "alignment.json").write_text(json.dumps(document), encoding="utf-8")
    again = build("wheel_loader", model, out, sheets=[sheet])
    assert {p.part: p.role for p in again.alignment.parts}[entry["part"]] == "front_frame"
