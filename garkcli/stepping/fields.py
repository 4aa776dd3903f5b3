"""The vector fields of a method's colours on a problem, and the trees that they see."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

from garkcli.doing import doing
from garkcli.errors import UsageProblem
from garkcli.frozen import replace
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.problem import Problem, field_of
from garkcli.problems.righthandside import RightHandSide, clock
from garkcli.problems.vectorfield import GROUPS, TIME, Group, VectorField, symbols
from garkcli.stepping.linearly_implicit import LinearlyImplicit
from garkcli.tableau.forms import beside_clock, with_time
from garkcli.tableau.tableau import Colour, Part, Tableau


def split_into(problem: Problem, terms: int) -> Problem:
    """Terms are summed, or of one, summands with momenta come first and those with positions only
    are shared equally by the others. Raises UsageProblem if there is no natural split.
    """
    found = len(problem.terms)
    if found == terms:
        return problem
    if terms == 1:
        return problem.unsplit()
    if found == 1 and isinstance(problem, Hamiltonian):
        split = _natural(problem, terms)
        if split is not None:
            return replace(problem, terms=split)
    plural = "s" if found > 1 else ""
    cure = f"give a list of {terms} in its file"
    if found > 1:
        cure += f", or choose a method for {found}"
    elif isinstance(problem, Hamiltonian):
        cure += ": no sum of parts with and without momenta"
    message = f"{problem.name} has {found} term{plural}, the method is for {terms}"
    raise UsageProblem(message, cure, code="other-problem")


def _natural(problem: Hamiltonian, terms: int) -> tuple[Any, ...] | None:
    import sympy

    momenta = set(symbols(problem.variables, "p"))
    summands = sympy.Add.make_args(problem.terms[0])
    kinetic: list[Any] = []
    potential: list[Any] = []
    for x in summands:
        part = kinetic if x.free_symbols & momenta else potential
        part.append(x)
    if not kinetic or not any(x.free_symbols for x in potential):
        return None
    share = sympy.expand(sympy.Add(*potential) / (terms - 1))
    return (sympy.Add(*kinetic), *(share,) * (terms - 1))


Fields: TypeAlias = Mapping[tuple[int, Group], VectorField]


def driven(colour: Colour) -> tuple[Group, ...]:
    return GROUPS if colour.part == "y" else (colour.part,)


def with_joined_terms(tableau: Tableau) -> Tableau:
    """A partitioned method for q̇ = V(q, p), ṗ = F(q, p), both in one term."""
    has_one_space = tableau.size == 2 and len(tableau.spaces) == 1
    driven_parts = {x.part for x in tableau.colours}
    if not has_one_space or driven_parts != set(GROUPS):
        return tableau
    return replace(tableau, colours=tuple([replace(x, term=0) for x in tableau.colours]))


def stepped_terms(tableau: Tableau, problem: Problem) -> Tableau:
    """The tableau with the terms of its steps; UsageProblem if it drives q and p in vain."""
    if isinstance(problem, Hamiltonian):
        return with_joined_terms(tableau)
    if tableau.is_partitioned:
        message = f"the method drives positions and momenta, and {problem.name} has none"
        cure = "choose a Hamiltonian problem, or a method whose colours drive all unknowns"
        raise UsageProblem(message, cure, code="other-problem")
    return tableau


def with_clock(tableau: Tableau, problem: Problem) -> Tableau:
    """Time as last colour, if needed: stages are at t_0 + h c^{l}; UsageProblem without nodes."""
    if isinstance(problem, Hamiltonian) or not problem.has_time:
        return tableau
    if LinearlyImplicit.of(tableau) is not None:
        return beside_clock(tableau, 1)
    made = with_time(tableau)
    if made is None:
        raise UsageProblem(
            f"{problem.name} depends on t, and the stages of the method have no times: a colour is "
            "linear, or colours share stages and differ in their nodes",
            "choose a problem without t, or give time as an unknown with the derivative 1",
            code="other-problem",
        )
    return made


def fields_of(tableau: Tableau, problem: Problem) -> Fields:
    """Raises UsageProblem if the problem does not suit the structure of the method."""
    if isinstance(problem, Hamiltonian):
        fields = _hamiltonian_fields(tableau, problem)
    else:
        fields = _right_hand_sides(tableau, problem)
    _check_edges(tableau, fields)
    return fields


def _right_hand_sides(tableau: Tableau, problem: RightHandSide) -> Fields:
    """f^{l} of each colour l, and ṫ = 1 of the last one if the problem depends on time."""
    fields: dict[tuple[int, Group], VectorField] = {}
    for m, colour in enumerate(tableau.colours):
        if problem.has_time and m == tableau.size - 1:
            fields[m, TIME] = clock(problem)
            continue
        field = field_of(problem, colour.term, "y")
        if not field.is_zero:
            fields[m, "y"] = field
    return fields


def _hamiltonian_fields(tableau: Tableau, problem: Hamiltonian) -> Fields:
    driving = set()
    for x in tableau.colours:
        driving |= {(x.term, group) for group in driven(x)}
    for term in range(len(problem.terms)):
        for group in GROUPS:
            if (term, group) in driving:
                continue
            if not field_of(problem, term, group).is_zero:
                raise _no_colour(problem, term, group)
    fields: dict[tuple[int, Group], VectorField] = {}
    for m, colour in enumerate(tableau.colours):
        for group in driven(colour):
            field = field_of(problem, colour.term, group)
            if not field.is_zero:
                fields[m, group] = field
    return fields


def _no_colour(problem: Hamiltonian, term: int, group: Group) -> UsageProblem:
    on, other = "q", "p"
    if group == "q":
        on, other = "p", "q"
    H = f"H{{{term + 1}}}"
    message = f"{H} of {problem.name} depends on {on}, but the method has no colour for that"
    cure = f"choose a problem whose {H} depends on {other} alone, or another structure"
    return UsageProblem(message, cure, code="other-problem")


def _check_edges(tableau: Tableau, fields: Fields) -> None:
    """Refuses fields that are not linear, or that need a missing block."""
    for (l, driven_group), field in fields.items():
        colour = tableau.colours[l]
        name = colour.name
        if colour.is_linear and not field.is_linear:
            raise UsageProblem(
                f"the method takes the field of colour {name} to be linear, and here it is not",
                "choose a problem with quadratic kinetic energy"
                if driven_group == "q"
                else "choose a problem in which it is",
                code="other-problem",
            )
        for m, driver in fields:
            if driver in field.depends and tableau.block(l, m) is None:
                other = tableau.colours[m].name
                raise UsageProblem(
                    f"the field of colour {name} depends on variables driven by colour {other}, "
                    f"on which its stages do not depend",
                    "choose a problem of the form that the structure is for",
                    code="other-problem",
                )


@doing("what the problem sees")
def visible_tableau(tableau: Tableau, fields: Fields) -> Tableau:
    """The tableau whose trees the problem sees, of the observed order: each nonzero field has a
    colour and stages of its own, and no stage sees what its field does not depend on.
    """
    colours, spaces = [], []
    for k, ((m, group), field) in enumerate(fields.items()):
        colour = tableau.colours[m]
        part: Part = "y" if group == TIME else group
        kind = colour.kind.of_linear_field if field.is_linear else colour.kind
        colours.append(replace(colour, space=k, part=part, kind=kind))
        spaces.append(tableau.space(m))
    blocks = {}
    for k, ((l, _), field) in enumerate(fields.items()):
        for n, (m, driver) in enumerate(fields):
            block = tableau.block(l, m)
            if driver in field.depends and block is not None:
                blocks[k, n] = block
    return Tableau(tuple(spaces), tuple(colours), blocks)


def visible_trees(fields: Fields) -> str:
    """The trees that a problem with these fields sees, in one line."""
    if all(field.is_linear for field in fields.values()):
        return "a linear problem sees only the unbranched trees"
    if _is_linear_but_for_time(fields):
        return "linear except in t: at most one branch at a vertex is not time"
    # velocities depend on momenta alone, and forces on positions
    if all(group not in field.depends for (_, group), field in fields.items()):
        velocities = [x for (_, group), x in fields.items() if group == "q"]
        if all(field.is_linear for field in velocities):
            return (
                "with quadratic kinetic energy it sees the trees in which velocities and forces "
                "alternate and velocities do not branch"
            )
        return "a separable problem sees the trees in which velocities and forces alternate"
    parts = [f"it sees the trees of all colours of the method{_branching(fields)}"]
    dependences = {field.depends for field in fields.values()}
    alone = (("positions", ("q",), "velocities"), ("momenta", ("p",), "forces"))
    for x, groups, branch in alone:
        if groups in dependences:
            parts.append(f"parts that depend on {x} alone have only {branch} as branches")
    return "; ".join(parts)


def _is_linear_but_for_time(fields: Fields) -> bool:
    """Whether right-hand sides with time are linear in the unknowns, with constant coefficients."""
    for (_, group), field in fields.items():
        if group not in ("y", TIME):
            return False
        if "y" in field.depends and not field.is_linear_in("y"):
            return False
    return True


def _branching(fields: Fields) -> str:
    """Words on the largest number of branches of a vertex; empty if unbounded."""
    degrees = []
    for field in fields.values():
        degree = field.degree
        if degree is None:
            return ""
        degrees.append(degree)
    return f", up to degree {max(degrees)}"
