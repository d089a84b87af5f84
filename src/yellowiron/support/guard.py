"""Runs third-party readers and engines in a child process, so that a crash, a hang or a bomb there is an error message
here."""

from __future__ import annotations

import contextlib
import os
import pickle
import selectors
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from pkgutil import resolve_name
from typing import IO, Any, NoReturn, cast

from yellowiron.model.errors import YellowironError
from yellowiron.support import isolated, limits, plugins, stopping
from yellowiron.support.files import answers

_CRASH_HINT = "The file is damaged, or made to break its reader; open it in its own program and export it again."
_PACKAGE = Path(__file__).resolve().parent.parent
_RUN = "yellowiron.support.guard:run_child"
_BEAT = 1.0
"""Seconds between two signs of life."""
_LOOK = 0.02
"""Seconds between two looks at how much memory a child has taken."""
_LAST_WORDS = 65536


@dataclass(frozen=True)
class Wording:
    """How the errors of a guarded call speak: `who` did not do it, what took `late` so many seconds, and what to do."""

    who: str = "The reader"
    late: str = "Reading took more than"
    hint: str = _CRASH_HINT


READING = Wording()
"""Of a file's reader."""


def run_guarded(
    target: str,
    *args: Any,
    where: str,
    error: type[YellowironError] = YellowironError,
    timeout_s: float = 600.0,
    memory_mb: int | None = 8192,
    resident_mb: int | None = None,
    wording: Wording = READING,
    progress: Callable[[str], None] = lambda words: None,
) -> Any:
    """The result of `module:function` called with `args` in a child process; both travel by pickle.

    A `YellowironError` raised there is raised here. A crash, more than `timeout_s` seconds without a sign of life
    (`beat`; readers give none), more than `memory_mb` of address space or `resident_mb` of memory in use (Linux) raise
    `error`, naming `where`. `progress` is called with what the child says of itself. `YellowironError` on a system
    without the processes and limits that this takes (`yellowiron.support.limits` says which has what). The child
    imports from the installation alone (`yellowiron.support.isolated`).
    """
    limits.require_supported_platform()
    # A signal amid a start would keep Python's lock for imports, and leave a child that nobody attends.
    with stopping.shielded(), tempfile.TemporaryDirectory(prefix="yellowiron-") as folder:
        call, answer = Path(folder, "call"), Path(folder, "answer")
        life, told = os.pipe()
        with os.fdopen(life, "rb", buffering=0) as lives:
            with os.fdopen(told, "wb", buffering=0):
                call.write_bytes(pickle.dumps((target, args, memory_mb, str(answer), told)))
                child = subprocess.Popen(
                    child_command(_RUN, str(call)),
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.PIPE,
                    env=isolated.shielded(os.environ),
                    start_new_session=True,
                    pass_fds=(told,),
                )
            with child:
                try:
                    with stopping.exposed():
                        noise = _attend(child, lives, timeout_s, resident_mb, progress)
                except _GreedyError as greedy:
                    raise error(
                        f"{wording.who} needs more than {resident_mb} MB of memory for this file and was stopped",
                        where=where, hint="Split the file, if it is none that is made to fill the memory.",
                    ) from greedy  # fmt: skip
                except subprocess.TimeoutExpired as expired:
                    raise error(
                        f"{wording.late} {timeout_s:g} s and was stopped", where=where, hint=wording.hint
                    ) from expired
                finally:
                    # The whole group: a reader may have started processes of its own.
                    with contextlib.suppress(ProcessLookupError, PermissionError):
                        os.killpg(child.pid, signal.SIGKILL)
        if child.returncode == os.EX_IOERR and not answer.exists():
            raise error(
                f"What was read cannot be stored: {noise.decode(errors='replace')}",
                where=tempfile.gettempdir(),
                hint="Make room in the folder for temporary files, or set TMPDIR to another.",
            )
        if not answer.exists():
            raise error(_obituary(wording.who, child.returncode, noise), where=where, hint=wording.hint)
        try:
            kind, value = answers.loads(answer.read_bytes())
        except Exception as broken:  # what broke it may have been the file
            raise error(f"{wording.who} gave no answer that is one", where=where, hint=wording.hint) from broken
    if kind == "error" and isinstance(value, YellowironError):
        raise value
    if kind == "memory":
        raise error(f"{wording.who} needs more than {memory_mb} MB of memory", where=where, hint="Split the file.")
    if kind == "failure":
        raise error(f"{wording.who} failed: {value}", where=where, hint=wording.hint)
    return value


class _GreedyError(Exception):
    """A child that took more memory than it may."""


def _attend(
    child: subprocess.Popen[bytes],
    life: IO[bytes],
    timeout_s: float,
    resident_mb: int | None,
    progress: Callable[[str], None],
) -> bytes:
    """Waits for the child to end; what it wrote to its error output, the last of it. `TimeoutExpired` where it gave no
    sign of life for so long, `_GreedyError` where it took more memory."""
    noise, words, end = b"", b"", time.monotonic() + timeout_s
    with selectors.DefaultSelector() as streams:
        streams.register(cast(IO[bytes], child.stderr), selectors.EVENT_READ)
        streams.register(life, selectors.EVENT_READ)
        while streams.get_map():
            if (left := end - time.monotonic()) <= 0.0:
                raise subprocess.TimeoutExpired(child.args, timeout_s)
            if resident_mb is not None and limits.memory_in_use(child.pid) > resident_mb:
                raise _GreedyError
            for key, _ in streams.select(min(left, _LOOK) if resident_mb is not None else left):
                data = os.read(key.fd, 65536)
                if not data:
                    streams.unregister(key.fileobj)
                elif key.fileobj is life:
                    end = time.monotonic() + timeout_s
                    *lines, words = (words[-_LAST_WORDS:] + data).split(b"\n")
                    for line in filter(None, lines):
                        progress(line.decode(errors="replace"))
                else:
                    noise = (noise + data)[-_LAST_WORDS:]
    child.wait(max(0.0, end - time.monotonic()))
    return noise


_life: int | None = None
_last_beat = 0.0


def beat(words: str = "") -> None:
    """In a guarded child a sign of life, and words for its parent's `progress`; elsewhere nothing. Quick enough to be
    called at every step of a long work."""
    global _last_beat
    if _life is None:
        return
    now = time.monotonic()
    if words or now - _last_beat > _BEAT:
        _last_beat = now
        os.write(_life, f"{words}\n".encode())


def _obituary(who: str, returncode: int, noise: bytes) -> str:
    if returncode == -signal.SIGPROF:
        return f"{who} came to no end"
    if returncode < 0:
        name = signal.Signals(-returncode).name if -returncode in signal.valid_signals() else str(-returncode)
        return f"{who} crashed ({name})"
    lines = [line for line in noise.decode(errors="replace").splitlines() if line.strip()]
    detail = f": {lines[-1].strip()[:200]}" if lines else ""
    return f"{who} ended with code {returncode} and no result{detail}"


def child_command(target: str, call: str) -> list[str]:
    """The command of a child process that calls `module:function` with one text. It may import, behind what its
    interpreter's installation has, from the folder of this package and from those of packages that bring plugins. It
    ends with this process."""
    folders = [str(_PACKAGE.parent), *plugins.folders()]
    return [*isolated.interpreter(), isolated.__file__, str(_PACKAGE), str(os.getpid()), target, call, *folders]


def run_child(call: str) -> NoReturn:
    """Does what the file `call` asks for, writes the answer beside it and ends the process: a guarded child's work."""
    global _life
    target, args, memory_mb, answer, _life = pickle.loads(Path(call).read_bytes())
    if memory_mb is not None:
        limits.limit_memory(memory_mb)
        limits.limit_files(memory_mb)
    limits.leave_no_core()
    outcome: tuple[str, Any]
    try:
        outcome = ("value", resolve_name(target)(*args))
    except YellowironError as error:
        outcome = ("error", error)
    except MemoryError:
        outcome = ("memory", None)
    except Exception as error:  # noqa: BLE001 - whatever a third-party reader throws becomes one sentence in the parent
        outcome = ("failure", f"{type(error).__name__}: {error}"[:500])
    part = Path(f"{answer}.part")
    try:
        part.write_bytes(answers.dumps(outcome))
        part.rename(answer)
    except OSError as error:
        sys.stderr.write(str(error.strerror))
        sys.stderr.flush()
        os._exit(os.EX_IOERR)
    # Past this point only library teardown could run, and that is where some readers crash.
    os._exit(0)
