"""Bodies that slew on another and yet reach down as far: what carries a machine is at its bottom."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.structure.ground_cut import BELOW, heights, layers
from yellowiron.alignment.structure.min_cut import held_by
from yellowiron.alignment.structure.observation import Observation, slewing_joints
from yellowiron.model.geometry import Floats


def regrounded(observation: Observation, answer: Answer) -> tuple[Answer, dict[int, str]]:
    """The answer with what reaches the ground on the body that carries; and solid → why it is, for what was moved.

    Of a body that slews on another and reaches about as low, whatever hangs together with its low parts is the
    carrier's, cut off where the least contact holds it to what is wholly above the carrier: a track's belt that runs
    into the deck above it had made one of both."""
    moved: dict[int, str] = {}
    for carrier, carried, up in _slewing(observation, answer):
        own, base = (_members(answer)[body] for body in (carried, carrier))
        solids = observation.solids
        low, high = layers([solids[i] for i in sorted(own)], [solids[i] for i in sorted(base)], up)
        if not high or _heights(own, observation, up)[1] >= _limit(base, observation, up):
            continue
        fallen = held_by(low, high, own, observation.evidence[-1])
        answer = _moved(answer, fallen, carried, carrier)
        moved |= dict.fromkeys(sorted(fallen), f"it reaches the ground, and was drawn into {carried}")
    return answer, moved


def _moved(answer: Answer, solids: frozenset[int], giver: str, taker: str) -> Answer:
    """The answer with some solids of one body as another's."""
    clusters, number = list(answer.structure.clusters), {b: c for c, b in answer.solution.body_of.items()}
    one, other = number[giver], number[taker]
    clusters[one] = replace(clusters[one], members=clusters[one].members - solids)
    clusters[other] = replace(clusters[other], members=clusters[other].members | solids)
    return replace(answer, structure=replace(answer.structure, clusters=tuple(clusters)))


def undercut(observation: Observation, answer: Answer) -> tuple[str, ...]:
    """The two bodies of every slewing joint that was found where the carried one, which is higher on the whole, reaches
    about as low as its carrier: parts of the carrier were taken for it."""
    found: list[str] = []
    for carrier, carried, up in _slewing(observation, answer):
        members = _members(answer)
        if _heights(members[carried], observation, up)[1] < _limit(members[carrier], observation, up):
            found += [carrier, carried]
    return tuple(found)


def too_low(observation: Observation, answer: Answer) -> dict[int, str]:
    """Solid → the body that it is not of, whatever it touches: the carried one of a slewing joint, for what reaches
    down to where nothing but its carrier is, as a track's belt does, whose upper run passes under the machine."""
    found: dict[int, str] = {}
    for carrier, carried, up in _slewing(observation, answer):
        members = _members(answer)
        limit = _limit(members[carrier], observation, up)
        low = {s.index for s in observation.solids if float((s.points @ up).min()) < limit}
        found |= dict.fromkeys(sorted(low - members[carried]), carried)
    return found


def _slewing(observation: Observation, answer: Answer) -> Iterator[tuple[str, str, Floats]]:
    """Of every slewing joint that was found: its carrier, what that carries, and upwards."""
    solution, structure, template, members = answer.solution, answer.structure, answer.template, _members(answer)
    for name in slewing_joints(template):
        bodies = {b for b in template.bodies_of(template.joint(name)) if b is not None}
        if name not in solution.hinge_of or len(bodies) != 2 or not bodies <= members.keys():
            continue
        carrier, carried = sorted(bodies, key=template.depth)
        up = structure.axes[structure.hinges[solution.hinge_of[name]].axis].direction
        below, above = (_heights(members[b], observation, up)[0] for b in (carrier, carried))
        yield carrier, carried, up if above > below else -up


def _members(answer: Answer) -> dict[str, frozenset[int]]:
    return {b: frozenset(answer.structure.clusters[c].members) for c, b in answer.solution.body_of.items()}


def _limit(carrier: frozenset[int], observation: Observation, up: Floats) -> float:
    """The height that what is carried does not reach down to."""
    _, low, high = _heights(carrier, observation, up)
    return low + BELOW * (high - low)


def _heights(members: Collection[int], observation: Observation, up: Floats) -> tuple[float, float, float]:
    return heights([observation.solids[i] for i in sorted(members)], up)
