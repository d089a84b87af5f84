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
