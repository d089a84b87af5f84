"""Many machines: a manifest of them built, and variants of one that was built.

`batch` takes a manifest (YAML, TOML, JSON, CSV) and builds what it names, an item a child process, here or on a Ray
cluster; out come a folder an item, whole or absent, a table and a page. `vary` takes a machine and a file of
parameters; out come small USD layers, or MJCF deltas, and a table of what was sampled.

In the order in which they build on each other: `values` (items, plans, outcomes), `places` (folders and addresses),
`documents` (files that a person writes), `manifest` (→ a plan), `keys` (what a result depends on), `figures` (a
machine's row), `child` (what runs in an item's process), `attending` (that process, watched over), `pool` and `on_ray`
(who runs them), `results` and `gallery` (table and page), `whole` (the whole way); `variants` is a room of its own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.fleet.documents import schema
    from yellowiron.fleet.manifest import read_manifest
    from yellowiron.fleet.on_ray import RayRunner
    from yellowiron.fleet.pool import LocalRunner
    from yellowiron.fleet.values import Item, Outcome, Plan
    from yellowiron.fleet.variants import Varied, vary
    from yellowiron.fleet.whole import Choice, Fleet, batch, planned

__all__ = [
    "Choice",
    "Fleet",
    "Item",
    "LocalRunner",
    "Outcome",
    "Plan",
    "RayRunner",
    "Varied",
    "batch",
    "planned",
    "read_manifest",
    "schema",
    "vary",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "Choice": "whole",
        "Fleet": "whole",
        "Item": "values",
        "LocalRunner": "pool",
        "Outcome": "values",
        "Plan": "values",
        "RayRunner": "on_ray",
        "Varied": "variants",
        "batch": "whole",
        "planned": "whole",
        "read_manifest": "manifest",
        "schema": "documents",
        "vary": "variants",
    },
)
