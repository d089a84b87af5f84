"""An inertia of their own of hinges in loops: which have one, and that no lever feels more of it than it may."""

from __future__ import annotations

import numpy as np
import pytest
from planar_zbar import sketch, strokes, zbar_mechanism

from yellowiron.kinematics import ClosedChain, complete
from yellowiron.kinematics.steadying import SHARE
from yellowiron.model.mechanism import Mechanism


@pytest.fixture(scope="module")
def machine() -> Mechanism:
    return complete(_whole())


def _whole() -> Mechanism:
    drawing = sketch()
    return zbar_mechanism(drawing, strokes(drawing))


def test_hinges_of_rods_and_links_have_one(machine: Mechanism) -> None:
    """Not what drives move, cuts, or the hinge that a cylinder's nearer half turns on."""
    given = {j.name for j in machine.joints if j.armature}
    looped = {name for loop in machine.loops for name in loop.joints}
    nearer = {machine.joint(c.slide).body0 for c in machine.cylinders}
    assert given == {
        j.name
        for j in machine.joints
        if j.type == "revolute" and j.name in looped and not j.cut and j.drive is None and j.body1 not in nearer
    }
    assert given


def test_none_adds_more_to_what_a_lever_moves_than_its_share(machine: Mechanism) -> None:
    chain = ClosedChain(machine)
    moved = np.diag(chain.masses(chain.drawn)[0])
    tangents = chain.tangents(chain.drawn)
    most = 0.0
    for joint in machine.joints:
        rates = np.array([chain.rate(chain.drawn, joint.name, t) for t in tangents.T]) if joint.armature else 0.0
        most = max(most, float(np.max(joint.armature * rates**2 / moved)))
    assert 0.05 * SHARE < most <= SHARE * (1.0 + 1e-9)


def test_what_has_no_loop_has_none() -> None:
    whole = _whole()
    tree = complete(
        Mechanism(
            name="tree", equipment_type="test", root=whole.root,
            bodies=tuple(b for b in whole.bodies if b.name in {whole.root, *(j.body1 for j in whole.joints[:1])}),
            joints=whole.joints[:1],
        )
    )  # fmt: skip
    assert not any(j.armature for j in tree.joints)
