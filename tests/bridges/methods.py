"""The methods that ``make bridges`` runs in other codes, by their names in the catalogue."""

from __future__ import annotations

METHODS = {
    "explicit": ("ralston-euler", "kutta-38", "dormand-prince-5"),
    "DIRK": ("implicit-midpoint", "sdirk-23", "esdirk-436"),
    "IMEX": ("ark-ars222", "ars-443", "ark-436"),
    "SPRK": ("stoermer-verlet", "ruth-3", "candy-rozmus-4"),
}
"""By kind. The 3/8 rule has two entries in a row of A, which some codes read one of; the
Dormand-Prince pair begins a step with its last stage; the midpoint rule has one stage."""
READ_BACK = ("gauss-3", "lobatto-iiia-4")
"""Fully implicit methods with irrational coefficients, read back besides those above."""
