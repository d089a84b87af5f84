"""Where the joints of known bodies are, with an uncertainty: axes without exact pins; and where two groups of solids
could be hinged, before any body is known."""

from yellowiron.alignment.axes.estimate import estimate_axes
from yellowiron.alignment.axes.proposals import group, hinge_proposals
from yellowiron.alignment.axes.values import AxisEstimate, Candidate, Frame

__all__ = ["AxisEstimate", "Candidate", "Frame", "estimate_axes", "group", "hinge_proposals"]
