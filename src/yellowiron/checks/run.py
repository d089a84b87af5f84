"""The check: opens a file, reads it once, runs every rule, and OpenUSD's own validators beside them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from yellowiron.checks import rules
from yellowiron.checks.comparison import Posed, compare
from yellowiron.checks.exchange.opening import is_exchange, read_exchange
from yellowiron.checks.exchange.parts import with_loose
from yellowiron.checks.reading.opening import open_stage, register_schemas
from yellowiron.checks.view import View
from yellowiron.model.errors import YellowironError
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Mechanism

_ORDER = {"error": 0, "warning": 1, "info": 2}


def check(path: str | Path) -> tuple[Finding, ...]:
    """The findings on a file: errors first, then warnings, then remarks; within these by code and the file's order.
    Codes `CHK…` are ours, `USD:…` are OpenUSD's validators'. Any UsdPhysics stage will do, its units apply; of a URDF,
    SDFormat or MJCF file the links and joints are checked.

    `YellowironError` where there is no such file, or it is none of these. References that lead nowhere are findings.
    """
    file = Path(path)
    return _sorted(_of_exchange(*read_exchange(file)) if is_exchange(file) else _of_stage(file))


def check_against(
    path: str | Path, mechanism: Mechanism, poses: Sequence[Posed], *, reduced: Mechanism | None = None
) -> tuple[Finding, ...]:
    """`check`, and the file held against the machine that it was written from: its bodies, joints, limits and masses
    over the machine's `poses` (codes `EXP…`). Errors as in `check`, and where the file is a USD file. `reduced`: the
    machine as it is where its cylinders are distances and its hooks hang on nothing but rope, for files that write them
    so."""
    file = Path(path)
    if not is_exchange(file):
        raise YellowironError(
            "What is held against a machine is a file that was exported from it", where=str(file),
            hint="Give a URDF, SDFormat or MJCF file; USD files need no --machine.",
        )  # fmt: skip
    view, own = read_exchange(file)
    slides = {cylinder.slide for cylinder in mechanism.cylinders}
    if reduced is not None:
        hung = {*reduced.floating} - {*mechanism.floating} - {end for joint in view.joints for end in joint.bodies}
        if hung or any(j.type == "distance" and j.path in slides for j in view.joints):
            mechanism = reduced
    view = with_loose(view, {joint.name for joint in mechanism.joints if joint.free})
    return _sorted((*_of_exchange(view, own), *compare(view, mechanism, poses)))


def _sorted(found: Iterable[Finding]) -> tuple[Finding, ...]:
    return tuple(sorted(found, key=lambda f: (_ORDER[f.severity], f.code)))


def _of_exchange(view: View, own: tuple[Finding, ...]) -> list[Finding]:
    return [*(finding for rule in rules.EXCHANGED for finding in rule(view)), *own]


def _of_stage(file: Path) -> list[Finding]:
    register_schemas()
    from pxr import Tf, UsdUtils

    from yellowiron.checks.reading.stage import read_view
    from yellowiron.checks.validators import validate

    quiet = UsdUtils.CoalescingDiagnosticDelegate()  # what USD would print is among the findings
    try:
        stage = open_stage(file)
        view = read_view(stage, file.name)
        found = [finding for rule in rules.RULES for finding in rule(view)]
        found += validate(stage)
    except Tf.ErrorException as error:
        words = " ".join(str(error).split())[:200]
        raise YellowironError(
            f"The file is damaged: {words}", where=str(file), hint="Copy it again, or write it again."
        ) from error
    finally:
        del quiet
    return found
