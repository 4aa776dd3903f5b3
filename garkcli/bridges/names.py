"""Names of methods as identifiers: neither reserved words nor names that the written files use."""

from __future__ import annotations

import re
from collections.abc import Mapping
from keyword import kwlist, softkwlist

from garkcli.errors import printable
from garkcli.page.plaintext import plain_line

LONGEST = 40


def stem_of(name: str) -> str:
    """A name as lower case ASCII letters, digits and single underscores; it begins with a letter.

    Behind ``gark_`` it is an identifier in every language. Letters of other scripts become numbers.

    >>> stem_of("Größe 3.gark.yaml"), stem_of("3/8 rule"), stem_of("中")
    ('grosse_3', 'method_3_8_rule', 'u4e2d')
    """
    plain = plain_line(printable(name)).replace("\u00df", "ss").lower()
    stem = plain.removesuffix(".yaml").removesuffix(".gark")
    words = re.findall("[a-z0-9]+", stem)
    joined = "_".join(words)[:LONGEST].strip("_")
    if not joined:
        return "method"
    return _behind_a_word(joined) if joined[0].isdigit() else joined


def identifier(name: str, language: str) -> str:
    """An identifier of a language, a key of ``RESERVED``.

    >>> identifier("import", "python"), identifier("import", "r"), identifier("end", "matlab")
    ('method_import', 'import', 'method_end')
    """
    stem = stem_of(name)
    return _behind_a_word(stem) if stem in RESERVED[language] else stem


def class_name(name: str, language: str = "python") -> str:
    """The name in capitalized words.

    >>> class_name("Ralston-Euler"), class_name("none"), class_name("3/8 rule")
    ('RalstonEuler', 'MethodNone', 'Method38Rule')
    """
    stem = stem_of(name)
    if _capitalized(stem) in RESERVED[language]:
        stem = _behind_a_word(stem)
    return _capitalized(stem)


def _behind_a_word(stem: str) -> str:
    return f"method_{stem}"[:LONGEST].strip("_")


def _capitalized(stem: str) -> str:
    return "".join(x.capitalize() for x in stem.split("_"))


_WORDS = {
    "cpp": """
    auto break case char const continue default do double else enum extern float for goto if inline
    int long register restrict return short signed sizeof static struct switch typedef union
    unsigned void volatile while asm alignas alignof bool constexpr false nullptr static_assert
    thread_local true typeof typeof_unqual
    errno assert stdin stdout stderr linux unix
    and and_eq bitand bitor catch char8_t char16_t char32_t class co_await co_return co_yield compl
    concept const_cast consteval constinit decltype delete dynamic_cast explicit export friend
    module mutable namespace new noexcept not not_eq operator or or_eq private protected public
    reinterpret_cast requires static_cast template this throw try typeid typename using virtual
    wchar_t xor xor_eq import override final
    array before boost cmath cos cstdio data do_step dt error explicit_error_generic_rk
    explicit_generic_rk field fusion h hpp include k log2 main make_vector mfem n numeric odeint
    once pragma printf problem sin solver sqrt state std stepper steps t y a b c d e e1 e2 f
    """,
    "julia": """
    A C H RodasTableau T T2 Type Vector btilde convert d gamma zeros
    abstract baremodule begin break catch const continue do else elseif end export false finally for
    function global if import in isa let local macro missing module mutable nothing outer primitive
    public quote return struct true try type using where while
    adaptiveorder as b bhat big bs c cs embedded_order fsal im map order pi a reshape sqrt tableau
    """,
    "matlab": """
    arguments break case catch classdef continue do else elseif end endfor endfunction endif
    endparfor endswitch endwhile enumeration events for function global if methods otherwise parfor
    persistent properties return spmd switch try until unwind_protect while
    abs ans b before bhat c cellfun colour columns cos cumsum d dense e embedded_order eps err eye f
    final first fprintf g h i imag inf iscell isempty iteration j k kron l log2 m max n nan norm
    numel order pi repmat reshape rows s sin sqrt step t t_end x y zeros
    all any assert beta cell char class clear clc close diff disp display double errno error exp
    false feval find gamma help hold import int int8 int16 int32 int64 isa length load log logical
    mean min null ode ode113 ode15i ode15s ode23 ode23s ode23t ode23tb ode45 ode78 ode89 ones plot
    prod rand real round run save single size sort std stderr stdin stdout string struct sum system
    table test true uint8 uint16 uint32 uint64 var version what which who why
    """,
    "mathematica": "I Precision",
    "python": """
    AbstractERK AbstractESDIRK AbstractImplicitSolver AbstractRootFinder AbstractRungeKutta
    AbstractTerm ButcherTableau ButcherTableaux CalculateJacobian ClassVar ConstantStepSize
    ExplicitRungeKutta ExplicitRungeKuttaMethod ExplicitRungeKuttaPair LocalLinearInterpolation
    MultiButcherTableau MultiTerm Newton Path Rational RungeKutta RungeKuttaMethod
    ThirdOrderHermitePolynomialInterpolation ThirdOrderPolynomialInterpolation VeryChord
    A B C E H P
    abc array b bhat c dedalus diffrax dtype float importlib int irksome name nodepy np numpy object
    order real_root rootof runge_kutta_method sqrt super sympy tableaux torch torchode tuple x
    """,
    "r": """
    break else for function if in next repeat while
    atol b1 b2 before c cat class cos error f final h hini hmax is length library list log2 n na out
    parms rbind rk rtol run seq sin slope source sprintf sqrt stage sum t times varstep y
    """,
}
RESERVED: Mapping[str, frozenset[str]] = {
    language: frozenset(words.split()).union(*[kwlist, softkwlist] if language == "python" else [])
    for language, words in _WORDS.items()
}
