"""The argument of ``--minimise``: a name, or a weighted sum of names, such as 2*A + largest."""

from __future__ import annotations

import re
from typing import TypeAlias

from flint import fmpq

from garkcli.design.minimise import objective as aims
from garkcli.design.minimise.objectives import OBJECTIVES
from garkcli.design.minimise.squared_error import Quotient
from garkcli.errors import ExpressionError, UsageProblem, did_you_mean
from garkcli.exact.expression import parse
from garkcli.exact.nodes import Chain, Expression, Literal, Name
from garkcli.exact.parametric import Parameters

Wanted: TypeAlias = (
    aims.Objective | aims.LevelObjective | aims.SearchMeasure | aims.Either | aims.WeightedSum
)
CURE = "write a name, or a sum such as '2*A + largest' or 'A - ssp/10'"
_KEYS = {key.removeprefix("-"): key for key in OBJECTIVES}
_HYPHENATED = re.compile("|".join(sorted((x for x in _KEYS if "-" in x), key=len, reverse=True)))


def objective_of(text: str) -> Wanted:
    """Raises UsageProblem for a text that is no name or sum of names.

    >>> objective_of("error").key
    'error'
    >>> [(str(weight), x.key) for weight, x in objective_of("2*A - ssp/10").terms]
    [('2', 'A'), ('-1/10', '-ssp')]
    """
    if text in OBJECTIVES:
        return OBJECTIVES[text]
    # a hyphen within a name is no minus sign
    plain = _HYPHENATED.sub(lambda x: x[0].replace("-", "_"), text)
    try:
        form = {name: a for name, a in _linear(parse(plain)).items() if a}
    except ExpressionError as error:
        message = f"what to minimise: {error.message}"
        raise UsageProblem(message, CURE, code="option-value") from None
    if "" in form or not form:
        message = "what to minimise: a number alone cannot become smaller"
        raise UsageProblem(message, CURE, code="option-value")
    return aims.WeightedSum(
        text, tuple(_term(name.replace("_", "-"), weight) for name, weight in form.items())
    )


def refuse(text: str, is_search: bool = False) -> None:
    """Raises UsageProblem if a text is no objective, or if a search alone minimises it."""
    objective = objective_of(text)
    if not is_search and not isinstance(objective, aims.Either):
        exactly(objective)


def _term(
    name: str, weight: fmpq
) -> tuple[fmpq, aims.Objective | aims.LevelObjective | aims.SearchMeasure]:
    if name not in _KEYS:
        message = f"no objective {name!r}"
        raise UsageProblem(message, did_you_mean(name, list(_KEYS)), code="unknown-word")
    objective = OBJECTIVES[_KEYS[name]]
    if isinstance(objective, aims.Either):
        message = f"{name} is the name of two intervals, and a sum needs one of them"
        raise UsageProblem(
            message, "write real-interval or oscillator-interval", code="option-value"
        )
    if isinstance(objective, aims.LevelObjective) == (weight > 0):
        message = f"a sum minimises {name}: write it without a minus sign"
        if weight > 0:
            message = f"a sum maximises {name}: write it with a minus sign"
        raise UsageProblem(message, CURE, code="option-value")
    return weight, objective


def _linear(expression: Expression) -> dict[str, fmpq]:
    """Coefficients by names, the constant by the empty one; UsageProblem if it is not linear."""
    match expression:
        case Literal(value=value):
            return {"": value} if value else {}
        case Name(name=name):
            return {name: fmpq(1)}
        case Chain(signs=signs, operands=operands):
            forms = [_linear(x) for x in operands]
            if signs[0] in "+-":
                return _added(signs, forms)
            total = forms[0]
            for sign, form in zip(signs[1:], forms[1:], strict=True):
                numbers, other = (form, total) if set(form) <= {""} else (total, form)
                factor = numbers.get("", fmpq(0))
                if set(numbers) <= {""} and (sign == "*" or (numbers is form and factor)):
                    total = {x: a * factor if sign == "*" else a / factor for x, a in other.items()}
                    continue
                raise _no_sum()
            return total
    raise _no_sum()


def _no_sum() -> UsageProblem:
    message = "what to minimise: a sum of names with numbers is expected"
    return UsageProblem(message, CURE, code="option-value")


def _added(signs: str, forms: list[dict[str, fmpq]]) -> dict[str, fmpq]:
    total: dict[str, fmpq] = {}
    for sign, form in zip(signs, forms, strict=True):
        for name, a in form.items():
            total[name] = total.get(name, fmpq(0)) + (a if sign == "+" else -a)
    return {name: a for name, a in total.items() if a}


def exactly(
    objective: aims.Objective | aims.LevelObjective | aims.SearchMeasure | aims.WeightedSum,
) -> aims.Objective | aims.LevelObjective:
    """An objective for the exact engines; UsageProblem if it is no rational function."""
    if isinstance(objective, aims.Objective) or (
        isinstance(objective, aims.LevelObjective) and objective.signs
    ):
        return objective
    terms = objective.terms if isinstance(objective, aims.WeightedSum) else ((fmpq(1), objective),)
    formulas = []
    for weight, one in terms:
        if not isinstance(one, aims.Objective):
            name = one.key.removeprefix("-")
            message = f"only a search minimises {name}"
            raise UsageProblem(message, f"add --search N{_instead(name)}", code="option-alone")
        formulas.append((weight, one.formula))

    def formula(subject: aims.ObjectiveSubject, ring: Parameters | None) -> Quotient:
        total = Quotient(fmpq(0), fmpq(1))
        for weight, one in formulas:
            part = one(subject, ring)
            numerator = (
                total.numerator * part.denominator + part.numerator * total.denominator * weight
            )
            total = Quotient(numerator, total.denominator * part.denominator)
        return total

    return aims.Objective(objective.key, objective.summary, formula)


def _instead(name: str) -> str:
    return "; error is its square" if name == "A" else ""
