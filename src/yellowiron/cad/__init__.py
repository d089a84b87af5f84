"""CAD files to an `Assembly`: `read_cad`; `check_file` without reading; `files_of`, what is read with it; `taken_apart`
for meshes of several parts, `rams_apart` for hydraulic cylinders in other meshes, `twins_apart` and `wheels_apart` for
left and right in one; `half_of`, `completed` and `mirrored` for machines of which one half is drawn.

In the order in which they build on each other: `naming` and `tolerances`; `appearance` and `mesh`; `brep`; then
`formats` (the registry: one entry a format), `proprietary` (formats without an open reader) and `recognition` (which of
them a file has); `readers`, one a format; and `read`, which has a reader work in a child process. A new format is an
entry in `formats` and a module in `readers`, or in another package.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.cad.dependence import files_of
from yellowiron.cad.read import check_file, read_cad
from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.cad.mesh.halves import completed, half_of, mirrored
    from yellowiron.cad.mesh.split import rams_apart, taken_apart, twins_apart, wheels_apart

__all__ = [
    "check_file",
    "completed",
    "files_of",
    "half_of",
    "mirrored",
    "rams_apart",
    "read_cad",
    "taken_apart",
    "twins_apart",
    "wheels_apart",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "completed": "mesh.halves",
        "half_of": "mesh.halves",
        "mirrored": "mesh.halves",
        "rams_apart": "mesh.split",
        "taken_apart": "mesh.split",
        "twins_apart": "mesh.split",
        "wheels_apart": "mesh.split",
    },
)
