"""Files with free parameters: families of methods whose coefficients are rational functions."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, TypeAlias

from flint import fmpq, fmpq_mpoly

from garkcli.constructions.nystrom import is_nystrom
from garkcli.constructions.rosenbrock import is_rosenbrock
from garkcli.design.want import numerators, sign_polynomial
from garkcli.errors import HasFreeParameters, MethodError
from garkcli.exact.parametric import Parameters, common_denominator
from garkcli.grammar.nodes import Extent, ScalarNode, extent, one_line
from garkcli.methodfile import description as d
from garkcli.methodfile.build import Builder
from garkcli.methodfile.description import left_behind
from garkcli.methodfile.family_values import FamilyValues
from garkcli.methodfile.load import NO_SETTINGS, built, described, loads, read_method_text
from garkcli.methodfile.reader import MethodReader
from garkcli.methodfile.wishes import Wishes, meaning_of
from garkcli.tableau.family import Family
from garkcli.tableau.stages import Jets
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.exact.nodes import Expression
    from garkcli.methodfile.rounding import Rounded

Moved: TypeAlias = "Callable[[Rounded], Mapping[int, Expression]]"
"""Expressions in place of rounded numbers, by the identity of the latter."""
_NAME = re.compile(r"\ba[0-9_]+")
_DESIGN = "a family with free parameters"


class FamilyFile(Family, kw_only=True):
    """A method file with free parameters.

    Attributes:
        source: the path as given.
        text: the file as it was read.
        settings: values that were given for other parameters.
        places: the place of the value of each parameter in the text, from and to.
        parameters_at: the place of ``parameters: …``; None without.
        shape: where ``unknown: …`` is, and the tableau that it means as keys of a method file;
            None without a shape.
        blocks: where "?" stands for whole blocks, and their matrices with the names of entries.
        wanted_at: the place of ``design: …``; None without.
        structure: which vector fields the problem has.
        claims: what ``expect`` says.
        left_behind: further weights of methods inside of a construction, which it has not.
        tolerance: the rounding of its numbers, the largest; None if all are exact.
    """

    source: str
    text: str
    settings: Mapping[str, str]
    places: Mapping[str, Extent]
    parameters_at: Extent | None = None
    shape: tuple[Extent, str] | None = None
    blocks: tuple[tuple[Extent, str], ...] = ()
    wanted_at: Extent | None = None
    structure: d.Structure = "general"
    claims: tuple[d.ClaimText, ...] = ()
    left_behind: tuple[str, ...] = ()
    tolerance: fmpq | None = None


def load_family(
    path: str,
    settings: Mapping[str, str] = NO_SETTINGS,
    deadline: float | None = None,
    is_free: bool = True,
) -> FamilyFile:
    """Reads a method file with free parameters, or one without if not ``is_free``.

    At ``deadline``, a value of ``time.monotonic``, remaining demands stay undecided. Raises
    MethodFileError with all faults; MethodError for methods without families.
    """
    return loads_family(*read_method_text(path), settings, deadline=deadline, is_free=is_free)


def _without_unknowns(source: str, settings: Mapping[str, str]) -> MethodError:
    if settings:
        message = f"{source} has no free parameter left"
        return MethodError(message, "gark check --set judges one method", code="free-parameters")
    cure = 'write parameters: {tau: free} in place of a value, or "?" for an entry'
    return MethodError(f"{source} has no free parameter", cure, code="free-parameters")


def loads_family(
    text: str,
    source: str = "<text>",
    settings: Mapping[str, str] = NO_SETTINGS,
    is_design: bool = True,
    deadline: float | None = None,
    is_free: bool = True,
    numbers: Moved | None = None,
) -> FamilyFile:
    r"""Demands under ``design`` count if ``is_design``; ``numbers`` replaces rounded numbers.

    >>> family = loads_family("parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, 1]")
    >>> family.tableau.block(0, 0)
    ((0, 0), (t, 0))
    """
    reader, description = described(text, source, settings)
    if is_free and not reader.numbers.free:
        # where the file or a setting has a fault, that is what is reported
        _refuse_others(loads(text, source, settings).tableau)
        raise _without_unknowns(source, settings)
    wishes = reader.wishes if is_design and reader.wishes is not None else Wishes()
    reader.numbers.entries += wishes.entries
    reader.numbers.free |= wishes.ranges
    return _family(reader, description, wishes, settings, deadline, numbers)


def family_of(error: HasFreeParameters, settings: Mapping[str, str] = NO_SETTINGS) -> FamilyFile:
    """The family of a file read as a method, without demands; MethodFileError with all faults."""
    if error.reading is None:  # the file was read in another process
        family = loads_family(error.text, error.source, settings, is_design=False)
    else:
        reader, description = error.reading
        family = _family(reader, description, Wishes(), settings, None)
    if family.tableau.exact_to is not None:
        message = "a parameter is free, and the fast part is solved exactly"
        cure = "give it a value: --set NAME=1/2; gark design finds values"
        raise MethodError(message, cure, code="free-parameters")
    return family


def _refuse_others(tableau: Tableau) -> None:
    if not (is_rosenbrock(tableau) or is_nystrom(tableau)):
        tableau.demand_fields(_DESIGN, with_flow=True)


def refuse_rounded(family: FamilyFile) -> None:
    if family.tolerance is None:
        return
    names = ", ".join(family.parameters)
    message = (
        f"the coefficients are rounded and {names} free: statements for all values need exact ones"
    )
    cure = f"gark design finds values within the tolerance; --set {family.parameters[0]}=1/2"
    raise MethodError(message, f"{cure} chooses one", code="rounded")


def _family(
    reader: MethodReader,
    description: d.Description,
    wishes: Wishes,
    settings: Mapping[str, str],
    deadline: float | None,
    numbers: Moved | None = None,
) -> FamilyFile:
    if description.form == "derivatives":  # its numbers say how many stages its tableau has
        message = f"{_DESIGN} is for GARK methods: {Jets.why}"
        raise MethodError(message, Jets.cure, code="cannot-construct")
    made = built(reader, description, FamilyValues)
    tolerance: fmpq | None = None
    if description.tolerance is not None:
        from garkcli.methodfile.number_tolerances import NumberTolerances  # few files are rounded
        from garkcli.methodfile.rounding import Rounded

        own = set(map(id, wishes.entries))
        coefficients = [x for x in reader.numbers.entries if id(x) not in own]
        tolerances = NumberTolerances(description.tolerance, description.content, coefficients)
        rounded = Rounded(coefficients, made.values, tolerances)
        rounded.refuse_keys(reader.source)
        tolerance = max(rounded.radii, default=None)
        if numbers is not None:
            change = rounded.changer(numbers(rounded))
            moved = FamilyValues(reader.numbers, change)
            moved.decide_as(made.values)
            made = Builder(made.text, moved)
    tableau, values = made.tableau, made.values
    _refuse_others(tableau)
    ring = values.domain.ring
    source = reader.source
    meaning = meaning_of(wishes, made, source, deadline)
    free = reader.numbers.free
    ranges = {name: values.ends(x) for name, x in free.items()}
    source.close()
    poles = _cancelled(values.domain.divisors, tableau, ring, free)
    return FamilyFile(
        source=source.name,
        text=source.text,
        name=one_line(description.name) or source.name,
        tableau=tableau,
        further=made.further,
        ring=ring,
        parameters=tuple(free),
        ranges=ranges,
        radicals=tuple(values.domain.radicals),
        relations=tuple(numerators(meaning.zeros, ring)),
        nonzero=(*meaning.nonzero, *poles),
        positive=_signs(meaning.positive, ring),
        not_negative=_signs(meaning.not_negative, ring),
        order=wishes.order,
        stable=meaning.stable,
        claims_of_wanted=meaning.claims,
        unsettled=meaning.unsettled,
        real=meaning.real,
        impossible=meaning.impossible,
        levels=meaning.levels,
        embedded_order=wishes.count("embedded-order"),
        dense_order=wishes.count("dense-order"),
        wanted_at=reader.place_of("design"),
        parameters_at=reader.place_of("parameters"),
        settings=settings,
        places={name: extent(source.text, x, x) for name, x in reader.numbers.places.items()},
        shape=_shape(reader),
        blocks=tuple(_blocks(description, source.text)),
        structure=description.structure,
        left_behind=left_behind(description.content),
        claims=description.claims,
        tolerance=tolerance,
    )


def _cancelled(
    divisors: Sequence[fmpq_mpoly], tableau: Tableau, ring: Parameters, free: Iterable[str]
) -> Iterator[fmpq_mpoly]:
    """Irreducible polynomials by which the file divides although they cancel, as in t/t."""
    shown = common_denominator(tableau.entries, ring)
    known = {str(factor) for factor, _ in shown.factor()[1]}
    indices = [ring.names.index(name) for name in free]
    for divisor in divisors:
        for factor, _ in divisor.factor()[1]:
            degrees = factor.degrees()
            has_parameter = any(degrees[k] for k in indices)
            if has_parameter and str(factor) not in known:
                known.add(str(factor))
                yield factor


def _signs(numbers: Sequence[object], ring: Parameters) -> tuple[fmpq_mpoly, ...]:
    return tuple(sign_polynomial(x, ring) for x in numbers)


def _shape(reader: MethodReader) -> tuple[Extent, str] | None:
    if reader.shaped is None:
        return None
    from garkcli.methodfile.shapes import spelled

    text = spelled(reader.shaped.layout)
    if reader.shaped.form == "prk" and "structure" not in reader.keys:
        text += "\nstructure: separable"
    return reader.shaped.place, text


def _blocks(description: d.Description, text: str) -> Iterator[tuple[Extent, str]]:
    if not isinstance(description.content, d.MethodsText):
        return
    by_method: dict[int, dict[tuple[int, int], d.MatrixText]] = {}
    for edge, block in description.content.transfer.blocks.items():
        if isinstance(block, d.MatrixText) and isinstance(block.node, ScalarNode):
            by_method.setdefault(id(block.node), {})[edge] = block
    for blocks in by_method.values():
        from garkcli.methodfile.transfers import spelled

        [node, *_] = [block.node for block in blocks.values()]
        yield extent(text, node, node), spelled(blocks)


def with_values(family: FamilyFile, values: Mapping[str, str], head: str, claim: str) -> str:
    """Returns the file with values, ``head`` as a comment and a claim if there is none."""
    text = family.text
    given = {**family.settings, **values}
    blocks = dict(family.blocks)
    places = [item for item in family.places.items() if item[1] not in blocks]
    changes = [(place, _scalar(given[name])) for name, place in places if name in given]
    changes += [
        (place, _NAME.sub(lambda x: _scalar(given[x[0]]), y)) for place, y in blocks.items()
    ]
    if family.shape is not None:
        place, tableau = family.shape
        own = {name: text[start:end] for name, (start, end) in places}
        lines = [*(f"  {x}: {own[x]}" for x in own if x not in given)]
        lines += [f"  {name}: {_scalar(value)}" for name, value in given.items()]
        changes = [(place, "\n".join(["parameters:", *lines, tableau]))]
        if family.parameters_at is not None:
            changes.append((family.parameters_at, ""))
    if family.wanted_at is not None:
        # its names are those of unknowns, which the file has no more
        changes.append((family.wanted_at, ""))
    for (start, end), change in sorted(changes, reverse=True):
        text = text[:start] + change + text[end:]
    if "expect:" not in text:
        text = f"{text.rstrip()}\nexpect: {{{claim}}}"
    return "\n".join([*(f"# {line}" for line in head.splitlines()), text.rstrip()]) + "\n"


def _scalar(value: str) -> str:
    is_plain = value.replace("/", "").replace("-", "").isdigit()
    return value if is_plain else f'"{value}"'
