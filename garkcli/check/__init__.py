"""Checks of method files: analysis, claims and findings."""
