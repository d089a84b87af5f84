"""Examples whose CAD files are not committed, drawn once a run, and what their tests hold of the machines built."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from kit.builds import MadeOnce, without_pages
from kit.machines.nameless import write_nameless
from yellowiron.model.alignment import Alignment
from yellowiron.pipeline import Machine, build

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
PERCENT, DEGREES = 0.3, 0.2
"""Bars of what is published."""


def drawn_example(name: str, made_once: MadeOnce, *arguments: str) -> Path:
    """A folder with an example's files, drawn with further arguments of its `main`, and in `nameless` its CAD file
    without names."""

    def fill(folder: Path) -> None:
        folder.mkdir()
        words = f"import sys; from pathlib import Path; from {name}.draw import main; "
        words += "main(Path(sys.argv[1]), *sys.argv[2:])"
        subprocess.run([sys.executable, "-c", words, str(folder), *arguments], cwd=EXAMPLES, check=True)
        (folder / "nameless").mkdir()
        write_nameless(folder / f"{name}.step", folder / "nameless" / f"{name}.step")

    return made_once("_".join([name, *arguments]), fill)


def built_example(name: str, made_once: MadeOnce, *arguments: str) -> Path:
    """The USD file of an example, built once a run of its drawing and its sheet."""
    folder = drawn_example(name, made_once, *arguments)

    def fill(out: Path) -> None:
        out.mkdir()
        with without_pages():
            build(name, folder / f"{name}.step", out / "out", sheets=(folder / "specifications.pdf",))

    return made_once("_".join([name, *arguments, "built"]), fill) / "out" / f"{name}.usda"


def assert_measured(machine: Machine, count: int) -> None:
    """So many values of the sheet are measured, each within its bar and none of them calibrated."""
    compared = [m for m in machine.measurements if m.spec is not None]
    assert len(compared) == count
    for m in compared:
        assert m.model is not None and m.spec is not None and m.role != "calibrated", m.name
        if m.unit == "rad":
            assert np.degrees(m.model) == pytest.approx(np.degrees(m.spec), abs=DEGREES), m.name
        else:
            assert m.model == pytest.approx(m.spec, rel=0.01 * PERCENT), m.name


def assert_as_drawn(machine: Machine, truth: Mapping[str, Any]) -> None:
    """Every joint and every cylinder is where and what the truth says."""
    frame, mechanism = machine.alignment.frame, machine.mechanism
    assert {j.name for j in mechanism.joints} == set(truth["joints"])
    for name, true in truth["joints"].items():
        joint = mechanism.joint(name)
        axis = frame[:3, :3] @ np.array(true["axis"])
        assert joint.type == true["type"] and np.linalg.norm(np.cross(axis, joint.axis)) < 1e-6, name
        apart = frame[:3, :3] @ np.array(true["anchor"]) + frame[:3, 3] - np.array(joint.anchor)
        if joint.type == "revolute":
            assert np.linalg.norm(np.cross(axis, apart)) < 1e-5, name
        else:
            assert np.dot(axis, joint.axis) > 0.0, name
    for slide, true in truth["cylinders"].items():
        found = next(c for c in mechanism.cylinders if c.slide == slide)
        assert found.bore == pytest.approx(true["bore"]) and found.stroke == pytest.approx(true["stroke"])
        assert found.closed_length == pytest.approx(true["closed_length"], abs=1e-6)


def assert_recognised(found: Alignment, truth: Mapping[str, Any]) -> None:
    """Every part is in its body, and none is to be looked at."""
    for part, (place, true) in zip(found.parts, truth["parts"].items(), strict=True):
        assert part.body == true["body"], place
    assert not found.to_review
