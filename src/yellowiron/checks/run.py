"""The check: opens a file, reads it once, runs every rule, and OpenUSD's own validators beside them."""

from __future__ import annotations

from pathlib import Path

from yellowiron.checks.reading.opening import open_stage, register_schemas
from yellowiron.model.errors import YellowironError
from yellowiron.model.finding import Finding

_ORDER = {"error": 0, "warning": 1, "info": 2}


def check(path: str | Path) -> tuple[Finding, ...]:
    """The findings on a USD file: errors first, then warnings, then remarks; within these by code and the stage's
    order. Codes `CHK…` are ours, `USD:…` are OpenUSD's validators'. Any UsdPhysics stage will do; its units apply.

    `YellowironError` where there is no such file or it is no USD. References that lead nowhere are findings.
    """
    register_schemas()
    from pxr import Tf, UsdUtils

    from yellowiron.checks.reading.stage import read_view
    from yellowiron.checks.rules import RULES
    from yellowiron.checks.validators import validate

    file = Path(path)
    quiet = UsdUtils.CoalescingDiagnosticDelegate()  # what USD would print is among the findings
    try:
        stage = open_stage(file)
        view = read_view(stage, file.name)
        found = [finding for rule in RULES for finding in rule(view)]
        found += validate(stage)
    except Tf.ErrorException as error:
        words = " ".join(str(error).split())[:200]
        raise YellowironError(
            f"The file is damaged: {words}", where=str(path), hint="Copy it again, or write it again."
        ) from error
    finally:
        del quiet
    return tuple(sorted(found, key=lambda f: (_ORDER[f.severity], f.code)))
