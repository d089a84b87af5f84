"""Bundles the pages' scripts before a wheel, a source distribution or an editable installation is made."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

_spec = importlib.util.spec_from_file_location("bundle", Path(__file__).with_name("studio") / "bundle.py")
assert _spec is not None and _spec.loader is not None
bundle = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(bundle)


class PageHook(BuildHookInterface):  # type: ignore[misc,type-arg]
    """Without a 3D view a wheel is none; who works on the sources may go on without."""

    def dependencies(self) -> list[str]:
        """Node, where there is something to bundle: not from a source distribution, which has the scripts."""
        return [] if bundle.state() == "fresh" else [bundle.NODE]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Before anything is packed."""
        try:
            bundle.make()
        except bundle.BundleError as error:
            if version != "editable":
                self.app.abort(str(error))
            self.app.display_warning(f"{error} Reports and the studio go without their 3D view: {bundle.COMMAND}")
