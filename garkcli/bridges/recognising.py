"""Exact forms of decimals: proposed from their digits, taken where the order does not fall."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from decimal import Decimal
from operator import ge
from typing import Any

from flint import arb, ctx, fmpq, fmpq_poly

from garkcli.bridges.claiming import imported
from garkcli.bridges.importing import numbers_of
from garkcli.bridges.subject import Subject
from garkcli.design.search.recognise import minimal_polynomial, rational
from garkcli.errors import MethodFileError
from garkcli.exact.display import decimal
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_text
from garkcli.exact.roots import real_roots
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
_DECIMAL = re.compile(r"-?[0-9]*\.[0-9]*(?:e[-+]?[0-9]{1,3})?")


class Proposal(Frozen):
    """An exact form of a decimal.

    Attributes:
        printed: the decimal.
        exact: the text of a coefficient; the longer it is, the less it says.
        distance: how far they are apart, as a decimal, rounded up.
    """

    printed: str
    exact: str
    distance: str


class Recognised(Frozen):
    """A method with exact forms in place of decimals.

    Attributes:
        method: with those that were taken.
        taken: what was taken.
        refused: what was proposed, and with which the order falls.
        left: decimals that nothing was proposed for.
    """

    method: Subject
    taken: tuple[Proposal, ...]
    refused: tuple[Proposal, ...]
    left: tuple[str, ...]

    def notes(self) -> Iterator[str]:
        """What people should know, a sentence each."""
        yield from (f"{x.printed} is {x.exact}, {x.distance} away" for x in self.taken)
        for x in self.refused:
            yield f"{x.printed} is not {x.exact}: with it the order falls"
        yield from (f"{text} stays a decimal" for text in self.left)


def recognised(before: Subject, name: str, is_as_found: bool = False) -> Recognised:
    """The method with exact numbers, as many as the certificate of the order bears out.

    Args:
        before: as it was imported.
        name: what its file calls it.
        is_as_found: whether the file claims what is true instead of what the source declares.
    """
    texts = dict.fromkeys(numbers_of(before.table))
    decimals = [x for x in texts if _digits(x) >= FEWEST_DIGITS]
    found = {x: proposed(x) for x in decimals[:MAX_NUMBERS]}
    left = tuple(x for x in decimals if found.get(x) is None)
    # the shortest forms are the surest; the longest are given up first
    kept = sorted(filter(None, found.values()), key=lambda x: len(x.exact))
    refused: list[Proposal] = []
    while kept:
        after = _with(before.table, {x.printed: x.exact for x in kept}, name, is_as_found)
        if after is not None and all(map(ge, _orders(after), _orders(before))):
            return Recognised(after, tuple(kept), tuple(refused), left)
        refused.append(kept.pop())
    return Recognised(before, (), tuple(refused), left)


def _orders(found: Subject) -> list[int]:
    return [x.order for x in (found.order, found.embedded_order) if x is not None]


def _with(
    table: FoundTable, exact: Mapping[str, str], name: str, is_as_found: bool
) -> Subject | None:
    """The method with other texts; what the source says of its rounding goes."""

    def changed(value: Any) -> Any:
        return tuple(map(changed, value)) if isinstance(value, tuple) else exact.get(value, value)

    numbers = {key: changed(getattr(table, key)) for key in ("A", "b", "c", "embedded")}
    try:
        return imported(replace(table, **numbers, tolerance=""), name, is_as_found)
    except MethodFileError:
        return None


def _digits(text: str) -> int:
    """Significant digits of a decimal; 0 of anything else."""
    if not _DECIMAL.fullmatch(text) or not any(x.isdigit() for x in text):
        return 0
    return len("".join(map(str, Decimal(text).as_tuple().digits)).strip("0"))


def proposed(text: str) -> Proposal | None:
    """The shortest exact form of a decimal, where there is one that its digits speak for.

    >>> proposed("0.78867513459481288").exact, proposed("0.3333333333333333").exact
    ('1/2 + sqrt(3)/6', '1/3')
    """
    digits = _digits(text)
    if not FEWEST_DIGITS <= digits <= MAX_DIGITS:
        return None
    value = fmpq(*Decimal(text).as_integer_ratio())
    # so many bits of the number are right
    bits = int(digits * BITS_A_DIGIT)
    with ctx.workprec(bits + 64):
        ball = arb(value).mid()
        fraction = rational(ball, bits)
        found = None if fraction is not None else minimal_polynomial(ball, bits)
    if fraction is not None:
        return _near(text, value, str(fraction), fraction)
    if found is None or not 1 < found.degree() <= MAX_DEGREE:
        return None
    polynomial = Polynomial.from_flint(fmpq_poly(found))
    roots = [root for root, _ in real_roots(polynomial)]
    if not roots:
        return None
    root = min(roots, key=lambda root: abs(root.ball(256) - value).mid())
    plain = polynomial_text(polynomial, "x").replace("^", "**")
    exact = root_text(root) or f"root_of({plain}, {text})"
    return _near(text, value, exact, root.ball(PRECISION))


def _near(text: str, value: fmpq, exact: str, found: arb | fmpq) -> Proposal | None:
    """The proposal, where the digits are those of the number."""
    unit = fmpq(10) ** int(Decimal(text).as_tuple().exponent)
    with ctx.workprec(PRECISION):
        distance = abs(arb(found) - arb(value))
        if not distance <= LAST_PLACES * unit:
            return None
        return Proposal(text, exact, decimal(rounded_up(distance)))
