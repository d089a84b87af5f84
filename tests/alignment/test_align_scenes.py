"""Which of what is drawn is the machine: one of several in a scene, one of loose blocks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from kit.machines.defects import drawn
from kit.machines.solids import box, tube
from kit.machines.synthetic import Machine
from yellowiron.alignment import align
from yellowiron.alignment.assignment import unit_scale
from yellowiron.alignment.features.separate_parts import separate_parts
from yellowiron.alignment.machines import apart_from, with_floating
from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.library import load_template
from yellowiron.model.assembly import Assembly
from yellowiron.model.geometry import Floats, Mesh
from yellowiron.model.specification import Specifications

UP = np.array([0.0, 0.0, 1.0])


def _placed(machine: Machine, node: str, move: Floats, scale: float = 1.0) -> Iterator[Occurrence]:
    """Its parts under a node, nameless, beside the origin."""
    assembly = machine.assembly()
    for k, part in enumerate(assembly.parts):
        mesh = Mesh(scale * assembly.points_of(part) + move, assembly.shape_of(part).mesh.triangles)
        yield Occurrence(f"Object_{k}", (node,), mesh, np.eye(4))


def _scene(first: str, second: str) -> tuple[Assembly, int]:
    """An excavator, and half as large again a loader beside it; how many parts the excavator has."""
    digger, loader = drawn("excavator", 3), drawn("loader", 3)
    items = [*_placed(digger, first, np.zeros(3)), *_placed(loader, second, np.array([0.0, 15.0, 0.0]), 1.5)]
    return assemble(items, name="scene", format="synthetic", unit=1.0, path="scene.glb"), len(digger.parts)


@pytest.mark.parametrize("first", ["Excavator_01", "minibagger.003"])
def test_of_several_machines_the_one_that_is_called_so_is_read(first: str) -> None:
    scene, count = _scene(first, "Vehicle_02")
    apart = separate_parts(scene)
    assert sum(p.path == (first,) for p in scene.parts if p.id in apart) == count, "nearness takes the larger one"
    called = apart_from(scene, load_template("excavator"))
    assert {p.path[0] for p in scene.parts if p.id in called} == {"Vehicle_02"}
    assert min(called.values()) > 1.0


@pytest.mark.parametrize("names", [("Vehicle_01", "Vehicle_02"), ("Excavator_01", "Excavator_02")])
def test_names_that_do_not_tell_leave_it_to_nearness(names: tuple[str, str]) -> None:
    scene, _ = _scene(*names)
    assert apart_from(scene, load_template("excavator")) == separate_parts(scene)


def test_a_part_that_a_person_gave_a_role_is_the_machines_whatever_is_called_so() -> None:
    scene, _ = _scene("Excavator_01", "Vehicle_02")
    said = frozenset({next(p.id for p in scene.parts if p.path == ("Vehicle_02",))})
    assert apart_from(scene, load_template("excavator"), said).keys() == separate_parts(scene).keys()


def test_of_several_machines_the_one_that_is_called_so_is_aligned_and_measured() -> None:
    """The larger one had been read, whatever was asked for, and the model put in another unit by its length."""
    small, large = _blocks(floating=0.0), drawn("loader", 3)
    items = [*_placed(small, "Telehandler", np.zeros(3)), *_placed(large, "Vehicle", np.array([0.0, 20.0, 0.0]), 2.0)]
    scene = assemble(items, name="scene", format="synthetic", unit=1.0, path="scene.glb")
    template = load_template("telehandler")
    found = {p.part: p.body for p in align(scene, template, Specifications()).parts}
    bodies = {node: {found[p.id] for p in scene.parts if p.path == (node,)} for node in ("Telehandler", "Vehicle")}
    assert bodies["Vehicle"] == {None}
    assert unit_scale._extent(scene, template) < 8.0
    assert {"chassis", "carriage", "front_wheel_l"} <= bodies["Telehandler"]


def _blocks(*, floating: float) -> Machine:
    """A telehandler of nine blocks, metres: its boom and its carriage float over the rest."""
    found = Machine(twin=False)
    blocks = (
        ("chassis", (3.5, 0.9, 0.5), (0.0, 0.0, 0.8)),
        ("engine", (1.2, 0.8, 1.2), (-0.9, 0.0, 1.7)),
        ("cab", (1.0, 0.7, 1.0), (0.6, 0.0, 1.6)),
        ("boom", (3.2, 0.25, 0.45), (2.6, 0.0, 2.4 + floating)),
        ("carriage", (0.6, 0.6, 1.1), (4.2, 0.0, 2.0 + floating)),
    )
    for name, size, at in blocks:
        place = np.eye(4)
        place[:3, 3] = at
        found.add(name, "", name, box(name, *size), place)
    for x in (-1.2, 1.2):
        for y in (-0.70, 0.45):
            place = np.array([[1.0, 0, 0, x], [0, 0, 1.0, y], [0, -1.0, 0, 0.45], [0, 0, 0, 1.0]])
            found.add(f"wheel{x}{y}", "", "wheel", tube(f"wheel{x}{y}", 0.45, 0.0, 0.25), place)
    return found


def _nameless(machine: Machine) -> Assembly:
    items = list(_placed(machine, "world", np.zeros(3)))
    return assemble(items, name="blocks", format="synthetic", unit=1.0, path="blocks.glb")


def test_what_floats_far_from_a_machine_of_blocks_is_its_own() -> None:
    """A public telehandler of nine blocks: 48 % of the surface were left out as other objects; 52 → 100 %, 0 → 4 of 4
    joints."""
    machine = _blocks(floating=0.6)
    model = _nameless(machine)
    apart = separate_parts(model)
    assert len(apart) == 2
    assert with_floating(model, apart, UP) == {}
    found = {p.part: p.body for p in align(model, load_template("telehandler"), Specifications()).parts}
    drawn_as = [machine.truth[p.id][1] for p in machine.parts]
    bodies = {name: found[p.id] for p, name in zip(model.parts, drawn_as, strict=True)}
    assert bodies["cab"] == bodies["chassis"] == "chassis"
    assert bodies["boom"] in ("boom", "inner_boom")
    assert bodies["carriage"] == "carriage"


def test_what_stands_as_low_as_the_machine_is_another_one() -> None:
    machine = _blocks(floating=0.0)
    place = np.eye(4)
    place[:3, 3] = [0.0, 4.0, 0.5]
    machine.add("pallet", "", "", box("pallet", 1.2, 0.8, 1.0), place)
    model = _nameless(machine)
    apart = separate_parts(model)
    assert len(apart) == 1
    assert with_floating(model, apart, UP) is None
