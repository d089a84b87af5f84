"""A library template copied to a folder of the user's."""

from __future__ import annotations

import shutil
from pathlib import Path

from yellowiron.library.load import DOCUMENTS, find_template, load_template
from yellowiron.model.errors import OutputError
from yellowiron.model.specification import fold


def copy_template(type_or_folder: str | Path, folder: str | Path) -> Path:
    """Copies a template's documents, and the textures they name, into a folder that is new or empty, and returns it.
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
    try:
        for name, file in files.items():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, target / name)
    except OSError as error:
        raise OutputError(
            f"The template cannot be copied: {error.strerror}",
            where=str(target),
            hint="Name a folder you may write to.",
        ) from error
    return target
