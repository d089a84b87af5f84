"""Packages whose names are imported on first use."""

import importlib
import subprocess
import sys

import pytest

PACKAGES = ("exporters", "kinematics", "simulation", "usd")


@pytest.mark.parametrize("package", PACKAGES)
def test_every_name_is_there(package: str) -> None:
    module = importlib.import_module(f"yellowiron.{package}")
    assert set(module.__all__) <= set(dir(module))
    for name in module.__all__:
        assert getattr(module, name) is not None


@pytest.mark.parametrize("package", PACKAGES)
def test_another_name_is_not(package: str) -> None:
    with pytest.raises(AttributeError, match=f"module 'yellowiron.{package}' has no attribute 'wings'"):
        _ = importlib.import_module(f"yellowiron.{package}").wings


def test_nothing_heavy_is_imported_before_its_use() -> None:
    heavy = "{'mujoco', 'pxr', 'scipy', 'numpy'}"
    code = f"import sys; from yellowiron import {', '.join(PACKAGES)}; print({heavy} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "set()\n"
