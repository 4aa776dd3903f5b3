"""``gark stability``: the findings, declared once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import product
from math import isqrt
from typing import TYPE_CHECKING, Any, NamedTuple, Never, TypeAlias, TypeVar

from flint import arb, ctx, fmpq

from garkcli.exact import polynomial_text as polynomials
from garkcli.exact.display import BITS_OF_A_DIGIT, plain_decimal, to_ball, to_text
from garkcli.exact.field import ZERO, Number
from garkcli.exact.multivariate import Multivariate
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, sign
from garkcli.frozen import Frozen
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ALGEBRAIC, ROOT_OF, multivariate_latex, polynomial_latex, root_data
from garkcli.plots.regions import stability_scene
from garkcli.reason import NO_REASON, Formula, Reason
from garkcli.stability.ball_polynomials import OPEN, Bounds
from garkcli.stability.damping import ImexPair, Ray, explicit_colour
from garkcli.stability.fraction import MOST_LINES, Fraction
from garkcli.stability.linear import poles_are_right
from garkcli.stability.summary import AtPoint, Colours, LinearStability, Stability
from garkcli.stability.two_frequencies import SlowInterval, TwoFrequencies
from garkcli.tableau.garkmethod import Derivation, derived_name
from garkcli.tell import facts, kinds
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.latex import expression_latex
from garkcli.tell.parts import part, parts, plot, told
from garkcli.tell.report import Report

if TYPE_CHECKING:
    from garkcli.exact.cells import Interval
    from garkcli.stability.oscillator import OscillatorStability
    from garkcli.stability.springs_plane import SpringsPlane
    from garkcli.stability.ssp import AdditiveRadius, SspCoefficient

T = TypeVar("T")
HEADLINE, USUAL, DETAIL, DATA = facts.Level
Extent: TypeAlias = "Sequence[Interval] | Bounds"
Form: TypeAlias = "tuple[Polynomial, Polynomial, Polynomial]"


class StabilityReport(Frozen):
    """``springs`` is for one slow frequency, ``slow`` for an interval; ``plane`` is a picture."""

    file: str
    name: str
    found: Stability
    springs: TwoFrequencies | None = None
    digits: int = 12
    plane: SpringsPlane | None = None
    slow: SlowInterval | None = None
    derivation: Derivation = ""
    is_order_star: bool = False


def _decimals(value: Callable[[int], arb], digits: int) -> str:
    bits, before = int(digits * BITS_OF_A_DIGIT) + 64, ctx.prec
    try:
        ctx.prec = bits
        return polynomials.ball_decimal(value(bits), digits)
    finally:
        ctx.prec = before


def _degrees(cosine: RealRoot, digits: int) -> str:
    return _decimals(lambda bits: cosine.ball(bits).acos() * 180 / arb.pi(), digits)


def _square_root(root: RealRoot, digits: int) -> str:
    return _decimals(lambda bits: root.ball(bits).sqrt(), digits)


def _around_zero(
    bounds: str, nowhere: str, everywhere: str, end: Callable[[RealRoot, Plain], str]
) -> facts.Wording[Extent]:
    """The interval that begins at 0: of −z on the real axis, of y² on the imaginary one."""

    def words(found: Extent, d: Plain) -> str:
        if isinstance(found, Bounds):
            if found.low is None:
                return d.prose(everywhere)
            return nowhere if found.high == 0 else d.bounds(found, d.prose(bounds))
        first = found[0] if found else None
        if first is None or first.is_point or first.start is None or first.start.exact != 0:
            return nowhere
        if first.end is None:
            return d.prose(everywhere)
        return end(first.end, d) + (" and further intervals" if len(found) > 1 else "")

    return words


def _height(end: RealRoot, d: Plain) -> str:
    return d.prose(f"|y| ≤ {_square_root(end, d.digits)}, y² ≤ ") + d.root(end)


def _end_data(found: Extent, d: Plain) -> dict[str, object]:
    """The end of the first interval: in −z on the real axis, in y² on the imaginary one."""
    if isinstance(found, Bounds):
        return kinds.BOUNDS.data(found, d)
    if not found:
        return {"to": "0"}
    return {"to": None if found[0].end is None else root_data(found[0].end, d.digits)}


_END = kinds.record(to=S.nullable(ALGEBRAIC))
REAL: facts.Kind[Extent] = facts.Kind(
    facts.Json(S.one_of(_END, kinds.BOUNDS.schema), _end_data),
    facts.Words(_around_zero("−z ≤ ", "z = 0 only", "z ≤ 0", lambda end, d: d.upto("−z", end))),
)
IMAGINARY: facts.Kind[Extent] = facts.Kind(
    REAL.what, facts.Words(_around_zero("y² ≤ ", "y = 0 only", "all y", _height))
)


def _ssp_data(x: SspCoefficient | Bounds, d: Plain) -> object:
    return kinds.BOUNDS.data(x, d) if isinstance(x, Bounds) else kinds.radius_data(x, d)


def _ssp_words(x: SspCoefficient | Bounds, d: Plain) -> str:
    return d.bounds(x) if isinstance(x, Bounds) else kinds.RADIUS.words(x, d)


SSP = facts.Kind(
    facts.Json(S.one_of(S.TEXT, ROOT_OF, kinds.BOUNDS.schema), _ssp_data), facts.Words(_ssp_words)
)
SECTOR: facts.Kind[RealRoot] = facts.Kind(
    facts.Json(
        kinds.record(degrees=S.TEXT, cosine=ALGEBRAIC),
        lambda x, d: {"degrees": _degrees(x, d.digits), "cosine": root_data(x, d.digits)},
    ),
    facts.Words(lambda x, d: d.prose(f"α = {_degrees(x, d.digits)}°, cos α = ") + d.root(x)),
)


def integral_parts(R: Fraction) -> tuple[Multivariate, Multivariate]:
    """Numerator and denominator, with whole coefficients if these are rational."""
    P, Q = R.numerator, R.denominator
    scale = polynomials.integral_scale([coefficient for _, coefficient in (*P.terms, *Q.terms)])
    constant_term = Multivariate.of(P.variables, {(0,) * P.variables: scale})
    return P * constant_term, Q * constant_term


def _fraction_data(R: Fraction, _: Plain) -> dict[str, object]:
    over, under = (
        polynomials.multivariate_text(p, [f"z{k + 1}" for k in range(p.variables)])
        for p in integral_parts(R)
    )
    return {"numerator": over, "denominator": under, "lowest_terms": R.is_reduced}


FRACTION: facts.Kind[Fraction] = facts.Kind(
    facts.Json(
        kinds.record(numerator=S.TEXT, denominator=S.TEXT, lowest_terms=S.FLAG), _fraction_data
    ),
    facts.Words(
        lambda R, d: (
            d.fraction(*integral_parts(R))
            + ("" if R.is_reduced else "; perhaps not in lowest terms")
        )
    ),
)


def _conserved_words(form: Form, d: Plain) -> str:
    terms = []
    for p, name in zip(polynomials.integral(form), ("(ωq)²", "ωq p", "p²"), strict=True):
        factor = d.polynomial(p, "z")
        if len(p.coefficients) > 1:
            terms.append(f"({factor}) {d.prose(name)}")
        elif p:
            terms.append(d.prose(name) if factor.strip("$") == "1" else f"{factor} {d.prose(name)}")
    return " + ".join(terms)


CONSERVED: facts.Kind[Form] = facts.Kind(
    facts.Json(
        kinds.record(qq=S.TEXT, qp=S.TEXT, pp=S.TEXT),
        lambda form, _: dict(
            zip(
                ("qq", "qp", "pp"),
                (polynomials.polynomial_text(p, "z") for p in polynomials.integral(form)),
                strict=True,
            )
        ),
    ),
    facts.Words(_conserved_words),
)
FROM_TO: facts.Kind[SlowInterval] = facts.Kind(
    facts.Json(
        kinds.record(**{"from": S.EXACT, "to": S.EXACT}),
        lambda x, _: {"from": str(x.low), "to": str(x.high)},
    ),
    facts.Words(lambda x, _: f"every a = (hω_slow)² from {x.low} to {x.high}"),
)
SQUARE: facts.Kind[fmpq] = facts.Kind(
    facts.Json(S.EXACT, lambda x, _: str(x)),
    facts.Words(lambda x, d: f"a = (hω_slow)² = {d.number(x)}"),
)


ROUNDED = Reason("coefficients are rounded")
LATE = Reason("it takes longer than --seconds")


def _open(x: Stability | LinearStability | Colours, name: str) -> facts.Answer[Never] | None:
    """An open answer if the time was over; else None."""
    return facts.Answer(None, Status(open=LATE)) if name in x.late else None


def a_stable(x: LinearStability) -> facts.Answer[bool]:
    """Whether |R| ≤ 1 in the left half plane, or why not."""
    if x.a_stable is not False or x.within is not None:
        return _open(x, "a_stable") or kinds.truth(x.a_stable, open_because=ROUNDED)
    if x.R.at_infinity() is None:
        return kinds.truth(False, "R is unbounded")
    if not poles_are_right(x.R.denominator):
        return kinds.truth(False, "a pole is not in the right half plane")
    E = kinds.polynomial("x")(x.e_polynomial)
    return kinds.truth(False, Reason("|R(iy)| > 1 where E(y²) < 0, E = {}", E))


def sector(x: LinearStability) -> RealRoot | facts.Answer[RealRoot] | None:
    if x.within is not None:
        return None
    if x.sector is None:
        return _open(x, "sector") or facts.Answer(None, Status(open=Reason("too many stages")))
    return x.sector.cosine or facts.Answer(None, reason=Reason("no"))


def _less_than_all(answer: facts.Answer[RealRoot]) -> facts.Level:
    """Usual unless A-stability implies the sector."""
    if answer.value is None:
        return USUAL if answer.status.open else DETAIL
    return USUAL if answer.value.exact != 0 else DETAIL


PRINTED = Reason("of the digits as printed, not of all methods within the tolerance")


def limit(x: LinearStability) -> facts.Answer[Number]:
    found = x.R.at_infinity()
    if found is None:
        return facts.Answer(None, reason=Reason("unbounded"))
    if x.within is not None:
        return facts.Answer(found, reason=PRINTED, level=DETAIL)
    return facts.Answer(found)


def real(x: LinearStability) -> Extent | facts.Answer[Extent] | None:
    return _open(x, "real") or (x.real if x.within is None else x.within.real)


def imaginary(x: LinearStability) -> Extent | facts.Answer[Extent] | None:
    return _open(x, "imaginary") or (x.imaginary if x.within is None else x.within.imaginary)


def ssp(x: LinearStability) -> SspCoefficient | Bounds | facts.Answer[Never] | None:
    if x.is_linear_alone:
        return None
    found = x.ssp if x.within is None else x.within.ssp
    without_nodes = Reason("the nodes have no simple radicals")
    return found or _open(x, "ssp") or facts.Answer(None, Status(open=without_nodes))


def _complex_words(d: Plain, real: str, imaginary: str) -> str:
    text = real
    if imaginary != "0":
        minus, size = "-" * imaginary.startswith("-"), imaginary.removeprefix("-")
        unit = "i" if size == "1" else f"{size}i"
        text = f"{minus}{unit}" if real == "0" else f"{real} {minus or '+'} {unit}"
    return d.formula(text, text)


def _points_words(points: Sequence[AtPoint], d: Plain) -> str:
    """R and |R| at each point, compared with 1."""
    said = []
    for x in points:
        z = f"z = {_complex_words(d, *map(to_text, x.z))}"
        if x.value is None or x.squared is None:
            said.append(f"{z}: a pole")
            continue
        value = _complex_words(d, *(_decimals_of(y, d.digits) for y in x.value))
        size = _modulus(x.squared, d.digits)
        than = {-1: "less than 1", 0: "exactly", 1: "more than 1"}[sign(x.squared - 1)]
        said.append(f"{z}: {value}, {d.formula(rf'|R| = {size}', f'|R| = {size}')}, {than}")
    return "; ".join(said)


def _decimals_of(x: Number, digits: int) -> str:
    return polynomials.ball_decimal(to_ball(x, digits + 4), digits)


def _modulus(squared: Number, digits: int) -> str:
    return _decimals(lambda _: to_ball(squared, digits + 24).sqrt(), digits)


SIZE: facts.Kind[Number] = facts.Kind(facts.Json(S.TEXT, lambda x, d: _modulus(x, d.digits)))
DECIMALS: facts.Kind[Sequence[Number]] = facts.Kind(
    facts.Json(S.array(S.TEXT), lambda x, d: [_decimals_of(y, d.digits) for y in x]),
    facts.Words(lambda x, d: ", ".join(_decimals_of(y, d.digits) for y in x)),
)
POINT: facts.Section[AtPoint] = facts.Section(
    facts.Row("z", kinds.EXACTS, lambda x: x.z),
    facts.maybe("value", kinds.EXACTS, lambda x: x.value),
    facts.maybe("decimals", DECIMALS, lambda x: x.value),
    facts.maybe("squared", kinds.EXACT, lambda x: x.squared),
    facts.maybe("size", SIZE, lambda x: x.squared),
    facts.maybe(
        "bounded", kinds.TRUTH, lambda x: None if x.squared is None else sign(x.squared - 1) <= 0
    ),
)
LINEAR: facts.Rows[LinearStability] = [
    facts.Row(
        "R",
        kinds.ratio("z"),
        lambda x: facts.Answer(
            x.R, reason=PRINTED if x.within else NO_REASON, level=DETAIL if x.within else USUAL
        ),
    ),
    facts.maybe("R_infinity", kinds.EXACT, limit),
    facts.maybe("a_stable", kinds.TRUTH, a_stable, HEADLINE),
    facts.maybe(
        "l_stable",
        kinds.TRUTH,
        lambda x: kinds.truth(x.l_stable, open_because=LATE if x.late else ROUNDED),
        lambda a: HEADLINE if a.value else DETAIL,
    ),
    facts.maybe("A_alpha", SECTOR, sector, _less_than_all),
    facts.maybe("real_interval", REAL, real),
    facts.maybe("imaginary_interval", IMAGINARY, imaginary),
    facts.maybe("ssp", SSP, ssp),
    facts.Row(
        "points",
        parts(POINT, _points_words),
        lambda x: facts.Answer(x.points, reason=PRINTED if x.within and x.points else NO_REASON),
        label="at points",
    ),
]
OF_COLOUR: facts.Section[LinearStability] = facts.Section(
    facts.Row("name", kinds.TEXT, lambda x: x.name, DATA),
    LINEAR,
    title=lambda x, d: f"colour {d.prose(x.name)} alone",
)


OF_ALL: facts.Section[LinearStability] = facts.Section(
    LINEAR, title=lambda _, d: d.prose("one λ for both parts")
)
_OTHERWISE: dict[str, dict[str, Any]] = {
    "R": {"label": "R̂(z)"},
    "R_infinity": {"label": "R̂(∞)"},
    "real_interval": {"level": DETAIL},
    "imaginary_interval": {"level": DETAIL},
}
OF_EMBEDDED: facts.Section[LinearStability] = facts.Section(
    [row.but(**_OTHERWISE.get(row.key, {})) for row in LINEAR if row.key != "ssp"],
    title=lambda _, d: d.prose("embedded weights"),
)
EMBEDDED: facts.Row[StabilityReport] = facts.maybe(
    "embedded", part(OF_EMBEDDED), lambda x: _open(x.found, "embedded") or x.found.embedded
)


def conserved(o: OscillatorStability) -> facts.Answer[Form]:
    if not o.determinant.is_one:
        return facts.Answer(None, reason=Reason("none: the determinant is not 1"))
    if o.conserved is None:
        return facts.Answer(
            None, reason=Reason("every one: the step is a multiple of the identity")
        )
    return facts.Answer(o.conserved)


def p_stable(o: OscillatorStability) -> facts.Answer[bool]:
    """Neither growth nor decay on the oscillator for any step size, and where that ends."""
    if o.is_i_stable and not o.is_p_stable:
        return kinds.truth(False, "solutions decay")
    return i_stable(o)


def i_stable(o: OscillatorStability) -> facts.Answer[bool]:
    """Stability for every step size on the oscillator, and where it ends."""
    if o.is_i_stable:
        return kinds.truth(True)
    first = o.stable[0] if o.stable else None
    if first is None or not first.has_start or first.is_point or first.end is None:
        return kinds.truth(False, "unstable for small step sizes")
    where = "beyond" if first.has_end else "at"
    return kinds.truth(False, Reason(f"not stable {where} x = {{}}", ROOT_ALONE(first.end)))


ROOT_ALONE: facts.Kind[RealRoot] = told(lambda x, d: d.root(x))


def phase(o: OscillatorStability) -> facts.Answer[int]:
    if o.phase.order is None:
        return facts.Answer(None, reason=Reason("none: the frequency is exact"))
    if o.phase.constant is None:
        return facts.Answer(
            o.phase.order, reason=Reason("the frequency is wrong for small step sizes")
        )
    where = "behind" if sign(o.phase.constant) > 0 else "ahead"
    lag, z = kinds.term("z", o.phase.order + 1), Formula("z = hω", r"z = h\omega")
    reason = Reason(f"{{}}, {{}}: {where}", lag(o.phase.constant), z)
    return facts.Answer(o.phase.order, reason=reason)


PHASE: facts.Kind[int] = facts.Kind(facts.Json(S.COUNT), facts.Words(lambda n, _: f"of order {n}"))


def stable_in(latex: str, text: str) -> facts.Kind[Sequence[Interval]]:
    """Stable intervals of x, with the root of each end in the sign of ``text``."""

    def zone(x: Interval, d: Plain) -> str:
        if x.is_point or x.end is None:
            return d.interval(x, "x")
        end = _square_root(x.end, d.digits)
        return f"{d.interval(x, 'x')}, {d.formula(latex, text)} to {end}"

    return facts.Kind(
        facts.Several(kinds.INTERVAL),
        facts.Words(lambda xs, d: " or ".join(zone(x, d) for x in xs) if xs else "for no x"),
    )


STABLE = stable_in(r"h\omega", "hω")
STABLE_FAST = stable_in(r"h\omega_{\mathrm{fast}}", "hω_fast")


def discriminant(o: OscillatorStability) -> facts.Answer[Polynomial]:
    """4D² − N², with its meaning."""
    meaning = "tr M = N/D for a step M"
    if o.determinant.is_one:
        meaning += ", which is stable where this is positive"
    return facts.Answer(o.discriminant, reason=Reason(meaning))


OF_WAVES = "oscillator stable, x = (hω)²"
OSCILLATOR: facts.Rows[OscillatorStability] = [
    facts.Row("trace", kinds.ratio("x"), lambda x: x.trace, DETAIL),
    facts.Row("determinant", kinds.ratio("x"), lambda x: x.determinant, DETAIL),
    facts.Row("discriminant", kinds.polynomial("x"), discriminant, DETAIL),
    facts.Row("stable", STABLE, lambda x: x.stable, label=OF_WAVES),
    facts.maybe("p_stable", kinds.TRUTH, p_stable),
    facts.maybe("i_stable", kinds.TRUTH, i_stable),
    facts.maybe("phase_order", PHASE, phase),
    facts.maybe("phase_constant", kinds.EXACT, lambda x: x.phase.constant, DATA),
    facts.maybe("conserved", CONSERVED, conserved, DETAIL),
]


def algebraic(x: StabilityReport) -> facts.Answer[bool]:
    found = x.found
    if found.algebraic is None:
        late = _open(found, "algebraic")
        if late is not None:
            return late
        if found.is_linear_alone:
            return facts.Answer(None, reason=Reason("not applicable: not a Runge-Kutta method"))
        if found.tolerance is None:
            return facts.Answer(None, reason=Reason("not applicable: the parts are not coupled"))
        return kinds.truth(found.algebraic_within, open_because=ROUNDED)
    why = [] if found.algebraic.weights_are_positive else ["a weight is negative"]
    if not found.algebraic.form_is_positive:
        why.append("B A + Aᵀ B − b bᵀ is not positive semidefinite")
    return kinds.truth(found.algebraic.holds, ", ".join(why))


def title(x: StabilityReport, d: Plain) -> str:
    within = x.found.tolerance
    given = x.file or x.name
    name = d.prose(derived_name(x.derivation, given) if x.derivation else given)
    return name if within is None else d.known(name, Status(within))


def head(kind: str) -> facts.Rows[StabilityReport]:
    return [
        *kinds.FILE_AND_NAME,
        facts.Row("derivation", kinds.DERIVATION, lambda x: x.derivation, DATA),
        facts.Row("kind", kinds.constant(kind), lambda _: kind, DATA),
        facts.maybe("tolerance", kinds.TOLERANCE, lambda x: x.found.tolerance, DATA),
    ]


RADII: facts.Section[AdditiveRadius] = facts.Section(
    facts.Row("direction", kinds.EXACTS, lambda x: x.ratios),
    facts.maybe("radius", kinds.RADIUS, lambda x: x.radius),
)


def _radii_words(found: Sequence[AdditiveRadius], d: Plain) -> str:
    """The reach of the region of absolute monotonicity in each direction."""
    texts = []
    for r in found:
        if r.radius is None:
            return "not decided: the nodes have no simple radicals"
        direction = ", ".join("0" if q == 0 else "r" if q == 1 else f"{q} r" for q in r.ratios)
        direction = d.formula(f"({direction})", f"({direction})")
        texts.append(f"{direction}, {d.prose('r ≤')} {kinds.RADIUS.words(r.radius, d)}")
    return "; ".join(texts)


def _ray(sign: str) -> facts.Kind[Ray]:
    def words(ray: Ray, d: Plain) -> str:
        if ray.end is None:
            return "no limit"
        return "none" if ray.end.exact == 0 else d.upto(sign, ray.end)

    return facts.Kind(
        facts.Json(
            _END, lambda x, d: {"to": None if x.end is None else root_data(x.end, d.digits)}
        ),
        facts.Words(words),
    )


class Imex(NamedTuple):
    colours: Colours
    pair: ImexPair


def imex(x: StabilityReport) -> Imex | None:
    colours = x.found.colours
    return Imex(colours, colours.pair) if colours is not None and colours.pair else None


IMEX: facts.Section[Imex] = facts.Section(
    facts.Row("explicit", kinds.TEXT, lambda x: x.colours.names[x.pair.explicit], DATA),
    facts.Row("implicit", kinds.TEXT, lambda x: x.colours.names[x.pair.implicit], DATA),
    facts.maybe("real_interval", _ray("−z"), lambda x: _open(x.colours, "real") or x.colours.real),
    facts.maybe(
        "imaginary_interval",
        _ray("|z|"),
        lambda x: _open(x.colours, "imaginary") or x.colours.imaginary,
    ),
    title=lambda x, d: d.prose(
        f"implicit-explicit pair, z{x.pair.explicit + 1} with |R| ≤ 1 for every"
        f" z{x.pair.implicit + 1} with Re ≤ 0"
    ),
)


PLOT: facts.Row[StabilityReport] = plot(
    lambda x: stability_scene([(x.name, x.found)], x.is_order_star, x.plane),
    lambda x: bool(x.found.linear or x.found.oscillator or x.plane),
)


def fraction(x: Colours) -> Fraction | facts.Answer[Fraction]:
    too_large = Reason(f"too large: {x.lines} lines determine it (limit {MOST_LINES})")
    return x.R or _open(x, "R") or facts.Answer(None, reason=too_large)


OF_COLOURS: facts.Rows[Colours] = (
    facts.maybe("R", FRACTION, fraction, label="R(z1, z2, …)"),
    facts.maybe("ssp_radii", parts(RADII, _radii_words), lambda x: _open(x, "radii") or x.radii),
)


class ImexParts(NamedTuple):
    explicit: LinearStability
    implicit: LinearStability


def imex_parts(x: StabilityReport) -> ImexParts | None:
    """Returns the parts of an implicit-explicit method; None for other methods."""
    explicit = explicit_colour(x.found.tableau) if x.found.linear else None
    if explicit is None:
        return None
    alone = x.found.linear[1:]
    return ImexParts(alone[explicit], alone[1 - explicit])


PLACES = 3
"""Decimals in the first line."""


def _cut(end: RealRoot | fmpq, power: int) -> str:
    """The root of an end in few decimals, cut off: up to there the method is stable."""
    value = end if isinstance(end, fmpq) else end.exact
    scale = 10 ** (PLACES * power)
    whole = None if value is None else (value * scale).floor()
    bits = 64
    while whole is None:  # the end is irrational
        assert isinstance(end, RealRoot)
        bits *= 2
        with ctx.workprec(bits):
            whole = (end.ball(bits) * scale).floor().unique_fmpz()
    return plain_decimal(fmpq(isqrt(int(whole)) if power == 2 else whole, 10**PLACES))


def _end_of(found: Extent | Ray) -> RealRoot | fmpq | None:
    if isinstance(found, Bounds):
        return found.low
    if isinstance(found, Ray):
        return found.end
    first = found[0] if found else None
    if first is None or first.is_point or first.start is None or first.start.exact != 0:
        return ZERO
    return first.end


def _interval(axis: str, found: Extent | Ray | None, d: Plain, power: int = 1) -> str:
    """Writes an interval, with the square of its end for ``power`` 2."""
    if found is None or found == OPEN:
        return d.prose(f"{axis} interval not decided")
    end = _end_of(found)
    if end is None:
        return d.prose(f"all of the {axis} axis")
    size = _cut(end, power)
    if size == "0":
        return d.prose(f"no {axis} interval")
    interval = f"[-{size}, 0]" if axis == "real" else f"[-{size}i, {size}i]"
    return d.prose(f"{axis} interval ") + d.formula(interval, interval.replace("-", "−"))


def _explicit_words(x: LinearStability, d: Plain) -> str:
    of = x.within or x
    return f"{_interval('real', of.real, d)}, {_interval('imaginary', of.imaginary, d, 2)}"


def _coupled_words(x: Imex, d: Plain) -> str:
    real, imaginary = x.colours.real, x.colours.imaginary
    return f"{_interval('real', real, d)}, {_interval('imaginary', imaginary, d)}"


def _after_colon(words: facts.Wording[T]) -> facts.Kind[T]:
    return told(words, lambda name, x, _, d: f"{name}: {words(x, d)}")


def _implicit_words(x: LinearStability, d: Plain) -> str:
    if x.l_stable:
        return "L-stable"
    cosine = None if x.sector is None else x.sector.cosine
    if x.a_stable is False and cosine is not None:
        return d.prose(f"A(α)-stable, α = {_degrees(cosine, 4)}°")
    return d.prose(x.words)


def _line(section: facts.Section[T]) -> facts.Kind[T]:
    return facts.Kind(None, part(section).shown)


def coupled(x: StabilityReport) -> Imex | facts.Answer[Never]:
    """The implicit-explicit pair, or why its interval is not known."""
    if x.found.colours is None:
        return facts.Answer(None, Status(open=ROUNDED))
    found = imex(x)
    if found is not None:
        return found
    R = fraction(x.found.colours)
    assert isinstance(R, facts.Answer)
    return facts.Answer(None, Status(open=R.status.open or R.reason))


def _colours(x: StabilityReport) -> Colours | None:
    return x.found.colours


ALIKE: facts.Rows[StabilityReport] = facts.via(lambda x: x.found.linear[0], LINEAR)
ALONE: facts.Row[StabilityReport] = facts.Row(
    "colours", parts(OF_COLOUR), lambda x: x.found.linear[1:], DETAIL
)
SEVERAL: facts.Rows[StabilityReport] = [
    *facts.via(_colours, OF_COLOURS[:1]),
    *(row for row in ALIKE if row.key != "R"),
    ALONE,
    facts.Row("R_alike", kinds.ratio("z"), lambda x: x.found.linear[0].R, DETAIL),
    *facts.via(_colours, OF_COLOURS[1:]),
    facts.maybe("pair", part(IMEX), imex),
]


def _of_linear(*keys: str) -> facts.Section[LinearStability]:
    rows = {row.key: row for row in LINEAR}
    return facts.Section([rows[key] for key in keys])


EXPLICIT = _of_linear("real_interval", "imaginary_interval", "ssp")
IMPLICIT = _of_linear("R_infinity", "A_alpha", "ssp")
OF_BOTH: facts.Rows[ImexParts] = [
    facts.Row("implicit_part", told(_implicit_words), lambda x: x.implicit, HEADLINE),
    facts.Row("explicit_part", _after_colon(_explicit_words), lambda x: x.explicit, HEADLINE),
    facts.Row(
        "of_implicit", _line(IMPLICIT), lambda x: x.implicit, label="implicit part", is_short=True
    ),
    facts.Row(
        "of_explicit", _line(EXPLICIT), lambda x: x.explicit, label="explicit part", is_short=True
    ),
]
PARTS: facts.Rows[StabilityReport] = [
    *facts.via(imex_parts, OF_BOTH),
    facts.Row("coupled", _after_colon(_coupled_words), coupled, HEADLINE),
]
ONE_LAMBDA: facts.Row[StabilityReport] = facts.Row(
    "one_lambda", _line(OF_ALL), lambda x: x.found.linear[0], DETAIL, label="one λ"
)


def _by_parts(rows: facts.Rows[StabilityReport]) -> facts.Rows[StabilityReport]:
    of_one_lambda = {row.key for row in LINEAR} - {"points"} | {"R_alike"}
    changes = {"pair": {"label": "coupled"}, "points": {"label": "at points, z1 = z2"}}
    return [
        *PARTS,
        *rows[:1],
        *(
            x.but(level=DATA) if x.key in of_one_lambda else x.but(**changes.get(x.key, {}))
            for x in rows[1:]
        ),
        ONE_LAMBDA,
    ]


def _waves(linear: str, waves: str) -> facts.Rows[StabilityReport]:
    """First if there is no other test equation."""
    rows = WAVES[waves]
    if linear != "none":
        return rows
    return [
        row.but(level=HEADLINE, label=f"{OF_WAVES}:") if row.key == "stable" else row
        for row in rows
    ]


WAVES: dict[str, facts.Rows[StabilityReport]] = {
    "none": [],
    "late": [facts.maybe("stable", STABLE, lambda x: _open(x.found, "oscillator"), label=OF_WAVES)],
    "known": facts.via(lambda x: x.found.oscillator, OSCILLATOR),
}


def _left_out_words(_: StabilityReport, d: Plain) -> str:
    return d.prose(
        "A(α), oscillator, P- and I-stability, phase lag: they need exact coefficients; "
        "R(z), R(∞): with -v, of the digits as printed"
    )


LEFT_OUT: facts.Row[StabilityReport] = facts.maybe(
    "left_out",
    facts.Kind(None, facts.Words(_left_out_words)),
    lambda x: x if x.found.linear and x.found.tolerance is not None else None,
    label="not within a tolerance",
)
TAIL: facts.Rows[StabilityReport] = [
    facts.maybe("algebraically_stable", kinds.TRUTH, algebraic),
    LEFT_OUT,
    PLOT,
]
LINEARS: dict[str, facts.Rows[StabilityReport]] = {
    "none": [*head("oscillator")],
    "alike": [*head("linear"), *ALIKE, ALONE, EMBEDDED],
    "several": [*head("linear"), *SEVERAL, EMBEDDED],
    "parts": [*head("linear"), *_by_parts([*SEVERAL, EMBEDDED])],
    "rounded parts": [*head("linear"), *_by_parts([*ALIKE, ALONE, EMBEDDED])],
}
"""Sections by the colours on the linear test equation: ``R`` has a z for each colour, or one."""
COLUMNS = ("file", "a_stable", "l_stable", "real_interval", "imaginary_interval", "ssp")
COLUMNS_OF_PARTS = ("file", "implicit_part", "explicit_part", "coupled")
FORMS = {
    (linear, waves): facts.Section(
        rows,
        _waves(linear, waves),
        TAIL,
        title=title,
        columns=COLUMNS_OF_PARTS if "parts" in linear else COLUMNS,
    )
    for (linear, rows), waves in product(LINEARS.items(), WAVES)
}


def factors(p: Polynomial) -> list[tuple[Polynomial, int]]:
    """The irreducible factors over ℚ, with their multiplicities; p itself over a number field."""
    if not p.is_rational or not p:
        return [(p, 1)]
    found = p.to_flint().numer().factor()[1]
    return [(Polynomial.from_flint(factor), power) for factor, power in found]


FACTOR: facts.Section[tuple[Polynomial, int]] = facts.Section(
    facts.Row("factor", kinds.polynomial("x"), lambda x: x[0]),
    facts.Row("multiplicity", kinds.POSITION, lambda x: x[1]),
)


def _factors_words(found: Sequence[tuple[Polynomial, int]], d: Plain) -> str:
    return "; ".join(d.polynomial(p, "x") + (f", {k} times" if k > 1 else "") for p, k in found)


OF_SPRINGS: facts.Rows[TwoFrequencies] = (
    facts.Row("slow", SQUARE, lambda x: x.slow, label="two springs, x = (hω_fast)²"),
    facts.Row("trace", kinds.ratio("x"), lambda x: x.trace, DETAIL),
    facts.Row("determinant", kinds.ratio("x"), lambda x: x.determinant, DETAIL),
    facts.Row(
        "factors",
        parts(FACTOR, _factors_words),
        lambda s: facts.Answer(factors(s.discriminant), reason=Reason("tr M = N/D for a step M")),
    ),
    facts.Row("stable", STABLE_FAST, lambda x: x.stable),
)
OF_SLOW: facts.Rows[SlowInterval] = (
    facts.itself("slow", FROM_TO, label="two springs, x = (hω_fast)²"),
    facts.Row("stable", STABLE_FAST, lambda x: x.stable),
    facts.maybe(
        "stable_for_every_fast",
        kinds.TRUTH,
        lambda x: kinds.truth(x.is_stable_for_all, open_because="at the x below"),
    ),
    facts.Row("open_points", kinds.ROOTS, lambda x: x.open_points),
)
SPRINGS: facts.Section[StabilityReport] = facts.Section(
    head("two-frequencies"), facts.via(lambda x: x.springs, OF_SPRINGS), PLOT, title=title
)
SLOW: facts.Section[StabilityReport] = facts.Section(
    head("slow-interval"), facts.via(lambda x: x.slow, OF_SLOW), PLOT, title=title
)


def form(x: StabilityReport) -> facts.Section[StabilityReport]:
    if x.slow is not None:
        return SLOW
    if x.springs is not None:
        return SPRINGS
    linear = "none" if not x.found.linear else "alike" if x.found.colours is None else "several"
    if imex_parts(x) is not None:
        linear = "parts" if linear == "several" else "rounded parts"
    late = "late" if "oscillator" in x.found.late else "none"
    return FORMS[linear, late if x.found.oscillator is None else "known"]


REPORT: Report[StabilityReport] = Report(
    "gark/stability/1",
    "report of gark stability",
    lambda: (SLOW, SPRINGS, *FORMS.values()),
    form,
    lambda x: {"digits": x.digits, "colours": [c.name for c in x.found.tableau.colours]},
    letters=lambda x: x.found.tableau,
)


def whole(found: Stability, name: str) -> StabilityReport:
    return StabilityReport(name, name, found)


def formulas(found: Stability) -> Iterator[tuple[str, str]]:
    if found.colours is not None and found.colours.R is not None:
        names = ", ".join(f"z_{{{k + 1}}}" for k in range(found.colours.size))
        yield f"R({names})", _fraction(found.colours.R)
    if found.tolerance is None:
        for one in found.linear:
            name = "R(z)" if one.name == "all" else rf"R_{{\mathrm{{{one.name}}}}}(z)"
            yield name, _quotient(one.R, "z")
        if found.embedded is not None:
            yield r"\hat R(z)", _quotient(found.embedded.R, "z")
    if found.oscillator is not None:
        yield r"\operatorname{tr} M(x)", _quotient(found.oscillator.trace, "x")
        yield r"\det M(x)", _quotient(found.oscillator.determinant, "x")


def _fraction(R: Fraction) -> str:
    whole = integral_parts(R)
    colours = range(1, whole[0].variables + 1)
    if any(polynomials.is_long(a) for p in whole for _, a in p.terms):
        names = [f"z{k}" for k in colours]
        return _in_decimals(
            [polynomials.multivariate_decimals(p, names) for p in (R.numerator, R.denominator)]
        )
    return _over(*(multivariate_latex(p, [f"z_{{{k}}}" for k in colours]) for p in whole))


def _quotient(x: kinds.Quotient, variable: str) -> str:
    given = x.numerator, x.denominator
    whole = polynomials.integral(given)
    if polynomials.has_long_coefficients(*whole):
        return _in_decimals([polynomials.polynomial_decimals(p, variable) for p in given])
    return _over(*(polynomial_latex(p, variable) for p in whole))


def _in_decimals(texts: Sequence[str]) -> str:
    top, bottom = (expression_latex(text) or rf"\text{{{text}}}" for text in texts)
    return _over(top, bottom, r"\approx")


def _over(top: str, bottom: str, sign: str = "=") -> str:
    return f"{sign} {top}" if bottom == "1" else rf"{sign} \frac{{{top}}}{{{bottom}}}"
