"""USD: machines and plain assemblies written, machines read back. The names here import `pxr` when they are used."""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.usd.convert import write_assembly
    from yellowiron.usd.counts import count_joints
    from yellowiron.usd.read import read_mechanism
    from yellowiron.usd.write import write_machine

__all__ = ["count_joints", "read_mechanism", "write_assembly", "write_machine"]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "count_joints": "counts",
        "read_mechanism": "read",
        "write_assembly": "convert",
        "write_machine": "write",
    },
)
