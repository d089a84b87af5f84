"""Findings: remarks that are data, never prints."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Severity = Literal["error", "warning", "info"]


@dataclass(frozen=True)
class Finding:
    """One remark of a check or a stage.

    `code` is stable (`CAD001`, `ALN002`, `MEC003`, …), `where` names the joint, part, page or file,
    `message` is one sentence, `hint` what to do about it.
    """

    code: str
    severity: Severity
    where: str
    message: str
    hint: str = ""
