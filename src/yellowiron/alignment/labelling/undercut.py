"""Bodies that slew on another and yet reach down as far: what carries a machine is at its bottom."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from yellowiron.alignment.assignment.answer import Answer
from yellowiron.alignment.features.solids import Solid
from yellowiron.alignment.structure.clusters import Cluster
from yellowiron.alignment.structure.ground_cut import BELOW, WITHIN, heights, held_by, upwards
from yellowiron.alignment.structure.observation import Observation, slewing_joints
from yellowiron.model.geometry import Floats


def regrounded(observation: Observation, answer: Answer) -> tuple[Answer, dict[int, str]]:
    """The answer with what reaches the ground on the body that carries; and solid → why it is, for what was moved.

    Of a body that slews on another and reaches about as low, whatever hangs together with its low parts is the
    carrier's, cut off where the least contact holds it to what is wholly above the carrier: a track's belt that runs
    into the deck above it had made one of both. Where either of the two bodies was not found, the tracks tell how high
    the carrier is, and one that was found is cut in two."""
    moved: dict[int, str] = {}
    for carrier, carried, up, base in _grounds(observation, answer):
        members = _members(answer)
        own = members[carried if carried in members else carrier]
        _, bottom, top = heights(base, up)
        reach = {i: heights([observation.solids[i]], up) for i in own}
        low = {i for i, (middle, _, _) in reach.items() if middle < bottom + WITHIN * (top - bottom)}
        high = {i for i, (_, lowest, _) in reach.items() if lowest >= top}
        if not high or all(lowest >= bottom + BELOW * (top - bottom) for _, lowest, _ in reach.values()):
            continue
        fallen = held_by(low, high, own, observation.evidence[-1])
        if carried in members:
            answer = _moved(answer, fallen, carried, carrier)
            moved |= dict.fromkeys(sorted(fallen), f"it reaches the ground, and was drawn into {carried}")
        else:
            answer = _moved(answer, own - fallen, carrier, carried)
            moved |= dict.fromkeys(sorted(own - fallen), f"it is above the tracks, and was drawn into {carrier}")
    return answer, moved


def _grounds(observation: Observation, answer: Answer) -> Iterator[tuple[str, str, Floats, Sequence[Solid]]]:
    """Of every slewing joint: its carrier, what that carries, upwards, and the solids whose height is the carrier's:
    its own where the joint was found, or the tracks', where only one of its bodies was."""
    found = {(carrier, carried): up for carrier, carried, up in _slewing(observation, answer)}
    members = _members(answer)
    for name in slewing_joints(answer.template):
        bodies = {b for b in answer.template.bodies_of(answer.template.joint(name)) if b is not None}
        if len(bodies) != 2:
            continue
        carrier, carried = sorted(bodies, key=answer.template.depth)
        if (carrier, carried) in found:
            solids = [observation.solids[i] for i in sorted(members[carrier])]
            yield carrier, carried, found[carrier, carried], solids
        elif observation.rows and observation.up is not None and len(bodies & members.keys()) == 1:
            yield carrier, carried, upwards(observation), observation.rows


def _moved(answer: Answer, solids: frozenset[int], giver: str, taker: str) -> Answer:
    """The answer with some solids of one body as another's, which has a new cluster if it had none."""
    clusters, body_of = list(answer.structure.clusters), dict(answer.solution.body_of)
    number = {b: c for c, b in body_of.items()}
    given = clusters[number[giver]]
    clusters[number[giver]] = replace(given, members=given.members - solids)
    if taker in number:
        taken = clusters[number[taker]]
        clusters[number[taker]] = replace(taken, members=taken.members | solids)
    else:
        body_of[len(clusters)] = taker
        clusters.append(Cluster(solids))
    return replace(
        answer,
        structure=replace(answer.structure, clusters=tuple(clusters)),
        solution=replace(answer.solution, body_of=body_of),
    )


def undercut(observation: Observation, answer: Answer) -> tuple[str, ...]:
    """The two bodies of every slewing joint that was found where the carried one, which is higher on the whole, reaches
    about as low as its carrier: parts of the carrier were taken for it."""
    found: list[str] = []
    for carrier, carried, up in _slewing(observation, answer):
        members = _members(answer)
        if _of(members[carried], observation, up)[1] < _limit(members[carrier], observation, up):
            found += [carrier, carried]
    return tuple(found)


def too_low(observation: Observation, answer: Answer) -> dict[int, str]:
    """Solid → the body that it is not of, whatever it touches: the carried one of a slewing joint, for what reaches
    down to where nothing but its carrier is, as a track's belt does, whose upper run passes under the machine."""
    found: dict[int, str] = {}
    members = _members(answer)
    for _, carried, up, base in _grounds(observation, answer):
        _, bottom, top = heights(base, up)
        limit = bottom + BELOW * (top - bottom)
        low = {s.index for s in observation.solids if float((s.points @ up).min()) < limit}
        found |= dict.fromkeys(sorted(low - members.get(carried, frozenset())), carried)
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
        below, above = (_of(members[b], observation, up)[0] for b in (carrier, carried))
        yield carrier, carried, up if above > below else -up


def _members(answer: Answer) -> dict[str, frozenset[int]]:
    return {b: frozenset(answer.structure.clusters[c].members) for c, b in answer.solution.body_of.items()}


def _limit(carrier: frozenset[int], observation: Observation, up: Floats) -> float:
    """The height that what is carried does not reach down to."""
    _, low, high = _of(carrier, observation, up)
    return low + BELOW * (high - low)


def _of(members: frozenset[int], observation: Observation, up: Floats) -> tuple[float, float, float]:
    return heights([observation.solids[i] for i in sorted(members)], up)
