"""yellowiron: from a construction machine's CAD model and specification sheet to a simulation-ready USD machine.

    import yellowiron as yi

    machine = yi.build("wheel_loader", "loader.step", "out/loader", sheets=["brochure.pdf"])
    print(machine.fell_short or "ready", machine.scene, machine.report)

The public names; each is imported on first use, because CAD, USD and physics libraries take seconds to load.
"""

import sys

if sys.argv[:1] == ["-m"] and not sys.flags.safe_path and not __file__.startswith(f"{sys.path[0]}/yellowiron/"):
    # `python -m yellowiron`: Python put the current folder first, where a `numpy.py` may lie (docs/security.md).
    del sys.path[0]

from typing import TYPE_CHECKING

from yellowiron.support.lazy import lazy_names

if TYPE_CHECKING:
    from yellowiron.api import Roles, align, check, convert, export, extract, measure, new_template, simulate
    from yellowiron.cad import read_cad
    from yellowiron.endpoint import ModelOptions
    from yellowiron.kinematics import ClosedChain
    from yellowiron.library import lint, list_templates, load_template
    from yellowiron.model.errors import YellowironError
    from yellowiron.model.mechanism import Mechanism
    from yellowiron.model.specification import Specifications
    from yellowiron.model.template import Template
    from yellowiron.pipeline import Machine, build
    from yellowiron.usd import read_mechanism, write_machine

__version__ = "0.2.0"

__all__ = [
    "ClosedChain",
    "Machine",
    "Mechanism",
    "ModelOptions",
    "Roles",
    "Specifications",
    "Template",
    "YellowironError",
    "__version__",
    "align",
    "build",
    "check",
    "convert",
    "export",
    "extract",
    "lint",
    "list_templates",
    "load_template",
    "measure",
    "new_template",
    "read_cad",
    "read_mechanism",
    "simulate",
    "write_machine",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "ClosedChain": "kinematics",
        "Machine": "pipeline",
        "Mechanism": "model.mechanism",
        "ModelOptions": "endpoint",
        "Roles": "api",
        "Specifications": "model.specification",
        "Template": "model.template",
        "YellowironError": "model.errors",
        "align": "api",
        "build": "pipeline",
        "check": "api",
        "convert": "api",
        "export": "api",
        "extract": "api",
        "lint": "library",
        "list_templates": "library",
        "load_template": "library",
        "measure": "api",
        "new_template": "api",
        "read_cad": "cad",
        "read_mechanism": "usd",
        "simulate": "api",
        "write_machine": "usd",
    },
)
