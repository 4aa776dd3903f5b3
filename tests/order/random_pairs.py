"""Tableaus whose symplectic pairs are held against docs/pair-order.md: some diagonal methods with
positive weights, and between them rules, mixtures, members of the affine space of all transfers,
or any blocks.

``python -m tests.order.random_pairs --cases 10000`` compares the criterion with the certificate,
``make pairs`` also the statements on rules and on the space.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from random import Random

from flint import fmpq

from garkcli.check.pair_reasons import fit
from garkcli.errors import CoincidingNodes
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, dot
from garkcli.methodfile.description import BlockRule
from garkcli.order.certificate import find_order
from garkcli.order.pair_order import pair_criterion
from garkcli.tableau.forms import gark, pair
from garkcli.tableau.tableau import Edge, Method, Tableau, butcher
from garkcli.transfer import RULES, combination, legendre
from tests.oracles.points import numbers
from tests.oracles.samples import method

LIMIT = 12
NAMES = (
    *("gauss 1", "gauss 2", "gauss 3", "radau-ia 2", "radau-iia 2", "radau-iia 3", "heun", "rk4"),
    *("lobatto-iiia 2", "lobatto-iiia 3", "lobatto-iiia 4", "lobatto-iiib 3", "lobatto-iiic 3"),
    *("lobatto-iiid 3", "kutta", "ssp3 4", "explicit-euler"),
)
"""Families, all of them with positive weights."""
SPELLED = {
    "3/8 rule": ("0,0,0,0", "1/3,0,0,0", "-1/3,1,0,0", "1,-1,1,0", "1/8,3/8,3/8,1/8"),
    "nodes 0, 1/4, 3/4, 1": (
        "0,0,0,0",
        "1/4,0,0,0",
        "-3/4,3/2,0,0",
        "5,-6,2,0",
        "1/18,4/9,4/9,1/18",
    ),
    "nodes 0, 5/9, 1": ("0,0,0", "5/9,0,0", "-7/5,12/5,0", "1/5,27/40,1/8"),
}


def pool() -> list[Method]:
    """The diagonal methods."""
    found = [method(name) for name in NAMES]
    for name, rows in SPELLED.items():
        *A, b = numbers(*rows)
        found.append(butcher(tuple(A), b, None, name))
    return found


def small(dice: Random) -> fmpq:
    return fmpq(dice.randint(-4, 4), dice.randint(1, 4))


def rule(dice: Random) -> Callable[[Method, Method], Matrix]:
    """A rule, Legendre of any degree among them."""
    name = dice.choice((*RULES, "legendre"))
    if name != "legendre":
        return RULES[name]
    degree = dice.randint(0, 4)
    return lambda l, m: legendre(l, m, degree)


def random_block(dice: Random, l: Method, m: Method) -> Matrix:
    """A block of one of the kinds; of those that need distinct nodes another where these coincide."""
    kind = dice.choice(("rule", "rule", "mixture", "member", "member", "any"))
    try:
        if kind == "rule":
            return rule(dice)(l, m)
        if kind == "mixture":
            tau = small(dice)
            return combination([(tau, rule(dice)), (1 - tau, rule(dice))], l, m)
    except CoincidingNodes:
        kind = "member"
    if kind == "any":
        return tuple(tuple(small(dice) for _ in m.b) for _ in l.b)
    return member(dice, l, m, dice.randint(1, 6))


def conditions(l: Method, m: Method, p: int) -> Iterator[tuple[dict[Edge, Number], Number]]:
    """C(k), D(k) and the even condition on a block as linear equations in its entries, from their
    definitions: coefficients by places, and the right-hand side.
    """
    k = (p - 1) // 2
    x_l, x_m = l.space.nodes, m.space.nodes
    for j in range(1, k + 1):
        v, w = m.space.power(x_m, j - 1), l.space.power(x_l, j)
        for i in range(l.stages):
            yield {(i, n): v[n] for n in range(m.stages)}, w[i] * fmpq(1, j)
        u = l.space.times(l.b, l.space.power(x_l, j - 1))
        z = m.space.times(
            m.b, tuple(1 * a - b for a, b in zip(m.space.one, m.space.power(x_m, j), strict=True))
        )
        for n in range(m.stages):
            yield {(i, n): u[i] for i in range(l.stages)}, z[n] * fmpq(1, j)
    if p % 2 == 0:
        u = l.space.times(l.b, l.space.power(x_l, k))
        v = m.space.power(x_m, k)
        places = ((i, n) for i in range(l.stages) for n in range(m.stages))
        yield {(i, n): u[i] * v[n] for i, n in places}, fmpq(1, 2 * (k + 1) ** 2)


def equations(l: Method, m: Method, p: int) -> list[list[Number]]:
    """The conditions of pair order p as rows of a linear system for the entries of a block."""
    size = l.stages * m.stages
    rows: list[list[Number]] = []
    for coefficients, right in conditions(l, m, p):
        row: list[Number] = [fmpq(0)] * (size + 1)
        for (i, n), value in coefficients.items():
            row[i * m.stages + n] = value
        row[size] = right
        rows.append(row)
    return rows


def member(dice: Random, l: Method, m: Method, p: int) -> Matrix:
    """A random block with the conditions of pair order p; entries that nothing fixes are small."""
    size = l.stages * m.stages
    rows = equations(l, m, p)
    pivots = reduced(rows, size)
    if pivots is None:
        return member(dice, l, m, p - 1)
    entries: list[Number] = [small(dice) for _ in range(size)]
    for row, pivot in pivots:
        known = dot(row[:size], entries) - row[pivot] * entries[pivot]
        entries[pivot] = row[size] - known
    return tuple(tuple(entries[i * m.stages : (i + 1) * m.stages]) for i in range(l.stages))


def reduced(rows: list[list[Number]], size: int) -> list[tuple[list[Number], int]] | None:
    """Rows in reduced echelon form with their pivots, by Gauss and Jordan; None where they have no
    solution.
    """
    done: list[tuple[list[Number], int]] = []
    for given in rows:
        row = given
        for other, pivot in done:
            if row[pivot]:
                row = [a - row[pivot] * b for a, b in zip(row, other, strict=True)]
        place = next((n for n in range(size) if row[n]), None)
        if place is None:
            if row[size]:
                return None
            continue
        row = [a / row[place] for a in row]
        done = [
            (
                [a - other[place] * b for a, b in zip(other, row, strict=True)]
                if other[place]
                else other,
                pivot,
            )
            for other, pivot in done
        ]
        done.append((row, place))
    return done


def dimension(l: Method, m: Method, p: int) -> int | None:
    """That of the affine space of blocks with these conditions, by counting pivots."""
    size = l.stages * m.stages
    rows = equations(l, m, p)
    pivots = reduced(rows, size)
    return None if pivots is None else size - len(pivots)


def edges(count: int) -> list[Edge]:
    return [(l, m) for l in range(count) for m in range(count) if l != m]


def tableau(dice: Random, methods: Sequence[Method]) -> Tableau:
    """Some of the methods, one to three, with a block of any kind between each two; of three often
    with members of one order, which random blocks do not reach together.
    """
    chosen = [dice.choice(methods) for _ in range(dice.choice((1, 2, 2, 2, 3)))]
    p = dice.randint(1, 6) if dice.random() < 0.4 else 0
    make: Callable[[Method, Method], Matrix]
    make = (lambda l, m: member(dice, l, m, p)) if p else (lambda l, m: random_block(dice, l, m))
    return gark(chosen, {(l, m): make(chosen[l], chosen[m]) for l, m in edges(len(chosen))})


def criterion_holds(case: Tableau) -> tuple[int, int]:
    """The order of the pair by the certificate, and by the criterion."""
    return find_order(pair(case), LIMIT).order, pair_criterion(case, LIMIT).order


def rules_hold(dice: Random, methods: Sequence[Method]) -> Counter[str]:
    """Some methods with one rule for all blocks: where the theorems say that each block fits, the
    pair has the least pair order p of the diagonal methods; where one does not, it has not. And p is
    never surpassed.
    """
    chosen = [dice.choice(methods) for _ in range(dice.choice((2, 2, 3)))]
    p = min(find_order(pair(gark([x], {})), LIMIT).order for x in chosen)
    count: Counter[str] = Counter()
    for name in ("collocation", "interpolation", "legendre"):
        degree = dice.choice((None, *range(6))) if name == "legendre" else None
        make = RULES[name]
        if name == "legendre":
            make = partial(legendre, degree=p // 2 if degree is None else degree)
        try:
            blocks = {(l, m): make(chosen[l], chosen[m]) for l, m in edges(len(chosen))}
        except CoincidingNodes:
            continue
        found = find_order(pair(gark(chosen, blocks)), LIMIT).order
        fits = [fit(BlockRule(l, m, name, degree), chosen, p) for l, m in blocks]
        said = {None if x is None else x.keeps for x in fits}
        assert found <= p, (chosen, name, degree)
        if said == {True}:
            assert found == p, ([x.name for x in chosen], name, degree, found, p)
            count[f"{name} keeps"] += 1
        elif False in said:
            assert found < p, ([x.name for x in chosen], name, degree, found, p)
            count[f"{name} loses"] += 1
        else:
            count[f"{name}: nothing is said"] += 1
    return count


def space_holds(dice: Random, methods: Sequence[Method]) -> int:
    """Two methods: the dimension of all transfers is that of the theorem, and a random one of them
    has pair order p, not p + 1 unless its conditions say so.
    """
    l, m = dice.choice(methods), dice.choice(methods)
    p = min(find_order(pair(gark([x], {})), LIMIT).order for x in (l, m))
    k = (p - 1) // 2
    wanted = 2 * ((l.stages - k) * (m.stages - k) - (p % 2 == 0))
    dimensions = [dimension(l, m, p), dimension(m, l, p)]
    assert None not in dimensions, (l.name, m.name, p)
    assert sum(x for x in dimensions if x is not None) == wanted, (l.name, m.name, p)
    case = gark([l, m], {(0, 1): member(dice, l, m, p), (1, 0): member(dice, m, l, p)})
    assert find_order(pair(case), LIMIT).order == p, (l.name, m.name, p)
    return p


def main(arguments: Sequence[str]) -> int:
    parser = ArgumentParser()
    parser.add_argument("--cases", type=int, default=10_000, help="for the criterion")
    parser.add_argument("--rules", type=int, default=0, help="tuples of methods for the rules")
    parser.add_argument("--spaces", type=int, default=0, help="pairs for the space of all")
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args(arguments)
    dice, methods = Random(given.seed), pool()
    orders: Counter[int] = Counter()
    for _ in range(given.cases):
        case = tableau(dice, methods)
        by_certificate, by_criterion = criterion_holds(case)
        assert by_certificate == by_criterion, (case, by_certificate, by_criterion)
        orders[by_certificate] += 1
    print(f"criterion: {given.cases} pairs agree, of order {dict(sorted(orders.items()))}")
    count: Counter[str] = Counter()
    for _ in range(given.rules):
        count += rules_hold(dice, methods)
    print(f"rules: {given.rules} tuples agree: {dict(sorted(count.items()))}")
    spaces = Counter(space_holds(dice, methods) for _ in range(given.spaces))
    print(f"spaces: {given.spaces} agree, of order {dict(sorted(spaces.items()))}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
