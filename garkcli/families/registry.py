"""All families, and their members."""

from __future__ import annotations

import pkgutil
import re
from collections.abc import Iterator, Mapping
from importlib import import_module

from garkcli import families
from garkcli.errors import ExpressionError, UnknownFamily, counted, did_you_mean, nearest
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.families.family import MAX_STAGES, STAGES, Given, MethodFamily, Option, Options, Recipe
from garkcli.tableau.tableau import Method

NO_OPTIONS: Options = {}
_FIRST = ("collocation", "explicit", "sdirk2", "extrapolated", "deferred")
"""Modules whose families come first in the documentation."""


def _families() -> Iterator[MethodFamily]:
    for name in sorted([file.name for file in pkgutil.iter_modules(families.__path__)], key=_place):
        if name != "registry":
            yield from getattr(import_module(f"garkcli.families.{name}"), "FAMILIES", ())


def _place(name: str) -> tuple[int, str]:
    return (_FIRST.index(name) if name in _FIRST else len(_FIRST)), name


FAMILIES: Mapping[str, MethodFamily] = {family.name: family for family in _families()}
BY_STAGES: Mapping[str, MethodFamily] = {
    name: family for name, family in FAMILIES.items() if family.keys == ("stages",)
}


OTHER_NAMES: Mapping[str, str] = {
    "euler": "explicit-euler",
    "forward-euler": "explicit-euler",
    "backward-euler": "radau-iia with 1 stage",
    "implicit-euler": "radau-iia with 1 stage",
    "midpoint": "explicit-midpoint, or gauss with 1 stage for the implicit one",
    "implicit-midpoint": "gauss with 1 stage",
    "trapezoidal": "lobatto-iiia with 2 stages",
    "crank-nicolson": "lobatto-iiia with 2 stages",
    "gauss-legendre": "gauss",
    "radau5": "radau-iia with 3 stages",
    "runge-kutta": "rk4",
    "classical": "rk4",
    "rk": "rk4",
    "erk4": "rk4",
    "rk2": "explicit-midpoint or heun",
    "rk3": "kutta",
    "ssprk2": "ssp2",
    "ssprk3": "ssp3",
    "lobatto-iii": "lobatto-iiic*",
    "gbs": "extrapolated-midpoint",
    "gragg": "extrapolated-midpoint",
    "bulirsch-stoer": "extrapolated-midpoint",
    "deferred-corrections": "sdc",
    "avf": "hbvm with degree 1 and more stages",
    "average-vector-field": "hbvm with degree 1 and more stages",
    "energy-preserving-collocation": "hbvm with more stages than the degree",
}


_MEMBER = re.compile(r"(?P<family>.+?)[-:](?P<size>[0-9]{1,6})")


def member_named(text: str, is_known: bool = True) -> tuple[str, int | None] | None:
    """The family and the size, ``gauss-2`` or ``gauss:2``, or a single method; ``is_known`` ones
    exist.

    >>> member_named("gauss-2"), member_named("lobatto-iiia:3"), member_named("rk4")
    (('gauss', 2), ('lobatto-iiia', 3), ('rk4', None))
    """
    word = text.strip().lower()
    if word in FAMILIES:
        return (word, None) if FAMILIES[word].is_single else None
    found = _MEMBER.fullmatch(word)
    if found is None or (is_known and found["family"] not in FAMILIES):
        return None
    return found["family"], int(found["size"])


def recipe_of(name: str, size: int | None = None, options: Options = NO_OPTIONS) -> Recipe:
    """A family of one method needs no size; UnknownFamily if there is no such member."""
    family = FAMILIES.get(name)
    if family is None:
        other = OTHER_NAMES.get(name.lower().replace("_", "-").replace(" ", "-"))
        cure, meant = did_you_mean(name, FAMILIES), nearest(name, FAMILIES)
        if other:
            cure, meant = f"it is called {other} here", ""
        message = f"no family {name[:MAX_NAME]!r}"
        raise UnknownFamily(message, cure, code="unknown-word", meant=meant)
    size = _size_of(family, size)
    recipe = family.recipe(size, _complete(family, options))
    most = family.largest if family.size == STAGES.name else MAX_STAGES
    if recipe.stages > most:
        stages = counted(recipe.stages, "stage")
        message = f"{name} with {family.size}: {size} has {stages}"
        raise UnknownFamily(message, f"at most {most} are made", code="wrong-value")
    return recipe


def _size_of(family: MethodFamily, size: int | None) -> int:
    if size is None and family.is_single:
        return family.smallest
    if size is None:
        what = "number of stages" if family.size == "stages" else family.size
        example = f"write for instance {family.size}: {max(2, family.smallest)}"
        message = f"the family {family.name} needs its {what}"
        raise UnknownFamily(message, example, code="missing-key")
    if family.smallest <= size <= family.largest:
        return size
    have = str(family.smallest)
    if not family.is_single:
        have += " or more"
    if size > family.largest and not family.is_single:
        have += f", at most {family.largest}"
    of_size = f"{family.size} {size}"
    if family.size == "stages":
        of_size = counted(size, "stage")
    message = f"{family.name} with {of_size} does not exist"
    raise UnknownFamily(message, f"it has {have}", code="wrong-value")


def _complete(family: MethodFamily, options: Options) -> Options:
    for name in options:
        if name not in family.keys:
            message = f"the family {family.name} has no option {name[:MAX_NAME]!r}"
            raise UnknownFamily(message, did_you_mean(name, family.keys), code="unknown-key")
    complete: dict[str, Given] = {}
    for option in family.options:
        value = options.get(option.name, option.default)
        if value == "":
            example = f"write for instance {option.name}: {option.example}"
            message = f"the family {family.name} needs its {option.name}"
            raise UnknownFamily(message, example, code="missing-key")
        complete[option.name] = value
    return complete


MAX_NAME = 60


def diagonal_method(name: str, stages: int | None = None, **options: object) -> Method:
    """The member of a family, or a name such as ``gauss-2``; coefficients may be text or numbers.

    Raises UnknownFamily if there is no such family or member.

    >>> diagonal_method("gauss", 2).space.modulus
    x^2 + (-1)*x + 1/6
    >>> diagonal_method("sdirk2", gamma="1/4").A
    ((1/4, 0), (1/2, 1/4))
    """
    if stages is None and (member := member_named(name)) is not None:
        name, stages = member
    family = FAMILIES.get(name)
    known = {} if family is None else {x.name: x for x in family.options}
    given: dict[str, Given] = {}
    for key, value in options.items():
        if family is not None and key == family.size and stages is None:
            stages = _integer(value, key)
        else:
            given[key] = _option_value(known.get(key), value, key)
    recipe = recipe_of(name, stages, given)
    domain = Domain(recipe.numbers)
    return recipe.make(tuple(map(domain.evaluate, recipe.numbers)))


def _option_value(option: Option | None, value: object, key: str) -> Given:
    if option is None:
        return str(value)
    if option.smallest is not None:
        number = _integer(value, key)
        if number >= option.smallest:
            return number
        cure = f"give {option.smallest} or more"
        raise UnknownFamily(f"{key}: {number} is too small", cure, code="wrong-value")
    text = str(value)
    if option.words:
        if text in option.words:
            return text
        cure = did_you_mean(text, option.words)
        raise UnknownFamily(f"{key}: {text[:MAX_NAME]} is not known", cure, code="unknown-word")
    try:
        return parse(text)
    except ExpressionError as error:
        raise UnknownFamily(f"{key}: {error.message}", error.help, code=error.code) from None


def _integer(value: object, key: str) -> int:
    if isinstance(value, int) and not isinstance(value, bool):
        return value
    message = f"{key}: a whole number is expected, not {str(value)[:MAX_NAME]}"
    raise UnknownFamily(message, "write plain digits, such as 2", code="wrong-value")
