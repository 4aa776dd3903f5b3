"""Exact forms of decimals: proposed from their digits, taken where the order does not fall."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from flint import arb, ctx, fmpq, fmpq_poly, fmpz_poly

from garkcli.bridges.importing import Imported, imported, numbers_of
from garkcli.design.search.recognise import minimal_polynomial, rational
from garkcli.errors import MethodFileError
from garkcli.exact.display import decimal
from garkcli.exact.expression import read_decimal
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_text
from garkcli.exact.roots import RealRoot, real_roots
from garkcli.frozen import Frozen, replace
from garkcli.order.tolerance import rounded_up
from garkcli.sources.found import FoundTable

FEWEST_DIGITS = 6
"""Decimals with fewer digits are exact already."""
LAST_PLACES = 2
"""Units of the last place by which a number may differ from its digits."""
BITS_A_DIGIT = 3.3
"""Bits of a decimal digit, rounded down."""
MAX_DEGREE = 4
"""Largest degree of a proposed root."""
MAX_NUMBERS = 400
"""Most different decimals that are examined."""
PRECISION = 4_000
"""Bits in which exact forms are compared with decimals; no decimal has so many."""
MAX_DIGITS = 1_000
"""Longer decimals are left as they are."""
_DECIMAL = re.compile(r"-?[0-9]*\.?[0-9]*(?:e[-+]?[0-9]{1,3})?")


class Proposal(Frozen):
    """An exact form of a decimal.

    Attributes:
        printed: the decimal.
        exact: the text of a coefficient.
        distance: how far they are apart, as a decimal, rounded up.
        size: how long the exact form is: the longer, the less it says.
    """

    printed: str
    exact: str
    distance: str
    size: int


class Recognised(Frozen):
    """A method with exact forms in place of decimals.

    Attributes:
        method: with those that were taken.
        taken: what was taken.
        refused: what was proposed, and with which the order falls.
        left: decimals that nothing was proposed for.
    """

    method: Imported
    taken: tuple[Proposal, ...]
    refused: tuple[Proposal, ...]
    left: tuple[str, ...]


def recognised(before: Imported, name: str) -> Recognised:
    """The method with exact numbers, as many as the certificate of the order bears out.

    Args:
        before: as it was imported.
        name: what its file calls it.
    """
    decimals = list(_decimals(before.table))
    proposals: list[Proposal] = []
    left: list[str] = []
    for text in decimals[:MAX_NUMBERS]:
        found = proposed(text)
        if found is None:
            left.append(text)
        else:
            proposals.append(found)
    left += decimals[MAX_NUMBERS:]
    # the shortest forms are the surest; the longest are given up first
    kept = sorted(proposals, key=lambda x: x.size)
    refused: list[Proposal] = []
    while kept:
        after = _with(before.table, kept, name)
        if after is not None and _is_as_good(before, after):
            return Recognised(after, tuple(kept), tuple(refused), tuple(left))
        refused.append(kept.pop())
    return Recognised(before, (), tuple(refused), tuple(left))


def _is_as_good(before: Imported, after: Imported) -> bool:
    """Whether no order has fallen."""
    if after.order.order < before.order.order:
        return False
    if before.embedded_order is None or after.embedded_order is None:
        return True
    return after.embedded_order.order >= before.embedded_order.order


def _with(table: FoundTable, proposals: Sequence[Proposal], name: str) -> Imported | None:
    exact = {x.printed: x.exact for x in proposals}
    try:
        return imported(_changed(table, exact), name)
    except MethodFileError:
        return None


def _changed(table: FoundTable, exact: Mapping[str, str]) -> FoundTable:
    """The table with other texts; what the source says of its rounding goes."""

    def changed(value: Any) -> Any:
        if isinstance(value, tuple):
            return tuple(map(changed, value))
        return exact.get(value, value)

    numbers = {key: changed(getattr(table, key)) for key in ("A", "b", "c", "embedded")}
    return replace(table, **numbers, tolerance="")


def _decimals(table: FoundTable) -> Iterator[str]:
    """The different decimals of a table that may be rounded, in order."""
    yield from dict.fromkeys(x for x in numbers_of(table) if _digits(x) >= FEWEST_DIGITS)


def _digits(text: str) -> int:
    """Significant digits of a decimal; 0 of anything else."""
    if not _DECIMAL.fullmatch(text) or "." not in text:
        return 0
    mantissa = text.partition("e")[0]
    return len(mantissa.replace(".", "").strip("-").strip("0"))


def proposed(text: str) -> Proposal | None:
    """The shortest exact form of a decimal, where there is one that its digits speak for.

    >>> proposed("0.78867513459481288").exact, proposed("0.3333333333333333").exact
    ('1/2 + sqrt(3)/6', '1/3')
    """
    digits = _digits(text)
    if not FEWEST_DIGITS <= digits <= MAX_DIGITS:
        return None
    sign = -1 if text.startswith("-") else 1
    value = sign * read_decimal(text.lstrip("-"))
    unit = _last_place(text)
    # so many bits of the number are right
    bits = int(digits * BITS_A_DIGIT)
    with ctx.workprec(bits + 64):
        ball = arb(value).mid()
        fraction = rational(ball, bits)
        if fraction is not None:
            return _near(text, value, unit, str(fraction), fraction)
        polynomial = minimal_polynomial(ball, bits)
    if polynomial is None or not 1 < polynomial.degree() <= MAX_DEGREE:
        return None
    root = _nearest_root(polynomial, value)
    if root is None:
        return None
    exact = root_text(root) or _root_of(polynomial, text)
    return _near(text, value, unit, exact, root.ball(PRECISION))


def _last_place(text: str) -> fmpq:
    mantissa, _, exponent = text.partition("e")
    places = len(mantissa.partition(".")[2]) - int(exponent or 0)
    return fmpq(10) ** -places


def _near(text: str, value: fmpq, unit: fmpq, exact: str, found: arb | fmpq) -> Proposal | None:
    """The proposal, where the digits are those of the number."""
    with ctx.workprec(PRECISION):
        distance = abs(arb(found) - arb(value))
        if not distance <= LAST_PLACES * unit:
            return None
        return Proposal(text, exact, decimal(rounded_up(distance)), len(exact))


def _nearest_root(polynomial: fmpz_poly, value: fmpq) -> RealRoot | None:
    roots = [root for root, _ in real_roots(Polynomial.from_flint(fmpq_poly(polynomial)))]
    if not roots:
        return None
    return min(roots, key=lambda root: abs(root.ball(256) - value).mid())


def _root_of(polynomial: fmpz_poly, near: str) -> str:
    plain = polynomial_text(Polynomial.from_flint(fmpq_poly(polynomial)), "x").replace("^", "**")
    return f"root_of({plain}, {near})"
