"""Draws the example telehandler."""
