"""Scores (0…1) that several steps from claims to values share, each with its reason."""

from __future__ import annotations

LEAST = 0.55
"""Score below which a claim does not speak of a wanted value at all: more than half of its label must."""
SURE = 0.7
"""Score from which one undisputed claim is `ok`: less than a third of its label says anything else."""
DOUBTFUL = 0.5
"""The most confidence of a value that a person should look at: as likely wrong as right."""
PICTURED = 0.45
"""The most confidence of a value read from a picture: a digit may be another, and its words prove nothing."""
