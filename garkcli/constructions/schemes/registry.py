"""The one list of schemes."""

from __future__ import annotations

from collections.abc import Mapping

from garkcli.constructions.schemes import exact, rounded
from garkcli.constructions.schemes.scheme import Scheme

SCHEMES: Mapping[str, Scheme] = {
    scheme.name: scheme for scheme in (*exact.SCHEMES, *rounded.SCHEMES)
}
"""Every scheme by name."""
OTHER_NAMES: Mapping[str, str] = {
    "yoshida-4": "triple-jump",
    "forest-ruth": "triple-jump",
    "yoshida": "yoshida-6, yoshida-8, or triple-jump for order 4",
    "kahan-li": "kahan-li-6 or kahan-li-8",
    "mclachlan-8": "suzuki-umeno-8",
    "symmetrized": "strang",
    "suzuki-4": "suzuki",
    "suzuki-fractal": "suzuki",
    "verlet": "strang",
}
"""What people call some of them, and how the program does."""
