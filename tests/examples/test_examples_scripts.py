"""The examples' scripts, which draw them anew."""

from __future__ import annotations

import importlib

import pytest
from example_file import EXAMPLES

SCRIPTS = sorted(".".join(path.relative_to(EXAMPLES).with_suffix("").parts) for path in EXAMPLES.glob("*/*.py"))


ENGINES = {"newton", "newton_usd_schemas", "physx_usd_schemas", "ovphysx", "warp", "mujoco_warp"}
"""What the extras of engines bring: without these a script that needs one is not tried."""


@pytest.mark.slow
@pytest.mark.parametrize("script", SCRIPTS)
def test_it_finds_what_it_stands_on(script: str) -> None:
    """None takes from another what has moved elsewhere; whole drawings are compared by the slow tests."""
    try:
        importlib.import_module(script)
    except ModuleNotFoundError as error:
        if error.name not in ENGINES:
            raise
        pytest.skip(f"{error.name} is not installed")
