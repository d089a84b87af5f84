"""What every command but `build` does, as a function: `import yellowiron as yi`, then `yi.align(…)`, `yi.measure(…)` ….

Files are named by paths; a machine may be the `Machine` that a build returned or its USD file. Every function raises
`YellowironError`, with `where` and `hint`, for unusable input, having written nothing. `progress` is called with a few
words at every step.
"""

from __future__ import annotations

import contextlib
import os
import re
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from yellowiron import checks, library, specs
from yellowiron.endpoint import Endpoint, ModelOptions
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.errors import OutputError, YellowironError
from yellowiron.model.finding import Finding
from yellowiron.model.mechanism import Measurement, Mechanism
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template
from yellowiron.support.output import keep_apart, output_file, output_folder
from yellowiron.support.text import to_json

if TYPE_CHECKING:
    from yellowiron.pipeline import Machine

Progress = Callable[[str], None]


@dataclass(frozen=True, eq=False)
class Roles:
    """What `align` found: the alignment, with the findings of all stages; the template whose roles are played; and the
    CAD model whose parts play them, which is the file's own, or that scaled or taken apart."""

    alignment: Alignment
    template: Template
    assembly: Assembly


def extract(
    equipment_type: str | Path,
    sheets: Sequence[Path | str],
    *,
    config: str = "",
    settings: Sequence[str] = (),
    accepted: Sequence[str] = (),
    extractor: specs.Extractor = "rules",
    model: ModelOptions | None = None,
    show: Path | str | None = None,
    progress: Progress = lambda words: None,
) -> Specifications:
    """The values that a type's template asks specification sheets (PDF files) for, in SI, each with its status and its
    evidence. `config` picks a column; `settings` ("Boom Length=5.7 m") are values by hand, `accepted` the names of
    values to review that a person has looked at ("all-proven": every one that the layout leaves no doubt of);
    `extractor` and `model` say who reads; `show` is a folder for pictures of the pages with a box around every
    value."""
    progress("Reading the specification sheets")
    template = library.load_template(equipment_type, sheet_only=True)
    paths = [Path(sheet) for sheet in sheets]
    given = specs.parse_settings(settings, template)
    if show is not None:
        keep_apart(Path(show), paths)
    found = specs.extract(template, paths, config=config, extractor=extractor, model=model, progress=progress)
    found = specs.merge(specs.accept(found, accepted, template), given)
    if show is not None:
        with output_folder(Path(show)) as folder:
            specs.draw_evidence(paths, found, folder)
    return found


def convert(cad_file: Path | str, out: Path | str, *, progress: Progress = lambda words: None) -> Assembly:
    """CAD to USD and nothing else: the model that was read, having written it to `out` (.usd, .usda or .usdc)."""
    from yellowiron import cad, usd
    from yellowiron.usd.convert import check_target

    check_target(Path(out))
    progress("Reading the CAD model")
    assembly = cad.read_cad(Path(cad_file))
    progress("Writing USD")
    usd.write_assembly(assembly, Path(out))
    return assembly


def align(
    equipment_type: str | Path,
    cad_file: Path | str,
    *,
    sheets: Sequence[Path | str] = (),
    settings: Sequence[str] = (),
    config: str = "",
    mirror: bool = False,
    out: Path | str | None = None,
    roles: Sequence[str] = (),
    confirmed: Sequence[str] = (),
    forgotten: Sequence[str] = (),
    machine: Sequence[str] = (),
    by: str = "",
    date: str = "",
    why: str = "",
    opinion: ModelOptions | None = None,
    progress: Progress = lambda words: None,
) -> Roles:
    """The part that plays each role of a type. With `sheets` and `settings` the model's scale is checked against them;
    `mirror` completes a model of which one half is drawn by its mirror image. The language model of `opinion` is shown
    parts in doubt; it points, and decides nothing.

    The alignment is written to the file `out`; what a person decided in it before holds. Decisions for whole parts of
    the CAD tree: `roles` are texts such as `ADT30/HITCH/*=hitch` (none: not part of the machine); what fits a pattern
    of `confirmed` keeps the role that `out` has for it; of what fits one of `forgotten` every decision is dropped.
    `machine` says of the whole: `forward=-x` or `up=z` in the CAD file's frame, a variant's choice, or a role that is
    not drawn, `*_pin=absent`. They are signed with `by`, an ISO `date` and `why`."""
    from yellowiron import cad
    from yellowiron.alignment import as_said, parse_machine, parse_rules, write_alignment
    from yellowiron.model.alignment import Decisions, Signature
    from yellowiron.model.rows import expand
    from yellowiron.opinion import second_opinion
    from yellowiron.said import values_by_hand
    from yellowiron.stages import compare_with_declared, find_roles

    if opinion is not None:
        Endpoint(opinion)  # says at once what is wrong with it

    signature = Signature(by, date, why)
    template = library.load_template(equipment_type)
    decisions = Decisions(
        parse_rules(roles, signature), tuple(confirmed), tuple(forgotten), signature,
        machine=parse_machine(machine, template, signature),
    )  # fmt: skip
    progress("Reading the CAD model")
    assembly = cad.read_cad(Path(cad_file))
    if mirror:
        assembly = cad.mirrored(assembly)
    values, choices = specs.split_settings(settings, template)
    read = specs.extract(template, [Path(sheet) for sheet in sheets], config=config, progress=progress)
    earlier = Path(out) if out is not None and Path(out).exists() else None
    specifications = specs.merge(read, values_by_hand(earlier, template), specs.parse_settings(values, template))
    progress("Finding the part that plays each role")
    assembly, alignment = find_roles(
        assembly, template, specifications, earlier=earlier, choices=choices, decisions=decisions
    )
    if opinion is not None:
        chosen = expand(as_said(template, alignment, alignment.choices), alignment.counts)
        alignment = second_opinion(alignment, assembly, chosen, opinion, progress=progress)
    if out is not None:
        with output_file(Path(out)) as temporary:
            write_alignment(alignment, assembly, temporary)
    remarks = compare_with_declared(assembly, template, alignment, specifications) if assembly.joints else ()
    findings = (*read.findings, *assembly.findings, *alignment.findings, *remarks)
    return Roles(replace(alignment, findings=findings), template, assembly)


def check(file: Path | str, *, machine: Machine | Mechanism | Path | str | None = None) -> tuple[Finding, ...]:
    """The findings of every rule, and of OpenUSD's own validators, on any UsdPhysics file, ours or not; on a URDF,
    SDFormat or MJCF file those on links and joints. With the `machine` from which such a file was exported, its bodies,
    joints, limits and masses are held against it over the full strokes."""
    if machine is None:
        return tuple(checks.check(Path(file)))
    from yellowiron import exporters, kinematics, usd

    mechanism = machine if isinstance(machine, Mechanism) else usd.read_mechanism(_file(machine))
    poses = [checks.Posed(strokes, bodies) for strokes, bodies in kinematics.stroke_poses(mechanism)]
    reduced, _ = exporters.with_tendons(exporters.with_ropes(mechanism)[0])
    return tuple(checks.check_against(Path(file), mechanism, poses, reduced=reduced))


def measure(machine: Machine | Mechanism | Path | str) -> tuple[Measurement, ...]:
    """Every measurement that the template defines, taken on a machine by its closed-chain kinematics, beside its sheet;
    metres and radians."""
    from yellowiron import kinematics, usd

    return kinematics.measure(machine if isinstance(machine, Mechanism) else usd.read_mechanism(_file(machine)))


def simulate(
    machine: Machine | Path | str,
    *,
    engine: str = "mujoco",
    test: Literal["strokes", "drive", "hydraulics", "all"] = "strokes",
    base: Literal["fixed", "floating"] | None = None,
    payload: float | str = 0.0,
    dt: float | None = None,
    settings: Literal["file", "engine"] | None = None,
    rates: Sequence[float] = (),
    progress: Progress = lambda words: None,
) -> dict[str, Any]:
    """A machine driven in an engine, as a document (docs/simulate.md): every actuator through its stroke, each step
    compared with the kinematics; driving about; the template's tests. `payload` is in kilograms, or "rated"; `dt` in
    seconds (default: the engine's own). `settings`: what a build writes (the default), or the engine's own defaults,
    for the strokes alone. With `rates`, steps a second, the strokes run at each of them with both settings, or with
    those that are named, and the document is a table of how far the pins come apart."""
    from yellowiron.simulation import at_rates, examine, parse_payload

    file = _file(machine)
    load = parse_payload(payload if isinstance(payload, str) else repr(float(payload)), file)
    if rates:
        if dt is not None or test != "strokes":
            raise YellowironError(
                "Rates are steps of their own, and for the strokes alone",
                where="--hz",
                hint="Leave --dt and --test out.",
            )
        chosen: tuple[Literal["file", "engine"], ...] = ("file", "engine") if settings is None else (settings,)
        return at_rates(file, engine=engine, rates=rates, settings=chosen, base=base, payload=load, progress=progress)
    document, _ = examine(
        file, engine=engine, test=test, base=base, payload=load, dt=dt, settings=settings or "file", progress=progress
    )
    return document


def export(
    machine: Machine | Path | str,
    out: Path | str,
    *,
    to: str = "mjcf",
    detail: str = "full",
    progress: Progress = lambda words: None,
) -> Path:
    """The same machine for another simulator, in the folder `out`: the path of the file to open there. `detail` of its
    colliders: `full`, `light` (few simple ones; MJCF has no others to see) or `visual` (none)."""
    from yellowiron import exporters, usd

    title = exporters.find_exporter(to).title
    file = _file(machine)
    keep_apart(Path(out), [file])
    with output_folder(Path(out)) as folder:
        progress(f"Writing {title}")
        inside = exporters.export(usd.read_mechanism(file), file, folder, to=to, detail=detail).relative_to(folder)
    return Path(out) / inside


def new_template(
    cad_file: Path | str,
    out: Path | str | None = None,
    *,
    like: str | Path | None = None,
    progress: Progress = lambda words: None,
) -> dict[str, Any]:
    """Proposes a template for the machine of a CAD model and writes it to the folder `out`, which is new or empty;
    without one nothing is written. `like` is a library type, or a template folder, whose roles, names and limits are
    taken over where bodies match.

    Returns {folder (null where nothing is written), equipment_type, bodies: [{role, kind, parts, reason}], joints:
    [{name, type, bodies, point, axis, pins, reason}], findings}: points in metres and axes in the CAD file's frame;
    findings of the geometry, then of the template's lint. Raises `YellowironError` also where nothing turns or slides.
    """
    from yellowiron import cad
    from yellowiron.alignment import align as align_parts
    from yellowiron.alignment import discover, discover_declared

    cad_file = Path(cad_file)
    name = re.sub(r"\W+", "_", cad_file.stem).strip("_").casefold() or "machine"
    folder = Path(out) if out is not None else None
    if folder is not None:
        keep_apart(folder, [cad_file])
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise OutputError(
                "The folder is there already, and nothing is overwritten",
                where=str(folder),
                hint="Name a folder that is new or empty with --out.",
            )
    progress("Reading the CAD model")
    assembly = cad.read_cad(cad_file)
    progress("Finding bodies and joints")
    found = discover_declared(assembly) if assembly.joints else discover(assembly)
    lent = None
    if like is not None:
        progress(f"Comparing with {like}")
        lent = library.likeness(like, align_parts(assembly, library.load_template(like), Specifications()))
    proposal = library.propose(found, name=name, like=lent)
    with contextlib.ExitStack() as stack:
        if folder is not None:
            temporary = stack.enter_context(output_folder(folder))
        else:
            temporary = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="yellowiron-"))) / name
            temporary.mkdir()
        for kind, document in proposal.documents.items():
            (temporary / f"{kind}.json").write_text(to_json(document), encoding="utf-8")
        (temporary / "proposal.md").write_text(proposal.words, encoding="utf-8")
        findings = library.lint(library.load_template(temporary)).findings
    return {
        "folder": str(folder) if folder is not None else None,
        "equipment_type": name,
        "bodies": [
            {"role": role, "kind": body.kind, "parts": list(body.parts), "reason": body.reason}
            for role, body in zip(proposal.roles, found.bodies, strict=True)
        ],
        "joints": [
            {
                "name": title,
                "type": joint.type,
                "bodies": [proposal.roles[joint.a], proposal.roles[joint.b]],
                "point": list(joint.point),
                "axis": list(joint.direction),
                "pins": list(joint.pins),
                "reason": joint.reason,
            }
            for title, joint in zip(proposal.joints, found.joints, strict=True)
        ],
        "findings": [asdict(f) for f in (*found.findings, *findings)],
    }


def _file(machine: Machine | Path | str) -> Path:
    """A machine's USD file."""
    return Path(machine) if isinstance(machine, (str, os.PathLike)) else machine.usd
