"""Models that are played, and questions as they see them."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from doubted_machine import Doubted

from kit.endpoint import Reply


@dataclass(frozen=True)
class Shown:
    """A question as a model sees it: the names of its parts, the bodies offered, the text and the pictures."""

    names: tuple[str, ...]
    offered: tuple[str, ...]
    words: str
    pictures: tuple[bytes, ...]


Model = Callable[[Shown], str]
"""The body that a model points to."""


def shown(body: Mapping[str, Any]) -> Shown:
    """What the first question of a request shows."""
    parts = body["messages"][1]["content"]
    text = parts[0]["text"]
    names = re.search(r"<names>\n(.*?)\n</names>", text, re.DOTALL)
    assert names is not None
    offered = re.findall(r"^- (\w+)", text, re.MULTILINE)
    urls = [part["image_url"]["url"] for part in parts[1:] if part["type"] == "image_url"]
    pictures = tuple(base64.b64decode(url.removeprefix("data:image/png;base64,"), validate=True) for url in urls)
    return Shown(tuple(names.group(1).splitlines()), tuple(offered), text, pictures)


def playing(model: Model) -> Callable[[Mapping[str, Any]], Reply]:
    return lambda body: (200, json.dumps({"answer": model(shown(body)), "reason": "it looks like that"}))


def agreeing(doubted: Doubted) -> Model:
    bodies = {p.part: p.body for p in doubted.alignment.parts}
    return lambda one: bodies[f"Assembly/{one.names[0]}"] or "none"


def lying(doubted: Doubted) -> Model:
    """Never what was found, and never the truth."""
    found = agreeing(doubted)

    def model(one: Shown) -> str:
        truth = doubted.truth[f"Assembly/{one.names[0]}"]
        return next(body for body in one.offered if body not in (found(one), truth))

    return model


def truthful(doubted: Doubted) -> Model:
    def model(one: Shown) -> str:
        truth = doubted.truth[f"Assembly/{one.names[0]}"]
        return truth if truth in one.offered else "none"

    return model


def nothing(doubted: Doubted) -> Model:
    return lambda one: "none"
