"""Rigid clusters and the hinges and slides between them, by geometry alone.

In: an `Assembly`, with a `Template` that says what to look for. Out: an `Observation` with its `ContactEvidence`, and
one `Structure` for each reading of the welds.

In this order: `contact_evidence` (what each contact can mean), `observation` (all of `features` for one contact
tolerance, and the evidence), `rigid_groups` (who may be joined), `welds` and `min_cut` (what is joined, and what was so
falsely), `clusters` (the structure). `loops` counts the freedoms of its closed chains.
"""
