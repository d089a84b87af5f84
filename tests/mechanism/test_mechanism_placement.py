"""Parts in the machine frame: features and facets through mirrored, scaled and sheared transforms."""

from __future__ import annotations

import numpy as np
import pytest
from mechanism_machine import box, pin
from scipy.spatial.transform import Rotation

from yellowiron.mechanism.placement import Placement, ancestors, place
from yellowiron.model.alignment import Alignment, PartAssignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.geometry import Floats, Shape
from yellowiron.model.template import Role, Template

TEMPLATE = Template("t", "", "base", (Role("base", None, True), Role("pin", "base", False, "pin")), ())


def placed(shape: Shape, matrix: Floats) -> Placement:
    part = Part("P", "P", (), shape.key, matrix)
    assembly = Assembly("a", "step", 1.0, (part,), {shape.key: shape})
    alignment = Alignment("t", np.eye(4), (PartAssignment("P", "pin", "base", 1.0, ""),))
    placement, findings = place(assembly, TEMPLATE, alignment)
    assert not findings
    return placement


def test_a_mirrored_and_enlarged_pin_is_a_larger_pin() -> None:
    matrix = np.diag([-2.0, 2.0, 2.0, 1.0])
    matrix[:3, 3] = (1.0, 0.0, 0.0)
    features = placed(pin("pin", 0.1, 0.5), matrix).features([0])
    assert features.radius == pytest.approx([0.2])
    assert features.length == pytest.approx([1.0])
    assert features.center[0] == pytest.approx([1.0, 0.0, 0.0])
    assert abs(features.direction[0, 2]) == pytest.approx(1.0)


def test_the_diagonal_is_that_of_the_box_around_parts() -> None:
    turned = np.diag([-2.0, 2.0, 2.0, 1.0])
    machine = placed(pin("pin", 0.1, 0.5), turned)
    assert machine.diagonal([0]) == pytest.approx(float(np.linalg.norm(np.ptp(machine.points_of([0]), axis=0))))
    assert machine.diagonal([]) == 0.0


def test_a_pin_made_longer_is_one_and_a_flattened_one_is_none() -> None:
    longer = placed(pin("pin", 0.1, 0.5), np.diag([1.0, 1.0, 3.0, 1.0])).features([0])
    assert (longer.radius[0], longer.length[0]) == pytest.approx((0.1, 1.5))
    assert len(placed(pin("pin", 0.1, 0.5), np.diag([1.0, 1.2, 1.0, 1.0])).features([0])) == 0


@pytest.mark.parametrize(("squeezed", "round_"), [(1e-6, True), (3e-5, True), (1e-3, False), (0.1, False)])
def test_single_precision_leaves_a_pin_its_shaft(squeezed: float, round_: bool) -> None:
    """Transforms of open models are off by 1e-6 to 3e-5; what is squeezed by a thousandth is no cylinder."""
    matrix = np.diag([1e-3 * (1.0 + squeezed), 1e-3, 1e-3, 1.0])
    matrix[:3, :3] = Rotation.from_euler("xyz", (0.3, 1.1, -0.4)).as_matrix() @ matrix[:3, :3]
    features = placed(pin("pin", 100.0, 500.0), matrix).features([0])
    assert features.radius == pytest.approx([0.1] * round_, rel=1e-4)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_facets_face_outwards_even_when_mirrored(sign: float) -> None:
    center, normal, area = placed(box("box", (1.0, 2.0, 3.0)), np.diag([sign, 1.0, 1.0, 1.0])).facets(0)
    assert np.sum(center * normal, axis=1).min() > 0.0
    assert area.sum() == pytest.approx(22.0)


def test_ancestors_are_nearest_first_and_none_for_an_unknown_role() -> None:
    assert [r.name for r in ancestors(TEMPLATE, "pin")] == ["pin", "base"]
    assert ancestors(TEMPLATE, "moon") == ancestors(TEMPLATE, None) == ()
