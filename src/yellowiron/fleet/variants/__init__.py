"""Variants of a built machine: what varies, drawn by a seed, put to its mechanism, solved, and written small.

In the order in which they build on each other: `parameters` (a file → what varies), `sampling` (draws), `tools` (other
tools), `changes` (values → mechanism), `solving` (loops, limits, gains), `layers` and `deltas` (USD layers, MJCF
deltas), `scripts` (Isaac Lab), `writing` (the whole way).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.fleet.variants.deltas import apply, spec_of
    from yellowiron.fleet.variants.writing import Varied, vary

__all__ = ["Varied", "apply", "spec_of", "vary"]

__getattr__, __dir__ = lazy_names(
    __name__, {"Varied": "writing", "apply": "deltas", "spec_of": "deltas", "vary": "writing"}
)
