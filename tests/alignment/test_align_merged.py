"""Machines whose files hold triangles alone, written as they come: parts in one soup, one mesh for all, one a body."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from kit.cadfiles.meshes import lumps
from kit.machines.defects import drawn
from kit.machines.excavators import excavator
from kit.machines.synthetic import Machine, disguise, loader
from yellowiron import stages
from yellowiron.alignment import align, write_alignment
from yellowiron.cad.mesh.assembly import Occurrence, assemble
from yellowiron.library import load_template
from yellowiron.model.alignment import Alignment, Decisions, Signature
from yellowiron.model.assembly import Assembly
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Mesh
from yellowiron.model.specification import Specifications
from yellowiron.stages import find_roles


def meshed(assembly: Assembly, groups: list[list[str]]) -> Assembly:
    """The triangles of an assembly, the parts of a group in one mesh, their surfaces forgotten."""
    found = [
        Occurrence(name, (), Mesh(points, triangles), np.eye(4)) for name, points, triangles in lumps(assembly, groups)
    ]
    return assemble(found, name="machine", format="GLB", unit=1.0, path="machine.glb")


def owners(original: Assembly, found: Assembly) -> dict[str, str]:
    """Part id of `found` → the one of `original` whose box is nearest to its own."""
    boxes = np.array(
        [np.concatenate([f(original.points_of(p), axis=0) for f in (np.min, np.max)]) for p in original.parts]
    )
    result = {}
    for part in found.parts:
        box = np.concatenate([f(found.points_of(part), axis=0) for f in (np.min, np.max)])
        result[part.id] = original.parts[int(np.abs(boxes - box).sum(axis=1).argmin())].id
    return result


def wrong(machine: Machine, kind: str, merged: str, seed: int) -> list[str]:
    assembly, truth, _ = disguise(machine, seed)
    groups: dict[str, list[str]] = {}
    for number, part in enumerate(assembly.parts):
        key = {"part": str(number), "body": truth[part.id][1], "one": ""}[merged]
        groups.setdefault(key, []).append(part.id)
    found, alignment = find_roles(meshed(assembly, list(groups.values())), load_template(kind), Specifications())
    owner = owners(assembly, found)
    assert set(alignment.missing) <= set(align(assembly, load_template(kind), Specifications()).missing)
    silent = [p for p in alignment.parts if p.part not in alignment.to_review]
    bodies = [(p.part, p.body, truth[owner[p.part]][1]) for p in silent if truth[owner[p.part]][1]]
    assert len(bodies) > 0.98 * len(assembly.parts)
    return [f"{part}: {body}, not {true}" for part, body, true in bodies if body != true]


@pytest.mark.slow
@pytest.mark.parametrize("merged", ["one", "body"])
def test_loader_merged(merged: str) -> None:
    assert wrong(loader(1001), "wheel_loader", merged, 1001) == []


@pytest.mark.slow
def test_decisions_on_parts_of_a_model_that_was_taken_apart_hold(tmp_path: Path) -> None:
    """The file's parts are the model's, though one that is read anew has a single part."""
    machine, template, file = loader(1001), load_template("wheel_loader"), tmp_path / "alignment.json"
    assembly, _, _ = disguise(machine, 1001)
    merged = meshed(assembly, [[part.id for part in assembly.parts]])
    found, alignment = find_roles(merged, template, Specifications())
    assert len(found.parts) > 1 == len(merged.parts)
    write_alignment(alignment, found, file)
    boom = next(p.part for p in alignment.parts if p.body == "boom")
    signature = Signature("Ada", "2026-11-26", "seen")
    yes = Decisions((), (boom,), (), signature)
    model, confirmed = find_roles(merged, template, Specifications(), earlier=file, decisions=yes)
    assert [part.id for part in model.parts] == [part.id for part in found.parts]
    assert {p.part: p.signature for p in confirmed.parts if p.source == "confirmed"} == {boom: signature}
    # What was said stays said when the same model is read again.
    write_alignment(confirmed, model, file)
    _, again = find_roles(merged, template, Specifications(), earlier=file)
    assert [p.part for p in again.parts if p.source == "confirmed"] == [boom]
    assert not [f for f in again.findings if f.rule in ("ALN012", "ALN013")]


@pytest.mark.slow
@pytest.mark.parametrize(("merged", "seed"), [("part", 1002), ("one", 1005), ("body", 1002)])
def test_excavators_merged(merged: str, seed: int) -> None:
    assert wrong(excavator(seed), "excavator", merged, seed) == []


@pytest.mark.slow
def test_cylinders_drawn_into_their_arms_are_taken_out() -> None:
    """An artist's mesh for what stands on one pin: the boom with its cylinders and the arm's, the arm with the
    bucket's."""
    assembly, truth, _ = disguise(excavator(1003), 1003)
    groups: dict[str, list[str]] = {}
    for part in assembly.parts:
        body = truth[part.id][1]
        carrier = {"boom_": "boom", "arm_c": "boom", "arm_p": "boom", "bucket_c": "arm", "bucket_p": "arm"}
        groups.setdefault(next((c for start, c in carrier.items() if body.startswith(start)), body), []).append(part.id)
    merged = meshed(assembly, list(groups.values()))
    found, alignment = find_roles(merged, load_template("excavator"), Specifications())
    # Their barrels and rods are parts, and little else is.
    assert len(merged.parts) + 6 <= len(found.parts) < 3 * len(merged.parts)
    owner = owners(assembly, found)
    halves = {"arm_cylinder_barrel", "arm_piston_rod", "bucket_cylinder_barrel", "bucket_piston_rod"}
    assert halves <= {p.body for p in alignment.parts}
    told = [(p.body, truth[owner[p.part]][1]) for p in alignment.parts if truth[owner[p.part]][1]]
    assert all(body == true for body, true in told if body in halves or true in halves), told


@pytest.mark.slow
def test_bodies_without_pins_are_not_taken_apart() -> None:
    """Nothing is gained by it: their roles are missing all the same."""
    machine = loader(1002)
    pins = {role for role, _ in machine.truth.values() if role.endswith("_pin") or "cylinder" in role or "rod" in role}
    machine.parts[:] = [p for p in machine.parts if not set(machine.truth[p.id]) & pins]
    assembly, truth, _ = disguise(machine, 1002)
    groups: dict[str, list[str]] = {}
    for part in assembly.parts:
        groups.setdefault(truth[part.id][1], []).append(part.id)
    merged = meshed(assembly, list(groups.values()))
    found, alignment = find_roles(merged, load_template("wheel_loader"), Specifications())
    assert alignment.missing
    assert found is merged


@pytest.mark.slow
def test_a_mesh_a_material_is_taken_apart_without_pins_too() -> None:
    """Taking it apart finds its bodies; the roles of pins are missing all the same, and so is half of all roles."""
    machine = excavator(1003)
    pins = {role for role, _ in machine.truth.values() if role.endswith("_pin")}
    machine.parts[:] = [p for p in machine.parts if machine.truth[p.id][0] not in pins]
    assembly, truth, _ = disguise(machine, 1003)
    groups: dict[int, list[str]] = {}
    for number, part in enumerate(assembly.parts):
        groups.setdefault(number % 6, []).append(part.id)
    template = load_template("excavator")
    found, alignment = find_roles(meshed(assembly, list(groups.values())), template, Specifications())
    assert len(found.parts) > 10 * len(groups)
    missing = {role.name for role in template.roles if role.rigid and role.name in alignment.missing}
    assert missing <= {template.root}
    owner = owners(assembly, found)
    right = [p.body == truth[owner[p.part]][1] for p in alignment.parts if truth[owner[p.part]][1]]
    assert sum(right) > 0.97 * len(right)


@pytest.fixture(scope="module")
def third() -> tuple[Assembly, Alignment]:
    """An excavator as it is drawn, and its roles."""
    machine = drawn("excavator", 3).assembly()
    return machine, align(machine, load_template("excavator"), Specifications())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("whole", "apart", "taken"),
    [
        # More than half of what is missing is found.
        (("boom", "arm", "bucket", "boom_pin"), ("boom",), True),
        # As many bodies, but pins are lost for them.
        (("boom", "arm", "bucket", "boom_pin"), ("arm_pin", "bucket_pin", "boom_pin"), False),
        # No more than half, but a limb, for which no pin is lost.
        (("boom", "arm", "bucket", "boom_pin"), ("boom", "arm", "boom_pin"), True),
        # A frame is no limb: crumbs of a machine drawn in one piece were taken for its other frame.
        (("boom", "upperstructure", "boom_pin"), ("boom", "boom_pin"), False),
    ],
)
def test_a_merged_mesh_is_taken_apart_where_that_finds_most_of_what_is_missing(
    whole: tuple[str, ...],
    apart: tuple[str, ...],
    taken: bool,
    third: tuple[Assembly, Alignment],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    machine, found = third
    pieces = replace(machine, name="pieces")
    template = load_template("excavator")

    def told(model: Assembly, *_: object, **__: object) -> Alignment:
        return replace(found, missing=apart if model is pieces else whole)

    monkeypatch.setattr(stages, "_roles_of_whole", told)
    monkeypatch.setattr(stages, "kept", lambda *_: pieces)
    model, _ = stages.find_roles(machine, template, Specifications())
    assert (model is pieces) is taken


@pytest.mark.slow
@pytest.mark.parametrize(("found_too", "taken"), [((), False), (("arm",), True)])
def test_a_variant_with_fewer_limbs_finds_none(
    found_too: tuple[str, ...], taken: bool, third: tuple[Assembly, Alignment], monkeypatch: pytest.MonkeyPatch
) -> None:
    """As drawn it is read as of two booms, of which one is missing, in pieces as of one: that is no limb found."""
    machine, found = third
    pieces = replace(machine, name="pieces")
    template = load_template("excavator")
    missing = ("arm", "boom_pin", "arm_pin")

    def told(model: Assembly, *_: object, **__: object) -> Alignment:
        if model is pieces:
            left = ("adjust_boom", *(name for name in missing if name not in found_too))
            return replace(found, choices={**found.choices, "boom_type": "mono"}, missing=left)
        return replace(found, choices={**found.choices, "boom_type": "two_piece"}, missing=(*missing, "adjust_boom"))

    monkeypatch.setattr(stages, "_roles_of_whole", told)
    monkeypatch.setattr(stages, "kept", lambda *_: pieces)
    model, _ = stages.find_roles(machine, template, Specifications())
    assert (model is pieces) is taken


@pytest.mark.slow
@pytest.mark.parametrize(
    ("contradicted_before", "few", "taken"), [(False, False, False), (True, False, True), (False, True, True)]
)
def test_pieces_that_the_names_contradict_are_no_better_reading(
    contradicted_before: bool,
    few: bool,
    taken: bool,
    third: tuple[Assembly, Alignment],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The names agree with the meshes, and not with what is made of their crumbs, which play more roles; where few
    bodies are meshes of their own, names tell nothing."""
    machine, found = third
    pieces = replace(machine, name="pieces")
    template = load_template("excavator")
    found = replace(found, findings=())
    bodies = tuple(sorted({str(part.body) for part in found.parts} - {template.root}))
    contrary = (Finding("ALN015", "info", "excavator", "The parts' names contradict the joints", "Check the names."),)

    def told(model: Assembly, *_: object, **__: object) -> Alignment:
        if model is pieces:
            return replace(found, missing=("boom",), findings=contrary)
        missing = bodies if few else ("boom", "arm", "bucket", "boom_pin")
        return replace(found, missing=missing, findings=contrary if contradicted_before else ())

    monkeypatch.setattr(stages, "_roles_of_whole", told)
    monkeypatch.setattr(stages, "kept", lambda *_: pieces)
    model, _ = stages.find_roles(machine, template, Specifications())
    assert (model is pieces) is taken
