"""A method with its results and the texts of its file, as the sections use them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, TypeAlias

from flint import fmpq

from garkcli.api.anymethod import method_of
from garkcli.api.methods import analyse
from garkcli.check.check_file import check_every, check_method
from garkcli.check.outcome import Outcome
from garkcli.constructions.derivatives import Derivatives
from garkcli.constructions.multirate import SLOW
from garkcli.errors import HasFreeParameters, MethodFileError
from garkcli.frozen import Frozen
from garkcli.methodfile.bibliography import reference_of
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import NO_SETTINGS, load
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.reference import Reference
from garkcli.report.checked import whole
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Tableau

Content: TypeAlias = Mapping[str, Any]
"""The variables of a template."""
MOST_CONDITIONS = 500
"""Most conditions of one method on a page; with many methods it is less."""
USUAL_CONDITIONS = 40
"""Most conditions of one method on a page without details."""
MOST_STAGES = 12
"""Most stages with irrational or rounded coefficients: with 16, intervals take ten seconds."""


class Reported(Frozen):
    """A method, or None for a file with faults or free parameters, and how much of it is shown."""

    outcome: Outcome
    method: GarkMethod | None = None
    reference: str = ""
    bibliography: Reference | None = None
    description: str = ""
    wanted_order: int | None = None
    has_pictures: bool = True
    has_details: bool = False
    most_conditions: int = MOST_CONDITIONS

    @property
    def tableau(self) -> Tableau | None:
        """The tableau; that of a family has entries in its parameters."""
        found = self.outcome.found
        return None if found is None else found.tableau

    @property
    def free(self) -> str | None:
        """The first free parameter, or None."""
        every = self.outcome.every
        return None if every is None else every.parameters[0]

    @property
    def stages(self) -> tuple[int, ...]:
        """The numbers of stages: of f in Rosenbrock methods, of slow parts with exact fast ones."""
        if self.tableau is None:
            return ()
        stages = tuple(self.tableau.space(l).stages for l in range(self.tableau.size))
        if self.outcome.rosenbrock is not None:
            return stages[: len(stages) // 2]
        if self.outcome.derivatives is not None:
            return (len(Derivatives.of(self.tableau).nodes),)
        if self.outcome.nystrom is not None or self.outcome.nprk is not None:
            return stages[:1]
        return stages if self.outcome.infinitesimal is None else stages[SLOW:]

    @property
    def tells_pair(self) -> bool:
        """Whether conjugate and pair are shown: for several colours, or by claims about them."""
        if self.tableau is not None and self.tableau.size > 1:
            return True
        return any(x.claim.startswith(("conjugate", "pair")) for x in self.outcome.claims)

    @property
    def has_names(self) -> bool:
        return self.outcome.rosenbrock is not None or self.outcome.nystrom is not None

    @property
    def is_slow(self) -> bool:
        """Whether its stability takes long: many stages with irrational or rounded numbers."""
        if self.tableau is None:
            return False
        stages = sum(self.stages)
        is_rational = self.tableau.degree == 1 and self.tolerance is None
        return stages > MOST_STAGES and not is_rational

    @property
    def tolerance(self) -> fmpq | None:
        return None if self.method is None else self.method.tolerance


def reported(
    given: Any,
    order: int | None = None,
    has_pictures: bool = True,
    settings: Mapping[str, str] = NO_SETTINGS,
) -> Reported:
    """Returns a method with results, or the faults of a file; MethodError for other arguments."""
    if isinstance(given, (str, os.PathLike)):
        try:
            method: GarkMethod = load(os.fspath(given), settings)
        except HasFreeParameters as error:
            outcome = check_every(error, DEFAULT_LIMIT, False, settings)
            if not outcome.is_read:
                return Reported(outcome)
            line, fields = reference_of(error.text, error.source)
            return Reported(outcome, reference=line, bibliography=fields, wanted_order=order)
        except MethodFileError as error:
            source = error.source
            return Reported(Outcome(source, source, faults=error.faults, text=error.text))
    else:
        method = method_of(given, is_any_kind=True)
    if isinstance(method, MethodFile):
        about = method.reference, method.bibliography, method.description
        outcome = check_method(method)
        return Reported(outcome, method if outcome.is_read else None, *about, order, has_pictures)
    name = method.name or "the method"
    outcome = whole(analyse(method), name)
    return Reported(outcome, method, wanted_order=order, has_pictures=has_pictures)
