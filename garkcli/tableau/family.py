"""Families of methods: tableaus whose entries are rational functions of parameters."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain
from typing import Any, Self, cast

from flint import fmpq, fmpq_mpoly

from garkcli.errors import LimitExceeded
from garkcli.exact.domain import Domain
from garkcli.exact.field import Number, with_radicals
from garkcli.exact.nodes import Root
from garkcli.exact.parametric import Parameters, Parametric, Rule
from garkcli.exact.rewriting import format_expression
from garkcli.exact.roots import RealRoot
from garkcli.frozen import Frozen, replace
from garkcli.tableau.embedded import NOTHING, Further, with_weights
from garkcli.tableau.forms import on_linear_problems
from garkcli.tableau.pointwise import at_points, nodes_in_radicals
from garkcli.tableau.tableau import Tableau


class Radical(Frozen):
    """A root among the coefficients, as an unknown: a zero of ``relation``. It is the nonnegative
    zero if ``is_even`` (the root is), and ``meant`` if several are real.
    """

    name: str
    relation: fmpq_mpoly
    is_even: bool = False
    meant: RealRoot | None = None
    text: str = ""
    latex: str = ""

    @classmethod
    def of(cls, name: str, number: RealRoot) -> Self:
        x = Parameters([name]).context.gen(0)
        powers = enumerate(number.polynomial.coeffs())
        return cls(name, sum((x**k * fmpq(a) for k, a in powers), x * 0), meant=number)


def reducing(names: Sequence[str], radicals: Iterable[Radical]) -> Parameters:
    """The ring of unknowns in which powers of roots are reduced."""
    ring = Parameters(names)
    rules = []
    for radical in radicals:
        relation = radical.relation.project_to_context(ring.context)
        place = ring.names.index(radical.name)
        degree = int(relation.degrees()[place])
        power = ring.context.gen(place) ** degree
        leading = relation[power.monoms()[0]]
        rest = power - relation / leading if leading else power
        if rest.degrees()[place] < degree:
            rules.append(Rule(place, degree, rest))
    ring.rules = tuple(rules)
    return ring


OSCILLATING = ("p-stable", "i-stable")


class RequiredStability(Frozen):
    """A required kind of stability, of all colours or of the diagonal method of one, from 0. With
    ``is_embedded`` the embedded weights take the place of b.
    """

    kind: str
    colour: int | None = None
    is_embedded: bool = False

    def __str__(self) -> str:
        name = self.kind[0].upper() + self.kind[1:]
        name += " with the embedded weights" * self.is_embedded
        return name if self.colour is None else f"{name} in colour {self.colour + 1}"

    def in_words(self, tableau: Tableau) -> str:
        """Returns the text, with its vector fields if there are several colours."""
        if on_linear_problems(tableau).size == 1 or self.kind in OSCILLATING:
            return str(self)
        fields = "all colours with one λ" if self.colour is None else "the others with λ = 0"
        return f"{self} ({fields})"


class Family(Frozen, kw_only=True):
    """A family of methods.

    Attributes:
        name: its name for people.
        tableau: its entries are rational numbers and ``Parametric`` ones.
        ring: the parameters, after them unknowns for radicals.
        parameters: the names of the free parameters.
        ranges: for each the least and the greatest value, None if unbounded.
        radicals: the roots among the coefficients.
        relations: polynomials that vanish at every solution.
        nonzero: polynomials that vanish at no solution.
        positive: polynomials that are positive at accepted solutions.
        not_negative: polynomials that are at least 0 there.
        order: the required order, if the file has one.
        stable: the required kinds of stability.
        claims_of_wanted: claims that follow from the requirements, with their values.
        unsettled: the keys of requirements that were not worked out in time.
        real: the keys of requirements whose ``relations`` hold for real values only.
        further: its embedded weights and its dense output.
        impossible: requirements that no value meets, with the reason.
        levels: the required levels, such as -ssp, each with the least value.
        embedded_order: the required order of the embedded weights, if the file has one.
        dense_order: the required order of the dense output, if the file has one.
    """

    name: str
    tableau: Tableau
    ring: Parameters
    parameters: tuple[str, ...]
    ranges: Mapping[str, tuple[fmpq | None, fmpq | None]]
    radicals: tuple[Radical, ...]
    relations: tuple[fmpq_mpoly, ...] = ()
    nonzero: tuple[fmpq_mpoly, ...] = ()
    positive: tuple[fmpq_mpoly, ...] = ()
    not_negative: tuple[fmpq_mpoly, ...] = ()
    order: int | None = None
    stable: tuple[RequiredStability, ...] = ()
    claims_of_wanted: tuple[tuple[str, str], ...] = ()
    unsettled: tuple[str, ...] = ()
    real: tuple[str, ...] = ()
    further: Further = NOTHING
    impossible: tuple[str, ...] = ()
    levels: tuple[tuple[str, fmpq], ...] = ()
    embedded_order: int | None = None
    dense_order: int | None = None

    @property
    def on_linear_problems(self) -> Self:
        return replace(self, tableau=on_linear_problems(self.tableau))

    def tested(self, wanted: RequiredStability) -> Self:
        """The family of the methods that a required stability is about, on linear problems."""
        embedded = self.further.embedded
        if not wanted.is_embedded or embedded is None:
            return self.on_linear_problems
        return replace(self, tableau=with_weights(self.tableau, embedded)).on_linear_problems

    def __repr__(self) -> str:
        return f"<Family {self.name}: {', '.join(self.parameters)}>"


NAME = "_node"


def ring_of(tableau: Tableau) -> Parameters:
    numbers: Iterable[object] = chain.from_iterable(tableau.rows)
    return next(x.ring for x in numbers if isinstance(x, Parametric))


def family_in_points(tableau: Tableau, ring: Parameters) -> Tableau | None:
    """Returns the family on point stages; None if the nodes have no simple radicals. ``ring`` is
    that of the parameters, without roots.
    """
    nodes = nodes_in_radicals(tableau)
    if not nodes:
        return None if nodes is None else tableau
    try:
        domain = Domain(list(chain.from_iterable(nodes.values())))
    except LimitExceeded:
        return None
    roots = [] if domain.field is None else domain.field.radicals
    if domain.field is not None and domain.field.degree != 2 ** len(roots):
        return None  # one root is a product of others
    names = [f"{NAME}{k}" for k in range(1, len(roots) + 1)]
    larger = Parameters([*ring.names, *names])
    rules = []
    for k, (name, (root, _)) in enumerate(zip(names, roots, strict=True)):
        radicand = Domain([]).evaluate(cast("Root", root).radicand)
        rules.append(Rule(len(ring.names) + k, 2, larger.constant(cast("fmpq", radicand))))
        larger.shown[name] = format_expression(root), format_expression(root, latex=True)
    larger.rules = tuple(rules)
    radicals = [larger.parameter(name) for name in names]

    def function(x: object) -> Any:
        if not isinstance(x, Parametric):
            return x
        parts = (p.project_to_context(larger.context) for p in (x.numerator, x.denominator))
        return Parametric(larger, *parts)

    def number(x: Number) -> Any:
        return with_radicals(x, radicals)

    return at_points(tableau, nodes, domain, function, number)
