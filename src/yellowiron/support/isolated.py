"""A guarded child's first steps: run as a script, in an interpreter that knows its installation and nothing else.

`interpreter` starts it without the current folder (`-P`) and without `PYTHON…` variables (`-E`), so that a `numpy.py`
among somebody's downloads is a file like any other. What the interpreter's installation has comes first; behind it the
folder that the parent's own package lies in, and those of packages that bring plugins. The package itself is the
parent's, wherever that is: in a wheel, an editable installation or a checkout.
"""

import sys

TYPE_CHECKING = False  # typing's own is not needed for this, and takes time
if TYPE_CHECKING:
    from collections.abc import Mapping


def interpreter() -> list[str]:
    """The command that starts this Python without the current folder and `PYTHON…` variables in its import path."""
    flags = ["-E", "-P", "-X", f"utf8={int(sys.flags.utf8_mode)}"]
    flags += ["-s"] if sys.flags.no_user_site else []
    flags += ["-B"] if sys.dont_write_bytecode else []
    return [sys.executable, *flags]


def shielded(environment: "Mapping[str, str]") -> dict[str, str]:
    """An environment in which no program of Python's looks for modules in the current folder or on PYTHONPATH: readers
    and libraries start such programs themselves, as glfw does when it is imported."""
    own = {name: value for name, value in environment.items() if not name.startswith("PYTHON")}
    return {**own, "PYTHONSAFEPATH": "1"}


def _load(package: str) -> None:
    """Makes a folder the package `yellowiron` of this process, whatever else of that name there is."""
    from importlib.util import module_from_spec, spec_from_file_location

    spec = spec_from_file_location("yellowiron", f"{package}/__init__.py", submodule_search_locations=[package])
    if spec is None or spec.loader is None:
        raise ImportError(f"no package in {package}")
    module = module_from_spec(spec)
    sys.modules["yellowiron"] = module
    spec.loader.exec_module(module)


if __name__ == "__main__":
    package, parent, target, call, *folders = sys.argv[1:]
    sys.path += [folder for folder in folders if folder not in sys.path]
    _load(package)
    from pkgutil import resolve_name

    resolve_name("yellowiron.support.limits:die_with_parent")(int(parent))
    resolve_name(target)(call)
