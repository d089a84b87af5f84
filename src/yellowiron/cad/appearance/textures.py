"""Pictures on surfaces: found beside the file that names them, checked, and kept as PNG or JPEG. Memory is bounded."""

from __future__ import annotations

import hashlib
import re
import urllib.parse
from collections.abc import Iterator
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path

import numpy as np

from yellowiron.model.finding import Finding
from yellowiron.model.geometry import Color, Finish, Texture, linear_values

_KEPT = {"PNG": ".png", "JPEG": ".jpg"}
"""Forms that every USD viewer opens; others are written anew as PNG."""
_FORMATS = ("PNG", "JPEG", "BMP", "TGA", "TIFF", "WEBP", "GIF", "DDS")
LARGEST = 64 * 1024**2
"""Bytes of one picture's file …"""
_MOST = 256 * 1024**2
"""… of all of a model's …"""
_PIXELS = 8192 * 8192
"""… and pixels of one."""
_FOLDERS = ("", "textures", "texture", "tex", "maps", "images", "materials", "source")
"""Where a picture is looked for by its mere name: exporters write the paths of their own computers."""


@dataclass(frozen=True)
class Picture:
    """A picture that can be kept: the texture, and its mean, as linear RGB and as the numbers that stand in it."""

    texture: Texture
    mean: Color
    raw: Color

    def painted(self, factor: Color | None) -> tuple[Texture, Color]:
        """The texture multiplied by a factor (linear RGB), and the mean colour that comes of it."""
        by = factor or (1.0, 1.0, 1.0)
        r, g, b = (m * f for m, f in zip(self.mean, by, strict=True))
        return replace(self.texture, factor=by), (r, g, b)


class Pictures:
    """The pictures of one model, each read once; what is left out becomes a finding (CAD012)."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._folder = Path(path).absolute().parent.resolve()
        self._known: dict[str, Picture | None] = {}
        self._spent = 0
        self._faults: dict[str, str] = {}

    def beside(self, reference: str) -> Picture | None:
        """The picture that a reference leads to, in the model's folder or below; None where there is none."""
        key = f"file {reference}"
        if key not in self._known:
            found = next((f for f in self._places(reference) if f.is_file()), None)
            if found is None:
                self._faults[Path(_plain(reference)).name or reference] = "it is not in the model's folder"
            self._known[key] = None if found is None else self._read(found, found.name)
        return self._known[key]

    def inside(self, data: bytes, name: str) -> Picture | None:
        """The picture in some bytes of the model itself."""
        key = hashlib.sha256(data).hexdigest()
        if key not in self._known:
            self._known[key] = self._made(data, name)
        return self._known[key]

    def fault(self, name: str, words: str) -> None:
        """A picture that its reader cannot keep."""
        self._faults[name] = words

    def findings(self) -> list[Finding]:
        """What is not kept, in the order met."""
        if not self._faults:
            return []
        listed = "; ".join(f"'{name}': {words}" for name, words in list(self._faults.items())[:5])
        more = f"; and {len(self._faults) - 5} more" if len(self._faults) > 5 else ""
        words = f"Of the textures are left out {listed}{more}"
        hint = "The parts have the colour under them. Put the pictures beside the model, or export it as GLB."
        return [Finding("CAD012", "info", self._path, words, hint)]

    def _places(self, reference: str) -> Iterator[Path]:
        """Files that a reference may mean; none is outside of the model's folder."""
        text = _plain(reference)
        name = text.rpartition("/")[2]
        folders = (*_FOLDERS, f"{Path(self._path).stem}.fbm")
        for candidate in (text, *(f"{folder}/{name}" if folder else name for folder in folders)):
            if "\0" in candidate or not name:
                continue
            target = (self._folder / candidate).resolve()
            if target.is_relative_to(self._folder):
                yield target

    def _read(self, file: Path, name: str) -> Picture | None:
        size = file.stat().st_size
        if size > LARGEST:
            self._faults[name] = f"its file has {size / 1024**2:.0f} MB"
            return None
        return self.inside(file.read_bytes(), name)

    def _made(self, data: bytes, name: str) -> Picture | None:
        from PIL import Image, UnidentifiedImageError

        if len(data) > LARGEST or self._spent + len(data) > _MOST:
            self._faults[name] = "the model's pictures are too large"
            return None
        try:
            with Image.open(BytesIO(data), formats=_FORMATS) as image:
                if image.width * image.height > _PIXELS:
                    self._faults[name] = f"it has {image.width} × {image.height} points"
                    return None
                suffix = _KEPT.get(image.format or "", "")
                if not suffix:
                    out = BytesIO()
                    image.convert("RGBA" if "A" in image.getbands() or "transparency" in image.info else "RGB").save(
                        out, "PNG"
                    )
                    data, suffix = out.getvalue(), ".png"
            mean, raw = _means(data)
        except Image.DecompressionBombError:
            self._faults[name] = "it has too many points"
            return None
        except (UnidentifiedImageError, OSError, ValueError, SyntaxError, EOFError):
            self._faults[name] = "it is damaged, or of a form that is not readable"
            return None
        self._spent += len(data)
        stem = re.sub(r"[^A-Za-z0-9_-]+", "_", Path(_plain(name)).stem)[:40].strip("_") or "texture"
        mark = hashlib.sha256(data).hexdigest()[:8]
        file = stem.removesuffix("_" + mark) + f"_{mark}{suffix}"
        return Picture(Texture(file, data), mean, raw)


def _plain(reference: str) -> str:
    return urllib.parse.unquote(reference).replace("\\", "/").removeprefix("file://").strip()


def _means(data: bytes) -> tuple[Color, Color]:
    """The mean of a picture's points by their opacity: as light, and as numbers in [0, 1]."""
    from PIL import Image

    with Image.open(BytesIO(data), formats=_FORMATS) as image:
        image.draft("RGB", (256, 256))
        # Made small first where that is the same: a picture of 8192 by 8192 points is 200 MB, and with opacity more.
        whole = image if image.mode == "RGB" else image.convert("RGBA")
        small = whole.resize((64, 64), Image.Resampling.BOX).convert("RGBA")
    points = np.asarray(small, dtype=np.float64).reshape(-1, 4) / 255.0
    weight = points[:, 3:] if points[:, 3].sum() > 0.0 else np.ones((len(points), 1))
    mean, raw = ((v * weight).sum(axis=0) / weight.sum() for v in (linear_values(points[:, :3]), points[:, :3]))
    return (float(mean[0]), float(mean[1]), float(mean[2])), (float(raw[0]), float(raw[1]), float(raw[2]))


def finish(
    metallic: float | None = None, roughness: float | None = None, texture: Texture | None = None
) -> Finish | None:
    """A finish, its numbers within [0, 1]; None where nothing is stated."""
    numbers = [None if v is None or not np.isfinite(v) else min(max(float(v), 0.0), 1.0) for v in (metallic, roughness)]
    made = Finish(numbers[0], numbers[1], texture)
    return None if made == Finish() else made
