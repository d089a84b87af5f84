"""What a guarded child answers: whole for what is ours, nothing else at all."""

from __future__ import annotations

import os
import pickle
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from yellowiron.model.errors import CadError, YellowironError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Mesh
from yellowiron.support.files import answers
from yellowiron.support.guard import run_guarded


class OtherError(CadError):
    """As a package that brings a reader may have one."""


class Calls:
    """A pickle of one calls what it was made with."""

    def __init__(self, function: Any, *words: Any) -> None:
        self.call = function, words

    def __reduce__(self) -> Any:
        return self.call


def back(value: Any) -> Any:
    return answers.loads(answers.dumps(value))


@pytest.mark.parametrize("value", [None, 1.5, "ä", b"\0", (1, [2.0, {"a": {3}}]), Path("/a/b"), 2**80])
def test_plain_data_comes_back(value: object) -> None:
    assert back(value) == value and type(back(value)) is type(value)


@pytest.mark.parametrize("kind", ["|b1", "<i4", "<i8", "<f4", "<f8", "|u1"])
@pytest.mark.parametrize("shape", [(), (0, 3), (2, 3)])
def test_arrays_come_back_and_can_be_written(kind: str, shape: tuple[int, ...]) -> None:
    array = np.asfortranarray(np.ones(shape, dtype=kind))
    found = back(array)
    assert found.dtype == array.dtype and found.shape == array.shape and (found == array).all()
    found[...] = 0
    assert back(np.float64(2.5)) == 2.5


def test_our_values_come_back_and_stay_one() -> None:
    finding = Finding("CAD001", "warning", "a", "words")
    mesh = Mesh(np.eye(3), np.zeros((1, 3), dtype=np.int32))
    one, other, again = back((finding, mesh, mesh))
    assert one == finding and other is again
    assert (other.points == mesh.points).all() and other.normals is None


def test_errors_come_back_as_those_of_this_package() -> None:
    for error, kind in (
        (CadError("a", where="b", hint="c"), CadError),
        (OtherError("a", where="b", hint="c"), CadError),
    ):
        found = back(error)
        assert type(found) is kind and (found.message, found.where, found.hint) == ("a", "b", "c")


HOSTILE = {
    "a command": Calls(os.system, "touch ran"),
    "a process": Calls(subprocess.Popen, ["touch", "ran"]),
    "a word of Python's": Calls(eval, "open('ran', 'w')"),
    "a method": Calls(getattr, Path("ran"), "touch"),
    "numpy's own": np.zeros(3),
    "another's class": Calls(answers.make, "value", "subprocess:Popen", "touch ran"),
    "a function of ours": Calls(answers.make, "value", "yellowiron.support.guard:run_child", "ran"),
    "a name behind a name": Calls(answers.make, "value", "yellowiron.support.guard:os.system", "touch ran"),
    "a class that ours imports": Calls(answers.make, "value", "yellowiron.support.guard:Path", "ran"),
    "objects by their addresses": Calls(answers.make, "array", "|O", (1,), bytearray(8)),
    "more numbers than there are": Calls(answers.make, "array", "<f8", (1 << 40,), bytearray(8)),
    "no array at all": Calls(answers.make, "array", "<f8", (1,), "12345678"),
    "too little": Calls(answers.make, "value", "yellowiron.model.finding:Finding", "CAD001"),
    "an error that is none": Calls(answers.make, "error", "yellowiron.model.finding:Finding", "a", "b", "c"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_an_answer_runs_nothing(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises((pickle.UnpicklingError, ValueError)):
        answers.loads(pickle.dumps(HOSTILE[name]))
    assert list(tmp_path.iterdir()) == []


def test_what_is_no_answer_is_not_sent() -> None:
    for value in (print, object(), np.zeros(2, dtype=object), Calls):
        with pytest.raises(TypeError):
            answers.dumps(value)


WRITES = """
import os, pickle, sys
class Call:
    def __reduce__(self):
        return os.system, ("touch {marker}",)
answer = pickle.load(open(sys.argv[4], "rb"))[3]
open(answer, "wb").write(pickle.dumps(("value", Call())))
os._exit(0)
"""


def test_a_child_that_was_taken_over_says_nothing(tmp_path: Path) -> None:
    """Whatever it writes in place of its answer."""
    marker = tmp_path / "ran"
    with pytest.raises(YellowironError, match="gave no answer that is one") as caught:
        run_guarded("builtins:exec", WRITES.replace("{marker}", str(marker)), where="a.step", error=CadError)
    assert isinstance(caught.value, CadError) and caught.value.hint and not marker.exists()
