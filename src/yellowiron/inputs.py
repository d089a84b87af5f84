"""What can be said against a build's inputs at once, before a library is loaded or a stage begun."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from yellowiron import cad, library, specs
from yellowiron.endpoint import Endpoint, ModelOptions
from yellowiron.model.alignment import LARGEST_FILE
from yellowiron.model.errors import AlignmentError
from yellowiron.model.specification import Specifications
from yellowiron.model.template import Template
from yellowiron.support.files.inputs import require_file
from yellowiron.support.output import check_folder, keep_apart


@dataclass(frozen=True, eq=False)
class Inputs:
    """What a build was given, as far as it is known without the CAD model: the `template`, values `given` by hand, and
    the variants chosen by hand."""

    template: Template
    given: Specifications
    choices: Mapping[str, str]


def checked_inputs(
    equipment_type: str | Path,
    cad_file: Path,
    out: Path,
    *,
    sheets: Sequence[Path] = (),
    alignment_file: Path | None = None,
    documents: Sequence[Path] = (),
    settings: Sequence[str] = (),
    opinion: ModelOptions | None = None,
    engines: Sequence[str] = (),
) -> Inputs:
    """`YellowironError` for a template that does not load, settings or engines that are not known, an output folder
    that cannot be written, a model for a second opinion that is not configured, and files that are missing or plainly
    not what they should be. Nothing is left behind."""
    keep_apart(out, [cad_file, *sheets])
    # The quickest first: a template takes half a second.
    cad.check_file(cad_file)
    for sheet in sheets:
        specs.check_file(sheet)
    if alignment_file is not None:
        require_file(alignment_file, what="The alignment", most=LARGEST_FILE, error=AlignmentError)
    library.check_documents(documents)
    check_folder(out)
    if opinion is not None:
        Endpoint(opinion)
    if engines:
        from yellowiron.simulation.registry import find_engine

        for engine in engines:
            find_engine(engine)
    template = library.load_template(equipment_type)
    values, choices = specs.split_settings(settings, template)
    return Inputs(template, specs.parse_settings(values, template), choices)
