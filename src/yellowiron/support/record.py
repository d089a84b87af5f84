"""What several writers of a machine say alike: the record that a build leaves on the prims of its file, beside what USD
has words for (`usd.authoring.metadata`), and how MuJoCo is to solve it, in MJCF and in a scene for Newton."""

from __future__ import annotations

from yellowiron.model.mechanism import Mechanism

RECORD = "yellowiron"
"""The key of that record in a prim's `customData`."""

ENDLESS = 1e9
"""Degrees: a pivot's limit that is none. PhysX couples pivots only where both have finite ones, and takes these: wheels
on one chain followed each other over many turns."""

DETAIL, DETAILS = "Detail", ("full", "light", "visual")
"""The variant set of a machine's colliders, in its file and in what is exported of it: all of them, which is selected,
few and simple ones, or none."""
COLLIDING = DETAILS[:2]
"""Those that have colliders."""

BRAKE_GIVES = 0.002
"""Radians (metres of a slide) by which a brake that is a spring gives before it slips."""

CATCHING_UP = 1.05
"""Of its rated speed: so fast may go what follows a target that moves at it."""

CONE = "elliptic"
IMPRATIO = 1000.0
"""Friction is so many times as hard as what holds bodies apart, else what stands with its brakes set creeps downhill:
loader and excavator on 20° by 2.0 and 3.7 mm/s in MuJoCo; so by 0.007 and 0.006, at the same cost."""
INTEGRATOR = "Euler"
"""Closes the loops a hundred times better than `implicitfast`: that one adds the drives' damping to the mass matrix for
the step alone, after the constraint forces were found without it (wheel loader at rest: 0.0004 against 0.05 mm)."""
FREE_INTEGRATOR = "implicitfast"
"""… which machines without loops or couplings have: nothing is to be held closed, and hinges in a row, each driven for
the mass it moves while the others stand, are unstable with `Euler` where that is many times the mass it moves alone."""
SCRUBS: dict[str, tuple[float, ...]] = {"solref": (-1e4, -10.0), "solimp": (0.5, 0.5, 0.001, 0.5, 2.0)}
"""A contact that slides all the time: stiffness (1/s²) and damping (1/s), 16 Hz with a twentieth of critical damping,
and an impedance of a half. A wheel sinks by less than 1 mm. MuJoCo's contact takes sliding for approaching: what slides
at v is lifted by friction × v × damping / stiffness. With its own 20 ms, critically damped, a tyre at 0.3 m/s leaves
the ground and lands again, and a skid steer turns half as far as dry friction lets it (13° of 28°; so 26°)."""


def integrator_of(mechanism: Mechanism) -> str:
    """MuJoCo's name of the integrator that suits a machine."""
    held = any(joint.cut or joint.follows is not None for joint in mechanism.joints)
    return INTEGRATOR if held else FREE_INTEGRATOR
