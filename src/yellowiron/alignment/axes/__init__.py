"""Where the joints of known bodies are, with an uncertainty: axes without exact pins."""

from yellowiron.alignment.axes.estimate import estimate_axes
from yellowiron.alignment.axes.values import AxisEstimate, Candidate, Frame

__all__ = ["AxisEstimate", "Candidate", "Frame", "estimate_axes"]
