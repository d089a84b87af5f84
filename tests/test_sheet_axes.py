"""The example's excavator without two of its pins, their axes guessed: its own sheet puts them back."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from kit.builds import MadeOnce, read_once
from yellowiron import kinematics, library, specs
from yellowiron.mechanism import build_mechanism
from yellowiron.model.rows import expand
from yellowiron.model.template import choose
from yellowiron.stages import find_roles, on_sheet
from yellowiron.support.vectors import triple

OFF = {"boom2arm_joint": (0.05, 0.0, 0.03), "arm2bucket_joint": (-0.03, 0.0, 0.06)}
"""By what the guesses are off, machine frame, metres."""


@pytest.mark.slow
def test_guessed_axes_are_placed_by_the_machines_own_sheet(root: Path, made_once: MadeOnce) -> None:
    example = root / "examples" / "excavator"
    template = library.load_template("excavator")
    sheet = specs.extract(template, [example / "specifications.pdf"])
    assembly, alignment = find_roles(read_once(example / "excavator.step", made_once), template, sheet)
    chosen = expand(choose(template, alignment.choices), alignment.counts)
    true = build_mechanism(assembly, chosen, alignment, sheet, name="true")
    back = np.linalg.inv(alignment.frame)

    def in_cad(point: np.ndarray) -> np.ndarray:
        return back[:3, :3] @ point + back[:3, 3]

    way = {j: back[:3, :3] @ np.array(true.joint(j).axis) for j in OFF}
    axes = {j: (triple(in_cad(np.array(true.joint(j).anchor) + np.array(by))), triple(way[j])) for j, by in OFF.items()}
    lost = {p.part for p in alignment.parts if p.role in ("arm_pin", "bucket_pin")}
    assert len(lost) >= 2
    kept = tuple(p for p in alignment.parts if p.part not in lost)
    guessed = replace(alignment, parts=kept, axes=axes, across=dict.fromkeys(OFF, 0.06))
    without = replace(assembly, parts=tuple(p for p in assembly.parts if p.id not in lost))
    placed, findings = on_sheet(without, chosen, guessed, sheet)
    assert [f.code for f in findings] == ["KIN013", "KIN013"]
    for joint in OFF:
        delta = np.array(placed.axes[joint][0]) - in_cad(np.array(true.joint(joint).anchor))
        # Within two centimetres the bores that both bodies have are found again.
        assert np.linalg.norm(delta - (delta @ way[joint]) * way[joint]) < 0.021
        assert placed.across[joint] < 0.02
    found = build_mechanism(without, chosen, placed, sheet, name="found")
    roles = {m.name: m.role for m in kinematics.measure(kinematics.calibrate(found))}
    assert {roles["Boom Length"], roles["Arm Length"], roles["Maximum Reach"]} == {"calibrated"}
    assert roles["Overall Width"] == "checked"
