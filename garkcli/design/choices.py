"""Down a family by values for unknowns, the dimension after each; the texts of one method."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from flint import fmpq, fmpq_mat, fmpq_poly

from garkcli.design.design import Design
from garkcli.design.solutions import value_at
from garkcli.design.steps import Found
from garkcli.errors import MethodError
from garkcli.exact.field import Algebraic, Number, NumberField, coordinates
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_decimal, root_text
from garkcli.exact.roots import RealRoot
from garkcli.frozen import Frozen


class Choice(Frozen):
    """A value for one unknown, with the dimension of the methods of that order before and after. It
    is −1 if there are none, not even with complex values.
    """

    name: str
    value: str
    order: int
    before: int
    after: int


def walk_down(design: Design, values: Mapping[str, tuple[str, fmpq]]) -> list[Choice]:
    """The dimension after each of several choices, among the methods of the highest order reached.
    Raises MethodError if no order was decided, NotDecided if a Gröbner basis takes too long.
    """
    reached = [x for x in design.steps if x.ideal is not None and x.may_have_methods]
    if not reached:
        message = "--choose: gark knows no order that methods of the file have"
        cure = "give values with --set instead: fewer unknowns make smaller systems"
        raise MethodError(message, cure, code="not-found")
    ideal = reached[-1].ideal
    assert ideal is not None
    ring = design.family.ring
    choices = []
    for name, (text, value) in values.items():
        unknown = ring.context.gen(ring.names.index(name))
        smaller = ideal.with_zeros([unknown - value])
        choices.append(Choice(name, text, reached[-1].order, ideal.dimension, smaller.dimension))
        ideal = smaller
    return choices


MAX_DEGREE = 12
DIGITS = 20


class Chosen(Frozen):
    """A method of a family; ``elements`` are the free parameters in the field of the solution.
    ``embedded`` is the order of its embedded weights; None if it has none.
    """

    elements: dict[str, Number]
    root: RealRoot
    order: int
    embedded: int | None = None

    @property
    def values(self) -> dict[str, str]:
        """The free parameters as text. Raises MethodError if no method file can hold them."""
        return values_text(self.elements, self.root)


def accepted_methods(design: Design) -> Iterator[Chosen]:
    names = design.family.parameters
    for step in reversed(design.steps):
        accepted = [(found, index) for found in step.found for index in found.accepted]
        for found, index in accepted:
            if found.order is not None:
                yield chosen(found, index, names, found.order.order)
        if accepted:
            return


def chosen(found: Found, index: int, names: Sequence[str], order: int) -> Chosen:
    solution = found.solution
    values = {name: solution.values[name] for name in names}
    embedded = None if found.embedded is None else found.embedded[0].order
    return Chosen(values, solution.real[index], order, embedded)


def values_text(values: dict[str, Number], root: RealRoot) -> dict[str, str]:
    """Returns elements of ℚ[u]/modulus at a root, in simple radicals or as polynomials in one root.
    Raises MethodError if no value generates the field, or its degree is beyond method files.
    """
    texts = {}
    for name, value in values.items():
        simple = root_text(value_at(value, root))
        if simple is None:
            return _in_one_root(values, root)
        texts[name] = simple
    return texts


def _in_one_root(values: dict[str, Number], root: RealRoot) -> dict[str, str]:
    algebraic = [x for x in values.values() if isinstance(x, Algebraic)]
    field = algebraic[0].field
    candidates = [x for x in algebraic if _powers(x, field).rank() == field.degree]
    if not candidates or field.degree > MAX_DEGREE:
        message = (
            f"the values are algebraic numbers of degree {field.degree} without simple radicals"
        )
        cure = f"method files hold roots of polynomials up to degree {MAX_DEGREE}"
        raise MethodError(message, cure, code="number-too-large")
    generator = min(candidates, key=lambda x: len(str(value_at(x, root).polynomial)))
    number = value_at(generator, root)
    polynomial = polynomial_text(Polynomial.from_flint(number.polynomial), "x")
    name = f"root_of({polynomial}, {root_decimal(number, DIGITS)})"
    powers = _powers(generator, field)
    texts = {}
    for key, value in values.items():
        column = fmpq_mat([[a] for a in coordinates(value, field.degree)])
        solved = powers.solve(column).entries()
        texts[key] = polynomial_text(Polynomial(solved), name).replace("^", "**")
    return texts


def _powers(generator: Algebraic, field: NumberField) -> fmpq_mat:
    columns = []
    power = fmpq_poly([1])
    for _ in range(field.degree):
        columns.append([power[k] for k in range(field.degree)])
        power = power * generator.poly % field.modulus
    return fmpq_mat(columns).transpose()
