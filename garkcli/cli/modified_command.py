"""``gark modified``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.cli.companion import exact_companion
from garkcli.cli.options import Output, check_document, declared
from garkcli.cli.problems import find_hamiltonian
from garkcli.cli.stepping import refuse_misplaced
from garkcli.errors import UsageProblem
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.backward.formulas import ModifiedFormula
    from garkcli.tableau.garkmethod import GarkMethod


@declared("modified", FORMATS)
def command(
    file: str,
    order: int,
    which: str | None,
    equation: bool,
    problem: str | None,
    seed: int | None,
    digits: int | None,
    document: bool,
    settings: dict[str, str],
    output: Output,
) -> int:
    """The modified equation of a method, in trees, exactly.

    A step is a step along the exact solution of another equation, whose coefficients are listed:
    of a symplectic method those of its modified Hamiltonian in free trees. They tell the order
    to which the method is symplectic and conserves energy, and its effective order: the order in
    the best coordinates.

    With --problem the modified Hamiltonian itself, of a method that is not symplectic the modified
    equation.
    """
    from garkcli.backward.series import possible_order
    from garkcli.backward.summary import backward_analysis
    from garkcli.methodfile.load import load
    from garkcli.methodfile.naming import called
    from garkcli.page.latex import fragment
    from garkcli.report.modified import REPORT, ModifiedReport

    check_document(document, output.format)
    method = exact_companion(load(file, settings), which)
    tableau = method.tableau
    formula = None
    if problem is not None:
        refuse_misplaced(problem, seed, None, {})
        formula = _formula(method, problem, seed, order)
    elif seed is not None:
        raise UsageProblem("--seed is for the problem", "give --problem too", code="option-alone")
    if formula is not None:
        # the problem sees fewer trees than the tableau has
        order = possible_order(tableau, order)
    found = backward_analysis(tableau, order, method.tolerance)
    report = ModifiedReport(
        called(file), method.name, found, method.derivation, digits, equation, formula
    )
    if output.format == "latex":
        output.write(fragment([REPORT.render([report], "latex")], document))
    else:
        output.tell(REPORT, [report])
    return 0


def _formula(method: GarkMethod, problem: str, seed: int | None, order: int) -> ModifiedFormula:
    """The formula on the problem of --problem.

    Raises:
        UsageProblem: the coefficients are rounded, or the problem is not Hamiltonian.
    """
    from garkcli.backward.formulas import modified_formula

    if method.tolerance is not None:
        raise UsageProblem(
            "--problem: a formula has exact coefficients, and those of the file are rounded",
            "give exact coefficients, without tolerance",
            code="rounded",
        )
    solved = find_hamiltonian(problem, method.tableau, seed)
    return modified_formula(method.tableau, solved, order).expanded()
