"""The stages of a build that are kept between runs: a stage that meets the same inputs again answers at once.

Modules of stages are imported where one runs: what is read from the disk needs none of their libraries. What a stage
depends on is its inputs' content (`support.caching.disk.kept`), so that a changed value of a sheet leaves the CAD
model's parts in their roles, and a build of the same inputs is read from the disk.
"""

from __future__ import annotations

import importlib
import threading
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from yellowiron import cad, checks, exporters, kinematics, library, report, said, specs, usd
from yellowiron.alignment import said_in
from yellowiron.endpoint import ModelOptions
from yellowiron.model.alignment import Alignment
from yellowiron.model.assembly import Assembly
from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Floats
from yellowiron.model.mechanism import Measurement, Mechanism
from yellowiron.model.poses import Sweep
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template
from yellowiron.solved import Solved
from yellowiron.support.caching.disk import kept, stages_are_kept

_LIBRARIES = (
    "mujoco", "ortools.sat.python.cp_model", "pxr.Usd", "pxr.UsdPhysics", "scipy.optimize", "scipy.spatial",
    "yellowiron.kinematics.completion", "yellowiron.kinematics.measuring.measurement", "yellowiron.usd.write",
)  # fmt: skip
_LOADED_S = 10.0
"""Seconds by which all of these are loaded, on a slow machine."""


def read_model(cad_file: Path, *, mirror: bool = False) -> Assembly:
    """The CAD model, as `cad.read_cad` has it, or `cad.mirrored`."""

    def make() -> Assembly:
        # A child reads; what comes next needs libraries that take a second or two to load.
        loading = threading.Thread(target=lambda: [importlib.import_module(n) for n in _LIBRARIES], daemon=True)
        loading.start()
        try:
            model = cad.read_cad(cad_file)
        except SystemExit:
            # The program ends as it stands (`support.stopping`).
            raise
        except BaseException:
            # Python crashes where it is taken down while a library loads; and what loads may wait in vain.
            loading.join(_LOADED_S)
            raise
        loading.join()
        return model

    files = cad.files_of(cad_file) if stages_are_kept() else None
    model = make() if files is None else kept("models", make, str(cad_file), files=files)
    return cad.mirrored(model) if mirror else model


def read_sheets(
    template: Template,
    sheets: Sequence[Path],
    *,
    config: str,
    extractor: specs.Extractor,
    model: ModelOptions | None,
    progress: Callable[[str], None],
) -> Specifications:
    """What the sheets say, as `specs.extract` has it. A language model's answers are its own to keep."""

    def read(sheet: Path) -> specs.Sheet:
        # Programs that read pictures are no part of this one.
        programs = specs.picture_programs()
        return kept("sheets", lambda: specs.read(sheet, progress=progress), str(sheet), programs, files=[sheet])

    pages = [read(sheet) for sheet in sheets]

    def make() -> Specifications:
        return specs.from_sheets(
            template, pages, config=config, extractor=extractor, model=model, progress=progress
        )  # fmt: skip

    return kept("values", make, template, pages, config) if extractor == "rules" else make()


def find_roles(
    assembly: Assembly,
    template: Template,
    specifications: Specifications,
    *,
    earlier: Path | None,
    data: library.Documents,
    choices: Mapping[str, str],
) -> tuple[Assembly, Alignment]:
    """`stages.find_roles`, of what it hears."""
    heard = said.heard_of(template, specifications)

    def make() -> tuple[Assembly, Alignment]:
        from yellowiron import stages

        return stages.find_roles(assembly, template, heard, earlier=earlier, data=data, choices=choices)

    edits = said_in(earlier, template) if earlier is not None else {}
    return kept("roles", make, assembly, template, heard, data, choices, edits)


def solve(
    template: Template,
    assembly: Assembly,
    alignment: Alignment,
    specifications: Specifications,
    data: library.Documents,
    choices: Mapping[str, str],
) -> Solved:
    """`stages.solve`."""
    given = (template, assembly, alignment, specifications, data, choices)

    def make() -> Solved:
        from yellowiron import stages

        return stages.solve(*given)

    return kept("mechanisms", make, *given)


def measure(mechanism: Mechanism) -> tuple[tuple[Measurement, ...], dict[str, dict[str, Floats]]]:
    """`kinematics.measure_and_pose`, whose libraries are loaded where it is needed."""
    return kept("measurements", lambda: kinematics.measure_and_pose(mechanism), mechanism)


def write(
    mechanism: Mechanism, assembly: Assembly, frame: Floats, folder: Path, *, textures: Sequence[str]
) -> tuple[tuple[Finding, ...], dict[str, int], dict[str, dict[str, int]]]:
    """Writes the machine into an empty folder and checks it: what the rules found and what meets over the strokes,
    `usd.count_joints` and `usd.count_colliders`. `textures`: folders in which those that materials name are looked
    for."""

    def make() -> tuple[dict[str, bytes], tuple[tuple[Finding, ...], dict[str, int], dict[str, dict[str, int]]]]:
        usd.write_machine(
            mechanism, assembly, folder, name=mechanism.name, frame=frame,
            texture_folders=[Path(place) for place in textures],
        )  # fmt: skip
        files = {str(f.relative_to(folder)): f.read_bytes() for f in sorted(folder.rglob("*")) if f.is_file()}
        machine = folder / f"{mechanism.name}.usda"
        told = (*checks.check(folder / "scene.usda"), *_clearances(mechanism, machine))
        return files, (told, usd.count_joints(machine), usd.count_colliders(machine))

    if any(material.texture for material in mechanism.materials.values()):
        return make()[1]
    files, found = kept("machines", make, mechanism, assembly, frame)
    for name, content in files.items():
        place = folder / name
        if not place.exists():
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_bytes(content)
    return found


def _clearances(mechanism: Mechanism, machine: Path) -> tuple[Finding, ...]:
    bodies = exporters.read_geometry(machine).bodies
    outlines = {name: kinematics.Outline(exporters.solids_of(b), exporters.drawn_of(b)) for name, b in bodies.items()}
    return kinematics.clearance_findings(mechanism, kinematics.meetings(mechanism, outlines))


def lint(template: Template) -> tuple[Finding, ...]:
    """What `library.lint` finds."""
    return kept("lint", lambda: library.lint(template).findings, template)


def levers(mechanism: Mechanism) -> dict[str, Any]:
    """`kinematics.lever_table` of every actuator."""
    return kept(
        "levers", lambda: {a.name: kinematics.lever_table(mechanism, a.name) for a in mechanism.actuators}, mechanism
    )


def document(facts: report.BuildFacts) -> dict[str, Any]:
    """`report.report_document`."""
    return kept("documents", lambda: report.report_document(facts), facts)


def page(
    told: Mapping[str, Any],
    mechanism: Mechanism,
    assembly: Assembly,
    alignment: Alignment,
    poses: Mapping[str, Mapping[str, Floats]],
    sweeps: Mapping[str, tuple[Sweep, ...]],
    sheets: Sequence[Path],
    specifications: Specifications,
) -> str:
    """`report.page`, with the pages of its sheets."""

    def make() -> str:
        with ThreadPoolExecutor(1) as pool:
            pages = pool.submit(specs.page_pictures, sheets, specifications)
            return report.page(
                told, mechanism, assembly, alignment,
                poses=poses, tables=lambda: kinematics.pose_tables(mechanism), sweeps=sweeps, sheets=pages.result,
            )  # fmt: skip

    return kept("pages", make, told, mechanism, assembly, alignment, poses, sweeps, files=sheets)
