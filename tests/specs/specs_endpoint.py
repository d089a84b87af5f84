"""A language model's endpoint on the loopback interface, and how it may answer: in other formats, with prose around,
refusing, failing. Every request is kept. What the models say of a page is `kit.sheets.page_models`'."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from kit import endpoint
from kit.endpoint import SECRET, Reply
from kit.sheets import page_models
from kit.sheets.page_models import Question, question_of

Model = Callable[["Request"], Reply]


@dataclass(frozen=True)
class Request:
    """What was asked, and the request's body."""

    question: Question
    body: Mapping[str, Any]


@dataclass
class Server:
    """Where it listens, what was asked, and with which headers."""

    url: str
    requests: list[Request]
    headers: list[dict[str, str]]


@contextmanager
def serving(model: Model) -> Iterator[Server]:
    requests: list[Request] = []

    def reply(body: Mapping[str, Any]) -> Reply:
        text = next(m["content"] for m in body["messages"] if m["role"] == "user")
        requests.append(Request(question_of(text), body))
        return model(requests[-1])

    with endpoint.serving(reply) as server:
        yield Server(server.url, requests, server.headers)


def playing(model: page_models.Model) -> Model:
    """A played model behind an endpoint."""
    return lambda request: (200, json.dumps({"values": model(request.question)}))


def chatting(model: Model) -> Model:
    """A model's answers in a fence with prose around; at first prose alone."""

    def reply(request: Request) -> Reply:
        if len(request.body["messages"]) == 2:
            return 200, "Certainly! I would be glad to help with that."
        status, text = model(request)
        return status, f"Certainly! Here it is:\n```json\n{text}\n```\nLet me know."

    return reply


def refusing(model: Model, *kinds: str) -> Model:
    """HTTP 400 for the answer formats named."""

    def reply(request: Request) -> Reply:
        form = request.body.get("response_format", {}).get("type", "prompt")
        return (400, f"{form} is not supported") if form in kinds else model(request)

    return reply


def failing(request: Request) -> Reply:
    return 400, f"no such model; your key was {SECRET}"
