"""Rules over any UsdPhysics stage, ours or not: `check(path)` → `Finding`s with stable codes (`docs/findings.md`).

In goes a USD file, out come findings; nothing is written. In the order in which they build on each other: `tolerances`
and `values` (a stage's bodies, joints and colliders), `loops` of its joints, `motion` (what the loops let move),
`islands` (what joints hold together), `view` (all that the rules read); `reading` (stage → `View`); `rule` and `rules`
(`View` → findings); `validators` (OpenUSD's own, beside them); `run` (the whole check).
"""

from __future__ import annotations

from yellowiron.checks.run import check

__all__ = ["check"]
