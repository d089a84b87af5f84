"""The whole way, in order: type, CAD model and specification sheet to a measured USD machine."""

from __future__ import annotations

import importlib
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from yellowiron import cad, checks, kinematics, library, report, specs, usd
from yellowiron.alignment import (
    align,
    decide,
    declared_roles,
    read_alignment,
    read_joints,
    read_values,
    to_scale,
    write_alignment,
)
from yellowiron.inputs import checked_inputs
from yellowiron.mechanism import (
    ComparedJoint,
    build_mechanism,
    compare_declared,
    declared_findings,
    declared_values,
)
from yellowiron.model.alignment import UNDECIDED, Alignment, Decisions
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import MechanismError
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Measurement, Mechanism
from yellowiron.model.rows import expand
from yellowiron.model.specification import Specifications
from yellowiron.model.sweep import Sweep
from yellowiron.model.template import Template, choose
from yellowiron.support.output import output_folder
from yellowiron.support.vectors import triple

_LIBRARIES = (
    "mujoco", "ortools.sat.python.cp_model", "pxr.Usd", "pxr.UsdPhysics", "scipy.optimize", "scipy.spatial",
    "yellowiron.kinematics.completion", "yellowiron.kinematics.measuring.measurement", "yellowiron.usd.write",
)  # fmt: skip
Progress = Callable[[str], None]
_SHOWN = 8
"""Causes of what is open that a notebook shows."""


@dataclass(frozen=True, eq=False)
class Machine:
    """What a build returns: every stage's result, `document` (what `report.json` holds), the folder with its files, and
    what `fell_short`, one phrase each."""

    mechanism: Mechanism
    alignment: Alignment
    specifications: Specifications
    measurements: tuple[Measurement, ...]
    document: Mapping[str, Any]
    folder: Path
    fell_short: tuple[str, ...]

    @property
    def usd(self) -> Path:
        """The machine alone, without ground or light: what `measure`, `simulate` and `export` take."""
        return self.folder / f"{self.mechanism.name}.usda"

    @property
    def scene(self) -> Path:
        """The machine on a ground plane: what to open first."""
        return self.folder / "scene.usda"

    @property
    def report(self) -> Path:
        """The page that says why everything is as it is."""
        return self.folder / "report.html"

    def __repr__(self) -> str:
        state = f"not ready ({report.tally(self.document)})" if self.fell_short else "ready"
        return f"<Machine {self.mechanism.name}: {len(self.mechanism.bodies)} bodies in {self.folder}: {state}>"

    def _repr_html_(self) -> str:
        """What a notebook shows: the verdict, what is open, and where to look."""
        said = [f"<b>{escape(repr(self)[1:-1])}</b>", escape(self.document["verdict"])]
        said += [f"{cause.severity}: {escape(cause.words)}" for cause in report.causes(self.document)[:_SHOWN]]
        said += [f'<a href="{escape(self.report.resolve().as_uri())}">report.html</a> says why.']
        return "<br>".join(said)


@dataclass
class _Clock:
    """Wall-clock seconds by stage."""

    progress: Progress
    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str, words: str) -> Iterator[None]:
        self.progress(words)
        start = time.perf_counter()
        yield
        self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - start


def build(
    equipment_type: str | Path,
    cad_file: Path | str,
    out: Path | str,
    *,
    sheets: Sequence[Path | str] = (),
    alignment_file: Path | str | None = None,
    documents: Sequence[Path | str] = (),
    settings: Sequence[str] = (),
    config: str = "",
    extractor: specs.Extractor = "rules",
    model: specs.ModelOptions | None = None,
    engines: Sequence[str] = (),
    progress: Progress = lambda words: None,
) -> Machine:
    """Fuses an equipment type's template, a CAD model and specification sheets into a USD machine in the folder `out`.

    `equipment_type` is a library type or a template folder; `alignment_file` an edited alignment (default: the one
    that an earlier run left in `out`); `documents` are JSON-1 … JSON-4 or a filled joint template; `settings` are
    texts such as `Lift Cylinder Stroke=764 mm`; `config` picks a column of the sheet; `extractor` and `model` say who
    reads it; the machine is driven in each of `engines` with its rated payload. Raises `YellowironError` for unusable
    input, having written nothing.
    """
    clock = _Clock(progress)
    cad_file, out = Path(cad_file), Path(out)
    # Whatever can be said against an input is said before anything slow.
    inputs = checked_inputs(
        equipment_type, cad_file, out, sheets=[Path(s) for s in sheets],
        alignment_file=Path(alignment_file) if alignment_file else None,
        documents=[Path(d) for d in documents], settings=settings,
    )  # fmt: skip
    template, given, choices = inputs.template, inputs.given, inputs.choices
    earlier = _earlier(alignment_file, out / "alignment.json")
    by_hand = (earlier, read_joints(earlier)) if earlier is not None else None
    with output_folder(out) as folder:
        # Libraries load in a stage of their own: their second or two is no stage's work.
        with clock.stage("load", "Loading libraries"):
            for name in _LIBRARIES:
                importlib.import_module(name)

        with clock.stage("convert", "Reading the CAD model"):
            assembly = cad.read_cad(cad_file)

        # Weakest first: template, sheet, documents, settings.
        data = library.load_documents([Path(d) for d in documents], template, assembly, joints=by_hand)
        template = library.apply_sensors(library.apply_joints(template, data), data)
        with clock.stage("extract", "Reading the specification sheets"):
            read = specs.extract(
                template, [Path(s) for s in sheets], config=config, extractor=extractor, model=model, progress=progress
            )
            specifications = specs.merge(read, values_by_hand(earlier, template), given)

        with clock.stage("align", "Finding the part that plays each role"):
            assembly, alignment = find_roles(
                assembly, template, specifications, earlier=earlier, data=data, choices=choices
            )

        with clock.stage("mechanism", "Building the mechanism"):
            solved = solve(template, assembly, alignment, specifications, data, choices)
            chosen, template, assembly, alignment = solved.chosen, solved.template, solved.assembly, solved.alignment
            mechanism, specifications, compared = solved.mechanism, solved.specifications, solved.compared

        with clock.stage("measure", "Measuring the machine against its sheet"):
            measurements = kinematics.measure(mechanism)

        with clock.stage("write", "Writing USD"):
            usd.write_machine(
                mechanism, assembly, folder, name=mechanism.name, frame=alignment.frame,
                texture_folders=[*data.folders, Path(template.folder)],
            )  # fmt: skip
            written = folder / f"{mechanism.name}.usda"

        with clock.stage("check", "Checking what was written"):
            checked = checks.check(folder / "scene.usda")

        simulation, sweeps = {}, {}
        if engines:
            with clock.stage("simulate", "Driving the machine"):
                for engine in engines:
                    simulation[engine], sweeps[engine] = _driven(written, engine, progress)

        with clock.stage("report", "Writing the report"):
            document = report.report_document(report.BuildFacts(
                mechanism, template, alignment, specifications, measurements,
                findings=(
                    *library.lint(chosen).findings, *assembly.findings, *data.findings,
                    *declared_findings(compared, assembly.name), *checked,
                ),
                usd_counts=usd.count_joints(written),
                levers={a.name: kinematics.lever_table(mechanism, a.name) for a in mechanism.actuators},
                simulation=simulation, declared=compared,
            ))  # fmt: skip
            report.write_document(document, folder / "report.json")
            report.write_document({"specifications": document["specifications"]}, folder / "specifications.json")
            filled = library.filled_joints(chosen, mechanism, specifications)
            report.write_document(filled, folder / "joints.filled.json")
            write_alignment(alignment, assembly, folder / "alignment.json")
            page = report.page(
                document, mechanism, assembly, alignment,
                poses=kinematics.key_poses(mechanism), tables=kinematics.pose_tables(mechanism), sweeps=sweeps,
            )  # fmt: skip
            (folder / "report.html").write_text(page, encoding="utf-8")
            report.write_document({
                "equipment_type": _place(equipment_type) if Path(equipment_type).is_dir() else str(equipment_type),
                "cad": _place(cad_file), "specs": [_place(s) for s in sheets], "data": [_place(d) for d in documents],
                "set": list(settings), "config": config,
            }, folder / "inputs.json")  # fmt: skip
        report.write_document({**clock.seconds, "total": sum(clock.seconds.values())}, folder / "timings.json")
    return Machine(
        mechanism=mechanism,
        alignment=alignment,
        specifications=specifications,
        measurements=measurements,
        document=document,
        folder=out,
        fell_short=tuple(report.fell_short(document)),
    )


@dataclass(frozen=True, eq=False)
class Solved:
    """A machine before it is measured and written: `chosen`, the template with its variants decided, `template`, that
    with its rows counted; the CAD model, as started; what the file's declared joints were `compared` to."""

    chosen: Template
    template: Template
    assembly: Assembly
    alignment: Alignment
    mechanism: Mechanism
    specifications: Specifications
    compared: tuple[ComparedJoint, ...]


def solve(
    template: Template,
    assembly: Assembly,
    alignment: Alignment,
    specifications: Specifications,
    data: library.Documents,
    choices: Mapping[str, str],
) -> Solved:
    """The mechanism of an aligned CAD model: axes put where the sheet has them, values that the CAD file declares lent,
    the machine brought to a pose within its limits."""
    chosen = choose(template, {**alignment.choices, **choices})
    template = expand(chosen, alignment.counts)
    alignment, tape = on_sheet(assembly, template, alignment, specifications, data)
    mechanism = _complete(assembly, template, alignment, specifications, data)
    compared = compare_declared(mechanism, assembly, alignment)
    lent = declared_values(mechanism, template, assembly, alignment, compared, specifications)
    if lent.values:
        specifications = specs.merge(lent, specifications)
        mechanism = _complete(assembly, template, alignment, specifications, data)
    start = kinematics.legal_start(mechanism)
    if start is not None:
        assembly, template, alignment = kinematics.started(assembly, template, alignment, start)
        mechanism = _complete(assembly, template, alignment, specifications, data)
        mechanism = replace(mechanism, findings=(*mechanism.findings, *start.findings))
    mechanism = replace(mechanism, findings=(*mechanism.findings, *tape))
    return Solved(chosen, template, assembly, alignment, mechanism, specifications, compared)


def _place(path: Path | str) -> str:
    """Where an input is, for whoever builds this machine again."""
    return str(Path(path).resolve())


def _earlier(alignment_file: Path | str | None, left: Path) -> Path | None:
    """The alignment file that was asked for, else the one that an earlier run `left`, if it did."""
    return Path(alignment_file) if alignment_file else left if left.exists() else None


def find_roles(
    assembly: Assembly,
    template: Template,
    specifications: Specifications,
    *,
    earlier: Path | None = None,
    data: library.Documents | None = None,
    choices: Mapping[str, str] | None = None,
    decisions: Decisions = UNDECIDED,
) -> tuple[Assembly, Alignment]:
    """Roles for the parts of a CAD model, and the model whose parts they are: scaled where the sheet's overall length
    asks for it; where roles are missing, its merged meshes taken apart, if that finds most of them. `earlier` is an
    alignment file whose edits hold; `decisions` go before them."""

    def found(model: Assembly) -> Alignment:
        edits = read_alignment(earlier, model, template) if earlier is not None else None
        edits = decide(edits, decisions, model, template)
        return roles_of(model, template, specifications, edits=edits, data=data, choices=choices)

    assembly = to_scale(assembly, template, specifications)
    alignment = found(assembly)
    apart = cad.taken_apart(assembly) if alignment.missing else assembly
    if apart is not assembly:
        other = found(apart)
        # A model without pins misses roles whatever is done to it; bodies in crumbs then answer to more roles, wrongly.
        if len(other.missing) < 0.5 * len(alignment.missing):
            return apart, other
    return assembly, alignment


def roles_of(
    assembly: Assembly,
    template: Template,
    specifications: Specifications,
    *,
    edits: Alignment | None = None,
    data: library.Documents | None = None,
    choices: Mapping[str, str] | None = None,
) -> Alignment:
    """Roles for the parts of a CAD model as it is; `edits` is an earlier alignment whose decisions hold."""
    edits = edits if data is None else library.with_relations(edits, data)
    alignment = align(assembly, template, specifications, edits=edits, choices=choices)
    # A robot description whose bodies are the template's: what it says goes before what was found.
    declared = declared_roles(assembly, template, alignment)
    if declared:
        edits = replace(edits or alignment, parts=(*(edits.parts if edits else ()), *declared))
        alignment = align(assembly, template, specifications, edits=edits, choices=choices)
    return alignment if data is None else library.with_axes(alignment, data)


def values_by_hand(earlier: Path | None, template: Template) -> Specifications:
    """The values that a person wrote into an earlier alignment; none without one."""
    values = read_values(earlier) if earlier is not None else {}
    return specs.parse_settings([f"{name}={value.text}" for name, value in values.items()], template)


def on_sheet(
    assembly: Assembly,
    template: Template,
    alignment: Alignment,
    specifications: Specifications,
    data: library.Documents | None = None,
) -> tuple[Alignment, tuple[Finding, ...]]:
    """The alignment with those of its axes that are known roughly placed where the sheet's dimensions put them, and
    what there is to say of it. `template` has its variants decided."""
    rough = {j: s for j, s in alignment.across.items() if j in alignment.axes}
    if not rough or not specifications.values:
        return alignment, ()

    def moved(shifts: Mapping[str, Floats]) -> Alignment:
        axes = {j: (triple(np.array(alignment.axes[j][0]) + by), alignment.axes[j][1]) for j, by in shifts.items()}
        return replace(alignment, axes={**alignment.axes, **axes})

    def built(shifts: Mapping[str, Floats]) -> Mechanism:
        name = template.equipment_type
        mechanism = build_mechanism(assembly, template, moved(shifts), specifications, name=name, documents=data)
        return kinematics.calibrate(mechanism)

    axes = [kinematics.OpenAxis(j, np.array(alignment.axes[j][1]), across) for j, across in sorted(rough.items())]
    placed = kinematics.place_axes(axes, built)
    across = {**alignment.across, **placed.across}
    return replace(moved(placed.shifts), across=across, calibrated=placed.sources), placed.findings


def compare_with_declared(
    assembly: Assembly, template: Template, alignment: Alignment, specifications: Specifications
) -> tuple[Finding, ...]:
    """How the joints that the CAD file declares agree with those that its geometry shows."""
    chosen = expand(choose(template, alignment.choices), alignment.counts)
    try:
        mechanism = build_mechanism(assembly, chosen, alignment, specifications, name=assembly.name)
    except MechanismError:
        return ()
    return declared_findings(compare_declared(mechanism, assembly, alignment), assembly.name)


def _complete(
    assembly: Assembly,
    template: Template,
    alignment: Alignment,
    specifications: Specifications,
    data: library.Documents,
) -> Mechanism:
    """The mechanism with its cylinders calibrated, limits, mobility and gains found."""
    mechanism = build_mechanism(
        assembly, template, alignment, specifications, name=template.equipment_type, documents=data
    )
    return kinematics.complete(kinematics.calibrate(mechanism))


def _driven(machine_file: Path, engine: str, progress: Progress) -> tuple[dict[str, Any], tuple[Sweep, ...]]:
    """A machine in an engine: through all its strokes, on a fixed base, with its rated payload; driving; put to its
    template's tests. As a document, and what there is to look at."""
    from yellowiron import simulation

    load = simulation.rated_payload(usd.read_mechanism(machine_file))
    return simulation.examine(machine_file, engine=engine, payload=load, progress=progress)
