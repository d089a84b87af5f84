"""A library template copied to a folder of the user's."""

from __future__ import annotations

import shutil
from pathlib import Path

from yellowiron.library.load import find_template, load_template
from yellowiron.model.errors import OutputError


def copy_template(type_or_folder: str | Path, folder: str | Path) -> Path:
    """Copies a template's documents into a folder that is new or empty, and returns it. `OutputError` where the folder
    has something in it or cannot be written; `TemplateError` where the template does not load."""
    source, target = find_template(type_or_folder), Path(folder)
    load_template(type_or_folder)
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise OutputError(
            "The folder is there already, and nothing is overwritten",
            where=str(target),
            hint="Name a folder that is new or empty.",
        )
    files = [source] if source.is_file() else sorted(p for p in source.iterdir() if p.suffix.lower() == ".json")
    try:
        target.mkdir(parents=True, exist_ok=True)
        for file in files:
            shutil.copyfile(file, target / ("joints.json" if source.is_file() else file.name))
    except OSError as error:
        raise OutputError(
            f"The template cannot be copied: {error.strerror}",
            where=str(target),
            hint="Name a folder you may write to.",
        ) from error
    return target
