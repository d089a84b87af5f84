"""What runs in the child process of one item: its build, its picture, its figures, its variants."""

from __future__ import annotations

import base64
import errno
import io
import json
import os
import re
from dataclasses import asdict
from pathlib import Path
from typing import Any, NoReturn

from yellowiron.fleet import places
from yellowiron.fleet.values import Item, Outcome, Variants
from yellowiron.model.errors import OutputError, YellowironError
from yellowiron.support import limits
from yellowiron.support.text import to_json

MACHINE, PICTURE = "machine", "picture.webp"
"""What an item's folder has beside its `MARK`: the build's folder, and a small picture."""
_PICTURE = re.compile(r'<img alt="The machine in the drawn pose" src="data:image/webp;base64,([A-Za-z0-9+/=]+)"')
_SIZE = (448, 240)
_PACKAGE = str(Path(__file__).resolve().parent.parent)
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EIO, errno.EROFS, errno.EFBIG)


def run(call: str) -> NoReturn:
    """Does what the file `call` asks for and ends the process: an item's work, whose outcome is a file beside it."""
    limits.leave_no_core()
    asked = json.loads(Path(call).read_text(encoding="utf-8"))
    outcome = build_item(item_from(asked["item"]), Path(asked["folder"]), Path(asked["inputs"]))
    answer = Path(asked["answer"])
    part = answer.with_suffix(".part")
    try:
        part.write_text(json.dumps(asdict(outcome)), encoding="utf-8")
        part.rename(answer)
    except OSError:
        os._exit(os.EX_IOERR)
    # Libraries are not taken down: that is where some crash.
    os._exit(0)


def item_from(said: dict[str, Any]) -> Item:
    """An item from its fields as JSON has them."""
    lists = {name: tuple(value) for name, value in said.items() if isinstance(value, list)}
    variants = Variants(**said["variants"]) if said["variants"] else None
    return Item(**{**said, **lists, "variants": variants})


def build_item(item: Item, folder: Path, inputs: Path) -> Outcome:
    """Builds an item into a folder that is new; what became of it. Inputs from elsewhere are fetched to `inputs`."""
    try:
        return _built(item, folder, inputs)
    except OutputError as error:
        return Outcome(item.id, "disk", error.message, item.id, error.hint)
    except YellowironError as error:
        # Where the program is installed says nothing of the item, and differs between machines.
        return Outcome(item.id, "refused", error.message, error.where.replace(_PACKAGE, "yellowiron"), error.hint)
    except MemoryError:
        return Outcome(item.id, "memory", "There is not enough memory", item.id, "Give it more, or split the model.")
    except OSError as error:
        if error.errno in _FULL:
            return Outcome(item.id, "disk", f"The disk does not take it: {error.strerror}", item.id, "Make room there.")
        return Outcome(item.id, "refused", f"A file cannot be used: {error.strerror}", str(error.filename or ""))
    except Exception as error:  # noqa: BLE001 - whatever it is, it is told of this item alone
        said = " ".join(f"{type(error).__name__}: {error}".split())[:300]
        return Outcome(item.id, "crashed", f"The build failed: {said}", item.id, "Build it alone to see where.")


def _built(item: Item, folder: Path, inputs: Path) -> Outcome:
    import yellowiron
    from yellowiron.fleet.figures import figures_of

    here = {place: _here(place, inputs, number) for number, place in enumerate(item.inputs)}
    if item.variants is not None:
        from yellowiron.fleet.variants.parameters import read_parameters

        read_parameters(here[item.variants.file])  # what is wrong with it is said before anything slow
    kind = item.type if not places.is_remote(item.type) else str(places.fetched(item.type, inputs / "type"))
    machine = yellowiron.build(
        kind,
        here[item.cad],
        folder / MACHINE,
        sheets=[here[sheet] for sheet in item.specs],
        documents=[here[document] for document in item.data],
        alignment_file=here[item.alignment] if item.alignment else None,
        settings=[*item.set, *([f"--tracks={item.tracks}"] if item.tracks else [])],
        config=item.config,
        mirror=item.mirror,
        engines=item.engines,
        page=item.page,
    )
    _name_inputs(folder / MACHINE / "inputs.json", item, here)
    if item.page:
        _take_picture(folder / MACHINE / "report.html", folder / PICTURE)
    if item.variants is not None:
        from yellowiron.fleet.variants import vary

        vary(machine.usd, here[item.variants.file], folder / "variants", count=item.variants.count,
             seed=item.variants.seed)  # fmt: skip
    figures = figures_of(machine.document, machine.fell_short)
    return Outcome(item.id, "short" if machine.fell_short else "ready", figures=figures)


def _here(place: str, inputs: Path, number: int) -> Path:
    return places.fetched(place, inputs / str(number)) if places.is_remote(place) else Path(place)


def _name_inputs(file: Path, item: Item, here: dict[str, Path]) -> None:
    """Where inputs are, as the manifest names them: where they were fetched to is nobody's."""
    if any(places.is_remote(place) for place in item.inputs):
        told = json.loads(file.read_text(encoding="utf-8"))
        told |= {"cad": item.cad, "specs": list(item.specs), "data": list(item.data)}
        file.write_text(to_json(told), encoding="utf-8")


def _take_picture(report: Path, target: Path) -> None:
    """The report's own picture of the machine, smaller."""
    from PIL import Image

    found = _PICTURE.search(report.read_text(encoding="utf-8"))
    if found is not None:
        with Image.open(io.BytesIO(base64.b64decode(found.group(1)))) as picture:
            picture.thumbnail(_SIZE)
            picture.save(target, "WEBP", quality=78, method=4)
