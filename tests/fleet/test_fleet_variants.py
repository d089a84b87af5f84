"""Variants: drawn the same by the same seed, written small over one base, and each a machine that checks and moves."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

from kit.builds import console
from kit.machines import small_machine
from yellowiron.checks import check
from yellowiron.fleet import schema, vary
from yellowiron.fleet.documents import UnusableError
from yellowiron.fleet.variants.changes import changed
from yellowiron.fleet.variants.parameters import DIRECTION, QUANTITIES, read_parameters
from yellowiron.fleet.variants.sampling import drawn, draws_of
from yellowiron.fleet.variants.solving import Basis, RefusedError
from yellowiron.kinematics import ClosedChain, complete
from yellowiron.model.mechanism import Mechanism
from yellowiron.usd import read_mechanism

ALL: dict[str, Any] = {
    "mass": {"vary": "mass", "of": "*", "each": True, "factor": {"normal": [1, 0.03], "within": [0.9, 1.1]}},
    "centre": {"vary": "center_of_mass", "of": "boom", "axis": "z", "offset": {"uniform": ["-20 mm", "20 mm"]}},
    "grip": {"vary": "friction", "of": "rubber", "factor": {"uniform": [0.6, 1.1]}},
    "gain": {"vary": "stiffness", "of": "boom", "factor": {"loguniform": [0.7, 1.0]}},
    "pressure": {"vary": "pressure", "of": "boom", "factor": {"uniform": [0.9, 1.1]}},
    "flow": {"vary": "flow", "of": "boom", "factor": {"uniform": [0.8, 1.1]}},
    "bore": {"vary": "bore", "offset": {"uniform": ["-0.2 mm", "0.2 mm"]}},
    "stroke": {"vary": "stroke", "offset": {"uniform": ["-4 mm", "4 mm"]}},
    "play": {"vary": "pin_play", "value": {"uniform": [0, "0.2 mm"]}},
    "load": {"vary": "payload", "value": {"uniform": [0, "500 kg"]}},
    "tyre": {"vary": "tyre_radius", "factor": {"uniform": [0.98, 1.02]}},
    "lug": {"vary": "pin", "of": "rod_joint", "axis": "z", "offset": {"uniform": ["-3 mm", "3 mm"]}},
    "boom": {
        "vary": "length",
        "of": "boom",
        "from": "boom_joint",
        "to": "rod_joint",
        "factor": {"uniform": [0.99, 1.01]},
    },
    "tool": {
        "vary": "tool",
        "of": "boom",
        "value": {"choice": ["drawn", "light"]},
        "tools": {"light": {"mass": "800 kg"}},
    },
}


@pytest.fixture(scope="module")
def machine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The small loader, with drives whose gains are worked out."""
    from dataclasses import replace

    from yellowiron.model.mechanism import PROVISIONAL
    from yellowiron.usd import write_machine

    folder = tmp_path_factory.mktemp("machine")
    made, assembly = small_machine.make()
    joints = tuple(
        replace(j, drive=replace(j.drive, source=PROVISIONAL)) if j.name == "slide" and j.drive is not None else j
        for j in made.joints
    )
    write_machine(complete(replace(made, joints=joints)), assembly, folder, name=made.name)
    return folder / f"{made.name}.usda"


def parameters(folder: Path, said: dict[str, Any]) -> Path:
    path = folder / "variants.json"
    path.write_text(json.dumps({"parameters": said}))
    return path


def table(folder: Path) -> list[dict[str, str]]:
    return list(csv.DictReader((folder / "variants.csv").read_text().splitlines()))


def files(folder: Path) -> dict[str, bytes]:
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def test_the_same_seed_gives_the_same_bytes_and_another_others(machine: Path, tmp_path: Path) -> None:
    said = parameters(tmp_path, ALL)
    made = vary(machine, said, tmp_path / "a", count=6, seed=3, jobs=1)
    assert made.count == 6
    vary(machine, said, tmp_path / "b", count=6, seed=3, jobs=1)
    assert files(tmp_path / "a") == files(tmp_path / "b")
    vary(machine, said, tmp_path / "c", count=6, seed=4, jobs=1)
    assert table(tmp_path / "c")[0]["grip"] != table(tmp_path / "a")[0]["grip"]
    assert max((tmp_path / "a" / file).stat().st_size for file in made.files) < 20_000


def test_another_parameter_or_a_larger_count_changes_no_value(machine: Path, tmp_path: Path) -> None:
    mechanism = read_mechanism(machine)
    some = {name: ALL[name] for name in ("mass", "play")}
    few = draws_of(read_parameters(parameters(tmp_path, some)), mechanism)
    all_of_them = draws_of(read_parameters(parameters(tmp_path, ALL)), mechanism)
    before = {d.column: v for d, v in zip(few, drawn(few, seed=1, count=5), strict=True)}
    after = {d.column: v for d, v in zip(all_of_them, drawn(all_of_them, seed=1, count=50), strict=True)}
    assert all(np.array_equal(after[column][:5], values) for column, values in before.items())


def test_draws_are_spread_as_they_are_said(machine: Path, tmp_path: Path) -> None:
    said = {
        "u": {"vary": "flow", "factor": {"uniform": [0.5, 1.5]}},
        "n": {"vary": "pressure", "factor": {"normal": [1, 0.1], "within": [0.9, 1.2]}},
        "l": {"vary": "stiffness", "factor": {"loguniform": [0.1, 10]}},
        "c": {"vary": "damping", "factor": {"choice": [1, 2, 4]}},
        "f": {"vary": "mass", "factor": 1.5},
    }
    draws = draws_of(read_parameters(parameters(tmp_path, said)), read_mechanism(machine))
    u, n, log, c, f = drawn(draws, seed=0, count=20_000)
    assert u.min() >= 0.5 and u.max() <= 1.5 and abs(u.mean() - 1.0) < 0.01
    assert n.min() >= 0.9 and n.max() <= 1.2
    assert abs(np.log10(log).mean()) < 0.02
    assert {value: round(float((c == value).mean()), 1) for value in (1.0, 2.0, 4.0)} == {1.0: 0.3, 2.0: 0.3, 4.0: 0.3}
    assert (f == 1.5).all()


def test_a_variant_is_read_back_as_it_was_solved_and_checks_find_nothing(machine: Path, tmp_path: Path) -> None:
    said = parameters(tmp_path, ALL)
    made = vary(machine, said, tmp_path / "out", count=3, seed=1, jobs=1)
    base = read_mechanism(machine)
    draws = draws_of(read_parameters(said), base)
    rows = drawn(draws, seed=1, count=max(int(Path(f).stem) for f in made.files) + 1)
    from yellowiron.fleet.variants.tools import read_tools

    tools = read_tools(read_parameters(said), base, said)
    basis = Basis(base)
    before = {(f.code, f.where.rpartition(".")[0] or f.where) for f in check(machine)}
    for file in made.files:
        number = int(Path(file).stem)
        wanted = basis.solved(changed(base, draws, [float(v[number]) for v in rows], tools))
        found = read_mechanism(tmp_path / "out" / file)
        _same(found, wanted)
        told = {(f.code, f.where.rpartition(".")[0] or f.where) for f in check(tmp_path / "out" / file)}
        assert {code for code, _ in told} <= {code for code, _ in before}


def _same(found: Mechanism, wanted: Mechanism) -> None:
    assert [b.name for b in found.bodies] == [b.name for b in wanted.bodies]
    assert [j.name for j in found.joints] == [j.name for j in wanted.joints]
    for one, other in zip(found.bodies, wanted.bodies, strict=True):
        assert one.mass == pytest.approx(other.mass, rel=1e-6)
        assert one.center_of_mass == pytest.approx(other.center_of_mass, abs=1e-6)
        assert np.allclose(one.inertia, other.inertia, rtol=1e-5, atol=1e-6 * np.abs(other.inertia).max())
    for this, that in zip(found.joints, wanted.joints, strict=True):
        assert this.anchor == pytest.approx(that.anchor, abs=1e-9)
        for end in ("lower", "upper"):
            assert getattr(this, end) == pytest.approx(getattr(that, end), abs=1e-7)
        if that.drive is not None and this.drive is not None:
            assert this.drive.stiffness == pytest.approx(that.drive.stiffness, rel=1e-6)
            assert this.drive.forces == pytest.approx(that.drive.forces, rel=1e-6)
            assert this.drive.speeds == pytest.approx(that.drive.speeds, rel=1e-6)
    assert found.materials == wanted.materials
    assert [(c.bore, c.stroke) for c in found.cylinders] == [(c.bore, c.stroke) for c in wanted.cylinders]


def test_what_is_the_base_s_stays_to_the_last_bit(machine: Path) -> None:
    base = read_mechanism(machine)
    same = Basis(base).solved(changed(base, (), (), {}))
    for one, other in zip(same.joints, base.joints, strict=True):
        assert (one.lower, one.upper, one.anchor) == (other.lower, other.upper, other.anchor)
        if one.drive is not None and other.drive is not None:
            assert one.drive.stiffness == pytest.approx(other.drive.stiffness, rel=1e-9)
            assert one.drive.damping == pytest.approx(other.drive.damping, rel=1e-9)


def test_forces_follow_from_bores_and_pressure_and_speeds_from_flow(machine: Path, tmp_path: Path) -> None:
    base = read_mechanism(machine)
    said = {
        "bore": {"vary": "bore", "factor": 1.1},
        "pressure": {"vary": "pressure", "of": "boom", "factor": 0.9},
        "flow": {"vary": "flow", "of": "boom", "factor": 0.8},
    }
    draws = draws_of(read_parameters(parameters(tmp_path, said)), base)
    work = changed(base, draws, [1.1, 0.9, 0.8], {})
    before, after = base.joint("slide").drive, work.joints["slide"].drive
    assert before is not None and after is not None
    ring = (1.1**2 * 0.1**2 - 0.06**2) / (0.1**2 - 0.06**2)
    assert after.forces == pytest.approx((0.9 * ring * before.forces[0], 0.9 * 1.21 * before.forces[1]))
    assert after.speeds == pytest.approx((0.8 / ring * before.speeds[0], 0.8 / 1.21 * before.speeds[1]))


def test_a_link_has_the_length_that_was_drawn_and_its_loop_closes(machine: Path, tmp_path: Path) -> None:
    base = read_mechanism(machine)
    said = {"boom": {**ALL["boom"], "factor": 1.02}}
    draws = draws_of(read_parameters(parameters(tmp_path, said)), base)
    variant = Basis(base).solved(changed(base, draws, [1.02], {}))

    def length(mechanism: Mechanism) -> float:
        ends = [np.array(mechanism.joint(name).anchor) for name in ("boom_joint", "rod_joint")]
        return float(np.linalg.norm(ends[1] - ends[0]))

    assert length(variant) == pytest.approx(1.02 * length(base), rel=1e-9)
    chain = ClosedChain(variant)
    slide = variant.joint("slide")
    assert slide.lower is not None and slide.upper is not None
    for end in (slide.lower, slide.upper):
        state = chain.solve({"slide": end})
        assert state.closure < 1e-9
        pivot = variant.joint("boom_joint")
        assert pivot.lower is not None and pivot.upper is not None
        assert pivot.lower <= chain.coordinate(state, "boom_joint") <= pivot.upper
    # What a build works out from nothing.
    again = complete(variant)
    for one, other in zip(variant.joints, again.joints, strict=True):
        assert one.lower == pytest.approx(other.lower, abs=2e-3)
        assert one.upper == pytest.approx(other.upper, abs=2e-3)


def test_what_cannot_be_is_refused_and_counted(machine: Path, tmp_path: Path) -> None:
    base = read_mechanism(machine)
    basis = Basis(base)

    def refused(said: dict[str, Any], value: float) -> str:
        draws = draws_of(read_parameters(parameters(tmp_path, {"x": said})), base)
        with pytest.raises(RefusedError) as error:
            basis.solved(changed(base, draws, [value], {}))
        return str(error.value)

    assert "does not close" in refused({"vary": "stroke", "offset": 0}, 1.2)
    assert "drawn beyond the stroke" in refused({"vary": "closed_length", "offset": 0}, 0.2)
    assert "no thinner than its bore" in refused({"vary": "rod_diameter", "factor": 1}, 2.0)
    some = {"stroke": {"vary": "stroke", "offset": {"uniform": [0, "2 m"]}}}
    made = vary(machine, parameters(tmp_path, some), tmp_path / "out", count=4, seed=2, jobs=1)
    assert made.count == 4
    assert made.refused
    rows = table(tmp_path / "out")
    assert sum(not row["refused"] for row in rows) == 4
    assert {row["file"] for row in rows if row["refused"]} == {""}
    assert [int(row["sample"]) for row in rows] == list(range(len(rows)))
    with pytest.raises(UnusableError, match="were refused"):
        vary(machine, parameters(tmp_path, {"x": {"vary": "stroke", "offset": "1500 mm"}}), tmp_path / "none", count=2)
    assert not (tmp_path / "none").exists()


@pytest.mark.parametrize(
    ("said", "words", "place"),
    [
        ({"vary": "colour", "factor": 1}, "'colour' does not fit here", "x.vary"),
        ({"vary": "mass"}, "mass is said by one of", "x"),
        ({"vary": "mass", "factor": 1, "offset": 2}, "mass is said by one of", "x"),
        ({"vary": "friction", "offset": 1}, "friction is said by one of", "x"),
        ({"vary": "mass", "factor": {"uniform": [2, 1]}}, "spread nothing", "x.factor.uniform"),
        ({"vary": "mass", "factor": {"normal": [1, 0]}}, "spread nothing", "x.factor.normal"),
        ({"vary": "mass", "factor": {"gauss": [1, 2]}}, "'gauss' is not a key here", "x.factor"),
        ({"vary": "mass", "offset": "5 mm"}, "is of another kind", "x.offset"),
        ({"vary": "mass", "of": "wing", "factor": 1}, "fits", "x.of"),
        ({"vary": "pin", "of": "slide", "offset": 1}, "'axis' is missing", "x"),
        ({"vary": "length", "of": "boom", "factor": 1}, "'from' is missing", "x"),
        ({"vary": "tool", "of": "boom", "value": {"choice": ["big"]}, "tools": {}}, "chosen by name", "x.value"),
    ],
)
def test_what_nobody_can_mean_is_told(machine: Path, tmp_path: Path, said: Any, words: str, place: str) -> None:
    with pytest.raises(UnusableError) as error:
        vary(machine, parameters(tmp_path, {"x": said}), tmp_path / "out", count=1)
    assert words in error.value.message
    assert place in error.value.where
    assert not (tmp_path / "out").exists()


def test_the_schema_knows_the_same_words(tmp_path: Path) -> None:
    known = schema("variants")
    jsonschema.Draft202012Validator.check_schema(known)
    entry = known["properties"]["parameters"]["additionalProperties"]["properties"]
    assert set(entry["vary"]["enum"]) == set(QUANTITIES) - {DIRECTION}
    jsonschema.validate({"parameters": ALL}, known)


def test_mjcf_deltas_make_the_model_that_the_layer_makes(machine: Path, tmp_path: Path) -> None:
    import mujoco

    from yellowiron.exporters import export
    from yellowiron.fleet.variants import spec_of

    said = parameters(tmp_path, ALL)
    layers = vary(machine, said, tmp_path / "usd", count=2, seed=5, jobs=1)
    vary(machine, said, tmp_path / "mjcf", count=2, seed=5, to="mjcf", jobs=1)
    for file in layers.files:
        name = Path(file).stem
        whole = tmp_path / "usd" / file
        path = export(read_mechanism(whole), whole, tmp_path / f"full{name}", to="mjcf")
        wanted = mujoco.MjModel.from_xml_path(str(path))
        delta = tmp_path / "mjcf" / "variants" / f"{name}.json"
        assert delta.stat().st_size < 20_000
        made = spec_of(delta).compile()
        for field in ("body_mass", "body_inertia", "body_ipos", "jnt_range", "jnt_pos", "actuator_gainprm",
                      "actuator_forcerange", "eq_data", "geom_friction", "site_pos"):  # fmt: skip
            assert np.allclose(getattr(made, field), getattr(wanted, field), rtol=1e-5, atol=1e-6), field
        touching = np.flatnonzero(wanted.geom_contype)
        assert np.allclose(made.geom_size[touching], wanted.geom_size[touching], rtol=1e-6)
        names = [mujoco.mj_id2name(m, mujoco.mjtObj.mjOBJ_BODY, n) for m in (made, wanted) for n in range(m.nbody)]
        assert names[: made.nbody] == names[made.nbody :]


def test_isaac_lab_finds_the_layers(machine: Path, tmp_path: Path) -> None:
    made = vary(machine, parameters(tmp_path, ALL), tmp_path / "out", count=3, seed=1, jobs=1)
    text = (tmp_path / "out" / "isaaclab_cfg.py").read_text()
    compile(text, "isaaclab_cfg.py", "exec")
    assert all(f'"{file}",' in text for file in made.files)
    assert (tmp_path / "out" / "small_loader_cfg.py").is_file()


def test_larger_tyres_raise_the_machine_and_its_colliders_grow(machine: Path, tmp_path: Path) -> None:
    from pxr import Usd, UsdGeom

    said = parameters(tmp_path, {"tyre": {"vary": "tyre_radius", "factor": 1.02}})
    made = vary(machine, said, tmp_path / "out", count=1, jobs=1)
    stage = Usd.Stage.Open(str(tmp_path / "out" / made.files[0]))
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["default", "render", "guide", "proxy"])
    for wheel in small_machine.WHEELS:
        box = cache.ComputeWorldBound(stage.GetPrimAtPath(f"{stage.GetDefaultPrim().GetPath()}/{wheel}"))
        assert box.ComputeAlignedRange().GetMin()[2] == pytest.approx(0.0, abs=2e-3)
        assert box.ComputeAlignedRange().GetMax()[2] == pytest.approx(2.04 * small_machine.RADIUS, abs=4e-3)
    assert float(table(tmp_path / "out")[0]["stand_height"]) == pytest.approx(0.02 * small_machine.RADIUS, rel=1e-3)


@pytest.mark.slow
def test_jobs_change_no_byte_and_the_command_line_says_what_was_refused(machine: Path, tmp_path: Path) -> None:
    said = parameters(tmp_path, {**ALL, "stroke": {"vary": "stroke", "offset": {"uniform": [0, "2 m"]}}})
    vary(machine, said, tmp_path / "one", count=20, seed=9, jobs=1)
    done = console("vary", machine, said, "--out", "three", "--count", "20", "--seed", "9", "-j", "3", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "samples were refused" in done.stdout
    assert files(tmp_path / "one") == files(tmp_path / "three")


@pytest.mark.slow
def test_variants_of_the_loader_are_what_a_build_would_work_out(built_loader: Any, tmp_path: Path) -> None:
    """Limits and gains of the few poses against all of them, for samples that vary everything."""
    base = read_mechanism(built_loader.folder / "wheel_loader.usda")
    said = {
        "mass": ALL["mass"],
        "link": {"vary": "length", "of": "bucket_link", "from": "rocker2bucket_link_joint",
                 "to": "bucket_link2bucket_joint", "factor": {"uniform": [0.99, 1.01]}},
        "stroke": {"vary": "stroke", "of": "boom_cylinder*", "offset": {"uniform": ["-6 mm", "0 mm"]}},
    }  # fmt: skip
    draws = draws_of(read_parameters(parameters(tmp_path, said)), base)
    rows = drawn(draws, seed=11, count=4)
    basis = Basis(base)
    from dataclasses import replace

    from yellowiron.fleet.variants.solving import provisional

    for number in range(4):
        work = changed(base, draws, [float(v[number]) for v in rows], {})
        try:
            variant = basis.solved(work)
        except RefusedError:
            continue
        from_loops = [n for n, j in work.joints.items() if str(j.source.get("limits", "")).startswith("from the loop")]
        blank = {
            name: replace(joint, lower=None, upper=None) if name in from_loops else joint
            for name, joint in work.joints.items()
        }
        blank |= {
            name: replace(joint, drive=provisional(base.joint(name).drive, joint.drive))
            for name, joint in blank.items() if joint.drive is not None
        }  # fmt: skip
        whole = complete(replace(work.made(), joints=tuple(blank[j.name] for j in base.joints)))
        for one, other in zip(variant.joints, whole.joints, strict=True):
            if one.name in from_loops:
                assert one.lower == pytest.approx(other.lower, abs=2e-3)
                assert one.upper == pytest.approx(other.upper, abs=2e-3)
            if one.drive is not None and other.drive is not None:
                assert one.drive.damping == pytest.approx(other.drive.damping, rel=0.02)
                assert one.drive.stiffness == pytest.approx(other.drive.stiffness, rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["mujoco", "newton", "physx"])
def test_variants_of_the_loader_hold_in_every_engine(built_loader: Any, tmp_path: Path, engine: str) -> None:
    """At the bars of the base machine: a finding is a bar that was not held."""
    import yellowiron
    from yellowiron.simulation import installed_engines

    if engine not in installed_engines():
        pytest.skip(f"{engine} is not installed")
    said = {
        "mass": ALL["mass"], "load": {"vary": "payload", "value": {"uniform": [0, "4000 kg"]}},
        "play": ALL["play"], "bore": {**ALL["bore"], "each": True}, "pressure": {**ALL["pressure"], "of": "*"},
        "tyre": {**ALL["tyre"], "each": True},
    }  # fmt: skip
    file = built_loader.folder / "wheel_loader.usda"
    made = vary(file, parameters(tmp_path, said), tmp_path / "out", count=1, seed=4, jobs=1)
    document = yellowiron.simulate(tmp_path / "out" / made.files[0], engine=engine)
    assert document["findings"] == []
    assert document["branches_kept"]
