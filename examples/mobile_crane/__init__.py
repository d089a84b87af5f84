"""Draws the example mobile crane."""
