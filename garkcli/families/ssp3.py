"""The optimal strong-stability-preserving methods of order 3 with n² stages.

D. Ketcheson, *Highly efficient strong stability-preserving Runge–Kutta methods with low-storage
implementations*, SIAM J. Sci. Comput. 30 (2008), section 4.2.
"""

from __future__ import annotations

from math import isqrt

from flint import fmpq

from garkcli.errors import UnknownFamily
from garkcli.families.family import MAX_STAGES, Family, Options, Recipe
from garkcli.families.stagelist import START, StageList, Weights, combined
from garkcli.tableau.tableau import Method


def ssp3(s: int, _: Options) -> Recipe:
    """SSPRK(n², 3).

    Raises:
        UnknownFamily: s is no square.
    """
    n = isqrt(s)
    if n * n != s:
        message = f"ssp3 with {s} stages does not exist"
        raise UnknownFamily(message, "it has 4, 9, 16, … stages", code="wrong-value")
    return Recipe(s, lambda _: _method(n))


def _method(n: int) -> Method:
    """Euler steps of length 1/(n² − n); in the middle the mean with an earlier value."""
    s = n * n
    length = fmpq(1, s - n)
    middle = n * (n + 1) // 2
    earlier = (n - 1) * (n - 2) // 2
    stages = StageList()
    values: list[Weights] = [START]
    for i in range(1, s + 1):
        slope = stages.slope_at(values[-1])
        gained = {slope: length}
        value = combined([(1, values[-1]), (1, gained)])
        if i == middle:
            whole = 2 * n - 1
            old = fmpq(n, whole)
            new = fmpq(n - 1, whole)
            value = combined([(old, values[earlier]), (new, value)])
        values.append(value)
    return stages.method(f"SSPRK({s},3)", values[-1])


FAMILIES = (Family("ssp3", ssp3, 4, MAX_STAGES, "3", "s = n^2; strong-stability-preserving"),)
