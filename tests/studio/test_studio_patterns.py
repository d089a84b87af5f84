"""Patterns that are offered for a selection."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from yellowiron.alignment import fits
from yellowiron.model.alignment import RoleRule
from yellowiron.model.assembly import Assembly, Part
from yellowiron.studio.patterns import patterns_of

IDS = (
    "D30/TRACTOR/CAB ASSY/SEAT", "D30/TRACTOR/CAB ASSY/DOOR", "D30/TRACTOR/RAIL L", "D30/TRACTOR/RAIL R",
    "D30/HITCH/FORK", "D30/HITCH/TUBE", "D30/REAR/CYL L/ROD", "D30/REAR/CYL L/EYE", "D30/REAR/CYL R/ROD",
    "D30/REAR/BOLT M12 1", "D30/REAR/BOLT M12 2", "D30/HITCH/BOLT M12 3", "D30/TRACTOR/HITCH/FORK#2",
)  # fmt: skip
PARTS = tuple(
    Part(i, i.split("/")[-1].removesuffix("#2"), tuple(i.split("/")[:-1]), "s", np.eye(4)) for i in IDS
)  # fmt: skip
MODEL = Assembly("model", "STEP", 1.0, PARTS, {})


def fitting(pattern: str) -> Sequence[str]:
    return [part.id for part in PARTS if fits(pattern)(part)]


def offered(*selected: str, rules: Sequence[RoleRule] = ()) -> list[str]:
    found = patterns_of(selected, MODEL, fitting, rules)
    assert all(list(one.parts) == fitting(one.pattern) for one in found)
    return [one.pattern for one in found]


@pytest.mark.parametrize(("selected", "first"), [
    (IDS[:2], ["CAB ASSY/*", "TRACTOR/*"]),  # a whole assembly, then the one around it; not all of the machine
    (IDS[6:8], ["CYL L/*", "REAR/*"]),
    (IDS[4:6], ["D30/HITCH/*"]),  # another assembly has that name: as much of the path as tells them apart
    (IDS[9:12], ["BOLT M12*"]),  # of several assemblies: what their names share, without the number
    (IDS[9:10], ["REAR/*", "BOLT M12*"]),
])  # fmt: skip
def test_what_a_selection_may_mean(selected: tuple[str, ...], first: list[str]) -> None:
    assert offered(*selected) == first


def test_what_was_said_before_stands_there_too() -> None:
    rules = (RoleRule("HITCH", "hitch"), RoleRule("CAB ASSY/*", None), RoleRule("GONE/*", "boom"))
    assert offered(*IDS[:2], rules=rules) == ["CAB ASSY/*", "TRACTOR/*", "HITCH", "GONE/*"]
    known = {one.pattern: (one.ruled, one.role) for one in patterns_of(IDS[:2], MODEL, fitting, rules)}
    assert known == {"CAB ASSY/*": (True, None), "TRACTOR/*": (False, None), "HITCH": (True, "hitch"),
                     "GONE/*": (True, "boom")}  # fmt: skip
    assert offered(rules=rules) == ["HITCH", "CAB ASSY/*", "GONE/*"]


def test_what_everything_is_named_means_nothing() -> None:
    parts = tuple(Part(f"Assembly/Part_{k:03d}", f"Part_{k:03d}", ("Assembly",), "s", np.eye(4)) for k in range(12))
    model = Assembly("model", "STEP", 1.0, parts, {})
    found = patterns_of(
        [p.id for p in parts[3:5]], model, lambda pattern: [p.id for p in parts if fits(pattern)(p)], ()
    )  # fmt: skip
    assert found == []
