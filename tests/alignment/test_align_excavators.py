"""Small excavators of every kind the template knows: found with names and without, built, and checked."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from kit.machines.excavators import Features, any_features, excavator
from kit.machines.synthetic import Machine, disguise
from yellowiron import checks, kinematics, library, usd
from yellowiron.alignment import align
from yellowiron.library import load_template
from yellowiron.mechanism import build_mechanism
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.rows import expand
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template, choose

KINDS = {
    "twin": Features(),
    "single": Features("single", bearing="boss"),
    "one_mesh": Features("merged", tipping="welded"),
    "two_piece": Features(two_piece=True, bearing="spigot"),
    "blade": Features("single", blade=1, tipping="welded"),
    "wide_blade": Features(blade=2, two_piece=True, bearing="flat"),
    "coupler": Features(coupler=True, through=True),
    "track_pins": Features("single", track_pins=True, hoses=3),
    "swing": Features("single", swing=True, blade=1),
    "swing_alone": Features("single", swing=True, bearing="boss", tipping="welded"),
}
"""One machine of each kind; each optional role is in one of them."""
UNSEEN = range(3000, 3012)
"""Seeds that were not looked at while the aligner was written."""
NOTHING = Specifications()
ROWS = ("track_shoe", "track_roller", "carrier_roller", "sprocket", "idler")


@pytest.fixture(scope="module")
def template() -> Template:
    return load_template("excavator")


def wrong(found: Alignment, truth: dict[str, tuple[str, str]], template: Template) -> list[str]:
    """Parts with a wrong body, or a wrong role of a pin or a track; a shoe's number only says where the row begins, and
    a pin through both boom cylinders' rods plays either role."""
    pins = {r.name for r in template.roles if r.kind == "pin"}
    found_wrong = []
    for p in found.parts:
        role, body = truth[p.part]
        exact = p.role in pins or role in pins or role.startswith(ROWS)
        same = (p.role or "").replace("_r_pin", "_l_pin") == role if "rod_l_pin" in role else p.role == role
        if role.startswith("track_shoe"):
            same = (p.role or "").startswith(role.rpartition("_")[0])
        if body and (p.body != body or (exact and not same)):
            found_wrong.append(f"{p.part}: {p.role}/{p.body}, not {truth[p.part]}")
    return found_wrong


def couplers(found: Alignment) -> set[str]:
    return {p.part for p in found.parts if p.role == "quick_coupler"}


def build(assembly: Assembly, template: Template, found: Alignment, folder: Path) -> None:
    """From the alignment to checked USD, with the mobility that is expected."""
    chosen = choose(template, found.choices)
    for mobility in library.lint(chosen).mobility:
        assert mobility.computed == mobility.expected
    mechanism = build_mechanism(assembly, expand(chosen, found.counts), found, NOTHING, name="machine")
    mechanism = kinematics.complete(kinematics.calibrate(mechanism))
    assert [f for f in mechanism.findings if f.severity == "error"] == []
    usd.write_machine(mechanism, assembly, folder, name="machine", frame=found.frame)
    assert [f for f in checks.check(folder / "scene.usda") if f.severity == "error"] == []


def whole(found: Alignment, features: Features) -> None:
    assert {name: found.choices[name] for name in features.choices()} == features.choices()
    unplayed = {"boom_piston_rod_r_pin"} if features.through else set()
    assert set(found.missing) == unplayed
    torn = set(found.to_review) - unplayed  # a hose that touches two bodies alike may be listed
    assert unplayed <= set(found.to_review) and len(torn) <= features.hoses
    assert all(p.reason.startswith("touches") for p in found.parts if p.part in torn)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["two_piece", "wide_blade"])
def test_nameless(template: Template, kind: str) -> None:
    assembly, truth, frame = disguise(excavator(2, KINDS[kind]), 2)
    found = align(assembly, template, NOTHING)
    assert wrong(found, truth, template) == []
    whole(found, KINDS[kind])
    assert found.frame == pytest.approx(frame, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("named", [True, False], ids=["named", "nameless"])
@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_builds(template: Template, tmp_path: Path, kind: str, named: bool) -> None:
    """The machine that is built is the same with names and without."""
    assembly, truth, _ = disguise(excavator(1, KINDS[kind]), 1, names=named, rotate=not named, shuffle=not named)
    found = align(assembly, template, NOTHING)
    assert wrong(found, truth, template) == []
    assert couplers(found) == {part for part, (role, _) in truth.items() if role == "quick_coupler"}
    whole(found, KINDS[kind])
    if not named:
        build(assembly, template, found, tmp_path)


@pytest.mark.slow
def test_a_coupler_by_name(template: Template) -> None:
    """What its name says is not looked for again."""
    machine: Machine = excavator(1, KINDS["coupler"])
    for k, part in enumerate(machine.parts):
        if machine.truth[part.id][0] == "quick_coupler":
            machine.parts[k] = part.__class__(part.id, "Quick Coupler", part.path, part.shape, part.transform)
    found = align(machine.assembly(), template, NOTHING)
    assert couplers(found) == {part for part, (role, _) in machine.truth.items() if role == "quick_coupler"}


@pytest.mark.slow
@pytest.mark.parametrize("seed", UNSEEN)
def test_unseen(template: Template, seed: int) -> None:
    assembly, truth, frame = disguise(excavator(seed, embedded=seed % 2 == 0), seed)
    found = align(assembly, template, NOTHING)
    assert couplers(found) == {part for part, (role, _) in truth.items() if role == "quick_coupler"}
    silent = [w for w in wrong(found, truth, template) if w.split(":")[0] not in found.to_review]
    assert len(silent) <= (any_features(seed).hoses > 0)  # a floating part may follow the hose that touches it
    assert found.choices["blade"] == any_features(seed).choices()["blade"]
    assert np.abs(found.frame - frame).max() < 1e-9


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "blade"), [(3000, 1), (3001, 0), (3002, 2)])
def test_unseen_swing_booms(template: Template, seed: int, blade: int) -> None:
    features = Features("single", swing=True, blade=blade)
    assembly, truth, frame = disguise(excavator(seed, features), seed)
    found = align(assembly, template, NOTHING)
    assert wrong(found, truth, template) == []
    whole(found, features)
    assert np.abs(found.frame - frame).max() < 1e-9
