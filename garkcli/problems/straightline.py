"""Straight-line Python for sympy expressions, in floats or in balls of any precision. All names in
the text are made here, so that no text of a file is part of a program.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from itertools import count
from typing import Any

from flint import arb, fmpq

from garkcli.exact import formula
from garkcli.frozen import Frozen
from garkcli.problems.deferred import Deferred, ask
from garkcli.problems.expr import Expr, Vector, number

_LONG = 300  # characters from which a part of an expression is given a name
_WRITTEN = 3  # powers up to the third are products, which cost less than **
_NAMES = (*formula.FUNCTIONS, "sqrt")
FUNCTIONS = frozenset(_NAMES)
"""The functions that an expression may have, besides powers."""
FLOATS: Mapping[str, Any] = {
    **{name: getattr(math, name) for name in _NAMES},
    "power": math.pow,  # refuses what ** would make complex
    "inf": math.inf,
    "isfinite": math.isfinite,
}
BALLS: Mapping[str, Any] = {
    **{f"ball_{name}": getattr(arb, name) for name in _NAMES},
    "ball_power": pow,
    "ball_pi": arb.pi,
    "ball_zero": arb(0),
}
"""The names in programs for balls, different from those for floats."""


class StraightLineCode(Frozen):
    """Texts of temporaries, each made of those before, and of results. They have ``{a0}``, … for
    arguments, ``{t0}``, … for temporaries, ``{k0}``, … for ``constants``, where None is π.
    """

    arguments: int
    temporaries: tuple[str, ...]
    results: tuple[str, ...]
    constants: tuple[fmpq | None, ...]
    is_for_balls: bool

    def lines(self, arguments: Sequence[str], prefix: str) -> tuple[list[str], list[str]]:
        names: dict[str, str] = {f"a{i}": name for i, name in enumerate(arguments)}
        for i in range(len(self.temporaries)):
            names[f"t{i}"] = f"{prefix}t{i}"
        for i, x in enumerate(self.constants):
            names[f"k{i}"] = self._constant(x)

        lines = []
        for i, text in enumerate(self.temporaries):
            made = text.format_map(names)
            lines.append(f"{prefix}t{i} = {made}")
        results = []
        for i, text in enumerate(self.results):
            made = text.format_map(names)
            if not _is_one_name(text):
                lines.append(f"{prefix}{i} = {made}")
                made = f"{prefix}{i}"
            results.append(made)
        return lines, results

    def _constant(self, x: fmpq | None) -> str:
        if not self.is_for_balls:
            return repr(math.pi) if x is None else _float(x)
        if x is None:
            return "ball_pi()"
        return constant_name(x)


def _is_one_name(text: str) -> bool:
    if text == "0":
        return True
    is_enclosed = text.startswith("{") and text.endswith("}")
    return is_enclosed and text.count("{") == 1


def _float(x: fmpq) -> str:
    try:
        return repr(int(x.p) / int(x.q))
    except OverflowError:
        return "inf" if x > 0 else "-inf"


def constant_name(x: fmpq) -> str:
    sign = "m" if x < 0 else ""
    p = abs(int(x.p))
    q = int(x.q)
    # hexadecimal: Python writes no more than 4300 decimal digits
    return f"k{sign}{p:x}_{q:x}"


@cache
def code_of(expressions: Vector, arguments: Vector, is_for_balls: bool) -> StraightLineCode:
    """Raises TypeError for a function outside of ``FUNCTIONS`` or another symbol."""
    if not (isinstance(expressions, Deferred) and isinstance(arguments, Deferred)):
        return _written(expressions, arguments, is_for_balls)
    kind = "balls" if is_for_balls else "floats"
    made = ask(
        expressions,
        f"{kind} of {arguments.name}",
        lambda: _spelled_out(_written(expressions, arguments, is_for_balls)),
    )
    return StraightLineCode(
        len(arguments),
        tuple(made["temporaries"]),
        tuple(made["results"]),
        tuple(None if x == "pi" else fmpq(x) for x in made["constants"]),
        is_for_balls,
    )


def _spelled_out(code: StraightLineCode) -> dict[str, list[str]]:
    """A code as JSON, without the parts that its name determines."""
    return {
        "temporaries": list(code.temporaries),
        "results": list(code.results),
        "constants": ["pi" if x is None else str(x) for x in code.constants],
    }


def _written(expressions: Vector, arguments: Vector, is_for_balls: bool) -> StraightLineCode:
    import sympy

    shared, reduced = sympy.cse(list(expressions), symbols=(sympy.Dummy(f"t{i}") for i in count()))
    writer = _Writer({x: f"{{a{i}}}" for i, x in enumerate(arguments)}, is_for_balls)
    for symbol, expression in shared:
        writer.symbols[symbol] = writer.named(writer.text(expression))
    results = ["0" if x == 0 else writer.text(x) for x in reduced]
    return StraightLineCode(
        len(arguments),
        tuple(writer.temporaries),
        tuple(results),
        tuple(writer.constants),
        is_for_balls,
    )


class _Writer:
    def __init__(self, symbols: dict[Expr, str], is_for_balls: bool) -> None:
        self.symbols = symbols
        self.constants: dict[fmpq | None, str] = {}
        self.temporaries: list[str] = []
        self.is_for_balls = is_for_balls

    def named(self, text: str) -> str:
        """A temporary for a text, or the text itself if it is one name."""
        if text.startswith("{"):
            return text
        self.temporaries.append(text)
        return f"{{t{len(self.temporaries) - 1}}}"

    def text(self, x: Expr) -> str:
        text = self._text(x)
        if len(text) < _LONG:
            return text
        return self.named(text)  # Python nests no more than 200 deep

    def _text(self, x: Expr) -> str:
        import sympy

        if x.is_Symbol:
            if x not in self.symbols:
                raise TypeError(f"{x} is no argument")
            return self.symbols[x]
        if x.is_Rational:
            return self._constant(number(x))
        if x is sympy.pi:
            return self._constant(None)
        if x is sympy.E:
            exp = self._name("exp")
            return f"{exp}({self._constant(fmpq(1))})"
        if x.is_Add:
            return f"({self._sum(x.as_ordered_terms())})"
        if x.is_Mul:
            return f"({self._product(x)})"
        if x.is_Pow:
            return self._power(x.base, x.exp)
        name = type(x).__name__
        if name in FUNCTIONS and len(x.args) == 1:
            return f"{self._name(name)}({self.text(x.args[0])})"
        raise TypeError(f"no code for {name}")

    def _name(self, function: str) -> str:
        return f"ball_{function}" if self.is_for_balls else function

    def _constant(self, x: fmpq | None) -> str:
        return self.constants.setdefault(x, f"{{k{len(self.constants)}}}")

    def _sum(self, terms: Vector) -> str:
        made = ""
        for term in sorted(terms, key=lambda x: x.could_extract_minus_sign()):
            if not made:
                made = self.text(term)
            elif term.could_extract_minus_sign():
                made += f" - {self.text(-term)}"
            else:
                made += f" + {self.text(term)}"
        return made

    def _product(self, x: Expr) -> str:
        """Factors over factors, so that a negative power costs one division."""
        above, below = [], []
        for factor in x.as_ordered_factors():
            if factor.is_Pow and _is_negative(factor.exp):
                below.append(self._power(factor.base, -factor.exp))
            else:
                above.append(factor)
        sign = ""
        if above and above[0].is_Rational and above[0] == -1:
            sign = "-"
            above = above[1:]
        texts = [self.text(factor) for factor in above]
        numerator = "*".join(texts) if texts else self._constant(fmpq(1))
        return sign + "/".join([numerator, *below])

    def _power(self, base: Expr, exponent: Expr) -> str:
        if _is_negative(exponent):
            return f"({self._constant(fmpq(1))}/{self._power(base, -exponent)})"
        text = self.text(base)
        if not exponent.is_Rational or exponent.q > 2:
            power = self._name("power")
            return f"{power}({text}, {self.text(exponent)})"
        if exponent.q == 1:
            return self._integer_power(self.named(text), int(exponent.p))
        # x^(n + 1/2) is x^n √x
        whole = int(exponent.p) // 2
        sqrt = self._name("sqrt")
        if not whole:
            return f"{sqrt}({text})"
        name = self.named(text)
        power = self._integer_power(name, whole)
        return f"({power}*{sqrt}({name}))"

    def _integer_power(self, text: str, n: int) -> str:
        """A power; for balls by products, as a power of a ball around zero has to be finite."""
        if n == 1:
            return text
        if n <= _WRITTEN:
            factors = "*".join([text] * n)
            return f"({factors})"
        if not self.is_for_balls:
            return f"({text}**{n})"
        half = self.named(self._integer_power(text, n // 2))
        if n % 2:
            return f"({half}*{half}*{text})"
        return f"({half}*{half})"


def _is_negative(exponent: Expr) -> bool:
    return bool(exponent.is_Rational and exponent.is_negative)


def function(
    expressions: Vector, arguments: Vector, is_for_balls: bool
) -> Callable[..., list[Any]]:
    """Compiles expressions to a function; its constants are enclosed at the current precision."""
    code = code_of(expressions, arguments, is_for_balls)
    names = [f"a{i}" for i in range(len(arguments))]
    lines, results = code.lines(names, "r")
    zero = "ball_zero" if is_for_balls else "0.0"
    returned = ", ".join(zero if x == "0" else x for x in results)
    taken = ", ".join(names)
    source = "\n ".join([f"def evaluate({taken}):", *lines, f"return [{returned}]"]) + "\n"
    constants = enclosed([code]) if is_for_balls else {}
    program: Callable[..., list[Any]] = define(source, "evaluate", constants)
    return program


def enclosed(codes: Sequence[StraightLineCode]) -> dict[str, arb]:
    balls = {}
    for code in codes:
        for x in code.constants:
            if code.is_for_balls and x is not None:
                balls[constant_name(x)] = arb(x)
    return balls


def define(source: str, name: str, constants: Mapping[str, Any]) -> Any:
    """The function ``name`` that a text made in this package defines."""
    namespace: dict[str, Any] = {"__builtins__": {}, **_BUILTINS, **FLOATS, **BALLS, **constants}
    exec(_compiled(source), namespace)
    return namespace[name]


_BUILTINS = {
    "abs": abs,
    "float": float,
    "list": list,
    "map": map,
    "range": range,
    "ArithmeticError": ArithmeticError,
    "ValueError": ValueError,
}


@cache
def _compiled(source: str) -> Any:
    return compile(source, "<step of a method>", "exec")
