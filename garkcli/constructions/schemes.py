"""Compositions and splittings by name: substeps of a method, or flows of the parts of a problem.

Some numbers are exact. Those of Yoshida, Suzuki and Umeno were computed from their order conditions
to 40 digits, by Newton's method from the published ones; the others are as published, with free
parameters.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import product
from typing import TypeAlias

from garkcli.frozen import Frozen

Part: TypeAlias = tuple[str, bool]
"""A fraction of the step as text, and whether the adjoint takes it."""
Parts: TypeAlias = tuple[Part, ...]
MAX_ORDER = 12


class Scheme(Frozen):
    """A composition of one method, of an ``order`` for people. ``parts`` makes the substeps from
    the order of the method and the requested one, both 0 for schemes of one order.
    """

    name: str
    order: str
    summary: str
    parts: Callable[[int, int], Parts]
    tolerance: str = ""
    has_orders: bool = False
    reference: str = ""


def palindrome(half: Sequence[str]) -> Callable[[int, int], Parts]:
    """γ_1, …, γ_k, 1 − 2 Σ γ, γ_k, …, γ_1."""
    total = " + ".join(f"({x})" for x in half)
    parts = tuple((text, False) for text in (*half, f"1 - 2*({total})", *reversed(half)))
    return lambda _, __: parts


def repeated(fractions: Callable[[int], Sequence[str]]) -> Callable[[int, int], Parts]:
    """Repeats a scheme that gains two orders, with substeps ``fractions(order)``."""

    def parts(base: int, wanted: int) -> Parts:
        texts = ["1"]
        for order in range(base, wanted, 2):
            pairs = product(fractions(order), texts)
            texts = [g if text == "1" else f"({g})*({text})" for g, text in pairs]
        return tuple((text, False) for text in texts)

    return parts


def _triple_jump(order: int) -> tuple[str, ...]:
    root = f"root(2, {order + 1})"
    outer = f"1/(2 - {root})"
    return outer, f"-{root}/(2 - {root})", outer


def _suzuki(order: int) -> tuple[str, ...]:
    root = f"root(4, {order + 1})"
    outer = f"1/(4 - {root})"
    return outer, outer, f"-{root}/(4 - {root})", outer, outer


_BETA = (
    "(14 - sqrt(19))/108",
    "(-23 - 20*sqrt(19))/270",
    "1/5",
    "(-2 + 10*sqrt(19))/135",
    "(146 + 5*sqrt(19))/540",
)


def _mclachlan(_: int, __: int) -> Parts:
    """Alternates β_1 by the adjoint and α_1 by the method; α is β reversed."""
    parts: list[Part] = []
    for beta, alpha in zip(_BETA, reversed(_BETA), strict=True):
        parts += [(beta, True), (alpha, False)]
    return tuple(parts)


_YOSHIDA_6 = (
    "0.784513610477557263819497633866349875776824",
    "0.235573213359358133684793182978534601686468",
    "-1.177679984178871006946415680964315734639269",
)
_YOSHIDA_8 = (
    "1.04242620869970426434895326839765647610556",
    "1.8202063097069800693317331661213997808094",
    "0.157739928123708321342825783079542004840526",
    "2.44002732616634406381689589761943094353784",
    "-0.00716989419709533209980612924964910948119879",
    "-2.44699182370424588929469145238146248456082",
    "-1.6158237415006537847879401974587421658972",
)
_KAHAN_LI_6 = (
    "0.39216144400731413927925056",
    "0.33259913678935943859974864",
    "-0.70624617255763935980996482",
    "0.08221359629355080023149045",
)
_KAHAN_LI_8 = (
    "0.13020248308889008087881763",
    "0.56116298177510838456196441",
    "-0.38947496264484728640807860",
    "0.15884190655515560089621075",
    "-0.39590389413323757733623154",
    "0.18453964097831570709183254",
    "0.25837438768632204729397911",
    "0.29501172360931029887096624",
)
_SUZUKI_UMENO_8 = (
    "0.7416703643506129534482278017838063156035",
    "-0.4091008258000315939973000958935634173099",
    "0.1907547102962383799538762564503716627355",
    "-0.5738624711160822666563877266355357421595",
    "0.2990641813036559238444635406886029882258",
    "0.3346249182452981837849579798821822886337",
    "0.3152930923967665966320566638110024309941",
)
_SOFRONIOU_10 = (
    "0.078795722521686419263907679337684",
    "0.31309610341510852776481247192647",
    "0.027918383235078066109520273275299",
    "-0.22959284159390709415121339679655",
    "0.13096206107716486317465685927961",
    "-0.26973340565451071434460973222411",
    "0.074973343155891435666137105641410",
    "0.11199342399981020488957508073640",
    "0.36613344954622675119314812353150",
    "-0.39910563013603589787862981058340",
    "0.10308739852747107731580277001372",
    "0.41143087395589023782070411897608",
    "-0.0048663605831352617621956593099771",
    "-0.39203335370863990644808193642610",
    "0.051942502962449647037182904015976",
    "0.050665090759924496335874344156866",
    "0.049674370639729879054568800279461",
)
_OF_YOSHIDA = "H. Yoshida, Phys. Lett. A 150 (1990), solution A"
_OF_KAHAN = "W. Kahan, R.-C. Li, Math. Comp. 66 (1997)"


SCHEMES: Mapping[str, Scheme] = {
    scheme.name: scheme
    for scheme in (
        Scheme(
            "strang",
            "2",
            "the method and its adjoint, half of the step each",
            lambda _, __: (("1/2", False), ("1/2", True)),
            reference="G. Strang, SIAM J. Numer. Anal. 5 (1968)",
        ),
        Scheme(
            "triple-jump",
            "4, 6, …",
            "three substeps of a symmetric method, repeated for higher orders",
            repeated(_triple_jump),
            has_orders=True,
            reference="M. Creutz, A. Gocksch (1989), E. Forest, H. Yoshida (1990)",
        ),
        Scheme(
            "suzuki",
            "4, 6, …",
            "five substeps of a symmetric method, repeated for higher orders",
            repeated(_suzuki),
            has_orders=True,
            reference="M. Suzuki, Phys. Lett. A 146 (1990)",
        ),
        Scheme(
            "mclachlan-4",
            "4",
            "ten substeps of any method of order 1 and its adjoint",
            _mclachlan,
            reference="R. McLachlan, SIAM J. Sci. Comput. 16 (1995)",
        ),
        Scheme(
            "yoshida-6", "6", "7 substeps", palindrome(_YOSHIDA_6), "1e-38", reference=_OF_YOSHIDA
        ),
        Scheme(
            "yoshida-8", "8", "15 substeps", palindrome(_YOSHIDA_8), "1e-36", reference=_OF_YOSHIDA
        ),
        Scheme(
            "kahan-li-6", "6", "9 substeps", palindrome(_KAHAN_LI_6), "1e-24", reference=_OF_KAHAN
        ),
        Scheme(
            "kahan-li-8", "8", "17 substeps", palindrome(_KAHAN_LI_8), "1e-24", reference=_OF_KAHAN
        ),
        Scheme(
            "suzuki-umeno-8",
            "8",
            "15 substeps",
            palindrome(_SUZUKI_UMENO_8),
            "1e-38",
            reference="M. Suzuki, K. Umeno (1993); R. McLachlan (1995)",
        ),
        Scheme(
            "sofroniou-10",
            "10",
            "35 substeps",
            palindrome(_SOFRONIOU_10),
            "1e-29",
            reference="M. Sofroniou, G. Spaletta, Optim. Methods Softw. 20 (2005)",
        ),
    )
}
OTHER_NAMES: Mapping[str, str] = {
    "yoshida-4": "triple-jump",
    "forest-ruth": "triple-jump",
    "yoshida": "yoshida-6, yoshida-8, or triple-jump for order 4",
    "kahan-li": "kahan-li-6 or kahan-li-8",
    "mclachlan-8": "suzuki-umeno-8",
    "symmetrized": "strang",
    "suzuki-4": "suzuki",
    "suzuki-fractal": "suzuki",
    "verlet": "strang",
}


FlowText: TypeAlias = tuple[int, str]
"""A part of the problem, from 0, and the fraction of the step for which it flows."""


class Splitting(Frozen):
    """A splitting by name; ``order`` is with exact flows. ``flows`` are for a number of parts, any
    if ``terms`` is 0.
    """

    name: str
    order: str
    summary: str
    flows: Callable[[int], tuple[FlowText, ...]]
    terms: int = 0
    tolerance: str = ""
    reference: str = ""


def _strang_flows(terms: int) -> tuple[FlowText, ...]:
    there = [(l, "1/2") for l in range(terms - 1)]
    return (*there, (terms - 1, "1"), *reversed(there))


def alternating(a: Sequence[str], b: Sequence[str]) -> tuple[FlowText, ...]:
    """Alternates part 1 for a_1 and part 2 for b_1, part 1 for a_2, …; b may be one shorter."""
    flows: list[FlowText] = []
    for i, text in enumerate(a):
        flows.append((0, text))
        if i < len(b):
            flows.append((1, b[i]))
    return tuple(flows)


def _two(a: Sequence[str], b: Sequence[str]) -> Callable[[int], tuple[FlowText, ...]]:
    flows = alternating(a, b)
    return lambda _: flows


def _mirrored(half: Sequence[str], count: int) -> tuple[str, ...]:
    """A palindrome of ``count`` texts with sum 1; the middle ones are determined."""
    total = " + ".join(f"({x})" for x in half)
    if count % 2:
        return (*half, f"1 - 2*({total})", *reversed(half))
    rest = f"1/2 - ({total})"
    return (*half, rest, rest, *reversed(half))


_OF_BLANES = "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002)"
_S6 = (
    _mirrored(("0.0792036964311957", "0.353172906049774", "-0.0420650803577195"), 7),
    _mirrored(("0.209515106613362", "-0.143851773179818"), 6),
)
_S10 = (
    _mirrored(
        (
            "0.0502627644003922",
            "0.413514300428344",
            "0.0450798897943977",
            "-0.188054853819569",
            "0.541960678450780",
        ),
        11,
    ),
    _mirrored(
        ("0.148816447901042", "-0.132385865767784", "0.067307604692185", "0.432666402578175"), 10
    ),
)
SPLITTINGS = {
    splitting.name: splitting
    for splitting in (
        Splitting(
            "lie", "1", "each part once", lambda terms: tuple((l, "1") for l in range(terms))
        ),
        Splitting(
            "strang",
            "2",
            "each part but the last for half of the step, and back",
            _strang_flows,
            reference="G. Strang, SIAM J. Numer. Anal. 5 (1968)",
        ),
        Splitting(
            "ruth-3",
            "3",
            "the method of order 3, three flows each",
            _two(("1", "-2/3", "2/3"), ("-1/24", "3/4", "7/24")),
            2,
            reference="R. Ruth, IEEE Trans. Nucl. Sci. 30 (1983)",
        ),
        Splitting(
            "blanes-moan-4", "4", "13 flows, small error", _two(*_S6), 2, "1e-14", _OF_BLANES
        ),
        Splitting(
            "blanes-moan-6", "6", "21 flows, small error", _two(*_S10), 2, "1e-14", _OF_BLANES
        ),
    )
}
