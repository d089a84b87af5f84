"""Balls in sockets: a cylinder that hangs in a ball around its barrel is held there, and turns."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from kit.machines.solids import box, lathe, place, tube
from yellowiron.alignment.features.ball_joints import ball_fits_of, is_ball
from yellowiron.alignment.features.contacts import neighbours
from yellowiron.alignment.features.cylinders import cylinders_of
from yellowiron.alignment.features.solids import Ball, Solid, solids_of
from yellowiron.alignment.structure.contact_evidence import Contacts, evidence_of
from yellowiron.model.assembly import Assembly, Part

TOLERANCE = 4e-4
RADIUS = 0.1
"""Of the ball around the barrel."""
END = 0.75
"""Where the rod's ball is."""


def hung() -> dict[str, Solid]:
    """A barrel with a collar, its rod, a block that holds the collar, a stud at the rod's end; balls as features."""
    shapes = {
        "barrel": tube("barrel", 0.06, 0.05, 0.6),
        "rod": lathe("rod", [(0.0, 0.0), (0.03, 0.0), (0.03, 0.55), (0.0, 0.55)]),
        "saddle": box("saddle", 0.3, 0.3, 0.1),
        "stud": tube("stud", 0.02, 0.0, 0.2),
    }
    at = {"barrel": (0.0, 0.0, -0.3), "rod": (0.0, 0.0, 0.2), "saddle": (0.15, 0.0, 0.0), "stud": (0.0, -0.2, END)}
    along = {"stud": (0.0, 1.0, 0.0)}
    parts = tuple(Part(n, n, ("A",), n, place(at[n], along.get(n, (0.0, 0.0, 1.0)))) for n in shapes)
    found = {s.part.id: s for s in solids_of(Assembly("a", "synthetic", 1.0, parts, shapes))}
    balls = {
        "barrel": Ball(np.zeros(3), RADIUS, False),
        "saddle": Ball(np.zeros(3), 1.002 * RADIUS, True),
        "stud": Ball(np.array([0.0, 0.0, END]), 0.05, False),
        "rod": Ball(np.array([0.0, 0.0, END]), 0.0501, True),
    }
    return {name: _with(solid, balls[name]) for name, solid in found.items()}


def _with(solid: Solid, ball: Ball) -> Solid:
    return replace(solid, balls=(ball,))


def test_a_cylinder_on_balls_hangs_on_them() -> None:
    solids = tuple(hung().values())
    (found,) = cylinders_of(solids, TOLERANCE, fixed=True)
    assert not found.fixed
    bare = tuple(_with(s, Ball(np.array([1.0, 1.0, 1.0]), 0.01, False)) for s in hung().values())
    (ram,) = cylinders_of(bare, TOLERANCE, fixed=True)
    assert ram.fixed


def test_the_ball_around_a_barrel_turns_across_it() -> None:
    """As the pins of a gimbal lie; and it is no bush that stays in its bore."""
    by_name = hung()
    solids = tuple(by_name.values())
    fits = ball_fits_of(solids, TOLERANCE)
    collar = next(f for f in fits if f.inner == by_name["barrel"].index)
    assert abs(collar.shaft.direction[2]) < 1e-9 and is_ball(collar, by_name["barrel"])
    cylinders = cylinders_of(solids, TOLERANCE)
    near = neighbours(solids, TOLERANCE)
    contacts = Contacts(solids, fits, [], [], cylinders, [], near, lambda a, b: False, TOLERANCE)
    evidence = evidence_of(contacts)
    pair = (by_name["barrel"].index, by_name["saddle"].index)
    assert pair in {(f.inner, f.outer) for _, f in evidence.direct}
    assert pair not in evidence.pressed
