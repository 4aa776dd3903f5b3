"""The step of a method that uses derivatives of f along the solution: an additive method with the
vector fields f_1 = f and f_{k+1} = f_k' f, with ∂f_k/∂t if f depends on t, each with its power of
h.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from garkcli.frozen import Frozen, replace
from garkcli.problems.problem import Problem, field_of
from garkcli.problems.righthandside import RightHandSide, clock
from garkcli.problems.vectorfield import TIME, Group, VectorField, field_of_components, symbols
from garkcli.stepping.dependency import DependencyGraph, dependency_graph
from garkcli.stepping.fields import Fields
from garkcli.tableau.along_flow import AlongFlow
from garkcli.tableau.forms import beside_clock
from garkcli.tableau.tableau import Tableau


class Stepped(Frozen, eq=False):
    """The additive method that takes the steps, with the ``powers`` of h of its colours."""

    tableau: Tableau
    fields: Fields
    powers: tuple[int, ...]

    @property
    def graph(self) -> DependencyGraph:
        """The dependencies without unused derivatives."""
        graph = dependency_graph(self.tableau, self.fields)
        taken = {x for evaluations in graph.sums.values() for x in evaluations}
        taken |= {x for x in graph.evaluations if graph.coefficients[None, x] != "0"}
        return replace(
            graph,
            evaluations=tuple(x for x in graph.evaluations if x in taken),
            arguments={x: stages for x, stages in graph.arguments.items() if x in taken},
            coefficients={
                (stage, x): f"{text} h^{self.powers[x.colour]}"
                for (stage, x), text in graph.coefficients.items()
                if x in taken
            },
        )


def along_flow(tableau: Tableau, problem: Problem) -> Stepped:
    method = AlongFlow.of(tableau)
    made, count = method.additive, len(method.A)
    groups = problem.layout.groups
    driven: list[Group] = [group for group in groups if group != TIME]
    field: Mapping[Group, VectorField] = {group: field_of(problem, 0, group) for group in driven}
    first = {group: tuple(x.components) for group, x in field.items()}
    fields: dict[tuple[int, Group], VectorField] = {}
    for k in range(count):
        fields |= {(k, group): x for group, x in field.items() if not x.is_zero}
        if k + 1 < count:
            field = {group: _derived(x, first, groups) for group, x in field.items()}
    powers = [*range(1, count + 1)]
    if TIME in groups:
        made = beside_clock(made, count)
        assert isinstance(problem, RightHandSide)
        fields[count, TIME] = clock(problem)
        powers.append(1)
    return Stepped(made, fields, tuple(powers))


def _derived(
    field: VectorField, first: Mapping[Group, tuple[Any, ...]], groups: tuple[Group, ...]
) -> VectorField:
    variables = field.variables
    steps = [
        (x, slope)
        for group in groups
        for x, slope in zip(symbols(variables, group), first.get(group, (1,)), strict=True)
    ]
    made = tuple(sum(f.diff(x) * slope for x, slope in steps) for f in field.components)
    return field_of_components(made, variables, groups)
