"""What other installed packages add to yellowiron: the entry points of a group, in the order of their names.

A package names them in its `pyproject.toml`, for engines under `[project.entry-points."yellowiron.engines"]`, as
`name = "module:object"`. Nothing is looked up before it is asked for, and nothing of a package is imported before its
entry is loaded.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import EntryPoint, distributions, entry_points
from pathlib import Path
from typing import Any, TypeVar

from yellowiron.model.errors import YellowironError
from yellowiron.support.text import with_article

_Kind = TypeVar("_Kind")
_HINT = "Update the package that brings it, or uninstall it."


@dataclass(frozen=True)
class Plugin:
    """An entry point of another package; not loaded yet."""

    entry: EntryPoint

    @property
    def name(self) -> str:
        """What it is called by."""
        return self.entry.name

    @property
    def package(self) -> str:
        """The package that brings it, and what it names there."""
        brought = self.entry.dist.name if self.entry.dist else "?"
        return f"{brought} ({self.entry.group}: {self.entry.name} = {self.entry.value})"

    def load(self, kind: type[_Kind]) -> _Kind:
        """The object that it names; `YellowironError` where that cannot be imported or is no `kind`."""
        with in_a_sentence(f"The plugin '{self.name}' cannot be loaded", self.package):
            found = self.entry.load()
        if not isinstance(found, kind):
            raise YellowironError(
                f"The plugin '{self.name}' is no {kind.__name__} but {with_article(type(found).__name__)}",
                where=self.package,
                hint=_HINT,
            )
        return found


@contextmanager
def in_a_sentence(what: str, where: str) -> Iterator[None]:
    """Whatever another package's code throws inside becomes a `YellowironError` that begins with `what`."""
    try:
        yield
    except YellowironError:
        raise
    except Exception as error:
        said = " ".join(f"{type(error).__name__}: {error}".split())[:300]
        raise YellowironError(f"{what}: {said}", where=where, hint=_HINT) from error


def folders() -> tuple[str, ...]:
    """The folders of the import path, in its order, that packages with an entry for us lie in; never the current
    one."""
    brought = [d for d in distributions() if any(e.group.startswith("yellowiron.") for e in d.entry_points)]
    places = {Path(str(package.locate_file(""))).resolve() for package in brought} - {Path.cwd()}
    return tuple(str(Path(folder).resolve()) for folder in sys.path if Path(folder).resolve() in places)


def all_plugins(group: str) -> list[Plugin]:
    """The plugins of a group, in the order of their names, none loaded."""
    return [Plugin(entry) for entry in sorted(entry_points(group=group), key=lambda e: (e.name, e.value))]


def find_plugins(group: str, *, builtin: Iterable[str] = ()) -> dict[str, Plugin]:
    """The plugins of a group by name, in the order of the names, none loaded. `YellowironError` where two packages
    bring the same name, or one brings a name of `builtin`: nothing is replaced silently."""
    found: dict[str, Plugin] = {}
    own = set(builtin)
    for plugin in all_plugins(group):
        if plugin.name in own:
            raise YellowironError(
                f"A package brings '{plugin.name}', a name that yellowiron has itself",
                where=plugin.package,
                hint="Uninstall that package, or have it take another name.",
            )
        other = found.setdefault(plugin.name, plugin)
        if other.entry.value != plugin.entry.value:
            raise YellowironError(
                f"Two packages bring '{plugin.name}'",
                where=f"{other.package} and {plugin.package}",
                hint="Uninstall one of them.",
            )
    return found


def installed(group: str, *, kind: type[Any] = object, builtin: Iterable[str] = ()) -> list[tuple[str, Any]]:
    """Name and object (a `kind`) of every plugin of a group, in the order of the names; errors as in `find_plugins`
    and `Plugin.load`."""
    return [(name, plugin.load(kind)) for name, plugin in find_plugins(group, builtin=builtin).items()]
