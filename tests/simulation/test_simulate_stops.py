"""Ends of stroke hold in every engine what is heavier than a cylinder's push; what stands is driven all at once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from in_engines import EVERY, load
from pxr import Usd

from kit.machines import small_machine
from yellowiron.kinematics import ClosedChain
from yellowiron.simulation.commands import Phase
from yellowiron.simulation.engine import Setup, tell
from yellowiron.simulation.payload import with_payload
from yellowiron.simulation.strokes.standing import falls_over
from yellowiron.usd import read_mechanism
from yellowiron.usd.layers.mujoco import STOP

GIVES = 0.01
"""Metres: MuJoCo's stop gives way by 6 mm to it."""
LOAD = 120e3
"""Newtons on the bucket: three times what the lift cylinder holds."""


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_machine.write(tmp_path_factory.mktemp("stops"))


def test_newton_s_layer_says_how_stops_are(file: Path) -> None:
    mechanism = read_mechanism(file)
    stage = Usd.Stage.Open(str(file))
    stops = {p.GetName() for p in stage.Traverse() if p.GetAttribute("mjc:solreflimit").HasAuthoredValue()}
    assert stops == {j.name for j in mechanism.joints if j.lower is not None and not j.cut}
    assert "slide" in stops and "front_wheel_l_joint" not in stops
    (slide,) = (p for p in stage.Traverse() if p.GetName() == "slide")
    assert tuple(slide.GetAttribute("mjc:solreflimit").Get()) == STOP


@pytest.mark.parametrize("engine", EVERY)
def test_a_load_stops_at_the_end_of_a_stroke(file: Path, engine: str) -> None:
    mechanism = read_mechanism(file)
    step = 1.0 / 240.0 if engine == "physx" else 0.001
    lower = mechanism.joint("slide").lower
    assert lower is not None
    loaded = load(engine, Setup(file, mechanism, "fixed", step, ("slide",)))
    try:
        states = []
        for number in range(round(3.0 / step)):
            tell(loaded, {"slide": lower * min(1.0, number * step)})
            pushed = loaded.read([loaded.state()])
            boom = [body.name for body in mechanism.bodies].index("boom")
            arm = np.array([2.9, 0.0, 1.5]) - np.asarray(mechanism.body("boom").origin)
            point = pushed.rotations[0, boom] @ arm + pushed.origins[0, boom]
            loaded.push("boom", np.array([0.0, 0.0, -LOAD * min(1.0, number * step)]), point)
            loaded.step()
            states.append(loaded.state())
        ended = loaded.read(states[-1:]).coordinates[0, 0]
    finally:
        loaded.close()
    assert ended == pytest.approx(lower, abs=GIVES)


def test_what_stands_is_driven_together(file: Path) -> None:
    """Its empty bucket raised and lowered, the small loader stands throughout; with what tips it as drawn nobody
    asks."""
    mechanism = read_mechanism(file)
    ends = {"slide": np.linspace(-0.1, 0.3, 50)}
    for payload in (0.0, 1e5):
        heavy = with_payload(mechanism, payload)
        assert falls_over(heavy, ClosedChain(heavy), Phase("together", ends, ())) is None
