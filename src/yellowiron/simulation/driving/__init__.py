"""Driving: a machine file and an engine's name → `DrivingResult`.

In order: `wheel` (the wheels and sprockets that motors drive), `rolling` (how fast wheels turn while a machine steers
on the spot), `sliding` (how a machine goes by dry friction whose wheels cannot all roll), `tracked` (turning on the
spot and swinging), `result` (what a drive found), `wheeled` (the whole drive).
"""
