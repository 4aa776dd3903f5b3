"""``gark stability``: what is found, declared once."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import product
from typing import TYPE_CHECKING, Any

from flint import arb, ctx

from garkcli.exact.display import BITS_OF_A_DIGIT, to_ball, to_text
from garkcli.exact.field import Number
from garkcli.exact.multivariate import Multivariate
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import (
    ball_decimal,
    integral,
    integral_scale,
    multivariate_text,
    polynomial_text,
)
from garkcli.exact.roots import RealRoot, sign
from garkcli.frozen import Frozen, replace
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ALGEBRAIC, ROOT_OF, root_data
from garkcli.plots.regions import stability_scene
from garkcli.reason import NO_REASON, Formula, Reason
from garkcli.stability.ball_polynomials import Bounds
from garkcli.stability.fraction import MOST_LINES, Fraction
from garkcli.stability.linear import poles_are_right
from garkcli.stability.summary import Stability
from garkcli.stability.two_frequencies import SlowInterval, TwoFrequencies
from garkcli.tableau.garkmethod import Derivation, derived_name
from garkcli.tell import kinds
from garkcli.tell.facts import Answer, Kind, Level, Row, Section, Status, maybe, via
from garkcli.tell.parts import part, parts, scene
from garkcli.tell.report import Report

if TYPE_CHECKING:
    from garkcli.stability.springs_plane import SpringsPlane
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level


class StabilityReport(Frozen):
    """What the report says of one file.

    Attributes:
        file: its path as given.
        name: the name of the method.
        found: its stability.
        springs: the two-frequency problem where it was requested.
        digits: decimals of algebraic numbers.
        plane: both frequencies in floats, for a picture.
        slow: the two-frequency problem for an interval of slow frequencies.
        derivation: whether the method is the pair or the conjugate of what the file gives.
        is_order_star: whether the picture is |R(z)| > |e^z|.
    """

    file: str
    name: str
    found: Stability
    springs: TwoFrequencies | None = None
    digits: int = 12
    plane: SpringsPlane | None = None
    slow: SlowInterval | None = None
    derivation: Derivation = ""
    is_order_star: bool = False


# kinds


def _decimals(value: Callable[[int], arb], digits: int) -> str:
    """A number in decimals, from its balls."""
    bits, before = int(digits * BITS_OF_A_DIGIT) + 64, ctx.prec
    try:
        ctx.prec = bits
        return ball_decimal(value(bits), digits)
    finally:
        ctx.prec = before


def _degrees(cosine: RealRoot, digits: int) -> str:
    """The angle of a cosine."""
    return _decimals(lambda bits: cosine.ball(bits).acos() * 180 / arb.pi(), digits)


def _square_root(root: RealRoot, digits: int) -> str:
    return _decimals(lambda bits: root.ball(bits).sqrt(), digits)


def _around_zero(
    bounds: str, nowhere: str, everywhere: str, end: Callable[[RealRoot, Plain], str]
) -> Callable[[Any, Plain], str]:
    """The interval of an axis that begins at 0: of −z on the real one, of y² on the imaginary."""

    def words(found: Any, d: Plain) -> str:
        if isinstance(found, Bounds):
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


def _end_data(found: Any, d: Plain) -> dict[str, Any]:
    """The first interval, by its end: in −z on the real axis, in y² on the imaginary one."""
    if isinstance(found, Bounds):
        return kinds.bounds_data(found)
    if not found:
        return {"to": "0"}
    return {"to": None if found[0].end is None else root_data(found[0].end, d.digits)}


_END = kinds.record(to=S.nullable(ALGEBRAIC))
REAL = Kind(
    S.one_of(_END, kinds.BOUNDS),
    _end_data,
    _around_zero("−z ≤ ", "z = 0 only", "z ≤ 0", lambda end, d: d.upto("−z", end)),
)
IMAGINARY = replace(REAL, words=_around_zero("y² ≤ ", "y = 0 only", "all y", _height))
SSP = Kind(
    S.one_of(S.TEXT, ROOT_OF, kinds.BOUNDS),
    lambda x, d: kinds.bounds_data(x) if isinstance(x, Bounds) else kinds.RADIUS.data(x, d),
    lambda x, d: d.bounds(x) if isinstance(x, Bounds) else kinds.RADIUS(x).words(d),
)
SECTOR = Kind(
    kinds.record(degrees=S.TEXT, cosine=ALGEBRAIC),
    lambda x, d: {"degrees": _degrees(x.cosine, d.digits), "cosine": root_data(x.cosine, d.digits)},
    lambda x, d: d.prose(f"α = {_degrees(x.cosine, d.digits)}°, cos α = ") + d.root(x.cosine),
)


def integral_parts(R: Fraction) -> tuple[Multivariate, Multivariate]:
    """Numerator and denominator with integers as coefficients, where they are rational."""
    P, Q = R.numerator, R.denominator
    scale = integral_scale([coefficient for _, coefficient in (*P.terms, *Q.terms)])
    constant_term = Multivariate.of(P.variables, {(0,) * P.variables: scale})
    return P * constant_term, Q * constant_term


def _fraction_data(R: Fraction, _: Plain) -> dict[str, Any]:
    over, under = (
        multivariate_text(p, [f"z{k + 1}" for k in range(p.variables)]) for p in integral_parts(R)
    )
    return {"numerator": over, "denominator": under, "lowest_terms": R.is_reduced}


FRACTION = Kind(
    kinds.record(numerator=S.TEXT, denominator=S.TEXT, lowest_terms=S.FLAG),
    _fraction_data,
    lambda R, d: (
        d.fraction(*integral_parts(R)) + ("" if R.is_reduced else "; perhaps not in lowest terms")
    ),
)


def _conserved_words(form: Any, d: Plain) -> str:
    terms = []
    for p, name in zip(integral(form), ("(ωq)²", "ωq p", "p²"), strict=True):
        factor = d.polynomial(p, "z")
        if len(p.coefficients) > 1:
            terms.append(f"({factor}) {d.prose(name)}")
        elif p:
            terms.append(d.prose(name) if factor.strip("$") == "1" else f"{factor} {d.prose(name)}")
    return " + ".join(terms)


CONSERVED = Kind(
    kinds.record(qq=S.TEXT, qp=S.TEXT, pp=S.TEXT),
    lambda form, _: dict(
        zip(("qq", "qp", "pp"), (polynomial_text(p, "z") for p in integral(form)), strict=True)
    ),
    _conserved_words,
)
FROM_TO = Kind(
    kinds.record(**{"from": S.EXACT, "to": S.EXACT}),
    lambda x, _: {"from": str(x.low), "to": str(x.high)},
    lambda x, _: f"every a = (hω_slow)² from {x.low} to {x.high}",
)
SQUARE = Kind(S.EXACT, lambda x, _: str(x), lambda x, d: f"a = (hω_slow)² = {d.number(x)}")


# what is found

ROUNDED = Reason("coefficients are rounded")
LATE = Reason("it takes longer than --seconds")


def _open(x: Any, name: str) -> Answer | None:
    """The answer where the time was not enough for an attribute; None where it was."""
    return Answer(None, Status(open=LATE)) if name in x.late else None


def a_stable(x: Any) -> Answer:
    """Whether |R| ≤ 1 in the left half plane, and why not."""
    if x.a_stable is not False or x.within is not None:
        return _open(x, "a_stable") or kinds.truth(x.a_stable, open_because=ROUNDED)
    if x.R.at_infinity() is None:
        return kinds.truth(False, "R is unbounded")
    if not poles_are_right(x.R.denominator):
        return kinds.truth(False, "a pole is not in the right half plane")
    E = kinds.polynomial("x")(x.e_polynomial)
    return kinds.truth(False, Reason("|R(iy)| > 1 where E(y²) < 0, E = {}", E))


def sector(x: Any) -> Any:
    """A(α)-stability."""
    if x.within is not None:
        return None
    if x.sector is None:
        return _open(x, "sector") or Answer(None, Status(open=Reason("too many stages")))
    return Answer(None, reason=Reason("no")) if x.sector.cosine is None else x.sector


def _less_than_all(answer: Answer) -> Level:
    """A sector is reported where it is not the left half plane, which A-stable says."""
    if answer.value is None:
        return USUAL if answer.status.open else DETAIL
    return USUAL if answer.value.cosine.exact != 0 else DETAIL


PRINTED = Reason("of the digits as printed, not of all methods within the tolerance")


def limit(x: Any) -> Answer:
    """R(∞)."""
    found = x.R.at_infinity()
    if found is None:
        return Answer(None, reason=Reason("unbounded"))
    if x.within is not None:
        return Answer(found, reason=PRINTED, level=DETAIL)
    return Answer(found)


def either(exact: str) -> Callable[[Any], Any]:
    """Of exact coefficients, or of rounded ones."""
    return lambda x: _open(x, exact) or getattr(x if x.within is None else x.within, exact)


def ssp(x: Any) -> Any:
    """The SSP coefficient."""
    if x.is_linear_alone:
        return None
    found = x.ssp if x.within is None else x.within.ssp
    without_nodes = Answer(None, Status(open=Reason("the nodes have no simple radicals")))
    return found or _open(x, "ssp") or without_nodes


def _complex_words(x: Any, d: Plain) -> str:
    """A complex number of texts."""
    real, imaginary = x
    text = real
    if imaginary != "0":
        minus, size = "-" * imaginary.startswith("-"), imaginary.removeprefix("-")
        unit = "i" if size == "1" else f"{size}i"
        text = f"{minus}{unit}" if real == "0" else f"{real} {minus or '+'} {unit}"
    return d.formula(text, text)


def _points_words(points: Any, d: Plain) -> str:
    """R and |R| at each point, and whether that is bounded by 1."""
    said = []
    for x in points:
        z = f"z = {_complex_words(list(map(to_text, x.z)), d)}"
        if x.value is None:
            said.append(f"{z}: a pole")
            continue
        value = _complex_words([_decimals_of(y, d.digits) for y in x.value], d)
        size = _modulus(x, d.digits)
        than = {-1: "less than 1", 0: "exactly", 1: "more than 1"}[sign(x.squared - 1)]
        said.append(f"{z}: {value}, {d.formula(rf'|R| = {size}', f'|R| = {size}')}, {than}")
    return "; ".join(said)


def _decimals_of(x: Number, digits: int) -> str:
    return ball_decimal(to_ball(x, digits + 4), digits)


def _modulus(x: Any, digits: int) -> str:
    return _decimals(lambda _: to_ball(x.squared, digits + 24).sqrt(), digits)


DECIMALS = Kind(
    S.array(S.TEXT),
    lambda x, d: [_decimals_of(y, d.digits) for y in x],
    lambda x, d: ", ".join(_decimals_of(y, d.digits) for y in x),
)
POINT = Section(
    Row("z", kinds.EXACTS),
    maybe("value", kinds.EXACTS),
    maybe("decimals", DECIMALS, "value"),
    maybe("squared", kinds.EXACT),
    maybe("size", Kind(S.TEXT, lambda x, d: _modulus(x, d.digits)), lambda x: x.value and x),
    maybe("bounded", kinds.TRUTH, lambda x: None if x.value is None else sign(x.squared - 1) <= 0),
)
LINEAR = [
    Row(
        "R",
        kinds.ratio("z"),
        lambda x: Answer(
            x.R, reason=PRINTED if x.within else NO_REASON, level=DETAIL if x.within else USUAL
        ),
    ),
    maybe("R_infinity", kinds.EXACT, limit),
    maybe("a_stable", kinds.TRUTH, a_stable, HEADLINE),
    maybe(
        "l_stable",
        kinds.TRUTH,
        lambda x: kinds.truth(x.l_stable, open_because=LATE if x.late else ROUNDED),
        lambda a: HEADLINE if a.value else DETAIL,
    ),
    maybe("A_alpha", SECTOR, sector, _less_than_all),
    maybe("real_interval", REAL, either("real")),
    maybe("imaginary_interval", IMAGINARY, either("imaginary")),
    maybe("ssp", SSP, ssp),
    Row(
        "points",
        parts(POINT, _points_words),
        lambda x: Answer(x.points, reason=PRINTED if x.within and x.points else NO_REASON),
        label="at points",
    ),
]
OF_COLOUR = Section(
    Row("name", kinds.TEXT, level=DATA),
    *LINEAR,
    title=lambda x, d: f"colour {d.prose(x.name)} alone",
)


OF_EMBEDDED = Section(
    replace(LINEAR[0], label="R̂(z)"),
    replace(LINEAR[1], label="R̂(∞)"),
    *LINEAR[2:5],
    *(replace(row, level=DETAIL) for row in LINEAR[5:7]),
    LINEAR[-1],
    title=lambda _, d: d.prose("embedded weights"),
)
EMBEDDED = maybe(
    "embedded", part(OF_EMBEDDED), lambda x: _open(x.found, "embedded") or x.found.embedded
)


def conserved(o: Any) -> Answer:
    """The quadratic form that a step keeps."""
    if not o.determinant.is_one:
        return Answer(None, reason=Reason("none: the determinant is not 1"))
    if o.conserved is None:
        return Answer(None, reason=Reason("every one: the step is a multiple of the identity"))
    return Answer(o.conserved)


def p_stable(o: Any) -> Answer:
    """Neither growth nor decay on the oscillator for any step size, and where that ends."""
    if o.is_i_stable and not o.is_p_stable:
        return kinds.truth(False, "solutions decay")
    return i_stable(o)


def i_stable(o: Any) -> Answer:
    """Stability for every step size on the oscillator, and where it ends."""
    if o.is_i_stable:
        return kinds.truth(True)
    first = o.stable[0] if o.stable else None
    if first is None or not first.has_start or first.is_point:
        return kinds.truth(False, "unstable for small step sizes")
    where = "beyond" if first.has_end else "at"
    return kinds.truth(False, Reason(f"not stable {where} x = {{}}", ROOT_ALONE(first.end)))


ROOT_ALONE = Kind(ALGEBRAIC, words=lambda x, d: d.root(x))


def phase(o: Any) -> Answer:
    """The order of the phase lag, and its sign."""
    if o.phase.order is None:
        return Answer(None, reason=Reason("none: the frequency is exact"))
    if o.phase.constant is None:
        return Answer(o.phase.order, reason=Reason("the frequency is wrong for small step sizes"))
    where = "behind" if sign(o.phase.constant) > 0 else "ahead"
    lag, z = kinds.term("z", o.phase.order + 1), Formula("z = hω", r"z = h\omega")
    reason = Reason(f"{{}}, {{}}: {where}", lag(o.phase.constant), z)
    return Answer(o.phase.order, reason=reason)


PHASE = Kind(S.COUNT, words=lambda n, _: f"of order {n}")
_X = kinds.intervals("x")
STABLE = Kind(
    _X.schema, _X.data, lambda xs, d: " or ".join(_zone(x, d) for x in xs) if xs else "for no x"
)


def _zone(x: Any, d: Plain) -> str:
    """An interval of x = (hω)², with the root of its end, which is one of hω."""
    if x.is_point or x.end is None:
        return d.interval(x, "x")
    root = d.formula(r"\sqrt{x}", "sqrt(x)")
    return f"{d.interval(x, 'x')}, {root} to {_square_root(x.end, d.digits)}"


def discriminant(o: Any) -> Answer:
    """4D² − N², and what that is."""
    meaning = "tr M = N/D for a step M"
    if o.determinant.is_one:
        meaning += ", which is stable where this is positive"
    return Answer(o.discriminant, reason=Reason(meaning))


OF_WAVES = "oscillator stable, x = (hω)²"
OSCILLATOR = [
    Row("trace", kinds.ratio("x"), level=DETAIL),
    Row("determinant", kinds.ratio("x"), level=DETAIL),
    Row("discriminant", kinds.polynomial("x"), discriminant, DETAIL),
    Row("stable", STABLE, label=OF_WAVES),
    maybe("p_stable", kinds.TRUTH, p_stable),
    maybe("i_stable", kinds.TRUTH, i_stable),
    maybe("phase_order", PHASE, phase),
    maybe("phase_constant", kinds.EXACT, "phase.constant", DATA),
    maybe("conserved", CONSERVED, conserved, DETAIL),
]


def algebraic(x: Any) -> Answer:
    """Algebraic stability, and why not."""
    found = x.found
    if found.algebraic is None:
        late = _open(found, "algebraic")
        if late is not None:
            return late
        if found.is_linear_alone:
            return Answer(None, reason=Reason("has no meaning: it is no Runge-Kutta method"))
        if found.tolerance is None:
            return Answer(None, reason=Reason("has no meaning: colours do not see one another"))
        return kinds.truth(found.algebraic_within, open_because=ROUNDED)
    why = [] if found.algebraic.weights_are_positive else ["a weight is negative"]
    if not found.algebraic.form_is_positive:
        why.append("B A + Aᵀ B − b bᵀ is not positive semidefinite")
    return kinds.truth(found.algebraic.holds, ", ".join(why))


def title(x: Any, d: Plain) -> str:
    """What a report is about."""
    within = x.found.tolerance
    given = x.file or x.name
    name = d.prose(derived_name(x.derivation, given) if x.derivation else given)
    return name if within is None else d.known(name, Status(within))


def head(kind: str) -> list[Row]:
    """The first fields of every report."""
    return [
        *kinds.FILE_AND_NAME,
        Row("derivation", Kind(S.DERIVATION), level=DATA),
        Row("kind", kinds.constant(kind), lambda _: kind, DATA),
        maybe("tolerance", kinds.TOLERANCE, "found.tolerance", DATA),
    ]


RADII = Section(Row("direction", kinds.EXACTS, "ratios"), maybe("radius", kinds.RADIUS))


def _radii_words(found: Any, d: Plain) -> str:
    """How far the region of absolute monotonicity reaches in each direction."""
    texts = []
    for r in found:
        if r.radius is None:
            return "not decided: the nodes have no simple radicals"
        direction = ", ".join({0: "0", 1: "r"}.get(q, f"{q} r") for q in r.ratios)
        direction = d.formula(f"({direction})", f"({direction})")
        texts.append(f"{direction}, {d.prose('r ≤')} {kinds.RADIUS(r.radius).words(d)}")
    return "; ".join(texts)


def _ray(sign: str) -> Kind:
    def words(ray: Any, d: Plain) -> str:
        if ray.end is None:
            return "no limit"
        return "none" if ray.end.exact == 0 else d.upto(sign, ray.end)

    return Kind(
        _END, lambda x, d: {"to": None if x.end is None else root_data(x.end, d.digits)}, words
    )


IMEX = Section(
    Row("explicit", kinds.TEXT, lambda c: c.names[c.pair.explicit], DATA),
    Row("implicit", kinds.TEXT, lambda c: c.names[c.pair.implicit], DATA),
    maybe("real_interval", _ray("−z"), lambda c: _open(c, "real") or c.real),
    maybe("imaginary_interval", _ray("|z|"), lambda c: _open(c, "imaginary") or c.imaginary),
    title=lambda c, d: d.prose(
        f"implicit-explicit pair, z{c.pair.explicit + 1} with |R| ≤ 1 for every"
        f" z{c.pair.implicit + 1} with Re ≤ 0"
    ),
)
PLOT = Row(
    "plot",
    scene(lambda x: stability_scene([(x.name, x.found)], x.is_order_star, x.plane)),
    lambda x: x if x.found.linear or x.found.oscillator or x.plane else None,
    DETAIL,
)


def fraction(x: Any) -> Any:
    """R of all colours."""
    found = x.found.colours
    if found.R is None:
        late = _open(found, "R")
        if late is not None:
            return late
        reason = Reason(f"too large: {found.lines} lines determine it (limit {MOST_LINES})")
        return Answer(None, reason=reason)
    return found.R


ALIKE = via(lambda x: x.found.linear[0], LINEAR)
ALONE = Row("colours", parts(OF_COLOUR), lambda x: x.found.linear[1:], DETAIL)
SEVERAL = [
    maybe("R", FRACTION, fraction, label="R(z1, z2, …)"),
    *ALIKE[1:],
    ALONE,
    Row("R_alike", kinds.ratio("z"), "found.linear.0.R", DETAIL),
    maybe(
        "ssp_radii",
        parts(RADII, _radii_words),
        lambda x: _open(x.found.colours, "radii") or x.found.colours.radii,
    ),
    maybe("pair", part(IMEX), lambda x: x.found.colours if x.found.colours.pair else None),
]


def _waves(linear: str, waves: str) -> list[Row]:
    """The rows of the oscillator; first where there is no other test equation."""
    rows = WAVES[waves]
    if linear != "none":
        return rows
    return [
        replace(row, level=HEADLINE, label=f"{OF_WAVES}:") if row.key == "stable" else row
        for row in rows
    ]


WAVES = {
    "none": [],
    "late": [maybe("stable", STABLE, lambda x: _open(x.found, "oscillator"), label=OF_WAVES)],
    "known": via(lambda x: x.found.oscillator, OSCILLATOR),
}
"""By what is known of the oscillator."""
TAIL = [maybe("algebraically_stable", kinds.TRUTH, algebraic), PLOT]
LINEARS = {
    "none": [*head("oscillator")],
    "alike": [*head("linear"), *ALIKE, ALONE, EMBEDDED],
    "several": [*head("linear"), *SEVERAL, EMBEDDED],
}
"""By what the colours do on the linear test equation: ``R`` has a z for each colour, or one."""
COLUMNS = ("file", "a_stable", "l_stable", "real_interval", "imaginary_interval", "ssp")
FORMS = {
    (linear, waves): Section(*rows, *_waves(linear, waves), *TAIL, title=title, columns=COLUMNS)
    for (linear, rows), waves in product(LINEARS.items(), WAVES)
}


def factors(p: Polynomial) -> list[tuple[Polynomial, int]]:
    """The irreducible factors over ℚ, with their multiplicities; p itself over a number field."""
    if not p.is_rational or not p:
        return [(p, 1)]
    found = p.to_flint().numer().factor()[1]
    return [(Polynomial.from_flint(factor), power) for factor, power in found]


FACTOR = Section(
    Row("factor", kinds.polynomial("x"), "0"), Row("multiplicity", kinds.POSITION, "1")
)


def _factors_words(found: Any, d: Plain) -> str:
    return "; ".join(d.polynomial(p, "x") + (f", {k} times" if k > 1 else "") for p, k in found)


SPRINGS = Section(
    *head("two-frequencies"),
    *via(
        lambda x: x.springs,
        [
            Row("slow", SQUARE, label="two springs, x = (hω_fast)²"),
            Row("trace", kinds.ratio("x"), level=DETAIL),
            Row("determinant", kinds.ratio("x"), level=DETAIL),
            Row(
                "factors",
                parts(FACTOR, _factors_words),
                lambda s: Answer(factors(s.discriminant), reason=Reason("tr M = N/D for a step M")),
            ),
            Row("stable", STABLE),
        ],
    ),
    PLOT,
    title=title,
)
SLOW = Section(
    *head("slow-interval"),
    *via(
        lambda x: x.slow,
        [
            Row("slow", FROM_TO, ".", label="two springs, x = (hω_fast)²"),
            Row("stable", STABLE),
            maybe(
                "stable_for_every_fast",
                kinds.TRUTH,
                lambda s: kinds.truth(s.is_stable_for_all, open_because="at the x below"),
            ),
            Row("open_points", kinds.ROOTS),
        ],
    ),
    PLOT,
    title=title,
)


def form(x: StabilityReport) -> Section:
    """The rows of a report: fields are there by what the method is."""
    if x.slow is not None:
        return SLOW
    if x.springs is not None:
        return SPRINGS
    linear = "none" if not x.found.linear else "alike" if x.found.colours is None else "several"
    late = "late" if "oscillator" in x.found.late else "none"
    return FORMS[linear, late if x.found.oscillator is None else "known"]


REPORT: Report[StabilityReport] = Report(
    "gark/stability/1",
    "report of gark stability",
    lambda: (SLOW, SPRINGS, *FORMS.values()),
    form,
    lambda x: {"digits": x.digits, "colours": [c.name for c in x.found.tableau.colours]},
)


def whole(found: Stability, name: str) -> StabilityReport:
    """What the report says of a stability by a name."""
    return StabilityReport(name, name, found)


def formulas(found: Stability) -> Iterator[tuple[str, str]]:
    """Names and values in LaTeX of what decides stability."""
    from garkcli.page.exactly import multivariate_latex, quotient_latex

    def quotient(x: Any, variable: str) -> str:
        return quotient_latex(x.numerator, x.denominator, variable)

    if found.colours is not None and found.colours.R is not None:
        names = [f"z_{{{k + 1}}}" for k in range(found.colours.size)]
        over, under = (multivariate_latex(p, names) for p in integral_parts(found.colours.R))
        yield f"R({', '.join(names)})", over if under == "1" else rf"\frac{{{over}}}{{{under}}}"
    if found.tolerance is None:
        for one in found.linear:
            name = "R(z)" if one.name == "all" else rf"R_{{\mathrm{{{one.name}}}}}(z)"
            yield name, quotient(one.R, "z")
        if found.embedded is not None:
            yield r"\hat R(z)", quotient(found.embedded.R, "z")
    if found.oscillator is not None:
        yield r"\operatorname{tr} M(x)", quotient(found.oscillator.trace, "x")
        yield r"\det M(x)", quotient(found.oscillator.determinant, "x")
