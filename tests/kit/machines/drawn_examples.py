"""Examples whose CAD files are not committed, drawn once a run, and what their tests hold of the machines built."""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from kit.builds import MadeOnce, read_once, reading_once, without_pages, without_usd
from kit.machines.defects import on_triangles
from kit.machines.forklifts import truth_of
from kit.machines.nameless import write_nameless
from yellowiron import library, specs, stages
from yellowiron.alignment.readings import align
from yellowiron.cad.mesh.measures import content_key
from yellowiron.model.alignment import Alignment
from yellowiron.model.geometry import Shape
from yellowiron.model.mechanism import Mechanism
from yellowiron.model.specification import Specification
from yellowiron.pipeline import Machine, build
from yellowiron.support.caching.content import content_of

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
PERCENT, DEGREES = 0.3, 0.2
"""Bars of what is published."""
_FITTED: dict[str, Shape] = {}


def drawn_example(name: str, made_once: MadeOnce, *arguments: str) -> Path:
    """A folder with an example's files, drawn with further arguments of its `main`, and in `nameless` its CAD file
    without names."""

    def fill(folder: Path) -> None:
        folder.mkdir()
        words = f"import sys; from pathlib import Path; from {name}.draw import main; "
        words += "main(Path(sys.argv[1]), *sys.argv[2:])"
        subprocess.run([sys.executable, "-c", words, str(folder), *arguments], cwd=EXAMPLES, check=True)
        (folder / "nameless").mkdir()
        write_nameless(folder / f"{name}.step", folder / "nameless" / f"{name}.step")

    return made_once("_".join([name, *arguments]), fill)


@dataclass(frozen=True)
class Built:
    """A machine that was built of an example, and the truth of its drawing."""

    machine: Machine
    truth: dict[str, Any]

    @property
    def mechanism(self) -> Mechanism:
        return self.machine.mechanism


def build_example(name: str, drawing: Path, made_once: MadeOnce, *, named: bool, sheet: Path | None = None) -> Built:
    """An example built once a run from its `drawing` (`drawn_example`), with names or without, and its sheet. Without
    names it writes no USD, which is the named one's, and what its linkages come to is the named one's too, where the
    mechanism is the same."""

    def fill(out: Path) -> None:
        out.mkdir()
        cad = drawing / ("" if named else "nameless") / f"{name}.step"
        known: list[tuple[Mechanism, Mechanism]] = []
        if not named:
            build_example(name, drawing, made_once, named=True, sheet=sheet)
            known = pickle.loads((made_once(f"{drawing.name}_named_built", fill) / "completed.pickle").read_bytes())
        with (
            without_pages(),
            reading_once(made_once, drawing),
            _completing(known),
            nullcontext() if named else without_usd(),
        ):
            machine = build(name, cad, out / "out", sheets=[sheet or drawing / "specifications.pdf"])
        (out / "completed.pickle").write_bytes(pickle.dumps(known))
        (out / "machine.pickle").write_bytes(pickle.dumps(machine))

    out = made_once(f"{drawing.name}_{'named' if named else 'nameless'}_built", fill)
    return Built(pickle.loads((out / "machine.pickle").read_bytes()), truth_of(drawing))


def steered_example(name: str, drawing: Path, made_once: MadeOnce, mode: str) -> Machine:
    """An example built once a run with one of its steering modes, its parts in the roles of the usual one."""
    known = build_example(name, drawing, made_once, named=True).machine
    if mode == "front":
        return known

    def fill(out: Path) -> None:
        out.mkdir()
        with without_pages(), reading_once(made_once, drawing):
            machine = build(
                name, drawing / f"{name}.step", out / "out", sheets=[drawing / "specifications.pdf"],
                settings=[f"steering_mode={mode}"], alignment_file=known.folder / "alignment.json",
            )  # fmt: skip
        (out / "machine.pickle").write_bytes(pickle.dumps(machine))

    machine: Machine = pickle.loads((made_once(f"{drawing.name}_{mode}", fill) / "machine.pickle").read_bytes())
    return machine


@contextmanager
def _completing(known: list[tuple[Mechanism, Mechanism]]) -> Iterator[None]:
    """Builds inside complete no mechanism that is among the `known` (as it is found, as it is completed), but for its
    parts' names; others are put there."""
    complete = stages._completed

    def completed(found: Mechanism) -> Mechanism:
        key = content_of(_plain(found))
        after = next((after for before, after in known if content_of(_plain(before)) == key), None)
        if after is None:
            after = complete(found)
            known.append((found, after))
        parts = {body.name: body.parts for body in found.bodies}
        return replace(after, bodies=tuple(replace(body, parts=parts[body.name]) for body in after.bodies))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stages, "_completed", completed)
        yield


def _plain(mechanism: Mechanism) -> Mechanism:
    """It without the names of its parts."""
    nameless = {b.name: tuple(replace(p, part="", source="") for p in b.parts) for b in mechanism.bodies}
    found = [replace(j, source={k: v for k, v in j.source.items() if k != "parts"}) for j in mechanism.joints]
    return replace(
        mechanism,
        bodies=tuple(replace(body, parts=nameless[body.name]) for body in mechanism.bodies),
        joints=tuple(found),
        sites=tuple(replace(site, source="") for site in mechanism.sites),
    )


def built_example(name: str, made_once: MadeOnce, *arguments: str) -> Path:
    """The USD file of an example, built once a run of its drawing and its sheet."""
    return build_example(name, drawn_example(name, made_once, *arguments), made_once, named=True).machine.usd


def assert_ready(built: Built, mobility: int, actuators: Collection[str]) -> None:
    """Every part is in its body, nothing is left to do, and the machine moves as many ways as it should."""
    _assert_recognised(built.machine.alignment, built.truth)
    report = json.loads((built.machine.folder / "report.json").read_text(encoding="utf-8"))
    assert [f for f in report["findings"] if f["severity"] != "info"] == []
    found = built.mechanism.mobility
    assert found is not None and (found.computed, found.expected) == (mobility, mobility)
    assert {a.name for a in built.mechanism.actuators} == set(actuators)


def assert_drawn_to(truth: Mapping[str, Any], least: int) -> None:
    """At least so many of the sheet's values are in the drawing, to 0.01 mm."""
    rows = truth["values"]
    assert sum("drawn" in row for row in rows.values()) >= least
    for name, row in rows.items():
        assert row.get("drawn", row["target"]) == pytest.approx(row["target"], abs=0.01), name


def assert_read(
    template: str, sheet: Path, lengths: Mapping[str, Any], *, rel: float = 1e-6
) -> dict[str, Specification]:
    """A sheet gives these `lengths` (`Value`s, millimetres), to a share `rel`, and says whose they are, and nothing of
    it is in doubt. Returns all that it gives."""
    found = specs.extract(library.load_template(template), [sheet])
    assert {s.status for s in found} == {"ok", "missing"}
    known = {s.name: s for s in found if s.status == "ok"}
    for name, value in lengths.items():
        assert known[name].value == pytest.approx(value.value / 1000.0, rel=rel), name
        assert known[name].example is not value.published, name
    return known


def assert_measured(machine: Machine, count: int) -> None:
    """So many values of the sheet are measured, each within its bar and none of them calibrated."""
    compared = [m for m in machine.measurements if m.spec is not None]
    assert len(compared) == count
    for m in compared:
        assert m.model is not None and m.spec is not None and m.role != "calibrated", m.name
        if m.unit == "rad":
            assert np.degrees(m.model) == pytest.approx(np.degrees(m.spec), abs=DEGREES), m.name
        else:
            assert m.model == pytest.approx(m.spec, rel=0.01 * PERCENT), m.name


def assert_as_drawn(machine: Machine, truth: Mapping[str, Any], *, besides: str = "") -> None:
    """Every joint and every cylinder is where and what the truth says; joints with `besides` in their name are not
    drawn."""
    frame, mechanism = machine.alignment.frame, machine.mechanism
    assert {j.name for j in mechanism.joints if not besides or besides not in j.name} == set(truth["joints"])
    for name, true in truth["joints"].items():
        joint = mechanism.joint(name)
        axis = frame[:3, :3] @ np.array(true["axis"])
        assert joint.type == true["type"], name
        assert joint.type == "spherical" or np.linalg.norm(np.cross(axis, joint.axis)) < 1e-6, name
        apart = frame[:3, :3] @ np.array(true["anchor"]) + frame[:3, 3] - np.array(joint.anchor)
        if joint.type == "revolute":
            assert np.linalg.norm(np.cross(axis, apart)) < 1e-5, name
        elif joint.type == "spherical":
            assert np.linalg.norm(apart) < 1e-5, name
        else:
            ahead = 1.0 if joint.body0 == true["body0"] else -1.0  # the tree may hold a cylinder by its rod
            assert ahead * np.dot(axis, joint.axis) > 0.0, name
    for slide, true in truth["cylinders"].items():
        found = next(c for c in mechanism.cylinders if c.slide == slide)
        assert found.bore == pytest.approx(true["bore"]) and found.stroke == pytest.approx(true["stroke"])
        assert found.closed_length == pytest.approx(true["closed_length"], abs=1e-6)


def assert_sourced(values: ModuleType, published: int) -> None:
    """Every value of an example stands once, and so many are published, each with its source."""
    names = [value.name for value in (*values.PUBLISHED, *values.EXAMPLE, *values.DRAWN_ONLY)]
    assert len(names) == len(set(names))
    assert len(values.PUBLISHED) == published and all(value.source and value.location for value in values.PUBLISHED)


def recognised(name: str, drawing: Path, names: str, surfaces: str, made_once: MadeOnce) -> Alignment:
    """An example's drawing (`drawn_example`) aligned with its sheet, in folder `names` of it, on "exact" surfaces or
    "triangles": every part is in its body, and none is to be looked at."""
    assembly = read_once(drawing / names / f"{name}.step", made_once)
    if surfaces == "triangles":
        assembly = replace(assembly, shapes={key: _fitted(shape) for key, shape in assembly.shapes.items()})
    template = library.load_template(name)
    found = align(assembly, template, specs.extract(template, [drawing / "specifications.pdf"]))
    _assert_recognised(found, truth_of(drawing))
    return found


def _fitted(shape: Shape) -> Shape:
    """A shape on triangles; those of drawings with and without names, and of their variants, are fitted once."""
    content = content_key(shape.mesh)
    if content not in _FITTED:
        _FITTED[content] = on_triangles({content: shape})[content]
    return replace(_FITTED[content], key=shape.key, name=shape.name)


def _assert_recognised(found: Alignment, truth: Mapping[str, Any]) -> None:
    # Tracks that are belts move with what carries them.
    carriers = {body: key.removesuffix("_with") for key in truth if key.endswith("_with") for body in truth[key]}
    for part, (place, true) in zip(found.parts, truth["parts"].items(), strict=True):
        assert part.body == carriers.get(true["body"], true["body"]), place
    assert not found.to_review
