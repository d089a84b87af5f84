"""A language model behind an OpenAI-compatible endpoint: questions out, answers of a given shape back, or none.

Nothing is sent unless the user names a model and an endpoint. Every answer is validated here: servers accept a format
and ignore it. Calls, retries and time are bounded; answers are kept on disk by what was asked; a conversation can be
recorded, and replayed without any network.
"""

from __future__ import annotations

import base64
import contextlib
import hashlib
import importlib.util
import json
import os
import re
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from yellowiron.model.errors import YellowironError
from yellowiron.support.caching.disk import cache_folder
from yellowiron.support.output import output_file

if TYPE_CHECKING:
    from openai import OpenAI
    from openai.types.chat import ChatCompletion

Answer = Mapping[str, Any]
Message = dict[str, Any]
"""A role and its content: a text, or parts that are texts (`text_part`) and pictures (`picture_part`)."""
Rung = Literal["json_schema", "json_object", "prompt"]
_LADDER: tuple[Rung, ...] = ("json_schema", "json_object", "prompt")
"""Ways to ask for JSON, strictest first; an endpoint that refuses one is asked the next way, and so from then on."""
_ANSWER = {"value", "tokens_in", "tokens_out"}
"""What is kept of an answer."""
_FENCED = re.compile(r"```(?:json)?\s*(.*?)```", re.DOTALL)
_HINT = "Check --llm-url, --llm-model and the key, or ask no model: the rules need no network."


@dataclass(frozen=True)
class ModelOptions:
    """Which model is asked, where, and how much of it.

    `url` is the base address of an OpenAI-compatible endpoint ("http://localhost:8000/v1"). A call may take
    `timeout_s` and `attempts`, all calls together `most_s` seconds and `most_calls`. `record` names a file to write
    the conversation to, beside what was recorded there before; `replay` one to answer from instead of the network.
    """

    model: str
    url: str = ""
    key: str = field(default="", repr=False)
    timeout_s: float = 60.0
    attempts: int = 3
    most_calls: int = 500
    most_s: float = 900.0
    record: Path | None = None
    replay: Path | None = None


class EndpointError(YellowironError):
    """An endpoint that cannot be used: not configured, not reached, refusing, or out of calls or time."""


@dataclass
class Usage:
    """What the answers cost, in tokens as the endpoint counts them: those kept from earlier as much as those of today,
    so that two runs say the same. `calls` are the ones that were sent today."""

    questions: int = 0
    tokens_in: int = 0
    tokens_out: int = 0
    calls: int = 0

    def add(self, answer: Mapping[str, Any]) -> None:
        """Counts an answer."""
        self.questions += 1
        self.tokens_in += answer["tokens_in"]
        self.tokens_out += answer["tokens_out"]

    def __str__(self) -> str:
        return f"{self.questions} questions, {self.tokens_in} tokens in, {self.tokens_out} tokens out"


class Endpoint:
    """One conversation's way to a model. `usage` counts; use as a context manager, so that a record is closed."""

    def __init__(self, options: ModelOptions) -> None:
        self.options = options
        self.usage = Usage()
        self._rung = 0
        self._client: OpenAI | None = None
        self._started = time.monotonic()
        self._record: dict[str, str] = {}
        if options.record is not None and options.record.exists():
            self._record = {line["question"]: _line(line) for line in _recorded(options.record)}
        self._replayed: dict[str, dict[str, Any]] | None = None
        if options.replay is not None:
            said = _recorded(options.replay)
            self._replayed = {line["question"]: {name: line[name] for name in sorted(_ANSWER)} for line in said}
        elif not (options.model and options.url):
            raise EndpointError(
                "No language model is configured",
                where="--llm-url, --llm-model",
                hint="Name an OpenAI-compatible endpoint and its model, by option or in YELLOWIRON_LLM_URL and "
                "YELLOWIRON_LLM_MODEL.",
            )
        elif importlib.util.find_spec("openai") is None:
            raise EndpointError(
                "Asking a language model needs the package openai",
                where="--llm-model",
                hint='Install it with: pip install "yellowiron[llm]".',
            )

    def __enter__(self) -> Endpoint:
        return self

    def __exit__(self, *_: object) -> None:
        if self.options.record is not None:
            with output_file(self.options.record) as file:
                file.write_text("".join(f"{line}\n" for line in self._record.values()), encoding="utf-8")
        if self._client is not None:
            self._client.close()

    def ask(self, messages: Sequence[Message], schema: Mapping[str, Any]) -> Answer | None:
        """The model's answer as a JSON object that fits `schema`; None if it gives none in the attempts it has.

        `EndpointError` where the endpoint cannot be reached or refuses, where calls or time are used up, and where a
        replay has no answer to the question.
        """
        key = self.key(messages, schema)
        found = self._kept(key)
        if found is None:
            found = self._asked(messages, schema)
            _keep(key, found)
        self.usage.add(found)
        self._record[key] = _line({"question": key, "messages": list(messages), **found})
        return None if found["value"] is None else dict(found["value"])

    def key(self, messages: Sequence[Message], schema: Mapping[str, Any]) -> str:
        """Stands for a question: the model and what it is asked, not where it runs."""
        document = json.dumps([self.options.model, list(messages), schema], sort_keys=True, ensure_ascii=False)
        return hashlib.sha256(document.encode()).hexdigest()

    def _kept(self, key: str) -> dict[str, Any] | None:
        if self._replayed is None:
            return _kept_on_disk(key)
        if key not in self._replayed:
            raise EndpointError(
                "The recorded conversation has no answer to a question of this run",
                where=str(self.options.replay),
                hint="Record it again: files, template, model or program have changed since.",
            )
        return self._replayed[key]

    def _asked(self, messages: Sequence[Message], schema: Mapping[str, Any]) -> dict[str, Any]:
        """Down the ladder until an answer fits; its value is None if none does."""
        said = list(messages)
        found: dict[str, Any] = {"value": None, "tokens_in": 0, "tokens_out": 0}
        for _ in range(self.options.attempts):
            completion = self._sent(said, schema)
            if completion.usage is not None:
                found["tokens_in"] += completion.usage.prompt_tokens
                found["tokens_out"] += completion.usage.completion_tokens
            text = (completion.choices[0].message.content or "") if completion.choices else ""
            found["value"], why = parsed(text, schema)
            if found["value"] is not None:
                break
            correction = f"That was not what was asked for: {why}. Answer with the JSON object only."
            said = [*messages, {"role": "assistant", "content": text[:2000]}, {"role": "user", "content": correction}]
        return found

    def _sent(self, messages: Sequence[Message], schema: Mapping[str, Any]) -> ChatCompletion:
        """One completion, whatever it says."""
        import openai

        while True:
            self._check_budget()
            self.usage.calls += 1
            try:
                return self._completion(messages, schema, _LADDER[self._rung])
            except (openai.BadRequestError, openai.UnprocessableEntityError) as error:
                if self._rung + 1 == len(_LADDER):
                    raise self._refused(error) from error
                self._rung += 1
            except openai.OpenAIError as error:
                raise self._refused(error) from error

    def _completion(self, messages: Sequence[Message], schema: Mapping[str, Any], rung: Rung) -> ChatCompletion:
        said: list[Any] = list(messages)
        form: dict[str, Any] = {}
        if rung == "json_schema":
            shape = {"name": "answer", "strict": True, "schema": schema}
            form = {"response_format": {"type": "json_schema", "json_schema": shape}}
        else:
            words = f"Answer with one JSON object of this JSON Schema and nothing else: {json.dumps(schema)}"
            said = [*said[:-1], _with_words(said[-1], words)]
            if rung == "json_object":
                form = {"response_format": {"type": "json_object"}}
        answer: ChatCompletion = self._connected().chat.completions.create(
            model=self.options.model, messages=said, temperature=0.0, seed=0, **form
        )
        return answer

    def _connected(self) -> OpenAI:
        if self._client is None:
            import openai

            options = self.options
            self._client = openai.OpenAI(
                base_url=options.url,
                api_key=options.key or "none",
                timeout=options.timeout_s,
                max_retries=options.attempts - 1,
            )
        return self._client

    def _check_budget(self) -> None:
        options = self.options
        spent = time.monotonic() - self._started
        if self.usage.calls >= options.most_calls or spent > options.most_s:
            raise EndpointError(
                f"The language model was asked {self.usage.calls} times in {spent:.0f} s, and there is more to ask",
                where=options.url,
                hint=f"At most {options.most_calls} calls and {options.most_s:g} s are spent; the rest is not asked.",
            )

    def _refused(self, error: Exception) -> EndpointError:
        words = " ".join(str(error).split())[:200]
        if self.options.key:
            words = words.replace(self.options.key, "…")
        return EndpointError(f"The language model gives no answer: {words}", where=self.options.url, hint=_HINT)


def text_part(words: str) -> dict[str, Any]:
    """A text as a part of a message with pictures."""
    return {"type": "text", "text": words}


def picture_part(png: bytes) -> dict[str, Any]:
    """A picture, a PNG file's bytes, as a part of a message."""
    return {"type": "image_url", "image_url": {"url": f"data:image/png;base64,{base64.b64encode(png).decode()}"}}


def _with_words(message: Message, words: str) -> Message:
    """A message that says more."""
    said = message["content"]
    return {**message, "content": f"{said}\n\n{words}" if isinstance(said, str) else [*said, text_part(words)]}


def parsed(text: str, schema: Mapping[str, Any]) -> tuple[dict[str, Any] | None, str]:
    """The JSON object in a text, if it fits the schema; else None and what is wrong with it.

    Prose around the object and code fences are forgiven.
    """
    import jsonschema

    why = "it holds no JSON object"
    for part in (text, *_FENCED.findall(text), text[text.find("{") : text.rfind("}") + 1]):
        try:
            value = json.loads(part)
        except ValueError:
            continue
        if not isinstance(value, dict):
            continue
        try:
            jsonschema.validate(value, dict(schema))
        except jsonschema.ValidationError as error:
            why = error.message[:200]
            continue
        return value, ""
    return None, why


def _kept_on_disk(key: str) -> dict[str, Any] | None:
    folder = cache_folder()
    if folder is None:
        return None
    try:
        found = json.loads((folder / "answers" / f"{key}.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return found if isinstance(found, dict) and set(found) == _ANSWER else None


def _keep(key: str, found: Mapping[str, Any]) -> None:
    """An answer, beside its place and then renamed into it; an answer that never came is asked for again next time."""
    folder = cache_folder()
    if folder is None or found["value"] is None:
        return
    with contextlib.suppress(OSError):
        path = folder / "answers" / f"{key}.json"
        path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        part = path.with_suffix(f".{os.getpid()}.part")
        part.write_text(json.dumps(found, sort_keys=True), encoding="utf-8")
        part.replace(path)


def _recorded(path: Path) -> list[dict[str, Any]]:
    """The lines of a recorded conversation."""
    try:
        lines = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]
        if not all({"question", *_ANSWER} <= line.keys() for line in lines):
            raise ValueError
    except OSError as error:
        raise EndpointError(
            f"{path.name} cannot be opened: {error.strerror or error}", where=str(path), hint="Check the path."
        ) from error
    except (ValueError, AttributeError) as error:
        raise EndpointError(
            f"{path.name} is no recorded conversation", where=str(path), hint="Record one with --llm-record."
        ) from error
    return lines


def _line(said: Mapping[str, Any]) -> str:
    return json.dumps(said, sort_keys=True)
