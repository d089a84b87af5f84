"""Linkages in space, with balls: a dozer's six-way blade and a grader's drawbar, and where they are by other means: a
body on a ball, its turn found from the lengths of three links by Newton on nine entries of a rotation matrix."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from drawing.ball import turned
from yellowiron.mechanism.joints.tree import Link, LinkKind, span_tree
from yellowiron.model.mechanism import Actuator, ActuatorJoint, Body, Cylinder, Drive, Joint, Mechanism

LATERAL = (0.0, 1.0, 0.0)
MAIN, FRAME, BLADE = "main", "c_frame", "blade"


@dataclass(frozen=True, eq=False)
class Ram:
    """A cylinder with balls at both ends: where it hangs, where it pushes, how far out and in it goes."""

    name: str
    bodies: tuple[str, str]
    foot: np.ndarray
    eye: np.ndarray
    travel: float
    passive: bool = False
    stiffness: float = 0.0
    """Of its drive, N/m; 0: as the kinematics has it."""

    @property
    def length(self) -> float:
        return float(np.linalg.norm(self.eye - self.foot))


@dataclass(frozen=True, eq=False)
class Blade:
    """A six-way blade as drawn: the C-frame's pivot, the ball, the pitch link's ends and the cylinders."""

    pivot: np.ndarray
    ball: np.ndarray
    link: tuple[np.ndarray, np.ndarray]
    rams: tuple[Ram, ...]

    def ram(self, name: str) -> Ram:
        return next(r for r in self.rams if r.name == name)


def blade(wobble: Sequence[float] = (0.0,) * 39) -> Blade:
    """A blade of the size of a 20 t dozer's, its pins moved by up to so many shares of 100 mm."""
    moved = iter(0.1 * np.reshape(wobble, (-1, 3)))

    def at(x: float, y: float, z: float) -> np.ndarray:
        return np.array([x, y, z]) + next(moved)

    ball = at(2.6, 0.0, 0.55)
    rams = [
        Ram("lift_l", (MAIN, FRAME), at(1.1, 0.5, 1.5), at(2.1, 0.55, 0.75), 0.25),
        Ram("lift_r", (MAIN, FRAME), at(1.1, -0.5, 1.5), at(2.1, -0.55, 0.75), 0.25, passive=True),
        Ram("tilt", (FRAME, BLADE), at(2.35, 0.1, 1.15), at(2.75, 1.15, 1.2), 0.09),
        Ram("angle_l", (FRAME, BLADE), at(1.5, 0.75, 0.5), at(2.75, 0.95, 0.5), 0.3),
        Ram("angle_r", (FRAME, BLADE), at(1.5, -0.75, 0.5), at(2.75, -0.95, 0.5), 0.3, passive=True),
    ]
    link = (at(2.3, 0.0, 1.2), at(2.7, 0.0, 1.25))
    return Blade(np.array([0.3, 0.0, 0.45]), ball, link, tuple(rams))


def blade_machine(drawn: Blade) -> Mechanism:
    """It as a mechanism: 14 bodies, 19 joints."""
    made = _Maker(MAIN)
    made.body(MAIN, np.zeros(3), 15000.0)
    made.body(FRAME, drawn.pivot, 1500.0, middle=0.5 * (drawn.pivot + drawn.ball))
    made.body(BLADE, drawn.ball, 2000.0, middle=drawn.ball + np.array([0.2, 0.0, 0.1]))
    made.joint("frame_pivot", "revolute", (MAIN, FRAME), drawn.pivot, LATERAL)
    for ram in drawn.rams:
        made.ram(ram)
    made.joint("blade_ball", "spherical", (FRAME, BLADE), drawn.ball)
    made.link("link", (FRAME, BLADE), *drawn.link)
    return made.mechanism("dozer", ("lift_l", "tilt", "angle_l"))


def drawbar(wobble: Sequence[float] = (0.0,) * 21) -> tuple[np.ndarray, tuple[Ram, ...]]:
    """A grader's: the ball at its nose, two lift cylinders and the one that shifts it aside."""
    moved = iter(0.1 * np.reshape(wobble, (-1, 3)))

    def at(x: float, y: float, z: float) -> np.ndarray:
        return np.array([x, y, z]) + next(moved)

    nose = at(5.2, 0.0, 1.0)
    rams = (
        Ram("lift_l", (MAIN, "drawbar"), at(3.0, 0.55, 2.2), at(2.9, 0.8, 1.0), 0.25),
        Ram("lift_r", (MAIN, "drawbar"), at(3.0, -0.55, 2.2), at(2.9, -0.8, 1.0), 0.25),
        Ram("shift", (MAIN, "drawbar"), at(3.1, -0.6, 2.0), at(2.8, 0.6, 1.05), 0.2),
    )
    return nose, rams


def drawbar_machine(nose: np.ndarray, rams: Sequence[Ram]) -> Mechanism:
    """It as a mechanism: 8 bodies, 10 joints."""
    made = _Maker(MAIN)
    made.body(MAIN, np.zeros(3), 12000.0)
    made.body("drawbar", nose, 900.0, middle=np.mean([nose, *(r.eye for r in rams)], axis=0))
    for ram in rams:
        made.ram(ram)
    made.joint("nose", "spherical", (MAIN, "drawbar"), nose)
    return made.mechanism("grader", tuple(r.name for r in rams))


def push_arms(*, dual: bool, yokes: bool = True) -> Mechanism:
    """A semi-U blade on push arms: balls at the trunnions, at the blade yokes with crossed pins, a tag link across,
    lift cylinders; on the right arm a brace, or the second tilt cylinder."""
    made = _Maker(MAIN)
    trunnions = {s: np.array([0.2, side * 1.35, 0.5]) for s, side in (("l", 1.0), ("r", -1.0))}
    pins = {s: np.array([2.5, side * 1.3, 0.35]) for s, side in (("l", 1.0), ("r", -1.0))}
    made.body(MAIN, np.zeros(3), 18000.0)
    for s in "lr":
        made.body(f"arm_{s}", trunnions[s], 600.0, middle=0.5 * (trunnions[s] + pins[s]))
        if yokes:
            made.body(f"yoke_{s}", pins[s], 60.0)
    made.body(BLADE, pins["l"], 1900.0, middle=np.array([2.7, 0.0, 0.6]))
    for s in "lr":
        made.joint(f"trunnion_{s}", "spherical", (MAIN, f"arm_{s}"), trunnions[s])
        if yokes:
            made.joint(f"pitch_{s}", "revolute", (f"arm_{s}", f"yoke_{s}"), pins[s], LATERAL)
            made.joint(f"yaw_{s}", "revolute", (f"yoke_{s}", BLADE), pins[s], (0.0, 0.0, 1.0))
        else:
            made.joint(f"pin_{s}", "revolute" if s == "l" else "spherical", (f"arm_{s}", BLADE), pins[s], LATERAL)
    for s, side in (("l", 1.0), ("r", -1.0)):
        foot, eye = np.array([1.5, side * 1.32, 0.62]), np.array([2.55, side * 1.3, 1.15])
        if s == "l" or dual:
            made.ram(Ram(f"tilt_{s}", (f"arm_{s}", BLADE), foot, eye, 0.05, stiffness=5e7))
        else:
            made.link("brace", ("arm_r", BLADE), foot, eye)
        lift = np.array([1.3, side * 0.5, 1.6]), np.array([2.45, side * 0.55, 0.55])
        made.ram(Ram(f"lift_{s}", (MAIN, BLADE), *lift, 0.25, passive=s == "r"))
    made.link("tag", (MAIN, BLADE), np.array([2.0, 0.75, 0.62]), np.array([2.45, -0.95, 0.6]))
    return made.mechanism("dozer", ("lift_l", "tilt_l", *(("tilt_r",) if dual else ())))


# ---- by other means --------------------------------------------------------------------------------------------------
def frame_turn(drawn: Blade, stroke: float) -> float:
    """The C-frame's angle (about y, rad) at a stroke of its left lift cylinder: the law of cosines, seen from the
    side."""
    ram = drawn.ram("lift_l")
    foot, eye = ram.foot - drawn.pivot, ram.eye - drawn.pivot
    aside = eye[1] - foot[1]
    across = np.sqrt((ram.length + stroke) ** 2 - aside**2)
    a, b = np.hypot(foot[0], foot[2]), np.hypot(eye[0], eye[2])
    corner = np.arccos((a * a + b * b - across**2) / (2.0 * a * b))
    high, low = np.arctan2(foot[2], foot[0]), np.arctan2(eye[2], eye[0])
    return float(corner - (high - low))


class Follower:
    """A body on a ball that is followed from pose to pose in small steps. `least`: how far from a dead point it was on
    its last way, as the least determinant of how its links lengthen by its turns, in shares of the drawn pose's."""

    def __init__(self, links: Sequence[tuple[np.ndarray, np.ndarray]], ball: np.ndarray) -> None:
        self._links, self._ball = links, ball
        self._lengths = np.array([np.linalg.norm(b - a) for a, b in links])
        self._drawn = self._lengths.copy()
        self.matrix = np.eye(3)
        self._first = self._determinant()
        self.least = 1.0

    def _determinant(self) -> float:
        arms = [(self.matrix @ (eye - self._ball), foot - self._ball) for foot, eye in self._links]
        return float(np.linalg.det([np.cross(arm, arm - foot) / np.linalg.norm(arm - foot) for arm, foot in arms]))

    def at(self, strokes: Sequence[float], steps: int = 20) -> np.ndarray:
        """Its rotation with the links so much longer than drawn."""
        goal = self._drawn + np.array(strokes)
        start, self.least = self._lengths, np.inf
        for share in np.linspace(0.0, 1.0, steps + 1)[1:]:
            self.matrix = turned(self._links, self._ball, start + share * (goal - start), self.matrix)
            self.least = min(self.least, self._determinant() / self._first)
        self._lengths = goal
        return self.matrix


# ---- as a mechanism --------------------------------------------------------------------------------------------------
class _Maker:
    def __init__(self, root: str) -> None:
        self._root = root
        self._bodies: dict[str, tuple[np.ndarray, float]] = {}
        self._joints: dict[str, tuple[str, tuple[str, str], np.ndarray, Sequence[float]]] = {}
        self._kinds: dict[str, LinkKind] = {}
        self._rams: list[Ram] = []

    def body(self, name: str, at: np.ndarray, mass: float, *, middle: np.ndarray | None = None) -> None:
        self._bodies[name] = (at if middle is None else middle, mass)

    def joint(
        self,
        name: str,
        kind: str,
        bodies: tuple[str, str],
        at: np.ndarray,
        axis: Sequence[float] = (0.0, 0.0, 1.0),
        link: LinkKind = "pin",
    ) -> None:
        self._joints[name] = (kind, bodies, at, axis)
        self._kinds[name] = link

    def ram(self, ram: Ram) -> None:
        barrel, rod = f"{ram.name}_barrel", f"{ram.name}_rod"
        line = (ram.eye - ram.foot) / ram.length
        self.body(barrel, ram.foot, 60.0, middle=ram.foot + 0.3 * ram.length * line)
        self.body(rod, ram.eye, 40.0, middle=ram.eye - 0.3 * ram.length * line)
        self.joint(f"{ram.name}_foot", "spherical", (ram.bodies[0], barrel), ram.foot, link=_link(ram, "hung"))
        self.joint(ram.name, "prismatic", (barrel, rod), ram.eye, line, "slide")
        self.joint(f"{ram.name}_eye", "spherical", (rod, ram.bodies[1]), ram.eye, link=_link(ram, "loose"))
        self._rams.append(ram)

    def link(self, name: str, bodies: tuple[str, str], foot: np.ndarray, eye: np.ndarray) -> None:
        """A body between two balls."""
        self.body(name, foot, 40.0, middle=0.5 * (foot + eye))
        self.joint(f"{name}_foot", "spherical", (bodies[0], name), foot)
        self.joint(f"{name}_eye", "spherical", (name, bodies[1]), eye)

    def mechanism(self, name: str, driven: Sequence[str]) -> Mechanism:
        links = [
            Link(n, bodies, self._kinds[n], kind == "revolute") for n, (kind, bodies, _, _) in self._joints.items()
        ]
        tree = span_tree(self._root, links)
        origins = {self._root: np.zeros(3)} | {b: self._joints[j][2] for b, j in tree.leading.items()}
        travel = {r.name: r.travel for r in self._rams}
        stiffness = {r.name: r.stiffness for r in self._rams}
        joints = []
        for joint, (kind, bodies, at, axis) in self._joints.items():
            lower = upper = drive = None
            if joint in driven:
                lower, upper = -travel[joint], travel[joint]
                drive = Drive("position", stiffness[joint], 0.0, 6e5, 0.25)
            elif kind == "prismatic":
                lower, upper = -2.0 * travel[joint], 2.0 * travel[joint]
            sides = tree.sides[joint]
            sign = -1.0 if kind == "prismatic" and sides != bodies else 1.0
            at3, axis3 = tuple(map(float, at)), tuple(sign * float(v) for v in axis)
            cut = joint in tree.cuts
            joints.append(Joint(joint, kind, *sides, at3, axis3, lower, upper, cut=cut, drive=drive))  # type: ignore[arg-type]
        return Mechanism(
            name,
            name,
            self._root,
            tuple(self._body(b, origins[b]) for b in tree.bodies),
            tuple(joints),
            tuple(_cylinder(r, r.name not in driven) for r in self._rams),
            tuple(Actuator(n, "cylinder", (ActuatorJoint(n),), (n,)) for n in driven),
            tree.loops,
        )

    def _body(self, name: str, origin: np.ndarray) -> Body:
        middle, mass = self._bodies[name]
        wide = name in (MAIN, BLADE, FRAME, "drawbar")
        inertia = mass * (np.diag([0.3, 0.1, 0.25]) if wide else 0.05 * np.eye(3))
        at, com = tuple(map(float, origin)), tuple(map(float, middle))
        return Body(name, at, mass, com, inertia, (), np.array([origin, middle]))  # type: ignore[arg-type]


def _link(ram: Ram, passive: LinkKind) -> LinkKind:
    return passive if ram.passive else "driven"


def _cylinder(ram: Ram, passive: bool) -> Cylinder:
    sizes = (0.11, 0.07, 2.0 * ram.travel, ram.length - ram.travel, ram.length, 2.5e7, 6e5, 4e5, 0.25)
    names = (f"{ram.name}_barrel", f"{ram.name}_rod", ram.name, f"{ram.name}_foot", f"{ram.name}_eye")
    return Cylinder(ram.name, *names, *sizes, passive=passive)


def strokes(count: int, travels: Mapping[str, float], seed: int = 3) -> dict[str, np.ndarray]:
    """Paths that touch both ends of every stroke, each in its own time."""
    time = np.linspace(0.0, 1.0, count)
    return {
        name: travel * np.sin(2.0 * np.pi * (seed + number) * time * 0.5)
        for number, (name, travel) in enumerate(travels.items())
    }
