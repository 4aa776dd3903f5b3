"""The names of the properties that a method file may claim."""

_FILES = (
    ("solving", "explicit diagonally-implicit sdirk esdirk gamma fully-implicit implicit-stages"),
    (
        "stages",
        "stiffly-accurate fsal symmetric reducible stage-order nodes-in-unit-interval "
        "positive-weights",
    ),
    ("stability", "a-stable l-stable p-stable"),
    ("stages", "algebraically-stable"),
    ("stability", "ssp-coefficient real-stability imaginary-stability"),
)
KEYS = {key: file for file, keys in _FILES for key in keys.split()}
"""Every property, in the order of the documentation, with its file in ``claimed``."""
