"""Small files are read without a child process where the child is not what is tested: test_guard, test_cad_errors and
the format tests have it. A reader that crashed here would take the whole test process with it, and be seen."""

from __future__ import annotations

import importlib
from typing import Any

import pytest


@pytest.fixture
def read_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """`read_cad` reads in this process."""

    def call(target: str, *args: Any, **_: Any) -> Any:
        module, _, name = target.partition(":")
        return getattr(importlib.import_module(module), name)(*args)

    monkeypatch.setattr("yellowiron.cad.read.run_guarded", call)
