"""What the operating system bounds: a process's memory, processor time and life.

| | Linux | macOS | Windows |
|---|---|---|---|
| process groups, processor time, no core dumps | yes | yes | no |
| memory (`RLIMIT_AS`) | yes | no: the kernel does not enforce it, and refuses values below what a process maps | no |
| a child ends with its parent (`prctl`) | yes | no | no |

Importing this works everywhere; `require_supported_platform` says where it is needed that a system is missing.
"""

from __future__ import annotations

import contextlib
import ctypes
import math
import os
import signal
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import IO

from yellowiron.model.errors import YellowironError

try:
    import fcntl
    import resource
except ImportError:  # not on Windows
    fcntl = resource = None  # type: ignore[assignment]

_PR_SET_PDEATHSIG = 1
"""linux/prctl.h."""
_SOON = 1e-3
"""Seconds of an outer timer that has run out; 0 would stop it."""


def require_supported_platform() -> None:
    """`YellowironError` on a system without POSIX processes and limits, such as Windows."""
    if sys.platform in ("win32", "cygwin") or resource is None:
        raise YellowironError(
            "yellowiron runs on Linux and macOS: it reads files in child processes with limits, "
            "which this system does not have",
            where=sys.platform,
            hint="On Windows use WSL, the Windows Subsystem for Linux (wsl --install), and run it there.",
        )


def limit_memory(megabytes: int) -> None:
    """Bounds this process's address space, where the system can."""
    if resource is not None and sys.platform != "darwin":
        limit = megabytes * 1024 * 1024
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


def limit_files(megabytes: int) -> None:
    """Bounds every file that this process writes: an archive may unpack to more than the disk has."""
    if resource is not None:
        limit = min(megabytes * 1024 * 1024, int(min(largest_file(), 2**62)))
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, resource.getrlimit(resource.RLIMIT_FSIZE)[1]))


def memory_in_use(process: int) -> float:
    """Megabytes of memory that a process, and those that it has started, have in use; 0 where the system does not say
    (it does on Linux)."""
    try:
        pages = int(Path(f"/proc/{process}/statm").read_text(encoding="ascii").split()[1])
        started = Path(f"/proc/{process}/task/{process}/children").read_text(encoding="ascii").split()
    except (OSError, ValueError, IndexError):
        return 0.0
    return pages * os.sysconf("SC_PAGE_SIZE") / 2**20 + sum(memory_in_use(int(child)) for child in started)


def largest_file() -> float:
    """Bytes that a file written by this process may have."""
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)[0] if resource is not None else -1
    return math.inf if limit < 0 else limit


def lock(file: IO[str]) -> bool:
    """Whether no other process holds this file; this one then does, until it closes it or ends. `OSError` where the
    file system has no locks."""
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def leave_no_core() -> None:
    """No core dump of this process, however it ends."""
    if resource is not None:
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def die_with_parent(parent: int) -> None:
    """Asks the kernel to end this process when its parent ends, however that ends (Linux; elsewhere it may linger).
    Where it has ended before it could be asked, and this process is another's now, it ends here."""
    with contextlib.suppress(AttributeError, OSError):
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(os.EX_UNAVAILABLE)


@contextlib.contextmanager
def must_end(seconds: float) -> Iterator[None]:
    """Ends the process, a guarded child, where what is inside takes more than so many seconds of the processor: for
    readers that go round in a circle on some damage, and whose time is known from the file's size.

    By a timer, which counts from now, and not by `RLIMIT_CPU`, which counts since the process began: one that had
    worked for a quarter of an hour was twice ended there long before that."""
    if resource is None:
        yield
        return
    outer, _ = signal.getitimer(signal.ITIMER_PROF)
    begun = time.process_time()
    signal.setitimer(signal.ITIMER_PROF, min(seconds, outer or seconds))
    try:
        yield
    finally:
        left = max(outer - (time.process_time() - begun), _SOON) if outer else 0.0
        signal.setitimer(signal.ITIMER_PROF, left)
