"""Rules over any UsdPhysics stage, ours or not, and over URDF, SDFormat and MJCF: `check(path)` → `Finding`s with
stable codes (`docs/findings.md`); `check_against` holds what was exported against its machine.

In goes a file, out come findings; nothing is written. In the order in which they build on each other: `tolerances`
and `values` (a stage's bodies, joints and colliders), `loops` of its joints, `motion` (what the loops let move),
`islands` (what joints hold together), `view` (all that the rules read); `reading` (stage → `View`), `exchange` (other
programs' files → `View`); `rule` and `rules` (`View` → findings); `validators` (OpenUSD's own, beside them);
`comparison` (with the machine); `run` (the whole check).

Findings of a comparison:

======  =================================================================================================
EXP001  the file lacks a body or a joint of the machine
EXP002  a joint does not let its bodies be where the kinematics has them
EXP003  a joint's limits stop the machine within its strokes
EXP004  a body's mass, centre or inertia is not the machine's
EXP005  pins of the machine's loops are open in the file
EXP006  how near the file's joints hold the bodies to where the kinematics has them
======  =================================================================================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.checks.comparison import Posed
    from yellowiron.checks.run import check, check_against

__all__ = ["Posed", "check", "check_against"]

__getattr__, __dir__ = lazy_names(__name__, {"Posed": "comparison", "check": "run", "check_against": "run"})
