"""`python -m yellowiron`, and what the command `yellowiron` starts."""

import os
import sys

from yellowiron.support.isolated import shielded

# What was not heeded here (-E) is not for the programs that libraries start either.
safe = shielded(os.environ if sys.flags.ignore_environment else {})
if sys.flags.ignore_environment:
    os.environ.clear()
os.environ.update(safe)

from yellowiron.cli import main  # noqa: E402

main()
