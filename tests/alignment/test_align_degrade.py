"""Poor CAD: what is certain is kept, what is missing is named, nothing crashes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from kit.machines.defects import spoiled
from kit.machines.solids import bolt, box, place
from kit.machines.synthetic import Machine, disguise, loader
from yellowiron.alignment import align
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly, Part
from yellowiron.model.errors import AlignmentError
from yellowiron.model.geometry import Mesh
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Role, Template, choose

NOTHING = Specifications()


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("wheel_loader")


def without(machine: Machine, *roles: str) -> Machine:
    """The machine without the parts of some roles or bodies."""
    machine.parts[:] = [p for p in machine.parts if not set(machine.truth[p.id]) & set(roles)]
    return machine


def right(found: Alignment, truth: dict[str, tuple[str, str]]) -> float:
    return float(np.mean([p.body == truth[p.part][1] for p in found.parts]))


def test_no_wheels(template: Template) -> None:
    sides = [f"{e}_{s}" for e in ("front_wheel", "rear_wheel") for s in "lr"]
    assembly, truth, _ = disguise(without(loader(0, steered=False), *sides), 0, rotate=False)
    found = align(assembly, template, NOTHING)
    assert set(sides) <= set(found.missing)
    assert {f.where for f in found.findings if f.code == "ALN001"} >= set(sides)
    assert right(found, truth) > 0.95


@pytest.mark.slow
def test_no_steering_cylinders(template: Template) -> None:
    gone = [f"steering_{p}_{s}" for p in ("cylinder_barrel", "piston_rod") for s in "lr"]
    assembly, truth, _ = disguise(without(loader(1), *gone), 1)
    found = align(assembly, template, NOTHING)
    assert set(gone) <= set(found.missing)
    assert right(found, truth) > 0.95


def test_one_pin_gone(template: Template) -> None:
    assembly, truth, _ = disguise(without(loader(1), "bucket_link_pin"), 1)
    found = align(assembly, template, NOTHING)
    assert "bucket_link_pin" in found.missing
    assert right(found, truth) > 0.9


@pytest.mark.slow
@pytest.mark.parametrize("embedded", [False, True])
def test_no_pins_at_all(template: Template, embedded: bool) -> None:
    """Bores side by side on one axis are hinges too; the pins are named as missing."""
    pins = [r.name for r in template.roles if r.kind == "pin"]
    assembly, truth, _ = disguise(without(loader(3, embedded=embedded), *pins), 3)
    found = align(assembly, template, NOTHING)
    assert right(found, truth) == 1.0
    assert set(found.missing) == {p for p in pins if p in {r.name for r in choose(template, found.choices).roles}}
    assert sum(f.code == "ALN002" for f in found.findings) >= 14


@pytest.mark.slow
def test_triangles_alone(template: Template) -> None:
    machine = loader(2)
    machine.shapes = {k: replace(s, cylinders=(), planes=()) for k, s in machine.shapes.items()}
    assembly, _, _ = disguise(machine, 2)
    found = align(assembly, template, NOTHING)
    assert len(found.parts) == len(assembly.parts)
    assert found.missing


def test_a_part_without_a_mesh(template: Template) -> None:
    machine = loader(2)
    empty = replace(
        next(iter(machine.shapes.values())), key="empty", mesh=Mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int32))
    )
    machine.shapes["empty"] = empty
    machine.parts.append(Part("LOADER/nothing", "nothing", ("LOADER",), "empty", np.eye(4)))
    found = align(machine.assembly(), template, NOTHING)
    last = found.parts[-1]
    assert (last.part, last.role, last.body) == ("LOADER/nothing", None, None)
    assert "LOADER/nothing" in found.to_review


def test_no_parts(template: Template) -> None:
    with pytest.raises(AlignmentError, match="no parts"):
        align(Assembly("empty", "synthetic", 1.0, (), {}), template, NOTHING)


def test_unknown_choice(template: Template) -> None:
    with pytest.raises(AlignmentError, match="no choice"):
        align(loader(0).assembly(), template, NOTHING, choices={"lift_cylinders": "triple"})


def test_a_bucket_by_its_names() -> None:
    """The conference paper's bucket: no joints, no wheels; parts bear the names of the template's roles."""
    names = ["bucket body", *(f"bucket bolt{k}" for k in range(1, 7))]
    roles = (Role("bucket", None, True), *(Role(n, "bucket", False) for n in names))
    template = Template("bucket", "", "bucket", roles, ())
    body, screw = box("body", 1.0, 0.6, 0.05), bolt("screw", 0.01, 0.03)
    parts = [Part(f"BUCKET/{names[0]}", names[0], ("BUCKET",), "body", np.eye(4))]
    for k, name in enumerate(names[1:]):
        parts.append(Part(f"BUCKET/{name}", name, ("BUCKET",), "screw", place((0.1 * k, 0, 0.025), (0, 0, 1))))
    assembly = Assembly("bucket", "synthetic", 1.0, tuple(parts), {"body": body, "screw": screw})
    found = align(assembly, template, NOTHING)
    assert {p.part.split("/")[1]: (p.role, p.body) for p in found.parts} == {n: (n, "bucket") for n in names}
    assert found.to_review == ()
    assert (found.frame == np.eye(4)).all()
    assert [f.code for f in found.findings] == ["ALN003"]


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "library"), [("loader", "wheel_loader"), ("excavator", "excavator")])
def test_neither_pins_nor_holes(kind: str, library: str) -> None:
    """Pivots are where parts have round ends side by side; the pins are named as missing."""
    assembly, truth, _ = disguise(spoiled(kind, 4, "visual"), 4)
    found = align(assembly, load_template(library), NOTHING)
    drawn = [p for p in found.parts if truth[p.part][1]]
    assert all(p.body == truth[p.part][1] for p in drawn)
    assert all(role.endswith(("_pin", "_bearing")) for role in found.missing)
    assert len(found.to_review) - len(found.missing) <= 0.02 * len(drawn)
