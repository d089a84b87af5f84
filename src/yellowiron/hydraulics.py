"""The oil between levers and cylinders: valves that open over time, one pump's flow shared, the engine's power, relief.

    hydraulics = Hydraulics(read_mechanism("out/excavator/excavator.usda"))
    targets = hydraulics.step({"boom": 0.6, "bucket": -1.0}, strokes, 0.001, forces=forces)

Every engine's position drives can be told the targets; numpy and a machine's mechanism are all that it needs. SI.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Actuator, Mechanism
from yellowiron.model.specification import fold

SPOOL = 0.5
"""Seconds from a closed valve to one wide open, pilot line and pump with it: a 20 t excavator's joints begin to move
0.31 to 0.93 s after they are told (dead times fitted to a ZX200, `Assets/Prefab/zx200.prefab` of
pwri-opera/OperaSim-PhysX, 45d8a07)."""
ENGINE = ("Net Power", "Engine Power", "Gross Power")
"""Specifications that say what the engine has, the first that is known."""
TO_OIL = 0.85
"""Of the engine's power, what reaches the oil."""
CUSHION = 0.06
"""Metres before its ends over which a cylinder's own throttles slow it evenly: 40 to 80 mm on booms and arms."""
_LONGEST_CUSHION, _CREEPING = 0.1, 0.1
"""… and at most so much of its stroke; it gets there with so much of its speed."""


@dataclass(frozen=True)
class Circuit:
    """One actuator's driven slide. In the slide's negative and positive direction: the `areas` (m²) of all its
    cylinders that the pump fills, the rated `speeds` (m/s) and the `forces` (N) at relief pressure. `sign`: +1 where
    the actuator's positive sense extends it. `lower` and `upper` are its ends; `softness` the drive's, m/N; `lag` its
    damping by its stiffness, s: so long its slide comes behind a target that moves."""

    actuator: str
    slide: str
    sign: int
    areas: tuple[float, float]
    speeds: tuple[float, float]
    forces: tuple[float, float]
    lower: float
    upper: float
    softness: float
    lag: float = 0.0


class Hydraulics:
    """The valves and the pump of one machine, from step to step. One object serves one machine.

    `circuits` by actuator are what it drives; motors and what has no rated speed are left to others.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        *,
        flow: float | None = None,
        power: float | None = None,
        spool: float = SPOOL,
        cushion: float = CUSHION,
        implicit: bool = False,
    ) -> None:
        """`flow`: what the pump gives all cylinders together, m³/s (default: what its largest consumer takes at rated
        speed). `power`: what it has for it, W (default: 0.85 of the engine's by the sheet, else unlimited). `spool`:
        seconds in which a valve opens. `cushion`: metres before its ends over which a cylinder is slowed. `implicit`:
        the engine's drives pull to where a slide will be after a step, as PhysX's do, not from where it is.

        `YellowironError` where no cylinder of the machine has a rated speed.
        """
        made = (_circuit(mechanism, actuator) for actuator in mechanism.actuators)
        self.circuits: Mapping[str, Circuit] = {circuit.actuator: circuit for circuit in made if circuit is not None}
        if not self.circuits:
            raise YellowironError(
                "No cylinder of the machine has a rated speed",
                where=mechanism.name,
                hint="Give the pump's flow and the bores, or a sheet, and build it again.",
            )
        largest = max(a * v for c in self.circuits.values() for a, v in zip(c.areas, c.speeds, strict=True))
        self.flow = largest if flow is None else float(flow)
        """m³/s of the pump."""
        self.power = engine_power(mechanism) * TO_OIL if power is None else float(power)
        """W at the pump; infinite where nothing says it."""
        self._spool, self._cushion, self._implicit = spool, cushion, implicit
        self._openings = dict.fromkeys(self.circuits, 0.0)
        self._targets: dict[str, float] = {}
        self._strokes: dict[str, float] = {}
        self._own: dict[str, float] = {}
        self.speeds: Mapping[str, float] = dict.fromkeys(self.circuits, 0.0)
        """Actuator → the speed that its oil gives it, m/s of its slide, at the last step; less in its cushions."""

    def step(
        self,
        levers: Mapping[str, float],
        strokes: Mapping[str, float],
        seconds: float,
        *,
        forces: Mapping[str, float] | None = None,
    ) -> dict[str, float]:
        """Slide → its drive's target, metres from the drawn pose, a step of so many `seconds` on.

        `levers`: actuator → −1 … 1 of its valve, positive in the actuator's sense; those not named are let go, and hold
        their load. `strokes`: slide → where it is. `forces`: slide → what its drive exerts, N, positive extending:
        what the pump's power is shared by; without it a load weighs nothing. `KeyError` for an actuator that is none of
        `circuits`.
        """
        for name in levers:
            if name not in self.circuits:
                raise KeyError(f"'{name}' has no cylinder here; there are: {', '.join(self.circuits)}")
        demands: dict[str, tuple[float, float]] = {}
        for name, circuit in self.circuits.items():
            opening = self._opened(name, circuit.sign * max(-1.0, min(1.0, levers.get(name, 0.0))), seconds)
            way, sense = int(opening > 0.0), math.copysign(1.0, opening)
            area = circuit.areas[way]
            load = sense * (forces or {}).get(circuit.slide, 0.0)
            # A load that pulls the way it goes needs none, and the relief valve opens at the rated force.
            pressure = max(0.0, min(load, circuit.forces[way])) / area
            demands[name] = abs(opening) * area * circuit.speeds[way], pressure
        share = self._share(demands)
        own = self._moving(strokes, seconds)
        ahead = self._after(own)
        speeds = {}
        for name, circuit in self.circuits.items():
            opening = self._openings[name]
            way = int(opening > 0.0)
            speeds[name] = math.copysign(share * demands[name][0] / circuit.areas[way], opening)
            self._move(circuit, strokes[circuit.slide], speeds[name], own[circuit.slide], seconds)
        self._ease(strokes, ahead, seconds)
        self.speeds = speeds
        return dict(self._targets)

    def controls(self, targets: Mapping[str, float]) -> dict[str, float]:
        """Actuator → the control of its servo in the exported MJCF, for the targets of `step`."""
        return {name: circuit.sign * targets[circuit.slide] for name, circuit in self.circuits.items()}

    def _opened(self, name: str, wanted: float, seconds: float) -> float:
        """The valve's opening, as far towards what is wanted as it gets in that time."""
        most = seconds / self._spool if self._spool > 0.0 else math.inf
        self._openings[name] += max(-most, min(most, wanted - self._openings[name]))
        return self._openings[name]

    def _share(self, demands: Mapping[str, tuple[float, float]]) -> float:
        """Of all demands (flow, pressure) the share that the pump has flow and power for: valves share it evenly,
        whatever their loads, as those with pressure compensators do."""
        flow = sum(each for each, _ in demands.values())
        share = min(1.0, self.flow / flow) if flow > 0.0 else 1.0
        power = share * sum(each * pressure for each, pressure in demands.values())
        return share * (min(1.0, self.power / power) if power > 0.0 else 1.0)

    def _moving(self, strokes: Mapping[str, float], seconds: float) -> dict[str, float]:
        """Slide → its own speed since the last step, m/s."""
        slides = [circuit.slide for circuit in self.circuits.values()]
        before, self._strokes = self._strokes, {slide: strokes[slide] for slide in slides}
        if not seconds > 0.0:
            return dict.fromkeys(slides, 0.0)
        return {slide: (strokes[slide] - before.get(slide, strokes[slide])) / seconds for slide in slides}

    def _after(self, own: Mapping[str, float]) -> Mapping[str, float]:
        """These speeds at the step's end, as they last changed: what the drives are damped by there."""
        before, self._own = self._own, dict(own)
        return {slide: 2.0 * speed - before.get(slide, speed) for slide, speed in own.items()}

    def _behind(self, circuit: Circuit, own: float, seconds: float) -> float:
        """Metres by which a drive that exerts nothing has its slide behind its target."""
        return (circuit.lag + self._implicit * seconds) * own

    def _move(self, circuit: Circuit, stroke: float, speed: float, own: float, seconds: float) -> None:
        """The target, moved on; no farther from where the slide is than the drive's whole force reaches, its damping
        at the slide's own speed overcome: oil that cannot move it goes over the relief valve. That speed counts up to
        the oil's: what is faster is not pushed."""
        target = self._targets.get(circuit.slide, stroke)
        speed *= self._cushioned(circuit, target, speed)
        target += speed * seconds
        if speed != 0.0:
            slowest, fastest = min(speed, 0.0), max(speed, 0.0)
            ahead = self._behind(circuit, max(slowest, min(fastest, own)), seconds)
            back, forth = (force * circuit.softness for force in circuit.forces)
            target = max(stroke - back + min(ahead, 0.0), min(stroke + forth + max(ahead, 0.0), target))
        self._targets[circuit.slide] = max(circuit.lower, min(circuit.upper, target))

    def _ease(self, strokes: Mapping[str, float], own: Mapping[str, float], seconds: float) -> None:
        """Draws targets nearer where the drives would do more at once than the pump has: what has gained its speed
        before the power was shared anew is pushed by no more than is left for it."""
        pushed = {}
        for circuit in self.circuits.values():
            slide = circuit.slide
            at = strokes[slide] + self._behind(circuit, own[slide], seconds)
            back, forth = circuit.forces
            force = max(-back, min(forth, (self._targets[slide] - at) / circuit.softness))
            if force * own[slide] > 0.0:
                pushed[slide] = circuit, at, force
        power = sum(force * own[slide] for slide, (_, _, force) in pushed.items())
        if power > self.power:
            for slide, (circuit, at, force) in pushed.items():
                target = at + self.power / power * force * circuit.softness
                self._targets[slide] = max(circuit.lower, min(circuit.upper, target))

    def _cushioned(self, circuit: Circuit, target: float, speed: float) -> float:
        """The share of its speed that is left to a cylinder so far from the end that it goes to: evenly slowed."""
        length = min(self._cushion, _LONGEST_CUSHION * (circuit.upper - circuit.lower))
        room = circuit.upper - target if speed > 0.0 else target - circuit.lower
        return max(_CREEPING, math.sqrt(max(room, 0.0) / length)) if room < length else 1.0


def _circuit(mechanism: Mechanism, actuator: Actuator) -> Circuit | None:
    if actuator.kind != "cylinder" or not actuator.joints:
        return None
    lead = actuator.joints[0]
    joint = mechanism.joint(lead.joint)
    drive = joint.drive
    signs = {entry.joint: entry.sign * lead.sign for entry in actuator.joints}
    cylinders = [c for c in mechanism.cylinders if c.slide in signs and c.pressure > 0.0]
    if drive is None or joint.lower is None or joint.upper is None or not cylinders or not drive.stiffness > 0.0:
        return None
    if not all(0.0 < v < math.inf for v in drive.speeds) or not all(0.0 < f < math.inf for f in drive.forces):
        return None
    # A twin of the other sign fills its other side.
    areas = [
        sum((c.push_force if (signs[c.slide] > 0) == extends else c.pull_force) / c.pressure for c in cylinders)
        for extends in (False, True)
    ]
    return Circuit(
        actuator.name, joint.name, lead.sign, (areas[0], areas[1]), drive.speeds, drive.forces,
        joint.lower, joint.upper, 1.0 / drive.stiffness, drive.damping / drive.stiffness,
    )  # fmt: skip


def engine_power(mechanism: Mechanism) -> float:
    """W of the engine, by the first of `ENGINE` that the sheet gives; infinite where it gives none."""
    known = {fold(name): entry for name, entry in mechanism.specifications.items() if entry.get("status") == "ok"}
    values = (known[fold(name)].get("value") for name in ENGINE if fold(name) in known)
    return next((float(value) for value in values if value), math.inf)
