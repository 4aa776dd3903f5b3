"""Backward error analysis: the equation that a method solves exactly
(docs/modified-equation.md).
"""
