"""Formats with exact surfaces, through Open CASCADE: a path to an `Assembly`.

`part21` looks at the text of a STEP file and `brep_text` at that of a shape: Open CASCADE may crash at one that is
damaged, or go on for ever; `patience` is how long it may work. `step`, `iges`, `brep_file` and `freecad` (whose shapes
`brep_file` reads) give what they find to `yellowiron.cad.brep.products`.
"""
