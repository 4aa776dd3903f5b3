"""Figures of results: scenes with their content, and the modules that draw them."""
