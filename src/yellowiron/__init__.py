"""yellowiron: from a construction machine's CAD model and specification sheet to a simulation-ready USD machine.

The public names, each imported on first use: CAD, USD and physics libraries take seconds to load.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from yellowiron.build import Machine, build
    from yellowiron.cad import read_cad
    from yellowiron.kinematics import ClosedChain, measure
    from yellowiron.library import lint, load_template
    from yellowiron.model.errors import YellowironError
    from yellowiron.model.mechanism import Mechanism
    from yellowiron.model.specification import Specifications
    from yellowiron.model.template import Template
    from yellowiron.new import new_template
    from yellowiron.usd import read_machine, write_machine

_HOME = {
    "ClosedChain": "kinematics",
    "Machine": "build",
    "Mechanism": "model.mechanism",
    "Specifications": "model.specification",
    "Template": "model.template",
    "YellowironError": "model.errors",
    "build": "build",
    "lint": "library",
    "load_template": "library",
    "measure": "kinematics",
    "new_template": "new",
    "read_cad": "cad",
    "read_machine": "usd",
    "write_machine": "usd",
}

__all__ = [
    "ClosedChain",
    "Machine",
    "Mechanism",
    "Specifications",
    "Template",
    "YellowironError",
    "build",
    "lint",
    "load_template",
    "measure",
    "new_template",
    "read_cad",
    "read_machine",
    "write_machine",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'yellowiron' has no attribute '{name}'")
    return getattr(importlib.import_module(f"yellowiron.{_HOME[name]}"), name)
