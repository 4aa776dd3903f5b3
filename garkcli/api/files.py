"""Method files and problem files, from paths and texts, with parameters of any number type."""

from __future__ import annotations

import os
from typing import TypeAlias

from garkcli.api.anymethod import AnyMethod, method_of
from garkcli.api.numbers import Number, Settings, Whole, rational_or_none, texts, whole
from garkcli.check import check_file as checking
from garkcli.check.outcome import Outcome
from garkcli.comparison import comparison
from garkcli.comparison.comparison import Comparison
from garkcli.conversion import convert as conversion
from garkcli.conversion.convert import Converted
from garkcli.errors import MethodError
from garkcli.families.registry import FAMILIES
from garkcli.methodfile import family
from garkcli.methodfile import load as methods
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.family import FamilyFile
from garkcli.methodfile.naming import is_catalogued
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.problems.files import load as problems
from garkcli.problems.problem import Problem
from garkcli.reference import Work

AnyPath: TypeAlias = "str | os.PathLike[str]"
NONE: Settings = {}


def load(path: AnyPath, settings: Settings = NONE) -> MethodFile:
    """Read a method file, or a method of the catalogue.

    Args:
        path: the file, or ``-`` for standard input; or the name or an alias in the catalogue.
        settings: values of its parameters, by name, in place of those in the file.

    Raises:
        MethodFileError: every fault of the file, with positions.
        HasFreeParameters: a parameter has no value; ``load_family`` reads such a file.

    >>> load("rk4").b
    (1/6, 1/3, 1/3, 1/6)
    """
    return methods.load(path_of(path), texts(settings, "settings"))


def loads(text: str, source: str = "<text>", settings: Settings = NONE) -> MethodFile:
    r"""Read the text of a method file.

    Args:
        text: of the file.
        source: what errors call it.
        settings: values of its parameters, by name, in place of those in the file.

    Raises:
        HasFreeParameters: a parameter has no value.

    >>> made = loads("parameters: {a: 1/2}\nA: [[a]]\nb: [1]", settings={"a": 0.25})
    >>> made.A, made.order
    (((1/4,),), 1)
    """
    return methods.loads(_text(text), source, texts(settings, "settings"))


def references_in(given: AnyMethod) -> tuple[str, tuple[Work, ...]]:
    """Returns the name and the publications, arrays having none; MethodFileError for faults."""
    if not isinstance(given, (str, os.PathLike)):
        method = method_of(given)
        if isinstance(method, MethodFile):
            return method.source, methods.works_in(method.text, method.source)
        return method.name, ()
    name = path_of(given)
    if name in FAMILIES and not is_catalogued(name):
        work = FAMILIES[name].reference
        return name, ((str(work), work),)
    text, source = methods.read_method_text(name)
    return source, methods.works_in(text, source)


def load_family(
    path: AnyPath, settings: Settings = NONE, deadline: float | None = None
) -> FamilyFile:
    """Read a method file with free parameters.

    Args:
        path: of the file.
        settings: values of parameters, by name, in place of those in the file.
        deadline: the reading of ``time.monotonic`` at which demands stay undecided; None for never.

    Raises:
        MethodError: the file has no free parameter.

    >>> load_family("tests/examples/families/sdirk.gark.yaml").parameters
    ('g',)
    """
    given = texts(settings, "settings")
    return family.load_family(path_of(path), given, deadline)


def loads_family(
    text: str,
    source: str = "<text>",
    settings: Settings = NONE,
    is_design: bool = True,
    deadline: float | None = None,
) -> FamilyFile:
    r"""Read the text of a method file with free parameters.

    Args:
        text: of the file.
        source: what errors call it.
        settings: values of parameters, by name, in place of those in the file.
        is_design: whether the demands under ``design`` count.
        deadline: as in ``load_family``.

    Raises:
        MethodError: the file has no free parameter.

    >>> loads_family("parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, 1]").parameters
    ('t',)
    """
    given = texts(settings, "settings")
    return family.loads_family(_text(text), source, given, is_design, deadline)


def load_problem(path: AnyPath, stiffness: Number | None = None) -> Problem:
    """Read a problem file.

    Args:
        path: of the file, or ``-`` for standard input.
        stiffness: a value for its parameter of this name.

    >>> load_problem("problems/kepler.yaml").energy
    px**2/2 + py**2/2 - 1/sqrt(x**2 + y**2)
    """
    value = rational_or_none(stiffness, "stiffness")
    return problems.load_problem(path_of(path), value)


def loads_problem(text: str, source: str = "<text>", stiffness: Number | None = None) -> Problem:
    """Read the text of a problem file; see ``load_problem``.

    Args:
        text: of the file.
        source: what errors call it.
        stiffness: as in ``load_problem``.

    >>> text = "{variables: [x], hamiltonian: px**2/2 - cos(x), initial: {x: 1, px: 0}}"
    >>> loads_problem(text).energy
    px**2/2 - cos(x)
    """
    value = rational_or_none(stiffness, "stiffness")
    return problems.loads_problem(_text(text), source, value)


def check_file(
    path: AnyPath,
    limit: Whole = DEFAULT_LIMIT,
    want_constants: bool = False,
    settings: Settings = NONE,
) -> Outcome:
    """Check a method file with its claims: ``gark check``.

    Args:
        path: a file, a name of the catalogue, or ``-`` for standard input.
        limit: where the search for orders stops, unless a claim of the file is higher.
        want_constants: whether to compute the norms of the principal error coefficients, over the
            trees of the order that fails.
        settings: values of its parameters, by name, in place of those in the file.

    Returns:
        The outcome; ``ok`` if the file could be read and all claims hold. A file that cannot be
        read has ``faults``.

    >>> found = check_file("rk4")
    >>> found.ok, found.analysis.order, [claim.holds for claim in found.claims]
    (True, <Order 4>, [True, True])
    """
    return checking.check_file(
        path_of(path), whole(limit, "limit", 1), want_constants, texts(settings, "settings")
    )


def compare(one: AnyMethod, other: AnyMethod, limit: Whole = DEFAULT_LIMIT) -> Comparison:
    """Compare two methods: ``gark diff``.

    Methods are the same if renumbering stages or colours turns one into the other, after colours
    that share stages were given copies of them, and equal or redundant stages were removed.

    Args:
        one: whatever ``method_of`` takes.
        other: another method.
        limit: where the search for orders stops.

    >>> compare(([[0, 0], [1, 0]], ["1/2", "1/2"]), ([[0, 1], [0, 0]], [0.5, 0.5]))
    <Comparison same>
    """
    first, second = (method_of(x, is_any_kind=True) for x in (one, other))
    return comparison.compare(first, second, whole(limit, "limit", 1))


def convert(
    method: AnyMethod,
    to: str = "spelled-out",
    stages: Whole | None = None,
    digits: Whole | None = None,
    is_recognising: bool = False,
) -> Converted:
    """A method in another form: ``gark convert``.

    Args:
        method: whatever ``method_of`` takes.
        to: the form: spelled-out, gark, ark, prk, pair, canonical or recovered; for a Rosenbrock
            method printed or transformed.
        stages: the least number of stages of each colour, reached with redundant stages in front.
        digits: with recovered: digits after the point; by default 50, or more if the tolerance has
            more.
        is_recognising: with recovered: exact numbers for decimals unless an order falls.

    >>> convert("heun", stages=3).method.A
    ((0, 0, 0), (0, 0, 0), (0, 1, 0))
    >>> rounded = loads("{tolerance: 1e-6, A: [[0, 0], [0.666667, 0]], b: [0.25, 0.75]}")
    >>> convert(rounded, "recovered", is_recognising=True).method.A
    ((0, 0), (2/3, 0))
    """
    many = None if stages is None else whole(stages, "stages", 1)
    places = None if digits is None else whole(digits, "digits", 1)
    found = method_of(method, is_any_kind=True)
    return conversion.convert(found, to, many, places, is_recognising)


def path_of(given: object) -> str:
    """Returns the path, or the name of the catalogue; MethodError for other types."""
    if isinstance(given, (str, bytes, os.PathLike)):
        return os.fsdecode(given)
    message = f"a path or a name is expected, not {type(given).__name__}"
    cure = "loads takes text, from_arrays takes matrices"
    raise MethodError(message, cure, code="arrays")


def _text(given: object) -> str:
    """Raises MethodError for other types."""
    if isinstance(given, str):
        return given
    message = f"a text is expected, not {type(given).__name__}"
    cure = "load(path) and its like read a file, from_arrays takes arrays"
    raise MethodError(message, cure, code="arrays")
