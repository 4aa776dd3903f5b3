"""What is done with an expression short of evaluating it: measuring, substituting, writing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from garkcli.errors import UndefinedValue, did_you_mean
from garkcli.exact.expression import INDEX_OF_ROOT, Chain, Expression, Literal, Name, Power, Root


def size_of(expression: Expression, sizes: Mapping[str, int]) -> int:
    """How many nodes ``expression`` has, each name counting for what it stands for (1 if it is not known)."""
    match expression:
        case Name(name=name):
            return sizes.get(name, 1)
        case Chain(operands=operands):
            return 1 + sum(size_of(x, sizes) for x in operands)
        case Power(base=base):
            return 1 + size_of(base, sizes)
        case Root(radicand=radicand):
            return 1 + size_of(radicand, sizes)
    return 1


def substitute(expression: Expression, values: Mapping[str, Expression]) -> Expression:
    """``expression`` with each name replaced by its value; offsets stay those of ``expression``.

    Raises:
        UndefinedValue: a name has no value.
    """
    match expression:
        case Name(name=name):
            if name not in values:
                near = did_you_mean(name, values) if values else ""
                cure = near if near.startswith("did") else f"define it, before its use: parameters: {{{name}: 1/2}}"
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
        case Root(radicand=radicand):
            return replace(expression, radicand=substitute(radicand, values))
    return expression


def roots_in(expression: Expression) -> Iterator[Root]:
    """Every root in ``expression``, the inner ones first."""
    match expression:
        case Chain(operands=operands):
            for operand in operands:
                yield from roots_in(operand)
        case Power(base=base):
            yield from roots_in(base)
        case Root(radicand=radicand):
            yield from roots_in(radicand)
            yield expression


def format_expression(expression: Expression, latex: bool = False) -> str:
    """The expression as text that ``parse`` reads again, or as LaTeX."""
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
        case Root(radicand=radicand, index=index):
            inner = format_expression(radicand, latex)
            if latex:
                return f"\\sqrt{{{inner}}}" if index == 2 else f"\\sqrt[{index}]{{{inner}}}"
            names = {n: name for name, n in INDEX_OF_ROOT.items()}
            return f"{names[index]}({inner})" if index in names else f"root({inner}, {index})"
    raise TypeError(f"no expression: {expression!r}")


def _bracketed(expression: Expression, tight: bool, latex: bool) -> str:
    text = format_expression(expression, latex)
    simple = isinstance(expression, (Name, Root)) or (isinstance(expression, Literal) and text.isdigit())
    loose = isinstance(expression, Chain) or not simple
    return f"({text})" if loose and tight else text
