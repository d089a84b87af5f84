"""The example roller: a tandem of the Volvo DD128C class, or a single drum with driven wheels."""
