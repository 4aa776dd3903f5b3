"""Theorem B of docs/pair-order.md where some colours are linear: random methods and the criterion in
plain fractions, held against the certificate, to which everything goes as text.

``python -m tests.order.linear_pairs --cases 10000``
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections import Counter
from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations, product
from math import factorial
from random import Random
from typing import NamedTuple

from garkcli import find_order, loads, pair
from tests.order.own_pairs import GRIDS, HIGHEST, Row, Rows, block, text_of, weights

Blocks = dict[tuple[int, int], Rows]


class Case(NamedTuple):
    """A method whose symplectic pair is judged.

    Attributes:
        b: positive weights of each colour.
        blocks: those of Q, each also the conjugate of one of P.
        linear: the colours whose vector field is linear.
        is_split: whether each two colours have one block of Q only, as separable pairs have: then
            the pair has the blocks and their conjugates in the other direction, on N colours.
    """

    b: list[Row]
    blocks: Blocks
    linear: frozenset[int]
    is_split: bool


def applied(A: Rows, v: Row) -> Row:
    return [sum((a * x for a, x in zip(row, v, strict=True)), Fraction(0)) for row in A]


def times(*vectors: Row) -> Row:
    found = [Fraction(1)] * len(vectors[0])
    for vector in vectors:
        found = [x * y for x, y in zip(found, vector, strict=True)]
    return found


def conjugate(A: Rows, b_l: Row, b_m: Row) -> Rows:
    """Â^{m,l} of A = A^{l,m}: b_lⱼ − aⱼᵢ b_lⱼ / b_mᵢ."""
    return [[w - A[j][i] * w / b_m[i] for j, w in enumerate(b_l)] for i in range(len(b_m))]


def edges(case: Case) -> list[tuple[int, int, Rows]]:
    """The edges of the pair: from a colour, to another, by a block of Q or of P."""
    found = [(l, m, A) for (l, m), A in case.blocks.items()]
    hats = [(m, l, conjugate(A, case.b[l], case.b[m])) for (l, m), A in case.blocks.items()]
    return found + hats


def criterion(case: Case) -> int:
    """The largest n that Theorem B bears out."""
    return next((n - 1 for n in range(1, HIGHEST + 1) if not fits(case, n)), HIGHEST)


def fits(case: Case, n: int) -> bool:
    """Whether the conditions of Theorem B for order n hold."""
    k = (n - 1) // 2
    found = edges(case)
    a = [[[Fraction(1)] * len(b)] for b in case.b]
    for j in range(1, k + 1):
        for l in range(len(a)):
            first = next(A for i, _, A in found if i == l)
            to = next(m for i, m, _ in found if i == l)
            if l in case.linear or j == 1:
                a[l].append(applied(first, a[to][j - 1]))
            else:
                a[l].append([x**j / factorial(j) for x in a[l][1]])
        if any(applied(A, a[m][j - 1]) != a[l][j] for l, m, A in found):
            return False
    for l, b in enumerate(case.b):
        for value, right in weighted(a[l], n, l in case.linear):
            if sum(x * y for x, y in zip(b, value, strict=True)) != right:
                return False
    right = Fraction(1, 2 * (k + 1) * factorial(k) * factorial(k + 1))
    return n % 2 == 1 or all(
        sum(times(case.b[l], a[l][k], applied(A, a[m][k]))) == right for l, m, A in found
    )


def nystrom(case: Case) -> int:
    """The same of two colours with one block, one of them linear, by what the other one sees:
    M = A^{2,1} Â^{1,2} and its nodes x = A^{2,1} 𝟙, of the blocks that the linear colour is between.
    """
    (linear,) = case.linear
    forth = next(A for l, _, A in edges(case) if l != linear)
    back = next(A for l, _, A in edges(case) if l == linear)
    b = case.b[1 - linear]
    x = applied(forth, [Fraction(1)] * len(case.b[linear]))

    def mean(*vectors: Row) -> Fraction:
        return sum(times(b, *vectors), Fraction(0))

    def power(j: int) -> Row:
        return [y**j for y in x]

    def image(j: int) -> Row:
        return applied(forth, applied(back, power(j)))

    def holds(n: int) -> bool:
        k = (n - 1) // 2
        return (
            sum(case.b[linear]) == 1
            and mean(power(n - 1)) == Fraction(1, n)
            and (k < 2 or image(k - 2) == [y / (k * (k - 1)) for y in power(k)])
            and (
                k == 0 or mean(power(k - 1), image(k - 1)) == Fraction(1, k * (k + 1) * (2 * k + 1))
            )
            and (
                k == 0
                or n % 2 == 1
                or mean(power(k), image(k - 1)) == Fraction(1, 2 * k * (k + 1) ** 2)
            )
        )

    return next((n - 1 for n in range(1, HIGHEST + 1) if not holds(n)), HIGHEST)


def weighted(a: list[Row], n: int, is_linear: bool) -> Iterator[tuple[Row, Fraction]]:
    """What the weights of a colour are applied to, and the value that order n needs."""
    k = len(a) - 1
    if is_linear:
        for i, j in [(j, j) for j in range(k + 1)] + [(j, j + 1) for j in range(k)]:
            yield times(a[i], a[j]), Fraction(1, (i + j + 1) * factorial(i) * factorial(j))
    elif k:
        for j in range(n):
            yield [x**j for x in a[1]], Fraction(1, j + 1)
    else:
        yield a[0], Fraction(1)


def certified(case: Case) -> int:
    """The order of the pair by the certificate, the method handed over as a file."""
    numbers = range(len(case.b))
    blocks = dict(case.blocks)
    if case.is_split:
        blocks = {(l, m): A for l, m, A in edges(case)}
    rows = [
        [
            [[str(x) for x in row] for row in blocks[l, m]] if (l, m) in blocks else None
            for m in numbers
        ]
        for l in numbers
    ]
    file = f"A: {text_of(rows).replace('None', 'null')}\n"
    file += f"b: {text_of([[str(x) for x in w] for w in case.b])}\n"
    if case.linear:
        file += f"linear: {[l + 1 for l in sorted(case.linear)]}\n"
    method = loads(file)
    return find_order(method if case.is_split else pair(method), limit=HIGHEST).order


def reflection(dice: Random, b: Row) -> Rows:
    """A reflection that keeps 𝟙 and the inner product b(fg)."""
    w = [Fraction(dice.randint(-3, 3)) for _ in b]
    mean = sum(x * y for x, y in zip(b, w, strict=True)) / sum(b)
    w = [x - mean for x in w]
    norm = sum(x * y * y for x, y in zip(b, w, strict=True))
    size = range(len(b))
    return [
        [int(i == j) - (2 * w[i] * b[j] * w[j] / norm if norm else 0) for j in size] for i in size
    ]


def turned(case: Case, l: int, U: Rows) -> Case:
    """The same with the stages of a colour turned: a linear colour does not see it."""
    blocks: Blocks = {}
    for (i, m), A in case.blocks.items():
        found = A
        if i == l:
            columns = [applied(U, [row[n] for row in found]) for n in range(len(found[0]))]
            found = [list(row) for row in zip(*columns, strict=True)]
        if m == l:
            transposed = [list(column) for column in zip(*U, strict=True)]
            found = [applied(transposed, row) for row in found]
        blocks[i, m] = found
    return case._replace(blocks=blocks)


def random_case(dice: Random) -> Case:
    """One to three colours, some of them linear; blocks for an order that is wanted, now and then
    one of them for less; the stages of linear colours often turned, those of others seldom.
    """
    wanted = dice.choice((1, 2, 3, 3, 4, 4, 5, 6))
    many = [x for x in GRIDS if len(set(x)) >= wanted - 1]
    grids = many if dice.random() < 0.7 else GRIDS
    colours = range(dice.choice((1, 2, 2, 3)))
    nodes = [[Fraction(x) for x in dice.choice(grids)] for _ in colours]
    linear = frozenset(l for l in colours if dice.random() < 0.6)
    b = [weights(c, dice) for c in nodes]
    is_split = len(colours) > 1 and dice.random() < 0.5
    places: list[tuple[int, int]] = list(product(colours, colours))
    if is_split:
        places = [dice.choice(((l, m), (m, l))) for l, m in combinations(colours, 2)]
        if len(places) == 3 and dice.random() < 0.5:
            places.pop()
    blocks = {}
    for l, m in places:
        p = wanted - (dice.random() < 0.06)
        blocks[l, m] = block(dice, (nodes[l], b[l]), (nodes[m], b[m]), p, l == m)
    case = Case(b, blocks, linear, is_split)
    for l in colours:
        if dice.random() < (0.8 if l in linear else 0.05):
            case = turned(case, l, reflection(dice, b[l]))
    return case


def compare(cases: int, seed: int) -> Counter[tuple[bool, int]]:
    """How many pairs, with linear colours or without, have which order by both programs."""
    dice = Random(seed)
    orders: Counter[tuple[bool, int]] = Counter()
    for number in range(cases):
        case = random_case(dice)
        found = criterion(case)
        assert found == certified(case), (number, case)
        if case.is_split and len(case.b) == 2 and len(case.linear) == 1:
            assert found == nystrom(case), (number, case)
        orders[bool(case.linear), found] += 1
    return orders


def main(arguments: Sequence[str]) -> int:
    parser = ArgumentParser()
    parser.add_argument("--cases", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args(arguments)
    orders = compare(given.cases, given.seed)
    for is_linear, name in ((True, "with"), (False, "without")):
        of = {order: count for (has, order), count in sorted(orders.items()) if has == is_linear}
        print(f"{sum(of.values())} pairs {name} linear colours agree, of order {of}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
