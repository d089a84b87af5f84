"""The sheet's diameters as evidence, and a remark where the CAD model differs."""

from __future__ import annotations

import pytest

from kit.machines.synthetic import loader
from yellowiron.alignment import align
from yellowiron.library import load_template
from yellowiron.model.assembly import Assembly
from yellowiron.model.specification import Specification, Specifications
from yellowiron.model.template import Template


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("wheel_loader")


@pytest.fixture(scope="module")
def assembly() -> Assembly:
    return loader(1).assembly()


def sheet(**diameters: float) -> Specifications:
    names = {k.replace("_", " "): v for k, v in diameters.items()}
    return Specifications({n: Specification(n, v, "m", "ok") for n, v in names.items()})


def drawn_bore(assembly: Assembly, name: str) -> float:
    part = next(p for p in assembly.parts if p.name == name)
    return 2 * max(c.radius for c in assembly.shape_of(part).cylinders if c.inner)


def test_the_drawn_bore_is_no_remark(template: Template, assembly: Assembly) -> None:
    bore = drawn_bore(assembly, "tilt barrel")
    assert align(assembly, template, sheet(Tilt_Cylinder_Bore=bore)).findings == ()


def test_another_bore_is_a_remark(template: Template, assembly: Assembly) -> None:
    bore = 1.1 * drawn_bore(assembly, "tilt barrel")
    found = align(assembly, template, sheet(Tilt_Cylinder_Bore=bore))
    assert [(f.code, f.where) for f in found.findings] == [("ALN006", "bucket_cylinder_barrel")]
    assert found.missing == ()


def test_a_doubtful_value_is_not_used(template: Template, assembly: Assembly) -> None:
    doubtful = Specification("Tilt Cylinder Bore", 9.0, "m", "review")
    assert align(assembly, template, Specifications({"Tilt Cylinder Bore": doubtful})).findings == ()
