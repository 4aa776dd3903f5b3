"""What ``--problem`` takes: a built-in problem or a problem file, split for the method at hand."""

from __future__ import annotations

import os
from contextlib import suppress
from typing import TYPE_CHECKING

import click
from click.shell_completion import CompletionItem

from garkcli.errors import UsageProblem, did_you_mean
from garkcli.files import note_input

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.cli.options import Output
    from garkcli.problems.hamiltonian import Hamiltonian
    from garkcli.problems.problem import Problem
    from garkcli.tableau.tableau import Tableau


def is_path(text: str) -> bool:
    """Whether this is the path of a problem file rather than the name of a built-in problem."""
    return text == "-" or text.endswith((".yaml", ".yml")) or "/" in text or "\\" in text


class ProblemType(click.ParamType):  # type: ignore[type-arg]
    """The name of a built-in problem or the path of a problem file."""

    name = "problem"

    def get_metavar(self, param: click.Parameter, ctx: click.Context | None = None) -> str:
        """What help shows."""
        return "NAME|FILE"

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Refuse what is neither, before anything is read."""
        from garkcli.problems.builtin import PROBLEMS

        if value not in PROBLEMS and not is_path(value):
            cure = did_you_mean(value, tuple(PROBLEMS))
            self.fail(f"no problem {value!r} (a problem file ends in .yaml); {cure}", param, ctx)
        note_input(value)
        return value

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """The names, and problem files; folders are for the shell, which goes on below them."""
        from garkcli.problems.builtin import PROBLEMS

        found = [name for name in PROBLEMS if name.startswith(incomplete)]
        if found:
            folder, start = os.path.split(incomplete)
            with suppress(OSError):
                found += sorted(
                    os.path.join(folder, name)
                    for name in os.listdir(folder or ".")
                    if name.startswith(start) and name.endswith((".yaml", ".yml"))
                    if name.isprintable()
                )
            return [CompletionItem(name) for name in found]
        return [CompletionItem(incomplete, type="file")]


def unsplit_problem(name_or_path: str, stiffness: fmpq | None) -> Problem:
    """The problem called so in one term, or as a file has it.

    Raises:
        UsageProblem: there is no such problem, or it has no stiffness.
        MethodFileError: the file has faults.
    """
    if is_path(name_or_path):
        from garkcli.methodfile.problem import load_problem

        return load_problem(name_or_path, stiffness)
    from garkcli.problems.builtin import problem

    return problem(name_or_path, 1, stiffness=stiffness)


def find_problem(
    name_or_path: str, tableau: Tableau, seed: int | None = None, stiffness: fmpq | None = None
) -> Problem:
    """The problem called so or described in that file, split into the terms that ``tableau`` is
    for.

    Args:
        name_or_path: the name of a built-in problem, or the path of a problem file.
        tableau: of the method.
        seed: for problems with random coefficients; 1 by default.
        stiffness: for those that have one.

    Raises:
        UsageProblem: there is no such problem, it takes no seed or no stiffness, or it has another
            number of terms.
        MethodFileError: the file has faults.
    """
    from garkcli.problems.builtin import check_seed, problem
    from garkcli.problems.oscillator import terms_of
    from garkcli.stepping.fields import with_joined_terms

    check_seed(name_or_path, seed)
    terms = terms_of(with_joined_terms(tableau))
    if is_path(name_or_path):
        from garkcli.methodfile.problem import load_problem
        from garkcli.stepping.fields import split_into

        return split_into(load_problem(name_or_path, stiffness), terms)
    return problem(name_or_path, terms, 1 if seed is None else seed, stiffness)


def find_hamiltonian(name_or_path: str, tableau: Tableau, seed: int | None = None) -> Hamiltonian:
    """The same, where it has to be Hamiltonian.

    Raises:
        UsageProblem: it is not, or see ``find_problem``.
        MethodFileError: the file has faults.
    """
    from garkcli.problems.hamiltonian import Hamiltonian

    found = find_problem(name_or_path, tableau, seed)
    if not isinstance(found, Hamiltonian):
        message = f"--problem: {found.name} is not Hamiltonian"
        raise UsageProblem(message, "choose one that is", code="other-problem")
    return found


def note_changing(problem: Problem, output: Output) -> None:
    """Say which invariants of a problem file are none: their errors are not the method's."""
    from garkcli.convergence.reference import changing

    for name, change, time in changing(problem):
        output.note(
            f"{problem.name}: {name} is no invariant: the exact solution changes it by "
            f"{change:.2g} to t = {time}"
        )
