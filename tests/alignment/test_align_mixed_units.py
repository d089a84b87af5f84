"""Parts written in another unit than the rest of their file: put right, told, and listed for review."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from kit.machines.another_unit import in_another_unit
from kit.machines.defects import drawn
from kit.machines.synthetic import Machine
from yellowiron.alignment.assignment.unit_scale import larger
from yellowiron.alignment.mixed_units import in_one_unit
from yellowiron.library import load_template
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import CylinderFeature
from yellowiron.model.specification import Specifications
from yellowiron.stages import find_roles

INCH = 0.0254


@pytest.fixture(scope="module")
def machine() -> Machine:
    return drawn("loader", 21)


@pytest.fixture(scope="module")
def sound(machine: Machine) -> Assembly:
    return machine.assembly()


def of_body(machine: Machine, body: str) -> list[str]:
    """The parts of a body, the largest first."""
    assembly = machine.assembly()
    ids = [part for part, (role, true) in machine.truth.items() if true == body and not role.endswith("_pin")]
    return sorted(ids, key=lambda part: -assembly.shape_of(assembly.part(part)).area)


def same_places(one: Assembly, other: Assembly) -> bool:
    pairs = zip(one.parts, other.parts, strict=True)
    return all(np.allclose(one.points_of(a), other.points_of(b), atol=1e-6) for a, b in pairs)


def test_a_sound_model_is_the_same_object(sound: Assembly) -> None:
    model, units = in_one_unit(sound)
    assert model is sound
    assert not units.mended and not units.lost


def test_touching_much_says_nothing_of_what_is_inside_the_machine(sound: Assembly) -> None:
    """A small part by the file's origin that touches nothing (a pin with play) touches the more the larger it is."""
    pin = min(sound.parts, key=lambda p: sound.shape_of(p).area)
    place = pin.transform.copy()
    place[:3, 3] = (0.01, 0.013, 0.017)
    middle = sound.points_of(pin).mean(axis=0) - pin.transform[:3, 3]
    place[:3, 3] -= middle
    model = replace(sound, parts=(*sound.parts, replace(pin, id="loose", transform=place)))
    found, units = in_one_unit(model)
    assert found is model
    assert not units.mended


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [1e3, 1e-3, 1 / INCH, INCH, 0.1])
def test_one_part_in_another_unit(machine: Machine, sound: Assembly, ratio: float) -> None:
    part = of_body(machine, "bucket")[0]
    model, units = in_one_unit(in_another_unit(sound, {part}, ratio))
    assert {p: pytest.approx(1 / ratio) for p in units.mended} == {p: r for p, (r, _) in units.mended.items()}
    assert set(units.mended) == {part}
    assert same_places(model, sound)


def test_parts_that_fit_each_other_in_another_unit(machine: Machine, sound: Assembly) -> None:
    """A bore and its pin still fit each other where both are a thousandth as large."""
    parts = {of_body(machine, body)[0] for body in ("bucket_piston_rod", "bucket_cylinder_barrel", "bucket_link")}
    model, units = in_one_unit(in_another_unit(sound, parts, 1e-3))
    assert set(units.mended) == parts
    assert same_places(model, sound)


@pytest.mark.slow
def test_it_is_told_and_for_review(machine: Machine, sound: Assembly) -> None:
    part = of_body(machine, "bucket")[0]
    template = load_template("wheel_loader")
    _, before = find_roles(sound, template, Specifications())
    _, found = find_roles(in_another_unit(sound, {part}, 1 / INCH), template, Specifications())
    assert {p.part: p.body for p in found.parts} == {p.part: p.body for p in before.parts}
    assert part in found.to_review and part not in before.to_review
    (told,) = (f for f in found.findings if f.code == "ALN033")
    assert part in told.message and "0.0254 times" in told.message
    (label,) = (p for p in found.parts if p.part == part)
    assert label.confidence <= 0.5 and "0.0254 times" in label.reason
    assert not any(f.code == "ALN033" for f in before.findings)


@pytest.mark.parametrize("ratio", [1e-3, INCH])
def test_a_part_whose_faces_fit_nothing_is_left_and_doubted(machine: Machine, sound: Assembly, ratio: float) -> None:
    part = of_body(machine, "bucket")[0]
    middle, turn = sound.points_of(sound.part(part)).mean(axis=0), np.eye(4)
    turn[:3, :3] = Rotation.from_euler("xz", (0.05, 0.05)).as_matrix()
    turn[:3, 3] = middle - turn[:3, :3] @ middle
    parts = (replace(p, transform=turn @ p.transform) if p.id == part else p for p in sound.parts)
    model = in_another_unit(replace(sound, parts=tuple(parts)), {part}, ratio)
    found, units = in_one_unit(model)
    assert found is model
    assert units.doubted == (part,)


@pytest.mark.slow
def test_what_no_unit_explains_is_for_review(machine: Machine, sound: Assembly) -> None:
    part = of_body(machine, "bucket_piston_rod")[0]
    spoiled = in_another_unit(sound, {part}, 517.0)
    model, units = in_one_unit(spoiled)
    assert model is spoiled
    assert units.lost == (part,)
    _, found = find_roles(spoiled, load_template("wheel_loader"), Specifications())
    assert part in found.to_review


@pytest.mark.slow
def test_of_half_the_parts_nobody_knows(sound: Assembly) -> None:
    spoiled = in_another_unit(sound, [p.id for p in sound.parts[::2]], 1e-3)
    model, units = in_one_unit(spoiled)
    assert model is spoiled and not units.mended


def test_doubt_of_round_faces_is_scaled_with_them(sound: Assembly) -> None:
    """By how much a coarse cylinder may be off is a length, too."""
    shape = next(s for s in sound.shapes.values() if s.cylinders)
    first = replace(shape.cylinders[0], error=0.002)
    coarse: CylinderFeature = larger(replace(shape, cylinders=(first,)), 1e-3, "small").cylinders[0]
    assert coarse.error == pytest.approx(2e-6)
