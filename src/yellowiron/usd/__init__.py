"""USD: machines and plain assemblies written, machines read back.

`Mechanism` × `Assembly` → a machine's files (`write_machine`), `Assembly` → plain USD (`write_assembly`), a machine's
file → `Mechanism` (`read_mechanism`) or what it counts (`count_joints`, `count_colliders`). The names here import `pxr`
when they are used. In order: `authoring` (how anything is written), `planning` (what is written where), `layers` (one
concept a layer), `write`, `convert`, `read`, `counts`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.usd.convert import write_assembly
    from yellowiron.usd.counts import count_colliders, count_joints
    from yellowiron.usd.read import read_mechanism
    from yellowiron.usd.write import write_machine

__all__ = ["count_colliders", "count_joints", "read_mechanism", "write_assembly", "write_machine"]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "count_colliders": "counts",
        "count_joints": "counts",
        "read_mechanism": "read",
        "write_assembly": "convert",
        "write_machine": "write",
    },
)
