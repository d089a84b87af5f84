"""A language model's endpoint on the loopback interface, and how it may answer: in other formats, with prose around,
refusing, failing. Every request is kept. What the models say of a page is `kit.sheets.page_models`'."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from kit.sheets import page_models
from kit.sheets.page_models import Question, completion, question_of

Reply = tuple[int, str]
"""HTTP status and the message's text."""
Model = Callable[["Request"], Reply]
SECRET = "sk-not-to-be-shown"


@dataclass(frozen=True)
class Request:
    """What was asked, and the request's body."""

    question: Question
    body: Mapping[str, Any]


@dataclass
class Server:
    """Where it listens, what was asked, and with which headers."""

    url: str
    requests: list[Request] = field(default_factory=list)
    headers: list[dict[str, str]] = field(default_factory=list)


@contextmanager
def serving(model: Model) -> Iterator[Server]:
    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_POST(self) -> None:
            body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            text = next(m["content"] for m in body["messages"] if m["role"] == "user")
            request = Request(question_of(text), body)
            server.requests.append(request)
            server.headers.append(dict(self.headers))
            status, text = model(request)
            data = json.dumps(completion(text) if status == 200 else {"error": {"message": text}}).encode()
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
