"""Convergence tests: errors over step sizes, and the order that they show."""
