"""Mass, centre and inertia against closed formulas: mirrored, scaled, open; and reconciled with a sheet."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mechanism_machine import box, machine, specifications, template

from yellowiron.mechanism import build_mechanism
from yellowiron.mechanism.bodies.choice import Choice
from yellowiron.mechanism.bodies.mass import Moments, combine, shell_moments, solid_moments
from yellowiron.mechanism.bodies.usual_weight import ground_length
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Mechanism

scale = st.floats(0.2, 3.0)
number = st.floats(-1.0, 1.0)


def box_inertia(mass: float, a: float, b: float, c: float) -> Floats:
    return mass / 12.0 * np.diag([b * b + c * c, a * a + c * c, a * a + b * b])


@settings(deadline=None)
@given(a=scale, b=scale, c=scale, mirror=st.booleans(), at=st.tuples(number, number, number))
def test_a_scaled_and_mirrored_box_is_the_box_of_that_size(
    a: float, b: float, c: float, mirror: bool, at: tuple[float, float, float]
) -> None:
    matrix = np.diag([-a if mirror else a, b, c, 1.0])
    matrix[:3, 3] = at
    found = solid_moments(box("box", (1.0, 2.0, 0.5), at=(0.1, 0.0, 0.2)), matrix, 7850.0)
    mass = 7850.0 * a * b * c
    assert found.mass == pytest.approx(mass)
    assert found.center == pytest.approx(matrix @ [0.1, 0.0, 0.2, 1.0] @ np.eye(4)[:, :3])
    assert found.inertia == pytest.approx(box_inertia(mass, a, 2.0 * b, 0.5 * c))


@settings(deadline=None)
@given(rows=st.lists(st.tuples(number, number, number), min_size=3, max_size=3))
def test_inertia_is_physically_valid_under_any_map(rows: list[tuple[float, float, float]]) -> None:
    matrix = np.eye(4)
    matrix[:3, :3] = np.array(rows) + 0.01 * np.eye(3)
    found = solid_moments(box("box", (1.0, 2.0, 0.5)), matrix, 7850.0)
    if found.mass < 1e-6:
        return
    small, middle, large = np.linalg.eigvalsh(found.inertia)
    assert small > 0.0
    assert small + middle >= large * (1.0 - 1e-9)


def test_the_parallel_axis_theorem_puts_two_halves_together() -> None:
    halves = [solid_moments(box("half", (1.0, 1.0, 0.5), at=(0, 0, z)), np.eye(4), 100.0) for z in (-0.25, 0.25)]
    whole = combine(halves)
    assert whole.mass == pytest.approx(100.0)
    assert whole.inertia == pytest.approx(box_inertia(100.0, 1.0, 1.0, 1.0))


def test_a_shell_is_its_triangles() -> None:
    """A square plate of 1 kg/m²: m/12 across its edges, m/6 about its normal (and no zero thickness)."""
    square = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, 0]], [[0, 0, 0], [1, 1, 0], [0, 1, 0]]], dtype=float)
    found = shell_moments(square + 5.0, 1.0)
    assert found.mass == pytest.approx(1.0)
    assert found.center == pytest.approx([5.5, 5.5, 5.0])
    assert np.diag(found.inertia) == pytest.approx([1 / 12, 1 / 12, 1 / 6], rel=1e-6)


def test_a_bad_inertia_is_made_valid() -> None:
    """A shape whose file claims an impossible inertia."""
    found = Moments(2.0, np.zeros(3), np.diag([-1.0, 0.5, 1.0]))
    assert np.linalg.eigvalsh(found.inertia).min() > 0.0


def mass_of(mechanism: Mechanism, body: str) -> float:
    return mechanism.body(body).mass


def build(**values: float) -> Mechanism:
    assembly, alignment = machine()
    return build_mechanism(assembly, template(), alignment, specifications(**values), name="crane")


def test_a_flat_body_s_moments_are_possible_in_single_precision() -> None:
    """What is left of an undercarriage without its tracks: 1.1 t, a long way from end to end, and flat."""
    moments = Moments(1127.0, np.zeros(3), np.diag([837.1, 66.9, 0.0])).inertia
    a, b, c = np.sort(np.linalg.eigvalsh(moments)).astype(np.float32)
    assert a + b > c
    assert c == pytest.approx(904.0, rel=1e-4)


def test_material_is_the_nearest_role_s() -> None:
    built = build()
    arm = next(p for p in built.body("arm").parts if p.role == "arm")
    assert (arm.material, arm.collision) == ("alloy", "convexDecomposition")
    assert arm.mass == pytest.approx(2.0 * 0.5 * 0.1 * 2700.0)
    base = next(p for p in built.body("base").parts if p.role == "base")
    assert (base.material, base.collision) == ("steel", "convexHull")
    assert set(built.materials) == {"steel", "alloy"}


def test_published_weights_are_met_body_first_then_the_whole() -> None:
    plain, met = build(), build(Arm_Weight=300.0, Operating_Weight=2000.0)
    assert mass_of(met, "arm") == pytest.approx(300.0)
    assert sum(b.mass for b in met.bodies) == pytest.approx(2000.0)
    assert sum(p.mass for b in met.bodies for p in b.parts) == pytest.approx(2000.0)
    factor = mass_of(met, "base") / mass_of(plain, "base")
    assert mass_of(met, "cylinder_rod") == pytest.approx(factor * mass_of(plain, "cylinder_rod"))
    assert met.body("base").inertia == pytest.approx(factor * plain.body("base").inertia)
    assert {(f.code, f.severity) for f in met.findings if f.code == "MEC032"} == {("MEC032", "info")}


def test_a_weight_far_off_is_a_warning() -> None:
    assert any(f.code == "MEC032" and f.severity == "warning" for f in build(Operating_Weight=20000.0).findings)


def test_component_weights_above_the_operating_weight_are_a_finding() -> None:
    built = build(Arm_Weight=300.0, Operating_Weight=200.0)
    assert "MEC033" in {f.code for f in built.findings}
    assert all(b.mass > 0.0 for b in built.bodies)


def test_entries_win_in_order() -> None:
    documents = {"BASE": "part", "arm": "document role", "*": "document star"}
    own = {"arm": "template role", "base": "template ancestor", "*": "star"}
    choice = Choice(template(), documents, own)
    pick = [choice.of(p, r) for p, r in (("base", None), ("X", "arm"), ("X", "rod_pin"))]
    assert [p[0] if p else None for p in pick] == ["part", "document role", "document role"]
    assert Choice(template(), {}, own).of("X", "arm_pin") == ("template ancestor", "template: role 'base'")
    assert Choice(template(), {}, {}).of("X", None) is None


def usual(kilograms: float, *, open_arm: bool = False, **values: float) -> Mechanism:
    """The crane, of a type that weighs so many kilograms where it stands on one metre, as its base does."""
    assembly, alignment = machine()
    if open_arm:
        shapes = {key: replace(shape, closed=key != "arm") for key, shape in assembly.shapes.items()}
        assembly = replace(assembly, shapes=shapes)
    known = template()
    weighed = tuple(replace(w, usual_weight=kilograms) if w.mass_of == "*" else w for w in known.wanted)
    return build_mechanism(assembly, replace(known, wanted=weighed), alignment, specifications(**values), name="crane")


def total(mechanism: Mechanism) -> float:
    return sum(body.mass for body in mechanism.bodies)


def test_without_a_weight_the_usual_one_of_type_and_size_is_assumed_and_told() -> None:
    drawn = total(build())
    for kilograms in (0.4 * drawn, 3.0 * drawn):
        built = usual(kilograms)
        assert total(built) == pytest.approx(kilograms)
        (finding,) = [f for f in built.findings if f.code == "MEC035"]
        assert finding.severity == "warning" and "stand on 1.00 m" in finding.message
        assert '--set "Operating Weight=… kg"' in finding.hint


def test_a_piece_of_what_it_stands_on_tells_no_weight() -> None:
    """A public excavator, of whose undercarriage 0.18 m were found, was given 1.7 kg, and MuJoCo refused it."""
    assembly, alignment = machine()
    arm = assembly.shapes["arm"]
    long = replace(arm, mesh=replace(arm.mesh, points=arm.mesh.points * [20.0, 1.0, 1.0]))
    known = template()
    weighed = tuple(replace(w, usual_weight=1.0) if w.mass_of == "*" else w for w in known.wanted)
    assembly = replace(assembly, shapes={**assembly.shapes, "arm": long})
    built = build_mechanism(assembly, replace(known, wanted=weighed), alignment, specifications(), name="crane")
    assert not [f for f in built.findings if f.code == "MEC035" and "stand on" in f.message]
    assert total(built) > 100.0


def test_a_weight_that_is_near_the_usual_one_or_published_stays() -> None:
    drawn = total(build())
    assert total(usual(1.3 * drawn)) == pytest.approx(drawn)
    assert total(usual(9.0 * drawn, Operating_Weight=2000.0)) == pytest.approx(2000.0)
    for built in (usual(1.3 * drawn), usual(9.0 * drawn, Operating_Weight=2000.0)):
        assert not [f for f in built.findings if f.code == "MEC035"]


def test_a_published_bucket_does_not_stop_the_machine_s_weight_from_being_assumed() -> None:
    built = usual(3.0 * total(build()), Arm_Weight=300.0)
    assert mass_of(built, "arm") == pytest.approx(300.0) and total(built) == pytest.approx(3.0 * total(build()))
    assert [f.code for f in built.findings if f.code in ("MEC035", "MEC032") and f.where == "mass"] == ["MEC035"]


@dataclass(frozen=True)
class Standing:
    """A placement of wheels, a row each, by the boxes that they fill: x from, to; y from, to."""

    boxes: tuple[tuple[float, float, float, float], ...]

    @property
    def roles(self) -> list[str]:
        return ["wheel"] * len(self.boxes)

    def points_of(self, rows: list[int]) -> np.ndarray:
        corners = [((x0, y0, 0.0), (x1, y1, 0.6)) for x0, x1, y0, y1 in (self.boxes[row] for row in rows)]
        return np.array(corners).reshape(-1, 3)


def test_wheels_of_one_axle_or_one_wheel_are_no_length_to_weigh_a_machine_by() -> None:
    known = template()
    rolling = replace(known, roles=(*known.roles, replace(known.roles[0], name="wheel", kind="wheel")))
    front, other, rear = (1.6, 2.2, 0.4, 0.6), (1.6, 2.2, -0.6, -0.4), (0.0, 0.6, 0.4, 0.6)
    assert ground_length(cast("Any", Standing((front, other, rear))), rolling) == pytest.approx(2.2)
    assert ground_length(cast("Any", Standing((front, other))), rolling) is None
    # A public forklift has one wheel drawn: it weighed 54 kg.
    assert ground_length(cast("Any", Standing((front,))), rolling) is None


def test_what_a_weight_leaves_is_in_the_open_shapes() -> None:
    """A box of aluminium as a sheet: as thick as the weight makes it, and what is closed keeps its volume."""
    area, closed = 2.0 * (2.0 * 0.5 + 2.0 * 0.1 + 0.5 * 0.1), total(build()) - 2.0 * 0.5 * 0.1 * 2700.0
    built = usual(1.0, open_arm=True, Operating_Weight=closed + 0.012 * area * 2700.0)
    assert mass_of(built, "base") == pytest.approx(mass_of(build(), "base"), rel=1e-3)
    assert any(f.code == "MEC031" and "12 mm" in f.message for f in built.findings)
    # No sheet is thicker than 20 mm: the rest is everybody's.
    built = usual(10.0 * closed, open_arm=True)
    assert total(built) == pytest.approx(10.0 * closed) and mass_of(built, "base") > 2.0 * mass_of(build(), "base")
