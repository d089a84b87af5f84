"""The numbers of a glTF document, and its objects by key and index."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from yellowiron.model.geometry import Floats

_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_STEPS = {5120: 127.0, 5121: 255.0, 5122: 32767.0, 5123: 65535.0}
"""What a normalised integer is divided by."""
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_MOST = 1 << 26
"""Rows that an accessor may declare without a byte behind them: more is a bomb."""


def fault(document: Mapping[str, Any], buffers: Sequence[bytes], number: Any) -> str:
    """What keeps an accessor's numbers from being read; '' if nothing does."""
    entry = item(document, "accessors", number)
    if not entry:
        return "it refers to numbers that are not there"
    count, sparse = entry.get("count"), part(entry, "sparse")
    row = _row(entry)
    bare = "bufferView" not in entry
    if not isinstance(count, int) or count < 0 or row == 0 or (bare and (not sparse or count > _MOST)):
        return "the layout of its numbers is broken"
    layouts = [] if bare else [(entry, count, row)]
    if "sparse" in entry:
        some = sparse.get("count")
        if not isinstance(some, int) or not 0 < some <= count:
            return "the layout of its numbers is broken"
        layouts += [(part(sparse, "indices"), some, _row({**part(sparse, "indices"), "type": "SCALAR"}))]
        layouts += [(part(sparse, "values"), some, row)]
    return next((words for layout in layouts if (words := _misfit(document, buffers, *layout))), "")


def accessor(
    document: Mapping[str, Any], buffers: Sequence[bytes], number: Any, *, normalized: bool = False
) -> Floats | None:
    """(n, k) the numbers of an accessor, integers divided by their range where it, or `normalized`, says so; None where
    it is absent or broken (`fault`)."""
    if fault(document, buffers, number):
        return None
    entry = item(document, "accessors", number)
    count, kind, width = int(entry["count"]), _TYPES[entry["componentType"]], _WIDTHS[entry["type"]]
    written = "bufferView" in entry
    values = _rows(document, buffers, entry, count, kind, width) if written else np.zeros((count, width))
    if "sparse" in entry:
        indices, changed = entry["sparse"]["indices"], entry["sparse"]["values"]
        some = entry["sparse"]["count"]
        places = _rows(document, buffers, indices, some, _TYPES[indices["componentType"]], 1)[:, 0].astype(np.int64)
        inside = (places >= 0) & (places < count)
        values[places[inside]] = _rows(document, buffers, changed, some, kind, width)[inside]
    if not (entry.get("normalized") or normalized) or entry["componentType"] not in _STEPS:
        return values
    return np.asarray(np.maximum(values / _STEPS[entry["componentType"]], -1.0))


def view(document: Mapping[str, Any], buffers: Sequence[bytes], number: Any) -> bytes:
    """The bytes of a buffer view; none where it is broken."""
    entry = item(document, "bufferViews", number)
    buffer, start, length = entry.get("buffer", 0), entry.get("byteOffset", 0), entry.get("byteLength", 0)
    if not all(_whole(v) for v in (buffer, start, length)) or buffer >= len(buffers):
        return b""
    return buffers[buffer][start : start + length]


def item(document: Mapping[str, Any], key: str, number: Any) -> Mapping[str, Any]:
    """The object of an index under a key; an empty one where there is none."""
    entries = document.get(key)
    if not isinstance(entries, list) or not isinstance(number, int) or not 0 <= number < len(entries):
        return {}
    return entries[number] if isinstance(entries[number], dict) else {}


def part(entry: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    """The object under a key; an empty one where there is none."""
    found = entry.get(key)
    return found if isinstance(found, dict) else {}


def _whole(value: Any) -> bool:
    return isinstance(value, int) and value >= 0


def _row(entry: Mapping[str, Any]) -> int:
    """Bytes of a row of numbers; 0 of a kind that there is not."""
    kind, width = _TYPES.get(entry.get("componentType", 0)), _WIDTHS.get(str(entry.get("type")), 0)
    return 0 if kind is None else np.dtype(kind).itemsize * width


def _misfit(
    document: Mapping[str, Any], buffers: Sequence[bytes], entry: Mapping[str, Any], count: int, row: int
) -> str:
    """What is wrong with `count` rows of `row` bytes where `entry` says that they are."""
    found = item(document, "bufferViews", entry.get("bufferView"))
    if not found:
        return "its numbers are stored in a way that is not readable here"
    start, length = found.get("byteOffset", 0), found.get("byteLength", 0)
    step, offset = found.get("byteStride", row), entry.get("byteOffset", 0)
    buffer = found.get("buffer", -1)
    whole = all(_whole(v) for v in (buffer, start, step, offset, length))
    if not whole or row == 0 or buffer >= len(buffers) or (step < row and count > 1):
        return "the layout of its numbers is broken"
    end = offset + (count - 1) * step + row if count else 0
    if end > length or start + length > len(buffers[buffer]):
        return f"it declares {count} numbers and the file has fewer"
    return ""


def _rows(
    document: Mapping[str, Any],
    buffers: Sequence[bytes],
    entry: Mapping[str, Any],
    count: int,
    kind: str,
    width: int,
) -> Floats:
    """(count, width) rows that `_misfit` finds nothing wrong with."""
    size = np.dtype(kind).itemsize
    stride = item(document, "bufferViews", entry["bufferView"]).get("byteStride", size * width)
    data = view(document, buffers, entry["bufferView"])
    offset = entry.get("byteOffset", 0)
    if not count:
        return np.zeros((0, width))
    return np.ndarray((count, width), dtype=kind, buffer=data, offset=offset, strides=(stride, size)).astype(np.float64)
