"""Draws the example crawler crane."""
