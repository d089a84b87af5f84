"""Sites of forks and of booms: where a fork's blade meets its shank, and which way a slide points."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import mechanism_machine as hand
import numpy as np
import pytest

from yellowiron.mechanism.joints.frames import JointFrame
from yellowiron.mechanism.placement import place
from yellowiron.mechanism.sites import sites
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Mesh, Shape
from yellowiron.model.mechanism import Site
from yellowiron.model.template import JointTemplate, Role, SiteTemplate, Template

TILT = math.radians(7.0)


def _site(rule: dict[str, object], shapes: Mapping[str, Shape], frames: Mapping[str, JointFrame] | None = None) -> Site:
    """The site of a rule on a body of some shapes, all tilted back by 7 degrees."""
    c, n = math.cos(TILT), math.sin(TILT)
    tilted = np.array([[c, 0, -n, 0], [0, 1, 0, 0], [n, 0, c, 0], [0, 0, 0, 1]])
    role, site = Role("carriage", None, rigid=True), SiteTemplate("forks", "carriage", rule)
    template = Template("truck", "", "carriage", (role,), (), sites=(site,))
    parts = tuple(Part(name, name, (), name, tilted) for name in shapes)
    played = tuple(PartAssignment(name, "carriage", "carriage", 1.0, "") for name in shapes)
    alignment = Alignment("truck", np.eye(4), played)
    findings: list[Finding] = []
    placement, _ = place(Assembly("truck", "STEP", 1.0, parts, dict(shapes)), template, alignment)
    (found,) = sites(template, frames or {}, placement, findings)
    assert findings == []
    return found


def _blades(*, shank: bool) -> dict[str, Shape]:
    """Two blades of 1.2 m from x = 0.1, their tops at z = 0.05; with `shank` each reaches up behind its blade."""
    shapes = {}
    for name, y in (("left", 0.3), ("right", -0.3)):
        shapes[f"{name} blade"] = hand.box(f"{name} blade", (1.2, 0.12, 0.05), at=(0.7, y, 0.025))
        if shank:
            shapes[f"{name} shank"] = hand.box(f"{name} shank", (0.05, 0.12, 0.6), at=(0.075, y, 0.3))
    return shapes


@pytest.mark.parametrize("shank", [True, False])
def test_a_fork_s_heel_is_where_its_blade_ends_at_the_rear(shank: bool) -> None:
    site = _site({"heel": 0.02}, _blades(shank=shank))
    c, n = math.cos(TILT), math.sin(TILT)
    assert site.position == pytest.approx((0.1 * c - 0.05 * n, 0.0, 0.1 * n + 0.05 * c), abs=1e-6)
    assert site.x_axis == pytest.approx((c, 0.0, n), abs=1e-9) and site.z_axis == pytest.approx((-n, 0.0, c), abs=1e-9)


def test_of_a_fork_in_one_piece_the_faces_say_where_the_heel_is() -> None:
    """The back of the shank is the piece's rear end; its front face is the fork's."""
    blade, shank = (hand.box(n, size, at=at) for n, size, at in (
        ("fork", (1.2, 0.12, 0.05), (0.7, 0.0, 0.025)), ("shank", (0.05, 0.12, 0.6), (0.075, 0.0, 0.3)),
    ))  # fmt: skip
    mesh = Mesh(np.vstack([blade.mesh.points, shank.mesh.points]), np.vstack([hand.BOX, hand.BOX + 8]))
    whole = replace(blade, mesh=mesh, volume=blade.volume + shank.volume, planes=blade.planes + shank.planes)
    site = _site({"heel": 0.02}, {"fork": whole})
    c, n = math.cos(TILT), math.sin(TILT)
    assert site.position == pytest.approx((0.1 * c - 0.05 * n, 0.0, 0.1 * n + 0.05 * c), abs=1e-6)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_boom_s_site_points_along_its_slide_forwards(sign: float) -> None:
    axis = sign * np.array([math.cos(0.6), 0.0, math.sin(0.6)])
    joint = JointTemplate("slide", "prismatic", ("carriage", "inner"))
    frame = JointFrame(joint, ("carriage", "inner"), np.array([1.0, 0.0, 2.0]), axis, 1.0, {})
    site = _site({"pointing": ("other", "slide")}, _blades(shank=True), {"slide": frame})
    assert site.position == (1.0, 0.0, 2.0) and site.x_axis == pytest.approx((math.cos(0.6), 0.0, math.sin(0.6)))
    assert site.z_axis == pytest.approx((-math.sin(0.6), 0.0, math.cos(0.6)))
