"""A method as its sections are made: what is found of it, and what its file says of it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import cached_property
from typing import Any

from flint import fmpq

from garkcli.api.anymethod import method_of
from garkcli.api.methods import analyse
from garkcli.check.check_file import check_method
from garkcli.check.every_value import check_every
from garkcli.check.outcome import Outcome
from garkcli.errors import HasFreeParameters, MethodFileError
from garkcli.frozen import Frozen
from garkcli.methodfile.bibliography import reference_of
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import NO_SETTINGS, load
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.reference import Reference
from garkcli.report.checked import REPORT
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Tableau

MOST_CONDITIONS = 500
"""Of one method in one page; of many methods fewer each."""
MOST_STAGES = 12
"""Of methods with irrational or rounded coefficients: with 16 their intervals of stability take up
to ten seconds.
"""


class Reported(Frozen):
    """A method, or a file that is none.

    Attributes:
        outcome: what became of it.
        method: it; None of a file with free parameters, and of one that cannot be read.
        reference: where it was published, in one line.
        bibliography: the fields of the reference; None where it is plain text.
        description: what its file says of it.
        wanted_order: up to which order its conditions are listed; None for the first one that
            fails.
        has_pictures: whether there are pictures of it.
        most_conditions: how many of its conditions are listed at most.
    """

    outcome: Outcome
    method: GarkMethod | None = None
    reference: str = ""
    bibliography: Reference | None = None
    description: str = ""
    wanted_order: int | None = None
    has_pictures: bool = True
    most_conditions: int = MOST_CONDITIONS

    @cached_property
    def data(self) -> dict[str, Any]:
        """What ``gark check --format json`` says of it."""
        return REPORT.data(self.outcome)

    @property
    def tableau(self) -> Tableau | None:
        """Its tableau, that of a family with entries in the parameters."""
        if self.outcome.analysis is not None:
            return self.outcome.analysis.tableau
        every = self.outcome.every
        return None if every is None else every.tableau

    @property
    def free(self) -> str | None:
        """The first of its free parameters; None where it has none."""
        every = self.outcome.every
        return None if every is None else every.parameters[0]

    @property
    def is_slow(self) -> bool:
        """Whether its stability takes long: of many stages, with irrational or rounded numbers."""
        if self.tableau is None:
            return False
        stages = sum(space.stages for space in self.tableau.spaces)
        is_rational = self.tableau.degree == 1 and self.tolerance is None
        return stages > MOST_STAGES and not is_rational

    @property
    def tolerance(self) -> fmpq | None:
        """The rounding of its coefficients."""
        return None if self.method is None else self.method.tolerance


class _Wishes(Frozen):
    """What the page is to have.

    Attributes:
        order: up to which order conditions are listed; None for the first that fails.
        has_pictures: whether there are pictures.
        settings: values of the parameters of a file.
    """

    order: int | None
    has_pictures: bool
    settings: Mapping[str, str]


def reported(
    given: Any,
    order: int | None = None,
    has_pictures: bool = True,
    settings: Mapping[str, str] = NO_SETTINGS,
) -> Reported:
    """What is found of a method.

    Args:
        given: a path, or a name of the catalogue, whose faults are part of the page; a method, or
            arrays, as ``assert_order`` takes them.
        order: up to which order conditions are listed; None for the first that fails.
        has_pictures: whether there are pictures of it.
        settings: values of the parameters of a file.

    Raises:
        MethodError: what is given is no method.
    """
    wishes = _Wishes(order, has_pictures, settings)
    if isinstance(given, (str, os.PathLike)):
        return _of_path(os.fspath(given), wishes)
    method = method_of(given)
    if isinstance(method, MethodFile):
        return _of_file(method, wishes)
    name = method.name or "the method"
    outcome = Outcome(name, name, analysis=analyse(method))
    return Reported(outcome, method, wanted_order=order, has_pictures=has_pictures)


def _of_path(path: str, wishes: _Wishes) -> Reported:
    try:
        method = load(path, wishes.settings)
    except HasFreeParameters as error:
        return _of_family(error, wishes)
    except MethodFileError as error:
        source = error.source
        return Reported(Outcome(source, source, faults=error.faults, text=error.text))
    return _of_file(method, wishes)


def _of_family(error: HasFreeParameters, wishes: _Wishes) -> Reported:
    """A file with free parameters."""
    outcome = check_every(error, DEFAULT_LIMIT, False, wishes.settings)
    if not outcome.is_read:
        return Reported(outcome)
    line, fields = reference_of(error.text, error.source)
    return Reported(outcome, reference=line, bibliography=fields, wanted_order=wishes.order)


def _of_file(method: MethodFile, wishes: _Wishes) -> Reported:
    return Reported(
        check_method(method),
        method,
        method.reference,
        method.bibliography,
        method.description,
        wishes.order,
        wishes.has_pictures,
    )
