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
"""The largest number of conditions of one method on a page; with many methods it is less."""
USUAL_CONDITIONS = 40
"""The largest number of conditions of one method on a page without details."""
MOST_STAGES = 12
"""The largest number of stages of methods with irrational or rounded coefficients: with 16, the
intervals of stability take up to ten seconds.
"""


class Reported(Frozen):
    """A method, or a file that cannot be read as one.

    ``method`` is None for a file with free parameters and for one that cannot be read.
    ``wanted_order`` is the last order whose conditions are listed, None for the first that fails;
    at most ``most_conditions`` are listed. With ``has_details`` the page has everything.
    """

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
        """The number of stages of each colour.

        For a Rosenbrock method those of f, for a multirate method with the exact fast part those of
        the slow parts; Nyström and partitioned methods have one colour.
        """
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
        """Whether its conjugate and pair are shown: it has several colours, or the file claims
        something about them.
        """
        if self.tableau is not None and self.tableau.size > 1:
            return True
        return any(x.claim.startswith(("conjugate", "pair")) for x in self.outcome.claims)

    @property
    def has_names(self) -> bool:
        """Whether the colours of its trees have names."""
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
    """Returns a method with its results.

    ``given`` is a path or a name of the catalogue, whose faults become part of the page; a method;
    or arrays, as in ``assert_order``. Conditions are listed up to ``order``, by default the first
    that fails. Raises MethodError if ``given`` is not a method.
    """
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
