"""Backward error analysis: the equation that a method solves exactly."""
