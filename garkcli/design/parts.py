"""A solution set in parts, each with rational coordinates as far as possible.

An unknown that is in an equation with degree one, A v + B = 0, is −B/A where A is not zero; where
it is, the equations A = B = 0 make another part. Products are taken apart in the same way. So each
solution is in one part, and no part is lost.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import nullcontext
from typing import Any, TypeAlias, cast

from flint import fmpq, fmpq_mpoly, fmpq_poly

from garkcli.deadline import check_time, only_small
from garkcli.design.ideal import Ideal, rational
from garkcli.design.member import value_of
from garkcli.design.solutions import Solution, solutions
from garkcli.errors import NotDecided, TooManyTerms
from garkcli.exact.cells import Interval, Point, ends_of, has, sign_of, where
from garkcli.exact.field import Algebraic, Number, NumberField
from garkcli.exact.parametric import Mixed, Parameters, Parametric, factors, fraction, unknowns_of
from garkcli.exact.polynomial import Polynomial, in_one
from garkcli.exact.roots import RealRoot, real_roots
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.kind import ONE_BRANCH
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Tableau


class Changes(Frozen):
    """Unknowns that are replaced by others, in the same places of ``ring``. ``instead`` has
    replaced old ones, by their places, in the new ones; ``nodes`` are those that are nodes.
    """

    old: Parameters
    ring: Parameters
    instead: Mapping[int, fmpq_mpoly]
    nodes: tuple[str, ...] = ()

    def polynomial(self, p: fmpq_mpoly) -> fmpq_mpoly:
        if not self.instead:
            return p
        context = self.ring.context
        images = [self.instead.get(i, context.gen(i)) for i in range(len(self.ring.names))]
        return p.compose(*images, ctx=context)

    def values(self) -> dict[str, Mixed]:
        values: dict[str, Mixed] = {}
        one = self.ring.constant(fmpq(1))
        for i, name in enumerate(self.old.names):
            polynomial = self.instead.get(i, self.ring.context.gen(i))
            values[name] = self.ring.quotient(polynomial, one)
        return values


def nodes_as_coordinates(tableau: Tableau, ring: Parameters) -> Changes:
    nodes = dict(_nodes(tableau))
    names = list(ring.names)
    instead: dict[int, fmpq_mpoly] = {}
    chosen: dict[int, fmpq_mpoly] = {}
    for name, node in nodes.items():
        others = [x for key, x in nodes.items() if key != name]
        for i in unknowns_of(node):
            is_alone = not any(x.degrees()[i] for x in others)
            if is_alone and name not in names:
                names[i] = name
                chosen[i] = node
                break
    new = Parameters(names)
    for i, node in chosen.items():
        moved = new.context.from_dict(dict(node.to_dict()))
        slope = moved.derivative(i).leading_coefficient()
        here = new.context.gen(i)
        # node = slope x + rest; the place of x now holds the node itself
        instead[i] = here / slope - (moved - here * slope) / slope
    single = (str(x) for colour in _evaluated(tableau) for x in colour.c)
    known = (*(names[i] for i in chosen), *(x for x in single if x in ring.names))
    return Changes(ring, new if instead else ring, instead, tuple(dict.fromkeys(known)))


def _nodes(tableau: Tableau) -> Iterator[tuple[str, fmpq_mpoly]]:
    for l, colour in enumerate(_evaluated(tableau), start=1):
        if not isinstance(tableau.spaces[colour.space], PointSpace):
            continue
        for i, node in enumerate(colour.c, start=1):
            x = cast("Mixed", node)
            if not isinstance(x, Parametric) or not x.denominator.is_one():
                continue
            if x.numerator.total_degree() == 1 and len(unknowns_of(x.numerator)) > 1:
                name = f"c{i}" if tableau.size == 1 else f"c{l}_{i}"
                yield name, x.numerator


def _evaluated(tableau: Tableau) -> list[Colour]:
    return [colour for colour in tableau.colours if colour.kind != ONE_BRANCH]


Values: TypeAlias = dict[str, Mixed]


class Part(Frozen):
    """Solutions with common coordinates: polynomials ``nonzero`` in these vanish nowhere. ``ideal``
    has the equations for the coordinates, trivial if they are free; some of its zeros may be zeros
    of ``nonzero``. ``sets`` restrict ``values`` to sets of numbers, by name.
    """

    ring: Parameters
    values: Mapping[str, Mixed]
    nonzero: tuple[fmpq_mpoly, ...]
    ideal: Ideal
    sets: tuple[tuple[str, tuple[Interval, ...]], ...] = ()

    @property
    def is_free(self) -> bool:
        """Whether all values of the coordinates are solutions, except zeros of ``nonzero``."""
        return self.ideal.is_trivial

    @property
    def dimension(self) -> int:
        return self.ideal.dimension

    @property
    def equations(self) -> list[fmpq_mpoly]:
        return [rational(p, self.ring) for p in self.ideal.basis]

    def expressed(self, polynomial: fmpq_mpoly, ring: Parameters) -> Mixed:
        values = cast("Mapping[str, Number]", self.values)
        return cast("Mixed", value_of(polynomial, ring, values))

    def at(self, coordinates: Mapping[str, Any]) -> dict[str, Any]:
        """Every unknown at values of the coordinates: numbers, or functions of others."""
        values: dict[str, Any] = {}
        for name, x in self.values.items():
            over, under = fraction(x, self.ring)
            numerator = value_of(over, self.ring, coordinates)
            values[name] = numerator / value_of(under, self.ring, coordinates)
        return values

    def extended(self, solution: Solution) -> Solution:
        return replace(solution, values=self.at(solution.values))


def at_root(name: str, root: RealRoot) -> Solution:
    """A real number as the value of an unknown, in the field that it generates."""
    monic = Polynomial.from_flint(root.polynomial).monic()
    modulus = monic.to_flint()
    value: Number
    if root.exact is not None:
        number_field, value = None, root.exact
    else:
        number_field = NumberField(modulus, ())
        value = number_field.from_coordinates([fmpq(0), fmpq(1)])
    roots = tuple(x for x, _ in real_roots(monic))
    return Solution(modulus, number_field, {name: value}, 1, roots)


MOST_POINTS = 60
"""Most points of a part of dimension 0, with complex ones: most of the degree of a field."""


def points_of(part: Part) -> Iterator[Solution]:
    """The solutions of a part of dimension 0; NotDecided beyond ``MOST_POINTS``."""
    if not part.ring.names:
        yield Solution(fmpq_poly([0, 1]), None, {}, 1, (RealRoot.rational(fmpq(0)),))
        return
    if part.ideal.degree > MOST_POINTS:
        raise NotDecided
    for solution in solutions(part.ideal):
        if all(value_of(p, part.ring, solution.values) for p in part.nonzero):
            yield solution


def what_is_asked(part: Part, name: str) -> fmpq_mpoly | None:
    place = part.ring.names.index(name)
    for p in part.equations:
        degrees = p.degrees()
        if degrees[place] and sum(degrees) == degrees[place]:
            return p.project_to_context(Parameters([name]).context)
    return None


def values_on(
    part: Part, name: str, not_negative: Sequence[Polynomial] = ()
) -> tuple[Interval, ...] | None:
    """The values of a free coordinate that sets of a part and signs allow; None for all."""
    sets = [x for key, x in part.sets if key == name]
    if not sets and not not_negative:
        return None

    def is_allowed(t: Point) -> bool:
        return all(has(x, t) for x in sets) and all(sign_of(p, t) >= 0 for p in not_negative)

    return where(is_allowed, [*not_negative, *(p for x in sets for p in ends_of(x))])


class RationalChart(Frozen):
    """Points of a part with the values ``one`` of coordinates that are not free, at a real root."""

    one: Solution
    index: int
    names: tuple[str, ...]

    @property
    def root(self) -> RealRoot:
        return self.one.real[self.index]

    def point(self, part: Part, free: Sequence[fmpq]) -> Solution | None:
        """Every unknown at one of the points; None if there is no method."""
        values = {**self.one.values, **dict(zip(self.names, free, strict=True))}
        if not all(value_of(p, part.ring, values) for p in part.nonzero):
            return None
        return part.extended(replace(self.one, values=values))

    def images(self, part: Part, ring: Parameters) -> list[fmpq_mpoly]:
        """The coordinates of a part in a ring of the free ones and, last, the root."""
        gens = dict(zip(ring.names, ring.context.gens(), strict=True))
        root = ring.context.gens()[-1]
        for name, value in self.one.values.items():
            powers = value.poly.coeffs() if isinstance(value, Algebraic) else [value]
            gens[name] = sum((root**k * a for k, a in enumerate(powers)), root * 0)
        return [gens[name] for name in part.ring.names]


def charts(part: Part) -> list[RationalChart]:
    """Charts for all real points of a part with finitely many values; none for other parts."""
    names, equations = part.ring.names, part.equations
    if part.is_free:
        origin = RealRoot.rational(fmpq(0))
        return [RationalChart(Solution(fmpq_poly([0, 1]), None, {}, 1, (origin,)), 0, tuple(names))]
    places = {i for p in equations for i in unknowns_of(p)}
    others = tuple(x for i, x in enumerate(names) if i not in places)
    if len(places) == 1 and len(equations) == 1:
        [place] = places
        roots = [root for root, _ in real_roots(in_one(equations[0], place))]
        return [RationalChart(at_root(names[place], x), x.number, others) for x in roots]
    ring = Parameters([names[i] for i in sorted(places)])
    ideal = Ideal(ring).with_zeros([p.project_to_context(ring.context) for p in equations])
    if ideal.dimension or ideal.degree > MOST_POINTS:
        return []
    return [
        RationalChart(solution, k, others)
        for solution in solutions(ideal)
        for k in range(len(solution.real))
    ]


def diagonal_unknowns(tableau: Tableau, ring: Parameters) -> list[str]:
    unknowns: dict[str, None] = {}
    for block in tableau.blocks.values():
        for i, row in enumerate(block):
            entry = str(row[i]) if i < len(row) else ""
            if entry in ring.names:
                unknowns[entry] = None
    return list(unknowns)


LARGE = 50
"""Bases with more terms are replaced by generators of the ideal if these are shorter."""
SHORT = 12


def parts_of(
    ideal: Ideal,
    changes: Changes | None = None,
    kept: Sequence[str] = (),
    generators: Callable[[], Iterable[fmpq_mpoly]] | None = None,
) -> Iterator[Part]:
    """The zeros of an ideal in parts; NotDecided if a Gröbner basis takes too long. ``kept``
    unknowns are preferred as coordinates. ``generators`` of the ideal are without UNIT: in order
    conditions weights and many entries are linear, in a large basis they are not.
    """
    changed = changes or Changes(ideal.ring, ideal.ring, {})
    splitting = _Splitting(changed.ring, tuple(kept))
    nonzero = factors(map(changed.polynomial, ideal.nonzero))
    equations = ideal.cleared
    if generators is not None and not kept and sum(map(len, equations)) > LARGE:
        shorter = list(generators())
        if 2 * sum(map(len, shorter)) < sum(map(len, equations)):
            equations = [*shorter, *(p for p in equations if len(p) <= SHORT)]
            splitting = replace(splitting, kept=changed.nodes, is_large=True)
    polynomials = [changed.polynomial(p) for p in equations]
    yield from splitting.parts(polynomials, nonzero, changed.values(), changed.ring.names)


def parts_within(part: Part, zeros: Iterable[fmpq_mpoly]) -> Iterator[Part]:
    for smaller in _Splitting(part.ring).all_parts([*part.equations, *zeros], part.nonzero):
        yield replace(smaller, values=part.at(smaller.values), sets=part.sets)


MOST_STEPS = 400


class Pieces(Frozen):
    """The zeros of ``equations`` in parts, without an ideal; ``nonzero`` vanish nowhere. Linear
    equations are solved first, and zeros of divisors are further parts. ``kept`` unknowns are
    preferred as coordinates.
    """

    equations: tuple[fmpq_mpoly, ...]
    nonzero: tuple[fmpq_mpoly, ...]
    changes: Changes
    kept: tuple[str, ...]
    parts: tuple[Part, ...]

    @classmethod
    def of(
        cls,
        equations: Iterable[fmpq_mpoly],
        nonzero: Iterable[fmpq_mpoly],
        changes: Changes,
        kept: Sequence[str] = (),
    ) -> Pieces:
        """The zeros in pieces; NotDecided after too many steps, or if a Gröbner basis is large."""
        monic = (p / p.leading_coefficient() for p in equations if p)
        equations, nonzero = tuple({str(p): p for p in monic}.values()), tuple(nonzero)
        kept = (*(kept or changes.nodes),)
        splitting = _Splitting(changes.ring, kept, is_large=True, steps=iter(range(MOST_STEPS)))
        zeros = [changes.polynomial(p) for p in equations]
        allowed = factors(map(changes.polynomial, nonzero))
        with only_small():
            parts = splitting.parts(zeros, allowed, changes.values(), changes.ring.names)
            try:
                return cls(equations, nonzero, changes, kept, tuple(parts))
            except TooManyTerms as error:
                raise NotDecided from error

    def with_zeros(self, polynomials: Iterable[fmpq_mpoly]) -> Pieces:
        return Pieces.of([*self.equations, *polynomials], self.nonzero, self.changes, self.kept)

    def ideal(self, start: Ideal) -> Ideal:
        """The ideal of the equations, if their zeros are finitely many and simple, or NotDecided.
        ``start`` is the ideal of ``nonzero``, in the unknowns of the equations.
        """
        ring = start.ring
        if self.changes.instead:
            return Pieces.of(
                self.equations, self.nonzero, Changes(ring, ring, {}), self.kept
            ).ideal(start)
        if len(self.parts) != 1:
            raise NotDecided
        [part] = self.parts
        zeros = [p.project_to_context(ring.context) for p in part.equations]
        for name, x in part.values.items():
            over, under = (p.project_to_context(ring.context) for p in fraction(x, part.ring))
            zeros.append(ring.context.gen(ring.names.index(name)) * under - over)
        with only_small():
            ideal = start.with_zeros(zeros)
            size = range(len(ring.names))
            slopes = [[p.derivative(i) for i in size] for p in self.equations]
            for solution in solutions(ideal):
                rows = [[value_of(p, ring, solution.values) for p in row] for row in slopes]
                if rank(rows) < len(size):
                    raise NotDecided
        return ideal.square_free

    @property
    def dimension(self) -> int:
        return max((part.dimension for part in self.parts), default=-1)

    @property
    def is_everything(self) -> bool:
        return not self.parts

    @property
    def is_proved(self) -> bool:
        # no part is lost
        return True


def rank(matrix: Iterable[Sequence[Number]]) -> int:
    """The rank of a matrix of numbers of one field.

    >>> rank([[fmpq(1), fmpq(2)], [fmpq(2), fmpq(4)]])
    1
    """
    echelon: list[tuple[int, list[Number]]] = []
    for row in matrix:
        check_time()
        rest = list(row)
        for place, known in echelon:
            factor = rest[place]
            if factor:
                rest = [x - factor * y for x, y in zip(rest, known, strict=True)]
        place = next((k for k, x in enumerate(rest) if x), -1)
        if place >= 0:
            leading = rest[place]
            echelon.append((place, [x / leading for x in rest]))
    return len(echelon)


class _Linear(Frozen):
    whole: fmpq_mpoly
    name: str
    A: fmpq_mpoly
    B: fmpq_mpoly
    cost: tuple[bool, bool, int, int, int]


class _Splitting(Frozen):
    """Takes solution sets apart; polynomials are in the ring of all unknowns.

    ``kept`` ones are preferred as coordinates. ``is_large``: as long as some unknown is linear,
    only small Gröbner bases are made. With a limit of ``steps`` the ideals of parts exclude the
    zeros of ``nonzero``.
    """

    ring: Parameters
    kept: tuple[str, ...] = ()
    is_large: bool = False
    steps: Iterator[int] | None = None

    def all_parts(
        self, polynomials: Sequence[fmpq_mpoly], nonzero: Sequence[fmpq_mpoly]
    ) -> Iterator[Part]:
        names = self.ring.names
        unknowns: Values = {}
        for name in names:
            unknowns[name] = cast("Mixed", self.ring.parameter(name))
        yield from self.parts(polynomials, nonzero, unknowns, names)

    def parts(
        self,
        polynomials: Sequence[fmpq_mpoly],
        nonzero: Sequence[fmpq_mpoly],
        values: Values,
        left: Sequence[str],
    ) -> Iterator[Part]:
        """The common zeros of polynomials at which irreducible ones vanish nowhere, in parts.
        ``values`` has all unknowns as functions of those in ``left``, not yet eliminated.
        """
        check_time()
        if self.steps is not None and next(self.steps, None) is None:
            raise NotDecided
        polynomials = [self._without(p, nonzero) for p in polynomials]
        if self.is_large:
            if any(p.is_constant() for p in polynomials):
                return
            linear = self._linear(polynomials, nonzero, left)
            if linear is not None and not linear.cost[1] and len(linear.A) == 1:
                yield from self._substituted(linear, polynomials, nonzero, values, left)
                return
        basis = self._basis(polynomials)
        if any(p.is_constant() for p in basis):
            return
        zeros = []
        for p in basis:
            found = [x for x in factors([p]) if x not in nonzero]
            if len(found) != 1:
                others = [x for x in basis if x is not p]
                yield from self._factored(found, others, nonzero, values, left)
                return
            zeros += found
        if any(p.total_degree() > q.total_degree() for p, q in zip(basis, zeros, strict=True)):
            yield from self.parts(zeros, nonzero, values, left)
            return
        linear = self._linear(zeros, nonzero, left)
        if linear is None and self.is_large:
            yield from replace(self, is_large=False).parts(zeros, nonzero, values, left)
            return
        if linear is None:
            part = self._part(zeros, nonzero, values, left)
            if self.steps is not None and not part.is_free:
                saturated = Ideal(part.ring, part.nonzero).with_zeros(part.equations).closure
                part = replace(part, ideal=saturated)
            if not part.ideal.is_everything:
                yield part
            return
        if linear.cost[1]:
            others = [x for x in zeros if x is not linear.whole]
            yield from self.parts([*others, linear.A, linear.B], nonzero, values, left)
            nonzero = [*nonzero, *factors([linear.A])]
        yield from self._substituted(linear, zeros, nonzero, values, left)

    def _basis(self, polynomials: Sequence[fmpq_mpoly]) -> Sequence[fmpq_mpoly]:
        try:
            with only_small() if self.is_large else nullcontext():
                ideal = Ideal(self.ring).with_zeros(polynomials)
        except NotDecided:
            check_time()
            return polynomials
        return [rational(p, self.ring) for p in ideal.basis]

    def _without(self, p: fmpq_mpoly, nonzero: Sequence[fmpq_mpoly]) -> fmpq_mpoly:
        product = self.ring.constant(fmpq(1))
        for factor in factors([p]):
            if factor not in nonzero:
                product *= factor
        return product if p else p

    def _factored(
        self,
        alternatives: Sequence[fmpq_mpoly],
        polynomials: Sequence[fmpq_mpoly],
        nonzero: Sequence[fmpq_mpoly],
        values: Values,
        left: Sequence[str],
    ) -> Iterator[Part]:
        for k, factor in enumerate(alternatives):
            others = [*nonzero, *alternatives[:k]]
            yield from self.parts([*polynomials, factor], others, values, left)

    def _linear(
        self, zeros: Sequence[fmpq_mpoly], nonzero: Sequence[fmpq_mpoly], left: Sequence[str]
    ) -> _Linear | None:
        candidates = []
        for p in zeros:
            degrees = p.degrees()
            for index in range(len(self.ring.names)):
                if degrees[index] != 1:
                    continue
                A = p.derivative(index)
                v = self.ring.context.gen(index)
                is_new = any(x not in nonzero for x in factors([A]))
                degree = int(p.total_degree())
                name = self.ring.names[index]
                is_kept = name in self.kept and len(unknowns_of(p)) > 1
                ease = (len(A), degree, -index)
                if self.is_large:
                    # branches with few unknowns first: each of them is another system
                    ease = (
                        (len(unknowns_of(A)), len(unknowns_of(p)), len(A))
                        if is_new
                        else (0, 0, len(A))
                    )
                cost = (is_kept, is_new, *ease)
                candidates.append(_Linear(p, name, A, p - A * v, cost))
        return min([x for x in candidates if x.name in left], key=lambda x: x.cost, default=None)

    def _substituted(
        self,
        linear: _Linear,
        zeros: Sequence[fmpq_mpoly],
        nonzero: Sequence[fmpq_mpoly],
        values: Values,
        left: Sequence[str],
    ) -> Iterator[Part]:
        ring = self.ring
        instead: Values = {}
        for name in ring.names:
            instead[name] = cast("Mixed", ring.parameter(name))
        instead[linear.name] = ring.quotient(-linear.B, linear.A)

        def at(x: Mixed) -> Mixed:
            numerator, denominator = fraction(x, ring)
            known = cast("Mapping[str, Number]", instead)
            over = value_of(numerator, ring, known)
            return cast("Mixed", over / value_of(denominator, ring, known))

        place = ring.names.index(linear.name)

        def numerator_at(p: fmpq_mpoly) -> fmpq_mpoly:
            """Σ p_k (−B)^k A^(d−k) for p = Σ p_k v^k of degree d in v; it vanishes with p."""
            degree = p.degrees()[place]
            total = p * 0
            for k in range(degree + 1):
                of_power = {e: a for e, a in p.to_dict().items() if e[place] == k}
                lowered = {(*e[:place], 0, *e[place + 1 :]): a for e, a in of_power.items()}
                power = (-linear.B) ** k * linear.A ** (degree - k)
                total += ring.context.from_dict(lowered) * power
            return total

        smaller = [p for p in map(numerator_at, zeros) if p]
        others = [numerator_at(p) for p in nonzero]
        if not all(others):
            return
        expressed = {name: at(x) for name, x in values.items()}
        names = [name for name in left if name != linear.name]
        yield from self.parts(smaller, factors(others), expressed, names)

    def _part(
        self,
        zeros: Sequence[fmpq_mpoly],
        nonzero: Sequence[fmpq_mpoly],
        values: Values,
        left: Sequence[str],
    ) -> Part:
        ring = Parameters(left)

        def moved(p: fmpq_mpoly) -> fmpq_mpoly:
            return p.project_to_context(ring.context)

        def moved_value(x: Mixed) -> Mixed:
            if not isinstance(x, Parametric):
                return x
            return ring.quotient(moved(x.numerator), moved(x.denominator))

        return Part(
            ring,
            {name: moved_value(x) for name, x in values.items()},
            tuple(moved(p) for p in nonzero),
            Ideal(ring).with_zeros([moved(p) for p in zeros]),
        )
