"""Backward error analysis: what a method solves exactly (docs/modified-equation.md)."""
