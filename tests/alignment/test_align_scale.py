"""Models in another unit than they claim: noticed by the sheet's overall length, and scaled."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kit.machines.synthetic import loader
from kit.scene import scene
from yellowiron import kinematics, stages
from yellowiron.alignment import align, other_size, to_scale
from yellowiron.alignment.assignment.unit_scale import scaled
from yellowiron.library import is_sheet_only, list_templates, load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.finding import Finding
from yellowiron.model.rows import expand
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import Template, choose
from yellowiron.stages import find_roles


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("wheel_loader")


@pytest.fixture(scope="module")
def drawn() -> Assembly:
    return loader(4, twin=True).assembly()


def sheet(**values: float) -> Specifications:
    names = {k.replace("_", " "): v for k, v in values.items()}
    return Specifications({n: Specification(n, v, "m", "ok") for n, v in names.items()})


def claimed(assembly: Assembly, unit: float) -> Assembly:
    """The model in a file that says its numbers are of that unit."""
    return replace(assembly, unit=unit)


def size(assembly: Assembly) -> float:
    points = np.concatenate([assembly.points_of(p) for p in assembly.parts])
    return float(np.ptp(points, axis=0).max())


def test_inches(template: Template, drawn: Assembly) -> None:
    length = 0.9 * size(drawn)
    model = to_scale(claimed(scaled(drawn, 1 / 0.0254), 1.0), template, sheet(Overall_Length=length))
    assert size(model) == pytest.approx(size(drawn), rel=1e-9)
    (finding,) = model.findings
    assert finding.code == "ALN014"
    assert "its numbers are inches" in finding.message
    before, after = (sum(a.shape_of(p).volume for p in a.parts) for a in (drawn, model))
    assert after == pytest.approx(before, rel=1e-9)


def test_millimetres_as_metres(template: Template, drawn: Assembly) -> None:
    model = to_scale(claimed(scaled(drawn, 1000.0), 1.0), template, sheet(Overall_Length=1.2 * size(drawn)))
    assert size(model) == pytest.approx(size(drawn), rel=1e-9)


def test_no_unit_at_all(template: Template, drawn: Assembly) -> None:
    """The hydraulic cylinders' diameters give the scale that the length only hints at."""
    found = align(drawn, template, Specifications())
    radii = {}
    for role in ("boom_piston_rod_l", "bucket_piston_rod", "steering_piston_rod_l"):
        bars = [p for p in found.parts if p.body == role]
        shapes = [drawn.shape_of(drawn.part(p.part)) for p in bars]
        longest = max((c for s in shapes for c in s.cylinders if not c.inner), key=lambda c: c.length)
        radii[role] = longest.radius
    values = sheet(
        Overall_Length=0.85 * size(drawn),
        Lift_Cylinder_Rod_Diameter=2 * radii["boom_piston_rod_l"],
        Tilt_Cylinder_Rod_Diameter=2 * radii["bucket_piston_rod"],
        Steering_Cylinder_Rod_Diameter=2 * radii["steering_piston_rod_l"],
    )
    model = to_scale(claimed(scaled(drawn, 7.3), 1.0), template, values)
    assert size(model) == pytest.approx(size(drawn), rel=0.01)
    assert "hydraulic cylinders" in model.findings[-1].message
    guess = to_scale(claimed(scaled(drawn, 7.3), 1.0), template, sheet(Overall_Length=size(drawn)))
    assert size(guess) == pytest.approx(size(drawn), rel=0.4)
    assert "a guess" in guess.findings[-1].message


def test_a_pose_is_no_unit(template: Template, drawn: Assembly) -> None:
    for length in (0.7 * size(drawn), 1.5 * size(drawn)):
        assert to_scale(drawn, template, sheet(Overall_Length=length)) is drawn
    assert to_scale(drawn, template, Specifications()) is drawn


def test_the_template_says_which_length(template: Template, drawn: Assembly) -> None:
    """Without a value that is the whole machine's length there is nothing to compare with."""
    plain = replace(template, wanted=tuple(replace(w, length_of=None) for w in template.wanted))
    long = sheet(Overall_Length=30 * size(drawn))
    assert to_scale(drawn, template, long) is not drawn
    assert to_scale(drawn, plain, long) is drawn


@pytest.mark.parametrize(("unit", "name"), [(1e-3, "millimetres"), (0.01, "centimetres"), (0.0254, "inches")])
def test_without_a_sheet_the_machine_tells_its_unit(
    template: Template, drawn: Assembly, unit: float, name: str
) -> None:
    """No loader is 8 km long."""
    model = to_scale(claimed(scaled(drawn, 1 / unit), 1.0), template, Specifications())
    assert size(model) == pytest.approx(size(drawn), rel=1e-9)
    (finding,) = model.findings
    assert finding.code == "ALN014"
    assert f"its numbers are taken for {name}" in finding.message


def test_a_toy_stays_a_toy_unless_nothing_tells_its_unit(template: Template, drawn: Assembly) -> None:
    toy = claimed(scaled(drawn, 0.05), 1e-3)
    assert to_scale(toy, template, Specifications()) is toy
    unknown = replace(toy, findings=(Finding("CAD009", "warning", "toy.stl", "The unit of length is not known"),))
    assert 3.0 < size(to_scale(unknown, template, Specifications())) < 25.0
    metres = claimed(scaled(drawn, 1e-3), 1e-3)  # of which each was written as a millimetre
    assert size(to_scale(metres, template, Specifications())) == pytest.approx(size(drawn), rel=1e-9)


def test_as_long_as_machines_are_is_left_alone(template: Template, drawn: Assembly) -> None:
    assert to_scale(drawn, template, Specifications()) is drawn


def without_a_unit(assembly: Assembly, numbers: float) -> Assembly:
    """The model as a file without a unit gives it, a metre written as so many `numbers`, these taken for metres."""
    remark = Finding("CAD009", "warning", "model.stl", "The format has no unit of length")
    return replace(scaled(assembly, numbers), unit=1.0, findings=(remark,))


@pytest.mark.parametrize(
    ("numbers", "name"),
    [(1e3, "millimetres"), (1e2, "centimetres"), (1 / 0.0254, "inches"), (1 / 0.3048, "feet")],
)
def test_what_machines_usually_measure_tells_the_unit(
    template: Template, drawn: Assembly, numbers: float, name: str
) -> None:
    """Of those that could be: 26 feet are 26 m, too, which a loader could just be."""
    model = to_scale(without_a_unit(drawn, numbers), template, Specifications())
    assert size(model) == pytest.approx(size(drawn), rel=1e-9)
    assert f"its numbers are taken for {name}" in model.findings[-1].message
    metres = without_a_unit(drawn, 1.0)
    assert to_scale(metres, template, Specifications()) is metres


def test_a_unit_that_was_applied_twice(template: Template, drawn: Assembly) -> None:
    for numbers, name in ((1e-3, "millimetres"), (1e-2, "centimetres")):
        model = to_scale(without_a_unit(drawn, numbers), template, Specifications())
        assert size(model) == pytest.approx(size(drawn), rel=1e-9)
        assert f"metres that were read as {name}" in model.findings[-1].message


def test_no_unit_explains_it(template: Template, drawn: Assembly) -> None:
    """A game's own units: as long as such machines usually are, which is said to be a guess."""
    model = to_scale(without_a_unit(drawn, 0.16), template, Specifications())
    assert 0.6 * size(drawn) < size(model) < 1.6 * size(drawn)
    assert "a guess" in model.findings[-1].message


def test_every_type_has_a_usual_length() -> None:
    """A dozer is long with its blade or without; a crane is as long as its boom."""
    for kind in list_templates():
        if is_sheet_only(kind):
            continue
        usual = [w.usual_length for w in load_template(kind).wanted if w.usual_length is not None]
        assert len(usual) == 1 and 2.0 < usual[0][0] < usual[0][1] < 80.0, kind


@pytest.mark.parametrize(("ratios", "factor"), [
    ((2.0, 2.1, 1.9, 2.3), 4.2**0.5),  # an artist's proportions
    ((0.6, 0.62, 0.58), 0.6),
    ((2.0, 2.1), None),  # two are too few
    ((1.1, 1.12, 1.15), None),  # a sister of the machine
    ((2.0, 1.0, 1.4, 0.8, 2.0), None),  # they do not agree
])  # fmt: skip
def test_lengths_that_agree_tell_the_size(
    ratios: tuple[float, ...], factor: float | None, template: Template, drawn: Assembly
) -> None:
    sizes = {f"length {k}": (1.5, 1.5 * ratio) for k, ratio in enumerate(ratios)}
    mesh = replace(drawn, shapes={key: replace(shape, exact=False) for key, shape in drawn.shapes.items()})
    found = other_size(mesh, sizes)
    if factor is None:
        assert found is None
        assert other_size(drawn, sizes) is None
        return
    assert found is not None
    assert found[0] == pytest.approx(factor, rel=1e-9)
    assert found[1].code == "ALN034"
    assert f"scaled by {factor:.3g}" in found[1].message
    exact = other_size(drawn, sizes)  # CAD is taken at its word
    assert exact is not None
    assert exact[0] == 1.0
    assert "scaled" not in exact[1].message


@pytest.mark.parametrize("exact", [True, False])
def test_exact_cad_is_recognised_once_and_as_the_sheet_has_it(
    exact: bool, drawn: Assembly, template: Template, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Only what is scaled by lengths that agree within a tenth hears no bores."""
    model = replace(drawn, shapes={key: replace(shape, exact=exact) for key, shape in drawn.shapes.items()})
    sheet_ = sheet(Overall_Width=3.0, Lift_Cylinder_Bore=0.16)
    heard = []

    def roles(assembly: Assembly, template: Template, told: Specifications, **_: object) -> tuple[Assembly, Alignment]:
        heard.append((round(size(assembly) / size(drawn), 6), told.number("Lift Cylinder Bore")))
        return assembly, Alignment("wheel_loader", np.eye(4), ())

    monkeypatch.setattr(stages, "_roles_in_one_unit", roles)
    monkeypatch.setattr(stages, "_sizes", lambda *_: dict.fromkeys("abc", (1.0, 2.0)))
    found, _ = find_roles(model, template, sheet_)
    assert heard == ([(1.0, 0.16)] if exact else [(1.0, 0.16), (2.0, None)])
    assert [f.code for f in found.findings] == ["ALN034"]


@pytest.mark.slow
def test_a_model_of_another_size_than_its_sheet_is_built_in_the_sheets() -> None:
    """Lengths that hang on no pose, measured on the sound machine, are the sheet of one that is drawn at two thirds."""
    given = scene("excavator", 3, "sound")
    excavator = load_template("excavator")
    assembly, found = find_roles(given.assembly, excavator, Specifications())
    chosen = expand(choose(excavator, found.choices), found.counts)
    names = {m.specification for m in excavator.measurements if not m.steps and m.unit == "m"}
    all_ok = Specifications({n: Specification(n, 1.0, "m", "ok") for n in names})
    mechanism = build_mechanism(assembly, chosen, found, all_ok, name="found")
    true = {n: model for n, (model, _) in kinematics.still_sizes(mechanism).items()}
    assert len(true) >= 5
    printed = Specifications({n: Specification(n, round(v, 2), "m", "ok") for n, v in true.items()})
    model, again = find_roles(scaled(given.assembly, 0.67), excavator, printed)
    assert size(model) == pytest.approx(size(assembly), rel=0.02)
    assert [f.code for f in model.findings if f.code == "ALN034"] == ["ALN034"]
    assert {p.part: p.body for p in again.parts} == {p.part: p.body for p in found.parts}
    same, _ = find_roles(given.assembly, excavator, printed)
    assert size(same) == size(assembly)
