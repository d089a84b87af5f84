"""A folder of downloads in which every module that anybody might import lies in wait, and installations beside it."""

from __future__ import annotations

import os
import shutil
import site
import sys
from collections.abc import Iterable
from importlib.metadata import packages_distributions
from pathlib import Path

import yellowiron

PACKAGE = Path(yellowiron.__file__).resolve().parent
LAUNCHER = PACKAGE.parents[1] / "launcher" / "yellowiron"


def plant(folder: Path, *, spare: Iterable[str] = ()) -> Path:
    """Fills a folder with modules of every name of the standard library, of every installed package, of ours and of
    those that Python runs at its start, and with a package's entry for us. Each leaves its name in the file that is
    returned; those of `spare` are left out."""
    folder.mkdir(parents=True, exist_ok=True)
    marker = folder.parent / f"{folder.name}.ran"
    # With what is there before anything can be imported.
    source = (
        f"import posix\nfile = posix.open({str(marker)!r}, posix.O_WRONLY | posix.O_CREAT | posix.O_APPEND)\n"
        "posix.write(file, __name__.encode() + b'\\n')\nposix.close(file)\n"
    )
    names = {*sys.stdlib_module_names, *packages_distributions(), "usercustomize", "sitecustomize", "tutor"}
    for name in sorted(names - {*spare, "yellowiron"}):
        if name.isidentifier():
            (folder / f"{name}.py").write_text(source)
    if "yellowiron" not in spare:
        for package in ("yellowiron", "yellowiron/support", "yellowiron/cad"):
            (folder / package).mkdir()
            for name in ("__init__", "__main__", "cli", "guard"):
                (folder / package / f"{name}.py").write_text(source)
    (folder / "evil.pth").write_text(f"import {', '.join(('random', 'tutor'))}\n")
    info = folder / "tutor-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: tutor\nVersion: 1.0\n")
    groups = ("cad_formats", "engines", "exporters", "templates")
    (info / "entry_points.txt").write_text("".join(f"[yellowiron.{group}]\ntutor = tutor:it\n" for group in groups))
    return marker


def installation(folder: Path, *, editable: bool) -> Path:
    """An environment in which this package is installed, as pip leaves a wheel or an editable installation: the path
    of its command. Other packages are those of this environment."""
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    packages, programs = folder / "lib" / version / "site-packages", folder / "bin"
    packages.mkdir(parents=True)
    programs.mkdir()
    python = Path(os.path.realpath(sys.executable))
    (folder / "pyvenv.cfg").write_text(f"home = {python.parent}\ninclude-system-site-packages = false\n")
    for name in ("python", "python3", version):
        (programs / name).symlink_to(python)
    (packages / f"yellowiron-{yellowiron.__version__}.dist-info").mkdir()
    if editable:
        (packages / "_yellowiron.pth").write_text(f"{PACKAGE.parent}\n")
    else:
        shutil.copytree(PACKAGE, packages / "yellowiron", ignore=shutil.ignore_patterns("__pycache__"))
    others = [path for path in site.getsitepackages() if Path(path).is_dir()]
    lines = "".join(f"import site; site.addsitedir({path!r})\n" for path in others)
    (packages / "zz_others.pth").write_text(lines)
    command = programs / "yellowiron"
    shutil.copy(LAUNCHER, command)
    return command
