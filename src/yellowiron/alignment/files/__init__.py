"""The alignment as a file that a person edits, and that outlives a revision of the CAD model.

In: an `Alignment` and its `Assembly`, or a path. Out: `alignment.json`, or the `Alignment` that is in it.

In this order: `revisions` (parts of one revision in the next), `alignment_json`.
"""
