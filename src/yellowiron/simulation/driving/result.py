"""What a drive found, as values, as a JSON document and as findings. SI inside."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from yellowiron.model.finding import Finding
from yellowiron.simulation.driving.tracked import SPIN

DISTANCE = 5.0
"""Metres that a wheeled machine drives forward and back."""
BLOCK_HEIGHT = 0.15
"""Metres."""
DISTANCE_BAR, RADIUS_BAR, LIFTED = 0.03, 0.05, 0.02
"""Shares by which a distance and the turning radius may be off, and metres that a wheel may rise."""
STEERED = 0.5
"""A steering that comes less than this share of its way is held by the tyres: no turn, nor a way, is one to judge."""
SPIN_BAR, SWING_BAR, CRAB_BAR = 0.1 * SPIN, math.radians(1.0), math.radians(2.0)
"""Radians by which a turn on the spot, a swing and the way of a machine that crabs may be off."""


@dataclass(frozen=True)
class DrivingResult:
    """Metres, radians, seconds. `sunk` and `creep`: how far the root came down and its speed after settling. Travel is
    the root's; `turning_radius` is that of the outermost wheel's middle, `geometry_radius` where the axles' lines meet
    at the measured lock, of a machine with a drum where dry friction lets it turn (`sliding`), none of one with an axle
    too many that neither drives nor steers; `axes_radius`: by the axles' lines in any case; `steered`: the share of
    its way to full lock that the steering came to rest at. `crab`: the way to the
    left of a machine whose wheels are all turned one way, against `crab_geometry`, the mean of where they point at
    full lock; it does not turn. `spin`: the turn on the
    spot of a machine that steers by its two sides' speeds, against `spin_geometry`, what dry friction leaves of it on
    tyres for as far as they rolled (`tracked.spin`); tracks slip. `swing`: by how much the slewing body's heading, seen
    from the ground, changed, against what its motor was told. `axle_angle`: the free axle's coordinate with one wheel
    on a block, `axle_geometry` what block and tread make of it; `highest_wheel`: the most that a wheel ever rose from
    what it stood on. None: not driven."""

    engine: str
    dt: float
    payload: float
    sunk: float
    creep: float
    forward: float
    backward: float
    sideways: float
    distance: float = DISTANCE
    steered: float | None = None
    lock: float | None = None
    turning_radius: float | None = None
    geometry_radius: float | None = None
    axes_radius: float | None = None
    crab: float | None = None
    crab_geometry: float | None = None
    spin: float | None = None
    spin_geometry: float | None = None
    swing: float | None = None
    swing_geometry: float | None = None
    axle_angle: float | None = None
    axle_geometry: float | None = None
    highest_wheel: float | None = None


def driving_document(result: DrivingResult) -> dict[str, Any]:
    """The result as JSON: metres, degrees where the name says so, percentages against the geometry."""
    radius = None
    if result.turning_radius is not None and result.geometry_radius:
        radius = 100.0 * (result.turning_radius / result.geometry_radius - 1.0)
    return {
        "payload_kg": result.payload,
        "sunk_mm": 1e3 * result.sunk,
        "creep_mm_s": 1e3 * result.creep,
        "distance_m": result.distance,
        "forward_m": result.forward,
        "forward_error_percent": 100.0 * (result.forward / result.distance - 1.0),
        "backward_m": result.backward,
        "backward_error_percent": 100.0 * (result.backward / result.distance - 1.0),
        "sideways_m": result.sideways,
        "steered_percent": None if result.steered is None else 100.0 * result.steered,
        "lock_deg": None if result.lock is None else math.degrees(result.lock),
        "turning_radius_m": result.turning_radius,
        "geometry_radius_m": result.geometry_radius,
        "radius_error_percent": radius,
        "crab_deg": None if result.crab is None else math.degrees(result.crab),
        "crab_geometry_deg": None if result.crab_geometry is None else math.degrees(result.crab_geometry),
        "spin_deg": None if result.spin is None else math.degrees(result.spin),
        "spin_geometry_deg": None if result.spin_geometry is None else math.degrees(result.spin_geometry),
        "swing_deg": None if result.swing is None else math.degrees(result.swing),
        "swing_geometry_deg": None if result.swing_geometry is None else math.degrees(result.swing_geometry),
        "block_m": BLOCK_HEIGHT,
        "axle_angle_deg": None if result.axle_angle is None else math.degrees(result.axle_angle),
        "axle_geometry_deg": None if result.axle_geometry is None else math.degrees(result.axle_geometry),
        "highest_wheel_mm": None if result.highest_wheel is None else 1e3 * result.highest_wheel,
    }


def driving_findings(result: DrivingResult) -> Iterator[Finding]:
    """SIM009 for what is off by more than its bar."""
    figures = [
        ("forward", result.forward, result.distance, DISTANCE_BAR),
        ("backward", result.backward, result.distance, DISTANCE_BAR),
    ]
    stuck = result.steered is not None and result.steered < STEERED
    if stuck:
        words = f"the steering came {100.0 * (result.steered or 0.0):.0f} % of its way to full lock: the tyres hold it"
        yield Finding("SIM009", "warning", "steering", words, "Check its cylinder's bore and pressure.")
    elif result.turning_radius is not None and result.geometry_radius is not None:
        figures.append(("turning radius", result.turning_radius, result.geometry_radius, RADIUS_BAR))
    for what, value, wanted, bar in figures:
        if not abs(value / wanted - 1.0) <= bar:
            words = f"{value:.3f} m against {wanted:.3f} m, more than {100.0 * bar:g} % off"
            yield Finding("SIM009", "warning", what, words, "Check wheels, their torque and the ground's friction.")
    for what, turned, meant, bar in (
        ("turn on the spot", result.spin, result.spin_geometry, SPIN_BAR),
        ("swing", result.swing, result.swing_geometry, SWING_BAR),
        ("way crabwise", None if stuck else result.crab, result.crab_geometry, CRAB_BAR),
    ):
        if turned is not None and meant is not None and not abs(turned - meant) <= bar:
            words = (
                f"{math.degrees(turned):.1f}° against {math.degrees(meant):.1f}°, more than {math.degrees(bar):g}° off"
            )
            yield Finding("SIM009", "warning", what, words, "Check torques and the ground's friction.")
    if result.highest_wheel is not None and result.highest_wheel > LIFTED:
        words = f"a wheel rose {1e3 * result.highest_wheel:.0f} mm from what it stood on"
        yield Finding("SIM009", "warning", "block", words, "Check the axle's range and the machine's masses.")
    if result.axle_angle is not None and result.axle_geometry and result.axle_angle < 0.5 * result.axle_geometry:
        words = f"the axle turned {math.degrees(result.axle_angle):.1f}°, not {math.degrees(result.axle_geometry):.1f}°"
        yield Finding("SIM009", "warning", "axle", words, "Check that the axle's joint is free.")
