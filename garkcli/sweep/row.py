"""The row of one method: its key, its parameters and its columns."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any, TypeAlias, TypeGuard

from flint import fmpq

from garkcli.constructions.rosenbrock import is_rosenbrock
from garkcli.design.choices import values_text
from garkcli.design.design import find_parameters
from garkcli.design.ideal import Ideal
from garkcli.design.member import is_admissible, member
from garkcli.design.search.run import FoundMethod, results
from garkcli.design.solutions import solutions
from garkcli.errors import GarkError, MethodError, MethodFileError, counted
from garkcli.exact.field import Number
from garkcli.methodfile.family import FamilyFile, loads_family, with_values
from garkcli.methodfile.load import loads
from garkcli.methodfile.search_file import FileSearch
from garkcli.problems.draw import Draw
from garkcli.sweep.columns import SweptMethod, Value, columns, is_value, value_of
from garkcli.sweep.plan import Criteria, Point
from garkcli.tableau.tableau import Tableau


def first_find(point: Point) -> FoundMethod | None:
    template = point.template
    assert point.seed is not None
    if template.is_drawn:
        return _drawn(point, Draw(point.seed))
    for result in results(_file_search(point).search, template.starts, point.seed, most=1):
        if result.methods:
            return result.methods[0]
    return None


def _drawn(point: Point, draw: Draw) -> FoundMethod:
    """Returns a method with random parameters whose pair has the order; MethodError without one."""
    family = _file_search(point).family
    order = point.template.order
    design = find_parameters(family, order, "pair")
    step, criterion, drawn = design.last, design.criterion_of(design.last), None
    if criterion is not None and isinstance(step.ideal, Ideal) and step.kind != "none":
        drawn = criterion.point(step.ideal, draw)
    for solution in () if drawn is None else solutions(drawn):
        for root in solution.real:
            if is_admissible(family, solution, root):
                values = {name: solution.values[name] for name in family.parameters}
                return FoundMethod(1, "exact", order, values_text(values, root), "0")
    message = f"no transfer is known whose symplectic pair has order {order}"
    cure = "take methods with positive weights whose symplectic pair has this order"
    raise MethodError(message, cure, code="not-found")


def method_found(point: Point, method: FoundMethod) -> Tableau:
    claim = f"{'pair-' * point.template.is_drawn}order: {method.order}"
    return loads(
        with_values(_file_search(point).family, method.values, "", claim), point.key
    ).tableau


def _file_search(point: Point) -> FileSearch:
    template = point.template
    return FileSearch(template.text, template.name, tuple(point.settings.items()), template.order)


Row: TypeAlias = "dict[str, Value | dict[str, str]]"
"""A mapping with ``key``, ``spec``, ``kept``, ``method``, ``parameters`` and the columns; with
``failure`` if there is no such method. Rows of searches also have ``seed``, and with a result
``proof`` and ``values``.
"""


_TEXTS = ("key", "spec", "method")
_SETTINGS = ("parameters", "values")


def is_row(row: Any) -> TypeGuard[Row]:
    """Returns whether data from a file are a row with values of the right types."""
    if not isinstance(row, dict) or not isinstance(row.get("kept"), bool):
        return False
    if not all(isinstance(row.get(name), str) for name in _TEXTS):
        return False
    for settings in (row.get(name, {}) for name in _SETTINGS):
        if not isinstance(settings, dict):
            return False
        if not all(isinstance(value, str) for value in settings.values()):
            return False
    if not isinstance(row.get("failure", ""), str):
        return False
    return all(is_value(row.get(name)) for name in columns())


def row_of(criteria: Criteria, point: Point) -> Row:
    """Returns the row of a method; conditions come first, and the first that fails ends the row."""
    row = _start(criteria, point)
    try:
        tableau = _searched(point, row) if point.template.is_searched else _tableau(point)
        if tableau is None:
            return {**row, "kept": not criteria.conditions}
        if not is_rosenbrock(tableau):
            tableau.demand_fields("gark sweep")
        judged = SweptMethod(tableau)
        for condition in criteria.conditions:
            value = value_of(condition.column, judged)
            row[condition.column] = value
            if not condition.holds(value):
                return row
        for name in criteria.columns:
            if name not in row:
                row[name] = value_of(name, judged)
    except (GarkError, ZeroDivisionError) as error:
        row["failure"] = _message(error)
        return row
    return {**row, "kept": True}


def crashed_row(criteria: Criteria, point: Point, why: str) -> Row:
    return {**_start(criteria, point), "failure": f"its process was ended {why}"}


def _start(criteria: Criteria, point: Point) -> Row:
    row: Row = {
        "key": point.key,
        "spec": criteria.fingerprint(point.template),
        "kept": False,
        "method": point.template.name,
        "parameters": dict(point.settings),
    }
    return row if point.seed is None else {**row, "seed": point.seed}


def _message(error: Exception) -> str:
    if isinstance(error, MethodFileError) and error.faults:
        return error.faults[0].message
    if isinstance(error, GarkError):
        return error.message
    return "a denominator is zero"


def _tableau(point: Point) -> Tableau:
    """Returns the method of a point, as a member of its family if possible."""
    family = _family(point.template.text, point.template.parameters)
    if family is not None:
        values: Mapping[str, Number] = {
            name: fmpq(*map(int, text.split("/"))) for name, text in point.settings.items()
        }
        return member(family.tableau, family.ring, values)
    method = loads(point.template.text, point.key, point.settings)
    if method.tolerance is not None:
        raise MethodError("its coefficients are rounded", "give exact ones", code="rounded")
    return method.tableau


def _searched(point: Point, row: Row) -> Tableau | None:
    """Records the method found from a seed; None if its coefficients are not known exactly."""
    method = first_find(point)
    if method is None:
        starts = counted(point.template.starts, "start")
        raise MethodError(f"nothing found from {starts}", "take more", code="not-found")
    row["proof"] = method.proof
    row["values"] = dict(method.values)
    return method_found(point, method) if method.is_exact else None


@lru_cache(maxsize=32)
def _family(text: str, parameters: tuple[str, ...]) -> FamilyFile | None:
    """Returns the family of a file; None if a parameter is not free or there are radicals."""
    try:
        family = loads_family(text)
    except GarkError:
        return None
    if set(family.parameters) != set(parameters) or family.radicals:
        return None
    return family
