"""The studio's address: a page and a few paths below it, for this computer and whoever has the token.

Every request has the token, names this server as its host, and comes from this page or from none; nothing is read from
the disk but what the studio was started with. A decision that was answered with 200 is on the disk.
"""

from __future__ import annotations

import asyncio
import contextlib
import datetime
import json
import secrets
import socket
import tempfile
import threading
from collections.abc import AsyncIterator, Callable, Mapping
from dataclasses import asdict
from importlib import resources
from pathlib import Path
from typing import Any

from yellowiron import report, specs
from yellowiron.model.errors import YellowironError
from yellowiron.opinion.doubts import boxes_of, size_of
from yellowiron.report.html.viewer import NOT_BUNDLED, asset, script
from yellowiron.report.words import titled
from yellowiron.studio.axes import axis_of, read_picks
from yellowiron.studio.building import Build
from yellowiron.studio.joints import joints_of, rounds_of
from yellowiron.studio.machine import all_of
from yellowiron.studio.operations import LARGEST_TEXT, words
from yellowiron.studio.patterns import pattern_of, patterns_of
from yellowiron.studio.questions import questions
from yellowiron.studio.scene import Scene
from yellowiron.studio.session import Session, State
from yellowiron.support import stopping
from yellowiron.support.text import to_json

try:
    import uvicorn
    from starlette.applications import Starlette
    from starlette.concurrency import run_in_threadpool
    from starlette.datastructures import Headers
    from starlette.requests import Request
    from starlette.responses import PlainTextResponse, Response, StreamingResponse
    from starlette.routing import Route
    from starlette.types import ASGIApp, Receive, Scope, Send
except ImportError as error:
    raise YellowironError(
        "The studio needs two libraries more", where="yellowiron studio",
        hint='Install them with: pip install "yellowiron[studio]"',
    ) from error  # fmt: skip

LARGEST_BODY = 4 * 1024 * 1024
"""Bytes of a request: a decision on ten thousand parts has a tenth of that."""
_LOOK = 0.15
"""Seconds between two looks for what is new."""
_HEAD = {
    "Cache-Control": "no-store",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Cross-Origin-Resource-Policy": "same-origin",
}
_STYLES = ("page.css", "viewer.css")


def serve(session: Session, *, port: int = 0, ready: Callable[[str], None] = lambda address: None) -> None:
    """Serves a session's page until the process is interrupted. `port` 0 takes any that is free; `ready` is told the
    address with its token. `YellowironError` for a port that is taken."""
    listening = socket.socket()
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind(("127.0.0.1", port))
        # Who is told the address may come at once.
        listening.listen(128)
    except OSError as error:
        raise YellowironError(
            f"The port {port} cannot be used: {error.strerror or error}", where="--port", hint="Name another, or none."
        ) from error
    token, chosen = secrets.token_urlsafe(24), int(listening.getsockname()[1])
    studio = application(session, token=token, port=chosen)
    settings = uvicorn.Config(studio, log_level="error", access_log=False, timeout_graceful_shutdown=1)
    ready(f"http://127.0.0.1:{chosen}/?token={token}")
    with stopping.until_interrupted():
        uvicorn.Server(settings).run(sockets=[listening])


def application(session: Session, *, token: str, port: int) -> ASGIApp:
    """The studio as an ASGI application behind its guard."""
    pages = _Pages(session)
    routes = [
        Route("/", pages.page),
        Route("/shapes", pages.shapes),
        Route("/machine", pages.machine),
        Route("/state", pages.state),
        Route("/sheet/{number:int}", pages.sheet),
        Route("/events", pages.events),
        *(Route(f"/{name}", pages.meant, methods=["POST"]) for name in ("axis", "rounds", "patterns")),
        *(Route(f"/{name}", pages.said, methods=["POST"]) for name in ("do", "undo", "redo", "build")),
    ]

    @contextlib.asynccontextmanager
    async def lifespan(_: Starlette) -> AsyncIterator[None]:
        yield
        pages.close()

    return _Guard(Starlette(routes=routes, lifespan=lifespan), token=token, port=port)


class _Guard:
    """Lets in who has the token, names this server as its host, comes from this page, and asks for little."""

    def __init__(self, inner: ASGIApp, *, token: str, port: int) -> None:
        self._inner, self._token = inner, token
        self._hosts = {f"127.0.0.1:{port}", f"localhost:{port}"}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self._inner(scope, receive, send)
            return
        if scope["type"] != "http":
            return
        refusal = self._refusal(scope)
        if refusal is not None:
            await PlainTextResponse(refusal[1], refusal[0], headers=_HEAD)(scope, receive, send)
            return
        await self._inner(scope, receive, send)

    def _refusal(self, scope: Scope) -> tuple[int, str] | None:
        headers, request = Headers(scope=scope), Request(scope)
        origin = headers.get("origin")
        if headers.get("host") not in self._hosts:
            return 403, "This server has another name."
        if origin is not None and origin.removeprefix("http://") not in self._hosts:
            return 403, "This page is not the studio's."
        given = headers.get("x-yellowiron-token") or request.query_params.get("token", "")
        if not secrets.compare_digest(given.encode(), self._token.encode()):
            return 403, "The address lacks its token: take the one that the command line shows."
        length = headers.get("content-length", "0")
        if not length.isdigit() or int(length) > LARGEST_BODY:
            return 413, "That is more than a decision can be."
        return None


class _Pages:
    """What is behind each path."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._scene = Scene(session.assembly)
        self._boxes = boxes_of(session.assembly)
        self._build = Build(session.setup)
        self._machine: tuple[int, bytes] = (0, b"")
        self._questions: tuple[int, list[dict[str, Any]], list[dict[str, Any]]] = (0, [], [])
        self._lock = threading.Lock()
        self._folder = tempfile.TemporaryDirectory(prefix="yellowiron-")
        self._drawn: dict[tuple[str, int], Path] | None = None

    def close(self) -> None:
        """Ends what still runs, and removes what was drawn."""
        self._build.stop()
        self._session.close()
        self._folder.cleanup()

    async def page(self, request: Request) -> Response:
        """The page, whole: it asks for nothing else but what is below."""
        nonce = secrets.token_urlsafe(12)
        folder = resources.files("yellowiron.studio").joinpath("data")
        html, style = (folder.joinpath(n).read_text(encoding="utf-8") for n in ("studio.html", "studio.css"))
        html = html.replace("{nonce}", nonce).replace("{style}", asset(*_STYLES) + style)
        source = script("yellowiron.studio", "studio")
        html = html.replace("{waiting}", "Loading the machine …" if source else NOT_BUNDLED).replace("{script}", source)
        policy = (
            f"default-src 'none'; script-src 'nonce-{nonce}'; style-src 'unsafe-inline'; connect-src 'self'; "
            "img-src 'self' data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        )
        return Response(html, media_type="text/html", headers={**_HEAD, "Content-Security-Policy": policy})

    async def shapes(self, request: Request) -> Response:
        """Every part's shape, packed."""
        return Response(self._scene.shapes, media_type="application/octet-stream", headers=_HEAD)

    async def machine(self, request: Request) -> Response:
        """The machine of the present state, packed."""
        data = await run_in_threadpool(self._packed)
        return Response(data, media_type="application/octet-stream", headers=_HEAD)

    async def state(self, request: Request) -> Response:
        """What there is to ask, and what was said."""
        return await self._answer(lambda: None)

    async def sheet(self, request: Request) -> Response:
        """A page of the sheets with a box around every value (PNG), by its number and, of several sheets, the
        sheet's name."""
        pages = await run_in_threadpool(self._sheets)
        number = int(request.path_params["number"])
        name = request.query_params.get("file") or next((name for name, page in pages if page == number), "")
        file = pages.get((name, number))
        if file is None:
            return PlainTextResponse("There is no such page with a value on it.", 404, headers=_HEAD)
        return Response(file.read_bytes(), media_type="image/png", headers=_HEAD)

    async def said(self, request: Request) -> Response:
        """A decision, or one taken back, or a build begun."""
        body = await _body(request)
        if body is None:
            return PlainTextResponse("That is more than a decision can be.", 413, headers=_HEAD)
        act: dict[str, Callable[[], object]] = {
            "do": lambda: self._done(body),
            "undo": self._session.undo,
            "redo": self._session.redo,
            "build": self._begun,
        }
        return await self._answer(act[request.url.path.strip("/")])

    async def meant(self, request: Request) -> Response:
        """What a person may mean; nothing is decided by it: the axis of some clicks, the axes near a joint, or the
        patterns that fit a selection, or one that is being written."""
        body = await _body(request)
        if body is None:
            return PlainTextResponse("That is more than a few clicks can be.", 413, headers=_HEAD)
        act: dict[str, Callable[[Any], Mapping[str, Any]]] = {
            "axis": self._axis, "rounds": self._rounds, "patterns": self._patterns,
        }  # fmt: skip
        return await _asked(lambda: act[request.url.path.strip("/")](_parsed(body)))

    def _axis(self, entry: Any) -> dict[str, Any]:
        assembly = self._session.assembly
        return asdict(axis_of(read_picks(entry, assembly), assembly))

    def _rounds(self, entry: Any) -> dict[str, Any]:
        name = entry.get("joint") if isinstance(entry, dict) else None
        return {"rounds": [asdict(axis) for axis in rounds_of(self._session.state, str(name))]}

    def _patterns(self, entry: Any) -> dict[str, Any]:
        said = entry if isinstance(entry, dict) else {}
        fitting, rules, parts = self._session.fitting, self._session.state.aligned.rules, said.get("parts")
        if isinstance(text := said.get("pattern"), str) and 0 < len(text.strip()) <= LARGEST_TEXT:
            found = [pattern_of(text.strip(), fitting, rules)]
        elif isinstance(parts, list) and all(part in self._session.parts for part in map(str, parts)):
            found = patterns_of([str(part) for part in parts], self._session.assembly, fitting, rules)
        else:
            raise YellowironError("That names no parts and no pattern", where="studio", hint="Reload the page.")
        return {"patterns": [asdict(one) for one in found]}

    async def events(self, request: Request) -> Response:
        """Tells a page, as long as it listens, that another state is there or the build has gone on."""

        async def told() -> AsyncIterator[str]:
            before: tuple[int, int] | None = None
            while not await request.is_disconnected():
                now = (self._session.state.version, self._session.said + self._build.count)
                if now != before:
                    yield f"data: {json.dumps({'version': now[0], 'changes': now[1]})}\n\n"
                    before = now
                await asyncio.sleep(_LOOK)

        return StreamingResponse(told(), media_type="text/event-stream", headers=_HEAD)

    def _done(self, body: bytes) -> None:
        entry = _parsed(body)
        today = datetime.date.today().isoformat()
        if isinstance(entry, dict):
            entry = {**self._session.mirrored(entry), "date": today}
        self._session.do(self._session.read(entry))

    def _begun(self) -> None:
        self._session.keep()
        self._build.start()

    async def _answer(self, act: Callable[[], object]) -> Response:
        def told() -> dict[str, Any]:
            act()
            return self._told(self._session.state)

        return await _asked(told)

    def _told(self, state: State) -> dict[str, Any]:
        operations, cursor = self._session.history()
        document = state.document
        roles = [r for r in state.template.roles if r.kind != "group" and state.template.body_of(r.name) is not None]
        return {
            "version": state.version,
            "said": self._session.said,
            "solved": state.said,
            "machine": titled(state.template.equipment_type),
            "file": self._session.setup.cad.name,
            "verdict": state.failed or document.get("verdict", ""),
            "causes": [asdict(cause) for cause in report.causes(document)] if document else [],
            "tally": report.tally(document) if document else "no machine yet",
            "questions": self._asked(state)[0],
            "joints": self._asked(state)[1],
            "history": [
                {"words": words(o), "by": o.signature.by, "date": o.signature.date, "holds": k < cursor}
                for k, o in enumerate(operations)
            ],
            "remarks": list(state.remarks),
            "machineSaid": [asdict(one) for one in all_of(state, self._session.template)],
            "roles": [{"name": r.name, "words": titled(r.name), "body": state.template.body_of(r.name)} for r in roles],
            "values": [report.specification_entry(s) for s in state.specifications],
            "build": {"state": self._build.state, "lines": self._build.lines[-12:],
                      "command": " ".join(["yellowiron", *self._session.setup.command()])},
        }  # fmt: skip

    def _asked(self, state: State) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
        """The questions and the joints of a state, made once."""
        version, asked, joints = self._questions
        if version != state.version:
            known = joints_of(state, size_of(self._boxes))
            asked = [asdict(question) for question in questions(state, self._boxes, known)]
            joints = [asdict(joint) for joint in known]
            self._questions = (state.version, asked, joints)
        return asked, joints

    def _packed(self) -> bytes:
        with self._lock:
            state = self._session.state
            if self._machine[0] != state.version:
                self._machine = (state.version, self._scene.machine(state))
            return self._machine[1]

    def _sheets(self) -> dict[tuple[str, int], Path]:
        with self._lock:
            if self._drawn is None:
                found: dict[tuple[str, int], Path] = {}
                for place, sheet in enumerate(self._session.setup.sheets):
                    folder = Path(self._folder.name, str(place))
                    drawn = specs.draw_evidence([sheet], self._session.state.specifications, folder)
                    for file in drawn:
                        found.setdefault((sheet.name, _number(file)), file)
                self._drawn = found
            return self._drawn


def _number(file: Path) -> int:
    """The page that a picture of it is named by."""
    digits = "".join(letter if letter.isdigit() else " " for letter in file.stem).split()
    return int(digits[-1]) if digits else 0


async def _asked(answer: Callable[[], Mapping[str, Any]]) -> Response:
    """What an answer is, or why there is none."""

    def answered() -> tuple[int, str]:
        try:
            return 200, to_json(answer())
        except YellowironError as error:
            return 400, to_json({"message": error.message, "where": error.where, "hint": error.hint})

    status, text = await run_in_threadpool(answered)
    return Response(text, status, media_type="application/json", headers=_HEAD)


def _parsed(body: bytes) -> Any:
    try:
        return json.loads(body)
    except (ValueError, RecursionError) as error:
        raise YellowironError("The message is no JSON", where="studio", hint="Reload the page.") from error


async def _body(request: Request) -> bytes | None:
    """What a request brings; None where it is too much."""
    found = b""
    async for chunk in request.stream():
        found += chunk
        if len(found) > LARGEST_BODY:
            return None
    return found
