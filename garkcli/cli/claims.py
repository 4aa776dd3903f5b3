"""``gark claims``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.cli.options import Given, Output, declared
from garkcli.errors import HasFreeParameters, UsageProblem
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.methodfile.build import MethodFile


@declared("claims", FORMATS)
def claims(given: Given, output: Output) -> None:
    """The true claims of a method, as a file makes them under `expect`.

    For a file with claims: these, corrected. Otherwise the orders, whether it is symplectic, its
    stage order, and the properties that it has. Claims that do not apply or are undecided are left
    out.

    --write puts the claims into the files, so that gark check fails once the method changes.
    """
    from garkcli.api.calls import refuse_unknown, true_claims_of
    from garkcli.methodfile.carried import write_claims
    from garkcli.methodfile.expectations import CLAIMS
    from garkcli.page.writing import write_whole
    from garkcli.report.claims import REPORT, Claims, yaml_text

    refuse_unknown(given.keys)
    if given.write and "-" in given.files:
        raise UsageProblem("--write needs a file", "name one in place of -", code="option-alone")
    paths = given.files_meant(output)
    if given.write:
        from garkcli.methodfile.naming import find_named

        for path in paths:
            if find_named(path) is not None:
                message = f"--write needs a file, and {path} is a name of the catalogue"
                raise UsageProblem(message, "give the path of the file", code="option-alone")
    methods = [_loaded(path) for path in paths]
    found = []
    for method in methods:
        made = (claim.key for claim in method.claims)
        wanted = list(CLAIMS) if given.all else [*made, *given.keys]
        found.append(true_claims_of(method, wanted))
    if given.write:
        for method, true in zip(methods, found, strict=True):
            text = write_claims(method.source, method.text, true.claims)
            if text != method.text:
                write_whole(method.source, [text], is_renewed=True)
    told = [Claims(true, given.write) for true in found]
    if output.format == "text":
        output.write(yaml_text(told, output.width, output.verbosity <= 0))
    else:
        output.tell(REPORT, *told)


def _loaded(path: str) -> MethodFile:
    """Returns a method with its claims.

    Raises UsageProblem for a family of methods.
    """
    from garkcli.methodfile.load import load

    try:
        return load(path)
    except HasFreeParameters as error:
        message = f"{error.source} has free parameters, and claims are of one method"
        cure = "gark check says what holds for every value"
        raise UsageProblem(message, cure, code="free-parameters") from None
