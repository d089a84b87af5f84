"""The machine of a file as the tests take it: without its rings of track shoes, which no joint holds."""

from __future__ import annotations

from pathlib import Path

from yellowiron import usd
from yellowiron.kinematics import attached
from yellowiron.model.errors import YellowironError
from yellowiron.model.mechanism import Mechanism
from yellowiron.simulate.engine import Base


def held_machine(usd_path: str | Path, base: Base) -> Mechanism:
    """The machine without bodies that nothing holds. `YellowironError` for one that would stand on them."""
    mechanism = usd.read_machine(usd_path)
    if mechanism.floating and base == "floating":
        raise YellowironError(
            "The machine stands on track shoes that are bodies of their own, which these tests do not follow",
            where=str(usd_path),
            hint="Drive it on a fixed base, or build it with --tracks belt.",
        )
    return attached(mechanism)
