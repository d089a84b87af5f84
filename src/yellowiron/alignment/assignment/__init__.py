"""Which cluster plays which body of the template, and the machine's frame.

In: a `Structure` for each reading of an `Observation`, a `Template`, `Specifications`, names. Out: an `Answer` with its
`Solution` (cluster → body, joint → hinge or slide), and a `MachineFrame`.

In this order: `names` (what parts are called), `cp_sat` (the assignment, solved), `machine_frame` and `root_fallback`
(from a solution), `weights` and `sheet_weights` (what speaks for a body besides joints), `one_sided`, `answer` (what is
compared), `search` (tolerances, readings, variants). `unit_scale` comes before it all: the model in metres, by the
sheet.
"""
