"""What a build writes on the prims of a machine's file beside what USD has words for, by `usd.authoring.metadata`."""

RECORD = "yellowiron"
"""The key of that record in a prim's `customData`."""
