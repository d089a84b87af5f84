"""A language model's endpoint on the loopback interface, and the models it plays: honest, inventing, yes-saying,
pointing at the wrong property, chatting, and failing. Every request is kept."""

from __future__ import annotations

import json
import re
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import pytest
from openai.types.chat import ChatCompletion

from yellowiron.specs.llm.endpoint import Endpoint

Facts = Mapping[str, tuple[str, str, str]]
"""Wanted name → words of its row, number as printed, unit."""
Reply = tuple[int, str]
"""HTTP status and the message's text."""
Model = Callable[["Question"], Reply]
SECRET = "sk-not-to-be-shown"


@dataclass(frozen=True)
class Question:
    """What was asked: its kind (the answer's property), the sheet's text, the wanted names, the request's body."""

    kind: str
    sheet: str
    names: tuple[str, ...]
    text: str
    body: Mapping[str, Any]

    @property
    def lines(self) -> dict[int, str]:
        """Numbered lines of a list."""
        return {int(m[1]): m[2] for m in re.finditer(r"^(\d+)\. (.*)$", self.sheet, re.MULTILINE)}


@dataclass
class Server:
    """Where it listens, what was asked, and with which headers."""

    url: str
    questions: list[Question] = field(default_factory=list)
    headers: list[dict[str, str]] = field(default_factory=list)


@contextmanager
def serving(model: Model) -> Iterator[Server]:
    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_POST(self) -> None:
            body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            question = _question(body)
            server.questions.append(question)
            server.headers.append(dict(self.headers))
            status, text = model(question)
            data = json.dumps(_completion(text) if status == 200 else {"error": {"message": text}}).encode()
            self.send_response(status)
            self.send_header("Content-Type", "application/json")
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            self.wfile.write(data)

        def log_message(self, *_: object) -> None:
            pass

    http = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    http.daemon_threads = True
    server = Server(f"http://127.0.0.1:{http.server_port}/v1")
    thread = threading.Thread(target=http.serve_forever, kwargs={"poll_interval": 0.02})
    thread.start()
    try:
        yield server
    finally:
        http.shutdown()
        thread.join()
        http.server_close()


@contextmanager
def at_hand(model: Model) -> Iterator[list[Question]]:
    """The model answers in this process, for thousands of questions, whose way there would be most of the work; what
    was asked."""
    asked: list[Question] = []

    def completion(
        self: Endpoint, messages: Sequence[Mapping[str, str]], schema: Mapping[str, Any], rung: str
    ) -> ChatCompletion:
        asked.append(_question({"messages": messages}))
        status, text = model(asked[-1])
        assert status == 200
        return ChatCompletion.model_validate(_completion(text))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Endpoint, "_completion", completion)
        yield asked


def _completion(text: str) -> dict[str, Any]:
    return {
        "id": "1", "object": "chat.completion", "created": 0, "model": "m",
        "choices": [{"index": 0, "finish_reason": "stop", "message": {"role": "assistant", "content": text}}],
        "usage": {"prompt_tokens": 100, "completion_tokens": 10, "total_tokens": 110},
    }  # fmt: skip


def _question(body: Mapping[str, Any]) -> Question:
    text = next(m["content"] for m in body["messages"] if m["role"] == "user")
    sheet = text[text.index("<sheet>") + 7 : text.index("</sheet>")].strip()
    asked = text[text.index("</sheet>") :]
    if "Summarise the text" in asked:
        kind = "rows"
    elif "For each line" in asked:
        kind = "lines"
    else:
        kind = "value" if "value of:" in asked else "unit" if "unit of" in asked else "answer"
    single = re.search(r"value of: (.*?) \(|value \S.* of (.*?)\? Give|say that (.*?) is ", asked)
    listed = tuple(m[1] for m in re.finditer(r"^- (.*?) \(", asked, re.MULTILINE))
    names = listed or tuple(g for g in (single.groups() if single else ()) if g)
    return Question(kind, sheet, names, asked, body)


def answer(**properties: Any) -> Reply:
    return 200, json.dumps(properties)


def honest(facts: Facts) -> Model:
    """Says what the sheet says."""

    def reply(q: Question) -> Reply:
        there = {n: f for n, f in facts.items() if n in q.names and f[0].casefold() in q.sheet.casefold()}
        if q.kind == "lines":
            named = [
                {"line": number, "name": n}
                for number, line in q.lines.items()
                for n, f in there.items()
                if f[0].casefold() in line.casefold()
            ]
            return answer(lines=named)
        if q.kind == "rows":
            return answer(rows=[{"name": n, "value": f[1], "unit": f[2]} for n, f in there.items()])
        fact = there.get(q.names[0]) if q.names else None
        if q.kind == "value":
            return answer(value=fact[1] if fact else "none")
        if q.kind == "unit":
            return answer(unit=fact[2] if fact else "none")
        return answer(answer="yes" if fact and f"{fact[1]} {fact[2]}" in q.text else "no")

    return reply


def numbers_in(line: str) -> list[tuple[str, str]]:
    """Every number of a line with the word after it."""
    return [(m[1], m[2] or "mm") for m in re.finditer(r"(\d[\d.,]*)\s*([^\W\d]+[/\d\w·]*)?", line)]


def yes_saying(q: Question) -> Reply:
    """Takes every line for every quantity, and every number of it for the value."""
    found = numbers_in(q.sheet.rpartition("|")[2]) or [("1", "mm")]
    if q.kind == "lines":
        return answer(lines=[{"line": n, "name": name} for n in q.lines for name in q.names])
    if q.kind == "rows":
        return answer(rows=[{"name": n, "value": v, "unit": u} for n in q.names for v, u in found])
    return answer(**{q.kind: {"value": found[0][0], "unit": found[0][1], "answer": "yes"}[q.kind]})


def inventing(q: Question) -> Reply:
    """Never says none; its numbers are its own."""
    if q.kind == "lines":
        return answer(lines=[{"line": n, "name": name} for n in q.lines for name in q.names])
    if q.kind == "rows":
        return answer(rows=[{"name": n, "value": "1234", "unit": "mm"} for n in q.names])
    return answer(**{q.kind: {"value": "1234", "unit": "mm", "answer": "yes"}[q.kind]})


def wrong_property(q: Question) -> Reply:
    """Points each line at one quantity, whatever the line says, with the number that stands there."""
    found = numbers_in(q.sheet.rpartition("|")[2]) or [("1", "mm")]
    if q.kind == "lines":
        return answer(lines=[{"line": n, "name": q.names[n % len(q.names)]} for n in q.lines])
    if q.kind == "rows":
        return answer(
            rows=[{"name": n, "value": v, "unit": u} for n, (v, u) in zip(q.names, found[::-1], strict=False)]
        )
    return answer(**{q.kind: {"value": found[0][0], "unit": found[0][1], "answer": "yes"}[q.kind]})


def chatting(model: Model) -> Model:
    """A model's answers in a fence with prose around; every third one is prose alone at first."""

    def reply(q: Question) -> Reply:
        if len(q.body["messages"]) == 2 and sum(map(ord, q.sheet)) % 3 == 0:
            return 200, "Certainly! I would be glad to help with that."
        status, text = model(q)
        return status, f"Certainly! Here it is:\n```json\n{text}\n```\nLet me know."

    return reply


def refusing(model: Model, *kinds: str) -> Model:
    """HTTP 400 for the answer formats named."""

    def reply(q: Question) -> Reply:
        form = q.body.get("response_format", {}).get("type", "prompt")
        return (400, f"{form} is not supported") if form in kinds else model(q)

    return reply


def failing(q: Question) -> Reply:
    return 400, f"no such model; your key was {SECRET}"
