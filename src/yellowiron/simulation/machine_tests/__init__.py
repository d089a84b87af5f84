"""The tests that a template states (tipping loads, forces, times, lifts): a machine file → `Figure`s.

In order: `statics` (what a posed machine bears, by calculation), `rig` (a machine in an engine, posed and pushed),
`figures` (what came out, beside the sheet), `hydraulics` (the tests themselves), `load_chart` (a crane's chart beside
both).
"""
