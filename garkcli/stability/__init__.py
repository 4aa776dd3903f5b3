"""Stability on linear and contractive problems, decided exactly."""
