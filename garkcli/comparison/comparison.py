"""The comparison of two methods, which ``gark diff`` reports."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from math import isclose
from typing import Literal, TypeAlias

from flint import fmpq

from garkcli.check.analysis import Analysis, AnyAnalysis, analyse_any
from garkcli.comparison.differences import BlockGap, Met, block_gaps, conditions_met
from garkcli.comparison.grid import Likeness
from garkcli.comparison.sameness import Sameness, find_sameness, views_of
from garkcli.constructions.derivatives import Derivatives, embedded_of, is_derivatives
from garkcli.constructions.nprk import is_nprk
from garkcli.constructions.nystrom import POSITIONS, START, is_nystrom
from garkcli.constructions.rosenbrock import is_rosenbrock
from garkcli.doing import doing
from garkcli.errors import MethodError
from garkcli.exact.field import ZERO
from garkcli.frozen import Frozen, replace
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.deciding import AnyOrder
from garkcli.order.meant import meant
from garkcli.properties.registry import KEYS
from garkcli.properties.verdict import Size, Verdict
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

Relation: TypeAlias = Literal[
    "identical", "same", "within-rounding", "same-step", "different", "undecided"
]
"""Equal entries, one method, equal up to the rounding that the files admit, equal steps with
further weights of one, different, or not known.
"""


WITH_TIME = "order with time"
"""The order for ẏ = f(t, y), with the nodes as given."""


class OrderPair(Frozen):
    """An order of both methods; None for one that has no such order."""

    name: str
    one: AnyOrder | None
    other: AnyOrder | None

    @property
    def exists(self) -> bool:
        return self.one is not None or self.other is not None

    @property
    def is_different(self) -> bool:
        """Returns whether the two orders are known to be different."""
        one, other = self.one, self.other
        if one is None or other is None:
            return one is not other
        if one.order < other.order:
            return not one.is_lower_bound
        return one.order > other.order and not other.is_lower_bound


class PropertyPair(Frozen):
    key: str
    one: Verdict
    other: Verdict
    tolerances: tuple[fmpq | None, fmpq | None]

    @property
    def is_known(self) -> bool:
        return not (self.one.is_undecided or self.other.is_undecided)


class Comparison(Shown, Frozen):
    """Similarities and differences of two methods.

    Attributes:
        one: the first method.
        other: the second.
        forms: the kinds of their tableaus.
        gaps: where entries differ; empty for different numbers of colours.
        sameness: how they are the same method; None if they are not.
        obstacle: why that is not known; empty if it is.
        allowed: the distance by which the rounding of the files may move equal entries apart.
        orders: their orders, of the method, its embedded weights, its conjugate and its pair.
        met: the conditions that only one meets; None if the methods are the same, or have different
            numbers of colours.
        properties: those that differ, or are decided of one method alone.

    >>> from garkcli import compare
    >>> found = compare("rk4", "kutta-38")
    >>> found.relation, [gap.kind for gap in found.gaps]
    ('different', ['A', 'b', 'c'])
    """

    one: GarkMethod
    other: GarkMethod
    forms: tuple[str, str]
    gaps: tuple[BlockGap, ...]
    sameness: Sameness | None
    obstacle: str
    allowed: fmpq
    orders: tuple[OrderPair, ...]
    met: Met | None
    properties: tuple[PropertyPair, ...]

    @property
    def relation(self) -> Relation:
        """The relation of the two methods in one word."""
        same = self.sameness
        if same is None:
            return "undecided" if self.obstacle else "different"
        if same.step_only:
            return "same-step" if self.is_same_step else "different"
        if same.allowed:
            return "within-rounding"
        has_one_form = self.forms[0] == self.forms[1]
        if same.is_plain and has_one_form and not self.gaps:
            return "identical"
        return "same"

    @property
    def remark(self) -> str:
        """The only difference if it is not in a block or in b; otherwise empty."""
        if self.relation not in {"same-step", "different"}:
            return ""
        kinds = {gap.kind for gap in self.gaps}
        if self.sameness is not None:
            return "; ".join(self._further)
        if kinds == {"c"}:
            return "nodes alone differ"
        first, second = _linear(self.one), _linear(self.other)
        has_one_size = len(first) == len(second)
        if not kinds and has_one_size and first != second:
            return "the entries are the same, which colours are linear is not"
        return ""

    @property
    def is_same_step(self) -> bool:
        if self.sameness is None:
            return False
        shared = {x for x in ("embedded", "dense") if self._lacking(x) == [False, False]}
        return not shared & {gap.kind for gap in self.gaps}

    def _lacking(self, key: str) -> list[bool]:
        return [getattr(x, key) is None for x in (self.one, self.other)]

    @property
    def _further(self) -> Iterator[str]:
        """Yields the further weights that differ or are missing, if the steps are equal."""
        for name in ("embedded weights", "dense output"):
            key = name.partition(" ")[0]
            missing = self._lacking(key)
            if missing == [False, False] and key in {gap.kind for gap in self.gaps}:
                yield f"other {name}"
            elif any(missing) and not all(missing):
                yield f"the {'first' if missing[0] else 'second'} has no {name}"

    def __repr__(self) -> str:
        return f"<Comparison {self.relation}>"


@doing("differences")
def compare(one: GarkMethod, other: GarkMethod, limit: int = DEFAULT_LIMIT) -> Comparison:
    """Compares two methods: they are the same if renumbering stages or colours turns one into the
    other, after colours that share stages were given copies of them, and equal or redundant stages
    were removed. Raises MethodError for methods of different kinds.

    >>> from garkcli.methodfile.load import loads
    >>> heun = loads("{A: [[0, 0], [1, 0]], b: [1/2, 1/2]}")
    >>> turned = loads("{A: [[0, 1], [0, 0]], b: [0.5, 0.5]}")
    >>> compare(heun, turned).sameness.stages
    ((1, 0),)
    """
    forms = form_of(one.tableau), form_of(other.tableau)
    if forms[0] != forms[1] and {*forms} & {*OF_OTHER_KINDS}:
        message = "methods of different kinds have no entries in common"
        raise MethodError(message, "compare methods of one kind", code="other-file")
    allowed = (one.tolerance or ZERO) + (other.tolerance or ZERO)
    views = views_of(one, other)
    gaps: tuple[BlockGap, ...] = ()
    if views.one.size == views.other.size:
        seen = views if forms[0] != "mdrk" else views_of(*_of_derivatives(one, other))
        found = block_gaps(seen.one, seen.other, Likeness(allowed))
        only = OF_OTHER_KINDS.get(forms[0])
        gaps = tuple(only(found, views.one.size) if only else found)
    answer = find_sameness(one, other, views, allowed)
    same = answer.sameness
    if same is not None and same.is_plain and not same.step_only:
        # what enclosures left open, where the methods are known to agree
        gaps = tuple(x for x in gaps if not all(y.is_open for y in x.gaps))
    first, second = analyse_any(one, limit), analyse_any(other, limit)
    met = None
    if same is None and views.one.size == views.other.size:
        known_as = [meant(x.tableau, x.tolerance) for x in (first, second)]
        met = conditions_met(known_as[0], known_as[1], (first.order.order, second.order.order))
    different = []
    tolerances = first.tolerance, second.tolerance
    for key in KEYS:
        pair = PropertyPair(
            key, first.subject.verdict(key), second.subject.verdict(key), tolerances
        )
        if _differ(pair):
            different.append(pair)
    if isinstance(first, Analysis) and isinstance(second, Analysis):
        orders = _orders(first, second)
        if first.symplectic != second.symplectic:
            verdicts = Verdict(first.symplectic), Verdict(second.symplectic)
            different.append(PropertyPair("symplectic", *verdicts, tolerances))
    else:
        orders = tuple(
            OrderPair(name, *(_viewed(x, claim) for x in (first, second)))
            for claim, name in VIEWED.items()
        )
    return Comparison(
        one=one,
        other=other,
        forms=forms,
        gaps=gaps,
        sameness=same,
        obstacle=answer.obstacle,
        allowed=allowed,
        orders=orders,
        met=met,
        properties=tuple(different),
    )


def _linear(method: GarkMethod) -> tuple[bool, ...]:
    return tuple(colour.is_linear for colour in method.tableau.colours)


def _orders(first: Analysis, second: Analysis) -> tuple[OrderPair, ...]:
    return (
        OrderPair("order", first.order, second.order),
        OrderPair(WITH_TIME, first.nonautonomous_order, second.nonautonomous_order),
        OrderPair("order of the embedded weights", _of_embedded(first), _of_embedded(second)),
        OrderPair("order of the conjugate", first.conjugate_order, second.conjugate_order),
        OrderPair("order of the symplectic pair", first.pair_order, second.pair_order),
    )


VIEWED = {
    "order": "order",
    "w-order": "order with any matrix",
    "old-jacobian-order": "order with an old Jacobian",
    "position-order": "order of q",
    "velocity-order": "order of q′",
    "slow-order": "order of the slow method",
    "nonautonomous-order": WITH_TIME,
    "index-1-order": "order on index-1 DAEs",
    "embedded-order": "order of the embedded weights",
}
"""The orders of methods that are not GARK methods, by the keys of their claims."""


def _viewed(analysis: AnyAnalysis, claim: str) -> AnyOrder | None:
    assert not isinstance(analysis, Analysis)
    view = analysis.view(claim)
    return None if view is None else view[0]


def _of_rosenbrock(gaps: Iterable[BlockGap], colours: int) -> Iterator[BlockGap]:
    """Yields the gaps in α, β = α + γ, b, c and c + d; each occurs twice in the tableau."""
    for gap in gaps:
        if gap.seen is not None:
            if gap.seen < colours:
                kind = "alpha" if gap.colour < colours else "beta"
                yield replace(gap, kind=kind)
        elif gap.colour < colours:
            yield gap
        elif gap.kind == "c":
            yield replace(gap, kind="c + d")


def _of_slow_parts(gaps: Iterable[BlockGap]) -> Iterator[BlockGap]:
    """Yields the gaps outside the fast part, which is that of the exact solution."""
    return (gap for gap in gaps if gap.colour and gap.seen != 0)


_IN_POSITIONS = {"A": "Abar", "b": "bbar", "embedded": "embedded bbar"}


def _of_nystrom(gaps: Iterable[BlockGap]) -> Iterator[BlockGap]:
    """Yields the gaps in Ā, A, c, b̄ and b; the matrices and nodes occur twice in the tableau."""
    for gap in gaps:
        if gap.seen is not None:
            if gap.colour == POSITIONS and gap.seen != START:
                is_bar = gap.seen == POSITIONS
                yield replace(gap, kind="Abar") if is_bar else gap
        elif gap.colour == POSITIONS:
            yield replace(gap, kind=_IN_POSITIONS.get(gap.kind, gap.kind))
        elif gap.kind != "c":
            yield gap


def _of_arguments(gaps: Iterable[BlockGap]) -> Iterator[BlockGap]:
    """Yields the gaps in the first argument; those in the second are the same."""
    return (gap for gap in gaps if gap.colour == 0 or gap.kind == "c")


def _of_derivatives(*methods: GarkMethod) -> Iterator[GarkMethod]:
    """Yields the methods with one colour for each derivative, and equally many derivatives."""
    made = [Derivatives.of(x.tableau) for x in methods]
    count = max(len(x.A) for x in made)
    for method, found in zip(methods, made, strict=True):
        arrays = found.arrays(count)
        colours = tuple(replace(x.colours[0], space=k) for k, x in enumerate(arrays))
        blocks = {(k, k): x.blocks[0, 0] for k, x in enumerate(arrays)}
        tableau = Tableau(tuple(x.spaces[0] for x in arrays), colours, blocks)
        embedded = method.embedded and embedded_of(method.embedded, method.tableau)
        if embedded is not None:
            zeros = (ZERO,) * len(embedded[0])
            embedded += (zeros,) * (count - len(embedded))
        yield GarkMethod(tableau=tableau, tolerance=method.tolerance, embedded=embedded)


_Only: TypeAlias = Callable[[Iterable[BlockGap], int], Iterable[BlockGap]]
OF_OTHER_KINDS: dict[str, _Only] = {
    "row": lambda gaps, size: _of_rosenbrock(gaps, size // 2),
    "rkn": lambda gaps, _: _of_nystrom(gaps),
    "nprk": lambda gaps, _: _of_arguments(gaps),
    "mdrk": lambda gaps, _: gaps,
    "mri": lambda gaps, _: _of_slow_parts(gaps),
}
"""For each other kind of methods, the function that selects their gaps."""


def form_of(tableau: Tableau) -> str:
    """Returns the kind: ``rk``, ``ark``, ``gark``, ``prk``, ``pair`` (other partitioned), ``row``
    (Rosenbrock), ``rkn`` (Nyström), ``nprk`` (nonlinearly partitioned), ``mdrk`` (with
    derivatives), ``mri`` (multirate, with an exact fast part).
    """
    if is_rosenbrock(tableau):
        return "row"
    if is_nystrom(tableau):
        return "rkn"
    if is_nprk(tableau):
        return "nprk"
    if is_derivatives(tableau):
        return "mdrk"
    if tableau.exact_to is not None:
        return "mri"
    if [colour.part for colour in tableau.colours] == ["q", "p"]:
        return "prk"
    if tableau.is_partitioned:
        return "pair"
    if tableau.size == 1:
        return "rk"
    return "ark" if len(tableau.spaces) == 1 else "gark"


def _of_embedded(analysis: Analysis) -> AnyOrder | None:
    return None if analysis.embedded is None else analysis.embedded.order


def _differ(pair: PropertyPair) -> bool:
    one, other = pair.one.value, pair.other.value
    if any(pair.tolerances) and isinstance(one, Size) and isinstance(other, Size):
        return not isclose(float(one), float(other), rel_tol=1e-12)
    return _text(pair.one) != _text(pair.other)


def _text(verdict: Verdict) -> tuple[str, bool, bool]:
    return str(verdict.value), verdict.is_undecided, verdict.is_at_least
