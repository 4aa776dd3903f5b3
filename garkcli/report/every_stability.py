"""``gark stability`` of a file with free parameters: R(z), and for which values it is stable."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from garkcli.check.every_facts import Fact, told
from garkcli.check.every_family import EveryFamily
from garkcli.check.every_properties import find_property
from garkcli.check.every_words import fact_text
from garkcli.design.stability_functions import FamilyFunction, family_functions
from garkcli.exact.display import to_latex, to_text
from garkcli.exact.polynomial_text import power_text
from garkcli.page.json_text import to_json
from garkcli.page.paint import folded
from garkcli.page.plain import printable
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import EXACT, TEXT, Schema, array, nullable, published
from garkcli.report.every_json import FACT

SCHEMA = "gark/stability-every/1"
KINDS = ("a-stable", "l-stable", "p-stable", "algebraically-stable")
"""What is decided, of one parameter."""
_WIDTH = 80
_LIMIT = 60
_LABEL = 22


@dataclass(frozen=True)
class EveryStability:
    """What is known of the stability of a family.

    Attributes:
        file: its path.
        name: what people call it.
        family: of methods.
        functions: R for all colours together, and for each.
    """

    file: str
    name: str
    family: EveryFamily
    functions: tuple[FamilyFunction, ...]

    @property
    def facts(self) -> dict[str, Fact]:
        """The kinds of stability."""
        return {key: find_property(self.family, key, _LIMIT) for key in KINDS}


def every_stability(file: str, name: str, family: EveryFamily) -> EveryStability:
    """The stability of a family."""
    functions = family_functions(family.tableau, family.ring)
    return EveryStability(file, name, family, functions)


def render(found: EveryStability, format: str) -> str:
    """The report as text, JSON or LaTeX."""
    if format == "json":
        return to_json(_REPORT.data(found)) + "\n"
    if format == "latex":
        return "".join(_latex(one) for one in found.functions)
    return "\n".join(_text(found)) + "\n"


def every_stability_schema() -> Schema:
    """The JSON Schema of these reports."""
    return published("report of gark stability for every value of parameters", _REPORT.schema)


def _text(found: EveryStability) -> Iterator[str]:
    parameters = found.family.family.parameters
    yield printable(f"{found.file}: {found.name}")
    verb = "is" if len(parameters) == 1 else "are"
    names = ", ".join(parameters)
    text = f"  {names} {verb} free: what holds for every value"
    yield from folded(text, _WIDTH, "  ")
    for one in found.functions:
        yield ""
        which = "R(z)" if one.name == "all" else f"R(z), colour {one.name}"
        over = sum_text(one.numerator, "z")
        under = sum_text(one.denominator, "z")
        yield from _labelled(which, over)
        if under != "1":
            yield from _labelled("  over", under)
        limit = one.at_infinity
        shown = "unbounded" if limit is None else to_text(limit)
        yield from _labelled("R(∞)", shown)
        yield from _labelled("E(x), x = y²", sum_text(one.e_polynomial, "x"))
    yield ""
    name = parameters[0]
    has_one = found.family.has_one
    for key, fact in found.facts.items():
        text = fact_text(fact, name, told)
        if fact.is_undecided and not fact.differs:
            text = _cure(key, name, has_one)
        yield from _labelled(key, text)
    yield from _labelled("intervals, SSP", f"numbers: --set {name}=1/2")


def _cure(key: str, name: str, has_one: bool) -> str:
    """What decides it."""
    if has_one or key == "algebraically-stable":
        return f"not decided for every value: --set {name}=1/2"
    return f"for one parameter: --set, then gark design --{key}"


def _labelled(label: str, text: str) -> Iterator[str]:
    lines = folded(text, _WIDTH - 2 - _LABEL, "")
    for line in lines:
        yield f"  {label:{_LABEL}}{line}"
        label = ""


def sum_text(coefficients: Sequence[Any], variable: str) -> str:
    """A polynomial, lowest power first, its coefficients in brackets where they are sums.

    >>> from flint import fmpq
    >>> sum_text((fmpq(1), fmpq(0), fmpq(-1, 2)), "z")
    '1 - 1/2*z^2'
    """
    text = ""
    for k, a in enumerate(coefficients):
        if not a:
            continue
        number = to_text(a)
        is_sum = " " in number
        is_negative = number.startswith("-") and not is_sum
        factor = f"({number})" if is_sum else number.removeprefix("-")
        text += " - " if is_negative else " + "
        power = power_text(variable, k)
        if power and factor != "1":
            power = f"{factor}*{power}"
        text += power or number.removeprefix("-" if is_negative else "")
    if text.startswith(" - "):
        return "-" + text.removeprefix(" - ")
    return text.removeprefix(" + ") or "0"


def _latex(one: FamilyFunction) -> str:
    name = "R(z)" if one.name == "all" else rf"R_{{\mathrm{{{one.name}}}}}(z)"
    over = _sum_latex(one.numerator)
    under = _sum_latex(one.denominator)
    value = over if under == "1" else rf"\frac{{{over}}}{{{under}}}"
    return f"\\[ {name} = {value} \\]\n"


def _sum_latex(coefficients: Sequence[Any]) -> str:
    text = ""
    for k, a in enumerate(coefficients):
        if not a:
            continue
        number = to_latex(a)
        is_sum = " " in to_text(a)
        power = power_text("z", k, f"{{{k}}}")
        if is_sum and power:
            number = rf"\left({number}\right)"
        if power and number in {"1", "-1"}:
            number = number.removesuffix("1")
        sign = "" if number.startswith("-") else "+"
        text += f"{sign}{number}{power}"
    return text.removeprefix("+") or "0"


def _exact(coefficients: Sequence[Any]) -> list[str]:
    return [to_text(a) for a in coefficients]


def _limit(one: FamilyFunction) -> str | None:
    limit = one.at_infinity
    return None if limit is None else to_text(limit)


_FUNCTION: Record[FamilyFunction] = Record(
    Field("name", TEXT, lambda x: x.name),
    Field("numerator", array(EXACT), lambda x: _exact(x.numerator)),
    Field("denominator", array(EXACT), lambda x: _exact(x.denominator)),
    Field("R_infinity", nullable(EXACT), _limit),
    Field("e_polynomial", array(EXACT), lambda x: _exact(x.e_polynomial)),
)
"""Coefficients of 1, z, z², …, and of 1, x, x², …"""


def _facts(found: EveryStability) -> dict[str, Any]:
    return {key.replace("-", "_"): FACT.data(fact) for key, fact in found.facts.items()}


_FACTS: Schema = {
    "type": "object",
    "required": [key.replace("-", "_") for key in KINDS],
    "properties": {key.replace("-", "_"): FACT.schema for key in KINDS},
    "additionalProperties": False,
}
_REPORT: Record[EveryStability] = Record(
    schema_named(SCHEMA),
    Field("file", TEXT, lambda x: x.file),
    Field("name", TEXT, lambda x: x.name),
    Field("unknowns", array(TEXT), lambda x: list(x.family.family.parameters)),
    _FUNCTION.every("functions", lambda x: x.functions),
    Field("stability", _FACTS, _facts),
)
