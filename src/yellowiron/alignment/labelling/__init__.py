"""From bodies to the role of every part, and what a person should look at.

In: the search's `Answer`, its `Observation`, tracks, what a person said. Out: an `Alignment`.

In this order: `place` (what is known of a part), `review` (what a person should know), `propagation` (from bodies to
all their parts), `coupler`, `track_places` and `further_axles` (parts with rules of their own), `suspects`, `undercut`
(which bodies and parts to mistrust), `confidence` (how probable a place is), `result` (the alignment as a value),
`halves` (that of a machine of which one half is drawn).
"""
