"""Where the grader's pins are, and what its cylinders make of them. Machine frame, millimetres: x forward from the
articulation, y left, z up from the ground. The drawbar and what it carries are told as they stand with the cutting edge
on the ground, straight and level; everything else as it is drawn, straight ahead.

Free dimensions are solved so that the strokes give what the sheet prints. Angles are radians.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, fsolve
from scipy.spatial.transform import Rotation

from drawing.articulation import Steering, steering_between
from drawing.ball import Array, turned

from . import values as v

AXLE_X, TANDEM_X = v.FRONT_TO_HITCH.value, -v.REAR_TO_HITCH.value
RADIUS = v.AXLE_HEIGHT.value
MIDDLE_X, REAR_X = (TANDEM_X + sign * v.TANDEM.value / 2 for sign in (1.0, -1.0))
MIRROR = np.array([1.0, -1.0, 1.0])

# ---- drawbar --------
NOSE = np.array([4_850.0, 0.0, 880.0])
"""The ball."""
SADDLE = np.array([2_950.0, 0.0, 1_880.0])
"""Where the saddle turns, lengthwise."""
LIFT_FOOT = np.array([2_950.0, 620.0, 2_200.0])
LIFT_Y, LIFT_Z = 850.0, 920.0
CENTRE_FOOT, CENTRE_Z = np.array([3_150.0, -700.0, 1_300.0]), 965.0
"""The centre shift cylinder: its foot, and its eye's height."""
CIRCLE = np.array([2_700.0, 0.0, 760.0])
EDGE_X = 2_740.0
CORNER = np.array([EDGE_X, v.BLADE_LENGTH.value / 2, 0.0])
BACK = ((2_575.0, 110.0), (2_575.0, 440.0))
"""x and z of the moldboard's rear corners."""
RAISED = 150.0
"""How high the edge is drawn."""
HOLE = math.radians(-48.0)
"""How far the saddle turns to its outermost hole for a bank on the right, its right side up."""
TIP_PIVOT, TIP_FOOT = np.array([2_500.0, 200.0]), np.array([1_985.0, 590.0])
"""x and z: where the blade's carrier turns on the circle, and the foot of its cylinder."""

# ---- front axle --------
KING_Y, LEAN_Y, LEAN_Z = 760.0, 640.0, 600.0
BAR_Z, LEAN_EYE_Z, LEAN_FOOT_Y = 900.0, 860.0, 150.0
TIE = np.array([-260.0, -32.0])
"""From the left kingpin to the tie rod's end, x and y."""
STEER_FOOT = np.array([-230.0, 60.0 - KING_Y])
STEER_Z, TIE_Z = LEAN_Z, 495.0
"""The steering cylinders' eyes are as high as the pins that the wheels lean about: leaning steers little."""

# ---- ripper --------
RIPPER_PIVOT = np.array([-2_700.0, 640.0])
RIPPER_FOOT = np.array([-3_070.0, 1_400.0])
RIPPER_TIP = np.array([-3_800.0, 0.0])
"""x and z, the tip on the ground."""
RIPPER_EYE_Z, RIPPER_RAISED = 780.0, 250.0
"""Height of the cylinders' eyes with the tips on the ground; how high these are drawn."""


def _spin(angle: float, p: Array) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * p[0] - s * p[1], s * p[0] + c * p[1]])


# ---- how the drawbar turns on its ball --------
def pitched(angle: float, p: Array) -> Array:
    """A point of the drawbar with that turned down at its rear (radians) about the nose."""
    matrix: Array = Rotation.from_rotvec([0.0, -angle, 0.0]).as_matrix()
    return NOSE + matrix @ (p - NOSE)


def pitch_for(height: float) -> float:
    """How far the straight drawbar is turned down where the edge is so high."""
    return float(brentq(lambda angle: pitched(angle, CORNER)[2] - height, -0.6, 0.6, xtol=1e-15))


def in_hole(angle: float, p: Array) -> Array:
    """A point of the saddle with that turned so far in another hole, its left side up."""
    return SADDLE + np.array(Rotation.from_rotvec([angle, 0.0, 0.0]).as_matrix()) @ (p - SADDLE)


@dataclass(frozen=True, eq=False)
class Linkage:
    """The solved linkage: eyes on the drawbar of the left lift and the centre shift cylinder and their closed lengths;
    of the tip cylinder the eye from the carrier's pivot (x, z), of the steering cylinder that from the kingpin (x, y),
    of the lean cylinder its foot's height, of the ripper cylinder its eye with the tip on the ground (x, z)."""

    lift_eye: Array
    lift_closed: float
    centre_eye: Array
    centre_closed: float
    tip_eye: Array
    steer_eye: Array
    lean_foot_z: float
    ripper_eye: Array
    ripper_closed: float

    def links(self, hole: float = 0.0) -> list[tuple[Array, Array]]:
        """Feet and eyes of both lift cylinders and the centre shift's, the saddle turned so far."""
        return [
            (in_hole(hole, LIFT_FOOT), self.lift_eye),
            (in_hole(hole, LIFT_FOOT * MIRROR), self.lift_eye * MIRROR),
            (in_hole(hole, CENTRE_FOOT), self.centre_eye),
        ]

    def lengths(self, matrix: Array, hole: float = 0.0) -> Array:
        """Their lengths with the drawbar turned so (3, 3)."""
        return np.array([np.linalg.norm(NOSE + matrix @ (b - NOSE) - a) for a, b in self.links(hole)])

    def drawbar(self, lengths: Array, near: Array, hole: float = 0.0) -> Array:
        """How the drawbar is turned (3, 3) at these lengths, on the branch of a rotation `near`."""
        return turned(self.links(hole), NOSE, lengths, near)

    def straight(self, height: float) -> Array:
        """The drawbar's rotation with the edge so high."""
        return np.array(Rotation.from_rotvec([0.0, -pitch_for(height), 0.0]).as_matrix())

    def tip_length(self, angle: float) -> float:
        """The tip cylinder's length with the blade tipped so far forward."""
        return float(np.linalg.norm(TIP_PIVOT + _spin(-angle, self.tip_eye) - TIP_FOOT))

    def steer_length(self, angle: float) -> float:
        """The left steering cylinder's length with its knuckle turned so far to the left."""
        return float(np.linalg.norm(_spin(angle, self.steer_eye) - STEER_FOOT))

    def lean_length(self, angle: float) -> float:
        """The lean cylinder's length with the wheels' tops so far to the left."""
        return _lean(self.lean_foot_z, angle)

    def ripper_length(self, angle: float) -> float:
        """A ripper cylinder's length with the ripper turned up so far from where its tips are on the ground."""
        return float(np.linalg.norm(ripped(angle, self.ripper_eye) - RIPPER_FOOT))

    def closed(self, name: str) -> float:
        """A cylinder's closed length."""
        at = {
            "lift": self.lift_closed,
            "centre": self.centre_closed,
            "tip": self.tip_length(math.radians(-v.TIP_BACK.value)),
            "steer": self.steer_length(math.radians(v.STEERING.value)),
            "lean": self.lean_length(math.radians(-v.LEAN.value)),
            "bend": v.BEND_CLOSED.value,
            "ripper": self.ripper_closed,
        }
        return at[name]


def place(matrix: Array, p: Array) -> Array:
    """Where a point of the drawbar is with that turned so (3, 3)."""
    return NOSE + matrix @ (p - NOSE)


# ---- front axle and ripper --------
def _lean(foot_z: float, angle: float) -> float:
    arm = LEAN_EYE_Z - LEAN_Z
    y, z = LEAN_Y + arm * math.sin(angle), LEAN_Z + arm * math.cos(angle)
    return math.hypot(y - LEAN_FOOT_Y, z - foot_z)


def outer(inner: float) -> float:
    """How far the outer knuckle turns as the inner one does: the tie rod keeps its length."""
    left, right = np.array([0.0, KING_Y]), np.array([0.0, -KING_Y])
    tie = 2.0 * (KING_Y + TIE[1])
    end = left + _spin(inner, TIE)

    def gap(angle: float) -> float:
        return float(np.linalg.norm(right + _spin(angle, TIE * (1.0, -1.0)) - end)) - tie

    return float(brentq(gap, 0.2 * inner, 1.1 * inner, xtol=1e-14))


def ripped(angle: float, p: Array) -> Array:
    """A point of the ripper (x, z) with that turned up so far."""
    return RIPPER_PIVOT + _spin(-angle, p - RIPPER_PIVOT)


def rip_for(height: float) -> float:
    """How far the ripper is turned up where its tips are so high."""
    return float(brentq(lambda angle: ripped(angle, RIPPER_TIP)[1] - height, -0.7, 0.7, xtol=1e-15))


@functools.cache
def solve_bend() -> Steering:
    """The articulation's cylinders: barrels on the front frame, rods on the rear one."""
    return steering_between(780.0, -330.0, math.radians(v.ARTICULATION.value), v.BEND_CLOSED.value, v.BEND_STROKE.value)


@functools.cache
def solve() -> Linkage:
    """The linkage that gives what the sheet prints."""
    high, low = pitch_for(v.BLADE_LIFT.value), pitch_for(-v.DEPTH_OF_CUT.value)

    def lift(free: Array) -> list[float]:
        eye = np.array([free[0], LIFT_Y, LIFT_Z])
        ends = [float(np.linalg.norm(pitched(angle, eye) - LIFT_FOOT)) for angle in (high, low)]
        return [ends[0] - free[1], ends[1] - free[1] - v.LIFT_STROKE.value]

    x, closed = fsolve(lift, [2_950.0, 900.0], xtol=1e-14)
    lift_eye = np.array([float(x), LIFT_Y, LIFT_Z])

    centre_eye = np.array([CENTRE_FOOT[0], 600.0, CENTRE_Z])
    drawn = float(np.linalg.norm(centre_eye - CENTRE_FOOT))

    def reach(length: float) -> float:
        return shoulder(centre_eye, length) - v.SHOULDER.value

    centre_closed = float(brentq(reach, drawn + 300.0, drawn + 480.0, xtol=1e-11)) - v.CENTRE_STROKE.value

    def tip(height: float) -> float:
        made = [
            float(np.linalg.norm(TIP_PIVOT + _spin(-math.radians(a), np.array([-60.0, height])) - TIP_FOOT))
            for a in (v.TIP_FORWARD.value, -v.TIP_BACK.value)
        ]
        return made[0] - made[1] - v.TIP_STROKE.value

    lock = math.radians(v.STEERING.value)

    def steer(long: float) -> float:
        eye = np.array([-long, 0.1 * long])
        ends = [float(np.linalg.norm(_spin(angle, eye) - STEER_FOOT)) for angle in (lock, -outer(lock))]
        return ends[1] - ends[0] - v.STEER_STROKE.value

    lean = math.radians(v.LEAN.value)
    foot_z = float(brentq(lambda z: _lean(z, lean) - _lean(z, -lean) - v.LEAN_STROKE.value, 560.0, 850.0, xtol=1e-13))
    up, down = rip_for(v.RIPPER_LIFT.value), rip_for(-v.RIPPING_DEPTH.value)

    def ripper(free: Array) -> list[float]:
        eye = np.array([free[0], RIPPER_EYE_Z])
        ends = [float(np.linalg.norm(ripped(angle, eye) - RIPPER_FOOT)) for angle in (up, down)]
        return [ends[0] - free[1], ends[1] - free[1] - v.RIPPER_STROKE.value]

    rx, ripper_closed = fsolve(ripper, [-3_250.0, 450.0], xtol=1e-12)
    long = float(brentq(steer, 180.0, 300.0, xtol=1e-13))
    return Linkage(
        lift_eye, float(closed), centre_eye, centre_closed,
        np.array([-60.0, float(brentq(tip, 150.0, 400.0, xtol=1e-13))]), np.array([-long, 0.1 * long]), foot_z,
        np.array([float(rx), RIPPER_EYE_Z]), float(ripper_closed),
    )  # fmt: skip


# ---- what it gives --------
def shoulder(centre_eye: Array, length: float) -> float:
    """How far the blade's left end is outside the tyres with the centre shift cylinder so long, the blade shifted as
    far as it goes, its edge on the ground."""
    aside = np.array([0.0, v.SHIFT_LEFT.value, 0.0])
    ends = [CORNER + aside, CORNER * MIRROR + aside]

    def gaps(turn: Array) -> list[float]:
        matrix = np.array(Rotation.from_rotvec(turn).as_matrix())
        return [
            float(np.linalg.norm(place(matrix, centre_eye) - CENTRE_FOOT)) - length,
            *(float(place(matrix, end)[2]) for end in ends),
        ]

    matrix = np.array(Rotation.from_rotvec(fsolve(gaps, [0.0, 0.0, -0.2], xtol=1e-13)).as_matrix())
    far = max(float(place(matrix, np.array([x, ends[0][1], z]))[1]) for x, z in BACK)
    return far - v.WIDTH.value / 2


def slope_of(matrix: Array) -> float:
    """How steeply the cutting edge rises to the right, the drawbar turned so (3, 3), degrees."""
    return math.degrees(math.asin(-float(matrix[2, 1])))


def held(k: Linkage) -> Array:
    """The drawbar's rotation (3, 3) with the saddle in its outermost hole, the cylinders as they are drawn: followed
    from the drawn pose."""
    matrix, lengths = k.straight(RAISED), k.lengths(k.straight(RAISED))
    for angle in np.linspace(0.0, HOLE, 41)[1:]:
        matrix = k.drawbar(lengths, matrix, float(angle))
    return matrix


def bank_cut(k: Linkage) -> Array:
    """The drawbar's rotation (3, 3) at which the blade is steepest for a bank on the right, its right end up, the
    saddle in its outermost hole: the left lift and the centre shift cylinder fully out, the right lift fully in."""
    matrix = held(k)
    lengths, low = k.lengths(matrix, HOLE), np.array([k.lift_closed, k.lift_closed, k.centre_closed])
    strokes = np.array([v.LIFT_STROKE.value, 0.0, v.CENTRE_STROKE.value])
    for share in np.linspace(0.0, 1.0, 41)[1:]:
        matrix = k.drawbar(lengths + share * (low + strokes - lengths), matrix, HOLE)
    return matrix


def measured() -> dict[str, float]:
    """What the solved linkage gives, by the value's name; millimetres and degrees."""
    k, bend = solve(), solve_bend()
    ends = [k.lift_closed + share * v.LIFT_STROKE.value for share in (0.0, 1.0)]
    pitches = [
        float(brentq(lambda a, end=end: np.linalg.norm(pitched(a, k.lift_eye) - LIFT_FOOT) - end, -0.6, 0.6))
        for end in ends
    ]
    high, low = (float(pitched(angle, CORNER)[2]) for angle in pitches)
    tips = [
        float(brentq(lambda a, end=end: k.tip_length(a) - end, -0.5, 1.2))
        for end in (k.closed("tip"), k.closed("tip") + v.TIP_STROKE.value)
    ]
    rips = [
        float(brentq(lambda a, end=end: k.ripper_length(a) - end, -0.7, 0.7))
        for end in (k.ripper_closed, k.ripper_closed + v.RIPPER_STROKE.value)
    ]
    lean = float(brentq(lambda a: k.lean_length(a) - k.closed("lean") - v.LEAN_STROKE.value, 0.0, 0.6))
    steer = float(brentq(lambda a: k.steer_length(a) - k.closed("steer"), 0.3, 1.2))
    return {
        v.BLADE_LIFT.name: high,
        v.DEPTH_OF_CUT.name: -low,
        v.SHOULDER.name: shoulder(k.centre_eye, k.centre_closed + v.CENTRE_STROKE.value),
        v.BANK_CUT.name: slope_of(bank_cut(k)),
        v.TIP_FORWARD.name: math.degrees(tips[1]),
        v.TIP_BACK.name: -math.degrees(tips[0]),
        v.STEERING.name: math.degrees(steer),
        v.LEAN.name: math.degrees(lean),
        v.ARTICULATION.name: math.degrees(bend.lock(v.BEND_CLOSED.value, v.BEND_STROKE.value)),
        v.RIPPER_LIFT.name: float(ripped(rips[0], RIPPER_TIP)[1]),
        v.RIPPING_DEPTH.name: -float(ripped(rips[1], RIPPER_TIP)[1]),
        v.WHEELBASE.name: AXLE_X - TANDEM_X,
        v.FRONT_TO_HITCH.name: AXLE_X,
        v.REAR_TO_HITCH.name: -TANDEM_X,
        v.TANDEM.name: MIDDLE_X - REAR_X,
    }
