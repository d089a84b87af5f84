"""A library template copied to a folder of the user's."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

from yellowiron.library.alike import is_like, template_document
from yellowiron.library.load import load_template
from yellowiron.library.parsing.wanted import complete
from yellowiron.library.type_folders import DOCUMENTS, find_template
from yellowiron.model.errors import OutputError
from yellowiron.model.specification import fold
from yellowiron.support.output import output_folder


def copy_template(type_or_folder: str | Path, folder: str | Path) -> Path:
    """Copies a template's documents, and the textures they name, into a folder that is new or empty, and returns it.
    What `wanted.json` takes from the library, and any document from the type it is `like`, is written out, so that the
    copy says everything itself.
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
    if source.is_file():
        files = {"joints.json": source}
    else:
        names = [p.name for p in sorted(source.iterdir()) if p.is_file() and fold(p.stem) in DOCUMENTS]
        names += sorted({m.texture for m in template.materials.values() if m.texture})
        files = {name: source / name for name in names}
        for name, file in files.items():
            if not file.resolve().is_relative_to(source.resolve()):
                raise OutputError(
                    f"'{name}' lies outside the template and would be copied outside the folder",
                    where=str(source),
                    hint="Put textures into the template's own folder.",
                )
    with output_folder(target) as staged:
        for name, file in files.items():
            (staged / name).parent.mkdir(parents=True, exist_ok=True)
            _copy(file, staged / name)
    return target


def _copy(file: Path, target: Path) -> None:
    kind = fold(file.stem)
    alike = kind in DOCUMENTS and is_like(file)
    if alike or kind == "wanted":
        document = template_document(file, kind)
        whole = complete(document) if kind == "wanted" else document
        if alike or whole != document:
            target.write_text(_text(whole.data) + "\n", encoding="utf-8")
            return
    shutil.copyfile(file, target)


def _text(value: Any, indent: str = "") -> str:
    """JSON with one line for each key, and lists on one line, as the library's own documents are written."""
    if not isinstance(value, dict):
        return json.dumps(value, ensure_ascii=False)
    inner = indent + "  "
    lines = [f"{inner}{json.dumps(key, ensure_ascii=False)}: {_text(item, inner)}" for key, item in value.items()]
    return "\n".join(("{", ",\n".join(lines), indent + "}"))
