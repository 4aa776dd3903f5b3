"""Sweeps: many methods side by side, their properties, and the best of them."""
