"""The meaning of names of arrays: matrix, weights, nodes, and which of them belong together."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import lru_cache

from garkcli.sources.values import Value, is_matrix, items_of, near

_WORDS: Mapping[str, tuple[str, ...]] = {
    "A": (
        "A",
        "a",
        "Amat",
        "amat",
        "beta",
        "β",
        "a_lower",
        "A_matrix",
        "aCoefficients",
        "AA",
        "aa",
    ),
    "b": (
        *("b", "B", "w", "bvec", "b_sol", "bsol"),
        *("c_sol", "weights", "α", "b_vec", "bCoefficients", "b_high", "b_high_order", "bb"),
    ),
    "c": ("c", "C", "cvec", "nodes", "alpha", "c_vec", "abscissae", "cCoefficients", "cc"),
    "embedded": (
        *("bhat", "b_hat", "bh", "bembed", "bstar", "b_star", "btilde"),
        *("b_tilde", "b_embedded", "bemb", "b_err_weights", "b_low_order"),
        *("embedded", "b2", "bhat_vec", "d", "αEEst", "alphaEEst", "b̂"),
        *("bEEst", "α̂", "b_low", "b_lower", "beta_star", "bt", "be"),
    ),
    "error": ("E", "e", "evec", "b_error", "b_err", "berr", "c_error", "err"),
    "dense": ("P", "dense", "binterp", "binterpt"),
    "order": ("order", "ORDER", "q", "ord", "DifferenceOrder", "order_b"),
    "embedded_order": (
        *("embedded_order", "error_estimator_order", "p", "Q", "adaptiveorder"),
        *("order_embedded", "embeddedOrder", "orderhat", "EmbeddedDifferenceOrder", "order_bt"),
    ),
    "lower_order": ("lowerOrder", "lower_order"),
    "higher_order": ("higherOrder", "higher_order"),
    **{x: (x, x.replace("gamma", "γ")) for x in ("gamma1", "gamma2", "gamma3")},
    "delta": ("delta", "δ"),
    "gamma": ("gamma",),
    "A_q": ("Abar", "abar", "A_bar", "a_bar", "Ā", "matrix_bar"),
    "b_q": ("bbar", "b_bar", "b̄", "weights_bar"),
    "A1": ("A_hat", "a_hat", "Ahat", "ahat", "Â"),
    "c1": ("c_hat", "chat", "ĉ"),
    "drifts": ("a_type",),
    "kicks": ("b_type",),
    "stages": ("stages", "s", "n_stages", "nstages"),
    "title": ("name", "title"),
    "fsal": ("fsal", "FSAL", "is_fsal"),
}
_ROLES = {word: role for role, words in _WORDS.items() for word in words}


def _spellings(word: str) -> Iterator[str]:
    """A word as it is, with capitals for its underscores, with a capital, and in capitals."""
    for spelling in (word, re.sub(r"_(\w)", lambda x: x[1].upper(), word)):
        yield from (spelling, spelling[0].upper() + spelling[1:]) if len(word) > 1 else (word,)
    if len(word) > SHORT:
        yield word.upper()


SHORT = 3
"""Letters of words that are not names of the same arrays in capitals."""
ROLES = {x: role for word, role in _ROLES.items() for x in _spellings(word)} | _ROLES
"""The role of each name, also in the spellings of constants and of Go, C# and Java; if several
names have a role, the first one counts.
"""
_PREFIX = re.compile(r"(?P<word>[AaBbCcEedw]|err|bhat|bh|Amat|bembed|order)_(?P<stem>\w+)")
_ESTIMATES = "|".join([*_WORDS["embedded"], *_WORDS["error"]])
_SUFFIX = re.compile(
    rf"(?P<stem>\w+?)_(?P<word>A|a|b|B|c|C|w|order|ORDER|{_ESTIMATES}"
    r"|embedded_order|dense|nodes|weights|stages|fsal|name|[ab]_type)"
)
_DIGIT = re.compile(r"(?P<stem>\w*[A-Za-z]\w*[0-9])(?P<word>[Aabc]|[Abc]_hat)")
"""``rk4a``, ``lsrk54b``, ``ars222A_hat``."""
_METHODS = re.compile(
    r"runge|kutta|butcher|tableau|(?<![a-z])i?e?rk(?![a-z]{2})|rk\d|ssp(?:rk)?(?![a-z])|dirk|dopri|dormand"
    r"|rosenbrock|\bros\d|rodas|rock\d|ralston|heun(?![a-z])|fehlberg|merson|mclachlan|yoshida"
    r"|low.?storage|symplectic|leapfrog|adams|(?<![a-z])ode\d|multistep|exponential.integrator"
    r"|(?<![^\W_])a_?[23]1(?!\w)|imex|imkg|rkf(?![a-z])|(?-i:AR[KS]_?\d)|cash.?karp|verner|gauss.?legendre"
    r"|radau|lobatto|tsit5|magnus",
    re.IGNORECASE,
)
"""Words for methods."""
_LIKE_METHODS = re.compile(
    r"runge|kutta|butcher|tableau|rk(?![a-z]{2})|ssp(?:rk)?(?![a-z])|dirk|dopri|dormand|ros\d"
    r"|rosenbrock|rodas|rock\d|ralston|heun(?![a-z])|fehlberg|merson|mclachlan|yoshida|low.?storage"
    r"|symplectic|leapfrog|adams|ode\d|multistep|exponential.integrator|a_?[23]1(?!\w)|imex|imkg"
    r"|ar[ks]_?\d|cash.?karp|verner|gauss.?legendre|radau|lobatto|tsit5|magnus"
)
"""These and further words in lower case; each begins with a letter, for a fast search."""
_LONGEST_BEFORE = 2
"""Most letters of a word before such a match: ``ierk``."""


def speaks(text: str) -> bool:
    """Whether a text contains a word for a method.

    >>> speaks("class Heun(Solver)"), speaks("in parking, work.")
    (True, False)
    """
    small = text.lower()
    if len(small) != len(text):
        return _METHODS.search(text) is not None
    starts = (found.start() for found in _LIKE_METHODS.finditer(small))
    places = (range(max(0, at - _LONGEST_BEFORE), at + 1) for at in starts)
    return any(_METHODS.match(text, at) for each in places for at in each)


MAX_NAME = 200
_WORD = r"(?P<word>butcher|matrix|weights|nodes|[abcw]|b_?hat|b_?embed|order)"
_WHICH = r"(?P<part>e(?:x(?:p|pl|plicit)?)?|i(?:m(?:p|pl|plicit)?)?)"
_PARTS = (
    re.compile(rf"{_WORD}_?{_WHICH}(?:_tableau)?", re.IGNORECASE),
    re.compile(rf"{_WHICH}_{_WORD}", re.IGNORECASE),
)
_ANY_PART = {"matrix": "A", "weights": "b", "nodes": "c", "order": "order"}
"""Names of arrays for both parts, beside those for one."""
_PAIR = {"A": "A1", "H": "A2", "c": "c"}
"""Names in the classes of Dedalus, where the last rows are the weights."""


@lru_cache(maxsize=10_000)
def role_of(name: str) -> tuple[str, str] | None:
    """The stem and the role of a name; None if it has no role.

    >>> role_of("rk4_A"), role_of("b_heun"), role_of("bhat"), role_of("velocity")
    (('rk4', 'A'), ('heun', 'b'), ('', 'embedded'), None)
    >>> role_of("rk4a"), role_of("dp_e"), role_of("dp_b_err")
    (('rk4', 'A'), ('dp', 'error'), ('dp', 'error'))
    """
    # d_A is on the device
    plain = name[2:] if name.startswith("d_") and name[2:] in ROLES else name
    if plain in ROLES:
        return "", ROLES[plain]
    if len(name) > MAX_NAME:
        return None
    for pattern in (_DIGIT, _SUFFIX, _PREFIX):
        match = pattern.fullmatch(name)
        if match:
            return match["stem"], ROLES[match["word"]]
    return None


def role_of_part(name: str) -> str:
    """The role of an array of an explicit part, 1, or of an implicit one, 2; empty if its name has
    none.

    >>> role_of_part("a_exp"), role_of_part("bhatim"), role_of_part("exp")
    ('A1', 'embedded2', '')
    """
    match = next(filter(None, (x.fullmatch(name) for x in _PARTS)), None)
    if match is None:
        return ""
    word = match["word"].lower()
    role = "A" if word == "butcher" else {**_ANY_PART, **ROLES}.get(word, "embedded")
    return role + "21"[match["part"].lower().startswith("e")]


def roles_of_parts(values: Mapping[str, Value]) -> Mapping[str, str]:
    """The names of the arrays of two parts, with their roles; empty without two matrices."""
    by_name = {name: role for name in values if (role := role_of_part(name))}
    if by_name:
        shared = _ANY_PART | ({"b": "b", "c": "c"} if "b" in values else {})
        by_name |= {name: role for name, role in shared.items() if name in values}
    elif "b" not in values and near(*items_of(values.get("c"))[-1:]) == 1:
        by_name = {name: role for name, role in _PAIR.items() if name in values}
    matrices = {role: values[name] for name, role in by_name.items() if role[0] == "A"}
    are_two = len(matrices) > 1 and all(map(is_matrix, matrices.values()))
    return by_name if are_two else {}
