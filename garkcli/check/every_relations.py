"""What a family asks of its parameters, put in: values that follow, powers of roots."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from flint import fmpq, fmpq_mpoly

from garkcli.errors import MethodError
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.parametric import Parameters, Parametric, Rule
from garkcli.tableau.family import Family, Radical


def moved_rules(old: Parameters, new: Parameters) -> Iterator[Rule]:
    """The rules of a ring in one without some parameters."""
    shift = len(old.names) - len(new.names)
    for rule in old.rules:
        terms = {tuple(map(int, e[shift:])): a for e, a in rule.instead.to_dict().items()}
        instead = new.context.from_dict(terms)
        yield Rule(rule.index - shift, rule.degree, instead)


def solved(
    relations: Sequence[fmpq_mpoly], ring: Parameters, unknowns: Sequence[str]
) -> dict[str, fmpq_mpoly]:
    """What relations that are linear in an unknown give it, each in those that are left then."""
    fixed: dict[str, fmpq_mpoly] = {}
    waiting = [p for p in relations if p]
    while waiting:
        p = waiting.pop(0)
        name = next((x for x in unknowns if is_linear(p, ring, x)), None)
        if name is None:
            raise MethodError(
                f"{p} = 0 is asked of the parameters, which is no value of one of them",
                "give values with --set, or ask gark design",
                code="no-value-left",
            )
        x = ring.context.gen(ring.names.index(name))
        slope = p.derivative(ring.names.index(name)).leading_coefficient()
        value = x - p / slope
        fixed[name] = value
        inside = list(ring.context.gens())
        inside[ring.names.index(name)] = value
        waiting = [q for q in (w.compose(*inside) for w in waiting) if q]
    return fixed


def is_linear(p: fmpq_mpoly, ring: Parameters, name: str) -> bool:
    """Whether a polynomial is a number times an unknown, plus what is without it."""
    index = ring.names.index(name)
    return p.degrees()[index] == 1 and p.derivative(index).is_constant()


def value_of(p: fmpq_mpoly, ring: Parameters, values: dict[str, object]) -> object:
    """A polynomial at values of the unknowns that it has."""
    total: object = fmpq(0)
    for exponents, a in p.to_dict().items():
        term: object = a
        for name, exponent in zip(ring.names, exponents, strict=True):
            for _ in range(int(exponent)):
                term = term * values[name]  # type: ignore[operator]
        total = total + term  # type: ignore[operator]
    return total


def moved_nonzero(family: Family, values: dict[str, object]) -> tuple[fmpq_mpoly, ...]:
    """What a family divides by and is not seen in it, at values of its unknowns.

    Raises:
        MethodError: it is zero there.
    """
    found = []
    for p in family.nonzero:
        value = value_of(p, family.ring, values)
        if not value:
            raise MethodError(
                f"the file divides by {family.ring.text(p)}, which is zero by what it asks",
                "change what it asks of the parameters, such as given nodes",
                code="division-by-zero",
            )
        if isinstance(value, Parametric):
            found.append(value.numerator)
    return tuple(found)


def rules_of(family: Family, ring: Parameters) -> Iterator[Rule]:
    """What powers of the roots are equal to, each of the degree that the roots before leave."""
    for number, radical in enumerate(family.radicals):
        index = family.ring.names.index(radical.name)
        before = {family.ring.names.index(x.name) for x in family.radicals}
        used = {k for k, e in enumerate(radical.relation.degrees()) if e}
        if not used <= before:
            raise MethodError(
                f"{radical.text} depends on a free parameter",
                "give values with --set: gark check, with a parameter for the root in its place",
                code="no-value-left",
            )
        degree = int(radical.relation.degrees()[index])
        if not _is_new(family.radicals[:number], radical):
            raise MethodError(
                f"{radical.text} is a number of the roots before it",
                "write it by these",
                code="no-value-left",
            )
        yield Rule(
            ring.names.index(radical.name),
            degree,
            _instead(radical, family.ring, ring, index, degree),
        )


def _instead(
    radical: Radical, old: Parameters, new: Parameters, index: int, degree: int
) -> fmpq_mpoly:
    """The highest power of a root, by its relation."""
    terms = {}
    leading = fmpq(1)
    for exponents, a in radical.relation.to_dict().items():
        if int(exponents[index]) == degree:
            leading = a
            continue
        powers = [0] * len(new.names)
        for name, exponent in zip(old.names, exponents, strict=True):
            if int(exponent):
                powers[new.names.index(name)] = int(exponent)
        terms[tuple(powers)] = a
    return new.context.from_dict({e: -a / leading for e, a in terms.items()})


def _is_new(before: Sequence[Radical], radical: Radical) -> bool:
    """Whether a root has the degree of its relation over the field of those before it."""
    roots = [parse(x.text) for x in (*before, radical)]
    field = Domain(roots).field
    due = 1
    for x in (*before, radical):
        due *= _degree(x)
    return field is not None and field.degree == due


def _degree(radical: Radical) -> int:
    """That of its relation in the root."""
    names = [str(x) for x in radical.relation.context().names()]
    return int(radical.relation.degrees()[names.index(radical.name)])
