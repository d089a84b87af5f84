"""Where templates are: the folders of equipment types, and the documents in one."""

from __future__ import annotations

import importlib.resources
from pathlib import Path
from types import ModuleType

from yellowiron.library.notation.validated_json import near
from yellowiron.model.errors import TemplateError
from yellowiron.model.specification import fold
from yellowiron.support.plugins import Plugin, find_plugins

DOCUMENTS = (
    "modules",
    "hierarchy",
    "relations",
    "joints",
    "variants",
    "materials",
    "collision",
    "wanted",
    "actuators",
    "measurements",
    "tests",
    "sensors",
    "words",
    "usual",
    "hinges",
    "shares",
    "balance",
)
"""The documents a template folder can have, each `<name>.json`; only `joints` is needed, and not even that
where `modules` bring joints."""
BUILDS = ("joints", "modules")
"""The documents of which a template needs one to be built from."""
ENTRY_POINTS = "yellowiron.templates"
"""The group under which an installed package names a package of its own that holds a folder for each type."""


def library_folder() -> Path:
    """Where the package keeps its templates."""
    return Path(str(importlib.resources.files("yellowiron.library"))) / "data"


def type_folders() -> dict[str, Path]:
    """Equipment type → its folder, sorted by type: the library's own, and those of installed packages, which name the
    package that holds such folders under the entry point group `yellowiron.templates`; the library's own first.
    `YellowironError` for an entry point that names no such package."""
    found: dict[str, Path] = {}
    for root in _roots():
        for folder in root.iterdir():
            if any((folder / kind).is_file() for kind in ("joints.json", "modules.json", "wanted.json")):
                found.setdefault(folder.name, folder)
    return dict(sorted(found.items()))


def module_files() -> dict[str, Path]:
    """Module → its file, sorted by name: `modules/<name>.json` beside the folders of types."""
    found: dict[str, Path] = {}
    for root in _roots():
        for file in (root / "modules").glob("*.json"):
            found.setdefault(file.stem, file)
    return dict(sorted(found.items()))


def _roots() -> list[Path]:
    return [library_folder(), *map(_brought, find_plugins(ENTRY_POINTS).values())]


def _brought(plugin: Plugin) -> Path:
    """The folder of type folders that an installed package brings."""
    package = plugin.load(ModuleType)
    folder = Path(package.__file__ or "").parent
    if not hasattr(package, "__path__") or not package.__file__:
        raise TemplateError(
            "The equipment types of a package cannot be found: it names no package with a folder of its own",
            where=plugin.package,
            hint="Update the package, or uninstall it.",
        )
    return folder


def list_templates() -> tuple[str, ...]:
    """The equipment types that are installed, sorted; those that `is_sheet_only` too."""
    return tuple(type_folders())


def is_sheet_only(equipment_type: str) -> bool:
    """Whether the library knows of a type only what to ask a sheet for: it can be extracted, not built."""
    folder = type_folders().get(equipment_type)
    return folder is None or not any((folder / f"{kind}.json").is_file() for kind in BUILDS)


def find_template(type_or_folder: str | Path) -> Path:
    """The folder (or lone joint template) that a type or path stands for. `TemplateError` if there is none."""
    text = str(type_or_folder)
    path = Path(type_or_folder)
    if len(path.parts) == 1 and not text.startswith("."):
        for name, folder in type_folders().items():
            if fold(name) == fold(text):
                return folder
    if path.is_dir() or (path.is_file() and path.suffix.lower() == ".json"):
        return path
    if path.is_file():
        raise TemplateError(
            "The file is no template", where=text, hint="Give a template folder, a joints.json, or a library type."
        )
    known = list_templates()
    hint = near(text, known)
    raise TemplateError(
        f"There is no equipment type or template folder '{text}'",
        where=text,
        hint=f"{hint} The library has: {', '.join(known)}.".strip(),
    )


def own_template(type_or_folder: str | Path) -> Path | None:
    """The user's own template folder (or lone joint template) that is meant; None where it is an installed type, even
    if something here has its name. `TemplateError` as in `find_template`."""
    found = find_template(type_or_folder)
    return None if found in type_folders().values() else found


def documents_in(folder: Path) -> dict[str, Path]:
    """The folder's documents by kind. A lone file that is named otherwise is its joint template."""
    files = sorted(p for p in folder.iterdir() if p.is_file() and p.suffix.lower() == ".json")
    found = {kind: path for kind in DOCUMENTS for path in files if fold(path.stem) == kind}
    if not found and len(files) == 1:
        return {"joints": files[0]}
    for path in files:
        # A misspelled document would be left out without a word.
        meant = near(path.stem, DOCUMENTS, at_least=0.85)
        if meant and fold(path.stem) not in DOCUMENTS:
            raise TemplateError(f"'{path.name}' is no document of a template", where=str(path), hint=meant)
    return found
