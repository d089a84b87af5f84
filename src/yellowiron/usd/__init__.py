"""USD: machines and plain assemblies written, machines read back. The names here import `pxr` when they are used."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from yellowiron.usd.convert import write_assembly
    from yellowiron.usd.counts import count_joints
    from yellowiron.usd.read import read_machine, read_mechanism
    from yellowiron.usd.write import write_machine

__all__ = ["count_joints", "read_machine", "read_mechanism", "write_assembly", "write_machine"]

_HOMES = {
    "count_joints": "counts",
    "read_machine": "read",
    "read_mechanism": "read",
    "write_assembly": "convert",
    "write_machine": "write",
}


def __getattr__(name: str) -> Any:
    """The public functions, imported on first use."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    import importlib

    return getattr(importlib.import_module(f"{__name__}.{_HOMES[name]}"), name)
