"""Names that a package's front gives, each imported when it is first asked for: CAD, USD and physics take seconds."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Mapping
from typing import Any


def lazy_names(package: str, homes: Mapping[str, str]) -> tuple[Callable[[str], Any], Callable[[], list[str]]]:
    """The module functions `__getattr__` and `__dir__` (PEP 562) of a package whose names are imported on first use.

    `package` is its `__name__`; `homes` says of each name which module inside the package defines it, dotted from
    there ("solver.chain"). `dir` gives the package's `__all__`. `AttributeError` for every other name, as for a module
    without `__getattr__`.
    """

    def find(name: str) -> Any:
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return getattr(importlib.import_module(f"{package}.{homes[name]}"), name)

    def names() -> list[str]:
        return sorted(importlib.import_module(package).__all__)

    return find, names
