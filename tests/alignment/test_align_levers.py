"""No hinge of a cylinder's triangle is on another's axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from kit.machines.defects import drawn
from kit.machines.excavators import any_features
from yellowiron.alignment.axes import AxisEstimate, Candidate, Frame, estimate_axes
from yellowiron.alignment.axes.levers import triangles_of, with_levers, without_lever
from yellowiron.alignment.features.solids import Solid, solids_of
from yellowiron.library import load_template
from yellowiron.model.template import Template, choose

SIZE = 10.0
HINGE, FOOT, TIP = (
    "upperstructure2boom_joint",
    "upperstructure2boom_cylinder_barrel_joint",
    "boom2boom_piston_rod_joint",
)


def template_of(choices: dict[str, str]) -> Template:
    return choose(load_template("excavator"), choices)


MONO = {"boom_cylinders": "single", "boom_type": "mono"}


def line(x: float, z: float, quality: float, y: float = 0.0) -> Candidate:
    """A line across the machine."""
    return Candidate(np.array([x, y, z]), np.array([0.0, 1.0, 0.0]), 0.001, 0.001, quality, "")


def levered(template: Template, **hinges: Sequence[Candidate]) -> dict[str, tuple[float, float]]:
    """Hinge → (x, z) of its best line."""
    found = with_levers(hinges, template, template.joints, SIZE)
    return {name: (float(lines[0].origin[0]), float(lines[0].origin[2])) for name, lines in found.items()}


def test_triangles_are_those_of_the_cylinders() -> None:
    template = template_of(MONO)
    pairs = set(triangles_of(template, {j.name for j in template.joints}))
    assert {(HINGE, FOOT), (HINGE, TIP), ("boom2arm_joint", "boom2arm_cylinder_barrel_joint")} <= pairs
    assert ("arm2tipping_link_joint", "bucket_piston_rod2tipping_link_joint") in pairs
    assert not any("swing" in name or "undercarriage" in name for pair in pairs for name in pair)
    # Three bodies on one pin are none: rod, tipping link and bucket link.
    shared = {"bucket_piston_rod2tipping_link_joint", "bucket_piston_rod2bucket_link_joint"}
    assert not any(set(pair) == shared for pair in pairs)


def test_the_hinge_gives_way_to_the_cylinder_s_foot_that_more_speaks_for() -> None:
    found = levered(
        template_of(MONO),
        **{HINGE: [line(1, 1, 0.67), line(0, 2, 0.26), line(5, 5, 0.04)], FOOT: [line(1, 1, 0.84, 0.3)]},
    )
    assert found == {HINGE: (0.0, 2.0), FOOT: (1.0, 1.0)}


def test_the_foot_gives_way_where_it_has_elsewhere_to_be() -> None:
    found = levered(
        template_of(MONO),
        **{
            HINGE: [line(1, 1, 0.9), line(0, 2, 0.2)],
            FOOT: [line(1.02, 1, 0.5), line(3, 1, 0.4)],
            TIP: [line(2, 3, 1)],
        },
    )
    assert found == {HINGE: (1.0, 1.0), FOOT: (3.0, 1.0), TIP: (2.0, 3.0)}


def test_hinges_apart_and_those_without_another_line_stay() -> None:
    template = template_of(MONO)
    apart = {HINGE: [line(1, 1, 0.9)], FOOT: [line(1.2, 1, 0.9)]}
    assert levered(template, **apart) == {HINGE: (1.0, 1.0), FOOT: (1.2, 1.0)}
    alone = {HINGE: [line(1, 1, 0.5), line(2, 2, 0.05)], FOOT: [line(1, 1, 0.9)]}
    assert levered(template, **alone) == {HINGE: (1.0, 1.0), FOOT: (1.0, 1.0)}


def test_a_pin_that_leaves_no_lever_is_not_its_hinge_s() -> None:
    template = template_of(MONO)
    way = (0.0, 1.0, 0.0)
    searched = {HINGE: ((1.0, 0.0, 1.0), way), FOOT: ((1.0, 0.4, 1.0), way), TIP: ((2.0, 0.0, 3.0), way)}

    def estimate(name: str, x: float, z: float, quality: float) -> AxisEstimate:
        return AxisEstimate(name, np.array([x, 0.0, z]), np.array(way), 0.01, 0.01, "", (), quality)

    elsewhere = {HINGE: estimate(HINGE, 0.0, 2.0, 0.3), FOOT: estimate(FOOT, 1.0, 1.0, 0.8)}
    assert without_lever(searched, elsewhere, template, SIZE) == {HINGE}
    assert not without_lever(searched, {**elsewhere, HINGE: estimate(HINGE, 0.0, 2.0, 0.05)}, template, SIZE)
    sound = {**searched, HINGE: ((0.0, 0.0, 2.0), way)}
    assert not without_lever(sound, elsewhere, template, SIZE), "it is where it was searched for"


@pytest.mark.slow
@pytest.mark.parametrize("seed", [3, 4, 8])
def test_a_boom_with_a_cylinder_s_foot_drawn_in_it_is_not_hinged_there(seed: int) -> None:
    """The boom's pin is not drawn, and the pins of its cylinders' feet were taken for the boom's."""
    machine = drawn("excavator", seed)
    template = template_of(any_features(seed).choices())
    solids = solids_of(machine.assembly())
    labels: dict[str, list[int]] = {}
    true: Solid | None = None
    for solid in solids:
        role, body = machine.truth[solid.part.id]
        if role == "boom_pin":
            true = solid
        elif role.startswith("boom_cylinder_barrel") and role.endswith("_pin"):
            labels.setdefault("boom", []).append(solid.index)
        elif body:
            labels.setdefault(body.partition("|")[0], []).append(solid.index)
    assert true is not None and true.line is not None
    found = estimate_axes(solids, labels, template, frame=Frame(*np.eye(3)))[HINGE]
    delta = found.origin - true.line.center
    across = np.linalg.norm(delta - (delta @ true.line.direction) * true.line.direction)
    height = max(float(s.high[2]) for s in solids) - min(float(s.low[2]) for s in solids)
    assert across < 0.01 * height


def test_of_twin_cylinders_one_that_is_blocks_has_the_other_s_line() -> None:
    """The right boom cylinder's round faces are not drawn, and a block of the boom's was taken for its barrel's."""
    seed = next(s for s in range(20) if any_features(s).choices().get("boom_cylinders") == "twin")
    machine = drawn("excavator", seed)
    solids, labels, block = [], dict[str, list[int]](), 0
    for solid in solids_of(machine.assembly()):
        role, body = machine.truth[solid.part.id]
        if body in ("boom_cylinder_barrel_r", "boom_piston_rod_r"):
            solid = replace(solid, cylinders=(), shaft=None, axis=None)
        solids.append(solid)
        if body == "boom" and not block and role == "boom":
            block = len(labels.setdefault("boom_cylinder_barrel_r", [])) + 1
            labels["boom_cylinder_barrel_r"].append(solid.index)
        elif body:
            labels.setdefault(body.partition("|")[0], []).append(solid.index)
    template = template_of(any_features(seed).choices())
    found = estimate_axes(solids, labels, template, frame=Frame(*np.eye(3)))
    slides = [found[f"boom_cylinder_barrel_{s}2boom_piston_rod_{s}_joint"] for s in "lr"]
    assert abs(float(slides[0].direction @ slides[1].direction)) > np.cos(np.radians(0.5))
    assert slides[1].how.startswith("its twin's")
