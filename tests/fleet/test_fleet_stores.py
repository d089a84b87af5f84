"""Inputs and results anywhere that fsspec reaches: memory, and S3 from a server of its own."""

from __future__ import annotations

import socket
import subprocess
import sys
import time
import uuid
from collections.abc import Iterator
from pathlib import Path

import pytest

from kit.fleets import SETTINGS
from yellowiron.fleet import batch, planned
from yellowiron.fleet.places import fetched, joined, read_address, store_at
from yellowiron.model.errors import OutputError, YellowironError


def test_addresses_are_joined_as_paths_are() -> None:
    assert joined("/a/b", "c/d.step") == "/a/b/c/d.step"
    assert joined("/a/b", "../d.step") == "/a/d.step"
    assert joined("s3://bucket/x", "c.step") == "s3://bucket/x/c.step"
    assert joined("/a", "s3://bucket/c.step") == "s3://bucket/c.step"
    assert joined("s3://bucket/x", "/types/mine") == "/types/mine"


def test_a_store_elsewhere_is_whole_or_absent(tmp_path: Path) -> None:
    pytest.importorskip("fsspec")
    address = f"memory://{uuid.uuid4().hex}"
    store = store_at(address)
    for text in ("first", "second"):
        made = tmp_path / text
        (made / "machine").mkdir(parents=True)
        (made / "item.json").write_text(text)
        (made / "machine" / text).write_text(text)
        store.install(made, "items/a")
    assert store.read("items/a/item.json") == b"second"
    assert store.read("items/a/machine/second") == b"second"
    assert store.read("items/a/machine/first") is None
    assert store.read_all(["items/a/item.json", "items/none/item.json"]) == {"items/a/item.json": b"second"}
    assert fetched(f"{address}/items/a/item.json", tmp_path / "here").read_text() == "second"


def test_what_is_not_reached_is_one_sentence(tmp_path: Path) -> None:
    pytest.importorskip("fsspec")
    with pytest.raises(YellowironError, match="there is no such file"):
        fetched("memory://nothing/here.step", tmp_path)
    with pytest.raises(YellowironError, match="cannot be reached"):
        read_address("nosuch://a/b", what="The manifest", most=10)
    with pytest.raises(OutputError, match="cannot be reached"):
        store_at("nosuch://a/b")


@pytest.fixture
def bucket(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """The address of a bucket on an S3 server that runs beside the test."""
    pytest.importorskip("moto.server")
    boto3 = pytest.importorskip("boto3")
    pytest.importorskip("s3fs")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    code = f"from moto.server import main; main(['-H', '127.0.0.1', '-p', '{port}'])"
    server = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    endpoint = f"http://127.0.0.1:{port}"
    settings = {
        "AWS_ENDPOINT_URL": endpoint, "AWS_ACCESS_KEY_ID": "test", "AWS_SECRET_ACCESS_KEY": "test",
        "AWS_DEFAULT_REGION": "us-east-1",
    }  # fmt: skip
    for name, value in settings.items():
        monkeypatch.setenv(name, value)
    try:
        for _ in range(300):
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", port)) == 0:
                    break
            time.sleep(0.1)
        boto3.client("s3", endpoint_url=endpoint).create_bucket(Bucket="fleet")
        yield "s3://fleet"
    finally:
        server.kill()
        server.wait()


@pytest.mark.slow
def test_a_batch_from_s3_to_s3(bucket: str, inputs: Path, tmp_path: Path) -> None:
    import fsspec

    files = fsspec.filesystem("s3")
    files.put(str(inputs / "small.glb"), "fleet/in/small.glb")
    files.put(str(inputs / "other.glb"), "fleet/in/other.glb")
    files.pipe("fleet/in/empty.step", b"")
    lines = [
        f"defaults: {{type: {inputs / 'type'}, page: false, set: {SETTINGS}}}",
        "machines: [{cad: in/*.glb}, {cad: in/empty.step}]",
    ]
    pytest.importorskip("yaml")
    files.pipe("fleet/fleet.yaml", "\n".join(lines).encode())
    first = batch(f"{bucket}/fleet.yaml", f"{bucket}/out", jobs=2)
    assert {row["id"]: row["status"] for row in first.rows} == {"other": "short", "small": "short", "empty": "refused"}
    files.invalidate_cache()
    assert files.exists("fleet/out/items/small/machine/small.usda")
    assert files.exists("fleet/out/index.html")
    assert b"s3://fleet/in/small.glb" in files.cat_file("fleet/out/items/small/machine/inputs.json")
    assert not any(choice.run for choice in planned(f"{bucket}/fleet.yaml", f"{bucket}/out", resume=True)[2])
    # The same machine as from a folder here: places apart.
    here = tmp_path / "here.json"
    here.write_text(
        f'{{"machines": [{{"cad": "{inputs}/small.glb", "type": "{inputs}/type", "page": false, '
        f'"set": ["{SETTINGS[0]}", "{SETTINGS[1]}"]}}]}}'
    )
    batch(here, tmp_path / "out", jobs=1)
    for name in ("small.usda", "payloads/physics.usda", "report.json"):
        assert files.cat_file(f"fleet/out/items/small/machine/{name}") == (
            tmp_path / "out" / "items" / "small" / "machine" / name
        ).read_bytes()  # fmt: skip
    files.pipe("fleet/in/small.glb", files.cat_file("fleet/in/small.glb") + b"\0\0\0\0")
    files.invalidate_cache()
    again = planned(f"{bucket}/fleet.yaml", f"{bucket}/out", resume=True)[2]
    assert [choice.item.id for choice in again if choice.run] == ["small"]
