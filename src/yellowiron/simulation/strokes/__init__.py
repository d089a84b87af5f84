"""Every actuator's stroke in an engine, held against the closed-chain kinematics: a machine file → `SimulationResult`.

In order: `held` (the machine as it is loaded), `comparison` (an engine's poses against the kinematics), `recording`
(what is kept of it to be looked at), `result` (what was found), `run` (load, command, step, compare), `watched` (the
same at a few moments, to be looked at).
"""
