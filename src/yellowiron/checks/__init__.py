"""Rules over any UsdPhysics stage, ours or not: `check(path)` → findings with stable codes (`docs/findings.md`)."""

from __future__ import annotations

from yellowiron.checks.run import check

__all__ = ["check"]
