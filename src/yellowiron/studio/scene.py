"""What the page draws: every part's shape once, then for each state where the parts are and how they move."""

from __future__ import annotations

from typing import Any

import numpy as np

from yellowiron import kinematics
from yellowiron.model.assembly import Assembly
from yellowiron.report.html.packing import Binary, largest, mesh_entry, packed
from yellowiron.report.html.viewer import assignment_entry, drawn_part, machine_entry
from yellowiron.studio.session import State

MOST_TRIANGLES = 4_000_000
"""Distinct triangles that are drawn; the smallest shapes beyond are not, and the page says so."""
_NOWHERE = {"name": "", "color": [150, 150, 146]}
"""The body of parts that are in none."""


class Scene:
    """A CAD model as the page draws it."""

    def __init__(self, assembly: Assembly) -> None:
        wanted = list(dict.fromkeys(part.shape for part in assembly.parts))
        self._numbers = largest(assembly, wanted, most=MOST_TRIANGLES)
        binary = Binary()
        header = {
            "shapes": [mesh_entry(assembly.shapes[key].mesh, binary) for key in self._numbers],
            "leftOut": sum(part.shape not in self._numbers for part in assembly.parts),
            "tables": [],
        }
        self.shapes = packed(header, binary)

    def machine(self, state: State) -> bytes:
        """A state for the page: `packed`, without shapes. Parts are in the order of the CAD model, so that one keeps
        its number; the last body is that of parts in none."""
        binary = Binary()
        entry = self._mechanism(state, binary)
        bodies = [*entry["bodies"], _NOWHERE]
        number = {body["name"]: index for index, body in enumerate(bodies)}
        assigned = {a.part: a for a in state.alignment.parts}
        review = set(state.alignment.to_review)
        frame = np.asarray(state.alignment.frame, dtype=np.float64)
        parts = []
        for part in state.assembly.parts:
            if part.shape not in self._numbers:
                continue
            said = assigned.get(part.id)
            parts.append(
                {
                    **drawn_part(part, state.assembly, frame, self._numbers[part.shape]),
                    "body": number.get((said.body or "") if said else "", len(bodies) - 1),
                    **assignment_entry(said, review=part.id in review),
                    "source": said.source if said else "",
                }
            )
        return packed({**entry, "bodies": bodies, "parts": parts, "shapes": [], "version": state.version}, binary)

    def _mechanism(self, state: State, binary: Binary) -> dict[str, Any]:
        if state.solved is not None:
            mechanism = state.solved.mechanism
            return machine_entry(mechanism, kinematics.pose_tables(mechanism), binary, poses=state.poses)
        bodies = sorted({a.body for a in state.alignment.parts if a.body})
        hues = np.linspace(0.0, 2.0 * np.pi, len(bodies), endpoint=False)
        shades = [[int(150 + 80 * np.cos(h + k)) for k in (0.0, 2.1, 4.2)] for h in hues]
        still: dict[str, Any] = dict.fromkeys(("joints", "tables", "sliders", "readouts", "sensors", "sites", "poses"))
        return {
            "root": bodies[0] if bodies else "",
            "bodies": [{"name": b, "color": c} for b, c in zip(bodies, shades, strict=True)],
            **{key: [] for key in still},
        }
