"""A scheduler on a Ray cluster: the same child process, inside of a Ray task.

A node needs yellowiron installed and the inputs in reach (a shared folder, or addresses). Results come back through Ray
and are put into their place by who runs the batch: nothing else has to be shared. A task whose worker or node dies is
run again elsewhere.
"""

from __future__ import annotations

import io
import os
import socket
import tarfile
import tempfile
import time
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

from yellowiron.fleet.attending import Child, finished, installed
from yellowiron.fleet.child import item_from
from yellowiron.fleet.places import Store, staged
from yellowiron.fleet.pool import Work
from yellowiron.fleet.values import Item, Outcome
from yellowiron.model.errors import OutputError, YellowironError

_LOOK_S = 0.02
_WAIT_S = 0.5
_KNOCK_S = 10.0
_RETRIES = 5
"""So many times a task is run again whose worker or node has died."""
_AHEAD = 2
"""Tasks that wait for each core of the cluster: enough to keep it busy, and few results under way."""
_THREADS = ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS")
"""Ray sets these for its workers; sums in other orders would be other bytes."""

Packed = tuple[dict[str, Any], bytes]


class RayRunner:
    """Runs items as tasks of a Ray cluster at `address` ("": one is started here, and ended); `jobs` at once (default:
    as many as it has cores)."""

    def __init__(self, address: str = "", *, jobs: int | None = None) -> None:
        self.address = address
        self.jobs = jobs

    def __call__(self, work: Work, store: Store) -> Iterator[Outcome]:
        """Runs them; see `pool.Runner`. `YellowironError` where Ray is not installed or the cluster not reached."""
        ray = _ray()
        started = not ray.is_initialized()
        if started:
            _knock(self.address)
            try:
                ray.init(address=self.address or None, num_cpus=None if self.address else self.jobs,
                         include_dashboard=False, log_to_driver=False, logging_level="ERROR")  # fmt: skip
            except Exception as error:
                raise _unreached(self.address, str(error).splitlines()[0][:200]) from error
        running: dict[Any, Item] = {}
        try:
            task = ray.remote(num_cpus=1, max_retries=_RETRIES)(run_task)
            threads = {name: os.environ.get(name) for name in _THREADS}
            waiting = list(reversed(work))
            while waiting or running:
                while waiting and len(running) < self._most(ray):
                    item, key = waiting.pop()
                    running[task.remote(asdict(item), key, threads)] = item
                ready, _ = ray.wait(list(running), num_returns=1, timeout=_WAIT_S)
                for reference in ready:
                    yield _told(ray, reference, running.pop(reference), store)
        finally:
            for reference in running:
                ray.cancel(reference, force=True)
            if started:
                ray.shutdown()

    def _most(self, ray: Any) -> int:
        """Tasks under way at once: what the cluster has now, as nodes come and go."""
        return self.jobs or _AHEAD * max(1, int(ray.cluster_resources().get("CPU", 1)))


def _knock(address: str) -> None:
    """`YellowironError` at once where nobody answers at an address: Ray itself would wait for minutes."""
    host, _, port = address.rpartition("://")[2].rpartition(":")
    if not (host and port.isdecimal()):
        return
    try:
        socket.create_connection((host, int(port)), timeout=_KNOCK_S).close()
    except OSError as error:
        raise _unreached(address, error.strerror or str(error)) from error


def _unreached(address: str, why: str) -> YellowironError:
    hint = "`ray status` on its head says how it is; --address HOST:6379."
    return YellowironError(f"The Ray cluster is not reached: {why}", where=address or "here", hint=hint)


def _ray() -> Any:
    try:
        import ray
    except ImportError as error:
        hint = "pip install 'yellowiron[fleet]', there and on the cluster's nodes."
        raise YellowironError("Ray is not installed", where="--engine ray", hint=hint) from error
    return ray


def _told(ray: Any, reference: Any, item: Item, store: Store) -> Outcome:
    """The outcome of a task that has ended, its result put into its place."""
    try:
        told, packed = ray.get(reference)
    except Exception as error:  # noqa: BLE001 - whatever Ray says of this task, the others go on
        said = f"Its Ray task was lost, {_RETRIES} times over: {type(error).__name__}"
        return Outcome(item.id, "killed", said, item.cad, "--resume runs it again.")
    outcome = Outcome(**told)
    place = store.staging() / staged(item.id)
    try:
        place.mkdir(parents=True, exist_ok=True)
        with tarfile.open(fileobj=io.BytesIO(packed)) as archive:
            archive.extractall(place, filter="data")
        return installed(place / "new", item, outcome, store)
    except (OSError, tarfile.TarError) as error:
        return Outcome(item.id, "disk", f"The disk does not take it: {error}", item.id, "Make room there.")
    finally:
        store.clear([item.id])


def run_task(item: dict[str, Any], key: str, threads: dict[str, str | None]) -> Packed:
    """In a Ray worker: runs an item's child to its end; its outcome, and its folder packed."""
    for name, value in threads.items():
        if value is None:
            os.environ.pop(name, None)
        else:
            os.environ[name] = value
    with tempfile.TemporaryDirectory(prefix="yellowiron-fleet-") as staging:
        made = item_from(item)
        try:
            child = Child.start(made, key, Path(staging))
        except OutputError as error:
            outcome = Outcome(made.id, "disk", error.message, made.id, error.hint)
            return asdict(outcome), b""
        try:
            while (ended := child.ended()) is None:
                time.sleep(_LOOK_S)
        finally:
            child.end()
        content = io.BytesIO()
        with tarfile.open(fileobj=content, mode="w") as archive:
            archive.add(finished(child, ended), arcname="new")
        return asdict(ended), content.getvalue()
