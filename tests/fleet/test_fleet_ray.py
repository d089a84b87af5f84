"""The same children on a Ray cluster: the same bytes, also where a node is killed half way."""

from __future__ import annotations

import threading
import time
from pathlib import Path
from typing import Any

import pytest

from kit.fleets import content, write_manifest
from yellowiron.fleet import RayRunner, batch


@pytest.fixture
def cluster(monkeypatch: pytest.MonkeyPatch) -> Any:
    """A head without cores and two nodes of one core each."""
    pytest.importorskip("ray", reason="ray is not installed: pip install 'yellowiron[fleet]'")
    import ray
    from ray.cluster_utils import Cluster

    made = Cluster(initialize_head=True, head_node_args={"num_cpus": 0, "include_dashboard": False})
    nodes = [made.add_node(num_cpus=1) for _ in range(2)]
    yield made, nodes
    ray.shutdown()
    made.shutdown()


@pytest.mark.slow
def test_two_nodes_of_which_one_is_killed_give_the_same_bytes(tmp_path: Path, inputs: Path, cluster: Any) -> None:
    machines = [{"cad": "in/small.glb", "id": f"m{n}"} for n in range(6)]
    manifest = write_manifest(tmp_path, [*machines, {"cad": "in/empty.step"}])
    batch(manifest, tmp_path / "here", jobs=2)
    made, nodes = cluster
    ended: list[str] = []

    over = threading.Event()

    def kill() -> None:
        while not ended and not over.wait(0.05):
            pass
        time.sleep(0.3)
        made.remove_node(nodes[1], allow_graceful=False)

    killer = threading.Thread(target=kill)
    killer.start()
    try:
        fleet = batch(
            manifest, tmp_path / "there", runner=RayRunner(made.address), told=lambda one, *_: ended.append(one.id)
        )
    finally:
        over.set()
        killer.join()
    assert sorted(ended) == sorted(row["id"] for row in fleet.rows)
    assert content(tmp_path / "there") == content(tmp_path / "here")


@pytest.mark.slow
def test_a_cluster_that_is_not_there_is_one_sentence(tmp_path: Path, inputs: Path) -> None:
    pytest.importorskip("ray", reason="ray is not installed: pip install 'yellowiron[fleet]'")
    from yellowiron.model.errors import YellowironError

    manifest = write_manifest(tmp_path, [{"cad": "in/small.glb", "id": "one"}])
    with pytest.raises(YellowironError, match="is not reached"):
        batch(manifest, tmp_path / "out", runner=RayRunner("127.0.0.1:1"))


def test_without_ray_there_is_a_hint(tmp_path: Path, inputs: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import sys

    from yellowiron.model.errors import YellowironError

    monkeypatch.setitem(sys.modules, "ray", None)
    manifest = write_manifest(tmp_path, [{"cad": "in/small.glb", "id": "one"}])
    with pytest.raises(YellowironError) as error:
        batch(manifest, tmp_path / "out", runner=RayRunner())
    assert "Ray is not installed" in error.value.message
    assert "yellowiron[fleet]" in error.value.hint
