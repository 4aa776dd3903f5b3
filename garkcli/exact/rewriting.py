"""Measures, substitutes and writes expressions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import ClassVar, NamedTuple

from flint import fmpq

from garkcli.errors import LimitExceeded, UndefinedValue, did_you_mean, nearest
from garkcli.exact import nodes
from garkcli.exact.expression import INDEX_OF_ROOT
from garkcli.exact.letters import letter_of
from garkcli.exact.nodes import parts
from garkcli.frozen import replace

MAX_SIZE = 2_000


def size_of(expression: nodes.Expression, sizes: Mapping[str, int]) -> int:
    if isinstance(expression, nodes.Name):
        return sizes.get(expression.name, 1)
    return 1 + sum(size_of(x, sizes) for x in parts(expression))


def check_size(size: int, text: str) -> None:
    """Raises LimitExceeded for too many operations in ``text``."""
    if size > MAX_SIZE:
        message = f"more than {MAX_SIZE} operations, with the parameters written out"
        raise LimitExceeded(message, "write it shorter", 0, len(text))


class Expanded(NamedTuple):
    expression: nodes.Expression
    size: int = 1
    depth: int = 1


def expanded(
    expression: nodes.Expression, values: Mapping[str, Expanded], used: set[str] | None = None
) -> Expanded:
    """Replaces names by values, noted in ``used``; UndefinedValue for a name without one."""

    def of(inner: nodes.Expression) -> Expanded:
        return expanded(inner, values, used)

    match expression:
        case nodes.Literal():
            return Expanded(expression)
        case nodes.Name(name=name):
            if used is not None:
                used.add(name)
            if name not in values:
                raise _unknown_name(expression, values)
            return values[name]
        case nodes.Chain(operands=operands):
            inside = list(map(of, operands))
            made: nodes.Expression = replace(
                expression, operands=tuple(x.expression for x in inside)
            )
        case nodes.Power(base=base):
            inside = [of(base)]
            made = replace(expression, base=inside[0].expression)
        case nodes.RealPower(base=base, exponent=exponent):
            inside = [of(base), of(exponent)]
            made = replace(expression, base=inside[0].expression, exponent=inside[1].expression)
        case nodes.Root(radicand=radicand):
            inside = [of(radicand)]
            made = replace(expression, radicand=inside[0].expression)
        case nodes.Call(argument=argument):
            inside = [of(argument)]
            made = replace(expression, argument=inside[0].expression)
        case _:
            return Expanded(expression)
    size, depth = 1, 1
    for x in inside:
        size, depth = size + x.size, max(depth, 1 + x.depth)
    return Expanded(made, size, depth)


def names_in(expression: nodes.Expression) -> Iterator[nodes.Name]:
    if isinstance(expression, nodes.Name):
        yield expression
    for part in parts(expression):
        yield from names_in(part)


def substitute(
    expression: nodes.Expression, values: Mapping[str, nodes.Expression]
) -> nodes.Expression:
    return expanded(expression, {name: Expanded(x) for name, x in values.items()}).expression


def _unknown_name(name: nodes.Name, values: Mapping[str, object]) -> UndefinedValue:
    cure = did_you_mean(name.name, values) if values else ""
    meant = nearest(name.name, values)
    if not cure.startswith("did"):
        cure = (
            f"define it, before its use: parameters: {{{name.name}: 1/2}}, or"
            f" {{{name.name}: free}} for gark design"
        )
    message = f"{name.name!r} is not a parameter"
    place = name.start, name.end
    return UndefinedValue(message, cure, *place, code="unknown-name", meant=meant)


def roots_in(expression: nodes.Expression) -> Iterator[nodes.Root | nodes.AlgebraicRoot]:
    for part in parts(expression):
        yield from roots_in(part)
    if isinstance(expression, (nodes.Root, nodes.AlgebraicRoot)):
        yield expression


def format_expression(expression: nodes.Expression, latex: bool = False) -> str:
    """The expression as LaTeX, or as text that ``parse`` or ``parse_formula`` reads.

    >>> from garkcli.exact.expression import parse
    >>> format_expression(parse("1/2 - sqrt(3)/6"))
    '1/2-(sqrt(3)/6)'
    """
    writer = _Latex() if latex else PlainText()
    return writer.written(expression)


class PlainText:
    """Writes expressions in the grammar of ``parse``; roots with letters as these."""

    is_latex: ClassVar[bool] = False

    def written(self, expression: nodes.Expression) -> str:
        match expression:
            case nodes.Literal(value=value):
                return (
                    self.decimal(expression) if nodes.is_decimal(expression) else self.number(value)
                )
            case nodes.Name(name=name):
                return self.name(name)
            case nodes.Chain():
                return self.chain(expression)
            case nodes.Power(base=base, exponent=exponent):
                return self.power(self.tight(base), exponent)
            case nodes.RealPower(base=base, exponent=real):
                return self.real_power(self.tight(base), self.written(real))
            case nodes.Call(function=function, argument=argument):
                return self.call(function, self.written(argument))
            case nodes.Root(radicand=radicand, index=index):
                return self.root(self.written(radicand), index)
            case nodes.AlgebraicRoot():
                return letter_of(expression, self.is_latex) or self.algebraic(expression)
        raise TypeError(f"no expression: {expression!r}")

    def chain(self, chain: nodes.Chain) -> str:
        is_product = chain.signs[0] in "*/"
        parts = []
        for sign, operand in zip(chain.signs, chain.operands, strict=True):
            binds = is_product or sign == "-"
            parts.append(sign + (self.tight(operand) if binds else self.written(operand)))
        return "".join(parts).removeprefix("+").removeprefix("*")

    def tight(self, expression: nodes.Expression) -> str:
        text = self.written(expression)
        is_whole_number = isinstance(expression, nodes.Literal) and text.isdigit()
        if is_whole_number or isinstance(
            expression, (nodes.Name, nodes.Root, nodes.AlgebraicRoot, nodes.Call)
        ):
            return text
        return f"({text})"

    def name(self, name: str) -> str:
        return name

    def number(self, value: fmpq) -> str:
        return str(value)

    def decimal(self, literal: nodes.Literal) -> str:
        return self.number(literal.value)

    def power(self, base: str, exponent: int) -> str:
        return f"{base}**{exponent}"

    def real_power(self, base: str, exponent: str) -> str:
        return f"{base}**({exponent})"

    def call(self, function: str, argument: str) -> str:
        return f"{function}({argument})"

    def root(self, radicand: str, index: int) -> str:
        for name, named in INDEX_OF_ROOT.items():
            if named == index:
                return f"{name}({radicand})"
        return f"root({radicand}, {index})"

    def algebraic(self, root: nodes.AlgebraicRoot) -> str:
        from garkcli.exact.root_of import approximate

        return f"root_of({self.polynomial(root)}, {approximate(root)})"

    def polynomial(self, root: nodes.AlgebraicRoot) -> str:
        text = ""
        for k, a in reversed(list(enumerate(root.coefficients))):
            if a:
                sign = "-" if a < 0 else "+"
                text += sign + self.monomial(abs(a), k)
        return text.removeprefix("+")

    def monomial(self, a: int, k: int) -> str:
        if k == 0:
            return str(a)
        power = "x" if k == 1 else self.power("x", k)
        return power if a == 1 else self.multiple(a, power)

    def multiple(self, a: int, power: str) -> str:
        return f"{a}*{power}"


_GREEK = {
    *("alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta"),
    *("iota", "kappa", "lambda", "mu", "nu", "xi", "pi", "rho", "sigma"),
    *("tau", "upsilon", "phi", "chi", "psi", "omega"),
}


def name_latex(name: str) -> str:
    """The LaTeX of a parameter: a21 is an a with indices."""
    letters = name.rstrip("0123456789_")
    index = name[len(letters) :].strip("_").replace("_", ",")
    head = letters.replace("_", r"\_")
    if head in _GREEK:
        head = f"\\{head} "
    elif len(head) > 1:
        head = rf"\mathrm{{{head}}}"
    return f"{head.strip()}_{{{index}}}" if index else head


def _is_sum(expression: nodes.Expression) -> bool:
    return (
        isinstance(expression, nodes.Chain)
        and expression.signs[0] in "+-"
        and expression.signs != "-"
    )


def decimal_latex(text: str) -> str:
    mantissa, _, exponent = text.partition("e")
    return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa


class _Latex(PlainText):
    r"""Products have no signs, quotients are fractions.

    >>> from garkcli.exact.expression import parse
    >>> texts = "1/2 - 3*sqrt(154)/77", "1/2*x", "-1/120*z^5", "-2*a12_31*(-x^2 + tau)"
    >>> for text in (*texts, "-(-2*(3/4))/x", "-0.25*x - 1e-9"):
    ...     print(format_expression(parse(text), latex=True))
    \frac{1}{2}-\frac{3\sqrt{154}}{77}
    \frac{x}{2}
    -\frac{z^{5}}{120}
    -2a_{12,31}\left(-x^{2}+\tau \right)
    -\frac{\left(-2\cdot \frac{3}{4}\right)}{x}
    -0.25x-1 \cdot 10^{-9}
    """

    is_latex = True

    def name(self, name: str) -> str:
        return name_latex(name)

    def chain(self, chain: nodes.Chain) -> str:
        if chain.signs[0] in "+-":
            first, *others = chain.operands
            start = self.written(first) if chain.signs[0] == "+" else "-" + self.factor(first)
            rest = zip(chain.signs[1:], map(self.factor, others), strict=True)
            return start + "".join(sign + text for sign, text in rest)
        over = [x for sign, x in zip(chain.signs, chain.operands, strict=True) if sign == "*"]
        under = [x for sign, x in zip(chain.signs, chain.operands, strict=True) if sign == "/"]
        top = self.product(over)
        if not under:
            return top
        minus = "-" * (top.startswith("-") and not _is_sum(over[0]))
        return rf"{minus}\frac{{{top.removeprefix(minus)}}}{{{self.product(under)}}}"

    def product(self, factors: list[nodes.Expression]) -> str:
        if len(factors) == 1:
            return self.written(factors[0])
        text = ""
        for expression in factors:
            if isinstance(expression, nodes.Literal) and expression.value == 1:
                continue
            is_first = not text and not _is_sum(expression)
            factor = self.written(expression) if is_first else self.factor(expression)
            if factor == "-1":
                factor = "-"
            is_apart = text[-1:].isdigit() and (factor[0].isdigit() or factor.startswith(r"\frac"))
            text += (r"\cdot " if is_apart else "") + factor
        return f"{text}1" if text in {"", "-"} else text

    def factor(self, expression: nodes.Expression) -> str:
        text = self.written(expression)
        is_whole = not text.startswith("-") and not _is_sum(expression)
        return text if is_whole else rf"\left({text}\right)"

    def tight(self, expression: nodes.Expression) -> str:
        text = super().tight(expression)
        return rf"\left{text[:-1]}\right)" if text.startswith("(") else text

    def number(self, value: fmpq) -> str:
        if value.q == 1:
            return str(value)
        sign = "-" if value < 0 else ""
        numerator = abs(value.p)
        return f"{sign}\\frac{{{numerator}}}{{{value.q}}}"

    def decimal(self, literal: nodes.Literal) -> str:
        # a literal behind a minus has its digits alone as text
        sign = "-" if literal.value < 0 and not literal.text.startswith("-") else ""
        return sign + decimal_latex(literal.text)

    def power(self, base: str, exponent: int) -> str:
        return f"{base}^{{{exponent}}}"

    def real_power(self, base: str, exponent: str) -> str:
        return f"{base}^{{{exponent}}}"

    def call(self, function: str, argument: str) -> str:
        return f"\\{function}\\left({argument}\\right)"

    def root(self, radicand: str, index: int) -> str:
        degree = "" if index == 2 else f"[{index}]"
        return f"\\sqrt{degree}{{{radicand}}}"

    def algebraic(self, root: nodes.AlgebraicRoot) -> str:
        from garkcli.exact.root_of import approximate

        shown = f"{self.polynomial(root)}, x\\approx {approximate(root)}"
        return f"\\operatorname{{root}}\\left({shown}\\right)"

    def multiple(self, a: int, power: str) -> str:
        return f"{a}{power}"
