"""A machine of no known type: bodies and joints for a template to be made from.

In: an `Assembly`. Out: a `FoundMachine`.

In this order: `description` (the value, from a structure: root, tree, kinds, reasons), `discover` (by geometry alone),
`robot` (by what a file declares, geometry added).
"""
