"""The examples' scripts, which draw them anew."""

from __future__ import annotations

import importlib

import pytest
from example_file import EXAMPLES

SCRIPTS = sorted(".".join(path.relative_to(EXAMPLES).with_suffix("").parts) for path in EXAMPLES.glob("*/*.py"))


@pytest.mark.parametrize("script", SCRIPTS)
def test_it_finds_what_it_stands_on(script: str) -> None:
    """None takes from another what has moved elsewhere; whole drawings are compared by the slow tests."""
    importlib.import_module(script)
