"""The commands. Exit code 0: done; 1: done, and something fell short; 2: the input is unusable.

In the order in which they build on each other: `telling` (what is said of a run, and how), `options` (those of several
commands), `application` (the program and its groups), then the commands, a module a group (`building`, `machines`,
`library`), and `entry`, the console script.
"""

from yellowiron.cli.application import app
from yellowiron.cli.entry import main

__all__ = ["app", "main"]
