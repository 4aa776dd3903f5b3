"""A spec file as a plan."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, cast

from garkcli.glossary.key import Files, Key
from garkcli.methodfile.grammar import told as entries_of
from garkcli.methodfile.sweep_file import file_of, read_sweep, sweep_file_schema
from garkcli.methodfile.sweep_text import SearchText, TemplateText
from garkcli.sweep.columns import columns, property_kind
from garkcli.sweep.plan import Condition, Criteria, Plan, Relation, Template


def load_plan(path: str) -> Plan:
    """Read a spec file.

    Raises:
        MethodFileError: every fault of it, with positions.
    """
    text = read_sweep(path, _kinds())
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
    return sweep_file_schema(_kinds())


def told(files: Files) -> Iterable[Key]:
    """What is told of the keys of spec files."""
    return entries_of(file_of(_kinds()).inside(), files.page)


def _kinds() -> dict[str, str]:
    """The columns, and what each is."""
    return {name: property_kind(name) for name in columns()}
