"""A library template copied to a folder of the user's."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

from yellowiron.library.composing.documents import is_whole, template_documents
from yellowiron.library.load import load_template
from yellowiron.library.notation.written import document_text
from yellowiron.library.parsing.wanted import complete
from yellowiron.library.type_folders import documents_in, find_template
from yellowiron.model.errors import OutputError
from yellowiron.model.template import Template
from yellowiron.support.output import output_folder


def copy_template(type_or_folder: str | Path, folder: str | Path) -> Path:
    """Copies a template's documents, and the textures they name, into a folder that is new or empty, and returns it.
    What `wanted.json` takes from the library, any document from the type it is `like`, and what modules bring, is
    written out, so that the copy says everything itself.
    `OutputError` where the folder has something in it or cannot be written, or a texture lies outside the template;
    `TemplateError` where the template does not load."""
    source, target = find_template(type_or_folder), Path(folder)
    template = load_template(type_or_folder, sheet_only=True)
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise OutputError(
            "The folder is there already, and nothing is overwritten",
            where=str(target),
            hint="Name a folder that is new or empty.",
        )
    files = _files(source, template)
    written = {} if source.is_file() else _written_out(source)
    with output_folder(target) as staged:
        for name, file in files.items():
            (staged / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, staged / name)
        for kind, content in written.items():
            (staged / f"{kind}.json").write_text(document_text(content) + "\n", encoding="utf-8")
    return target


def _files(source: Path, template: Template) -> dict[str, Path]:
    """What is copied as it is: documents that say everything, and textures; by name in the copy."""
    if source.is_file():
        return {"joints.json": source}
    names = [path.name for kind, path in documents_in(source).items() if is_whole(source, kind)]
    names += sorted({m.texture for m in template.materials.values() if m.texture})
    files = {name: source / name for name in names}
    for name, file in files.items():
        if not file.resolve().is_relative_to(source.resolve()):
            raise OutputError(
                f"'{name}' lies outside the template and would be copied outside the folder",
                where=str(source),
                hint="Put textures into the template's own folder.",
            )
    return files


def _written_out(source: Path) -> dict[str, Any]:
    """Kind → content of the documents that do not say everything themselves."""
    documents = template_documents(source)
    whole = {kind: complete(document) if kind == "wanted" else document for kind, document in documents.items()}
    return {kind: whole[kind].data for kind in whole if not is_whole(source, kind) or whole[kind] != documents[kind]}
