"""Writes the pages that docstrings give: `docs/api.md` (the public names), `docs/rooms.md` (packages and modules).

`python docs/generate.py` after a docstring or a signature has changed; a test holds the pages to the code.
"""

from __future__ import annotations

import ast
import dataclasses
import inspect
from pathlib import Path
from typing import Any

import yellowiron

DOCS = Path(__file__).resolve().parent
PACKAGE = DOCS.parent / "src" / "yellowiron"
_MADE = "<!-- made by docs/generate.py from the docstrings: edit those -->"
_WIDTH = 110


def api_page() -> str:
    """The public names: signature, docstring, and a class's fields and methods."""
    names = [name for name in yellowiron.__all__ if not name.startswith("_")]
    things = {name: getattr(yellowiron, name) for name in names}
    functions = [name for name, thing in things.items() if inspect.isfunction(thing)]
    classes = [name for name, thing in things.items() if inspect.isclass(thing)]
    sections = [_MADE, "# The public API", inspect.getdoc(yellowiron) or "", "## Functions"]
    sections += [_entry(name, things[name]) for name in functions]
    sections += ["## Values", *(_entry(name, things[name]) for name in classes)]
    return "\n\n".join(sections) + "\n"


def rooms_page() -> str:
    """Every package, what its docstring says, and its modules with their first lines."""
    sections = [_MADE, "# The rooms of the code", _first(PACKAGE / "__init__.py")]
    for init in sorted(PACKAGE.rglob("__init__.py"), key=lambda path: path.parent):
        folder = init.parent
        modules = [path for path in sorted(folder.glob("*.py")) if not path.name.startswith("__")]
        if folder != PACKAGE:
            depth = "#" * (1 + len(folder.relative_to(PACKAGE).parts))
            sections.append(f"{depth} {folder.relative_to(PACKAGE).as_posix()}")
            sections.append(_first(init))
        rows = "\n".join(f"| `{path.stem}` | {_first(path)} |" for path in modules)
        if rows:
            sections.append(f"| module | |\n|---|---|\n{rows}")
    return "\n\n".join(sections) + "\n"


def _entry(name: str, thing: Any) -> str:
    lines = [f"### {name}"]
    if inspect.isfunction(thing):
        lines.append(f"```python\n{_signature(name, thing)}\n```")
        lines.append(inspect.getdoc(thing) or "")
        return "\n\n".join(lines)
    lines.append(inspect.getdoc(thing) or "")
    if dataclasses.is_dataclass(thing):
        rows = "\n".join(f"| `{field.name}` | `{_plain(field.type)}` |" for field in dataclasses.fields(thing))
        lines.append(f"| field | type |\n|---|---|\n{rows}")
    for member, value in vars(thing).items():
        if member.startswith("_"):
            continue
        if isinstance(value, property) and value.fget is not None:
            lines.append(f"`.{member}`: {_plain(inspect.signature(value.fget).return_annotation)}. {_flat(value)}")
        elif inspect.isfunction(value):
            lines.append(f"```python\n{_signature(member, value)}\n```\n\n{inspect.getdoc(value) or ''}")
    return "\n\n".join(lines)


def _signature(name: str, function: Any) -> str:
    """As it is written, annotations as they are; a line for each parameter where one line does not hold it."""
    signature = inspect.signature(function)
    parameters = []
    keyword_only = False
    for parameter in signature.parameters.values():
        if parameter.kind is inspect.Parameter.KEYWORD_ONLY and not keyword_only:
            keyword_only = True
            parameters.append("*")
        text = (
            f"{parameter.name}: {_plain(parameter.annotation)}" if parameter.annotation is not parameter.empty else ""
        )
        default = parameter.default
        shown = "quiet" if inspect.isfunction(default) else repr(default)
        parameters.append(text + ("" if default is parameter.empty else f" = {shown}"))
    returns = f" -> {_plain(signature.return_annotation)}"
    line = f"{name}({', '.join(parameters)}){returns}"
    if len(line) <= _WIDTH:
        return line
    inside = "".join(f"    {parameter},\n" for parameter in parameters)
    return f"{name}(\n{inside}){returns}"


def _plain(annotation: Any) -> str:
    return annotation if isinstance(annotation, str) else getattr(annotation, "__name__", str(annotation))


def _flat(thing: Any) -> str:
    return " ".join((inspect.getdoc(thing) or "").split())


def _first(path: Path) -> str:
    """The first paragraph of a module's docstring, on one line."""
    text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    return " ".join(text.split("\n\n", 1)[0].split()).replace("|", "\\|")


def main() -> None:
    """Writes both pages."""
    (DOCS / "api.md").write_text(api_page(), encoding="utf-8")
    (DOCS / "rooms.md").write_text(rooms_page(), encoding="utf-8")


if __name__ == "__main__":
    main()
