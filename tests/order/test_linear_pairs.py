"""Theorem B' of docs/pair-order.md: the order of pairs of which some colours are linear."""

from fractions import Fraction

from tests.order.linear_pairs import Case, certified, compare, criterion, nystrom
from tests.order.own_pairs import Row, Rows
from tests.whole import in_whole


def rows(*texts: str) -> Rows:
    return [row(text) for text in texts]


def row(text: str) -> Row:
    return [Fraction(x) for x in text.split(",")]


LOBATTO = rows("0, 0, 0", "5/24, 1/3, -1/24", "1/6, 2/3, 1/6")


@in_whole
def test_the_criterion_is_the_order_of_random_pairs() -> None:
    """With linear colours and without, of orders that vary."""
    orders = compare(25, seed=4)
    assert {order for has_linear, order in orders if has_linear} >= {1, 2, 3, 4}


def test_the_weights_of_a_linear_colour_need_no_quadrature_order() -> None:
    """Lobatto IIIA 3 turned by an isometry of b that keeps 𝟙: V does not see it while it is linear,
    though B(4) fails for its nodes; with V of any kind the order is 3.
    """
    turn = rows("-3/5, 8/5, 0", "2/5, 3/5, 0", "0, 0, 1")
    A = [
        [
            sum(x * y for x, y in zip(line, column, strict=True))
            for column in zip(*turn, strict=True)
        ]
        for line in LOBATTO
    ]
    b = row("1/6, 2/3, 1/6")
    linear = Case([b, b], {(1, 0): A}, frozenset({0}), is_split=True)
    assert criterion(linear) == nystrom(linear) == certified(linear) == 4
    nodes = [1 - sum(w * line[j] for w, line in zip(b, A, strict=True)) / b[j] for j in range(3)]
    assert nodes == row("4/5, 3/10, 1")
    assert sum(w * c**3 for w, c in zip(b, nodes, strict=True)) == Fraction(1, 4) + Fraction(1, 50)
    general = linear._replace(linear=frozenset())
    assert criterion(general) == certified(general) == 3


def test_neighbouring_vectors_need_their_number() -> None:
    """Both colours linear, all products of one block one vector, b(c²) = 1/3 for both; but
    b(c) = 5/9 and 4/9, so the order is 1.
    """
    A = rows("0, 7/9", "40/81, -37/81")
    b = [row("1/3, 2/3"), row("11/20, 9/20")]
    case = Case(b, {(1, 0): A}, frozenset({0, 1}), is_split=True)
    assert criterion(case) == certified(case) == 1
