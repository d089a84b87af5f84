"""`report.html`: the document, a `Mechanism`, its `Assembly` and `Alignment` → one self-contained page, as text.

In order: `rays` (what they meet), `pictures` (shaded, without a display), `drawing` (all of a page), `marks` (labels
over a picture) and `plots` (curves as SVG); `joints`, `sensors`, `simulation`, `sweeps` (what the page says of each),
`viewer` (the machine packed for the 3D view), and `page`, which puts them together.
"""
