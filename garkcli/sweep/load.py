"""A spec file as a plan."""

from __future__ import annotations

from typing import Any, cast

from garkcli.methodfile.sweep_file import read_sweep
from garkcli.methodfile.sweep_search import SearchText
from garkcli.methodfile.sweep_text import TemplateText
from garkcli.sweep.columns import columns, property_kind
from garkcli.sweep.plan import Condition, Criteria, Plan, Relation, Template


def load_plan(path: str) -> Plan:
    """Read a spec file.

    Raises:
        MethodFileError: every fault of it, with positions.
    """
    kinds = {name: property_kind(name) for name in columns()}
    text = read_sweep(path, kinds)
    conditions = tuple(
        Condition(name, cast(Relation, relation), bound)
        for name, relation, bound in text.conditions
    )
    search = text.search or SearchText(range(0))
    templates = tuple(_template(x, search) for x in text.templates)
    criteria = Criteria(tuple(text.columns), conditions)
    best, pareto = tuple(text.best), tuple(text.pareto)
    return Plan(text.name, templates, text.grids, criteria, best, pareto)


def _template(given: TemplateText, search: SearchText) -> Template:
    """A method file, with its searches where unknowns are left to them."""
    plain = given.name, given.text, given.parameters
    if not given.order:
        return Template(*plain)
    return Template(*plain, given.order, search.seeds, search.starts)


def sweep_schema() -> dict[str, Any]:
    """The JSON Schema of the spec files of sweeps, as plain data.

    >>> sweep_schema()["type"]
    'object'
    """
    from garkcli.methodfile.sweep_schema import sweep_file_schema

    return sweep_file_schema({name: property_kind(name) for name in columns()})
