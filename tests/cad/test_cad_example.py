"""The example machine through the reader, against its own truth."""

from __future__ import annotations

import json
import time
from pathlib import Path

import numpy as np
import pytest

from yellowiron.cad import read_cad
from yellowiron.model.assembly import Assembly


@pytest.fixture(scope="module")
def truth(example: Path) -> dict[str, dict[str, dict[str, object]]]:
    path = example / "truth.json"
    if not path.exists():
        pytest.skip("the example is not drawn yet")
    return json.loads(path.read_text())


@pytest.fixture(scope="module")
def loader(example: Path) -> tuple[Assembly, float]:
    path = example / "wheel_loader.step"
    if not path.exists():
        pytest.skip("the example is not drawn yet")
    start = time.perf_counter()
    return read_cad(path), time.perf_counter() - start


@pytest.mark.slow
def test_every_part_is_read(loader: tuple[Assembly, float], truth: dict[str, dict[str, object]]) -> None:
    assembly, seconds = loader
    assert {part.id for part in assembly.parts} == set(truth["parts"])
    assert assembly.declared_occurrences == len(assembly.parts)
    assert len(assembly.shapes) < len(assembly.parts)
    assert not [finding for finding in assembly.findings if finding.severity != "info"]
    assert seconds < 30.0
    for shape in assembly.shapes.values():
        assert shape.closed
        assert shape.exact
        assert shape.volume > 0.0
        moments = np.linalg.eigvalsh(shape.inertia)
        assert moments[0] > 0.0
        assert moments[0] + moments[1] >= moments[2] * (1.0 - 1e-9)


@pytest.mark.slow
def test_every_pivot_is_a_cylinder_feature(
    loader: tuple[Assembly, float], truth: dict[str, dict[str, dict[str, object]]]
) -> None:
    assembly, _ = loader
    axes, points = [], []
    for part in assembly.parts:
        turn = part.transform[:3, :3]
        for feature in assembly.shape_of(part).cylinders:
            axes.append(turn @ feature.direction)
            points.append(turn @ feature.center + part.transform[:3, 3])
    all_axes, all_points = np.array(axes), np.array(points)
    for name, joint in truth["joints"].items():
        axis = np.array(joint["axis"], dtype=float)
        offset = all_points - np.array(joint["anchor"], dtype=float)
        away = np.linalg.norm(offset - np.outer(offset @ axis, axis), axis=1)
        turned = np.degrees(np.arcsin(np.clip(np.linalg.norm(np.cross(all_axes, axis), axis=1), 0.0, 1.0)))
        on_axis = (away < 1e-5) & (turned < 0.01)
        assert on_axis.sum() >= 2, f"{name}: no two cylinders of the model share its axis"
