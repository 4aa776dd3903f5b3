"""``gark design`` for people."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from itertools import groupby
from textwrap import wrap

from garkcli.design.choices import Choice
from garkcli.design.design import Design
from garkcli.design.stable_values import StableValues
from garkcli.design.step import Found, Step
from garkcli.errors import counted
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_decimal, root_text
from garkcli.exact.roots import RealRoot
from garkcli.page.plain import printable
from garkcli.report.design_values import conditions, zeros
from garkcli.report.stable_values import set_lines
from garkcli.trees.notation import format_tree

INDENT = " " * 17
ZEROS = "the zeros, real and complex, of"
MAX_POLYNOMIALS = 12
"""Most polynomials of a family that are shown; JSON has all."""
_ONE_BY_ONE = ("solutions", "none", "undecided")
MAX_LINES = 24
"""And the most lines of them, the first polynomial aside."""
MAX_LENGTH = 300
"""Longer polynomials are told by their degree where a number is their root."""
UNDECIDED = (
    "fewer unknowns make it decidable: values for some by --set or design: fix, a shape with"
    " fewer such as palindromic; --search N looks for methods and decides nothing"
)


def _unsettled(keys: Sequence[str]) -> str:
    """What was not worked out, and what helps."""
    return (
        f"the conditions of {', '.join(keys)} under design take longer than that; ask for"
        " a lower order of the pair, or fix unknowns by --set or design: fix"
    )


_TIMES = {1: "", 2: "; a double solution", 3: "; a triple solution"}


def render(
    source: str,
    design: Design,
    digits: int,
    width: int,
    choices: Sequence[Choice] = (),
    sets: Sequence[StableValues] = (),
) -> str:
    """The design as text.

    Args:
        source: the file.
        design: what each order asks of the parameters.
        digits: of numbers without simple radicals.
        width: columns to fill.
        choices: of values that led to it.
        sets: where every value has the order, those that are as stable as is wanted.
    """
    family = design.family
    lines = [printable(source), f"  {printable(family.name)}"]
    unknowns = f"unknown {', '.join(family.parameters)}; order of the {design.whose}"
    lines += wrap(unknowns, width, initial_indent="  ", subsequent_indent="  ")
    lines += [f"  {_left(choice)}" for choice in choices]
    lines.append("")
    for _, group in groupby(design.steps, key=partial(_likeness, design)):
        steps = list(group)
        lines += _of_steps(design, steps, digits, width)
    for values in sets:
        lines += ["", *set_lines(values, digits, width)]
    if family.stable and not sets and design.last.kind not in _ONE_BY_ONE:
        kinds = ", ".join(map(str, family.stable))
        text = f"  {kinds}: decided for single solutions, or for one parameter: --set"
        lines += ["", *wrap(text, width, subsequent_indent="  ")]
    return "\n".join(lines) + "\n"


def _left(choice: Choice) -> str:
    """What a choice leaves."""
    value = f"{choice.name} = {choice.value}"
    if choice.before < 0:
        return f"{value}: no method of order {choice.order} is left to choose from"
    left = "no method" if choice.after < 0 else f"dimension {choice.after}"
    return f"{value} leaves {left} of order {choice.order}, dimension {choice.before}"


def _likeness(design: Design, step: Step) -> tuple[object, ...]:
    """What steps have in common that are shown as one."""
    texts = zeros(design.family, step.polynomials)
    where = conditions(design.family, step)
    return step.kind, step.is_real, tuple(texts), tuple(where)


def _of_steps(design: Design, steps: Sequence[Step], digits: int, width: int) -> Iterator[str]:
    first, last = steps[0].order, steps[-1].order
    orders = f"order {first}" if first == last else f"order {first} to {last}"
    head = f"  {orders:<15}"
    step = steps[-1]
    match step.kind:
        case "every-value":
            where = conditions(design.family, step)
            lines = wrap(f"every value{_where(where)}", width - len(INDENT), break_on_hyphens=False)
            yield f"{head}{lines[0]}"
            yield from (INDENT + line for line in lines[1:])
            yield from _real(design, step, digits, width)
        case "none":
            yield f"{head}no value"
            yield from _witness(design, step, width)
        case "undecided":
            yield f"{head}not decided in the time of --seconds"
            if step.ideal is not None:
                said = "which values have it is not worked out in that time"
                if step.ideal.is_everything:
                    said = "msolve finds that no value has it, which is no proof"
                yield from _said(said, width)
            unsettled = design.family.unsettled
            if unsettled:
                yield from _said(_unsettled(unsettled), width)
            else:
                yield from _said(UNDECIDED, width)
        case "family":
            assert step.ideal is not None
            yield f"{head}a family of dimension {step.ideal.dimension}: {ZEROS}"
            yield from _polynomials(zeros(design.family, step.polynomials), width)
            where = conditions(design.family, step)
            if where:
                yield from _said(_where(where).strip(), width)
            yield from _real(design, step, digits, width)
        case "solutions":
            count = sum(x.solution.degree for x in step.found)
            yield f"{head}{counted(count, 'solution')}: {ZEROS}"
            yield from _polynomials(zeros(design.family, step.polynomials), width)
            for found in step.found:
                yield from _solutions(design, found, digits, width)
    if step.ideal is not None and not step.ideal.is_proved and step.kind != "undecided":
        said = "found by msolve: each is proved, that there are no others is not"
        yield from _said(said, width)


def _witness(design: Design, step: Step, width: int) -> Iterator[str]:
    if step.witness is None:
        said = "what is wanted besides cannot be met, not even by complex values"
        yield from _said(said, width)
        return
    text = "with the conditions before it, that of "
    tree = format_tree(step.witness, colours=design.tableau.size > 1)
    text += f"{tree} cannot be met, not even by complex values"
    yield from _said(text, width)


def _said(text: str, width: int) -> Iterator[str]:
    """A sentence beside the orders, in as many lines as it takes."""
    for line in wrap(text, width - len(INDENT), break_on_hyphens=False):
        yield INDENT + line


def _where(texts: Sequence[str]) -> str:
    """What else is true of values, in words; nothing where nothing is."""
    if not texts:
        return ""
    *others, last = texts
    return f" where {', '.join(others)} and {last}" if others else f" where {last}"


def _real(design: Design, step: Step, digits: int, width: int) -> Iterator[str]:
    """What is known of the real values of a family, where these are not a family too."""
    if step.real is not None and step.real.is_everything:
        yield from _said("none of them is real", width)
        return
    if step.real is not None:
        yield from _said("its real values are the real zeros of", width)
        texts = zeros(design.family, [*step.polynomials_of_real])
        yield from _polynomials(texts, width)
        for found in step.found:
            yield from _solutions(design, found, digits, width)
    elif step.is_real is False:
        yield from _said("no real value of them is a method that the file admits", width)
    if step.is_real is None:
        yield from _said(
            "whether a real value of them is a method that the file admits is not decided", width
        )


def _polynomials(polynomials: Sequence[str], width: int) -> Iterator[str]:
    indent = INDENT + "  "
    shown: list[str] = []
    more = len(polynomials)
    for p in polynomials[:MAX_POLYNOMIALS]:
        lines = wrap(p, width, initial_indent=indent, subsequent_indent=indent + "  ")
        if shown and len(shown) + len(lines) > MAX_LINES:
            break
        shown += lines
        more -= 1
    yield from shown
    if more:
        yield f"{INDENT}  and {counted(more, 'polynomial')} more, see --format json"


def _solutions(design: Design, found: Found, digits: int, width: int) -> Iterator[str]:
    solution = found.solution
    times = _TIMES.get(solution.multiplicity, f"; {solution.multiplicity} times")
    for index in range(len(solution.real)):
        said = f"{_verdict(design, found, index)}{times}"
        yield from _said(said, width)
        for name in design.family.parameters:
            yield from _value(name, solution.real_values[index][name], digits, width)
    others = solution.degree - len(solution.real)
    if others:
        noun = "solution" if others == 1 else "solutions"
        yield f"{INDENT}{others} {noun} not real{times}"


def _verdict(design: Design, found: Found, index: int) -> str:
    if found.order is None:
        return "no method: a weight or a denominator is zero there"
    order = _order(design, found)
    if index in found.unstable:
        kinds = " and ".join(x.in_words(design.tableau) for x in design.family.stable)
        return f"{order}; not {kinds}, which is wanted"
    if index in found.open:
        return f"{order}; stability not decided: its field is too large, or the time too short"
    if index not in found.accepted:
        return "not of this file: out of a range, a sign not wanted, or another root"
    stable = "".join(f", {kind.in_words(design.tableau)}" for kind in design.family.stable)
    return f"{order}, by a certificate of its own{stable}"


def _order(design: Design, found: Found) -> str:
    assert found.order is not None
    least = "at least " if found.order.is_lower_bound else ""
    return f"order {least}{found.order.order} of the {design.whose}"


def _value(name: str, value: RealRoot, digits: int, width: int) -> Iterator[str]:
    indent = INDENT + "  "
    text = f"{name} = {_number(value, digits)}"
    yield from wrap(text, width, initial_indent=indent, subsequent_indent=indent + "  ")


def _number(value: RealRoot, digits: int) -> str:
    """Radicals where there are simple ones; else decimals and the polynomial."""
    simple = root_text(value)
    if value.exact is not None:
        return str(simple)
    decimals = root_decimal(value, digits)
    if simple is not None:
        return f"{simple} = {decimals}…"
    polynomial = polynomial_text(Polynomial.from_flint(value.polynomial), "x")
    if len(polynomial) > MAX_LENGTH:
        polynomial = f"a polynomial of degree {value.polynomial.degree()}"
    return f"{decimals}…, a root of {polynomial}"
