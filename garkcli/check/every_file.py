"""A file with free parameters, checked: what holds for every value of them."""

from __future__ import annotations

from collections.abc import Mapping

from garkcli.check.every_claims import verify_every
from garkcli.check.every_value import every_value
from garkcli.check.outcome import Outcome
from garkcli.doing import doing
from garkcli.errors import Fault, GarkError, HasFreeParameters, MethodFileError
from garkcli.methodfile.expectations import highest_order
from garkcli.methodfile.family import family_of

MOST_PARAMETERS = 30
"""Free parameters of a file that is checked: with 27 it takes ten seconds, with 35 minutes."""


@doing("what holds for every value of the parameters")
def check_every(
    file: HasFreeParameters, limit: int, want_constants: bool, settings: Mapping[str, str]
) -> Outcome:
    """Check a file whose parameters are free.

    Args:
        file: with its text.
        limit: where the search for orders stops, unless a claim of the file reaches further.
        want_constants: whether error constants were asked for, which need values.
        settings: values of other parameters.
    """
    try:
        family = family_of(file, settings)
        count = len(family.parameters)
        if count > MOST_PARAMETERS:
            message = f"{count} free parameters (limit {MOST_PARAMETERS})"
            cure = "give values to some by --set; gark design asks for one order"
            return _refused(file, message, cure, "too-many")
        of_dense = [x for x in family.claims if x.key.startswith("dense")]
        if of_dense:
            name = family.parameters[0]
            message = f"{of_dense[0].key} is claimed, and {name} is free"
            cure = f"dense output is judged for values: --set {name}=1/2"
            return _refused(file, message, cure, "free-parameters")
        reach = max(limit, highest_order(family.claims) + 1)
        found = every_value(family, reach)
    except MethodFileError as error:
        faults = error.faults
        return Outcome(file.source, file.source, faults=faults, text=file.text)
    except GarkError as error:
        return _refused(file, error.message, error.help, error.code)
    if want_constants:
        name = found.parameters[0]
        message = "error constants are numbers, and a parameter is free"
        return _refused(file, message, f"choose a value: --set {name}=1/2", "free-parameters")
    return Outcome(
        file=family.source,
        name=family.name,
        structure=family.structure,
        every=found,
        claims=verify_every(family.claims, found),
        text=file.text,
        left_behind=family.left_behind,
    )


def _refused(file: HasFreeParameters, message: str, cure: str, code: str) -> Outcome:
    """What is not said for every value."""
    faults = (Fault(message, cure, code=code),)
    return Outcome(file.source, file.source, faults=faults, text=file.text)
