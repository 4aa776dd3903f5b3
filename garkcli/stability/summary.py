"""All results on the stability of one method; those beyond the time limit are undecided."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from flint import fmpq

from garkcli.deadline import SECONDS, spending
from garkcli.doing import doing
from garkcli.errors import NotDecided
from garkcli.exact.cells import Interval
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.polynomial import Polynomial
from garkcli.frozen import Frozen, replace
from garkcli.order.meant import AnyTableau, meant, printed
from garkcli.stability import linear as linear_problems
from garkcli.stability.algebraic import AlgebraicStability, algebraic_stability, algebraic_within
from garkcli.stability.damping import ImexPair, Ray, explicit_colour, imex_pair
from garkcli.stability.fraction import Fraction, lines_needed, stability_fraction
from garkcli.stability.linear import e_polynomial
from garkcli.stability.oscillator import OscillatorStability, usual_oscillator
from garkcli.stability.sector import Sector, largest_sector
from garkcli.stability.ssp import AdditiveRadius, SspCoefficient, additive_radius, ssp_coefficient
from garkcli.stability.within import StabilityWithin, stability_within, stiff_stability_within
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

if TYPE_CHECKING:
    from garkcli.order.rounded import RoundedTableau


class Colours(Frozen):
    """The joint stability of several colours; ``late`` attributes exceeded the time limit.

    Attributes:
        R: R(z_1, …, z_N); None if too large, or late.
        lines: the number of lines that determine it.
        radii: points on the boundary of the region of absolute monotonicity; empty if late or
            linear.
        pair: as an implicit-explicit one; None if it is none, or R is late.
        explicit_alone: R of the explicit colour, or of the first one without a pair.
        real: the z_E ≤ 0 with every z_I damped; None without a pair, or undecided.
        imaginary: the z_E on the imaginary axis with every z_I damped.
    """

    names: tuple[str, ...]
    R: Fraction | None
    lines: int
    radii: tuple[AdditiveRadius, ...]
    pair: ImexPair | None
    explicit_alone: linear_problems.StabilityFunction
    real: Ray | None
    imaginary: Ray | None
    late: frozenset[str] = frozenset()

    @property
    def size(self) -> int:
        return len(self.names)


def several_colours(tableau: Tableau, ratios: Sequence[fmpq] = ()) -> Colours:
    """Returns the joint stability; ``ratios`` are further r_2/r_1 for the additive radius."""
    late: set[str] = set()
    size = tableau.size
    single = [linear_problems.stability_function(tableau, _unit(size, l)) for l in range(size)]
    directions: list[list[Number]] = [_unit(size, l) for l in range(size)]
    directions.append([ONE] * size)
    directions += [[ONE, ratio] for ratio in ratios]
    radii = _in_time(late, "radii", lambda: [additive_radius(tableau, x) for x in directions])
    R = _in_time(late, "R", lambda: stability_fraction(tableau))
    pair = imex_pair(tableau, R)
    real = imaginary = None
    if pair is not None:
        real = _in_time(late, "real", pair.real_ray)
        imaginary = _in_time(late, "imaginary", pair.imaginary_ray)
    return Colours(
        names=tuple(colour.name for colour in tableau.colours),
        R=R,
        lines=lines_needed(tableau),
        radii=tuple(radii or ()),
        pair=pair,
        explicit_alone=single[0 if pair is None else pair.explicit],
        real=real,
        imaginary=imaginary,
        late=frozenset(late),
    )


def _in_time(late: set[str], name: str, work: Callable[[], Any]) -> Any:
    """The result of ``work``; None, with its name added to ``late``, if the time is over."""
    try:
        return work()
    except NotDecided:
        late.add(name)
        return None


def _unit(size: int, l: int) -> list[Number]:
    return [ONE if m == l else ZERO for m in range(size)]


def _word(word: str, is_so: bool | None) -> str:
    if is_so is None:
        return f"{word} not decided"
    return word if is_so else f"not {word}"


class AtPoint(Frozen):
    """The value of R at a point; None at a pole."""

    z: linear_problems.Complex
    value: linear_problems.Complex | None

    @property
    def squared(self) -> Number | None:
        if self.value is None:
            return None
        real, imaginary = self.value
        return real * real + imaginary * imaginary


class LinearStability(Frozen):
    """The results from a stability function R(z); None if rounding or time leaves one open.

    Attributes:
        name: the driven colours: ``all``, one with the others at 0, or ``embedded`` weights of all.
        R: the stability function.
        e_polynomial: |Q(iy)|² − |P(iy)|² as a polynomial in y².
        a_stable: |R(z)| ≤ 1 in the left half plane.
        l_stable: a_stable with R(∞) = 0.
        sector: the sector of A(α)-stability; None if undecided.
        real: the x ≥ 0 with |R(−x)| ≤ 1.
        imaginary: the x = y² ≥ 0 with |R(iy)| ≤ 1.
        within: the results for rounded coefficients; None for exact ones.
        ssp: the SSP coefficient, the other vector fields being 0; None if undecided.
        late: the attributes that exceeded the time limit.
        is_linear_alone: whether R is for linear problems only, without SSP coefficient.
        points: R at given points.

    >>> from garkcli import find_stability
    >>> whole, *alone = find_stability("ars-222").linear
    >>> [(x.name, x.words) for x in alone]
    [('1', 'not A-stable'), ('2', 'A-stable, L-stable')]
    """

    name: str
    R: linear_problems.StabilityFunction
    e_polynomial: Polynomial
    a_stable: bool | None
    l_stable: bool | None
    sector: Sector | None
    real: tuple[Interval, ...] | None
    imaginary: tuple[Interval, ...] | None
    ssp: SspCoefficient | None
    within: StabilityWithin | None = None
    late: frozenset[str] = frozenset()
    is_linear_alone: bool = False
    points: tuple[AtPoint, ...] = ()

    def at(self, points: Sequence[linear_problems.Complex]) -> LinearStability:
        return replace(self, points=tuple(AtPoint(z, self.R.at(z)) for z in points))

    @property
    def words(self) -> str:
        """The stability in a few words."""
        words = _word("A-stable", self.a_stable)
        return f"{words}, {_word('L-stable', self.l_stable)}" if self.a_stable else words

    def __repr__(self) -> str:
        return f"<LinearStability {self.name}: {self.words}>"


class Stability(Shown, Frozen):
    """The stability of one method.

    Attributes:
        tableau: the method.
        linear: R for all colours together, then for each alone; empty if colours drive positions or
            momenta only, or are not coupled.
        oscillator: the method on the harmonic oscillator; None if it has no split.
        algebraic: algebraic stability; None if it is not defined.
        tolerance: the rounding within which it holds; None for exact methods.
        colours: each with a z of its own; None for one colour or rounded ones.
        algebraic_within: algebraic stability of the method that a rounded one means, or None.
        late: the attributes that exceeded the time limit; they are None.
        is_linear_alone: whether it is about linear problems only.
        embedded: R̂ for all colours together; None without embedded weights or ``linear``.

    >>> from garkcli import find_stability
    >>> find_stability("radau-iia-2")
    <Stability A-stable, L-stable>
    >>> find_stability("rk4").linear[0].real[0].end
    <RealRoot 2.78529356341, a root of x^3 - 4*x^2 + 12*x - 24>
    """

    tableau: Tableau
    linear: tuple[LinearStability, ...]
    oscillator: OscillatorStability | None
    algebraic: AlgebraicStability | None
    tolerance: fmpq | None = None
    colours: Colours | None = None
    algebraic_within: bool | None = None
    late: frozenset[str] = frozenset()
    is_linear_alone: bool = False
    embedded: LinearStability | None = None

    def at(self, points: Sequence[linear_problems.Complex]) -> Stability:
        linear = tuple(x.at(points) for x in self.linear)
        return replace(self, linear=linear, embedded=self.embedded and self.embedded.at(points))

    @property
    def of_linear_problems(self) -> Stability:
        linear = tuple(replace(x, ssp=None, is_linear_alone=True) for x in self.linear)
        colours = self.colours
        if colours is not None:
            colours = replace(colours, radii=(), late=colours.late - {"radii"})
        return replace(
            self,
            linear=linear,
            algebraic=None,
            algebraic_within=None,
            colours=colours,
            is_linear_alone=True,
        )

    def __repr__(self) -> str:
        if not self.linear:
            return f"<Stability of {self.tableau!r} on the oscillator>"
        explicit = explicit_colour(self.tableau)
        if explicit is not None:
            return f"<Stability of the implicit part: {self.linear[2 - explicit].words}>"
        return f"<Stability {self.linear[0].words}>"


@doing("stability")
def stability(
    tableau: Tableau,
    ratios: Sequence[fmpq] = (),
    seconds: float | None = SECONDS,
    embedded: Tableau | None = None,
) -> Stability:
    """Returns all results for an exact method; raises NotDecided if R itself is late.

    ``ratios`` are r_2/r_1 of further additive SSP radii. After ``seconds`` of processor time the
    rest stays undecided. ``embedded`` is the method with its embedded weights as b.
    """
    late: set[str] = set()
    with spending(seconds):
        linear = [linear_stability(tableau, *direction) for direction in directions(tableau)]
        algebraic = _in_time(late, "algebraic", lambda: algebraic_stability(tableau))
        oscillator = _in_time(late, "oscillator", lambda: usual_oscillator(tableau))
        colours = None
        if linear and tableau.size > 1:
            colours = several_colours(tableau, ratios)
        of_embedded = None
        if linear and embedded is not None:
            of_embedded = _in_time(late, "embedded", lambda: _embedded(embedded))
        linear = [_with_sector(x) for x in linear]
    return Stability(
        tableau=tableau,
        linear=tuple(linear),
        oscillator=oscillator,
        algebraic=algebraic,
        colours=colours,
        late=frozenset(late),
        embedded=of_embedded,
    )


def _embedded(tableau: Tableau) -> LinearStability:
    shares: list[Number] = [ONE] * tableau.size
    return _with_sector(linear_stability(tableau, "embedded", shares, is_linear_alone=True))


@doing("stability")
def stability_of_rounded(
    tableau: Tableau, tolerance: fmpq, embedded: AnyTableau | None = None
) -> Stability:
    """Returns the stability of the method that a rounded one means, as far as decided."""
    method = meant(tableau, tolerance)
    assert not isinstance(method, Tableau)
    linear = tuple(_of_rounded(method, *x) for x in directions(tableau))
    of_embedded = None
    if linear and embedded is not None:
        if isinstance(embedded, Tableau):
            of_embedded = _embedded(embedded)
        else:
            found = _of_rounded(embedded, "embedded", [ONE] * tableau.size)
            of_embedded = replace(found, is_linear_alone=True)
    return Stability(
        tableau,
        linear,
        None,
        None,
        tolerance,
        algebraic_within=algebraic_within(method.near, method.grain),
        embedded=of_embedded,
    )


def _of_rounded(method: RoundedTableau, name: str, shares: Sequence[Number]) -> LinearStability:
    decided = stability_within(method.near, shares, method.grain)
    if not (decided.a_stable and decided.l_stable):
        decided = _unless_another(decided, method, shares)
    R = linear_problems.stability_function(printed(method), shares)
    return LinearStability(
        name=name,
        R=R,
        e_polynomial=e_polynomial(R),
        a_stable=decided.a_stable,
        l_stable=decided.l_stable,
        sector=None,
        real=None,
        imaginary=None,
        ssp=None,
        within=decided,
    )


def _unless_another(
    found: StabilityWithin, method: RoundedTableau, shares: Sequence[Number]
) -> StabilityWithin:
    widest = method.widest
    if widest is None:
        return replace(found, a_stable=found.a_stable or None, l_stable=found.l_stable or None)
    a_stable, l_stable = stiff_stability_within(method.tableau, shares, widest)
    return replace(
        found,
        a_stable=None if a_stable is not False and not found.a_stable else found.a_stable,
        l_stable=None if l_stable is not False and not found.l_stable else found.l_stable,
    )


def directions(tableau: Tableau) -> list[tuple[str, list[Number]]]:
    size = tableau.size
    if tableau.is_partitioned or len(list(tableau.edges())) < size**2:
        return []
    single = [(x.name, _unit(size, l)) for l, x in enumerate(tableau.colours)]
    return [("all", [ONE] * size), *(single if size > 1 else [])]


def linear_stability(
    tableau: Tableau, name: str, shares: Sequence[Number], is_linear_alone: bool = False
) -> LinearStability:
    """Linear stability in one direction of (λ_1, …, λ_N), without the sector."""
    R = linear_problems.stability_function(tableau, shares)
    late: set[str] = set()
    a_stable = _in_time(late, "a_stable", lambda: linear_problems.is_a_stable(R))
    l_stable = R.at_infinity() == 0 and a_stable
    return LinearStability(
        name=name,
        R=R,
        e_polynomial=e_polynomial(R),
        a_stable=a_stable,
        l_stable=l_stable,
        sector=None,
        real=_in_time(late, "real", lambda: linear_problems.real_set(R)),
        imaginary=_in_time(late, "imaginary", lambda: linear_problems.imaginary_set(R)),
        ssp=None
        if is_linear_alone
        else _in_time(late, "ssp", lambda: ssp_coefficient(tableau, shares)),
        late=frozenset(late),
        is_linear_alone=is_linear_alone,
    )


def _with_sector(x: LinearStability) -> LinearStability:
    late = set(x.late)
    sector = _in_time(late, "sector", lambda: largest_sector(x.R))
    return replace(x, sector=sector, late=frozenset(late))
