"""What each kind of evidence counts: data, fitted to machines whose truth is known (`data/fusion.json`, made by
`benchmarks/fit_fusion.py`)."""

from __future__ import annotations

import functools
import json
from collections.abc import Mapping
from importlib import resources
from types import MappingProxyType


@functools.cache
def weights() -> Mapping[str, float]:
    """Evidence → what it counts, in points; see `votes`, `bonds` and `judge` for what each is."""
    text = resources.files("yellowiron.alignment").joinpath("data/fusion.json").read_text(encoding="utf-8")
    return MappingProxyType(dict(json.loads(text)["weights"]))
