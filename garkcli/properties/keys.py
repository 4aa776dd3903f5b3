"""The names of the properties that a method file may claim."""

KEYS = (
    "explicit",
    "diagonally-implicit",
    "sdirk",
    "esdirk",
    "gamma",
    "fully-implicit",
    "implicit-stages",
    "stiffly-accurate",
    "fsal",
    "symmetric",
    "reducible",
    "stage-order",
    "nodes-in-unit-interval",
    "positive-weights",
    "a-stable",
    "l-stable",
    "p-stable",
    "algebraically-stable",
    "ssp-coefficient",
    "real-stability",
    "imaginary-stability",
)
"""Every property, in the order of the documentation; a file of ``claimed`` each."""
