"""Theorem B of docs/pair-order.md by a program of its own: random methods, their blocks and the
criterion in plain fractions, held against the certificate, to which everything goes as text.

``python -m tests.order.own_pairs --cases 10000``. With ``--trees N`` the first N pairs are also held
against all conditions of trees up to order 4, each vertex by its definition.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections import Counter
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import partial
from itertools import combinations_with_replacement, product
from random import Random
from typing import TypeAlias

from garkcli import find_order, loads, pair

Row: TypeAlias = list[Fraction]
Rows: TypeAlias = list[Row]
Case: TypeAlias = tuple[list[Row], list[Row], dict[tuple[int, int], Rows]]
"""Nodes and weights of each colour, and the blocks between colours."""
Tree: TypeAlias = tuple[tuple[int, int, "Tree"], ...]
"""The branches of a vertex: by which type of edge, to which colour, the branch."""
HIGHEST = 8
GRIDS = [
    ["0", "1"],
    ["0", "1/2", "1"],
    ["0", "1/3", "1"],
    ["1/3", "1"],
    ["1/4", "3/4"],
    ["0", "1/3", "2/3", "1"],
    ["1/4", "1/2", "3/4"],
    ["0", "1/4", "1/2", "3/4", "1"],
    ["0", "1/2", "1/2", "1"],
    ["1/2"],
]
"""Nodes; with the weights of interpolation, which are positive where they are taken."""


def solved(equations: list[tuple[Row, Fraction]], dice: Random) -> Row | None:
    """A solution of linear equations, small numbers for what they leave free; None for none."""
    rows = [[*row, right] for row, right in equations]
    size = len(rows[0]) - 1
    pivots: list[int] = []
    for column in range(size):
        n = len(pivots)
        found = next((i for i in range(n, len(rows)) if rows[i][column]), None)
        if found is None:
            continue
        rows[n], rows[found] = rows[found], rows[n]
        head = rows[n][column]
        rows[n] = [x / head for x in rows[n]]
        for i in range(len(rows)):
            if i != n and rows[i][column]:
                f = rows[i][column]
                rows[i] = [x - f * y for x, y in zip(rows[i], rows[n], strict=True)]
        pivots.append(column)
    if any(row[size] for row in rows[len(pivots) :]):
        return None
    values = [Fraction(dice.randint(-2, 2), dice.randint(1, 3)) for _ in range(size)]
    for row, column in zip(rows, pivots, strict=False):
        others = sum(row[j] * values[j] for j in range(size) if j != column)
        values[column] = row[size] - others
    return values


def weights(c: Row, dice: Random) -> Row:
    """Positive weights of as high a degree as there are."""
    degree = len(set(c))
    while True:
        equations = [([x**j for x in c], Fraction(1, j + 1)) for j in range(degree)]
        for _ in range(3):
            b = solved(equations, dice)
            if b is not None and min(b) > 0:
                return b
        degree -= 1
        if degree == 0:
            return [Fraction(1, len(c)) for _ in c]


def _added(
    equations: list[tuple[Row, Fraction]],
    places: list[tuple[int, int]],
    entries: dict[tuple[int, int], Fraction],
    right: Fraction,
) -> None:
    equations.append(([entries.get(x, Fraction(0)) for x in places], right))


def block(dice: Random, l: tuple[Row, Row], m: tuple[Row, Row], p: int, is_own: bool) -> Rows:
    """A block with C(k), D(k) and the even condition for p, as far as they can be met; row sums of
    a block of its own are the nodes.
    """
    (c_l, b_l), (c_m, b_m) = l, m
    rows, columns = len(c_l), len(c_m)
    for order in range(p, -1, -1):
        k = (order - 1) // 2
        equations: list[tuple[Row, Fraction]] = []
        add = partial(_added, equations, list(product(range(rows), range(columns))))

        for j in range(1, max(k, int(is_own)) + 1):
            for i in range(rows):
                add({(i, n): c_m[n] ** (j - 1) for n in range(columns)}, c_l[i] ** j / j)
        for j in range(1, k + 1):
            for n in range(columns):
                add(
                    {(i, n): b_l[i] * c_l[i] ** (j - 1) for i in range(rows)},
                    b_m[n] * (1 - c_m[n] ** j) / j,
                )
        if order and order % 2 == 0:
            places = product(range(rows), range(columns))
            entries = {(i, n): b_l[i] * c_l[i] ** k * b_m[n] * c_m[n] ** k for i, n in places}
            add(entries, Fraction(1, 2 * (k + 1) ** 2))
        if not equations:
            add({}, Fraction(0))
        found = solved(equations, dice)
        if found is not None:
            return [found[i * columns : (i + 1) * columns] for i in range(rows)]
    raise AssertionError


def random_case(dice: Random) -> Case:
    """One to three colours, blocks for an order that is wanted, now and then one of them for less."""
    wanted = dice.choice((1, 2, 2, 3, 3, 4, 4, 5, 6))
    many = [x for x in GRIDS if len(set(x)) >= wanted - 1]
    grids = many if dice.random() < 0.7 else GRIDS
    nodes = [[Fraction(x) for x in dice.choice(grids)] for _ in range(dice.choice((1, 2, 2, 3)))]
    b = [weights(c, dice) for c in nodes]
    numbers = range(len(nodes))
    blocks = {}
    for l, m in product(numbers, numbers):
        p = wanted - (dice.random() < 0.06)
        blocks[l, m] = block(dice, (nodes[l], b[l]), (nodes[m], b[m]), p, l == m)
    return nodes, b, blocks


def criterion(case: Case) -> int:
    """The largest n for which B(n), C(k), D(k) and, for even n, the even condition hold."""
    return next((n - 1 for n in range(1, HIGHEST + 1) if not fits(case, n)), HIGHEST)


def fits(case: Case, n: int) -> bool:
    """Whether they hold for n."""
    nodes, b, blocks = case
    k = (n - 1) // 2
    for c, w in zip(nodes, b, strict=True):
        for j in range(1, n + 1):
            if sum(x * y ** (j - 1) for x, y in zip(w, c, strict=True)) != Fraction(1, j):
                return False
    for (l, m), A in blocks.items():
        c_l, c_m, b_l, b_m = nodes[l], nodes[m], b[l], b[m]
        for j in range(1, k + 1):
            for row, x in zip(A, c_l, strict=True):
                if sum(a * y ** (j - 1) for a, y in zip(row, c_m, strict=True)) != x**j / j:
                    return False
            for i, (x, own) in enumerate(zip(c_m, b_m, strict=True)):
                left = sum(v * y ** (j - 1) * row[i] for v, y, row in zip(b_l, c_l, A, strict=True))
                if left != own * (1 - x**j) / j:
                    return False
        if n % 2 == 0:
            value = sum(
                v * y**k * a * x**k
                for v, y, row in zip(b_l, c_l, A, strict=True)
                for a, x in zip(row, c_m, strict=True)
            )
            if value != Fraction(1, 2 * (k + 1) ** 2):
                return False
    return True


def certified(case: Case) -> int:
    """The order of the pair by the certificate, the method handed over as a file."""
    nodes, b, blocks = case
    numbers = range(len(nodes))

    rows = [[[[str(x) for x in row] for row in blocks[l, m]] for m in numbers] for l in numbers]
    if len(nodes) == 1:
        file = f"A: {text_of(rows[0][0])}\nb: {text_of([str(x) for x in b[0]])}\n"
    else:
        file = f"A: {text_of(rows)}\nb: {text_of([[str(x) for x in w] for w in b])}\n"
        file += f"c: {text_of([[str(x) for x in c] for c in nodes])}\n"
    return find_order(pair(loads(file)), limit=HIGHEST).order


def text_of(rows: object) -> str:
    """Nested lists as YAML."""
    return str(rows).replace("'", '"')


def conjugates(case: Case) -> dict[tuple[int, int], Rows]:
    """Â^{l,m} = 𝟙 b_mᵀ − B_l⁻¹ (A^{m,l})ᵀ B_m."""
    _, b, blocks = case
    return {
        (l, m): [
            [b[m][j] - blocks[m, l][j][i] * b[m][j] / b[l][i] for j in range(len(b[m]))]
            for i in range(len(b[l]))
        ]
        for l, m in blocks
    }


def trees(order: int, colours: int) -> Iterator[Tree]:
    """All trees of an order, but for the colour of the root, as multisets of branches."""
    if order == 1:
        yield ()
        return
    branches = [
        (e, m, x, k)
        for k in range(1, order)
        for e in (0, 1)
        for m in range(colours)
        for x in trees(k, colours)
    ]
    for count in range(1, order):
        for chosen in combinations_with_replacement(branches, count):
            if sum(x[3] for x in chosen) == order - 1:
                yield tuple(x[:3] for x in chosen)


def size(tree: Tree) -> int:
    return 1 + sum(size(x) for _, _, x in tree)


def density(tree: Tree) -> int:
    found = size(tree)
    for _, _, x in tree:
        found *= density(x)
    return found


def stages(edges: Sequence[dict[tuple[int, int], Rows]], l: int, tree: Tree, count: int) -> Row:
    """The stage vector of a tree with a root of colour l."""
    vector = [Fraction(1)] * count
    for e, m, branch in tree:
        A = edges[e][l, m]
        below = stages(edges, m, branch, len(A[0]))
        image = [sum((a * x for a, x in zip(row, below, strict=True)), Fraction(0)) for row in A]
        vector = [x * y for x, y in zip(vector, image, strict=True)]
    return vector


def by_trees(case: Case, highest: int) -> int:
    """The order of the pair by all conditions, up to an order."""
    _, b, blocks = case
    edges = [blocks, conjugates(case)]
    for order in range(1, highest + 1):
        for tree in trees(order, len(b)):
            for l, w in enumerate(b):
                vector = stages(edges, l, tree, len(w))
                value = sum(x * y for x, y in zip(w, vector, strict=True))
                if value != Fraction(1, density(tree)):
                    return order - 1
    return highest


def compare(cases: int, trees_of: int, seed: int) -> Counter[int]:
    """How many pairs have which order, all of them by both programs."""
    dice = Random(seed)
    orders: Counter[int] = Counter()
    for number in range(cases):
        case = random_case(dice)
        found = criterion(case)
        assert found == certified(case), (number, case)
        if number < trees_of:
            assert by_trees(case, 4) == min(found, 4), (number, case)
        orders[found] += 1
    return orders


def main(arguments: Sequence[str]) -> int:
    parser = ArgumentParser()
    parser.add_argument("--cases", type=int, default=10_000)
    parser.add_argument("--trees", type=int, default=0)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args(arguments)
    orders = compare(given.cases, given.trees, given.seed)
    print(f"{given.cases} pairs agree, of order {dict(sorted(orders.items()))}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
