"""A spec file as a plan."""

from __future__ import annotations

from typing import cast

from garkcli.methodfile.sweep_file import read_sweep
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
    templates = tuple(
        Template(x.name, x.text, x.parameters) for x in text.templates
    )
    criteria = Criteria(tuple(text.columns), conditions)
    best, pareto = tuple(text.best), tuple(text.pareto)
    return Plan(text.name, templates, text.grids, criteria, best, pareto)
