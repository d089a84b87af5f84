"""Joints that robot descriptions declare: USD physics, MJCF with closed loops, URDF."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from kit.machines import small_machine
from yellowiron.cad import read_cad
from yellowiron.exporters import export_mjcf
from yellowiron.model.assembly import Assembly
from yellowiron.model.mechanism import Mechanism
from yellowiron.usd import read_mechanism

pytestmark = pytest.mark.usefixtures("read_here")


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> tuple[Mechanism, Path]:
    file = small_machine.write(tmp_path_factory.mktemp("usd"))
    return read_mechanism(file), file


def check(read: Assembly, mechanism: Mechanism) -> None:
    """Every joint of the mechanism is there, between its bodies, at its place."""
    found = {j.name: j for j in read.joints}
    for joint in mechanism.joints:
        declared = found[joint.name]
        assert declared.bodies == (joint.body0, joint.body1)
        closes = declared.type == "spherical" and joint.cut
        assert declared.type == joint.type or closes
        beside = np.cross(np.subtract(declared.anchor, joint.anchor), joint.axis)
        assert np.linalg.norm(beside) < 1e-5
        assert closes or np.linalg.norm(np.cross(declared.axis, joint.axis)) < 1e-6
        if joint.lower is not None and not joint.cut:
            assert (declared.lower, declared.upper) == pytest.approx((joint.lower, joint.upper), abs=1e-6)
    links = read.links()
    assert set(links) == {b.name for b in mechanism.bodies}
    assert sum(map(len, links.values())) == len(read.parts)


def test_usd(written: tuple[Mechanism, Path]) -> None:
    mechanism, file = written
    check(read_cad(file), mechanism)


def test_mjcf(written: tuple[Mechanism, Path], tmp_path: Path) -> None:
    mechanism, file = written
    read = read_cad(export_mjcf(mechanism, file, tmp_path))
    check(read, mechanism)
    assert [j.type for j in read.joints if j.name == "boom_joint"] == ["spherical"]
    assert [j.bodies for j in read.joints if j.type == "free"] == [("", "frame")]


def test_urdf_meshes_without_their_package(tmp_path: Path) -> None:
    (tmp_path / "block.stl").write_text(
        "solid b\n"
        + "".join(
            f"facet normal 0 0 0\nouter loop\n{v}endloop\nendfacet\n"
            for v in ("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n", "vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\n")
        )
        + "endsolid b\n"
    )
    (tmp_path / "robot.urdf").write_text(
        '<robot name="r"><link name="a"><visual><geometry><mesh filename="package://some_robot/meshes/block.stl"/>'
        "</geometry></visual></link></robot>"
    )
    assert len(read_cad(tmp_path / "robot.urdf").parts) == 1
