"""`python -m yellowiron`."""

from yellowiron.cli import main

main()
