"""Options that several commands have, and those that all have."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from yellowiron.cli.application import AsJson, Quiet, Verbose
from yellowiron.cli.telling import telling_too


def _types(incomplete: str) -> list[str]:
    """The library's types, for a shell that completes a command."""
    from yellowiron import library

    return [name for name in library.list_templates() if name.startswith(incomplete)]


Type = Annotated[
    str,
    typer.Argument(metavar="TYPE", help="A library type (templates list) or a template folder.", autocompletion=_types),
]
Sheets = Annotated[list[Path] | None, typer.Option("--specs", help="A specification sheet (PDF); may be repeated.")]
Settings = Annotated[
    list[str] | None, typer.Option("--set", help='A value by hand: "Lift Cylinder Stroke=764 mm"; may be repeated.')
]
Config = Annotated[str, typer.Option("--config", help="The column of the sheet to take, by its heading.")]

Mirror = Annotated[
    bool, typer.Option("--mirror", help="Of a model that is one half of a machine, build the whole: its mirror image.")
]

SecondOpinion = Annotated[
    bool,
    typer.Option("--model", help="Show parts in doubt to the language model: it points, and decides nothing."),
]


def _reading(
    config: Config = "",
    extractor: Annotated[
        Literal["rules", "llm", "both"],
        typer.Option(
            "--extractor", help="How sheets are read: by rules (no network), by a language model, or by both."
        ),
    ] = "rules",
) -> dict[str, Any]:
    """How sheets are read, as `yellowiron.extract` and `yellowiron.build` take it."""
    return {"config": config, "extractor": extractor}


def _llm(
    llm_url: Annotated[
        str,
        typer.Option("--llm-url", envvar="YELLOWIRON_LLM_URL", help="An OpenAI-compatible endpoint, http://…/v1."),
    ] = "",
    llm_model: Annotated[
        str, typer.Option("--llm-model", envvar="YELLOWIRON_LLM_MODEL", help="The model's name there.")
    ] = "",
    llm_key: Annotated[
        str,
        typer.Option(
            "--llm-key", envvar="YELLOWIRON_LLM_KEY", show_envvar=True, help="Its key; better in the environment."
        ),
    ] = "",
    llm_record: Annotated[
        Path | None, typer.Option("--llm-record", help="Write the conversation with the model here.")
    ] = None,
    llm_replay: Annotated[
        Path | None, typer.Option("--llm-replay", help="Answer from a recorded conversation, no network.")
    ] = None,
) -> Any:
    """Where a language model is, as `ModelOptions`; it is asked only where another option says so."""
    from yellowiron.endpoint import ModelOptions

    return ModelOptions(llm_model, llm_url, llm_key, record=llm_record, replay=llm_replay)


def reads_sheets(command: Callable[..., None]) -> Callable[..., None]:
    """Gives a command the options of `_reading`; it gets what they say as `reading`."""
    return _with_options(command, _reading, "reading")


def asks_a_model(command: Callable[..., None]) -> Callable[..., None]:
    """Gives a command the options of `_llm`; it gets what they say as `llm`."""
    return _with_options(command, _llm, "llm")


def command(group: typer.Typer, name: str | None = None) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Makes a function a command of a group, with the options of `_telling`."""

    def added(function: Callable[..., None]) -> Callable[..., None]:
        return group.command(name)(_with_options(function, _telling))

    return added


def _telling(as_json: AsJson = False, quiet: Quiet = False, verbose: Verbose = False) -> None:
    """How a command says what it does and found."""
    telling_too(as_json=as_json, quiet=quiet, verbose=verbose)


def _with_options(command: Callable[..., None], options: Callable[..., Any], gets: str = "") -> Callable[..., None]:
    """A command with the parameters of `options` behind its own; what that gives is its parameter `gets`."""
    own = [p for p in inspect.signature(command, eval_str=True).parameters.values() if p.name != gets]
    further = list(inspect.signature(options, eval_str=True).parameters.values())

    @functools.wraps(command)
    def with_options(**given: Any) -> None:
        said = options(**{option.name: given.pop(option.name) for option in further})
        command(**given, **({gets: said} if gets else {}))

    parameters = [p.replace(kind=inspect.Parameter.KEYWORD_ONLY) for p in (*own, *further)]
    # typer reads the one and the other.
    with_options.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    with_options.__annotations__ = {p.name: p.annotation for p in parameters}
    return with_options
