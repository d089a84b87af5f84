"""The whole way, in order: type, CAD model and specification sheet to a measured USD machine."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any

from yellowiron import library, memory, report, specs, usd
from yellowiron.alignment import read_joints, write_alignment
from yellowiron.endpoint import ModelOptions
from yellowiron.inputs import checked_inputs
from yellowiron.mechanism import declared_findings
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import YellowironError
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Measurement, Mechanism
from yellowiron.model.poses import Sweep
from yellowiron.model.specification import Specifications
from yellowiron.said import values_by_hand
from yellowiron.support.output import output_folder

Progress = Callable[[str], None]
_SHOWN = 8
"""Causes of what is open that a notebook shows."""


@dataclass(frozen=True, eq=False)
class Machine:
    """What a build returns: every stage's result (`assembly`: the CAD model whose parts they are, as it starts),
    `document` (what `report.json` holds), the folder with its files, and what `fell_short`, one phrase each."""

    mechanism: Mechanism
    alignment: Alignment
    specifications: Specifications
    measurements: tuple[Measurement, ...]
    document: Mapping[str, Any]
    folder: Path
    fell_short: tuple[str, ...]
    assembly: Assembly

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
    mirror: bool = False,
    extractor: specs.Extractor = "rules",
    model: ModelOptions | None = None,
    opinion: ModelOptions | None = None,
    engines: Sequence[str] = (),
    page: bool = True,
    progress: Progress = lambda words: None,
) -> Machine:
    """Fuses an equipment type's template, a CAD model and specification sheets into a USD machine in the folder `out`.

    `equipment_type` is a library type or a template folder; `alignment_file` an edited alignment (default: the one
    that an earlier run left in `out`); `documents` are JSON-1 … JSON-4 or a filled joint template; `settings` are
    texts such as `Lift Cylinder Stroke=764 mm`; `config` picks a column of the sheet; `mirror` completes a model of
    which one half is drawn by its mirror image; `extractor` and `model` say who reads it; the language model of
    `opinion` is shown parts in doubt, points, and decides nothing; the machine is driven in each of `engines` with its
    rated payload; without `page` no report.html is drawn, a third of the time. Raises
    `YellowironError` for unusable input, having written nothing.
    """
    clock = _Clock(progress)
    cad_file, out = Path(cad_file), Path(out)
    # Whatever can be said against an input is said before anything slow.
    inputs = checked_inputs(
        equipment_type, cad_file, out, sheets=[Path(s) for s in sheets],
        alignment_file=Path(alignment_file) if alignment_file else None,
        documents=[Path(d) for d in documents], settings=settings, opinion=opinion, engines=engines,
    )  # fmt: skip
    template, given, choices = inputs.template, inputs.given, inputs.choices
    own = library.own_template(equipment_type)
    earlier = _earlier(alignment_file, out / "alignment.json")
    by_hand = (earlier, read_joints(earlier)) if earlier is not None else None
    with output_folder(out) as folder:
        with clock.stage("convert", "Reading the CAD model"):
            assembly = memory.read_model(cad_file, mirror=mirror)

        # Weakest first: template, sheet, documents, settings.
        data = library.load_documents([Path(d) for d in documents], template, assembly, joints=by_hand)
        template = library.apply_sensors(library.apply_joints(template, data), data)
        with clock.stage("extract", "Reading the specification sheets"):
            read = memory.read_sheets(
                template, [Path(s) for s in sheets], config=config, extractor=extractor, model=model, progress=progress
            )
            specifications = specs.merge(read, values_by_hand(earlier, template), given)

        with clock.stage("align", "Finding the part that plays each role"):
            assembly, alignment = memory.find_roles(
                assembly, template, specifications, earlier=earlier, data=data, choices=choices
            )

        with clock.stage("mechanism", "Building the mechanism"):
            solved = memory.solve(template, assembly, alignment, specifications, data, choices)
            chosen, template, assembly, alignment = solved.chosen, solved.template, solved.assembly, solved.alignment
            mechanism, specifications, compared = solved.mechanism, solved.specifications, solved.compared

        if opinion is not None:
            from yellowiron.opinion import second_opinion

            # After all that an alignment is used for: what the model says can change nothing.
            with clock.stage("opinion", "Asking for a second opinion"):
                alignment = second_opinion(alignment, assembly, template, opinion, progress=progress)

        with clock.stage("measure", "Measuring the machine against its sheet"):
            measurements, poses = memory.measure(mechanism)

        with clock.stage("write", "Writing and checking USD"):
            textures = [*data.folders, template.folder]
            checked, usd_counts, colliders = memory.write(
                mechanism, assembly, alignment.frame, folder, textures=textures
            )
            written = folder / f"{mechanism.name}.usda"

        simulation, sweeps, stuck = {}, {}, []
        if engines:
            with clock.stage("simulate", "Driving the machine"):
                for engine in engines:
                    try:
                        simulation[engine], sweeps[engine] = _driven(written, engine, progress)
                    except YellowironError as error:
                        # What an engine makes of it is no reason to lose the machine.
                        words = f"{error.message}: the machine was not driven there."
                        stuck.append(Finding("SIM010", "error", engine, words, error.hint))

        with clock.stage("report", "Writing the report"):
            document = memory.document(report.BuildFacts(
                mechanism, template, alignment, specifications, measurements,
                findings=(
                    *memory.lint(chosen), *assembly.findings, *data.findings,
                    *declared_findings(compared, assembly.name), *checked, *stuck,
                ),
                usd_counts=usd_counts, colliders=colliders,
                levers=memory.levers(mechanism),
                simulation=simulation, declared=compared,
            ))  # fmt: skip
            report.write_document(document, folder / "report.json")
            report.write_document({"specifications": document["specifications"]}, folder / "specifications.json")
            filled = library.filled_joints(chosen, mechanism, specifications)
            report.write_document(filled, folder / "joints.filled.json")
            write_alignment(alignment, assembly, folder / "alignment.json")
            if page:
                text = memory.page(
                    document, mechanism, assembly, alignment, poses, sweeps, [Path(s) for s in sheets], specifications
                )
                (folder / "report.html").write_text(text, encoding="utf-8")
            report.write_document({
                "equipment_type": str(equipment_type) if own is None else _place(own),
                "cad": _place(cad_file), "specs": [_place(s) for s in sheets], "data": [_place(d) for d in documents],
                "set": list(settings), "config": config, **({"mirror": True} if mirror else {}),
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
        assembly=assembly,
    )


def _place(path: Path | str) -> str:
    """Where an input is, for whoever builds this machine again."""
    return str(Path(path).resolve())


def _earlier(alignment_file: Path | str | None, left: Path) -> Path | None:
    """The alignment file that was asked for, else the one that an earlier run `left`, if it did."""
    return Path(alignment_file) if alignment_file else left if left.exists() else None


def _driven(machine_file: Path, engine: str, progress: Progress) -> tuple[dict[str, Any], tuple[Sweep, ...]]:
    """A machine in an engine: through all its strokes, on a fixed base, with its rated payload; driving; put to its
    template's tests. As a document, and what there is to look at."""
    from yellowiron import simulation

    load = simulation.payload_over_strokes(usd.read_mechanism(machine_file))
    return simulation.examine(machine_file, engine=engine, payload=load, progress=progress)
