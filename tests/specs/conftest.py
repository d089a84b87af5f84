"""Sheets drawn for a single test are read without a child process: what a child costs and guards is tested by itself
(test_guard, test_specs_robust, test_specs_hostile, test_specs_ocr, and the examples' sheets)."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from typing import Any

import pytest


@pytest.fixture(scope="module")
def read_here() -> Iterator[None]:
    """`extract` and `read` read in this process."""

    def call(target: str, *args: Any, **_: Any) -> Any:
        module, _, name = target.partition(":")
        return getattr(importlib.import_module(module), name)(*args)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("yellowiron.specs.reader.run_guarded", call)
        yield
