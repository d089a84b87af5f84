"""Numbers that several readers of layouts share, each with its reason. Lengths are points."""

from __future__ import annotations

LARGER = 1.12
"""A heading is set larger than its rows by this ratio at least (or in capitals): the next type size up, 9 over 8 pt."""
INDENT = 4.0
"""By which a row stands in under its sub-heading: half an em of small print, more than labels waver."""
LONGEST_LABEL = 12
"""Words of a label; more are prose."""
HEADING_BAR = 40.0
"""Height below which a filled bar may lie behind one heading; what is higher lies behind several rows."""
