"""Loading, analysis and verification of one file, without output."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from garkcli import errors
from garkcli.check.analysis import (
    Analysis,
    AnyAnalysis,
    analyse,
    analyse_any,
    looks_rounded,
    remark_of,
)
from garkcli.check.claims import verify
from garkcli.check.culprit import culprit, misprints
from garkcli.check.outcome import Outcome
from garkcli.doing import doing
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.expectations import highest_order
from garkcli.methodfile.load import NO_SETTINGS, load
from garkcli.order.certificate import DEFAULT_LIMIT

if TYPE_CHECKING:
    from collections.abc import Mapping

    from garkcli.order.constants import ErrorConstants


def check_file(
    path: str,
    limit: int = DEFAULT_LIMIT,
    want_constants: bool = False,
    settings: Mapping[str, str] = NO_SETTINGS,
) -> Outcome:
    """Checks a file; faults are in the outcome. Orders stop at ``limit``, or at a higher claim."""
    try:
        method = load(path, settings)
    except errors.HasFreeParameters as error:
        return check_every(error, limit, want_constants, settings)
    except errors.MethodFileError as error:
        return Outcome(error.source, error.source, faults=error.faults, text=error.text)
    return check_method(method, limit, want_constants)


MOST_PARAMETERS = 30
"""Most free parameters: 27 take ten seconds, 35 minutes."""


@doing("what holds for every value of the parameters")
def check_every(
    file: errors.HasFreeParameters, limit: int, want_constants: bool, settings: Mapping[str, str]
) -> Outcome:
    from garkcli.check.every_value import every_value, verify_every  # most files are methods
    from garkcli.methodfile.family import family_of, refuse_rounded

    try:
        family = family_of(file, settings)
        refuse_rounded(family)
        count = len(family.parameters)
        if count > MOST_PARAMETERS:
            message = f"{count} free parameters (limit {MOST_PARAMETERS})"
            cure = "give values to some by --set; gark design asks for one order"
            return _refused(file, message, cure, "too-many")
        further = [x for x in family.claims if x.key.startswith(("dense", "predictor"))]
        if further:
            name = family.parameters[0]
            message = f"{further[0].key} is claimed, and {name} is free"
            cure = f"gark judges dense output and predictors for single values: --set {name}=1/2"
            return _refused(file, message, cure, "free-parameters")
        facts = every_value(family, max(limit, highest_order(family.claims) + 1))
    except errors.MethodFileError as error:
        return Outcome(file.source, file.source, faults=error.faults, text=file.text)
    except errors.GarkError as error:
        return _refused(file, error.message, error.help, error.code)
    if want_constants:
        name = facts.parameters[0]
        message = "error constants are numbers, and a parameter is free"
        return _refused(file, message, f"choose a value: --set {name}=1/2", "free-parameters")
    return Outcome(
        file=family.source,
        name=family.name,
        structure=family.structure,
        every=facts,
        claims=verify_every(family.claims, facts),
        text=file.text,
        left_behind=family.left_behind,
    )


def _refused(file: errors.HasFreeParameters, message: str, cure: str, code: str) -> Outcome:
    faults = (errors.Remark(message, cure, code=code),)
    return Outcome(file.source, file.source, faults=faults, text=file.text)


def check_method(
    method: MethodFile, limit: int = DEFAULT_LIMIT, want_constants: bool = False
) -> Outcome:
    """Checks a method; orders stop at ``limit``, or at a higher claim."""
    reach = max(limit, highest_order(method.claims) + 1)
    if not method.tableau.is_gark:
        return _check_other_kind(method, reach, want_constants)
    try:
        analysis = analyse(method.tableau, reach, method.tolerance, method.further)
    except (errors.MethodError, errors.UsageProblem) as error:
        # it has too many stages, or needs numpy
        fault = errors.Remark(error.message, error.help, code=error.code)
        return Outcome(method.source, method.name, faults=(fault,), text=method.text)
    claims = verify(method.claims, analysis)
    remark = remark_of(method, analysis)
    return Outcome(
        file=method.source,
        name=method.name,
        structure=method.structure,
        analysis=analysis,
        claims=claims,
        text=method.text,
        blame=culprit(method, analysis, claims, reach, remark),
        remark=remark,
        constants=_constants(analysis) if want_constants else None,
        left_behind=method.left_behind,
        rules=method.rules,
    )


def _check_other_kind(method: MethodFile, limit: int, want_constants: bool) -> Outcome:
    analysis = analyse_any(method, limit)
    assert not isinstance(analysis, Analysis)
    own: dict[str, Any] = {analysis.form: analysis}
    remark = looks_rounded(method, analysis.order)
    return Outcome(
        file=method.source,
        name=method.name,
        claims=verify(method.claims, analysis),
        text=method.text,
        misprints=misprints(method, analysis.order, remark=remark),
        remark=remark,
        constants=_constants(analysis) if want_constants else None,
        left_behind=method.left_behind,
        **own,
    )


def _constants(analysis: AnyAnalysis) -> ErrorConstants | None:
    if analysis.order.is_lower_bound:
        return None
    from garkcli.order.constants import error_constants

    return error_constants(analysis.tableau, analysis.order.order + 1)
