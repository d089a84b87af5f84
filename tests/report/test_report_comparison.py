"""Two builds beside each other."""

from __future__ import annotations

import copy
import io
import json
import math
from pathlib import Path
from typing import Any

import pytest
from rich.console import Console

from yellowiron.report import difference_table, differences

pytestmark = pytest.mark.slow  # its machine is built for it


@pytest.fixture(scope="module")
def document(five_lines: Path) -> Any:
    return json.loads((five_lines / "out" / "report.json").read_text(encoding="utf-8"))


def test_a_build_is_like_itself(document: Any) -> None:
    assert differences(document, copy.deepcopy(document)) == []


def test_what_differs_is_said_once(document: Any) -> None:
    other = copy.deepcopy(document)
    hinge = next(j for j in other["joints"] if j["name"] == "front_frame2boom_joint")
    hinge["anchor"] = [hinge["anchor"][0] + 0.01, hinge["anchor"][1] + 5.0, hinge["anchor"][2]]
    slid = next(j for j in other["joints"] if j["type"] == "prismatic")
    slid["upper"] = slid["upper"] - 0.1
    other["cylinders"][0]["stroke"] -= 0.041
    other["bodies"][1]["parts"].append(other["bodies"][0]["parts"].pop())
    other["bodies"][2]["mass"] *= 1.1
    other["specifications"][0].update(value=0.8, source="set")
    gone = other["findings"].pop()
    found = differences(document, other)
    assert [d.kind for d in found] == ["value", "cylinder", "joint", "joint", "mass", "part", "finding"]
    by_kind = {d.kind: d for d in reversed(found)}
    assert by_kind["value"].after == "800 mm (given)"
    assert by_kind["part"].after == other["bodies"][1]["name"]
    assert by_kind["finding"].after == "" and by_kind["finding"].before == gone["message"]
    moved = {d.name: d.after for d in found if d.kind == "joint"}
    # Along its axis a hinge is where it was.
    assert moved["front_frame2boom_joint"] == "moved 10 mm, turned 0°"
    assert f"{slid['name']} limits" in moved
    console = Console(width=100, file=io.StringIO())
    console.print(difference_table(found))
    assert isinstance(console.file, io.StringIO)
    assert "2 joints" in console.file.getvalue()


def test_a_rods_speed_is_in_metres_a_second(document: Any) -> None:
    other = copy.deepcopy(document)
    other["cylinders"][0]["speed"] = 0.125
    (found,) = differences(document, other)
    assert found.name.endswith(" speed") and found.after == "0.125 m/s"


def test_joints_that_are_there_but_once_or_turned(document: Any) -> None:
    other = copy.deepcopy(document)
    first = other["joints"].pop(0)
    turned = other["joints"][0]
    a = math.radians(1.0)
    x, y, z = turned["axis"]
    turned["axis"] = [x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a), z]
    if abs(z) > 0.9:
        turned["axis"] = [math.sin(a), 0.0, math.cos(a) * z]
    found = [d for d in differences(document, other) if d.kind == "joint"]
    assert (found[0].name, found[0].after) == (first["name"], "")
    assert "turned 1°" in found[1].after
