"""Opens a stage for checking: whatever opens is checked, and what does not is unusable input."""

from __future__ import annotations

import contextlib
import importlib
from pathlib import Path
from typing import Any

from yellowiron.model.errors import YellowironError

_SUFFIXES = (".usd", ".usda", ".usdc", ".usdz")
_SCHEMAS = ("newton_usd_schemas", "physx_usd_schemas")


def register_schemas() -> None:
    """Registers the engines' schemas where they are installed; it counts only before the first stage opens."""
    for name in _SCHEMAS:
        with contextlib.suppress(ImportError):
            importlib.import_module(name)


def open_stage(path: Path) -> Any:
    """The composed stage. References that lead nowhere are findings, not errors; `YellowironError` where there is no
    such file or it is no USD."""
    if not path.is_file():
        words = "This is a folder, not a file" if path.is_dir() else "There is no such file"
        raise YellowironError(words, where=str(path), hint="Give a USD file.")
    if path.suffix.lower() not in _SUFFIXES:
        raise YellowironError(
            "This is not a USD file", where=str(path), hint=f"USD files end in {', '.join(_SUFFIXES)}."
        )
    from pxr import Tf, Usd

    try:
        return Usd.Stage.Open(str(path))
    except Tf.ErrorException as error:
        raise YellowironError(
            "The file cannot be read as USD", where=str(path), hint="It is damaged or is not USD; write it again."
        ) from error
