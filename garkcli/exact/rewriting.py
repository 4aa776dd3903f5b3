"""What is done with an expression short of evaluating it: measuring, substituting, writing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from garkcli.errors import UndefinedValue, did_you_mean
from garkcli.exact.expression import INDEX_OF_ROOT, Chain, Expression, Literal, Name, Power, Root
from garkcli.exact.formula import Call, RealPower


def size_of(expression: Expression, sizes: Mapping[str, int]) -> int:
    """How many nodes ``expression`` has, each name counting for what it stands for (1 if it is not
    known).
    """
    if isinstance(expression, Name):
        return sizes.get(expression.name, 1)
    return 1 + sum(size_of(x, sizes) for x in parts(expression))


def depth_of(expression: Expression, depths: Mapping[str, int]) -> int:
    """How deep ``expression`` is nested, each name as deep as what it stands for (1 if it is not
    known).
    """
    if isinstance(expression, Name):
        return depths.get(expression.name, 1)
    return 1 + max((depth_of(x, depths) for x in parts(expression)), default=0)


def parts(expression: Expression) -> tuple[Expression, ...]:
    """The expressions that ``expression`` is made of."""
    match expression:
        case Chain(operands=operands):
            return operands
        case Power(base=base):
            return (base,)
        case RealPower(base=base, exponent=exponent):
            return (base, exponent)
        case Root(radicand=radicand):
            return (radicand,)
        case Call(argument=argument):
            return (argument,)
    return ()


def names_in(expression: Expression) -> Iterator[Name]:
    """Every name in ``expression``, in the order of the text."""
    if isinstance(expression, Name):
        yield expression
    for part in parts(expression):
        yield from names_in(part)


def substitute(expression: Expression, values: Mapping[str, Expression]) -> Expression:
    """``expression`` with each name replaced by its value; offsets stay those of ``expression``.

    Raises:
        UndefinedValue: a name has no value.
    """
    match expression:
        case Name(name=name):
            if name not in values:
                near = did_you_mean(name, values) if values else ""
                cure = (
                    near
                    if near.startswith("did")
                    else f"define it, before its use: parameters: {{{name}: 1/2}}"
                )
                raise UndefinedValue(
                    f"{name!r} is not a parameter",
                    cure,
                    expression.start,
                    expression.end,
                )
            return values[name]
        case Chain(operands=operands):
            return replace(expression, operands=tuple(substitute(x, values) for x in operands))
        case Power(base=base):
            return replace(expression, base=substitute(base, values))
        case RealPower(base=base, exponent=exponent):
            return replace(
                expression, base=substitute(base, values), exponent=substitute(exponent, values)
            )
        case Root(radicand=radicand):
            return replace(expression, radicand=substitute(radicand, values))
        case Call(argument=argument):
            return replace(expression, argument=substitute(argument, values))
    return expression


def roots_in(expression: Expression) -> Iterator[Root]:
    """Every root in ``expression``, the inner ones first."""
    for part in parts(expression):
        yield from roots_in(part)
    if isinstance(expression, Root):
        yield expression


def format_expression(expression: Expression, latex: bool = False) -> str:
    """The expression as text that ``parse`` (with functions: ``parse_formula``) reads again, or as
    LaTeX.
    """
    match expression:
        case Literal(value=value):
            if latex and value.q != 1:
                return f"{'-' if value < 0 else ''}\\frac{{{abs(value.p)}}}{{{value.q}}}"
            return str(value)
        case Name(name=name):
            return name
        case Chain(signs=signs, operands=operands):
            parts = [
                sign + _bracketed(x, signs[0] in "*/" or sign == "-", latex)
                for sign, x in zip(signs, operands, strict=True)
            ]
            return "".join(parts).removeprefix("+").removeprefix("*")
        case Power(base=base, exponent=exponent):
            text = _bracketed(base, True, latex)
            return f"{text}^{{{exponent}}}" if latex else f"{text}**{exponent}"
        case RealPower(base=base, exponent=exponent):
            text, power = _bracketed(base, True, latex), format_expression(exponent, latex)
            return f"{text}^{{{power}}}" if latex else f"{text}**({power})"
        case Call(function=function, argument=argument):
            inner = format_expression(argument, latex)
            return f"\\{function}\\left({inner}\\right)" if latex else f"{function}({inner})"
        case Root(radicand=radicand, index=index):
            inner = format_expression(radicand, latex)
            if latex:
                return f"\\sqrt{{{inner}}}" if index == 2 else f"\\sqrt[{index}]{{{inner}}}"
            names = {n: name for name, n in INDEX_OF_ROOT.items()}
            return f"{names[index]}({inner})" if index in names else f"root({inner}, {index})"
    raise TypeError(f"no expression: {expression!r}")


def _bracketed(expression: Expression, tight: bool, latex: bool) -> str:
    text = format_expression(expression, latex)
    simple = isinstance(expression, (Name, Root, Call)) or (
        isinstance(expression, Literal) and text.isdigit()
    )
    loose = isinstance(expression, Chain) or not simple
    return f"({text})" if loose and tight else text
