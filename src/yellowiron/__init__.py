"""yellowiron: from a construction machine's CAD model and specification sheet to a simulation-ready USD machine."""
