"""How probable it is that a part's place is right: a logistic curve over what the place was found by, fitted to many
synthetic machines whose truth is known (`data/confidence.json`, made by `benchmarks/bench_confidence.py`)."""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Mapping
from importlib import resources

from yellowiron.alignment.labelling.place import Place

Grounds = Mapping[str, float]
"""What a probability rests on, by name; see `grounds`."""
REVIEW = 0.5
"""Parts whose evidence has less strength than this are for a person to look at."""
LIMIT = 0.005
"""No place is surer than 1 less this: the machines fitted to are not the world."""


def grounds(place: Place, *, whole: bool, rung: int) -> dict[str, float]:
    """What speaks for and against a place. `strength`: the log-odds of the solver's own measure; `by …`: 1 for what it
    was found by; `doubted`: 1 where it is listed for review; `whole`: 1 if every body and joint of the machine was
    found, no cylinder left over; `rung`: how often the contact tolerance was widened; `names for`, `names against`: how
    much more the part's names speak of its body than of any other, or of another; `lead`: how many more of its body's
    joints hold than of the runner-up's."""
    strength = min(max(place.confidence, 0.02), 0.98)
    return {
        "strength": round(math.log(strength / (1 - strength)), 3),
        f"by {place.how}": 1.0,
        **({"doubted": 1.0} if place.confidence < REVIEW else {}),
        "whole": float(whole),
        "rung": float(rung),
        "names for": round(max(place.said, 0.0), 3),
        "names against": round(max(-place.said, 0.0), 3),
        **({"lead": round(place.lead, 3)} if place.how == "joints" else {}),
    }


@functools.cache
def _weights() -> dict[str, float]:
    text = resources.files("yellowiron.alignment").joinpath("data/confidence.json").read_text(encoding="utf-8")
    return dict(json.loads(text)["weights"])


def probability(of: Grounds) -> float:
    """That a place with these grounds is right, at most 1 − `LIMIT`."""
    weights = _weights()
    odds = weights["always"] + sum(weights.get(name, 0.0) * value for name, value in of.items())
    return min(1.0 / (1.0 + math.exp(-odds)), 1.0 - LIMIT)
