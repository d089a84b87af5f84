"""Runs a third-party reader in a child process, so that a crash, a hang or a bomb there is an error message here."""

from __future__ import annotations

import contextlib
import importlib
import os
import pickle
import resource
import signal
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from yellowiron.model.errors import YellowironError

_PR_SET_PDEATHSIG = 1
"""linux/prctl.h."""
_CRASH_HINT = "The file is damaged, or made to break its reader; open it in its own program and export it again."


def run_guarded(
    target: str,
    *args: Any,
    where: str,
    error: type[YellowironError] = YellowironError,
    timeout_s: float = 600.0,
    memory_mb: int = 8192,
) -> Any:
    """The result of `module:function` called with `args` in a child process; both travel by pickle.

    A `YellowironError` raised there is raised here. A crash, more than `timeout_s` seconds or more than `memory_mb` of
    address space raise `error`, naming `where`.
    """
    with tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
        call, answer = Path(folder, "call"), Path(folder, "answer")
        call.write_bytes(pickle.dumps((target, args, memory_mb, str(answer))))
        # The parent's import path goes along, so that a source checkout works as an installation does.
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
        child = subprocess.Popen(
            [sys.executable, "-m", "yellowiron.guard", str(call)],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            env=environment,
            start_new_session=True,
        )
        try:
            _, noise = child.communicate(timeout=timeout_s)
        except subprocess.TimeoutExpired as expired:
            raise error(
                f"Reading took more than {timeout_s:g} s and was stopped", where=where, hint=_CRASH_HINT
            ) from expired
        finally:
            # The whole group: a reader may have started processes of its own.
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(child.pid, signal.SIGKILL)
            child.wait()
        if child.returncode == os.EX_IOERR and not answer.exists():
            raise error(
                f"What was read cannot be stored: {noise.decode(errors='replace')}",
                where=tempfile.gettempdir(),
                hint="Make room in the folder for temporary files, or set TMPDIR to another.",
            )
        if not answer.exists():
            raise error(_obituary(child.returncode, noise), where=where, hint=_CRASH_HINT)
        kind, value = pickle.loads(answer.read_bytes())
    if kind == "error":
        raise value
    if kind == "memory":
        raise error(f"Reading needs more than {memory_mb} MB of memory", where=where, hint="Split the file.")
    if kind == "failure":
        raise error(f"The reader failed: {value}", where=where, hint=_CRASH_HINT)
    return value


def _obituary(returncode: int, noise: bytes) -> str:
    if returncode < 0:
        name = signal.Signals(-returncode).name if -returncode in signal.valid_signals() else str(-returncode)
        return f"The reader crashed ({name})"
    lines = [line for line in noise.decode(errors="replace").splitlines() if line.strip()]
    detail = f": {lines[-1].strip()[:200]}" if lines else ""
    return f"The reader ended with code {returncode} and no result{detail}"


def _die_with_parent() -> None:
    """Asks the kernel to end this process when its parent ends, however that ends (Linux; elsewhere it may linger)."""
    import ctypes

    with contextlib.suppress(AttributeError, OSError):
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


def _child(call: Path) -> None:
    _die_with_parent()
    target, args, memory_mb, answer = pickle.loads(call.read_bytes())
    limit = memory_mb * 1024 * 1024
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    module_name, function_name = target.split(":")
    outcome: tuple[str, Any]
    try:
        outcome = ("value", getattr(importlib.import_module(module_name), function_name)(*args))
    except YellowironError as error:
        outcome = ("error", error)
    except MemoryError:
        outcome = ("memory", None)
    except Exception as error:  # noqa: BLE001 - whatever a third-party reader throws becomes one sentence in the parent
        outcome = ("failure", f"{type(error).__name__}: {error}"[:500])
    part = Path(f"{answer}.part")
    try:
        part.write_bytes(pickle.dumps(outcome))
        part.rename(answer)
    except OSError as error:
        sys.stderr.write(str(error.strerror))
        sys.stderr.flush()
        os._exit(os.EX_IOERR)
    # Past this point only library teardown could run, and that is where some readers crash.
    os._exit(0)


if __name__ == "__main__":
    _child(Path(sys.argv[1]))
