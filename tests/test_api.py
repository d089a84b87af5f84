"""The public names: there, callable, and what a script or a type checker expects of them."""

from __future__ import annotations

import importlib
import importlib.metadata
import inspect
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import yellowiron as yi
from yellowiron.model.errors import YellowironError

VERBS = (
    "align", "build", "check", "convert", "export", "extract", "lint", "list_templates", "load_template", "measure",
    "new_template", "read_cad", "simulate",
)  # fmt: skip


def test_every_name_is_there() -> None:
    assert dir(yi) == sorted(yi.__all__)
    assert all(getattr(yi, name) is not None for name in yi.__all__)
    with pytest.raises(AttributeError, match="no attribute 'flux'"):
        yi.flux  # noqa: B018


@pytest.mark.parametrize("verb", VERBS)
def test_verbs_have_real_signatures_and_say_what_they_do(verb: str) -> None:
    function = getattr(yi, verb)
    assert inspect.isfunction(function)
    kinds = {p.kind for p in inspect.signature(function).parameters.values()}
    assert not kinds & {inspect.Parameter.VAR_KEYWORD, inspect.Parameter.VAR_POSITIONAL}
    assert inspect.getdoc(function)


def test_no_package_hides_a_verb() -> None:
    """Importing a submodule sets its name on the package: none may be a verb's."""
    for name in ("alignment", "checks", "exporters", "simulation", "specs", "pipeline", "api"):
        importlib.import_module(f"yellowiron.{name}")
    assert all(inspect.isfunction(getattr(yi, verb)) for verb in VERBS)


def test_the_version_stands_in_one_place() -> None:
    assert importlib.metadata.version("yellowiron") == yi.__version__


def test_importing_costs_nothing() -> None:
    """No CAD, USD or physics library is loaded before one is asked for."""
    heavy = ("OCP", "pxr", "mujoco", "ortools", "scipy", "numpy", "networkx")
    code = f"import sys, yellowiron; print([n for n in {heavy} if n in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "[]\n"


@pytest.mark.parametrize("payload", [250, 250.0, np.float64(250.0), "250", "0.25 t"])
def test_a_payload_is_any_number_of_kilograms(payload: float | str, monkeypatch: pytest.MonkeyPatch) -> None:
    """numpy's numbers, too, which `repr` writes with their type."""
    given: list[float] = []

    def examined(file: Path, **options: Any) -> tuple[dict[str, Any], tuple[()]]:
        given.append(options["payload"].mass)
        return {}, ()

    monkeypatch.setattr("yellowiron.simulation.suite.examine", examined)
    assert yi.simulate("loader.usda", payload=payload) == {}
    assert given == [250.0]


@pytest.mark.slow
def test_an_engine_that_fails_does_not_take_the_build_with_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from kit.fleets import SETTINGS
    from kit.small import write_small
    from yellowiron import pipeline

    def failing(*given: object) -> None:
        raise YellowironError("The engine 'mujoco' took no step for 300 s", where="x", hint="Try another engine.")

    monkeypatch.setattr(pipeline, "_driven", failing)
    folder = write_small(tmp_path)
    machine = pipeline.build(
        folder / "type", folder / "small.glb", tmp_path / "out", settings=SETTINGS, engines=["mujoco"], page=False
    )
    (told,) = [f for f in machine.document["findings"] if f["code"] == "SIM010"]
    assert (told["severity"], told["where"]) == ("error", "mujoco")
    assert "took no step for 300 s: the machine was not driven there" in told["message"]
    assert machine.usd.is_file() and machine.fell_short
    with pytest.raises(YellowironError, match="There is no engine 'bullet'"):
        pipeline.build(folder / "type", folder / "small.glb", tmp_path / "none", engines=["bullet"])
